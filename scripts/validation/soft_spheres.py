"""`vitrel sweep` runs `params/articles/mueller_figure_7_density.toml` and `mueller_figure_7_modulus.toml`: elastic
spheres from a simple cubic crystal. An *early release* is a contact in which a third particle hits one of the pair. A
*blocked rotation* is a contact whose rotation a neighbour blocks. Both are given per 1000 collisions.

Theory is the kinetic theory of a dilute gas of nearly hard spheres, with the mean contact duration τ and the mean free
time τ_f. A third particle hits one of the pair in a fraction (3√3/4) τ/τ_f of the collisions; it blocks the rotation in
a fraction (π/6 + √3/16) τ/τ_f. In addition, after an early release the former partner can block the rotation of the
released particle with the third one. Random sampling of such encounters gives a fraction of {REFUSED} of the early
releases. Both vanish in the dilute limit and in the hard limit.

Required: a deviation from theory of at most {SIGMAS} standard errors, of so many random events, and a tenth, up to η =
{THIN}; at most {USUAL:g} of the collisions at η = 0.001 and Y = 1 GPa, and {VANISHED:g} at η = 0.0003 and at Y = 100
GPa.

{table}
"""

import math

from validation.common import PARAMS, Estimate, expect, table
from validation.comparison import Scenes, Tolerance, compared

TITLE = "Exceptions of soft spheres"
INPUTS = ["edmd", "core", "params/articles/mueller_figure_7_density.toml", "params/articles/mueller_figure_7_modulus.toml"]

THIN, SIGMAS = 0.01, 4
USUAL, VANISHED = 2e-3, 2e-4
# Largest shares of the collisions by packing fraction and modulus in GPa.
LARGEST = {(0.001, 1): USUAL, (0.0003, 1): VANISHED, (0.001, 100): VANISHED}
# A particle moves with its partner, is hit by a third one at k, and is released: the probability that the two then approach
# and that the rotation of their line of centres brings the particle closer to its former partner. From 8 000 000 samples of
# the velocities of a gas and of k, not shadowed by the partner and weighted with the flux; standard error 0.0002.
REFUSED = 0.2755
RELEASES, ROTATIONS = "early_releases_per_collision", "blocked_rotations_per_collision"


def expected_exceptions(packing_fraction, modulus):
    """Per collision, from the kinetic theory of a dilute gas of nearly hard particles; the modulus in GPa."""
    radius, density, poisson, speed = 0.1, 1140, 0.4, 2
    mass = density * 4 * math.pi / 3 * radius**3
    stiffness = 2 * modulus * 1e9 * math.sqrt(radius / 2) / (3 * (1 - poisson**2)) / (mass / 2)
    contact = 3.2180654597 * stiffness**-0.4 * (math.sqrt(2) * speed) ** -0.2 * math.gamma(0.9)
    number_density = packing_fraction / (4 * math.pi / 3 * radius**3)
    free = 1 / (number_density * math.pi * (2 * radius) ** 2 * 4 * speed / math.sqrt(2 * math.pi))
    share = contact / free
    hit, in_the_way = 3 * math.sqrt(3) / 4, math.pi / 6 + math.sqrt(3) / 16
    return {
        RELEASES: hit * share,
        ROTATIONS: (in_the_way + REFUSED * hit) * share,
    }


def gases(build):
    """By packing fraction and modulus in GPa; the two figures share one of them."""
    found = {}
    for quantity in ("density", "modulus"):
        for scene in Scenes(PARAMS / "articles" / f"mueller_figure_7_{quantity}.toml").run(build):
            modulus = scene.values.get("dynamics.contact.youngs_modulus", "1 GPa").removesuffix("GPa")
            found[scene.values.get("system.packing_fraction", 0.001), float(modulus)] = scene
    return sorted(found.items())


def cells(gas, scene, name):
    """Theory and measurement, per 1000 collisions."""
    collisions = sum(scene.every("run.collisions"))
    expected = expected_exceptions(*gas)[name]
    error = math.sqrt(expected / collisions)
    found = Estimate(scene.mean(f"run.{name}").mean, error)
    if gas[0] <= THIN:
        compared(f"η, Y = {gas}: {name}", found, expected, Tolerance(SIGMAS, relative=0.1))
    expect(found.mean <= LARGEST.get(gas, 1), f"η, Y = {gas}: {name} is {found}")
    return [f"{1e3 * expected:.3f}", Estimate(1e3 * found.mean, 1e3 * error)]


def measure(build):
    rows = []
    for gas, scene in gases(build):
        collisions = sum(scene.every("run.collisions"))
        rows.append([*gas, collisions, *cells(gas, scene, RELEASES), *cells(gas, scene, ROTATIONS)])
    head = ["η", "Y (GPa)", "collisions", "early releases, theory", "measured", "blocked rotations, theory", "measured"]
    return {"table": table(head, rows)}
