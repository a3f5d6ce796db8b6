"""Random periodic packings of hard ellipsoids: the volume fractions of the article, and the computing times."""

import functools
import math
import pathlib
import statistics
import tempfile

from validation.common import HERE, expect, processor, summary_of, table

TITLE = "Random periodic packings of ellipsoids"
FIGURES = HERE.parents[1] / "docs" / "figures" / "packings"

GROWTH_RATE = 0.1
SLOW_RATE = 0.01  # growth rate for the maximum volume fractions
JAMMED = 1e6  # final reduced pressure; the fraction is then below its limit by 1e-6 times the degrees of freedom
NEAR_CONTACTS = 0.05  # of the isostatic number; neighbours that nearly touch (analysis/structure/contacts.h)
RUNS = 10
START = 0.01

# R_1, R_2, particles, volume fraction, growth rate, published mean CPU seconds (MATLAB, 1.6 GHz), for the maximum
# volume fractions of the article. Dense fluids of platelets and long rods are nematic: packings are isotropic only if
# they have no time to order. The rates are the highest that reach the fraction in all runs.
TABLE_2 = (
    (2, 2, 30, 0.60, 0.3, 54.3), (5, 5, 45, 0.55, 0.05, 69.9), (10, 10, 90, 0.30, 0.3, 48.6),
    (20, 20, 175, 0.20, 0.15, 112.5), (30, 30, 175, 0.10, 0.2, 104.9), (40, 40, 310, 0.10, 0.15, 181.3),
    (2, 1, 30, 0.60, 0.3, 52.7), (5, 1, 45, 0.55, 0.1, 65.2), (10, 1, 60, 0.30, 0.3, 39.3),
    (20, 1, 75, 0.20, 0.2, 47.8), (30, 1, 90, 0.10, 0.4, 53.7), (40, 1, 100, 0.10, 0.25, 92.8),
)
# Further examples: name, aspect ratios in TOML, particles, volume fraction.
EXAMPLES = (
    ("prolate 3", "[3, 3]", 100, 0.40),
    ("prolate 40", "[40, 40]", 300, 0.10),
    ("oblate 3", "[3, 1]", 100, 0.40),
    ("oblate 20", "[20, 1]", 50, 0.15),
    ("scalene 2, 5", "[2, 5]", 100, 0.30),
    ("scalene 4, 0.5", "[4, 0.5]", 1000, 0.20),
    ("1 ≤ R ≤ 5", "[{ distribution = \"uniform\", low = 1, high = 5 }, { distribution = \"uniform\", low = 1, high = 5 }]", 50, 0.30),
    ("0.1 ≤ R ≤ 2", "[{ distribution = \"uniform\", low = 0.1, high = 2 }, { distribution = \"uniform\", low = 0.1, high = 2 }]", 125, 0.20),
)
EXTREMES = (("prolate 100", "[100, 100]", 500, 0.05), ("prolate 2", "[2, 2]", 100000, 0.40))


# Jammed packings of N = 1 000: name, aspect ratios, growth rate, lowest and highest fraction in the literature.
JAMMED_ROWS = (
    ("spheres", "[1, 1]", 0.003, 0.635, 0.65),
    ("prolate 1.5", "[1.5, 1.5]", 0.003, 0.70, 0.72),
    ("oblate 1.5", "[1.5, 1]", 0.003, 0.70, 0.72),
    ("1.25 : 1 : 0.8", "[1.25, 1.5625]", 0.003, 0.725, 0.745),
)


def parameters(ratios, particles, fraction, seed, goal, rate):
    return f"""[system]
dimension = 3
particles = {particles}
seed = {seed}
{f"packing_fraction = {fraction}" if fraction else ""}

[[species]]
name = "A"
fraction = 1.0
aspect_ratios = {ratios}

[[prepare.stage]]
method = "insert"
packing_fraction = {min(START, fraction or START)}

[[prepare.stage]]
method = "grow"
growth_rate = {rate}
{goal}
"""


