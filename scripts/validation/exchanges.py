"""Time to forget a dense polydisperse liquid, with and without exchanges of places: bench/exchanges.{md,svg,csv}."""

import csv
import datetime
import math

from validation.common import ROOT, clock_rate, commit_of, expect, measured, processor, pyplot, table, write_figure
from validation.figures import COLOURS, MARKERS, legend

TITLE = "Exchanges of places"
PAGE = ROOT / "bench" / "exchanges.md"
FIGURE = ROOT / "bench" / "exchanges.svg"
DATA = ROOT / "bench" / "exchanges.csv"

LIQUIDS = {"disks": "disks", "ellipses": "ellipses, κ = 2", "spheres": "spheres"}
QUANTITIES = ("places", "orientations", "sizes")
MOTION, COLLECTIVE = "motion", "chains, collective exchanges"


def time_text(time):
    return "–" if not time else f"{time['seconds']:.3g} ± {time['error']:.1g}" if time["times"] > 1 else f"{time['seconds']:.2g}"


def accepted(method):
    """The share of its exchanges, or of the steps of collective ones, that are accepted."""
    return method.get("exchanges_accepted", method.get("steps_accepted"))


def sweep_time(method):
    """Microseconds per sweep."""
    return f"{1e6 * method['seconds'] / method['sweeps']:.0f}"


def times(rows, quantity):
    """A line per state, a column per method."""
    methods = list(dict.fromkeys(method["method"] for row in rows for method in row["methods"]))
    lines = []
    for row in rows:
        texts = {method["method"]: time_text(method.get(quantity)) for method in row["methods"]}
        lines.append([row["packing_fraction"], *(texts.get(method, "") for method in methods)])
    return table(["φ", *methods], lines)


def states(rows):
    """A table for each quantity."""
    known = [q for q in QUANTITIES if any(method.get(q) for row in rows for method in row["methods"])]
    return "\n\n".join(f"Seconds until the {q} are forgotten:\n\n{times(rows, q)}" for q in known)


def write_data(data):
    """Writes a line per state and method as CSV."""
    with open(DATA, "w", encoding="utf-8", newline="") as file:
        lines = csv.writer(file, lineterminator="\n")
        columns = [f"{quantity}{end}" for quantity in QUANTITIES for end in ("", "_error")]
        lines.writerow(["liquid", "packing_fraction", "method", *columns, "accepted", "microseconds_per_sweep"])
        for liquid, row in ((liquid, row) for liquid in LIQUIDS for row in data[liquid]):
            for method in row["methods"]:
                found = [method.get(q) or {"seconds": None, "error": None} for q in QUANTITIES]
                lines.writerow([liquid, row["packing_fraction"], method["method"],
                                *(time[key] for time in found for key in ("seconds", "error")),
                                accepted(method), sweep_time(method)])


def curves(rows, quantity):
    """(φ, seconds, error) of every method that forgot this quantity more than once."""
    found = {}
    for row in rows:
        for method in row["methods"]:
            time = method.get(quantity)
            points = found.setdefault(method["method"], [])
            if time and time["times"] > 1:
                points.append((row["packing_fraction"], time["seconds"], time["error"]))
    return found


def draw(data, file):
    figure, all_axes = pyplot().subplots(1, 3, figsize=(12.5, 4.2), sharey=True, layout="constrained")
    for axes, (key, name) in zip(all_axes, LIQUIDS.items()):
        for k, (method, points) in enumerate(curves(data[key], "sizes").items()):
            axes.errorbar([p[0] for p in points], [p[1] for p in points], yerr=[p[2] for p in points], label=method,
                          color=COLOURS[k % len(COLOURS)], marker=MARKERS[k % len(MARKERS)], markersize=5, linewidth=1)
        axes.set(title=name, xlabel="packing fraction φ", yscale="log")
        axes.title.set_fontsize("medium")
        axes.grid(alpha=0.25)
    all_axes[0].set_ylabel("processor time until sizes are forgotten / s")
    write_figure(legend(figure, all_axes[-1]), file)


