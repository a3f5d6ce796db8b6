"""Monte Carlo in space: the pressure and the order of ellipsoids, and the speed of trials."""

import concurrent.futures
import math
import os
import pathlib
import tempfile

from validation.common import (apart, carnahan_starling, estimate, expect, properties_of_test, summary_of, table,
                               text_of)

TITLE = "Monte Carlo in space: ellipsoids"

VOLUME = 4 * math.pi / 3  # of a sphere of size 1
ERRORS = 3
SOLIDS = "Fluids/SolidsByMonteCarlo.HaveThePressureOfMotion"
METHODS = ("monte_carlo", "contact_function", "motion", "constant_rotation")
# Semi-axes, packing fraction and effort of the instances of that test.
SPHEROIDS = (((3, 1, 1), 0.30, 40), ((3, 1, 1), 0.45, 60))
SCALENE = (((1.25, 1, 0.8), 0.30, 40), ((1.25, 1, 0.8), 0.45, 40))
LARGEST_DIFFERENCE = 0.001  # of Z, spheroids
LARGEST_SOLID_ERROR = 0.001  # of Z, scalene ellipsoids
EQUATION_OF_STATE = 0.02  # of Z: the largest difference from the fitted equation of state
# Spheroids of aspect ratio 5 from a random and an aligned start: packing fraction, sweeps, and bounds of S in both.
ORDER = ((0.30, 40_000, 0, 0.2), (0.42, 250_000, 0.5, 1))
ORDER_SEEDS = 4
STARTS = {"random": """
[[prepare.stage]]
method = "insert"
packing_fraction = 0.1

[[prepare.stage]]
method = "swell"
""", "aligned": """
[[prepare.stage]]
method = "lattice"
arrangement = "face_centred_cubic"
"""}


def convex_measures(semi_axes):
    """Mean radius of curvature, surface and volume of an ellipsoid: means over all directions of a Gauss–Legendre rule."""
    from numpy import arange, cos, meshgrid, outer, pi, polynomial, sin, sqrt, stack  # only here, see nematic_order

    a, b, c = semi_axes
    z, weight = polynomial.legendre.leggauss(200)
    angle = (arange(400) + 0.5) * pi / 200
    height, around = meshgrid(z, angle, indexing="ij")
    ring = sqrt(1 - height**2)
    direction = stack([ring * cos(around), ring * sin(around), height], axis=-1)
    share = outer(weight, [1 / 800] * 400)  # all of them add to 1

    def mean_length(stretch):
        return float((share * sqrt(((direction * stretch)**2).sum(axis=-1))).sum())

    return mean_length([a, b, c]), 4 * math.pi * mean_length([b * c, a * c, a * b]), VOLUME * a * b * c


def virial_coefficients(a, t):
    """B₂ … B₅ of hard ellipsoids in powers of their volume, the last three fitted by Vega (1997); a = t = 0: spheres."""
    return (
        4 + 3 * a,
        10 + 13.094756 * a - 2.073909 * t + 4.096689 * a**2 + 2.325342 * t**2 - 5.791266 * a * t,
        18.3648 + 27.714434 * a - 10.2046 * t + 11.142963 * a**2 + 8.634491 * t**2 - 28.279451 * a * t
        - 17.190946 * a**2 * t + 24.188979 * a * t**2 + 0.74674 * a**3 - 9.455150 * t**3,
        28.2245 + 21.288105 * a + 4.525788 * t + 36.032793 * a**2 + 59.0098 * t**2 - 118.407497 * a * t
        + 24.164622 * a**2 * t + 139.766174 * a * t**2 - 50.490244 * a**3 - 120.995139 * t**3
        + 12.624655 * a**3 * t,
    )


def isotropic_fluid(semi_axes, phi):
    """Z of hard ellipsoids: Vega (1997), equation 20. Beyond B₅ it is that of Carnahan and Starling times B₂/4."""
    radius, surface, volume = convex_measures(semi_axes)
    a, t = radius * surface / (3 * volume) - 1, 4 * math.pi * radius**2 / surface - 1

    def series(coefficients):
        return 1 + sum(b * phi**k for k, b in enumerate(coefficients, 1))

    own, spheres = virial_coefficients(a, t), virial_coefficients(0, 0)
    return series(own) + own[0] / 4 * (carnahan_starling(phi) - series(spheres))


def pressures(build, number, effort):
    """Z by every method, with its standard error."""
    found = properties_of_test(build / "tests/physics/test_physics", f"{SOLIDS}/{number}", VITREL_SOLIDS_EFFORT=effort)
    return {method: (float(found[method]), float(found[f"{method}_error"]))
            for method in METHODS if method in found}


def relative_difference(one, two):
    """(one − two)/two of two estimates, and its standard error."""
    return one[0] / two[0] - 1, math.hypot(one[1], two[1]) / two[0]


def name_of(semi_axes):
    return " : ".join(map(str, semi_axes))


def expect_equation_of_state(semi_axes, phi, z):
    """The expected Z, and by how much it differs from this one."""
    expected = isotropic_fluid(semi_axes, phi)
    difference = expected / z - 1
    expect(abs(difference) <= EQUATION_OF_STATE,
           f"{name_of(semi_axes)}, φ = {phi}: the equation of state differs by {difference:+.2%}")
    return f"{expected:.4f} ({difference:+.2%})"