class Packing:
    """One packing, grown by `vitrel prepare` and tested by `vitrel check`."""

    def __init__(self, build, ratios, particles, fraction, seed=1, rate=GROWTH_RATE):
        goal = f"packing_fraction = {fraction}" if fraction else f"reduced_pressure = {JAMMED}"
        with tempfile.TemporaryDirectory() as folder:
            file, state = pathlib.Path(folder, "packing.toml"), pathlib.Path(folder, "packing.h5")
            file.write_text(parameters(ratios, particles, fraction, seed, goal, rate), encoding="utf-8")
            summary = summary_of(build, "prepare", file, "-o", state)
            check = summary_of(build, "check", state)
        name = f"{ratios}, {particles} particles, seed {seed}"
        expect(check["overlaps"] == 0, f"{name}: {check['overlaps']} overlaps")
        self.fraction = summary["packing_fraction"]
        if fraction:
            expect(abs(self.fraction / fraction - 1) < 1e-11, f"{name}: reached {self.fraction}")
        self.seconds = sum(stage["wall_seconds"] for stage in summary["stages"])
        self.ratio = summary["orientation_ratio"]
        self.collisions = summary["collisions"]
        self.backbone = {key: summary.get(key) for key in ("contact_number", "isostatic_number", "rattlers")}


def isotropic_ratio(particles):
    """Mean ρ of random directions, and the half-width of the 95 % confidence interval of a mean over RUNS samples."""
    import numpy  # only here: a test imports all validations

    draw = numpy.random.default_rng(1)
    ratios = []
    for _ in range(2000):
        directions = draw.normal(size=(particles, 3))
        directions /= numpy.linalg.norm(directions, axis=1)[:, None]
        eigenvalues = numpy.linalg.eigvalsh(directions.T @ directions)
        ratios.append(eigenvalues[2] / eigenvalues[0])
    return statistics.mean(ratios), 1.96 * statistics.stdev(ratios) / math.sqrt(RUNS)


def spread(values):
    """The mean and the half-width of its 95 % confidence interval."""
    student = {5: 2.776, 10: 2.262}[len(values)]
    return statistics.mean(values), student * statistics.stdev(values) / math.sqrt(len(values))


@functools.cache
def row_packings(build, r1, r2, particles, fraction, rate):
    return [Packing(build, f"[{r1}, {r2}]", particles, fraction, seed, rate) for seed in range(1, RUNS + 1)]


def table_2(build):
    rows = []
    for r1, r2, particles, fraction, rate, printed in TABLE_2:
        packings = row_packings(build, r1, r2, particles, fraction, rate)
        seconds, seconds_error = spread([p.seconds for p in packings])
        ratio, ratio_error = spread([p.ratio for p in packings])
        densest = [Packing(build, f"[{r1}, {r2}]", particles, None, seed, SLOW_RATE).fraction for seed in range(1, 4)]
        by_chance, chance_error = isotropic_ratio(particles)
        rows.append(["prolate" if r1 == r2 else "oblate", r1, particles, f"{fraction:.0%}", f"{rate:g}",
                     f"{ratio:.2f} ± {ratio_error:.2f}", f"{by_chance:.2f} ± {chance_error:.2f}", f"{printed:g}",
                     f"{seconds:.3f} ± {seconds_error:.3f}", f"{printed / seconds:.0f}",
                     f"{statistics.mean(densest):.3f}"])
        expect(min(densest) >= fraction, f"R_1 = {r1}, R_2 = {r2}: jammed at {min(densest)}")
    return rows


def examples(build):
    rows = []
    for name, ratios, particles, fraction in (*EXAMPLES, *EXTREMES):
        packing = Packing(build, ratios, particles, fraction)
        rows.append([name, particles, f"{fraction:.0%}", f"{packing.ratio:.2f}", f"{packing.collisions:.2e}",
                     f"{packing.seconds:.3g}"])
    return rows


