"""Isotropic and nematic states of hard ellipses, from random and aligned starts."""

import math
import pathlib
import statistics
import tempfile

from validation.common import apart, estimate, expect, preparation, shape, summary_of, table, text_of

TITLE = "Isotropic and nematic states"
STARTS = ("random", "aligned")
INSERTED = 0.4  # packing fraction after insertion
ERRORS = 3

# Aspect ratio, φ, Monte Carlo sweeps after swelling.
ISOTROPIC = ((2, 0.60, 1500), (6, 0.40, 6000))
SIZES = {500: 24, 2000: 12}  # particles: seeds of each start
# The approach to equilibrium in the last of them, and the orientational relaxation of single particles.
WAY = (0, 500, 1000, 2000, 4000, 6000)
WAY_PARTICLES = 1000
WAY_SEEDS = 6
QUALITY_SWEEPS = 2500

NEMATIC = (6, 0.70)
NEMATIC_WAY = (0, 1000, 5000)
NEMATIC_SIZES = (500, 2000)
NEMATIC_SEEDS = 3
# The largest exponent of the decay of order at which a two-dimensional nematic is stable.
LARGEST_DECAY = 1 / 4

# From a random start: the number of seeds, and the stages that bring it to φ.
RANDOM_PARTICLES = 1000
GROW = 'method = "grow"\ngrowth_rate = {}'
HYBRID = 'method = "hybrid"\ngrowth_rate = 1e-2\nstretch_sweeps = {}'
SAMPLE = 'method = "sample"\nmoves = "local"\nsweeps = {}'
METHODS = {
    "swell": (2, 'method = "swell"'),
    "compress, βP = 10": (1, f'method = "compress"\npressure = 10\npacking_fraction = {NEMATIC[1]}'),
    "hybrid, rate 1e-2, 10 sweeps per interval": (2, HYBRID.format(10)),
    "hybrid, rate 1e-2, 100 sweeps per interval": (2, HYBRID.format(100)),
    "grow, rate 1e-2": (2, GROW.format("1e-2")),
    "grow, rate 1e-2, then 10000 sweeps": (2, GROW.format("1e-2"), SAMPLE.format(10_000)),
    "grow, rate 1e-3": (2, GROW.format("1e-3")),
    "grow, rate 1e-4": (1, GROW.format("1e-4")),
}


def stage(text):
    return f"[[prepare.stage]]\n{text}"


def insertion(start, packing_fraction):
    return f'method = "insert"\npacking_fraction = {packing_fraction}\norientations = "{start}"'


def prepared(build, particles, aspect_ratio, packing_fraction, seed, *stages, quality_sweeps=0):
    """The summary of a preparation by these stages."""
    text = preparation(particles, aspect_ratio, (1,), f"[prepare]\nquality_sweeps = {quality_sweeps}",
                       *map(stage, stages))
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "state.toml")
        file.write_text(text, encoding="utf-8")
        return summary_of(build, "prepare", file, "-o", pathlib.Path(folder, "state.h5"),
                          "--set", f"system.packing_fraction={packing_fraction}", "--set", f"system.seed={seed}")


def sampling(sweeps):
    """A swelling stage and, unless `sweeps` is 0, a sampling stage."""
    return ('method = "swell"', SAMPLE.format(sweeps)) if sweeps else ('method = "swell"',)


def exponent(orders):
    """The exponent of N in S and its standard error, from the estimates of S at two numbers of particles."""
    (small, (s, ds)), (large, (t, dt)) = sorted(orders.items())
    ratio = math.log(large / small)
    return math.log(t / s) / ratio, math.hypot(ds / s, dt / t) / ratio


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


class Liquid:
    """Independent samples of a state that should be isotropic, from one start and of one size."""

    def __init__(self, build, state, particles, start):
        self.aspect_ratio, self.packing_fraction, sweeps = state
        self.particles, self.start = particles, start
        first = 1000 * STARTS.index(start) + 1
        states = [prepared(build, particles, self.aspect_ratio, self.packing_fraction, seed, insertion(start, INSERTED),
                           *sampling(sweeps))["quality"] for seed in range(first, first + SIZES[particles])]
        self.orders = [one["nematic_order"] for one in states]
        self.order = estimate(self.orders)
        self.correlations = [one["nematic_correlation"] for one in states]
        lengths = [one["length"] for one in self.correlations]
        expect(all(length["reached"] for length in lengths), f"{self.name()}: g₂ does not fall below 1/e within half the box")
        self.length = statistics.mean(length["value"] for length in lengths)

    def name(self):
        return f"{shape(self.aspect_ratio)}, φ = {self.packing_fraction}, N = {self.particles}, {self.start}"


