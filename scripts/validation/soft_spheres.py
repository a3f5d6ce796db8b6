"""Soft spheres: how often a third particle interferes."""

import functools
import math

from validation.common import article_sweep, expect, table

TITLE = "Exceptions of soft spheres"

USUAL_MODULUS, DILUTE = 1e9, 1e-3
MAX_EXCEPTIONS = 2e-3  # at the usual modulus, dilute
DILUTE_LIMIT = 0.01  # the largest packing fraction at which exceptions are compared with theory
VANISHED = 2e-4  # at the lowest packing fraction and for the hardest particles
MAX_SIGMAS = 4
EXCEPTIONS = {"early_releases": "early releases", "blocked_rotations": "blocked rotations"}


@functools.cache
def refused_after_hit(samples=1_000_000):
    """A particle moves with its partner, is hit by a third one at k, and is released. Returns the probability that the
    two then approach and that the rotation of their line of centres brings the particle closer to its former partner,
    at n. The average is over the velocities of a gas with kT = m = 1 and over all k not shadowed by the partner,
    weighted with the flux."""
    import numpy

    draw = numpy.random.default_rng(1)
    n = numpy.array([1.0, 0, 0])
    k = draw.normal(size=(samples, 3))
    k /= numpy.linalg.norm(k, axis=1, keepdims=True)
    k = k[k @ n < 0.5]
    third = math.sqrt(3 / 2) * draw.normal(size=k.shape)  # relative to the centre of mass of the pair
    apart = math.sqrt(2) * draw.normal(size=k.shape)  # velocity of the partner after contact, relative to the particle
    apart[:, 0] = math.sqrt(2) * draw.rayleigh(size=len(k))
    flux = numpy.maximum(0, -(third * k).sum(axis=1))
    relative = third + apart / 2
    along = (relative * k).sum(axis=1, keepdims=True)
    refused = (along[:, 0] < 0) & ((relative - along * k) @ n < 0)
    return float((flux * refused).sum() / flux.sum())


def expected_exceptions(packing_fraction, modulus):
    """Per collision, from the kinetic theory of a dilute gas of nearly hard particles."""
    radius, density, poisson, speed = 0.1, 1140, 0.4, 2
    mass = density * 4 * math.pi / 3 * radius**3
    stiffness = 2 * modulus * math.sqrt(radius / 2) / (3 * (1 - poisson**2)) / (mass / 2)
    contact = 3.2180654597 * stiffness**-0.4 * (math.sqrt(2) * speed) ** -0.2 * math.gamma(0.9)
    number_density = packing_fraction / (4 * math.pi / 3 * radius**3)
    free = 1 / (number_density * math.pi * (2 * radius) ** 2 * 4 * speed / math.sqrt(2 * math.pi))
    hit, in_the_way = 3 * math.sqrt(3) / 4, math.pi / 6 + math.sqrt(3) / 16
    return {"early_releases": hit * contact / free,
            "blocked_rotations": (in_the_way + refused_after_hit() * hit) * contact / free}


def measured_exceptions(build):
    """Per collision, against both quantities of the figure; they share the row of the usual modulus in the dilute gas."""
    rows = {}
    for quantity in ("density", "modulus"):
        for average in article_sweep(build, f"mueller_figure_7_{quantity}", parallel=2)["seeds"]:
            values, figures = average["values"], average["figures"]
            packing_fraction = values.get("system.packing_fraction", DILUTE)
            modulus = 1e9 * float(values.get("dynamics.contact.youngs_modulus", "1 GPa").removesuffix("GPa"))
            rows[packing_fraction, modulus] = {
                "packing_fraction": packing_fraction, "modulus": modulus, "seeds": average["seeds"],
                "particles": round(figures["particles"]["mean"]),
                "collisions": round(average["seeds"] * figures["collisions"]["mean"]),
                **{name: figures[f"{name}_per_collision"] for name in EXCEPTIONS}}
    return list(rows.values())


def exceptions_of(rows, key, fixed, value):
    return sorted((row for row in rows if row[fixed] == value), key=lambda row: row[key])


def check_exceptions(rows):
    for row in rows:
        where = f"η = {row['packing_fraction']:g}, Y = {row['modulus']:g} Pa"
        expected = expected_exceptions(row["packing_fraction"], row["modulus"])
        for name in EXCEPTIONS:
            found = row[name]["mean"]
            if row["packing_fraction"] <= DILUTE and row["modulus"] >= USUAL_MODULUS:
                expect(found <= MAX_EXCEPTIONS, f"{where}: {name} is {found}")
            if row["packing_fraction"] <= DILUTE_LIMIT:
                error = math.sqrt(expected[name] / row["collisions"])
                expect(abs(found - expected[name]) <= MAX_SIGMAS * error + 0.1 * expected[name],
                       f"{where}: {name} is {found}, expected {expected[name]}")
    for key, fixed, value, last in (("packing_fraction", "modulus", USUAL_MODULUS, 0),
                                    ("modulus", "packing_fraction", DILUTE, -1)):
        for name in EXCEPTIONS:
            found = exceptions_of(rows, key, fixed, value)[last][name]["mean"]
            expect(found <= VANISHED, f"at the end of {key}, {name} is {found}")


def per_thousand(of):
    return f"{1e3 * of['mean']:.3f} ± {1e3 * of['error']:.3f}"


def exception_rows(rows):
    for row in sorted(rows, key=lambda row: (row["packing_fraction"], row["modulus"])):
        expected = expected_exceptions(row["packing_fraction"], row["modulus"])
        yield [f"{row['packing_fraction']:g}", f"{row['modulus'] / 1e9:g}", row["collisions"],
               *(cell for name in EXCEPTIONS for cell in (per_thousand(row[name]), f"{1e3 * expected[name]:.3f}"))]


def measure(build):
    exceptions = measured_exceptions(build)
    check_exceptions(exceptions)
    usual, = (row for row in exceptions if row["modulus"] == USUAL_MODULUS and row["packing_fraction"] == DILUTE)
    head = ["η", "Y (GPa)", "collisions", "early releases, ‰", "theory", "blocked rotations, ‰", "theory"]
    return f"""`vitrel sweep` runs `params/articles/mueller_figure_7_density.toml` and `mueller_figure_7_modulus.toml`: {usual['particles']} elastic spheres
from a simple cubic crystal; means and standard errors over {usual['seeds']} seeds. An *early release* is a contact in which a third
particle hits one of the pair. A *blocked rotation* is a contact whose rotation a neighbour blocks. Theory is the kinetic theory of
a dilute gas of nearly hard spheres, with the mean contact duration τ and the mean free time τ_f. A third particle hits one of the
pair in a fraction (3√3/4) τ/τ_f of the collisions; it blocks the rotation in a fraction (π/6 + √3/16) τ/τ_f. In addition, after an
early release the former partner can block the rotation of the released particle with the third one. Random sampling of such
encounters gives a fraction of {refused_after_hit():.3f} of the early releases. Both vanish in the dilute limit and in the hard limit.

{table(head, list(exception_rows(exceptions)))}
"""
