"""The glass of ellipses and disks, prepared where dynamics cannot go: rewrites docs/glass.md and its figures."""

import json
import math
import pathlib
import re
import shutil
import tempfile
import textwrap
import tomllib

from validation.common import PARAMS, ROOT, estimate, expect, output_of, save_charts, summary_of, table
from validation.comparison import toml

TITLE = "The glass"
PAGE = ROOT / "docs" / "glass.md"
FIGURES = ROOT / "docs" / "figures" / "glass"
DATA = ROOT / "docs" / "data" / "glass"  # tables of all runs; the runs stay on the machine that makes them
RUNS = ROOT / "out" / "glass"
QUICK = RUNS / "quick"

LIQUIDS = {"glass_polydisperse": "ellipses, κ = 2", "glass_polydisperse_disks": "disks"}
AGEING = "glass_fast"
STUDIES = [*LIQUIDS, AGEING]
LOWEST = 0.60  # the packing fraction that times are relative to
STUDENT = {2: 1.837, 3: 1.321, 4: 1.197}  # standard errors from so many seeds, times this, cover 68.3 %
MIN_GROWTH = {"glass_polydisperse": 300, "glass_polydisperse_disks": 1e3}  # of τ_α relative to the cage


# ---- running ----------------------------------------------------------------------------------------------

def reduced(name, folder):
    """The parameter file of a study with fewer particles, and of its densities only the lowest."""
    kept = 3 if name == AGEING else 6
    text = (PARAMS / f"{name}.toml").read_text(encoding="utf-8")
    head = re.sub(r"^particles = .*", "particles = 400", text.split("[sweep", 1)[0], flags=re.MULTILINE)
    lines = []
    for section, keys in tomllib.loads(text)["sweep"].items():
        lines.append(f"[sweep.{section}]")
        lines += [f'"{key}" = [{", ".join(map(toml, values[:kept]))}]' for key, values in keys.items()]
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / f"{name}.toml"
    file.write_text(head + "\n".join(lines) + "\n", encoding="utf-8")
    return file


class Study:
    """One sweep, run or continued, and its analysis."""

    def __init__(self, build, name, quick):
        self.build, self.name = build, name
        self.folder = (QUICK if quick else RUNS) / name.removeprefix("glass_")
        self.parameters = reduced(name, QUICK) if quick else PARAMS / f"{name}.toml"

    def run(self):
        self.vitrel("sweep", self.parameters, "-o", self.folder, "-j", "2", "--quiet")

    def status(self):
        return self.vitrel("sweep", self.parameters, "-o", self.folder, "--status")

    def vitrel(self, *words):
        """In the folder of the project, so that what is kept names no path outside of it."""
        inside = [word.relative_to(ROOT) if isinstance(word, pathlib.Path) and word.is_relative_to(ROOT) else word for word in words]
        return output_of([self.build / "app/vitrel", *map(str, inside)], cwd=ROOT)

    def analyze(self):
        summary = summary_of(self.build, "analyze", self.folder)
        self.fits = summary["glass"]["fits"]
        verdicts = {self.key(run): run for run in summary["runs"]}
        self.jobs = sorted((Job(path.parent) for path in self.folder.glob("*/done.json")), key=lambda job: self.key(job.values))
        for job in self.jobs:
            job.verdict = verdicts[self.key(job.values)]
            expect(job.done["run"]["overlaps"] == 0, f"{self.name}, {job.done['id']}: overlaps")

    @staticmethod
    def key(run):
        return (round(run.get("packing_fraction", run.get("system.packing_fraction")), 6),
                run.get("seed", run.get("system.seed")))

    def seconds(self):
        return sum(job.seconds() for job in self.jobs)

    def mean_time(self, phi, which):
        """The geometric mean over seeds; nothing if one of them has no such time."""
        times = [job.time(which) for job in self.jobs if job.phi == phi]
        if not times or any(time is None for time in times):
            return None
        return math.exp(sum(math.log(time[0]) for time in times) / len(times))

    def densities(self):
        return sorted({job.phi for job in self.jobs})

    def growth(self, which):
        """Of a time, from the lowest density to the highest at which it is known, and that density; nothing if unknown."""
        known = [(phi, self.mean_time(phi, which)) for phi in self.densities() if self.mean_time(phi, which)]
        return (known[-1][1] / known[0][1], known[-1][0]) if known and known[0][0] == LOWEST else None


