"""Collision-time methods: rewrites the measured parts, the figures and the data of docs/collision-time.md."""

import csv
import re

from validation.common import ROOT, compared, expect, pair_columns, processor, save_figure, table
from validation.figures import failing_pair_figure, overlap_figure, scene_figure, speed_figure, whole_run_figure

TITLE = "Collision time: all methods"
PAIRS = 10_000  # of each class, for the default method
SECONDS = 20  # for every other method
DURATION = 100  # of the whole runs, as in the thesis
PAGE = ROOT / "docs/collision-time.md"
FIGURES = "figures/collision-time"
DATA = ROOT / "docs/data/collision-time"

SCENE = ("--body", "semi_axes=1,0.5", "--body",
         "semi_axes=1,0.5 position=1,1 velocity=-1,0 angular_velocity=3.141592653589793", "--until", "2")

DEFAULT, RIVAL = "separating_axis", "slsqp"
# Goals for the speed-up of the default method over SLSQP.
GOALS = {("generic", 2): 60, ("generic", 6): 40, ("recorded", 2): 100, ("recorded", 6): 100}

NAMES = {
    "separating_axis": "separating axis (default)",
    "circles": "circles",
    "slsqp": "SLSQP",
    "slsqp_checked": "SLSQP, checked",
    "nelder_mead": "Nelder–Mead",
    "simulated_annealing": "simulated annealing",
    "quadratic_penalty": "quadratic penalty",
    "log_barrier": "logarithmic barrier",
    "augmented_lagrangian": "augmented Lagrangian",
    "psi_root": "root of Ψ",
    "perram_wertheim_root": "root of Perram–Wertheim",
    "unit_circle": "unit circle",
    "reference": "reference",
}
FAILURES = {"late": "late", "missed": "missed", "early": "early", "false": "false", "not_converged": "no answer"}
COUNTS = ["method", "tolerance", "class", "aspect_ratio", "pairs", "correct", *FAILURES, "degenerate", "ns_per_call",
          "largest_error", "median_error", "largest_gap_error"]
SPACE = "\N{NO-BREAK SPACE}"


def time_text(nanoseconds):
    for unit in ("ns", "µs", "ms"):
        if nanoseconds < 999.5:
            break
        nanoseconds /= 1000
    digits = 2 if nanoseconds < 9.995 else 1 if nanoseconds < 99.95 else 0
    return f"{nanoseconds:.{digits}f}{SPACE}{unit}"


def share_text(part, whole):
    """A non-zero share is never shown as 0."""
    if part == 0:
        return "·"
    percent = 100 * part / whole
    return f"{percent:.{3 if percent >= 99.5 else 2 if percent >= 1 else 1}g}{SPACE}%"


def plain(value):
    """Three significant digits, without an exponent."""
    return f"{float(f'{value:.3g}'):g}"


def count_text(count):
    return str(count) if count else "·"


def error_text(error):
    return "–" if error is None else "0" if error == 0 else f"{error:.1e}"


def distinct(values):
    return list(dict.fromkeys(values))


def wrong(row):
    return row["pairs"] - row["correct"]


def applies(row):
    """A method that answers no pair of a class does not apply to it."""
    return row["not_converged"] < row["pairs"]


class Rows:
    """The rows of the stability table."""

    def __init__(self, rows):
        self.methods = distinct(row["method"] for row in rows)
        self.classes = distinct((row["class"], row["aspect_ratio"]) for row in rows)
        self._rows = {(row["method"], row["class"], row["aspect_ratio"]): row for row in rows}

    def of(self, method, of=None):
        """Its row for one class, or all its rows, where the method applies."""
        if of is None:
            return [row for c in self.classes if (row := self.of(method, c))]
        row = self._rows.get((method, *of))
        return row if row and applies(row) else None


def class_name(of):
    return f"{of[0]}, κ{SPACE}={SPACE}{of[1]:g}"


def ratio(rows, of):
    return rows.of(RIVAL, of)["ns_per_call"] / rows.of(DEFAULT, of)["ns_per_call"]


def speed(rows):
    lines = []
    for of, goal in GOALS.items():
        times = [time_text(rows.of(method, of)["ns_per_call"]) for method in (DEFAULT, RIVAL)]
        reached = "reached" if ratio(rows, of) >= goal else "not reached"
        lines.append([class_name(of), *times, f"{ratio(rows, of):.0f}", f"≥ {goal}, {reached}"])
    return table(["pairs", "separating axis, per call", "SLSQP, per call", "times faster", "goal"], lines)