class Both:
    """Both starts of one size. They must agree, and nearby correlations must account for the order."""

    def __init__(self, build, state, particles):
        self.liquids = [Liquid(build, state, particles, start) for start in STARTS]
        self.name = self.liquids[0].name().rsplit(",", 1)[0]
        self.particles = particles
        orders = sum((liquid.orders for liquid in self.liquids), [])
        correlations = sum((liquid.correlations for liquid in self.liquids), [])
        sums = correlated_sums(correlations, particles)
        self.order = estimate(orders)
        self.sum = statistics.mean(sums)
        # N S² is the same sum over all pairs.
        self.rest = estimate([particles * s**2 - near for s, near in zip(orders, sums)])

    def check(self):
        difference = apart(*(liquid.order for liquid in self.liquids))
        expect(difference <= ERRORS, f"{self.name}: the starts differ by {difference:.1f} standard errors")
        expect(abs(self.rest[0]) <= ERRORS * self.rest[1],
               f"{self.name}: N S² has {text_of(*self.rest)} more than nearby particles contribute")

    def expected(self):
        """S of many independent groups: the mean modulus of a Gaussian with ⟨S²⟩ = sum/N."""
        return math.sqrt(math.pi * self.sum / (4 * self.particles))

    def row(self):
        return [self.name, *(text_of(*liquid.order) for liquid in self.liquids), f"{self.expected():.3f}",
                f"{self.sum:.2f}", text_of(*self.rest, 2),
                f"{statistics.mean(liquid.length for liquid in self.liquids):.1f}"]


def check_exponent(name, orders):
    """Checks that the exponent is that of a liquid and excludes the largest exponent of a nematic."""
    power, error = exponent(orders)
    expect(abs(power + 0.5) <= ERRORS * error, f"{name}: S falls as N to the power {text_of(power, error)}")
    expect(power + ERRORS * error < -LARGEST_DECAY / 4, f"{name}: {text_of(power, error)} does not rule out a nematic")
    return power, error


def isotropic(build):
    """The rows of all states, and a phrase on each exponent."""
    rows, powers = [], []
    for state in ISOTROPIC:
        sizes = [Both(build, state, particles) for particles in SIZES]
        for one in sizes:
            one.check()
            rows.append(one.row())
        name = f"{shape(state[0])}, φ = {state[1]}"
        power = check_exponent(name, {one.particles: one.order for one in sizes})
        powers.append(f"{text_of(*power, 2)} ({name})")
    return rows, " and ".join(powers)


def approach(build):
    """Rows of S against the number of sweeps, from both starts."""
    kappa, fraction, _ = ISOTROPIC[-1]
    rows = []
    for sweeps in WAY:
        row = [sweeps]
        for start in STARTS:
            orders = [prepared(build, WAY_PARTICLES, kappa, fraction, seed, insertion(start, INSERTED),
                               *sampling(sweeps))["nematic_order"] for seed in range(1, WAY_SEEDS + 1)]
            row.append(text_of(*estimate(orders)))
        rows.append(row)
    return rows


