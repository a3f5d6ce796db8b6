"""Newtonian dynamics of 1000 ellipses with aspect ratio 6 at φ = 0.75, swollen from a random dilute state and equilibrated by
2000 Monte Carlo sweeps. {FRAMES} frames are saved, one about every million collisions. The exact check (tolerance zero)
tests each of them.

{table}
"""

import pathlib
import tempfile

from validation.common import expect, settings, summary_of, table
from validation.comparison import SCENES

TITLE = "A hundred million collisions"
INPUTS = ["edmd", "core"]

COLLISIONS, FRAMES = 1e8, 100
TRIAL = 200  # units of time, to measure the collision rate
MARGIN = 1.1  # the rate falls by ten to twenty per cent while the particles align


def run(build, folder, duration, interval):
    """The summaries of a run and of its exact check."""
    file = pathlib.Path(folder, f"{duration:.0f}.h5")
    changes = settings([f"dynamics.duration={duration:.6f}", f"output.samples.interval={interval:.6f}"])
    return summary_of(build, "run", SCENES / "long_run.toml", "-o", file, *changes), summary_of(build, "check", file)


def measure(build):
    with tempfile.TemporaryDirectory() as folder:
        trial, _ = run(build, folder, TRIAL, TRIAL)
        interval = MARGIN * COLLISIONS * TRIAL / trial["collisions"] / FRAMES
        done, check = run(build, folder, FRAMES * interval, interval)
    required = {
        "collisions": (done["collisions"], "≥", COLLISIONS), "correction moves": (done["correction_moves"], "≤", 0),
        "frames": (check["frames"], "≥", FRAMES), "overlaps": (check["overlaps"], "≤", 0),
        "largest relative energy drift": (done["energy_drift"], "≤", 1e-10)}
    for name, (value, relation, bound) in required.items():
        expect(value >= bound if relation == "≥" else value <= bound, f"{name}: {value}")
    others = {"smallest gap in all frames": check["smallest_gap"], "largest momentum": done["largest_momentum"],
              "βP/ρ": done["compressibility_factor"], "simulated time": done["simulated_time"],
              "collisions per second, files and checks included": done["collisions_per_second"]}
    rows = [[name, f"{value:.4g}", f"{relation} {bound:g}"] for name, (value, relation, bound) in required.items()]
    return {"table": table(["", "measured", "required"], rows + [[name, f"{value:.3g}", "–"] for name, value in others.items()])}
