"""Figures of collision times and overlap criteria, from the data of vitrel-bench."""

import math

from validation.common import pyplot

COLOURS = ["#0072b2", "#c65200", "#00805c", "#b1407f", "#8a7a00", "#6a4fc4", "#a8281c", "#3c434b"]
MARKERS = "osD^"
ONE, TWO, OVERLAP = "#1f78c8", "#d9822b", "#c8374d"
SMALLEST_ERROR, SMALLEST_GAP = 1e-17, 1e-13  # smaller values are drawn there


def chart(title, x, y, log="xy", size=(8.4, 4.8)):
    """An empty chart with these titles; `log` names its logarithmic axes."""
    figure, axes = pyplot().subplots(figsize=size, layout="constrained")
    axes.set(title=title, xlabel=x, ylabel=y, **{f"{axis}scale": "log" for axis in log})
    axes.title.set_fontsize("medium")
    axes.grid(alpha=0.25)
    return figure, axes


def points(axes, name, k, shown):
    """A line with a marker for each (x, y, hollow); `k` selects its colour and marker."""
    colour, marker = COLOURS[k % len(COLOURS)], MARKERS[k // len(COLOURS) % len(MARKERS)]
    axes.plot([x for x, _, _ in shown], [y for _, y, _ in shown], color=colour, linewidth=0.8, zorder=1)
    for hollow in (False, True):
        part = [(x, y) for x, y, h in shown if h == hollow]
        axes.scatter([x for x, _ in part], [y for _, y in part], s=30, marker=marker, linewidths=1.3, edgecolors=colour,
                     facecolors="white" if hollow else colour, zorder=2)
    axes.plot([], [], color=colour, marker=marker, linewidth=0.8, label=name)


def legend(figure, axes, notes=()):
    """A legend beside the chart, below the notes."""
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1), borderaxespad=0, frameon=False, fontsize="small",
                title="\n".join(notes), title_fontsize="small", alignment="left")
    return figure


def floor(axes, value, label):
    """Marks the lower limit at which smaller values are drawn."""
    axes.axhline(value, color="black", linewidth=0.6, linestyle=":")
    axes.annotate(label, (0.5, value), xycoords=("axes fraction", "data"), ha="center", va="bottom", fontsize="small")


def by_method(rows):
    grouped = {}
    for row in rows:
        grouped.setdefault(row["method"], []).append(row)
    return grouped.items()


def curve_name(row):
    """Random pairs are the rule; a method on another class of pairs is a curve of its own."""
    return row["method"] if row["class"] == "generic" else f"{row['method']}, {row['class']}"


def speed_figure(rows, error):
    """Time per call against the "median_error" or "largest_error", a point per tolerance."""
    which = error.replace("_", " ")
    figure, axes = chart(f"Time per prediction against its {which} (random pairs, κ = {rows[0]['aspect_ratio']:g})",
                         "time per call / ns", f"{which} of the time / horizon")
    answered = [{**row, "method": curve_name(row)} for row in rows if row["not_converged"] < row["pairs"]]
    for k, (method, of) in enumerate(by_method(answered)):
        points(axes, method, k, [(row["ns_per_call"], max(row[error], SMALLEST_ERROR), row["correct"] < row["pairs"])
                                 for row in of if row[error] is not None])
    if any(row[error] is not None and row[error] <= SMALLEST_ERROR for row in answered):
        floor(axes, SMALLEST_ERROR, "≤ 10⁻¹⁷")
    return legend(figure, axes, ["one point per tolerance", "hollow: some answers missing,", "false, or off by more than 1 %"])


def overlap_figure(rows):
    """Time of pairs near contact against the largest gap for which a criterion is wrong, of the first aspect ratio."""
    kappa = rows[0]["aspect_ratio"]
    figure, axes = chart(f"Time per overlap test against the largest gap answered wrongly (κ = {kappa:g})", "time per call / ns",
                         "largest gap answered wrongly / semi-minor axis")
    series = {}
    for method, of in by_method(row for row in rows if row["aspect_ratio"] == kappa):
        near = next((row for row in of if row["class"] == "near_contact"), of[0])
        wrong = any(row["wrong_overlap"] + row["wrong_disjoint"] for row in of)
        name = "polygons" if method.startswith("polygon") else method
        gap = max(row["largest_wrong_gap"] for row in of)
        series.setdefault(name, []).append((near["ns_per_call"], max(gap, SMALLEST_GAP), wrong))
    for k, (name, shown) in enumerate(series.items()):
        points(axes, name, k, shown)
    floor(axes, SMALLEST_GAP, "≤ 10⁻¹³")
    return legend(figure, axes, ["filled: no pair wrong; hollow: some are", "polygons: 8, 16 … 256 vertices"])


