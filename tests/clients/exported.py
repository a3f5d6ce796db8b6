"""Exports a trajectory and holds its numbers, read with h5py, to compare with."""
import os
import subprocess
import sys
import tempfile

import h5py
import numpy as np

folder = tempfile.TemporaryDirectory()  # removed at the end of the script


class Trajectory:
    def __init__(self, path):
        with h5py.File(path, "r") as file:
            particles = file["particles/all"]
            self.step = particles["position/step"][:]
            self.time = particles["position/time"][:]
            edges = particles["box/edges/value"][:]
            self.box = np.stack([edges[:, 0, 0], edges[:, 1, 1]], axis=1)
            self.position = particles["position/value"][:]
            self.image = particles["image/value"][:]
            self.angle = particles["angle/value"][:]
            self.has_velocity = "velocity" in particles
            if self.has_velocity:
                self.velocity = particles["velocity/value"][:]
                self.angular_velocity = particles["angular_velocity/value"][:, :, 2]
            names = {value: name for name, value in h5py.check_enum_dtype(particles["species"].dtype).items()}
            self.species = [names[k] for k in particles["species"][:]]
            self.mass = particles["mass"][:]
            self.axes = particles["semiaxes"][:, :2]
        self.frames, self.n = self.angle.shape
        # Homogeneous ellipses; round particles do not turn.
        inertia = self.mass * (self.axes**2).sum(axis=1) / 4
        self.inertia = np.where(self.axes[:, 0] == self.axes[:, 1], 0, inertia)


def export(suffix):
    """The trajectory of the command line (program, file), and the path that it was exported to."""
    program, source = sys.argv[1:]
    path = os.path.join(folder.name, "exported." + suffix)
    subprocess.run([program, "export", source, "--to", suffix, "-o", path, "-q"], check=True)
    return Trajectory(source), path


def expect(name, found, right):
    found, right = np.asarray(found), np.asarray(right)
    assert found.shape == right.shape, f"{name}: shape {found.shape}, not {right.shape}"
    assert np.array_equal(found, right), f"{name}: {found} is not {right}"


def expect_near(name, found, right, tolerance):
    found, right = np.asarray(found), np.asarray(right)
    assert found.shape == right.shape, f"{name}: shape {found.shape}, not {right.shape}"
    assert np.all(np.abs(found - right) <= tolerance), f"{name}: {found} is not {right}"
