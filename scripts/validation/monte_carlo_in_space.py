"""Ellipsoids, N = 343: Z by Monte Carlo, from the contacts of event chains and, in the states that these visit, from
the contact function; and by motion, from the virial of the collisions, with free rotation by Euler's equations. Scalene
ellipsoids also rotate at constant angular velocity, which must not matter. The runs are those of
`tests/physics/monte_carlo_in_space_test.cpp`, 40 to 60 times as long, in 20 blocks. Required: of spheroids, a
difference between chains and motion of at most {LARGEST_DIFFERENCE:.1%}; of scalene ellipsoids, standard errors of at
most {LARGEST_ERROR:.1%} and differences of at most 3 standard errors. The equation of state of Vega, Mol. Phys. 92, 651
(1997), is a fit; motion must agree with it within {EQUATION_OF_STATE:.0%}.

{solids}

Isotropic and nematic states of spheroids of aspect ratio 5, N = 500, {ORDER_SEEDS} seeds of each start: inserted at
random orientations at φ = 0.1 and swollen, or on a stretched face-centred cubic lattice, all aligned. S is the largest
eigenvalue of ⟨3 u uᵀ − 1⟩/2 after the last sweep. Required: both starts agree within 3 standard errors, on S < 0.2 at φ
= 0.3 and S > 0.5 at φ = 0.42.

{order}
"""

import concurrent.futures
import os

from validation.common import Estimate, estimate, expect, properties_of_test, table
from validation.comparison import SCENES, Compared, Scenes, Tolerance, compared
from validation.literature import ellipsoid_fluid

TITLE = "Monte Carlo in space: ellipsoids"
INPUTS = ["mc", "edmd", "core", "tests/physics/monte_carlo_in_space_test.cpp", "scripts/validation/literature.py"]

LARGEST_DIFFERENCE, LARGEST_ERROR, EQUATION_OF_STATE = 0.001, 0.001, 0.02  # of Z
TEST = "Fluids/SolidsByMonteCarlo.HaveThePressureOfMotion"
# Semi-axes, packing fraction and effort of the instances of that test.
SOLIDS = (((3, 1, 1), 0.30, 40), ((3, 1, 1), 0.45, 60), ((1.25, 1, 0.8), 0.30, 40), ((1.25, 1, 0.8), 0.45, 40))
# What is compared with motion. The test itself compares the contact function.
METHODS = {
    "monte_carlo": "chains",
    "contact_function": "contact function",
    "constant_rotation": "motion, constant ω",
}

PHI, START, SWEEPS = "system.packing_fraction", "prepare.stage.0", "prepare.stage.2.sweeps"
ORDER_SEEDS = 4
STARTS = ({"method": "insert", "packing_fraction": 0.1}, {"method": "lattice", "arrangement": "face_centred_cubic"})
ORDER = {0.30: (40_000, 0, 0.2), 0.42: (250_000, 0.5, 1)}  # sweeps, and bounds of S
SPHEROIDS = Scenes(
    SCENES / "spheroids.toml",
    rows=tuple({PHI: phi, SWEEPS: bounds[0], START: start} for phi, bounds in ORDER.items() for start in STARTS),
    seeds=range(1, ORDER_SEEDS + 1))


def pressures(build, number, effort):
    """Z by every method."""
    found = properties_of_test(build / "tests/physics/test_physics", f"{TEST}/{number}", VITREL_SOLIDS_EFFORT=effort)
    return {method: Estimate(float(found[method]), float(found[f"{method}_error"]))
            for method in ("motion", *METHODS) if method in found}


def tolerance(semi_axes, method):
    if method == "contact_function":
        return Tolerance(3.5)
    if len(set(semi_axes)) == 3:
        return Tolerance(largest_error=LARGEST_ERROR)
    return Tolerance(0, LARGEST_DIFFERENCE)


def solid_rows(semi_axes, phi, found):
    name, motion = " : ".join(map(str, semi_axes)), found["motion"]
    for method, words in METHODS.items():
        if method in found:
            one = compared(f"{name}, φ = {phi}, {method}", found[method], motion, tolerance(semi_axes, method))
            yield [name, phi, f"{words}, against motion", *one.cells()]
    expected = ellipsoid_fluid(semi_axes, phi)
    fit = compared(f"{name}, φ = {phi}", motion, expected, Tolerance(0, EQUATION_OF_STATE))
    yield [name, phi, "motion, against Vega (1997)", *fit.cells()]


def nematic_orders(scene):
    """S, the largest eigenvalue of ⟨3 u uᵀ − 1⟩/2, of each seed."""
    from numpy import linalg  # only here: a test imports all validations

    return [1.5 * linalg.eigvalsh(tensor)[-1] - 0.5 for tensor in scene.every("prepare.orientation_tensor")]


def order_row(random, aligned):
    phi = random[PHI]
    sweeps, least, most = ORDER[phi]
    starts = [estimate(nematic_orders(scene)) for scene in (random, aligned)]
    for order in starts:
        expect(least <= order.mean <= most, f"κ = 5, φ = {phi}: S = {order}")
    return [phi, sweeps, *compared(f"κ = 5, φ = {phi}: S of both starts", *starts).cells()]


def measure(build):
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = [pool.submit(pressures, build, number, effort) for number, (*_, effort) in enumerate(SOLIDS)]
    rows = []
    for (semi_axes, phi, _), of in zip(SOLIDS, found):
        rows += solid_rows(semi_axes, phi, of.result())
    scenes = SPHEROIDS.run(build)
    order = map(order_row, scenes[::2], scenes[1::2])
    return {
        "solids": table(["semi-axes", "φ", "Z by", *Compared.HEAD], rows),
        "order": table(["φ", "sweeps", "S, aligned start", "S, random start", *Compared.HEAD[2:]], order),
    }
