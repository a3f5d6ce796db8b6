"""Monte Carlo at the pressure P = ρZ of a table must reproduce the packing fraction of the table. This is tested in a
box of constant shape (isotropic) and in a box whose sides change one at a time (anisotropic). βP is in units of 1/(a
b). An ellipse with a b = 1 has the area π, so βP = φZ/π. Z of disks comes from Kolafa and Rottner, Mol. Phys. 104, 3435
(2006), for the infinite system. Z of ellipses comes from Monte Carlo at constant volume with N ≈ 400, an independent
route.

{SEEDS} seeds of each state start from random positions at the φ of the table. Averages are over the second half of the
sweeps: {sweeps} for N = 100. Required: a standard error, from the scatter of the seeds, of at most {LARGEST_ERROR:.1%} of φ; a
deviation of at most 3 standard errors plus the error of the tables (0.1 % of φ, 0.3 % from φ = 0.6 on). The same holds for
the mean of all deviations, with 0.1 %: {mean}.

{table}

Volumes decorrelate slowly: a volume move is accepted if it
creates no overlap, so its step is about 1/(N (Z − 1)) of the volume, which diffuses in such steps across the width of
its distribution, 1/√(N ∂(φZ)/∂φ). That takes 100 to 1900 sweeps at N = 100. The number of sweeps for a given error is
independent of N, and small systems are cheap.
"""

import math
import statistics

from validation.common import Estimate, shape
from validation.comparison import SCENES, SEED, Comparison, Scenes, Tolerance, compared
from validation.literature import fluid_pressures

TITLE = "Constant pressure: packing fractions of hard disks and ellipses"
INPUTS = ["mc", "core", "workflow/stages", "bench/reference/literature.h"]

SEEDS = 16
SWEEPS = {1: 16_000, 2: 16_000, 4: 24_000, 6: 28_000}  # per seed, by aspect ratio
LARGER = ((1, 0.6), (6, 0.2))  # states with four times as many particles, too
LARGEST_ERROR = 0.003  # of φ

KAPPA, PHI, PARTICLES, BOX = "species.0.aspect_ratio", "system.packing_fraction", "system.particles", "prepare.stage.2.box"


def table_error(phi):
    """Relative error stated by the authors."""
    return 0.003 if phi >= 0.6 else 0.001


def pressure(phi, z):
    """βP = ρZ in units of 1/(a b): an ellipse with a b = 1 covers π."""
    return phi / math.pi * z


def states():
    """Entry of the table, box and number of particles of each measurement."""
    entries = fluid_pressures()
    yield from ((entry, box, 100) for entry in entries for box in ("isotropic", "anisotropic"))
    yield from ((entry, "isotropic", 400) for entry in entries if (entry.aspect_ratio, entry.packing_fraction) in LARGER)


def rows():
    """Every state has seeds of its own: two with equal seeds would draw equal changes of the box."""
    return tuple(
        {KAPPA: entry.aspect_ratio, PHI: entry.packing_fraction, PARTICLES: particles, BOX: box,
         "prepare.stage.2.pressure": pressure(entry.packing_fraction, entry.z),
         "prepare.stage.2.sweeps": SWEEPS[entry.aspect_ratio], SEED: number * SEEDS + k + 1}
        for number, (entry, box, particles) in enumerate(states()) for k in range(SEEDS))


COMPARISON = Comparison(
    Scenes(SCENES / "constant_pressure.toml", rows=rows()),
    quantity="prepare.stages.-1.mean_packing_fraction",
    reference=lambda scene: scene[PHI],
    tolerance=lambda scene: Tolerance(relative=table_error(scene[PHI]), largest_error=LARGEST_ERROR),
    columns={"": lambda scene: shape(scene[KAPPA]), "N": lambda scene: scene[PARTICLES], "box": lambda scene: scene[BOX],
             "βP": lambda scene: f"{scene['prepare.stage.2.pressure']:.6f}"})


def mean_deviation(found):
    """The mean relative deviation and its standard error."""
    error = math.hypot(*(one.error / one.reference.mean for one in found)) / len(found)
    return Estimate(statistics.mean(one.deviation / one.reference.mean for one in found), error)


def measure(build):
    measured = COMPARISON.measure(build)
    mean = mean_deviation([one for _, one in measured])
    compared("mean deviation", mean, 0, Tolerance(absolute=table_error(0)))
    return {"table": COMPARISON.table(measured), "mean": f"{mean.mean:+.3%} ± {mean.error:.3%}",
            "sweeps": ", ".join(f"{sweeps} ({shape(kappa)})" for kappa, sweeps in SWEEPS.items())}
