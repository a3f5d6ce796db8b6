"""{seeds} runs of each system differ in nothing but their seed. The table has the scatter of the runs over their stated
error, pooled over the points of a curve; the 95 % intervals of these ratios are {width:.2f} wide on average. All ratios lie
between {LEAST} and {MOST}. Of all values {covered:.0%} are within one stated error of the mean, which should be 68 %.
"none": most runs are too short for an error, and state none. Columns that differ in a number n share a row, which has the
smallest and the largest ratio.

{bias}

{table}
"""

import json
import math
import pathlib
import re
import statistics
import tempfile
import textwrap

from validation.common import expect, settings, summary_of, table
from validation.comparison import SCENES, SEED

TITLE = "Error bars against the scatter of seeds"
INPUTS = ["analysis", "core", "edmd", "mc", "workflow/analyze", "workflow/run"]
SEEDS = range(1, 161)
# Scatter over stated error. With 160 seeds of normal values the ratio itself has an error of 6 %.
LEAST, MOST = 0.8, 1.25
MOST_REFUSED = 5
RESAMPLES = 400

# Parameter files in scenes/coverage. Fewer time differences than by default say the same of a curve.
SYSTEMS = ("disks", "ellipses", "brownian_ellipses", "short", "mixture", "polydisperse", "spheres", "brownian_spheroids", "soft",
           "until_known", "compressed")
# What runs of different lengths have in common.
OF_ANY_LENGTH = ("quality report", "summary", "relaxation:", "relaxation_times")


def prepared(folder):
    """What the preparation of a job states with an error."""
    state = json.loads((folder / "prepare.json").read_text(encoding="utf-8"))
    last = state["stages"][-1]
    if (mean := last.get("mean_packing_fraction")) is not None:
        # Compressed to a pressure, each state has a density of its own, and a reduced pressure of its own.
        return {"compression: packing_fraction": (mean, last["mean_packing_fraction_error"])}
    report = state.get("quality")  # of a state in the plane; in space the summary itself
    pressure = report["reduced_pressure"] if report else {"value": state["reduced_pressure"],
                                                          "error": state["reduced_pressure_error"]}
    return {"quality report: reduced_pressure": (pressure["value"], pressure["error"])}


def measured(folder):
    """All quantities of a job that have an error, by table and column: values and errors."""
    import h5py  # only here: a test imports all validations

    found = prepared(folder)
    if not (folder / "results.h5").exists():
        return found
    with h5py.File(folder / "results.h5") as results:
        for group in results.values():
            if not isinstance(group, h5py.Group):
                continue
            for name in group:
                if f"{name}_error" in group:
                    found[f"{group.name[1:]}: {name}"] = group[name][()], group[f"{name}_error"][()]
    return found


def sampled(build, name, seeds=SEEDS):
    """Arrays seeds × points of the values and the errors of every quantity of a system."""
    import numpy

    with tempfile.TemporaryDirectory() as folder:
        sweep = pathlib.Path(folder)
        summary_of(build, "sweep", SCENES / "coverage" / f"{name}.toml", "-o", sweep, "-j", "2", "--quiet",
                   *settings([f'sweep.grid={{ "{SEED}" = {list(seeds)} }}']))
        runs = [measured(sweep / f"seed-{seed}") for seed in seeds]
    found = {}
    for quantity in runs[0]:
        pairs = [[numpy.atleast_1d(numpy.asarray(x, dtype=float)) for x in run[quantity]] for run in runs]
        if len({len(value) for value, _ in pairs}) == 1 and (name != "until_known" or quantity.startswith(OF_ANY_LENGTH)):
            # else the points differ, as distances in boxes that do, and times in runs of different lengths
            found[quantity] = tuple(numpy.array(part) for part in zip(*pairs))
    return found


