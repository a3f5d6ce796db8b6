"""Pairs of ellipses from NumPy arrays to NumPy arrays: 0.93 of the rate of a loop in C++ for overlaps and 0.83 for
first contacts, with the same numbers of both (commit 38009a9).

A run of {PARTICLES} ellipses (κ = 2, φ = 0.6) that writes a frame every {COLLISIONS_PER_FRAME} collisions, with and
without a function that is called with every frame: {share:+.1%} (median of {ROUNDS} pairs of runs of {seconds:.1f} s),
of which the copy of the frame is a part; below {MAX_CALLBACK:.0%} is required.
"""

import pathlib
import statistics
import sys
import tempfile
import time

from validation.common import expect

TITLE = "From Python"
INPUTS = ["python"]

PARTICLES, COLLISIONS_PER_FRAME, FRAMES, ROUNDS = 1000, 1000, 400, 5
MAX_CALLBACK = 0.05  # of the time of the run, beyond the copy


def callback_cost(vitrel):
    """Share of the time of a run that a callback takes, beyond the copy of the frame; and that of the copy."""
    state = vitrel.prepare(particles=PARTICLES, packing_fraction=0.6, aspect_ratio=2, seed=1, quiet=True)

    def run(folder, duration, interval, on_frame):
        start = time.perf_counter()
        found = vitrel.run(state, output=pathlib.Path(folder, f"{start}.h5"), duration=duration, equilibration=0,
                           samples__interval=interval, on_frame=on_frame, quiet=True)
        return time.perf_counter() - start, found

    with tempfile.TemporaryDirectory() as folder:
        _, trial = run(folder, 1, 0.1, None)
        interval = COLLISIONS_PER_FRAME / trial.summary["collisions"]
        plain, called = [], []
        for _ in range(ROUNDS):
            plain.append(run(folder, FRAMES * interval, interval, None)[0])
            called.append(run(folder, FRAMES * interval, interval, lambda frame: None)[0])
    ratios = [b / a for a, b in zip(plain, called)]
    return statistics.median(ratios) - 1, statistics.median(plain)


def measure(build):
    sys.path.insert(0, str(build / "python"))
    import vitrel  # only here: a test imports all validations

    share, seconds = callback_cost(vitrel)
    expect(share < MAX_CALLBACK, f"a callback takes {100 * share:.1f} % of the run")
    return {"share": share, "seconds": seconds}