def choices(rows):
    """A line per choice, beside local moves and beside chains."""
    lines = {}
    for method in (method for row in rows for method in row["methods"]):
        beside, choice = method["method"].split(" ", 1)
        lines.setdefault(choice, {})[beside] = [*(time_text(method.get(q)) for q in ("places", "sizes")),
                                                f"{accepted(method):.3f}", sweep_time(method)]
    head = [f"{beside}: {what}" for beside in ("local", "chains") for what in ("places, s", "sizes, s", "accepted", "µs")]
    return table(["trials", "partners", "steps", *head],
                 [[*choice.split(), *line["local"], *line["chains"]] for choice, line in lines.items()])


def page(data):
    psi = " and ".join(f"{data[key]:.1f}" for key in ("ns_per_psi", "ns_per_psi_at_the_end"))
    growth, gains = speed_ups(data["disks"])
    liquids = "\n\n".join(f"## {name[0].upper() + name[1:]}\n\n{states(data[key])}" for key, name in LIQUIDS.items())
    return f"""# How long does each method take to forget a dense polydisperse liquid?

    scripts/validate exchanges                            # builds, measures and writes this page
    build/release/bench/vitrel-bench exchanges disks choices      # parts of it, as JSON

Measured on {datetime.date.today()}, commit {commit_of(data)}, {processor()}{clock_rate()}, {data["compiler"]}, `{data["flags"]}`.
Calibration: {psi} ns per Ψ (the function of Vieillard-Baron of two ellipses, from their angles; at the
beginning and at the end of the run).

N = {data["disks"][0]["particles"]} particles with sizes σ distributed as σ⁻³ between 0.45 and 1 of the largest, a standard deviation of 23 %. Every
state is mixed by event chains with collective exchanges. Each method then runs on one thread until it has forgotten the
state 30 times, or for 10 s; motion, with which the others are compared, for up to 150 s until it has forgotten three
times. A method that has not forgotten a state is left out of the denser ones. Compared are the state at the beginning and the present one, whatever the numbers of the
particles: sums over pairs of particles of both whose centres are closer than 0.3 (V/N)^(1/D), relative to the motion of
all. *Places* counts such pairs, *orientations* adds cos 2Δθ of the axes, *sizes* the product of the deviations of the sizes
from their mean. Forgotten is what has fallen to 1/e of what is more than chance. Times are processor time, their errors
standard errors; a dash says that the method did not forget within its time. [These times](exchanges.csv), the shares of
accepted exchanges and the times per sweep are kept as CSV.

*Exchanges* are those of `mc/exchanges.h`: of any two particles, of two close in size (a tenth of the ranks), and collective
ones.

![Processor time until the sizes are forgotten against the packing fraction, of all methods]({FIGURE.name})

{liquids}

## Speed-up over motion

How many times as fast event chains with collective exchanges forget the places of disks as motion does. The times of motion
grow by a factor of {growth} over the densities where they were measured more than once. Beyond, a ratio is that to the law of Vogel and Fulcher
fitted to them, if they grow by 1000 or more, up to {MAX_EXTRAPOLATION:.0f} times the longest time measured. Farther away only the lower limit
is given, by the law or because motion does not become faster.

{gains}

## Choices

Disks at φ = {data["choices"][0]["packing_fraction"]}. A share of the local moves are exchanges of two (*trials*), among this share of the ranks
(*partners*); beside event chains there are as many per particle and sweep. *Steps* are those of collective exchanges per
particle and sweep, *µs* the time per sweep.

{choices(data["choices"])}
"""


def gain(row, method, other, quantity="sizes"):
    """How many times as fast one method forgets as another; nothing if one does not."""
    times = {m["method"]: m.get(quantity) for m in row["methods"]}
    if not times.get(method) or not times.get(other):
        return None
    return times[other]["seconds"] / times[method]["seconds"]


# ---- the speed-up over motion ----------------------------------------------------------------------------

CONFIDENCE = 2.71  # rise of χ² that leaves 5 % on one side
MAX_EXTRAPOLATION = 1e3  # of times of motion over the longest one measured
MIN_GROWTH = 1e3  # of the times of motion: a law is fitted only to three decades