def whole_run_figure(runs):
    """Collisions per second against correction moves per 1000 collisions, a point per tolerance."""
    figure, axes = chart("The scene of the thesis: speed against correction moves", "collisions per second",
                         "correction moves per 1000 collisions")
    none = 10 ** (math.ceil(math.log10(1000 / max(1, *(run["collisions"] for run in runs)))) - 1)
    for k, (method, of) in enumerate(by_method(runs)):
        points(axes, method, k, [(run["collisions_per_second"], max(1000 * run["correction_moves"] / run["collisions"], none),
                                  run["stood_still"]) for run in of if run["collisions"]])
    floor(axes, none, "none")
    return legend(figure, axes, ["one point per tolerance", "hollow: the run stood still"])


def curve_figure(title, x, y, name, marks):
    """A curve with its zeros marked: [(x, label, height of the label)]."""
    figure, axes = chart(title, "time t", name, log="", size=(6.8, 4))
    axes.axhline(0, color="black", linewidth=0.6)
    axes.plot(x, y, color=COLOURS[0])
    for at, label, height in marks:
        axes.plot([at], [0], "o", color=OVERLAP)
        axes.annotate(label, (at, 0), xytext=(14, height), textcoords="offset points",
                      arrowprops={"arrowstyle": "-", "linewidth": 0.6})
    return figure, axes


def scene_figure(data, key, name):
    what = {"d": "distance", "psi": "contact function"}[key]
    first, path = data["scene"][0]["time"], data["scene_path"]
    marks = [(first, f"first contact, t = {first:.4f}", 40), (1, "touching again, t = 1", 40)]
    return curve_figure(f"Two ellipses that touch, overlap and touch again: {what}", path["time"], path[key], name, marks)[0]


def passing_pair_figure(pair):
    """η₁ around the overlap of two passing ellipsoids, with the samples of a scan."""
    curve, scan = pair["eta1"]["curve"], pair["eta1"]["scan"]
    figure, axes = curve_figure("Two ellipsoids pass and overlap for a moment: η₁(t)", curve["time"], curve["eta1"], "η₁",
                                [(pair["contact"], f"contact, t = {pair['contact']:.4f}", 60)])
    axes.plot(scan["time"], scan["eta1"], "s", color=TWO, label=f"samples of a scan in {pair['eta1']['scan_steps']} steps")
    axes.legend(frameon=False)
    return figure


def ellipse(of, **style):
    from matplotlib.patches import Ellipse  # needed only to draw

    return Ellipse((of["x"], of["y"]), 2 * of["a"], 2 * of["b"], angle=math.degrees(of["angle"]), **style)


def draw_pair(axes, picture, velocity):
    one, two = picture["ellipses"]
    for of, colour in ((one, ONE), (two, TWO)):
        axes.add_patch(ellipse(of, facecolor=colour, alpha=0.16))
        axes.add_patch(ellipse(of, facecolor="none", edgecolor=colour, linewidth=1.4))
    if picture["overlap"]:
        both = axes.add_patch(ellipse(two, facecolor=OVERLAP, alpha=0.75))
        both.set_clip_path(ellipse(one, transform=axes.transData))
    speed = math.hypot(*velocity)
    if picture["time"] == 0 and speed > 0:
        tip = (two["x"] + 0.34 * velocity[0] / speed, two["y"] + 0.34 * velocity[1] / speed)
        axes.annotate("", tip, (two["x"], two["y"]), arrowprops={"arrowstyle": "-|>", "shrinkA": 0, "shrinkB": 0})
    axes.set(xlim=(-1, 1), ylim=(-1, 1), aspect="equal", xticks=[], yticks=[])
    axes.set_title(f"{picture['title']}\nt = {picture['time']:.9g}", fontsize="medium", loc="left")


def failing_pair_figure(failure):
    """Both ellipses at the times that show how a method failed, each panel with its own scale."""
    pictures = failure["pictures"]
    figure, panels = pyplot().subplots(1, len(pictures), figsize=(2.9 * len(pictures), 3.3), squeeze=False, layout="constrained")
    for axes, picture in zip(panels[0], pictures):
        draw_pair(axes, picture, failure["relative_velocity"])
    return figure
