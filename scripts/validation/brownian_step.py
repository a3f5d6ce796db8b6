"""Accuracy and cost of the step of Brownian dynamics: params/brownian_step.toml."""

import collections
import tempfile

from validation.common import PARAMS, expect, processor, pyplot, save_figure, summary_of, table, text_of

TITLE = "The step of Brownian dynamics"
STEP, FRACTION = "dynamics.brownian_step", "system.packing_fraction"
# Deviations of the relaxation time of translation: with steps up to the default, and from those on that are warned of.
DEFAULT, LARGEST = 0.1, 0.04
LONG, SMALLEST = 0.3, 0.06


class Point:
    """One step at one packing fraction, averaged over seeds."""

    def __init__(self, average):
        figures = average["figures"]
        self.step, self.fraction = average["values"][STEP], average["values"][FRACTION]
        scale = self.step / 2  # D₀

        def times(name):
            return tuple(scale * figures[name][part] for part in ("mean", "error"))

        self.translation, self.rotation = times("tau_translation"), times("tau_rotation")
        self.seconds = figures["wall_seconds"]["mean"] / (scale * average["values"]["dynamics.duration"])

    def deviation(self, shortest):
        """Of the relaxation time of translation from that with the shortest step."""
        return self.translation[0] / shortest.translation[0] - 1

    def error(self, shortest):
        return sum((error / mean)**2 for mean, error in (self.translation, shortest.translation))**0.5


def drawn(densities):
    figure, axes = pyplot().subplots(1, 2, figsize=(9, 3.6), layout="constrained", sharey=True)
    for fraction, points in densities.items():
        others = points[1:]
        values, errors = ([100 * number(point) for point in others]
                          for number in (lambda point: point.deviation(points[0]), lambda point: point.error(points[0])))
        for place, x in zip(axes, ([point.seconds for point in others], [point.step for point in others])):
            place.errorbar(x, values, yerr=errors, marker="o", markersize=4, linewidth=1, label=f"φ = {fraction:g}")
    for place, label in zip(axes, ("s per D₀ t = 1", "τ_B")):
        place.set(xscale="log", yscale="symlog", ylim=(-2, 300), xlabel=label)
        place.grid(alpha=0.25)
    axes[0].set_ylabel("deviation of τα / %")
    axes[1].legend(frameon=False, fontsize="small")
    save_figure(figure, "figures", "brownian_step")


def measure(build):
    with tempfile.TemporaryDirectory() as folder:
        summary = summary_of(build, "sweep", PARAMS / "brownian_step.toml", "-o", folder, "-j", "2")
    densities = collections.defaultdict(list)
    for average in summary["seeds"]:
        point = Point(average)
        densities[point.fraction].append(point)
    lines = []
    for fraction, points in densities.items():
        points.sort(key=lambda point: point.step)
        for point in points:
            deviation, error = point.deviation(points[0]), point.error(points[0])
            what = f"φ = {fraction:g}, τ_B = {point.step:g}: off by {deviation:.1%} ± {error:.1%}"
            expect(point.step > DEFAULT or deviation <= LARGEST + 2 * error, what)
            expect(point.step < LONG or deviation >= SMALLEST - 2 * error, what + ", which is warned of")
            lines.append([f"{fraction:g}", f"{point.step:g}", text_of(*point.translation, 4), text_of(*point.rotation, 4),
                          "–" if point is points[0] else f"{100 * deviation:.1f} ± {100 * error:.1f}", f"{point.seconds:.3f}"])
    drawn(densities)
    return f"""
`params/brownian_step.toml`: 400 ellipses, κ = 2, sizes spread by 10 %, four seeds. In units of 1/D₀, with D₀ = τ_B/2,
relaxation times no longer depend on the step where it is short. Deviations are those from the shortest step. What decides
is how far a particle flies in a step, √(kT/m) τ_B, beside its size: the same step is off by nearly the same at all densities,
whether it is a fraction of the mean gap between particles or many of them. Runs whose step exceeds 0.2 of the
size of a typical particle say so, in `--dry-run` and at the end. One core of an {processor()}, two jobs at a time.

![Deviation against cost and against the step](figures/brownian_step.svg)

{table(["φ", "τ_B", "D₀ τα", "D₀ τ₂", "deviation of τα / %", "s per D₀ t = 1"], lines)}
"""