class Job:
    """One finished run."""

    def __init__(self, folder):
        import h5py  # only here: a test imports all validations

        self.done = json.loads((folder / "done.json").read_text(encoding="utf-8"))
        self.values = self.done["values"]
        self.phi, self.seed = self.values["system.packing_fraction"], self.values["system.seed"]
        with h5py.File(folder / "results.h5") as file:
            self.tables = {name: {column: values[...] for column, values in group.items()}
                           for name, group in file.items() if name != "provenance"}

    def seconds(self):
        return self.done["prepare"]["wall_seconds"] + self.done["run"]["wall_seconds"]

    def time(self, which):
        """A relaxation time and its error: "alpha", "cage" or "2"; nothing if it is not known."""
        kind, parameter = {"alpha": (0, None), "cage": (4, None), "2": (1, 2)}[which]
        times = self.tables["relaxation_times"]
        for k in range(len(times["tau"])):
            if times["group"][k] == 0 and times["kind"][k] == kind and parameter in (None, times["parameter"][k]):
                return None if math.isnan(times["tau"][k]) else (times["tau"][k], times["tau_error"][k])
        return None

    def ageing(self, column):
        """What is seen after a waiting time, over time."""
        found = self.tables["ageing"]
        return [(t, y) for t, y in zip(found["time"], found[column]) if t > 0 and not math.isnan(y)]


# ---- figures ----------------------------------------------------------------------------------------------

TIMES = {"alpha": "τ_α", "cage": "τ_α relative to the cage", "2": "τ₂"}
CHARTS = {"glass_polydisperse": ["relaxation_times", "mean_squared_displacement", "mean_squared_rotation", "self_intermediate_scattering",
                                 "orientational_correlation", "non_gaussian_parameter", "four_point_susceptibility"],
          "glass_polydisperse_disks": ["relaxation_times"],
          "glass_fast": ["mean_squared_rotation_after_waiting", "orientational_correlation_after_waiting"]}


def save_study_charts(study, folder):
    """Those of the report page of the sweep that the text shows."""
    with tempfile.TemporaryDirectory() as scratch:
        report = pathlib.Path(scratch, "page.html")
        study.vitrel("report", study.folder, "-o", report, "-q")
        save_charts(report, folder, [f"{name}.svg" for name in CHARTS[study.name]])


def save_domains(study, folder):
    """Pictures of states as they are made, coloured by orientation."""
    densities = [phi for phi in (0.60, 0.72, 0.82) if phi in study.densities()] or study.densities()[:3]
    for k, phi in enumerate(densities, start=1):
        with tempfile.TemporaryDirectory() as scratch:
            state = pathlib.Path(scratch, "state.h5")
            study.vitrel("prepare", study.parameters, "--set", f"system.packing_fraction={phi}", "-o", state, "-q")
            study.vitrel("picture", state, "--width", "440", "-o", folder / f"domains-{k}.png", "-q")


# ---- text -------------------------------------------------------------------------------------------------

def number(value, error=None, digits=3):
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return "–"
    text = f"{value:.{digits}g}"
    return text if error is None or math.isnan(error) else f"{text} ± {error:.1g}"


def density(fit):
    if fit["phi_c"] is not None:
        return f"{fit['phi_c']:.3f} ± {fit['phi_c_error']:.3f}"
    return f"> {fit['phi_c_least']:.3f}" if fit["phi_c_least"] is not None else "–"


def fit_rows(study):
    return [[QUANTITIES[fit["kind"]], fit["law"], density(fit), number(fit["exponent"], fit["exponent_error"]),
             "{:.3f} … {:.3f}".format(*fit["window"]) if fit["dof"] else "–",
             number(fit["chi2"] / fit["dof"], digits=2) if fit["dof"] else "–", fit["diffusion"], fit["reason"] or "–"]
            for fit in study.fits]


FIT_HEAD = ["quantity", "law", "φ_c", "exponent", "best window", "χ²/dof", "diffusion", "reason for no law"]


def fit_of(study, kind, law):
    return next(fit for fit in study.fits if (fit["kind"], fit["law"]) == (kind, law))


NAMES = {"power law": "the power law", "Vogel–Fulcher": "the law of Vogel and Fulcher"}
QUANTITIES = {"translation, tau_alpha": "τ_α relative to the cage", "rotation, tau_2": "τ₂"}
BY_DIFFUSION = {"untested": "", "agrees": ", and diffusion agrees", "disagrees": ", but diffusion disagrees"}


