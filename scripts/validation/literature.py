"""Values (`VALUES`: literature.toml) and formulas of the literature, each once, by the keys of docs/references.bib.

The table of fluids is that of bench/reference/literature.h, which the tests and the studies of vitrel-bench read, too.
"""

import dataclasses
import functools
import math
import re
import tomllib

from validation.common import HERE, ROOT

HEADER = ROOT / "bench/reference/literature.h"
VALUES = tomllib.loads((HERE / "literature.toml").read_text(encoding="utf-8"))


@dataclasses.dataclass(frozen=True)
class FluidPressure:
    """Z = βP/ρ of a fluid of equal hard ellipses."""

    aspect_ratio: float
    packing_fraction: float
    z: float
    error: float


@functools.cache
def fluid_pressures():
    """The entries of `fluid_pressures` in the header, which says where they are from."""
    found = re.search(r"FluidPressure fluid_pressures\[\] = \{(.+?)\};", HEADER.read_text(encoding="utf-8"), re.DOTALL)
    entries = re.findall(r"\{([^{}]+)\}", found[1])
    return tuple(FluidPressure(*map(float, entry.split(","))) for entry in entries)


# ---- hard spheres of diameter 2, mass 1 and kT 1 ----------------------------------------------------------

DIAMETER = 2
VOLUME = 4 * math.pi / 3


def number_density(phi):
    return phi / VOLUME


def carnahan_starling(phi):
    """Z of the fluid (carnahan1969)."""
    return (1 + phi + phi**2 - phi**3) / (1 - phi)**3


def contact_value(phi):
    """g(σ) by the same."""
    return (1 - phi / 2) / (1 - phi) ** 3


def sphere_fluid(phi):
    """Z of the fluid (kolafa2004)."""
    x = phi / (1 - phi)
    return 1 + sum(factor * x**power for factor, power in VALUES["sphere_fluid"])


def sphere_crystal(phi, particles):
    """Z of the face-centred cubic crystal (speedy1998). The centre of mass of a finite crystal moves freely: all but one
    particle contribute Z, and that one 1.
    """
    z = phi / (math.pi / math.sqrt(18))
    infinite = 3 / (1 - z) - 0.5921 * (z - 0.7072) / (z - 0.601)
    return infinite - (infinite - 1) / particles


def enskog_diffusion(phi):
    """hansen2013, with the factor for higher Sonine polynomials."""
    return 1.01896 * 3 / (8 * number_density(phi) * DIAMETER**2 * math.sqrt(math.pi) * contact_value(phi))


def enskog_viscosity(phi):
    """hansen2013."""
    dilute = 1.016 * 5 / (16 * DIAMETER**2 * math.sqrt(math.pi))
    g, co_volume = contact_value(phi), 4 * phi
    return dilute * (1 / g + 0.8 * co_volume + 0.761 * co_volume**2 * g)


def collision_frequency(phi):
    """Of one sphere, by Enskog (hansen2013)."""
    return 4 * contact_value(phi) * number_density(phi) * DIAMETER**2 * math.sqrt(math.pi)


def speedy_diffusion(phi):
    """A fit to simulations of about 500 spheres (speedy1987)."""
    n = number_density(phi) * DIAMETER**3
    dilute = 3 / 8 * DIAMETER / math.sqrt(math.pi)
    return dilute / n * (1 - n / 1.09) * (1 + n**2 * (0.4 - 0.83 * n**2))


def driven_cumulant(restitution):
    """a₂ of the velocities of driven smooth spheres (vannoije1998)."""
    d, e = 3, restitution
    return 16 * (1 - e) * (1 - 2 * e**2) / (73 + 56 * d - 24 * d * e - 105 * e + 30 * (1 - e) * e**2)


def driving_power(restitution, phi):
    """What a smooth sphere loses in collisions at temperature 1 (vannoije1998)."""
    return (1 - restitution**2) / 2 * collision_frequency(phi) * (1 + 3 / 16 * driven_cumulant(restitution))


# ---- hard ellipsoids --------------------------------------------------------------------------------------

def convex_measures(semi_axes):
    """Mean radius of curvature, surface and volume: means over all directions of a Gauss–Legendre rule."""
    import numpy  # only here: scripts without it import this module

    a, b, c = semi_axes
    z, weight = numpy.polynomial.legendre.leggauss(200)
    angle = (numpy.arange(400) + 0.5) * math.pi / 200
    height, around = numpy.meshgrid(z, angle, indexing="ij")
    ring = numpy.sqrt(1 - height**2)
    direction = numpy.stack([ring * numpy.cos(around), ring * numpy.sin(around), height], axis=-1)
    share = numpy.outer(weight, [1 / 800] * 400)  # all of them add to 1

    def mean_length(stretch):
        return float((share * numpy.linalg.norm(direction * stretch, axis=-1)).sum())

    return mean_length([a, b, c]), 4 * math.pi * mean_length([b * c, a * c, a * b]), VOLUME * a * b * c


def virial_coefficients(a, t):
    """B₂ … B₅ in powers of the volume (vega1997); a = t = 0: spheres."""
    return [sum(factor * a**i * t**j for factor, i, j in terms) for terms in VALUES["ellipsoid_virials"]]


def ellipsoid_fluid(semi_axes, phi):
    """Z of the isotropic fluid (vega1997, equation 20). Beyond B₅ it is that of Carnahan and Starling times B₂/4."""
    radius, surface, volume = convex_measures(semi_axes)
    a, t = radius * surface / (3 * volume) - 1, 4 * math.pi * radius**2 / surface - 1

    def series(coefficients):
        return 1 + sum(b * phi**k for k, b in enumerate(coefficients, 1))

    own, spheres = virial_coefficients(a, t), virial_coefficients(0, 0)
    return series(own) + own[0] / 4 * (carnahan_starling(phi) - series(spheres))
