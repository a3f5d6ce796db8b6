"""Driven smooth spheres: N = {PARTICLES}, φ = {PHI}, kicks every {KICKS} mean free times, with the power that makes the
temperature 1 by van Noije and Ernst (Granular Matter 1, 57 (1998)) with Enskog's collision frequency. Required: T
within {LARGEST_TEMPERATURE:.0%} of it, and the fourth cumulant a₂ of the velocities within {LARGEST_CUMULANT} of
theirs. Errors are standard errors, from {FRAMES} frames that are {APART} mean free times apart.

{table}

Cooling rough spheres: `tests/physics/rough_gas_test.cpp` compares the ratio of their rotational to their translational
temperature with the Boltzmann equation, solved by direct simulation Monte Carlo, and with the closed form of Huthmann
and Zippelius (Phys. Rev. E 56, R6275 (1997)), which takes both velocities as Gaussian. They are not, and the closed
form is too large: the measured ratios are 0.966, 0.939 and 0.978 of it at β = −0.5, 0 and 0.5, and within 3 % of the
Boltzmann equation (e = 0.9, no slip, φ = 0.01, commit 37c9582).
"""

from validation.common import PARAMS, estimate, table
from validation.comparison import Compared, Scenes, Tolerance, compared
from validation.literature import collision_frequency, driven_cumulant, driving_power

TITLE = "Granular gases"
INPUTS = ["edmd", "core", "analysis/observables", "params/driven_gas.toml"]

RESTITUTION = "dynamics.restitution"
PARTICLES, PHI = 4000, 0.02
KICKS, RELAXATION, APART, FRAMES = 0.01, 60, 4, 150  # the first three in mean free times
LARGEST_TEMPERATURE, LARGEST_CUMULANT = 0.02, 0.003
FREE_TIME = 1 / collision_frequency(PHI)

SCENES = Scenes(
    PARAMS / "driven_gas.toml",
    settings=(f"system.particles={PARTICLES}", f"system.packing_fraction={PHI}",
              f"prepare.stage.0.packing_fraction={PHI}", f"dynamics.driving.interval={KICKS * FREE_TIME}",
              f"dynamics.equilibration={RELAXATION * FREE_TIME}", f"dynamics.duration={APART * FRAMES * FREE_TIME}",
              f"output.samples.interval={APART * FREE_TIME}", f"analysis.structure.frames={FRAMES}", 'analysis.only="velocities"'),
    rows=tuple({RESTITUTION: e, "dynamics.driving.power": driving_power(e, PHI)} for e in (0.8, 0.5)),
    seeds=(1,), tables=("velocities",))


def row(scene):
    frames, = scene.every("tables.velocities")
    e = scene[RESTITUTION]
    temperature = compared(f"e = {e}: T", estimate(frames["temperature"]), 1, Tolerance(0, LARGEST_TEMPERATURE))
    cumulant = compared(f"e = {e}: a₂", estimate(frames["a_2"]), driven_cumulant(e), Tolerance(0, absolute=LARGEST_CUMULANT))
    return [e, temperature.measured, *cumulant.cells()]


def measure(build):
    head = ["e", "T", "a₂, van Noije & Ernst", "a₂, measured", *Compared.HEAD[2:]]
    return {"table": table(head, map(row, SCENES.run(build)))}
