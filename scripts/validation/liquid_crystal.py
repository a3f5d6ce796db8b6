"""Monodisperse ellipses in a square box. The nematic order parameter is S = |⟨exp 2iθ⟩|. Particles are inserted at φ =
0.4, either at random angles (random start) or all at the angle 0 (aligned start, S = 1). They are swollen to φ and then
sampled by sweeps of local moves.

### Isotropic states

There are independent seeds for each start: 24 (N = 500) and 12 (N = 2000). Each is sampled for many orientational
relaxation times of single particles (C₂ < 1/e, the longest of 6 seeds at N = 1000, commit ebbc22c): 1500 sweeps (κ = 2;
relaxation time: 77) and 6000 sweeps (κ = 6; relaxation time: 356).

In a liquid N⟨S²⟩ is the sum of ⟨cos 2(θ_i − θ_j)⟩ over all j, i included, and does not depend on N. The column *near*
is the sum over particles j up to the distance at which g₂(r) first falls to 0; *far* is the contribution of all others.
*Expected* is S = √(π near/4N), the value for many independent groups. Required, within 3 standard errors: both starts
give the same S; *far* is zero; S ∝ N^(−1/2), distinct from the exponent of a nematic, −1/16 or above. Also required: g₂
stays below 1/e beyond a length shorter than half the box. The exponent of N is {powers}.

{isotropic}

Near the transition the alignment of the liquid relaxes more slowly than the orientation of a single particle: at κ = 6
and φ = 0.4, S of an aligned start falls from 0.48 after 500 sweeps to 0.31, 0.14, 0.06 after 1000, 2000 and 4000 (N =
1000).

### Nematic states

κ = 6, φ = 0.70. In two dimensions nematic order is only quasi-long-ranged: g₂(r) ∝ r^(−η). At η = 1/4 disclination
pairs unbind and the nematic melts, so η ≤ 1/4. S decreases as N^(−η/4), with an exponent of −1/16 or above. If the
power law begins at the nearest-neighbour distance, S is at least about N^(−1/16) (*minimum S*). Required: S of every
seed exceeds this value after any number of sweeps; the exponent of N is not below −1/16 by more than 3 standard errors;
g₂ stays above 1/e throughout the box. {NEMATIC_SEEDS} seeds start aligned; the final exponent of N is {power}.

{nematic}

From random starts, domains of different directors must merge and disclinations must annihilate. They do so more
completely the longer the preparation stays at densities where particles are mobile (1000 particles, commit ebbc22c):
growth at the rate 1e-2 gives S = 0.06 to 0.25 in 0.7 s, 1e-3 gives 0.42 to 0.74 in 4.7 s, and 1e-4 gives 0.87 in 44 s;
swelling gives 0.04 to 0.07, compression at βP = 10 gives 0.26 in 19 s, and the hybrid method with 100 sweeps per
interval 0.10 to 0.12 in 3.7 s.
"""

import math
import statistics

from validation.common import Estimate, estimate, expect, shape, table
from validation.comparison import SCENES, SEED, Scenes, compared

TITLE = "Isotropic and nematic states"
INPUTS = ["mc", "core", "analysis", "workflow/stages"]
FILE = SCENES / "liquid_crystal.toml"

ERRORS = 3
STARTS = ("random", "aligned")
ISOTROPIC = {2: (0.60, 1500), 6: (0.40, 6000)}  # by aspect ratio φ and sweeps
SIZES = {500: 24, 2000: 12}  # particles: seeds of each start
NEMATIC = (6, 0.70)
NEMATIC_SWEEPS, NEMATIC_SIZES, NEMATIC_SEEDS = (1000, 5000), (500, 2000), 3
LARGEST_DECAY = 1 / 4  # of order, at which a two-dimensional nematic is stable

KAPPA, PHI, PARTICLES = "species.0.aspect_ratio", "system.packing_fraction", "system.particles"
START, SWEEPS = "prepare.stage.0.orientations", "prepare.stage.2.sweeps"


def row(kappa, phi, particles, start, sweeps, seed):
    return {KAPPA: kappa, PHI: phi, PARTICLES: particles, START: start, SWEEPS: sweeps, SEED: seed}


LIQUIDS = Scenes(FILE, rows=tuple(
    row(kappa, phi, particles, start, sweeps, 1000 * STARTS.index(start) + seed)
    for kappa, (phi, sweeps) in ISOTROPIC.items() for particles, seeds in SIZES.items() for start in STARTS
    for seed in range(1, seeds + 1)))
NEMATICS = Scenes(FILE, rows=tuple(
    row(*NEMATIC, particles, "aligned", sweeps, seed)
    for particles in NEMATIC_SIZES for sweeps in NEMATIC_SWEEPS for seed in range(1, NEMATIC_SEEDS + 1)))


