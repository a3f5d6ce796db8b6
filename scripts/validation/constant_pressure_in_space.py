"""Hard spheres at the pressure P = ρZ of an equation of state must have its packing fraction: Kolafa, Labík and
Malijevský, Phys. Chem. Chem. Phys. 6, 2335 (2004), for the fluid, and Speedy, J. Phys.: Condens. Matter 10, 4387
(1998), for the face-centred cubic crystal. In a crystal of N particles the centre of mass is free, so that Z is lower
by (Z − 1)/N. All runs begin on the crystal, N = {PARTICLES}, and the fluid melts in 2000 sweeps of event chains. The
box keeps its shape. Averages are over the second half of the sweeps. Required: a standard error, from the scatter of
the seeds, of at most {LARGEST_ERROR:.2%} of φ, and a deviation of at most 3 standard errors.

{table}
"""

import functools

from validation.comparison import SCENES, SEED, Comparison, Scenes, Tolerance
from validation.literature import VOLUME, sphere_crystal, sphere_fluid

TITLE = "Constant pressure: packing fractions of hard spheres"
INPUTS = ["mc", "core", "workflow/stages", "scripts/validation/literature.py"]

PARTICLES = 864
LARGEST_ERROR = 0.0005  # of φ
CRYSTAL = functools.partial(sphere_crystal, particles=PARTICLES)
STATES = {0.30: (sphere_fluid, 450_000, 16), 0.45: (sphere_fluid, 200_000, 28), 0.60: (CRYSTAL, 125_000, 16)}  # sweeps, seeds

PHI, SWEEPS = "system.packing_fraction", "prepare.stage.2.sweeps"


def rows():
    return tuple({PHI: phi, "prepare.stage.2.pressure": phi / VOLUME * equation(phi), SWEEPS: sweeps, SEED: seed}
                 for phi, (equation, sweeps, seeds) in STATES.items() for seed in range(1, seeds + 1))


COMPARISON = Comparison(
    Scenes(SCENES / "constant_pressure_in_space.toml", rows=rows()),
    quantity="prepare.stages.-1.mean_packing_fraction",
    reference=lambda scene: scene[PHI],
    tolerance=lambda scene: Tolerance(largest_error=LARGEST_ERROR),
    columns={"": lambda scene: "crystal" if STATES[scene[PHI]][0] is CRYSTAL else "fluid",
             "Z": lambda scene: f"{STATES[scene[PHI]][0](scene[PHI]):.5f}", "sweeps": lambda scene: scene[SWEEPS],
             "seeds": lambda scene: len(scene.jobs)})
measure = COMPARISON.tables
