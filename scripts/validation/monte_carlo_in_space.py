"""Monte Carlo in space: constant pressure of spheres, the pressure of spheroids, and the speed of trials."""

import json
import math
import pathlib
import statistics
import tempfile

from validation.common import expect, output_of, properties_of_test, summary_of, table

TITLE = "Monte Carlo in space: spheres and spheroids"

VOLUME = 4 * math.pi / 3  # of a sphere of size 1
PARTICLES = 864  # 6³ cells of a face-centred cubic crystal
SEEDS = 8
LARGEST_ERROR = 0.0005  # of φ
ERRORS = 3
# Sweeps per seed, by packing fraction; averages are over the second half.
SWEEPS = {0.30: 350_000, 0.45: 350_000, 0.60: 250_000}
SPHEROIDS = "PackingFractions/SpheroidsByMonteCarlo.HaveThePressureOfMotion"
SPHEROID_EFFORT = 400
LARGEST_DIFFERENCE = 0.001  # of Z


def fluid(phi):
    """Z of the fluid: Kolafa, Labík and Malijevský (2004)."""
    x = phi / (1 - phi)
    powers = {1: 4, 2: 6, 3: 2.3647684, 4: -0.8698551, 5: 1.1062803, 6: -1.1014221, 7: 0.66605866, 8: -0.03633431,
              10: -0.20965164, 14: 0.10555569, 22: -0.0087238}
    return 1 + sum(factor * x**power for power, factor in powers.items())


def crystal(phi):
    """Z of the face-centred cubic crystal (Speedy 1998) of PARTICLES spheres.

    The centre of mass of a finite crystal moves freely: all but one particle contribute Z, and that one 1.
    """
    z = phi / (math.pi / math.sqrt(18))
    infinite = 3 / (1 - z) - 0.5921 * (z - 0.7072) / (z - 0.601)
    return infinite - (infinite - 1) / PARTICLES


STATES = (("fluid", 0.30, fluid), ("fluid", 0.45, fluid), ("crystal", 0.60, crystal))


def parameters(phi, compressibility, sweeps):
    return f"""[system]
dimension = 3
particles = {PARTICLES}
packing_fraction = {phi}

[[species]]
aspect_ratio = 1

[[prepare.stage]]
method = "lattice"
arrangement = "face_centred_cubic"

[[prepare.stage]]
method = "sample"
sweeps = 2000

[[prepare.stage]]
method = "compress"
pressure = {phi / VOLUME * compressibility!r}
sweeps = {sweeps}
"""


class Found:
    """The mean packing fraction at the pressure of an equation of state, from independent seeds."""

    def __init__(self, build, phase, phi, equation):
        self.phase, self.phi, self.compressibility = phase, phi, equation(phi)
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "pressure.toml")
            file.write_text(parameters(phi, self.compressibility, SWEEPS[phi]), encoding="utf-8")
            means = [summary_of(build, "prepare", file, "-o", pathlib.Path(folder, f"{seed}.h5"),
                                "--set", f"system.seed={seed}")["stages"][-1]["mean_packing_fraction"]
                     for seed in range(1, SEEDS + 1)]
        self.mean = statistics.mean(means)
        self.error = statistics.stdev(means) / math.sqrt(SEEDS) / phi
        self.deviation = self.mean / phi - 1

    def check(self):
        name = f"{self.phase}, φ = {self.phi}"
        expect(self.error <= LARGEST_ERROR, f"{name}: an error of {self.error:.3%}")
        expect(abs(self.deviation) <= ERRORS * self.error, f"{name}: φ = {self.mean:.5f} ± {self.error:.3%}")

    def row(self):
        return [self.phase, self.phi, f"{self.compressibility:.5f}", f"{self.mean:.6f}", f"{self.error:.3%}",
                f"{self.deviation:+.3%}", f"{self.deviation / self.error:+.1f}"]


def spheroids(build):
    """Z of spheroids of aspect ratio 3 by the contact function and by motion, at 0.30 and 0.45."""
    rows = []
    for number, phi in enumerate((0.30, 0.45)):
        found = properties_of_test(build / "tests/physics/test_physics", f"{SPHEROIDS}/{number}",
                                   VITREL_SPHEROID_EFFORT=SPHEROID_EFFORT)
        sampled, error, moved, its_error = (float(found[key]) for key in
                                            ("monte_carlo", "monte_carlo_error", "motion", "motion_error"))
        difference, its_scatter = sampled / moved - 1, math.hypot(error, its_error) / moved
        expect(abs(difference) <= LARGEST_DIFFERENCE + 2 * its_scatter,
               f"spheroids, φ = {phi}: Z differs by {difference:+.3%} ± {its_scatter:.3%}")
        rows.append([phi, f"{sampled:.4f}", f"{error:.4f}", f"{moved:.4f}", f"{its_error:.4f}", f"{difference:+.3%}",
                     f"{its_scatter:.3%}"])
    return rows


def speed(build):
    """Trials per second, and the time per batch of overlap tests, beside the plane."""
    found = json.loads(output_of([build / "bench/vitrel-bench", "sampler", "space"]))["space"]
    return [[name, row["particles"], f"{row['packing_fraction']:.2f}", f"{1e3 / row['ns_per_trial']:.2f}",
             f"{row['batches']:.1f}", f"{row['ns_per_trial'] / row['batches']:.0f} ns"] for name, row in found.items()]


def measure(build):
    found = [Found(build, *state) for state in STATES]
    for one in found:
        one.check()
    return f"""Hard spheres at the pressure P = ρZ of an equation of state must have its packing fraction: Kolafa, Labík and Malijevský,
Phys. Chem. Chem. Phys. 6, 2335 (2004), for the fluid, and Speedy, J. Phys.: Condens. Matter 10, 4387 (1998), for the
face-centred cubic crystal. In a crystal of N particles the centre of mass is free, so that Z is lower by (Z − 1)/N. All
runs begin on the crystal, N = {PARTICLES}, and the fluid melts in 2000 sweeps of event chains. The box keeps its shape.
{SEEDS} seeds; averages are over the second half of {", ".join(f"{sweeps} (φ = {phi})" for phi, sweeps in SWEEPS.items())} sweeps.
Required: a standard error of at most {LARGEST_ERROR:.2%} of φ, and a deviation of at most {ERRORS} standard errors.

{table(["", "φ", "Z", "φ, measured", "standard error", "deviation", "in standard errors"], [one.row() for one in found])}

Spheroids of aspect ratio 3, N = 343: Z by Monte Carlo with the contact function, and by motion from the virial of the
collisions. Required: a difference of at most {LARGEST_DIFFERENCE:.1%} and twice its standard error.

{table(["φ", "Z, Monte Carlo", "error", "Z, motion", "error", "difference", "standard error"], spheroids(build))}

Trials of local moves per second on one thread, in millions. A batch is the test of a trial against up to four others.

{table(["", "N", "φ", "millions per second", "batches per trial", "time per batch"], speed(build))}
"""
