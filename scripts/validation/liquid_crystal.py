"""Which states of hard ellipses are isotropic and which nematic, from random and from aligned starts."""

import math
import pathlib
import statistics
import tempfile

from validation.common import expect, preparation, shape, summary_of, table

TITLE = "Isotropic and nematic states"
STARTS = ("random", "aligned")
INSERTED = 0.4  # the packing fraction
ERRORS = 3

# Aspect ratio, φ, sweeps of Monte Carlo after the swelling.
ISOTROPIC = ((2, 0.60, 1500), (6, 0.40, 6000))
SIZES = {500: 24, 2000: 12}  # particles: seeds of each start
# The way there, of the last of them, and how long single particles remember their angles.
WAY = (0, 500, 1000, 2000, 4000, 6000)
WAY_PARTICLES = 1000
WAY_SEEDS = 6
QUALITY_SWEEPS = 2500

NEMATIC = (6, 0.70)
NEMATIC_WAY = (0, 1000, 5000)
NEMATIC_SIZES = (500, 2000)
NEMATIC_SEEDS = 3
# The power of r by which order may decay before a two-dimensional nematic falls apart.
LARGEST_DECAY = 1 / 4

# From a random start: the stages that bring it to φ, and how many seeds.
RANDOM_PARTICLES = 1000
GROW = 'method = "grow"\ngrowth_rate = {}'
HYBRID = 'method = "hybrid"\ngrowth_rate = 1e-2\nstretch_sweeps = {}'
SAMPLE = 'method = "sample"\nmoves = "local"\nsweeps = {}'
METHODS = {
    "swell": (2, 'method = "swell"'),
    "compress, βP = 10": (1, f'method = "compress"\npressure = 10\npacking_fraction = {NEMATIC[1]}'),
    "hybrid, rate 1e-2, 10 sweeps at a time": (2, HYBRID.format(10)),
    "hybrid, rate 1e-2, 100 sweeps at a time": (2, HYBRID.format(100)),
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
    """Nothing is a stage of no sweeps."""
    return ('method = "swell"', SAMPLE.format(sweeps)) if sweeps else ('method = "swell"',)


def estimate(values):
    """Mean and standard error of independent values."""
    return statistics.mean(values), statistics.stdev(values) / math.sqrt(len(values))


def text_of(mean, error, digits=3):
    return f"{mean:.{digits}f} ± {error:.{digits}f}"


def apart(one, other):
    """Of two estimates, in standard errors."""
    return abs(one[0] - other[0]) / math.hypot(one[1], other[1])


def exponent(orders):
    """That of N in S, and its standard error, from the estimates of S at two numbers of particles."""
    (small, (s, ds)), (large, (t, dt)) = sorted(orders.items())
    ratio = math.log(large / small)
    return math.log(t / s) / ratio, math.hypot(ds / s, dt / t) / ratio


def correlated_sums(correlations, particles):
    """For each state the sum of cos 2(θ_i − θ_j) over all j that are correlated with i, itself included, on the
    average of i. Correlated are distances up to that where the mean of g₂ over the states first falls to 0."""
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
        expect(all(length["reached"] for length in lengths), f"{self.name()}: correlated through half the box")
        self.length = statistics.mean(length["value"] for length in lengths)

    def name(self):
        return f"{shape(self.aspect_ratio)}, φ = {self.packing_fraction}, N = {self.particles}, {self.start}"


class Both:
    """Both starts of one size: they have to agree, and order must be what the correlations of near particles make."""

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
               f"{self.name}: N S² has {text_of(*self.rest)} more than what near particles make")

    def expected(self):
        """S of a sum of many independent groups: the mean length of a Gaussian with ⟨S²⟩ = sum/N."""
        return math.sqrt(math.pi * self.sum / (4 * self.particles))

    def row(self):
        return [self.name, *(text_of(*liquid.order) for liquid in self.liquids), f"{self.expected():.3f}",
                f"{self.sum:.2f}", text_of(*self.rest, 2),
                f"{statistics.mean(liquid.length for liquid in self.liquids):.1f}"]


def check_exponent(name, orders):
    """That of a liquid, and told apart from the largest that a nematic may have."""
    power, error = exponent(orders)
    expect(abs(power + 0.5) <= ERRORS * error, f"{name}: S falls as N to the power {text_of(power, error)}")
    expect(power + ERRORS * error < -LARGEST_DECAY / 4, f"{name}: {text_of(power, error)} does not rule out a nematic")
    return power, error


def isotropic(build):
    """Rows of all states, and a sentence about each exponent."""
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