def orientation_times(build):
    """The longest orientational relaxation time of single particles in each liquid, by aspect ratio."""
    times = {}
    for kappa, fraction, sweeps in ISOTROPIC:
        states = [prepared(build, WAY_PARTICLES, kappa, fraction, seed, insertion("random", INSERTED),
                           *sampling(sweeps // 4), quality_sweeps=QUALITY_SWEEPS)["quality"]
                  for seed in range(1, WAY_SEEDS + 1)]
        limits = [one["time_correlation"]["orientation_lost"] for one in states]
        expect(all(limit["reached"] for limit in limits), f"{shape(kappa)}: orientations do not relax: {limits}")
        times[kappa] = max(limit["value"] for limit in limits)
        expect(times[kappa] <= sweeps / 10, f"{shape(kappa)}: {sweeps} sweeps are too few for a relaxation time of {times[kappa]}")
    return times


def min_order(particles):
    """S of a nematic at its stability limit, where g₂(r) falls as r^-1/4 from the nearest-neighbour distance on."""
    return particles ** (-LARGEST_DECAY / 4)


def length_text(quality):
    length = quality["nematic_correlation"]["length"]
    return f"{length['value']:.1f}" if length["reached"] else f"> {length['value']:.1f}"


def nematic(build):
    """Rows of S against the number of sweeps, and the final exponent of N."""
    rows, orders = [], {}
    for particles in NEMATIC_SIZES:
        row = [particles]
        for sweeps in NEMATIC_WAY:
            states = [prepared(build, particles, *NEMATIC, seed, insertion("aligned", INSERTED), *sampling(sweeps))
                      for seed in range(1, NEMATIC_SEEDS + 1)]
            found = [one["nematic_order"] for one in states]
            row.append(text_of(*estimate(found)))
            least = min_order(particles)
            expect(min(found) >= least, f"κ = 6, N = {particles}, {sweeps} sweeps: S = {min(found)}, below {least}")
        expect(not any(one["quality"]["nematic_correlation"]["length"]["reached"] for one in states),
               f"κ = 6, N = {particles}: g₂ falls below 1/e within the box")
        orders[particles] = estimate(found)
        rows.append([*row, f"{min_order(particles):.3f}"])
    power, error = exponent(orders)
    expect(power + ERRORS * error >= -LARGEST_DECAY / 4, f"κ = 6: S falls as N to the power {text_of(power, error)}")
    return rows, (power, error)


def from_random(build):
    rows = []
    for name, (seeds, *stages) in METHODS.items():
        states = [prepared(build, RANDOM_PARTICLES, *NEMATIC, seed, insertion("random", INSERTED), *stages)
                  for seed in range(1, seeds + 1)]
        orders = ", ".join(f"{one['nematic_order']:.2f}" for one in states)
        lengths = ", ".join(length_text(one["quality"]) for one in states)
        rows.append([name, orders, lengths, f"{statistics.mean(one['wall_seconds'] for one in states):.1f} s"])
    return rows


def measure(build):
    liquids, powers = isotropic(build)
    times = orientation_times(build)
    way = approach(build)
    order, (power, error) = nematic(build)
    sweeps = " and ".join(f"{sweeps} sweeps (κ = {kappa}; relaxation time: {times[kappa]})"
                          for kappa, _, sweeps in ISOTROPIC)
    seeds = " and ".join(f"{count} (N = {particles})" for particles, count in SIZES.items())
    kappa, fraction, _ = ISOTROPIC[-1]
    return f"""Monodisperse ellipses in a square box. The nematic order parameter is S = |⟨exp 2iθ⟩|. Particles are inserted at φ = {INSERTED},
either at random angles (random start) or all at the angle 0 (aligned start, S = 1). They are swollen to φ and then sampled
by sweeps of local moves.

### Isotropic states

There are independent seeds for each start: {seeds}. Each is sampled for many orientational
relaxation times of single particles (C₂ < 1/e, the longest of {WAY_SEEDS} seeds at N = {WAY_PARTICLES}):
{sweeps}.

In a liquid N⟨S²⟩ is the sum of ⟨cos 2(θ_i − θ_j)⟩ over all j, i included, and does not depend on N. The column *near* is
the sum over particles j up to the distance at which g₂(r) first falls to 0; *far* is the contribution of all others.
*Expected* is S = √(π near/4N), the value for many independent groups. Required, within {ERRORS} standard errors: both starts
give the same S; *far* is zero; S ∝ N^(−1/2), distinct from the exponent of a nematic, −1/16 or above. Also required: the
relaxation time of single particles is at most a tenth of the sweeps, and g₂ stays below 1/e beyond a length shorter than
half the box. The exponent of N is {powers}.

{table(["", "S, random start", "S, aligned start", "expected", "near", "far", "correlation length"], liquids)}

Near the transition the alignment of the liquid relaxes more slowly than the orientation of a single particle.
κ = {kappa}, φ = {fraction}, N = {WAY_PARTICLES}, {WAY_SEEDS} seeds:

{table(["sweeps", *(f"S, {start} start" for start in STARTS)], way)}

### Nematic states

κ = {NEMATIC[0]}, φ = {NEMATIC[1]:.2f}. In two dimensions nematic order is only quasi-long-ranged: g₂(r) ∝ r^(−η). At η = 1/4 disclination pairs
unbind and the nematic melts, so η ≤ 1/4. S decreases as N^(−η/4), with an exponent of −1/16 or above. If the power law
begins at the nearest-neighbour distance, S is at least about N^(−1/16) (*minimum S*). Required: S of every seed exceeds this
value after any number of sweeps; the exponent of N is not below −1/16 by more than {ERRORS} standard errors; g₂ stays above 1/e
throughout the box. {NEMATIC_SEEDS} seeds start aligned; the final exponent of N is {text_of(power, error)}.

{table(["N", *(f"S after {n} sweeps" for n in NEMATIC_WAY), "minimum S"], order)}

Random starts, {RANDOM_PARTICLES} particles. Domains of different directors must merge and disclinations must annihilate. They do so
more completely the longer the preparation stays at densities where particles are mobile. The table lists S and the
correlation length of g₂ for each seed, and the mean time. It sets no requirement.

{table(["stages", "S", "correlation length", "time"], from_random(build))}
"""
