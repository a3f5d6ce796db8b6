"""Monte Carlo in space: constant pressure of spheres."""

import concurrent.futures
import math
import os
import pathlib
import tempfile

from validation.common import estimate, expect, summary_of, table

TITLE = "Constant pressure: packing fractions of hard spheres"

VOLUME = 4 * math.pi / 3  # of a sphere of size 1
PARTICLES = 864  # 6³ cells of a face-centred cubic crystal
FEWEST_SEEDS, MOST_SEEDS = 16, 96
SEEDS_AT_ONCE = 4
LARGEST_ERROR = 0.0005  # of φ
ERRORS = 3
# Sweeps per seed, by packing fraction; averages are over the second half.
SWEEPS = {0.30: 450_000, 0.45: 200_000, 0.60: 125_000}


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


def packing_fraction(build, phi, compressibility, seed):
    """The mean packing fraction at the pressure of this Z."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "pressure.toml")
        file.write_text(parameters(phi, compressibility, SWEEPS[phi]), encoding="utf-8")
        summary = summary_of(build, "prepare", file, "-o", pathlib.Path(folder, "state.h5"), "--set", f"system.seed={seed}")
    return summary["stages"][-1]["mean_packing_fraction"]


def independent_fractions(build, phi, compressibility, pool):
    """Packing fractions of as many seeds as the standard error needs."""
    fractions = []
    while len(fractions) < FEWEST_SEEDS or (estimate(fractions)[1] > LARGEST_ERROR * phi and len(fractions) < MOST_SEEDS):
        seeds = range(len(fractions) + 1, len(fractions) + SEEDS_AT_ONCE + 1)
        fractions += pool.map(lambda seed: packing_fraction(build, phi, compressibility, seed), seeds)
    return fractions


def constant_pressure_row(phase, phi, compressibility, means):
    mean, error = (value / phi for value in estimate(means))
    deviation = mean - 1
    name = f"{phase}, φ = {phi}"
    expect(error <= LARGEST_ERROR, f"{name}: an error of {error:.3%}")
    expect(abs(deviation) <= ERRORS * error, f"{name}: φ is off by {deviation:+.3%} ± {error:.3%}")
    return [phase, phi, f"{compressibility:.5f}", len(means), f"{mean * phi:.6f}", f"{error:.3%}", f"{deviation:+.3%}",
            f"{deviation / error:+.1f}"]


def measure(build):
    states = [(phase, phi, equation(phi)) for phase, phi, equation in STATES]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        rows = [constant_pressure_row(phase, phi, z, independent_fractions(build, phi, z, pool)) for phase, phi, z in states]
    return f"""Hard spheres at the pressure P = ρZ of an equation of state must have its packing fraction: Kolafa, Labík and Malijevský,
Phys. Chem. Chem. Phys. 6, 2335 (2004), for the fluid, and Speedy, J. Phys.: Condens. Matter 10, 4387 (1998), for the
face-centred cubic crystal. In a crystal of N particles the centre of mass is free, so that Z is lower by (Z − 1)/N. All
runs begin on the crystal, N = {PARTICLES}, and the fluid melts in 2000 sweeps of event chains. The box keeps its shape.
Seeds are added until the standard error is small enough; averages are over the second half of {", ".join(f"{sweeps} (φ = {phi})" for phi, sweeps in SWEEPS.items())} sweeps.
Required: a standard error of at most {LARGEST_ERROR:.2%} of φ, and a deviation of at most {ERRORS} standard errors.

{table(["", "φ", "Z", "seeds", "φ, measured", "standard error", "deviation", "in standard errors"], rows)}
"""
