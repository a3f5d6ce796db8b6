"""Random periodic packings of hard ellipsoids: the volume fractions of the article, and the computing times."""

import json
import math
import statistics
import tomllib

from validation.common import PARAMS, article_sweep, expect, processor, pyplot, save_figure, table

TITLE = "Random periodic packings of ellipsoids"
FIGURES = "figures/packings"
TABLE_2 = "ghossein_table_2"

RATIOS, PARTICLES, FRACTION = "species.0.aspect_ratios", "system.particles", "system.packing_fraction"
RATE = "prepare.stage.1.growth_rate"
GROWTH_RATE = 0.1
SLOW_RATE = 0.01  # growth rate for the maximum volume fractions
JAMMED = 1e6  # final reduced pressure; the fraction is then below its limit by 1e-6 times the degrees of freedom
NEAR_CONTACTS = 0.05  # of the isostatic number; neighbours that nearly touch (analysis/structure/contacts.h)
UNTIL_JAMMED = f"prepare.stage.1.reduced_pressure={JAMMED}"
RUNS = 10

# Mean CPU seconds of the rows of table 2 (MATLAB, 1.6 GHz).
PUBLISHED = (54.3, 69.9, 48.6, 112.5, 104.9, 181.3, 52.7, 65.2, 39.3, 47.8, 53.7, 92.8)
# Further examples: name, aspect ratios in TOML, particles, volume fraction.
EXAMPLES = (
    ("prolate 3", "[3, 3]", 100, 0.40),
    ("prolate 40", "[40, 40]", 300, 0.10),
    ("oblate 3", "[3, 1]", 100, 0.40),
    ("oblate 20", "[20, 1]", 50, 0.15),
    ("scalene 2, 5", "[2, 5]", 100, 0.30),
    ("scalene 4, 0.5", "[4, 0.5]", 1000, 0.20),
    ("prolate 100", "[100, 100]", 500, 0.05),
    ("prolate 2", "[2, 2]", 100000, 0.40),
)
DRAWN = ("same a, 1 ≤ R ≤ 5", "same a, 0.1 ≤ R ≤ 2")  # of ghossein_figure_5
# Jammed packings of N = 1 000: name, aspect ratios, growth rate, lowest and highest fraction in the literature.
JAMMED_ROWS = (
    ("spheres", "[1, 1]", 0.003, 0.635, 0.65),
    ("prolate 1.5", "[1.5, 1.5]", 0.003, 0.70, 0.72),
    ("oblate 1.5", "[1.5, 1]", 0.003, 0.70, 0.72),
    ("1.25 : 1 : 0.8", "[1.25, 1.5625]", 0.003, 0.725, 0.745),
)


class Packings:
    """Packings that differ in their seeds only."""

    def __init__(self, average):
        self.values, self.figures = average["values"], average["figures"]
        self.ratio, self.seconds = self.mean("orientation_ratio"), self.mean("wall_seconds")

    def mean(self, name):
        return self.figures[name]["mean"]

    def half_width(self, name):
        """Of the 95 % confidence interval of the mean."""
        return self.figures[name]["interval"][1] - self.mean(name)

    def text(self, name, digits):
        return f"{self.mean(name):.{digits}f} ± {self.half_width(name):.{digits}f}"


def aspect_ratios(packings):
    return json.loads(packings.values[RATIOS])


def parameters_of(name):
    return tomllib.loads((PARAMS / "articles" / f"{name}.toml").read_text(encoding="utf-8"))


def sweep(build, name, *overrides):
    """The jobs and the averages of a sweep whose packings must have the volume fractions that are given."""
    found = article_sweep(build, name, *overrides)
    given = parameters_of(name)["system"].get("packing_fraction")
    for job in found["jobs"]:
        reached, wanted = job["prepare"]["packing_fraction"], job["values"].get(FRACTION, given)
        expect(wanted is None or abs(reached / wanted - 1) < 1e-11, f"{name}: {job['id']}: reached {reached}")
    return found["jobs"], [Packings(average) for average in found["seeds"]]


def together(columns):
    """Other rows: their parameters in TOML or as numbers."""
    lists = (f'"{key}" = [{", ".join(map(str, values))}]' for key, values in columns.items())
    return f"sweep.together={{ {', '.join(lists)} }}"


def seeds(count):
    return f'sweep.grid={{ "system.seed" = {list(range(1, count + 1))} }}'


def column(rows, k):
    return [row[k] for row in rows]


