"""Compressibility factor of hard disks, compared with the equation of state of Kolafa and Rottner."""

import math
import statistics

from validation.common import HERE, expect, fluid_pressures, run_and_check, table

TITLE = "Equation of state of hard disks"
PARTICLES = 2500
RUNS = 4  # independent seeds
REFERENCE = {phi: z for (kappa, phi), z in fluid_pressures().items() if kappa == 1}

# 3.5 standard errors of the mean over the runs; the error of each run comes from blocking. False-alarm rate: 0.05 %
# per density.
ERRORS = 3.5
LARGEST_RELATIVE_ERROR = 1e-3


def compressibility(build, packing_fraction):
    """The mean over the runs, its standard error from those of the runs, and the number of collisions."""
    means, errors, collisions = [], [], 0
    for seed in range(1, RUNS + 1):
        run, check = run_and_check(
            build, HERE / "disks.toml", f"system.particles={PARTICLES}",
            f"system.packing_fraction={packing_fraction}", f"system.seed={seed}", frames=["--last"])
        expect(check["overlaps"] == 0, f"φ = {packing_fraction}, seed {seed}: {check['overlaps']} overlaps")
        means.append(run["compressibility_factor"])
        errors.append(run["compressibility_factor_error"])
        collisions += run["collisions"]
    return statistics.mean(means), math.hypot(*errors) / RUNS, collisions


def row(build, packing_fraction, reference):
    mean, error, collisions = compressibility(build, packing_fraction)
    deviation = (mean - reference) / error
    expect(error <= LARGEST_RELATIVE_ERROR * mean, f"φ = {packing_fraction}: error {error} of {mean} is too large")
    expect(abs(deviation) <= ERRORS, f"φ = {packing_fraction}: Z = {mean} ± {error}, not {reference}")
    return [packing_fraction, reference, f"{mean:.5f}", f"{error:.5f}", f"{deviation:+.1f}", f"{collisions:.1e}"]


def measure(build):
    head = ["φ", "Z, reference", "Z", "standard error", "deviation in standard errors", "collisions"]
    return f"""The compressibility factor Z = βP/ρ from the collisional virial of {RUNS} Newtonian runs of {PARTICLES} disks each, compared
with the equation of state of Kolafa and Rottner, Mol. Phys. 104, 3435 (2006), for the infinite system. Required: a standard
error of at most {LARGEST_RELATIVE_ERROR:.1%} and a deviation of at most {ERRORS} standard errors (false-alarm rate: 0.05 % per row).

{table(head, [row(build, *case) for case in REFERENCE.items()])}
"""