def totals(rows, method):
    """Pairs and counts over all classes to which the method applies."""
    of_method = rows.of(method)
    return {key: sum(row[key] for row in of_method) for key in ("pairs", "correct", *FAILURES)}


def glance(rows):
    speeds = list(GOALS)
    head = ["method", *(f"per call, {class_name(of)}" for of in speeds), "pairs", *FAILURES.values(), "largest error"]
    lines = []
    for method in rows.methods:
        of_method = rows.of(method)
        times = [time_text(row["ns_per_call"]) if (row := rows.of(method, of)) else "–" for of in speeds]
        sums = totals(rows, method)
        errors = [row["largest_error"] for row in of_method if row["largest_error"] is not None]
        lines.append([NAMES[method], *times, sums["pairs"], *(share_text(sums[f], sums["pairs"]) for f in FAILURES),
                      error_text(max(errors, default=None))])
    return table(head, lines)


def stability(rows, names):
    def cell(row):
        return share_text(wrong(row), row["pairs"]) if row else "–"

    lines = [[class_name(of), *(cell(rows.of(method, of)) for method in rows.methods)] for of in rows.classes]
    return table(["class", *(names[method] for method in rows.methods)], lines)


def write_counts(rows, file):
    """Writes all rows, with three digits, as CSV."""
    with open(DATA / file, "w", encoding="utf-8", newline="") as output:
        lines = csv.writer(output, lineterminator="\n")
        lines.writerow(COUNTS)
        for row in (row for method in rows.methods for row in rows.of(method)):
            lines.writerow([plain(row[key]) if isinstance(row[key], float) else row[key] for key in COUNTS])


def classes(data):
    """Every class with its largest aspect ratios and what it is."""
    kinds = distinct((of["class"], of["meaning"]) for of in data["classes"])
    ratios = {kind: [f"{of['aspect_ratio']:g}" for of in data["classes"] if of["class"] == kind] for kind, _ in kinds}
    return table(["class", "largest κ", "meaning"], [[kind, ", ".join(ratios[kind]), meaning] for kind, meaning in kinds])


def failing(rows, method):
    """A sentence on the wrong answers of a method."""
    sums = totals(rows, method)
    shares = [f"{share_text(sums[f], sums['pairs'])} {word}" for f, word in FAILURES.items() if sums[f]]
    worst = max(rows.of(method), key=lambda row: wrong(row) / row["pairs"])
    return (f"Wrong answers among {sums['pairs']} pairs: {', '.join(shares)}. Worst class: "
            f"{class_name((worst['class'], worst['aspect_ratio']))}, {share_text(wrong(worst), worst['pairs'])} wrong.")


def failures(data, rows):
    without = [NAMES[m] for m in rows.methods if m not in {failure["method"] for failure in data["failures"]}]
    parts = [f"No wrong answer: {', '.join(without)}."] if without else []
    for failure in data["failures"]:
        name = NAMES[failure["method"]]
        of = class_name((failure["class"], failure["aspect_ratio"]))
        parts.append(f"### {name[0].upper() + name[1:]}\n\n{failing(rows, failure['method'])}\n\n"
                     f"![Example failure: {name}]({FIGURES}/failure_{failure['method']}.svg)\n\n"
                     f"Example ({of}, pair {failure['index']}): the method {failure['caption']}.")
    return "\n\n".join(parts)


def overlap(data):
    rows = data["overlap"]
    kinds = distinct((row["class"], row["aspect_ratio"]) for row in rows)
    lines = []
    for method in distinct(row["method"] for row in rows):
        of_method = {(row["class"], row["aspect_ratio"]): row for row in rows if row["method"] == method}
        shares = [share_text(row["wrong_overlap"] + row["wrong_disjoint"], row["pairs"]) for row in of_method.values()]
        largest = max(row["largest_wrong_gap"] for row in of_method.values())
        lines.append([f"`{method}`", *shares, error_text(largest) if largest else "·",
                      time_text(of_method["near_contact", 2]["ns_per_call"])])
    return table(["criterion", *map(class_name, kinds), "largest wrong gap", "per call, near_contact, κ = 2"], lines)