def conclusion(study, subject):
    """Which law holds for which time, a sentence each."""
    sentences = []
    for kind in dict.fromkeys(fit["kind"] for fit in study.fits):
        found = [fit for fit in study.fits if fit["kind"] == kind and fit["phi_c"] is not None]
        sentences += [f"{QUANTITIES[kind]} of {subject} follows {NAMES[fit['law']]}, with φ_c = {density(fit)}"
                      f"{BY_DIFFUSION[fit['diffusion']]}." for fit in found]
        if not found:
            sentences.append(f"No law holds for {QUANTITIES[kind]} of {subject}.")
    return " ".join(sentences)


def order_by(study, law):
    """Whether rotation and translation stop together by this law, in one sentence; empty if it does not hold for both."""
    rotation, translation = (fit_of(study, kind, law) for kind in ("rotation, tau_2", "translation, tau_alpha"))
    if None in (rotation["phi_c"], translation["phi_c"]):
        return ""
    distance = translation["phi_c"] - rotation["phi_c"]
    error = math.hypot(translation["phi_c_error"], rotation["phi_c_error"])
    together = "together within two standard errors" if abs(distance) < 2 * error else \
        "rotation first" if distance > 0 else "translation first"
    return f"By {NAMES[law]}, rotation stops at φ = {density(rotation)} and translation at {density(translation)}: {together}."


NO_ORDER = "no law holds for both, so that there are no two densities to compare."


def ratio_of_job(job, which):
    """τ₂ over a time of translation, and its error; nothing if one is not known."""
    rotation, translation = job.time("2"), job.time(which)
    if not rotation or not translation:
        return None
    ratio = rotation[0] / translation[0]
    return ratio, ratio * math.hypot(rotation[1] / rotation[0], translation[1] / translation[0])


def ratios(study, which):
    """τ₂ over a time of translation at the lowest and the highest density that have both, averaged over seeds."""
    known = []
    for phi in study.densities():
        found = [ratio_of_job(job, which) for job in study.jobs if job.phi == phi]
        if all(found):
            mean = sum(ratio for ratio, _ in found) / len(found)
            known.append((phi, number(mean, math.hypot(*(error for _, error in found)) / len(found))))
    (low, first), (high, last) = known[0], known[-1]
    return f"goes from {first} at φ = {low:g} to {last} at {high:g}"


def answer(study):
    """To the question of the page, in the first paragraph."""
    known = " ".join(filter(None, (order_by(study, law) for law in NAMES)))
    return (f"Times of ellipses of aspect ratio 2 grow from φ = {LOWEST:g} on: {growth_text(study)}. The ratio of τ₂ and τ_α relative to "
            f"the cage {ratios(study, 'cage')}. " + (known or "At which density either would stop, these times do not say: " + NO_ORDER))


def growth_text(study):
    """By how much each time grows."""
    grown = [(TIMES[which], study.growth(which)) for which in ("2", "cage", "alpha") if study.growth(which)]
    return ", ".join(f"{name} {float(f'{factor:.2g}'):g}-fold (up to {highest:g})" for name, (factor, highest) in grown)


def domains_text(study):
    """The length of the domains at the lowest and the highest density, as made and at the last waiting time."""
    lengths = []
    for job in (study.jobs[0], study.jobs[-1]):
        waits = job.tables["waiting_times"]
        lengths.append(f"from {waits['nematic_length'][0]:.2g} to {waits['nematic_length'][-1]:.2g} at φ = {job.phi:g}")
    waits = study.jobs[0].tables["waiting_times"]["waiting_time"]
    return f"Between t_w = {waits[0]:g} and {waits[-1]:g} ξ grows {lengths[0]}, and {lengths[1]}."


def value_at(points, time):
    """Of a correlation, linear in ln t between its points."""
    for (before, first), (after, second) in zip(points, points[1:]):
        if before <= time <= after:
            return first + (second - first) * math.log(time / before) / math.log(after / before)
    return points[-1][1]


def stopping_density(jobs, curve, time):
    """Of one seed: the density at which a correlation falls to 1/e just then, by linear interpolation; a bound, as
    a text, where it does so at all of them or at none.
    """
    values = [(job.phi, value_at(job.ageing(curve), time)) for job in jobs]
    moving = [k for k, (_, value) in enumerate(values) if value <= 1 / math.e]
    if not moving:
        return f"≤ {values[0][0]:g}"
    if moving[-1] + 1 == len(values):
        return f"> {values[-1][0]:g}"
    (low, above), (high, below) = values[moving[-1]:moving[-1] + 2]
    return low + (high - low) * (1 / math.e - above) / (below - above)


