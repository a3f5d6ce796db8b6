"""The package for Python beside C++: pairs from arrays, and a callback for every frame of a run."""

import json
import pathlib
import statistics
import sys
import tempfile
import textwrap
import time

from validation.common import expect, output_of, table

TITLE = "From Python"

PAIRS, HORIZON, REPEATS = 1_000_000, 10, 5
MIN_RATE = 0.8  # of C++

PARTICLES, COLLISIONS_PER_FRAME, FRAMES, ROUNDS = 1000, 1000, 400, 5
MAX_CALLBACK = 0.05  # of the time of the run, beyond the copy


def bodies(numpy):
    """Both bodies of every pair as the program reads them: a, b, x, y, angle, v_x, v_y, angular velocity."""
    random = numpy.random.default_rng(1)
    rows = numpy.empty((PAIRS, 2, 8))
    rows[..., 0], rows[..., 1] = 2**0.5, 0.5**0.5
    rows[:, 0, 2:4] = 0
    rows[:, 1, 2:4] = random.uniform(-3, 3, (PAIRS, 2))
    rows[..., 4] = random.uniform(0, numpy.pi, (PAIRS, 2))
    rows[..., 5:] = random.normal(size=(PAIRS, 2, 3))
    return rows


def best_seconds(work):
    times = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        found = work()
        times.append(time.perf_counter() - start)
    return min(times), found


def pairs_from_arrays(build, vitrel, numpy):
    """Rows of the table: times of C++ and of Python, from arrays to arrays."""
    rows = bodies(numpy)
    with tempfile.NamedTemporaryFile() as file:
        rows.tofile(file.name)
        native = json.loads(output_of([build / "bench/vitrel-bench", "pair-arrays", file.name, "--horizon", str(HORIZON)]))

    def both():
        return [vitrel.Bodies(part[:, :2], part[:, 2:4], angle=part[:, 4], velocity=part[:, 5:7], angular_velocity=part[:, 7])
                for part in (rows[:, 0], rows[:, 1])]

    overlap_seconds, overlap = best_seconds(lambda: vitrel.overlap(*both()))
    contact_seconds, contact = best_seconds(lambda: vitrel.first_contact(*both(), horizon=HORIZON))
    expect(int(overlap.sum()) == native["overlaps"], "numbers of overlaps differ")
    touching = numpy.isfinite(contact.time)
    expect(int(touching.sum()) == native["contacts"], "numbers of contacts differ")
    return [("overlap", native["overlap_seconds"], overlap_seconds, native["overlaps"]),
            ("first contact", native["contact_seconds"], contact_seconds, native["contacts"])]


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
    import numpy  # only here: a test imports all validations
    import vitrel

    rows = pairs_from_arrays(build, vitrel, numpy)
    for name, native, python, _ in rows:
        expect(native / python >= MIN_RATE, f"{name}: {native / python:.2f} of the rate of C++")
    share, seconds = callback_cost(vitrel)
    expect(share < MAX_CALLBACK, f"a callback takes {100 * share:.1f} % of the run")
    lines = [(name, f"{1e9 * native / PAIRS:.0f}", f"{1e9 * python / PAIRS:.0f}", f"{native / python:.2f}", found)
             for name, native, python, found in rows]
    pairs = (
        f"{PAIRS:,} pairs of ellipses (κ = 2) with random places, directions and motion: one loop of one processor in C++, and "
        f"the function of the package, from NumPy arrays to NumPy arrays. Both find the same numbers of overlaps and contacts. "
        f"At least {MIN_RATE} of the rate of C++ is required. The best of {REPEATS} repetitions.")
    callback = (
        f"A run of {PARTICLES} ellipses (κ = 2, φ = 0.6) that writes a frame every {COLLISIONS_PER_FRAME} collisions, with and "
        f"without a function that is called with every frame: {100 * share:+.1f} % (median of {ROUNDS} pairs of runs of "
        f"{seconds:.1f} s), of which the copy of the frame is a part; below {100 * MAX_CALLBACK:.0f} % is required.")
    head = ["", "C++ (ns a pair)", "Python (ns a pair)", "rate of Python over C++", "found"]
    return "\n\n".join([textwrap.fill(pairs, 120), table(head, lines), textwrap.fill(callback, 120)])