def larger_packings(build):
    """In isotropic packings of correlated particles ρ − 1 ∝ N^(−1/2); in ordered ones it is independent of N."""
    rows = []
    for r1, r2, particles, fraction, rate, _ in TABLE_2:
        if r2 != 1 and r1 != 5:
            continue
        found = [spread([p.ratio for p in row_packings(build, r1, r2, n, fraction, rate)])
                 for n in (particles, 8 * particles)]
        (small, _), (large, error) = found
        expect(small - 1 > 2 * (large - 1) or large - error <= isotropic_ratio(8 * particles)[0],
               f"R_1 = {r1}, R_2 = {r2}: ρ = {small} at N = {particles}, {large} at {8 * particles}: not isotropic")
        rows.append([f"{r1}, {r2}", f"{fraction:.0%}", particles, *(f"{mean:.2f} ± {half:.2f}" for mean, half in found),
                     f"{(small - 1) / (large - 1):.1f}"])
    return rows


def jammed(build):
    rows = []
    for name, ratios, rate, lowest, highest in JAMMED_ROWS:
        packings = [Packing(build, ratios, 1000, None, seed, rate) for seed in range(1, 6)]
        fraction, error = spread([packing.fraction for packing in packings])
        expect(lowest <= fraction <= highest, f"{name}: jammed at {fraction}, not between {lowest} and {highest}")
        contacts, contacts_error = spread([packing.backbone["contact_number"] for packing in packings])
        isostatic = packings[0].backbone["isostatic_number"]
        expect(contacts < (1 + NEAR_CONTACTS) * isostatic, f"{name}: {contacts} contacts per particle")
        rows.append([name, f"{rate:g}", f"{fraction:.4f} ± {error:.4f}", f"{lowest:g} – {highest:g}",
                     f"{contacts:.2f} ± {contacts_error:.2f}", f"{isostatic:g}",
                     f"{statistics.mean(packing.backbone['rattlers'] for packing in packings) / 1000:.1%}",
                     f"{statistics.mean(packing.seconds for packing in packings):.3g}"])
    return rows


def orientation_study(build):
    """Figure 6: ρ against N, with means and 95 % confidence intervals of 10 runs."""
    series = {}
    for ratio, fraction in ((2, 0.30), (10, 0.10)):
        for particles in (10, 25, 50, 100, 200, 500):
            found = [Packing(build, f"[{ratio}, {ratio}]", particles, fraction, seed).ratio
                     for seed in range(1, RUNS + 1)]
            series.setdefault((ratio, fraction), []).append((particles, *spread(found)))
    return series


def exponent(points):
    """The slope of a linear fit to the logarithms."""
    x, y = ([math.log(p[k]) for p in points] for k in (0, 1))
    mx, my = statistics.mean(x), statistics.mean(y)
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)


def times(build):
    """Figures 7 to 9: seconds against N (R = 2, 30 %), volume fraction (N = 1000, R = 2) and R (N = 100, 5 %)."""
    def seconds(ratio, particles, fraction):
        return Packing(build, f"[{ratio}, {ratio}]", particles, fraction).seconds

    return {
        "particles N": [(n, seconds(2, n, 0.30)) for n in (100, 316, 1000, 3162, 10000, 31623, 100000)],
        "volume fraction": [(f, seconds(2, 1000, f)) for f in (0.1, 0.2, 0.3, 0.4, 0.5, 0.6)],
        "aspect ratio R": [(r, seconds(r, 100, 0.05)) for r in (2, 3, 5, 10, 20, 40)],
    }


def draw(orientation, timed):
    import matplotlib  # only here: a test imports all validations

    matplotlib.use("svg")
    from matplotlib import pyplot, ticker

    matplotlib.rcParams.update({"svg.hashsalt": "vitrel", "svg.fonttype": "none", "font.size": 11})
    FIGURES.mkdir(parents=True, exist_ok=True)

    def saved(figure, name):
        figure.tight_layout()
        figure.savefig(FIGURES / name, metadata={"Date": None})
        pyplot.close(figure)

    figure, axes = pyplot.subplots(figsize=(6.4, 4.2))
    for (ratio, fraction), points in orientation.items():
        n, mean, error = zip(*points)
        axes.errorbar(n, mean, error, fmt="o-", capsize=3, label=f"R = {ratio}, {fraction:.0%}")
    axes.axhline(1, color="gray", linewidth=0.8)
    axes.set(xlabel="particles N", ylabel="ρ = λ_max/λ_min", xscale="log")
    axes.legend(frameon=False)
    axes.grid(alpha=0.3)
    saved(figure, "orientation.svg")

    figure, panels = pyplot.subplots(1, 3, figsize=(10.5, 3.6))
    for axes, (name, points) in zip(panels, timed.items()):
        x, y = zip(*points)
        axes.loglog(x, y, "o-")
        if x[-1] < 100 * x[0]:
            axes.set_xticks(x, [f"{value:g}" for value in x])
            axes.minorticks_off()
            axes.yaxis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
        axes.yaxis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))
        axes.set(xlabel=name, ylabel="seconds")
        axes.grid(alpha=0.3)
    saved(figure, "times.svg")