def exponent(orders):
    """The exponent of N in S, from the estimates of S at two numbers of particles."""
    (small, (s, ds)), (large, (t, dt)) = sorted(orders.items())
    ratio = math.log(large / small)
    return Estimate(math.log(t / s) / ratio, math.hypot(ds / s, dt / t) / ratio)


def correlated_sums(correlations, particles):
    """For each state the sum of cos 2(θ_i − θ_j) over all j correlated with i, i included, averaged over i. Particles are
    correlated up to the distance at which the mean of g₂ over the states first falls to 0."""
    bins = zip(*([pairs * (value or 0) for pairs, value in zip(g["pairs"], g["value"])] for g in correlations))
    sums = [1.0] * len(correlations)
    for column in bins:
        if sum(column) < 0:
            break
        sums = [total + 2 / particles * share for total, share in zip(sums, column)]
    return sums


def correlations(scene):
    return scene.every("prepare.quality.nematic_correlation")


def orders(scene):
    return scene.every("prepare.nematic_order")


def liquid_row(random, aligned):
    """Both starts of one size must agree, and nearby correlations must account for the order."""
    name, particles = f"{shape(random[KAPPA])}, φ = {random[PHI]}, N = {random[PARTICLES]}", random[PARTICLES]
    both = [correlation for scene in (random, aligned) for correlation in correlations(scene)]
    expect(all(one["length"]["reached"] for one in both), f"{name}: g₂ does not fall below 1/e within half the box")
    starts = [estimate(orders(scene)) for scene in (random, aligned)]
    compared(f"{name}: S of both starts", *starts)
    sums = correlated_sums(both, particles)
    near = statistics.mean(sums)
    # N S² is the same sum over all pairs.
    far = estimate([particles * s**2 - nearby for s, nearby in zip(orders(random) + orders(aligned), sums)])
    compared(f"{name}: N S² beyond nearby particles", far, 0)
    return [name, *starts, f"{math.sqrt(math.pi * near / (4 * particles)):.3f}", f"{near:.2f}", far,
            f"{statistics.mean(one['length']['value'] for one in both):.1f}"]


def check_exponent(name, orders_by_size):
    """Checks that the exponent is that of a liquid and excludes the largest exponent of a nematic."""
    power = exponent(orders_by_size)
    compared(f"{name}: exponent of N", power, -1 / 2)
    expect(power.mean + ERRORS * power.error < -LARGEST_DECAY / 4, f"{name}: {power} does not rule out a nematic")
    return power


def isotropic(build):
    """The rows of all liquids, and their exponents of N by aspect ratio."""
    scenes = LIQUIDS.run(build)
    pairs = list(zip(scenes[::2], scenes[1::2], strict=True))
    rows = [liquid_row(*pair) for pair in pairs]
    powers = {}
    for kappa in ISOTROPIC:
        by_size = {random[PARTICLES]: estimate(orders(random) + orders(aligned))
                   for random, aligned in pairs if random[KAPPA] == kappa}
        powers[kappa] = check_exponent(shape(kappa), by_size)
    return rows, powers


def min_order(particles):
    """S of a nematic at its stability limit, where g₂(r) falls as r^-1/4 from the nearest-neighbour distance on."""
    return particles ** (-LARGEST_DECAY / 4)


def nematic(build):
    """Rows of S by the number of particles, and the final exponent of N."""
    found = {}
    for scene in NEMATICS.run(build):
        least = min_order(scene[PARTICLES])
        expect(min(orders(scene)) >= least, f"{scene}: S = {min(orders(scene))}, below {least}")
        expect(not any(one["length"]["reached"] for one in correlations(scene)), f"{scene}: g₂ falls below 1/e within the box")
        found.setdefault(scene[PARTICLES], []).append(estimate(orders(scene)))
    power = exponent({particles: estimates[-1] for particles, estimates in found.items()})
    expect(power.mean + ERRORS * power.error >= -LARGEST_DECAY / 4, f"κ = 6: S falls as N to the power {power}")
    return [[particles, *estimates, f"{min_order(particles):.3f}"] for particles, estimates in found.items()], power


def measure(build):
    liquids, powers = isotropic(build)
    order, power = nematic(build)
    head = ["", *(f"S, {start} start" for start in STARTS), "expected", "near", "far", "correlation length"]
    return {"powers": " and ".join(f"{one} ({shape(kappa)})" for kappa, one in powers.items()), "power": power,
            "isotropic": table(head, liquids),
            "nematic": table(["N", *(f"S after {n} sweeps" for n in NEMATIC_SWEEPS), "minimum S"], order)}