def forgetting(build):
    """Rows of S against sweeps, from both starts."""
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
    """The longest of single particles in each liquid, by aspect ratio, far below the sweeps that were sampled."""
    times = {}
    for kappa, fraction, sweeps in ISOTROPIC:
        states = [prepared(build, WAY_PARTICLES, kappa, fraction, seed, insertion("random", INSERTED),
                           *sampling(sweeps // 4), quality_sweeps=QUALITY_SWEEPS)["quality"]
                  for seed in range(1, WAY_SEEDS + 1)]
        limits = [one["time_correlation"]["orientation_lost"] for one in states]
        expect(all(limit["reached"] for limit in limits), f"{shape(kappa)}: orientations are kept: {limits}")
        times[kappa] = max(limit["value"] for limit in limits)
        expect(times[kappa] <= sweeps / 10, f"{shape(kappa)}: {sweeps} sweeps are too few for a time of {times[kappa]}")
    return times


def min_order(particles):
    """S of a nematic at the end of its stability, where g₂(r) falls as r^-1/4 from the distance of neighbours on."""
    return particles ** (-LARGEST_DECAY / 4)


def length_text(quality):
    length = quality["nematic_correlation"]["length"]
    return f"{length['value']:.1f}" if length["reached"] else f"> {length['value']:.1f}"


def nematic(build):
    """Rows of S against sweeps, and the exponent of N at the end."""
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
               f"κ = 6, N = {particles}: correlations end within the box")
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
    way = forgetting(build)
    order, (power, error) = nematic(build)
    sweeps = " and ".join(f"{sweeps} sweeps (κ = {kappa}; orientations of particles: {times[kappa]})"
                          for kappa, _, sweeps in ISOTROPIC)
    seeds = " and ".join(f"{count} (N = {particles})" for particles, count in SIZES.items())
    kappa, fraction, _ = ISOTROPIC[-1]
    return f"""Ellipses of one size in a square box. The nematic order is S = |⟨exp 2iθ⟩|. Particles are inserted at φ = {INSERTED}, at random
angles (random start) or all at the angle 0 (aligned start, S = 1), swollen to φ and then sampled for a number of sweeps of
local moves.

### Isotropic states

Independent seeds, {seeds} of each start, are sampled for many times as long as
single particles remember their orientation (C₂ < 1/e, the longest of {WAY_SEEDS} seeds at N = {WAY_PARTICLES}):
{sweeps}.

In a liquid N⟨S²⟩ is the sum of ⟨cos 2(θ_i − θ_j)⟩ over all j, i included, and does not depend on N. The column *near*
takes only particles j up to the distance where g₂(r) first falls to 0, *far* is what the others add. *Expected* is
S = √(π near/4N), that of many independent groups. Wanted, within {ERRORS} standard errors: the same S from both starts;
nothing from far; S ∝ N to the power −1/2, told apart from the −1/16 or more of a nematic, too. Besides, the
orientation time of particles is at most a tenth of the sweeps, and g₂ stays below 1/e from a length on that is less than
half the box. The power of N is {powers}.

{table(["", "S, random start", "S, aligned start", "expected", "near", "far", "correlation length"], liquids)}

Near its transition the liquid forgets its alignment more slowly than a particle its angle. κ = {kappa}, φ = {fraction},
N = {WAY_PARTICLES}, {WAY_SEEDS} seeds:

{table(["sweeps", *(f"S, {start} start" for start in STARTS)], way)}

### Nematic states

κ = {NEMATIC[0]}, φ = {NEMATIC[1]:.2f}. There is only quasi-long-range order in two dimensions: g₂(r) falls as r to the power −η. η is 1/4 at most,
where pairs of disclinations part and the nematic melts. So S falls as N to the power −η/4, that is, −1/16 or more, and is
at least about N^(−1/16) if the power law begins at the distance of neighbours. Wanted: S of every seed above this after any
number of sweeps; a power of N not below −1/16 by more than {ERRORS} standard errors; g₂ above 1/e as far as the box allows.
Aligned starts, {NEMATIC_SEEDS} seeds; the power of N at the end is {text_of(power, error)}.

{table(["N", *(f"S after {n} sweeps" for n in NEMATIC_WAY), "S, least"], order)}

Random starts, {RANDOM_PARTICLES} particles: domains of different directions have to grow together, and disclinations to meet, the
sooner the longer they stay at densities where particles still move. S and the correlation length of g₂ for each seed,
and the mean time. Nothing is wanted here.

{table(["stages", "S", "correlation length", "time"], from_random(build))}
"""