def measure(build):
    dense, larger = jammed(build), larger_packings(build)
    rows, further = table_2(build), examples(build)
    orientation, timed = orientation_study(build), times(build)
    draw(orientation, timed)
    slopes = {name: exponent(points) for name, points in timed.items()}
    isotropic = [f"R = {ratio}: from {points[0][1]:.2f} at N = {points[0][0]} to {points[-1][1]:.2f} ± {points[-1][2]:.2f} "
                 f"at N = {points[-1][0]}" for (ratio, _), points in orientation.items()]
    return f"""Ellipsoids with semi-axes a : a/R_1 : a/R_2 are inserted at random in a periodic cube at {START:.0%} (or less) and grow during
event-driven dynamics. The growth rate, of all lengths per unit of time, is that of the table, otherwise {GROWTH_RATE:g}. The exact
check (tolerance zero) tests every packing; the volume fraction agrees with the target to 1e-11. The table lists means of {RUNS}
runs with 95 % confidence intervals, and the ρ of as many random directions (*random ρ*). The target volume fractions are the
maximum values of the article. The last column lists the maximum reached by vitrel: the mean of three packings grown at the
rate {SLOW_RATE:g} to a reduced pressure of {JAMMED:g}. There Z ≈ 6/(1 − φ/φ_J), so the fraction is 6 millionths below its limit. The
article stops when 50 iterations gain less than 0.1 %.

{table(["shape", "R_1", "N", "volume fraction", "growth rate", "ρ", "random ρ", "published, s", "measured, s", "ratio", "maximum fraction"], rows)}

Where ρ exceeds its random value, neighbours are aligned. Platelets of aspect ratio 20 and above are nematic at these
fractions in equilibrium; at higher growth rates they jam before reaching them. The packings as a whole are isotropic: with
eight times as many particles, ρ − 1 decreases by a factor of {min(float(row[-1]) for row in larger):g} or more. The expected factor is √8 = 2.8; in an ordered
packing ρ − 1 would not decrease.

{table(["R_1, R_2", "volume fraction", "N", "ρ", "ρ at 8 N", "decrease of ρ − 1"], larger)}

The published times were measured with MATLAB at 1.6 GHz, the others on one core of {processor()}.

{table(["shape", "N", "volume fraction", "ρ", "collisions", "seconds"], further)}

Jammed packings of 1000 particles at the same reduced pressure, compared with the literature:

{table(["shape", "growth rate", "volume fraction", "literature", "contacts", "isostatic", "rattlers", "seconds"], dense)}

The contacts are per particle and without rattlers. Spheres have the isostatic number, but for some
2 % of neighbours that nearly touch; ellipsoids have fewer (Donev et al. 2007).

ρ approaches 1 as the number of particles increases: {"; ".join(isotropic)}.

![ρ against N](figures/packings/orientation.svg)

The time scales as N^{slopes["particles N"]:.2f} with the number of particles (R = 2, 30 %), as V_f^{slopes["volume fraction"]:.1f} with the volume fraction (N = 1000,
R = 2), and as R^{slopes["aspect ratio R"]:.1f} with the aspect ratio (N = 100, 5 %). The exponents of the article are 1.5, 2.6, and 0.6 up to R = 10
and 2.8 beyond.

![Time against N, volume fraction and R](figures/packings/times.svg)
"""
