"""Opens the CSV table of a packing: centres, axes and quaternions of all bodies, images included."""
import csv

import numpy as np

from packing import export, grid

right, path = export("csv", "--images")
with open(path, newline="") as file:
    header, *rows = csv.reader(file)
columns = {name.split(" [")[0]: values for name, values in zip(header, zip(*rows))}


def numbers(*names):
    return np.array([[float(text) for text in columns[name]] for name in names]).T


particle = numbers("particle")[:, 0].astype(int)
image = numbers("image_x", "image_y", "image_z").astype(int)
# Those that hold a point of a fine grid; the four bodies leave no thinner slices.
seen = list(right.images(grid(right.box, 80)))
assert [(i, tuple(shift)) for i, shift in zip(particle, image)] == seen
assert len(seen) > 10
assert np.array_equal(numbers("x", "y", "z"), right.position[particle] + image * right.box)
assert np.array_equal(numbers("a", "b", "c"), right.axes[particle])
assert np.array_equal(numbers("qw", "qx", "qy", "qz"), right.orientation[particle])
assert np.array_equal(numbers("box_x", "box_y", "box_z"), np.tile(right.box, (len(rows), 1)))
assert list(columns["species"]) == [right.species[i] for i in particle]
