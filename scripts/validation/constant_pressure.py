"""Monte Carlo at constant pressure: the pressure of an equation of state yields its packing fraction."""

import itertools
import math
import pathlib
import statistics
import tempfile

from validation.common import estimate, expect, fluid_pressures, preparation, shape, summary_of, table

TITLE = "Constant pressure: packing fractions of hard disks and ellipses"

REFERENCE = tuple((*state, z) for state, z in fluid_pressures().items())  # aspect ratio, φ, Z
BOXES = ("isotropic", "anisotropic")
SEEDS = 16
PARTICLES = 100
# Per seed, by aspect ratio; averages are over the second half.
SWEEPS = {1: 16_000, 2: 16_000, 4: 24_000, 6: 28_000}
# Particles: multiple of the number of sweeps.
SIZES = {25: 2, 400: 1}
SIZE_STATES = ((1, 0.6), (6, 0.2))

LARGEST_ERROR = 0.003  # of φ
ERRORS = 3


def table_error(packing_fraction):
    """Relative error stated by the authors."""
    return 0.003 if packing_fraction >= 0.6 else 0.001


def pressure(packing_fraction, compressibility):
    """βP = ρZ in units of 1/(a b): an ellipse with a b = 1 covers π."""
    return packing_fraction / math.pi * compressibility


def derivative(points, x):
    """Derivative at x of the polynomial through the points (x, y)."""
    total = 0
    for j, (x_j, y_j) in enumerate(points):
        others = [x_k for k, (x_k, _) in enumerate(points) if k != j]
        slopes = (math.prod(x - x_k for x_k in others if x_k != left_out) for left_out in others)
        total += y_j * sum(slopes) / math.prod(x_j - x_k for x_k in others)
    return total


def spread(aspect_ratio, packing_fraction, particles):
    """Relative standard deviation of φ at constant pressure: the inverse square root of N ∂(φZ)/∂φ.

    The derivative is that of the table, with 1/√Z interpolated. 1/√Z is nearly linear in φ; scaled-particle theory
    gives 1 − φ for disks.
    """
    of_shape = {phi: z for kappa, phi, z in REFERENCE if kappa == aspect_ratio}
    z = of_shape[packing_fraction]
    slope = derivative([(0, 1), *((phi, 1 / math.sqrt(z)) for phi, z in of_shape.items())], packing_fraction)
    return 1 / math.sqrt(particles * (z - 2 * packing_fraction * z**1.5 * slope))


def parameters(particles, aspect_ratio, betap, box, sweeps):
    return preparation(particles, aspect_ratio, (1,), "[prepare]\nquality_sweeps = 0",
                       '[[prepare.stage]]\nmethod = "insert"', '[[prepare.stage]]\nmethod = "swell"',
                       f'[[prepare.stage]]\nmethod = "compress"\npressure = {betap!r}\nbox = "{box}"\n'
                       f'sweeps = {sweeps}')


def seeds(number):
    """The seeds of one measurement. Two measurements with equal seeds would draw equal changes of the box."""
    return range(number * SEEDS + 1, (number + 1) * SEEDS + 1)


class Found:
    """The mean packing fraction at the pressure of one table entry, from independent seeds."""

    def __init__(self, build, number, entry, box, particles=PARTICLES, more_sweeps=1):
        self.entry = entry
        self.aspect_ratio, self.reference, self.compressibility = entry
        self.box, self.particles = box, particles
        sweeps = round(SWEEPS[self.aspect_ratio] * more_sweeps)
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "pressure.toml")
            betap = pressure(self.reference, self.compressibility)
            file.write_text(parameters(particles, self.aspect_ratio, betap, box, sweeps), encoding="utf-8")
            means = []
            for seed in seeds(number):
                done = summary_of(build, "prepare", file, "-o", pathlib.Path(folder, f"{seed}.h5"),
                                  "--set", f"system.packing_fraction={self.reference}",
                                  "--set", f"system.seed={seed}")
                means.append(done["stages"][-1]["mean_packing_fraction"])
        self.mean, self.error = estimate(means)
        # Relative, as are all deviations below.
        self.deviation = self.mean / self.reference - 1
        self.relative_error = self.error / self.reference
        ratio = self.relative_error / spread(self.aspect_ratio, self.reference, particles)
        self.independent = SEEDS * sweeps / 2 * ratio**2

    def name(self):
        return f"{shape(self.aspect_ratio)}, φ = {self.reference}, {self.box}, N = {self.particles}"

    def check(self):
        expect(self.relative_error <= LARGEST_ERROR, f"{self.name()}: an error of {self.relative_error:.2%}")
        most = ERRORS * self.relative_error + table_error(self.reference)
        expect(abs(self.deviation) <= most, f"{self.name()}: φ = {self.mean:.5f} ± {self.error:.5f}")

    def row(self):
        return [shape(self.aspect_ratio), self.reference, f"{pressure(self.reference, self.compressibility):.6f}",
                self.box, f"{self.mean:.5f}", f"{self.error:.5f}", f"{self.deviation:+.2%}",
                f"{self.deviation / self.relative_error:+.1f}", f"{self.independent:.0f}"]

    def size_row(self):
        return [shape(self.aspect_ratio), self.reference, self.particles, f"{self.mean:.5f}", f"{self.error:.5f}",
                f"{self.deviation:+.2%}", f"{self.independent:.0f}"]