def table_2(build, packings):
    """The rows of the article, with the maximum volume fractions that vitrel reaches."""
    given = parameters_of(TABLE_2)["sweep"]["together"]
    fractions, runs = given[FRACTION], 3
    jobs, densest = sweep(build, TABLE_2, together({key: given[key] for key in (RATIOS, PARTICLES)}), seeds(runs),
                          f"{RATE}={SLOW_RATE}", UNTIL_JAMMED)
    for job, fraction in zip(jobs, [fraction for fraction in fractions for _ in range(runs)], strict=True):
        reached = job["prepare"]["packing_fraction"]
        expect(reached >= fraction, f"{job['id']}: jammed at {reached}, below {fraction}")
    rows = zip(*(given[key] for key in (RATIOS, PARTICLES, FRACTION, RATE)), PUBLISHED, packings, densest, strict=True)
    for (r1, r2), particles, fraction, rate, published, of, dense in rows:
        chance_error = 1.96 * of.mean("isotropic_ratio_deviation") / math.sqrt(RUNS)
        yield ["prolate" if r1 == r2 else "oblate", r1, particles, f"{fraction:.0%}", f"{rate:g}",
               of.text("orientation_ratio", 2), f"{of.mean('isotropic_ratio'):.2f} ± {chance_error:.2f}",
               f"{published:g}", of.text("wall_seconds", 3), f"{published / of.seconds:.0f}",
               f"{dense.mean('packing_fraction'):.3f}"]


def larger_packings(build, packings):
    """In isotropic packings of correlated particles ρ − 1 ∝ N^(−1/2); in ordered ones it is independent of N."""
    chosen = [of for of in packings if aspect_ratios(of)[1] == 1 or aspect_ratios(of)[0] == 5]
    columns = {key: [of.values[key] for of in chosen] for key in (RATIOS, PARTICLES, FRACTION, RATE)}
    columns[PARTICLES] = [8 * particles for particles in columns[PARTICLES]]
    _, larger = sweep(build, TABLE_2, together(columns))
    for small, large in zip(chosen, larger, strict=True):
        ratios, particles = small.values[RATIOS].strip("[]"), small.values[PARTICLES]
        decrease = (small.ratio - 1) / (large.ratio - 1)
        low = large.ratio - large.half_width("orientation_ratio")
        expect(decrease > 2 or low <= large.mean("isotropic_ratio"),
               f"{ratios}: ρ = {small.ratio} at N = {particles}, {large.ratio} at {8 * particles}: not isotropic")
        yield [ratios, f"{small.values[FRACTION]:.0%}", particles,
               *(of.text("orientation_ratio", 2) for of in (small, large)), f"{decrease:.1f}"]


def examples(build):
    _, found = sweep(build, TABLE_2, together({key: column(EXAMPLES, k) for k, key in
                                               enumerate((RATIOS, PARTICLES, FRACTION), 1)}),
                     seeds(1), f"{RATE}={GROWTH_RATE}")
    _, drawn = sweep(build, "ghossein_figure_5")
    for name, of in zip((*column(EXAMPLES, 0), *DRAWN), (*found, *drawn), strict=True):
        yield [name, of.values[PARTICLES], f"{of.values[FRACTION]:.0%}", f"{of.ratio:.2f}",
               f"{of.mean('collisions'):.2e}", f"{of.seconds:.3g}"]


def jammed(build):
    _, found = sweep(build, TABLE_2, together({RATIOS: column(JAMMED_ROWS, 1), RATE: column(JAMMED_ROWS, 2)}), seeds(5),
                     f"{PARTICLES}=1000", UNTIL_JAMMED)
    for (name, _, rate, lowest, highest), of in zip(JAMMED_ROWS, found, strict=True):
        fraction = of.mean("packing_fraction")
        expect(lowest <= fraction <= highest, f"{name}: jammed at {fraction}, not between {lowest} and {highest}")
        contacts, isostatic = of.mean("contact_number"), of.mean("isostatic_number")
        expect(contacts < (1 + NEAR_CONTACTS) * isostatic, f"{name}: {contacts} contacts per particle")
        yield [name, f"{rate:g}", of.text("packing_fraction", 4), f"{lowest:g} – {highest:g}",
               of.text("contact_number", 2), f"{isostatic:g}", f"{of.mean('rattlers') / 1000:.1%}", f"{of.seconds:.3g}"]


