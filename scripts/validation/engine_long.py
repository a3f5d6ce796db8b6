"""Newtonian dynamics of 1000 ellipses with aspect ratio 6 at φ = 0.75, swollen from a random dilute state and
equilibrated by 2000 Monte Carlo sweeps. {FRAMES} frames are saved, one about every million collisions. The exact check
(tolerance zero) tests each of them.

{table}
"""

import math
import pathlib
import tempfile

from validation.common import expect, settings, summary_of, table
from validation.comparison import SCENES

TITLE = "A hundred million collisions"
INPUTS = ["edmd", "core"]

COLLISIONS, FRAMES = 1e8, 100
TRIAL = 200  # units of time, to measure the collision rate
MARGIN = 1.1  # the rate falls by ten to twenty per cent while the particles align
# Figures of the run and of its check, with their bounds.
REQUIRED = (
    ("collisions", COLLISIONS, math.inf),
    ("correction_moves", 0, 0),
    ("frames", FRAMES, math.inf),
    ("overlaps", 0, 0),
    ("energy_drift", 0, 1e-10),
    ("collisions_per_second", 0, math.inf),
)


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
    figures = done | check
    rows = []
    for name, least, most in REQUIRED:
        value = figures[name]
        expect(least <= value <= most, f"{name}: {value}, not between {least:g} and {most:g}")
        rows.append([name.replace("_", " "), f"{value:.4g}", f"{least:g}", f"{most:g}"])
    return {"table": table(["", "measured", "at least", "at most"], rows)}
