"""A million pairs of ellipses from NumPy arrays to NumPy arrays, all alike, beside a loop in C++ over the same pair (`vitrel-bench
pair`): {rates}. At least {rate_floor} is required.

A run of {PARTICLES} ellipses (κ = 2, φ = 0.6) that writes a frame every {COLLISIONS_PER_FRAME} collisions, with and
without a function that is called with every frame: {share:+.1%} (median of {ROUNDS} pairs of runs of {seconds:.1f} s),
of which the copy of the frame is a part; below {MAX_CALLBACK:.0%} is required.
"""

import json
import pathlib
import statistics
import sys
import tempfile
import time
import timeit

from validation.common import expect, output_of

TITLE = "From Python"
INPUTS = ["python"]

PAIRS, MIN_RATES = 1_000_000, {"overlaps": 0.9, "first contacts": 0.8}
PAIR = [{"semi_axes": [1.4, 0.7], "position": [0.0, 0.0], "angle": 0.3, "velocity": [0.0, 0.0], "angular_velocity": 0.4},
        {"semi_axes": [1.4, 0.7], "position": [2.6, 0.8], "angle": 1.9, "velocity": [-1.0, 0.2], "angular_velocity": -0.7}]
PARTICLES, COLLISIONS_PER_FRAME, FRAMES, ROUNDS = 1000, 1000, 400, 5
MAX_CALLBACK = 0.05  # of the time of the run, beyond the copy


def pair_rates(build, vitrel):
    """Rates of Python over those of C++, by the time of the process, the best of several."""
    answers = json.loads(output_of([build / "bench/vitrel-bench", "pair", vitrel.to_toml({"horizon": 10.0, "body": PAIR}),
                                    "--method", "separating_axis", "--json"]))
    one, two = (vitrel.Bodies(**{key: [value] * PAIRS for key, value in body.items()}) for body in PAIR)

    def nanoseconds(work):
        return 1e9 / PAIRS * min(timeit.repeat(work, timer=time.process_time, number=1, repeat=ROUNDS))

    return {"overlaps": answers["overlap"]["ns_per_call"] / nanoseconds(lambda: vitrel.overlap(one, two)),
            "first contacts": answers["rows"][0]["ns_per_call"] / nanoseconds(lambda: vitrel.first_contact(one, two, horizon=10))}


def callback_cost(vitrel):
    """The share of the time of a run that a callback takes, and the seconds of a run without."""
    state = vitrel.prepare(particles=PARTICLES, packing_fraction=0.6, aspect_ratio=2, seed=1, quiet=True)

    def run(folder, duration, interval, on_frame):
        start = time.perf_counter()
        found = vitrel.run(state, output=pathlib.Path(folder, f"{start}.h5"), duration=duration, equilibration=0,
                           samples__interval=interval, on_frame=on_frame, quiet=True)
        return time.perf_counter() - start, found

    with tempfile.TemporaryDirectory() as folder:
        _, trial = run(folder, 1, 0.1, None)
        interval = COLLISIONS_PER_FRAME / trial.summary["collisions"]
        rounds = [[run(folder, FRAMES * interval, interval, on_frame)[0] for on_frame in (None, lambda frame: None)]
                  for _ in range(ROUNDS)]
    return statistics.median(called / plain for plain, called in rounds) - 1, statistics.median(plain for plain, _ in rounds)


def measure(build):
    sys.path.insert(0, str(build / "python"))
    import vitrel  # only here: a test imports all validations

    rates = pair_rates(build, vitrel)
    for name, floor in MIN_RATES.items():
        expect(rates[name] >= floor, f"{name}: {rates[name]:.2f} of the rate of C++")
    share, seconds = callback_cost(vitrel)
    expect(share < MAX_CALLBACK, f"a callback takes {100 * share:.1f} % of the run")
    return {"rates": ", ".join(f"{rate:.2f} of its rate for {name}" for name, rate in rates.items()), "share": share,
            "rate_floor": " and ".join(map(str, MIN_RATES.values())), "seconds": seconds}