def stop_text(study, curve, time):
    """The mean over seeds, with an error that covers 68.3 %; else the bounds."""
    found = [stopping_density([job for job in study.jobs if job.seed == seed], curve, time)
             for seed in sorted({job.seed for job in study.jobs})]
    if any(isinstance(one, str) for one in found):
        return ", ".join(dict.fromkeys(one if isinstance(one, str) else f"{one:.3f}" for one in found))
    mean, error = estimate(found)
    return f"{mean:.3f} ± {STUDENT[len(found)] * error:.3f}"


def stop_rows(study):
    """The density of each waiting time at which a correlation falls to 1/e in the time that follows the last one; that time."""
    waits = study.jobs[0].tables["waiting_times"]["waiting_time"]
    window = study.jobs[0].verdict["duration"] - waits[-1]
    return window, [[f"{waited:g}", *(stop_text(study, f"{name}_{k}", window) for name in ("l", "fs"))]
                    for k, waited in enumerate(waits, start=1)]


def wrapped(text):
    """Paragraphs in lines of 120 characters; tables, headings, pictures and code stay."""
    blocks = [block if block[0] in "|#! " else textwrap.fill(" ".join(block.split()), 120, break_long_words=False,
                                                             break_on_hyphens=False)
              for block in text.strip().split("\n\n")]
    return "\n\n".join(blocks) + "\n"


def page(liquids, ageing):
    text = (ROOT / "scripts/validation/glass_page.txt").read_text(encoding="utf-8")
    values = {"hours": f"{sum(study.seconds() for study in (*liquids, ageing)) / 3600:.1f}",
              "order": " ".join(filter(None, (order_by(liquids[0], law) for law in NAMES))) or NO_ORDER.capitalize(),
              "answer": answer(liquids[0]),
              "ratio": ratios(liquids[0], "alpha"), "cage_ratio": ratios(liquids[0], "cage"), "domains": domains_text(ageing)}
    window, stops = stop_rows(ageing)
    values |= {"window": f"{window:g}", "stops": table(["t_w", "rotation stops at φ", "translation stops at φ"], stops)}
    for study, key in zip(liquids, ("ellipses", "disks")):
        values |= {f"fits_{key}": table(FIT_HEAD, fit_rows(study)),
                   f"growth_{key}": growth_text(study), f"conclusion_{key}": conclusion(study, key)}
    for key, value in values.items():
        text = text.replace(f"@{key}@", value)
    return wrapped(text)


def save_tables(studies):
    """What every run gave, and the fits."""
    for study in studies:
        folder = DATA / study.name.removeprefix("glass_")
        folder.mkdir(parents=True, exist_ok=True)
        for name in ("runs", "relaxation", "glass_fit"):
            shutil.copy(study.folder / "results" / f"{name}.csv", folder)


def draw(liquids, ageing, folder):
    for study in (*liquids, ageing):
        save_study_charts(study, folder / study.name.removeprefix("glass_"))
    save_domains(ageing, folder / ageing.name.removeprefix("glass_"))


def studied(build, is_quick):
    studies = [Study(build, name, is_quick) for name in STUDIES]
    for study in studies:
        study.run()
        study.analyze()
    return studies


def measure(build):
    *liquids, ageing = studied(build, is_quick=False)
    for study in liquids:
        growth, densest = study.growth("cage")
        expect(growth >= MIN_GROWTH[study.name], f"{study.name}: times grow only {growth:.3g}-fold up to {densest}")
    draw(liquids, ageing, FIGURES)
    save_tables([*liquids, ageing])
    PAGE.write_text(page(liquids, ageing), encoding="utf-8")
    return """This command writes [The glass](glass.md), from the runs in out/glass and those that are missing
there, which it makes. `--status` tells which are; `--quick` goes through the whole chain with fewer particles and densities
and writes to out/glass/quick."""


def quick(build):
    *liquids, ageing = studied(build, is_quick=True)
    draw(liquids, ageing, QUICK / "figures" / "glass")
    (QUICK / "glass.md").write_text(page(liquids, ageing), encoding="utf-8")
    return f"{QUICK.relative_to(ROOT)}/glass.md, in {sum(study.seconds() for study in (*liquids, ageing)):.0f} s of runs"


def status(build):
    return "\n".join(f"{study.folder.relative_to(ROOT)}\n{study.status()}"
                     for study in (Study(build, name, False) for name in STUDIES))