def spheroid_row(semi_axes, phi, found):
    shape_name = name_of(semi_axes)
    difference, error = relative_difference(found["monte_carlo"], found["motion"])
    expect(abs(difference) <= LARGEST_DIFFERENCE, f"{shape_name}, φ = {phi}: Z differs by {difference:+.3%} ± {error:.3%}")
    return [shape_name, phi, *(text_of(*z, 4) for z in found.values()), f"{difference:+.3%} ± {error:.3%}",
            expect_equation_of_state(semi_axes, phi, found["motion"][0])]


def scalene_row(semi_axes, phi, found):
    shape_name = name_of(semi_axes)
    compared = ("monte_carlo", "motion", "constant_rotation")
    for method in compared:
        z, error = found[method]
        expect(error <= LARGEST_SOLID_ERROR * z, f"{shape_name}, φ = {phi}, {method}: an error of {error / z:.3%}")
    differences = [relative_difference(found[method], found["motion"]) for method in compared if method != "motion"]
    for difference, error in differences:
        expect(abs(difference) <= ERRORS * error, f"{shape_name}, φ = {phi}: Z differs by {difference:+.3%} ± {error:.3%}")
    return [shape_name, phi, *(text_of(*z, 4) for z in found.values()),
            *(f"{difference:+.3%} ± {error:.3%}" for difference, error in differences),
            expect_equation_of_state(semi_axes, phi, found["motion"][0])]


def nematic_order(build, phi, sweeps, start, seed):
    """S, the largest eigenvalue of ⟨3 u uᵀ − 1⟩/2, after so many sweeps."""
    from numpy import linalg  # only here: a test imports all validations

    text = f"""[system]
dimension = 3
particles = 500
packing_fraction = {phi}
seed = {seed}

[[species]]
aspect_ratio = 5

[prepare]
quality_sweeps = 0
{STARTS[start]}
[[prepare.stage]]
method = "sample"
moves = "local"
sweeps = {sweeps}
"""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "nematic.toml")
        file.write_text(text, encoding="utf-8")
        tensor = summary_of(build, "prepare", file, "-o", pathlib.Path(folder, "state.h5"))["orientation_tensor"]
    return 1.5 * linalg.eigvalsh(tensor)[-1] - 0.5


def order_row(phi, sweeps, least, most, orders):
    """`orders` has the estimate of S from each start."""
    difference = apart(*orders.values())
    expect(difference <= ERRORS, f"κ = 5, φ = {phi}: the starts differ by {difference:.1f} standard errors")
    for start, (mean, _) in orders.items():
        expect(least <= mean <= most, f"κ = 5, φ = {phi}: S = {mean:.3f} from the {start} start")
    return [phi, sweeps, *(text_of(*order) for order in orders.values()), f"{difference:.1f}"]


def measure(build):
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        solids = [pool.submit(pressures, build, number, effort)
                  for number, (_, _, effort) in enumerate((*SPHEROIDS, *SCALENE))]
        orders = [{start: [pool.submit(nematic_order, build, phi, sweeps, start, seed)
                           for seed in range(1, ORDER_SEEDS + 1)] for start in STARTS} for phi, sweeps, _, _ in ORDER]
    spheroids = [spheroid_row(name, phi, found.result()) for (name, phi, _), found in zip(SPHEROIDS, solids)]
    scalene = [scalene_row(name, phi, found.result()) for (name, phi, _), found in zip(SCALENE, solids[len(SPHEROIDS):])]
    order = [order_row(*state, {start: estimate([one.result() for one in found]) for start, found in of_starts.items()})
             for state, of_starts in zip(ORDER, orders)]
    return f"""Ellipsoids, N = 343: Z by Monte Carlo from the contacts of event chains and, in the states that these visit, from the contact
function; and by motion from the virial of the collisions. 20 blocks each. Beside them is the equation of state of Vega, Mol.
Phys. 92, 651 (1997), with its difference from the motion. That equation is a fit; its difference must be at most {EQUATION_OF_STATE:.0%}.
Spheroids; required: a difference between chains and motion of at most {LARGEST_DIFFERENCE:.1%}.

{table(["semi-axes", "φ", "Z, chains", "Z, contact function", "Z, motion", "chains − motion", "Vega (1997)"], spheroids)}

Scalene ellipsoids, whose free rotation obeys Euler's equations or is at constant angular velocity. Required: standard
errors of at most {LARGEST_SOLID_ERROR:.1%} and differences of at most {ERRORS} standard errors.

{table(["semi-axes", "φ", "Z, chains", "Z, contact function", "Z, Euler's equations", "Z, constant ω",
        "chains − Euler's equations", "constant ω − Euler's equations", "Vega (1997)"], scalene)}

Isotropic and nematic states of spheroids of aspect ratio 5, N = 500, {ORDER_SEEDS} seeds of each start: inserted at random
orientations at φ = 0.1 and swollen, or on a stretched face-centred cubic lattice, all aligned. S is the largest eigenvalue of
⟨3 u uᵀ − 1⟩/2 after the last sweep. Required: both starts agree within {ERRORS} standard errors, on S < {ORDER[0][3]} at φ = {ORDER[0][0]}
and S > {ORDER[1][2]} at φ = {ORDER[1][0]}.

{table(["φ", "sweeps", *(f"S, {start} start" for start in STARTS), "difference in standard errors"], order)}
"""
