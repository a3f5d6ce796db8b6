"""Exports a trajectory and holds its numbers, read with h5py, to compare with."""
import os
import subprocess
import sys
import tempfile

import h5py
import numpy as np

folder = tempfile.TemporaryDirectory()  # removed at the end of the script


class Trajectory:
    """All vectors are those of space; in the plane z = 0, the box is 1 high, and c = b."""

    def __init__(self, path):
        with h5py.File(path, "r") as file:
            self.dimension = file["parameters"].attrs["dimension"]
            particles = file["particles/all"]
            self.step = particles["position/step"][:]
            self.time = particles["position/time"][:]
            self.box = np.diagonal(particles["box/edges/value"][:], axis1=1, axis2=2)
            self.position = particles["position/value"][:]
            self.image = particles["image/value"][:]
            self.has_velocity = "velocity" in particles
            if self.has_velocity:
                self.velocity = particles["velocity/value"][:]
                self.angular_velocity = particles["angular_velocity/value"][:]
                if self.dimension == 2:
                    self.angular_velocity = np.pad(self.angular_velocity[:, :, None], ((0, 0), (0, 0), (2, 0)))
            names = {value: name for name, value in h5py.check_enum_dtype(particles["species"].dtype).items()}
            self.species = [names[k] for k in particles["species"][:]]
            self.mass = particles["mass"][:]
            self.axes = particles["semiaxes"][:]
            if self.dimension == 2:
                self.angle = particles["angle/value"][:]
                half, zero = self.angle / 2, np.zeros(self.angle.shape)
                self.orientation = np.stack([np.cos(half), zero, zero, np.sin(half)], axis=2)
                self.axes[:, 2] = self.axes[:, 1]
            else:
                self.orientation = particles["orientation/value"][:]
        self.frames, self.n = self.position.shape[:2]


def export(suffix, output=None):
    """The trajectory of the command line (program, file), and the path that it was exported to."""
    program, source = sys.argv[1:]
    path = os.path.join(folder.name, output or "exported." + suffix)
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