def orientation_study(build):
    """Figure 6: ρ against N, with means and 95 % confidence intervals."""
    series = {}
    for of in sweep(build, "ghossein_figure_6")[1]:
        key = aspect_ratios(of)[0], of.values[FRACTION]
        point = of.values[PARTICLES], of.ratio, of.half_width("orientation_ratio")
        series.setdefault(key, []).append(point)
    return series


def exponent(points):
    """The slope of a linear fit to the logarithms."""
    x, y = ([math.log(p[k]) for p in points] for k in (0, 1))
    mx, my = statistics.mean(x), statistics.mean(y)
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)


def times(build):
    """Seconds against N (figure 7: R = 2, 30 %), volume fraction (8: N = 1000, R = 2) and R (9: N = 100, 5 %)."""
    figures = {"particles N": (7, lambda of: of.values[PARTICLES]),
               "volume fraction": (8, lambda of: of.values[FRACTION]),
               "aspect ratio R": (9, lambda of: aspect_ratios(of)[0])}
    return {name: [(place(of), of.seconds) for of in sweep(build, f"ghossein_figure_{number}")[1]]
            for name, (number, place) in figures.items()}


def draw(orientation, timed):
    plots = pyplot()
    from matplotlib import ticker  # only here: a test imports all validations

    figure, axes = plots.subplots(figsize=(6.4, 4.2))
    for (ratio, fraction), points in orientation.items():
        n, mean, error = zip(*points)
        axes.errorbar(n, mean, error, fmt="o-", capsize=3, label=f"R = {ratio}, {fraction:.0%}")
    axes.axhline(1, color="gray", linewidth=0.8)
    axes.set(xlabel="particles N", ylabel="ρ = λ_max/λ_min", xscale="log")
    axes.legend(frameon=False)
    axes.grid(alpha=0.3)
    figure.tight_layout()
    save_figure(figure, FIGURES, "orientation")

    figure, panels = plots.subplots(1, 3, figsize=(10.5, 3.6))
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
    figure.tight_layout()
    save_figure(figure, FIGURES, "times")


def measure(build):
    _, packings = sweep(build, TABLE_2)
    rows, larger = list(table_2(build, packings)), list(larger_packings(build, packings))
    dense, further = list(jammed(build)), list(examples(build))
    orientation, timed = orientation_study(build), times(build)
    draw(orientation, timed)
    slopes = {name: exponent(points) for name, points in timed.items()}
    isotropic = [f"R = {ratio}: from {points[0][1]:.2f} at N = {points[0][0]} to {points[-1][1]:.2f} ± {points[-1][2]:.2f} "
                 f"at N = {points[-1][0]}" for (ratio, _), points in orientation.items()]
    return f"""Ellipsoids with semi-axes a : a/R_1 : a/R_2 are inserted at random in a periodic cube at 1 % (or less) and grow during
event-driven dynamics. `vitrel sweep` runs the files `ghossein_*.toml` of `params/articles`, one job at a time. The growth
rate, of all lengths per unit of time, is that of the table, otherwise {GROWTH_RATE:g}. The exact check (tolerance zero) tests every
packing; the volume fraction agrees with the target to 1e-11. Seconds are those of the whole preparation. The table lists
means of {RUNS} runs with 95 % confidence intervals, and the ρ of as many random directions (*random ρ*). The target volume
fractions are the maximum values of the article. The last column lists the maximum reached by vitrel: the mean of three
packings grown at the rate {SLOW_RATE:g} to a reduced pressure of {JAMMED:g}. There Z ≈ 6/(1 − φ/φ_J), so the fraction is 6 millionths
below its limit. The article stops when 50 iterations gain less than 0.1 %.

{table(["shape", "R_1", "N", "volume fraction", "growth rate", "ρ", "random ρ", "published, s", "measured, s", "ratio", "maximum fraction"], rows)}

Where ρ exceeds its random value, neighbours are aligned. Platelets of aspect ratio 20 and above are nematic at these
fractions in equilibrium; at higher growth rates they jam before reaching them. The packings as a whole are isotropic: with
eight times as many particles, ρ − 1 decreases by a factor of {min(float(row[-1]) for row in larger):g} or more. The expected factor is √8 = 2.8; in an ordered
packing ρ − 1 would not decrease.

{table(["R_1, R_2", "volume fraction", "N", "ρ", "ρ at 8 N", "decrease of ρ − 1"], larger)}

The published times were measured with MATLAB at 1.6 GHz, the others on one core of {processor()}.

{table(["shape", "N", "volume fraction", "ρ", "collisions", "seconds"], further)}

The last two packings are those of figure 5: all particles have the same semi-axis a, and R_1 and R_2 are uniform.

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