def fitted(points, phi_c, at):
    """χ² of ln t = c + s φ/(φ_c − φ), weighted by the errors of ln t, and ln t at another φ by this law."""
    def x(phi):
        return phi / (phi_c - phi)

    rows = [(x(phi), math.log(t), (t / error) ** 2) for phi, t, error in points]
    weight = sum(w for _, _, w in rows)
    mean_x, mean_y = (sum(row[k] * row[2] for row in rows) / weight for k in (0, 1))
    slope = sum(w * (a - mean_x) * (b - mean_y) for a, b, w in rows) / sum(w * (a - mean_x) ** 2 for a, _, w in rows)
    chi = sum(w * (b - mean_y - slope * (a - mean_x)) ** 2 for a, b, w in rows)
    return chi, mean_y + slope * (x(at) - mean_x)


def extrapolated(points, at):
    """The time at this density by the law of Vogel and Fulcher, or infinity if that is too far away, and its lower 95 % limit:
    that of all φ_c whose χ² is within 2.71 of the minimum, all errors enlarged where the law does not fit. None if the law
    diverges before, or the limit is too far away.
    """
    highest = max(points[-1][0], at)
    tried = [fitted(points, highest + 10 ** (-4 + 0.002 * k), at) for k in range(2000)]
    minimum = min(chi for chi, _ in tried)
    scale = max(1, minimum / max(1, len(points) - 3))
    lowest = min(value for chi, value in tried if chi <= minimum + CONFIDENCE * scale)
    farthest = math.log(MAX_EXTRAPOLATION * points[-1][1])
    if min(tried) == tried[0] or lowest > farthest:
        return None
    return math.exp(min(tried)[1]) if min(tried)[1] <= farthest else math.inf, math.exp(lowest)


def speed_ups(rows, quantity="places"):
    """How many times as fast collective exchanges forget as motion, at every density: measured or, where motion is too slow,
    by the law fitted to it, or more than if motion became no slower.
    """
    motion = [point for point in curves(rows, quantity).get(MOTION, []) if point[2]]
    has_law = len(motion) >= 5 and motion[-1][1] >= MIN_GROWTH * motion[0][1]
    lines = []
    for phi, seconds, error in curves(rows, quantity).get(COLLECTIVE, []):
        known = next(((t, e) for at, t, e in motion if at == phi), None)
        if known:
            ratio = known[0] / seconds
            relative = math.hypot(known[1] / known[0], error / seconds)
            lines.append([phi, f"{ratio:.3g} ± {ratio * relative:.1g}", f"{ratio * math.exp(-1.645 * relative):.3g}", "measured"])
        elif found := extrapolated(motion, phi) if has_law else None:
            value, lower = found
            lines.append([phi, f"{value / seconds:.2g}" if value < math.inf else "–",
                          f"{lower / seconds * math.exp(-1.645 * error / seconds):.2g}", "by the law"])
        elif motion:
            last, last_error = motion[-1][1:]
            relative = math.hypot(last_error / last, error / seconds)
            lines.append([phi, "–", f"{last / seconds * math.exp(-1.645 * relative):.3g}", f"motion as at {motion[-1][0]}"])
    growth = f"{motion[-1][1] / motion[0][1]:.3g}" if motion else "–"
    return growth, table(["φ", "ratio", "lower 95 % limit", ""], lines)


def check(rows):
    """Where motion of disks and spheres is slow but can still be measured, collective exchanges must be faster. Ellipses, which
    turn, relax by motion up to higher densities.
    """
    gains = [(row["packing_fraction"], gain(row, COLLECTIVE, MOTION)) for row in rows]
    known = [(phi, value) for phi, value in gains if value]
    expect(known and known[-1][1] > 2, f"collective exchanges gain too little: {known}")


def measure(_build):
    data = measured("exchanges", "release")
    PAGE.write_text(page(data), encoding="utf-8")
    draw(data, FIGURE)
    write_data(data)
    for key in ("disks", "spheres"):
        check(data[key])
    return f"""This command writes [How long does each method take to forget a dense polydisperse liquid?](../bench/exchanges.md).
Required of disks and spheres: at the highest density that motion forgets within its time, event chains with collective
exchanges are more than twice as fast. Ellipses, which turn, relax by motion up to higher densities.

![Processor time until the sizes are forgotten against the packing fraction, of all methods](../bench/exchanges.svg)
"""