def scene(data):
    truth = data["scene"][0]["time"]
    lines = [[NAMES[answer["method"]], f"{answer['time']:.15f}", error_text(answer["time"] - truth)]
             if answer["time"] is not None else [NAMES[answer["method"]], "no contact", "–"]
             for answer in data["scene"]]
    return table(["method", "first contact at t", "off by"], lines)


def runs(data):
    lines = []
    for run in data["whole_runs"]:
        collisions, moves = run["collisions"], run["correction_moves"]
        still = ", then stood still" if run["stood_still"] else ""
        lines.append([NAMES[run["method"]], f"{run['tolerance']:.2g}", f"{run['simulated_time']:.4g}{still}",
                      collisions, count_text(moves),
                      plain(1000 * moves / collisions) if collisions and moves else "·",
                      plain(run["collisions_per_second"]), error_text(run["energy_drift"]),
                      error_text(run["deepest_overlap"]) if run["deepest_overlap"] else "·"])
    return table(["method", "tolerance", "time", "collisions", "correction moves", "per 1000 collisions",
                  "collisions per second", "energy drift", "deepest overlap (b)"], lines)


def measured(data):
    how = data["provenance"]
    commit = how["commit"][:7] + "-modified" * ("modified" in how["commit"])
    return (f"Measured on {how['finished'][:10]}, commit {commit}, {processor()}, with\n\n"
            f"    vitrel-bench collision-time --pairs {PAIRS} --seconds {SECONDS} --duration {DURATION} -o FOLDER\n\n"
            f"in {how['wall time']}.")


def with_part(page, name, text):
    """The page with the text between the markers of this part replaced."""
    begin, end = f"<!-- begin {name} -->", f"<!-- end {name} -->"
    expect(page.count(begin) == 1 and page.count(end) == 1, f"{PAGE.name}: there is not exactly one part {name}")
    before, rest = page.split(begin)
    return before + begin + "\n\n" + text + "\n\n" + end + rest.split(end)[1]


def figures(data):
    tolerances = data["tolerances"]
    return {"collision-time": speed_figure(tolerances, "median_error"),
            "collision-time-largest": speed_figure(tolerances, "largest_error"),
            "scene_gap": scene_figure(data, "d", "d(t)"), "scene_psi": scene_figure(data, "psi", "Ψ(t)"),
            "overlap": overlap_figure(data["overlap"]), "whole-run": whole_run_figure(data["whole_runs"]),
            **{f"failure_{failure['method']}": failing_pair_figure(failure) for failure in data["failures"]}}


def write_page(data, rows):
    parts = {"measured": measured(data), "speed": speed(rows), "glance": glance(rows), "stability": stability(rows, NAMES),
             "classes": classes(data), "failures": failures(data, rows), "scene": scene(data), "runs": runs(data),
             "overlap": overlap(data)}
    page = PAGE.read_text(encoding="utf-8")
    marked = re.findall(r"<!-- begin (\w+) -->", page)
    expect(sorted(marked) == sorted(parts), f"{PAGE.name} has the parts {marked}, expected {list(parts)}")
    for name, text in parts.items():
        page = with_part(page, name, text)
    for old in (PAGE.parent / FIGURES).glob("*.svg"):
        old.unlink()
    for name, figure in figures(data).items():
        save_figure(figure, FIGURES, name)
    write_counts(rows, "ellipses.csv")
    PAGE.write_text(page, encoding="utf-8")


def measure(build):
    data = compared(build, "collision-time", "collision-time.json", "--pairs", PAIRS, "--seconds", SECONDS, "--duration", DURATION)
    data["scene_path"] = pair_columns(build, "-o", "path", *SCENE)
    rows = Rows(data["rows"])
    sums = totals(rows, DEFAULT)
    expect(sums["correct"] == sums["pairs"], f"the default method is wrong: {sums}")
    moves = [run["correction_moves"] for run in data["whole_runs"] if run["method"] == DEFAULT]
    expect(moves and not any(moves), f"correction moves with the default method: {moves}")
    write_page(data, rows)
    return f"""This command writes the tables and figures of [Collision time](collision-time.md). Required: the default method gives no
wrong answer at its default tolerance, and its complete runs need no correction move at any tolerance.
The page says which goals are reached.
"""