def mean_deviation(found):
    """The mean relative deviation and its standard error."""
    error = math.hypot(*(one.relative_error for one in found)) / len(found)
    return statistics.mean(one.deviation for one in found), error


def sizes(build, numbers, found):
    """The states of SIZE_STATES at all sizes, small ones first; only the larger ones must agree with the table."""
    all_sizes = []
    for entry in REFERENCE:
        if entry[:2] not in SIZE_STATES:
            continue
        same = [one for one in found if one.entry == entry and one.box == "isotropic"]
        for size in SIZES.items():
            same.append(Found(build, next(numbers), entry, "isotropic", *size))
        all_sizes += sorted(same, key=lambda one: one.particles)
    for one in all_sizes:
        if one.particles >= PARTICLES:
            one.check()
    return all_sizes


def measure(build):
    numbers = itertools.count()
    found = [Found(build, next(numbers), entry, box) for entry in REFERENCE for box in BOXES]
    for one in found:
        one.check()
    mean, error = mean_deviation(found)
    expect(abs(mean) <= ERRORS * error + table_error(0), f"a mean deviation of {mean:+.3%} ± {error:.3%}")
    head = ["", "φ, table", "βP", "box", "φ", "standard error", "deviation", "in standard errors",
            "sweeps per independent volume"]
    lengths = ", ".join(f"{sweeps} ({shape(kappa)})" for kappa, sweeps in SWEEPS.items())
    return f"""Monte Carlo at the pressure P = ρZ of a table must reproduce the packing fraction of the table. This is tested in a box of
constant shape (isotropic) and in a box whose sides change one at a time (anisotropic). βP is in units of 1/(a b). An ellipse
with a b = 1 has the area π, so βP = φZ/π. Z of disks comes from Kolafa and Rottner, Mol. Phys. 104, 3435 (2006), for the
infinite system. Z of ellipses comes from Monte Carlo at constant volume with N ≈ 400, an independent route.

{SEEDS} seeds of {PARTICLES} particles each start from random positions at the φ of the table. Averages are over the second half of
the sweeps. Sweeps per seed: {lengths}. Required: a standard error,
from the scatter of the seeds, of at most {LARGEST_ERROR:.1%} of φ; a deviation of at most {ERRORS} standard errors plus the error of the tables
({table_error(0):.1%} of φ, {table_error(0.6):.1%} from φ = 0.6 on). The same holds for the mean of all deviations, with {table_error(0):.1%}: {mean:+.3%} ± {error:.3%}.

Volumes decorrelate slowly. A volume move is accepted if it creates no overlap, so its step is about 1/(N (Z − 1)) of the
volume. The volume diffuses in such steps across the width of its distribution, 1/√(N ∂(φZ)/∂φ). The last column follows from
the measured error and this width: the length of the run divided by the number of independent volumes that give this error.
It grows with N as the square of the ratio of width to step. The number of sweeps for a given error is therefore
independent of N, and small systems are cheap.

{table(head, [one.row() for one in found])}

Finite-size effects in an isotropic box. The shift of φ decreases as 1/N or faster. In the smallest systems, which need not
agree with the table, it is at least four times as large as at N = {PARTICLES}, where it is therefore below the errors.

{table(["", "φ, table", "N", "φ", "standard error", "deviation", "sweeps per independent volume"],
       [one.size_row() for one in sizes(build, numbers, found)])}
"""
