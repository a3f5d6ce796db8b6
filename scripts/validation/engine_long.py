"""A hundred million collisions of elongated ellipses at high density: overlaps, correction moves, energy."""

import pathlib
import tempfile

from validation.common import expect, summary_of, table

TITLE = "A hundred million collisions"
PARTICLES = 1000
COLLISIONS = 1e8
FRAMES = 100
ENERGY_DRIFT = 1e-10  # relative
TRIAL = 200  # units of time, to measure the collision rate
MARGIN = 1.1  # the rate falls by ten to twenty per cent while the particles align

PARAMETERS = f"""[system]
particles = {PARTICLES}
packing_fraction = 0.75
seed = 1

[[species]]
name = "A"
fraction = 1.0
aspect_ratio = 6.0

[[prepare.stage]]
method = "insert"
packing_fraction = 0.2

[[prepare.stage]]
method = "swell"

[[prepare.stage]]
method = "sample"
sweeps = 2000

[dynamics]
kind = "newtonian"
equilibration = 0.0

[output]
velocities = false
"""


def run(build, parameters, output, duration, interval):
    return summary_of(build, "run", parameters, "-o", output, "--set", f"dynamics.duration={duration:.6f}", "--set",
                      f'output.samples={{ spacing = "linear", interval = {interval:.6f} }}')


def measure(build):
    with tempfile.TemporaryDirectory() as folder:
        parameters, file = pathlib.Path(folder, "long.toml"), pathlib.Path(folder, "run.h5")
        parameters.write_text(PARAMETERS, encoding="utf-8")
        trial = run(build, parameters, pathlib.Path(folder, "trial.h5"), TRIAL, TRIAL)
        interval = MARGIN * COLLISIONS * TRIAL / trial["collisions"] / FRAMES
        done = run(build, parameters, file, FRAMES * interval, interval)
        check = summary_of(build, "check", file)
    expect(done["collisions"] >= COLLISIONS, f"only {done['collisions']} collisions")
    expect(done["correction_moves"] == 0, f"{done['correction_moves']} correction moves")
    expect(done["energy_drift"] <= ENERGY_DRIFT, f"relative energy drift {done['energy_drift']}")
    expect(check["frames"] >= FRAMES and check["overlaps"] == 0,
           f"{check['overlaps']} overlaps in {check['frames']} frames")
    rows = [["collisions", f"{done['collisions']:.4g}", f"≥ {COLLISIONS:g}"],
            ["correction moves", done["correction_moves"], "0"],
            [f"overlaps in {check['frames']} frames", check["overlaps"], "0"],
            ["smallest gap in all frames", f"{check['smallest_gap']:.1e}", "≥ 0"],
            ["largest relative energy drift", f"{done['energy_drift']:.1e}", f"≤ {ENERGY_DRIFT:g}"],
            ["largest momentum", f"{done['largest_momentum']:.1e}", "–"],
            ["βP/ρ", f"{done['compressibility']:.3f}", "–"],
            ["simulated time", f"{done['simulated_time']:.0f}", "–"],
            ["collisions per second, files and checks included", f"{done['collisions_per_second']:.3g}", "–"]]
    return f"""Newtonian dynamics of {PARTICLES} ellipses with aspect ratio 6 at φ = 0.75, swollen from a random dilute state and equilibrated by
2000 Monte Carlo sweeps. {FRAMES} frames are saved, one about every million collisions. The exact check (tolerance zero)
tests each of them.

{table(["", "measured", "required"], rows)}
"""