def ratio(values, errors):
    """Scatter over stated error, pooled over the points of a curve, with its 95 % interval from resampled seeds; None
    where most runs state no error.
    """
    import numpy

    stated = numpy.isfinite(errors) & (errors > 0)
    points = stated.mean(axis=0) > 0.8
    if not points.any():
        return None
    values, errors = (numpy.where(stated, x, numpy.nan)[:, points] for x in (values, errors))

    def pooled(rows):
        scatter = numpy.nanvar(values[rows], axis=0, ddof=1)
        return math.sqrt(numpy.mean(scatter / numpy.nanmean(errors[rows]**2, axis=0)))

    seeds = len(values)
    random = numpy.random.default_rng(1)
    resampled = [pooled(random.integers(seeds, size=seeds)) for _ in range(RESAMPLES)]
    low, high = numpy.quantile(resampled, (0.025, 0.975))
    return pooled(numpy.arange(seeds)), low, high


def coverage(values, errors):
    """The share of values within one stated error of the mean over the seeds, pooled over the points."""
    import numpy

    stated = numpy.isfinite(errors) & (errors > 0)
    mean = numpy.nanmean(numpy.where(stated, values, numpy.nan), axis=0)
    return (numpy.abs(values - mean) < errors)[stated].mean()


class Judged:
    """Ratio, its interval and the coverage of a quantity of a system, and whether the ratio is as it should be."""

    def __init__(self, values, errors):
        found = ratio(values, errors)
        self.refused = found is None
        self.right = self.refused
        if found:
            self.ratio, self.low, self.high = found
            self.covered = coverage(values, errors)
            self.right = LEAST <= self.ratio <= MOST

    def cell(self):
        return "none" if self.refused else f"{self.ratio:.2f}"


def bias_text(of_systems):
    """By what relaxation times differ on average if runs end as soon as these are known, from runs of the same seeds that
    do not.
    """
    (known, _), (fixed, _) = (of_systems[system] for system in ("until_known", "brownian_ellipses"))
    texts = []
    for relative in (known / fixed - 1).T:
        bias, error = relative.mean(), relative.std(ddof=1) / math.sqrt(len(relative))
        expect(abs(bias) < 0.01 + 3.5 * error, f"to end when relaxation is known biases its time by {bias:.2g}")
        texts.append(f"{100 * bias:.1f} ± {100 * error:.1f} %")
    return textwrap.fill("Runs that end as soon as their relaxation is known, some after 180 units of time and the others after 360, differ in "
                         f"their relaxation times from runs of the same seeds for 300 units of time by {', '.join(texts)} on average.", 120)


def varies(values):
    """Whether it differs between seeds: not if it is conserved, or no quantity of these particles."""
    import numpy

    spread = numpy.nanstd(values, axis=0) if numpy.isfinite(values).any() else numpy.zeros(1)
    return bool((spread > 1e-9 * numpy.abs(numpy.nanmean(values))).any())


def families(quantities):
    """Those that differ in numbers only, by the name that they share."""
    found = {}
    for quantity in sorted(quantities):
        found.setdefault(re.sub(r"_\d+$", "_n", quantity), []).append(quantity)
    return {name if len(of) > 1 else of[0]: of for name, of in found.items()}


def range_of(texts):
    return "–".join(sorted({min(texts), max(texts)})) if texts else ""


def measure(build):
    judged, relaxation_times = {}, {}
    for system in SYSTEMS:
        found = sampled(build, system)
        relaxation_times[system] = found.get("relaxation_times: tau")
        for quantity, (values, errors) in found.items():
            if varies(values):
                judged.setdefault(quantity, {})[system] = Judged(values, errors)
    wrong = [f"{quantity} of {system}: {one.cell()}" for quantity, of_systems in judged.items()
             for system, one in of_systems.items() if not one.right]
    refused = [quantity for quantity, of_systems in judged.items() if any(one.refused for one in of_systems.values())]
    expect(not wrong, "errors do not cover: " + "; ".join(wrong))
    expect(len(refused) <= MOST_REFUSED, f"{len(refused)} quantities are refused: " + ", ".join(refused))
    rows = [[name, *(range_of([judged[one][system].cell() for one in quantities if system in judged[one]]) for system in SYSTEMS)]
            for name, quantities in families(judged).items()]
    known = [one for of_systems in judged.values() for one in of_systems.values() if not one.refused]
    return {"seeds": len(SEEDS), "bias": bias_text(relaxation_times), "width": statistics.mean(one.high - one.low for one in known),
            "covered": statistics.mean(one.covered for one in known),
            "table": table(["quantity", *(system.replace("_", " ") for system in SYSTEMS)], rows)}
