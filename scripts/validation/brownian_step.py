"""Accuracy and cost of the step of Brownian dynamics: params/brownian_step.toml."""

import collections
import tempfile

from validation.common import PARAMS, expect, processor, pyplot, save_figure, summary_of, table, text_of

TITLE = "The step of Brownian dynamics"
STEP, FRACTION = "dynamics.brownian_step", "system.packing_fraction"
# Of the relaxation time, up to this many mean gaps, and at least beyond the warning (workflow/run/brownian_step.h).
SHORT, LARGEST_ERROR = 0.75, 0.04
LONG, SMALLEST_ERROR = 3.0, 0.05


class Point:
    """One step at one packing fraction, averaged over seeds."""

    def __init__(self, average):
        figures = average["figures"]
        self.step, self.fraction = average["values"][STEP], average["values"][FRACTION]
        scale = self.step / 2  # D₀

        def times(name):
            return tuple(scale * figures[name][part] for part in ("mean", "error"))

        self.translation, self.rotation = times("tau_translation"), times("tau_rotation")
        self.gaps = figures["brownian_step_in_gaps"]["mean"]
        self.seconds = figures["wall_seconds"]["mean"] / (scale * average["values"]["dynamics.duration"])

    def deviation(self, shortest):
        """Of the relaxation time of translation from that with the shortest step."""
        return self.translation[0] / shortest.translation[0] - 1

    def error(self, shortest):
        return sum((error / mean)**2 for mean, error in (self.translation, shortest.translation))**0.5


def drawn(densities):
    figure, (cost, gaps) = pyplot().subplots(1, 2, figsize=(9, 3.6), layout="constrained", sharey=True)
    for fraction, points in densities.items():
        others = points[1:]
        values = [100 * point.deviation(points[0]) for point in others]
        errors = [100 * point.error(points[0]) for point in others]
        for axes, x in ((cost, [point.seconds for point in others]), (gaps, [point.gaps for point in others])):
            axes.errorbar(x, values, yerr=errors, marker="o", markersize=4, linewidth=1, label=f"φ = {fraction:g}")
    cost.set(xscale="log", yscale="log", ylim=(0.3, 300), xlabel="s per D₀ t = 1", ylabel="deviation of τα / %")
    gaps.set(xscale="log", xlabel="√(kT/m) τ_B / mean gap")
    for axes in (cost, gaps):
        axes.grid(alpha=0.25)
    gaps.legend(frameon=False, fontsize="small")
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
            expect(point.gaps > SHORT or deviation <= LARGEST_ERROR + 2 * error,
                   f"φ = {fraction:g}, τ_B = {point.step:g}: off by {deviation:.1%}")
            expect(point.gaps < LONG or deviation >= SMALLEST_ERROR - 2 * error,
                   f"φ = {fraction:g}, τ_B = {point.step:g}: warned of in vain, off by {deviation:.1%}")
            lines.append([f"{fraction:g}", f"{point.step:g}", f"{point.gaps:.2f}", text_of(*point.translation, 4),
                          text_of(*point.rotation, 4), "–" if point is points[0] else f"{100 * deviation:.1f} ± {100 * error:.1f}",
                          f"{point.seconds:.3f}"])
    drawn(densities)
    head = ["φ", "τ_B", "τ_B in mean gaps", "D₀ τα", "D₀ τ₂", "deviation of τα / %", "s per D₀ t = 1"]
    return f"""
`params/brownian_step.toml`: 400 ellipses, κ = 2, sizes spread by 10 %, four seeds. With D₀ = τ_B/2, relaxation times in
units of 1/D₀ no longer depend on the step where it is short beside the time between two collisions of a particle, in which
it flies a mean gap. Deviations are those from the shortest step. Runs with steps of more than two mean gaps say so, in
`--dry-run` by theory and at the end as measured. One core of an {processor()}.

![Deviation against cost and against the step in mean gaps](figures/brownian_step.svg)

{table(head, lines)}
"""
