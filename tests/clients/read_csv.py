"""Opens an exported CSV file with Python's csv and compares every column: the text carries all digits."""
import csv

import numpy as np

from exported import expect, export

right, path = export("csv")
with open(path, newline="") as file:
    header, *rows = csv.reader(file)
names, units = zip(*(name[:-1].split(" [") for name in header))
columns = dict(zip(names, zip(*rows)))
assert len(rows) == right.frames * right.n


def numbers(name):
    return np.array([float(text) for text in columns[name]]).reshape(right.frames, right.n)


def each_frame(values):
    return np.repeat(values[:, None], right.n, axis=1)


def each_particle(values):
    return np.repeat(np.asarray(values)[None], right.frames, axis=0)


unwrapped = right.position[:, :, :2] + right.image[:, :, :2] * right.box[:, None, :]
expected = {
    "frame": each_frame(np.arange(right.frames)),
    "step": each_frame(right.step),
    "time": each_frame(right.time),
    "box_x": each_frame(right.box[:, 0]),
    "box_y": each_frame(right.box[:, 1]),
    "id": each_particle(np.arange(right.n)),
    "x": right.position[:, :, 0],
    "y": right.position[:, :, 1],
    "unwrapped_x": unwrapped[:, :, 0],
    "unwrapped_y": unwrapped[:, :, 1],
    "angle": right.angle,
    "a": each_particle(right.axes[:, 0]),
    "b": each_particle(right.axes[:, 1]),
    "mass": each_particle(right.mass),
}
if right.has_velocity:
    expected.update(vx=right.velocity[:, :, 0], vy=right.velocity[:, :, 1], omega=right.angular_velocity)
assert set(names) == {*expected, "species"}
for name, values in expected.items():
    expect(name, numbers(name), values)
expect("species", columns["species"], right.species * right.frames)
unit = dict(zip(names, units))
assert unit["time"] == "time" and unit["x"] == unit["a"] == "length" and unit["angle"] == "rad"
