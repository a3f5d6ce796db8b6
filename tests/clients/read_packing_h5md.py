"""Opens a state of three dimensions with h5py and MDAnalysis, and compares with what write_packing puts there."""
import sys
import warnings

import h5py
import numpy as np

warnings.simplefilter("ignore")
import MDAnalysis  # noqa: E402

positions = np.array([[-0.97, -0.95, -0.98], [0.1, 0.03, -0.95], [0, -0.9, 0.05], [-0.96, 0, 0]])
i = np.arange(4)
half = (0.7 * i + 0.3) / 2
axis = np.stack([1 + 0 * i, i, 2 + 0 * i], axis=1)
axis = axis / np.linalg.norm(axis, axis=1)[:, None]
orientations = np.concatenate([np.cos(half)[:, None], np.sin(half)[:, None] * axis], axis=1)

with h5py.File(sys.argv[2], "r") as file:
    particles = file["particles/all"]
    box = particles["box"]
    assert box.attrs["dimension"] == 3
    assert list(box.attrs["boundary"]) == [b"periodic"] * 3
    assert np.array_equal(box["edges/value"][:], [np.diag([2.0, 2.0, 2.0])])
    assert np.array_equal(particles["position/value"][:], [positions])
    assert np.array_equal(particles["image/value"][:], [np.stack([i, -i, 0 * i], axis=1)])
    assert np.allclose(particles["orientation/value"][:], [orientations], rtol=0, atol=3e-16)
    assert particles["velocity/value"].shape == particles["angular_velocity/value"].shape == (1, 4, 3)
    assert "angle" not in particles
    assert np.array_equal(particles["semiaxes"][:],
                          [[0.6, 0.3, 0.3], [0.5, 0.5, 0.2], [0.4, 0.4, 0.4], [0.55, 0.25, 0.4]])
    assert list(particles["species"][:]) == [0, 0, 1, 0]
    assert file["parameters"].attrs["dimension"] == 3

universe = MDAnalysis.Universe.empty(4, trajectory=True, velocities=True)
universe.load_new(sys.argv[2], format="H5MD", convert_units=False)
assert universe.trajectory.n_frames == 1
assert np.allclose(universe.atoms.positions, positions, rtol=0, atol=1e-7)
assert np.array_equal(universe.dimensions, [2, 2, 2, 90, 90, 90])
