"""Exports a packing and holds its numbers, read with h5py, to compare with."""
import itertools
import os
import subprocess
import sys
import tempfile

import h5py
import numpy as np

folder = tempfile.TemporaryDirectory()  # removed at the end of the script


def rotation(q):
    """The matrix of a quaternion w, x, y, z."""
    w, x, y, z = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


class Packing:
    def __init__(self, path):
        with h5py.File(path, "r") as file:
            particles = file["particles/all"]
            self.box = np.diag(particles["box/edges/value"][-1])
            self.position = particles["position/value"][-1]
            self.orientation = particles["orientation/value"][-1]
            self.axes = particles["semiaxes"][:]
            names = {value: name for name, value in h5py.check_enum_dtype(particles["species"].dtype).items()}
            self.kind = particles["species"][:]
            self.species = [names[k] for k in self.kind]
        self.n = len(self.position)
        self.turn = np.array([rotation(q) for q in self.orientation])

    def inside(self, i, shift, points):
        """Which points the image of particle i holds."""
        own = (points - self.position[i] - shift * self.box) @ self.turn[i] / self.axes[i]
        return (own**2).sum(axis=1) <= 1

    def volumes(self):
        return 4 * np.pi / 3 * self.axes.prod(axis=1)

    def images(self, points):
        """The images (particle, shift) that hold any of the points, in order."""
        for i in range(self.n):
            for shift in itertools.product((-1, 0, 1), repeat=3):
                if self.inside(i, np.array(shift), points).any():
                    yield i, shift


def export(suffix, *options):
    """The packing of the command line (program, state or parameter file), and the path that it was exported to."""
    program, source = sys.argv[1:3]
    if source.endswith(".toml"):
        state = os.path.join(folder.name, "prepared.h5")
        subprocess.run([program, "prepare", source, "-o", state, "-q"], check=True)
        source = state
    path = os.path.join(folder.name, "exported." + suffix)
    subprocess.run([program, "export", source, "--to", suffix, "-o", path, "-q", *options], check=True)
    return Packing(source), path


def grid(box, n):
    """The centres of n³ cells, x fastest."""
    at = (np.arange(n) + 0.5) / n - 0.5
    z, y, x = np.meshgrid(at, at, at, indexing="ij")
    return np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1) * box
