"""Reads a trajectory with MDAnalysis and compares positions, velocities, box and times, which it holds
in single precision; all numbers of the sample are exact in it."""
import sys
import warnings

import numpy as np

warnings.simplefilter("ignore")
import MDAnalysis  # noqa: E402

import sample  # noqa: E402

universe = MDAnalysis.Universe.empty(sample.N, trajectory=True, velocities=True)
# The file has no units: everything is in units of the particles.
universe.load_new(sys.argv[1], format="H5MD", convert_units=False)
assert universe.trajectory.n_frames == sample.FRAMES
assert universe.trajectory.n_atoms == sample.N

seen = 0
for k, frame in enumerate(universe.trajectory):
    assert np.array_equal(frame.positions, sample.position(k)), frame.positions
    assert np.array_equal(frame.velocities, sample.velocity(k)), frame.velocities
    assert np.array_equal(frame.dimensions, [20 + k, 10, 1, 90, 90, 90]), frame.dimensions
    assert frame.time == 0.25 * k, frame.time
    assert frame.data["step"] == 10 * k
    assert frame.data["collisions"] == 100 * k
    seen += 1
assert seen == sample.FRAMES

# Random access, as analyses use it.
assert np.array_equal(universe.trajectory[2].positions, sample.position(2))
