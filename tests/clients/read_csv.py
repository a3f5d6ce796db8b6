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


directions = "xyz"[:right.dimension]
expected = {
    "frame": each_frame(np.arange(right.frames)),
    "step": each_frame(right.step),
    "time": each_frame(right.time),
    "id": each_particle(np.arange(right.n)),
    "mass": each_particle(right.mass),
}
for k, x in enumerate(directions):
    expected["box_" + x] = each_frame(right.box[:, k])
    expected[x] = right.position[:, :, k]
    expected["unwrapped_" + x] = right.position[:, :, k] + right.image[:, :, k] * right.box[:, None, k]
    expected["abc"[k]] = each_particle(right.axes[:, k])
    if right.has_velocity:
        expected["v" + x] = right.velocity[:, :, k]
if right.dimension == 2:
    expected["angle"] = right.angle
    if right.has_velocity:
        expected["omega"] = right.angular_velocity[:, :, 2]
else:
    expected.update({"q" + name: right.orientation[:, :, k] for k, name in enumerate("wxyz")})
    if right.has_velocity:
        expected.update({"omega_" + x: right.angular_velocity[:, :, k] for k, x in enumerate(directions)})
assert set(names) == {*expected, "species"}
for name, values in expected.items():
    expect(name, numbers(name), values)
expect("species", columns["species"], right.species * right.frames)
unit = dict(zip(names, units))
assert unit["time"] == "time" and unit["x"] == unit["a"] == "length"
assert unit["angle"] == "rad" if right.dimension == 2 else unit["qw"] == "1"
