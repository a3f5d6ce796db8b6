"""The studies of vitrel-bench: rewrites docs/studies, its tables, pages and figures, and checks what is required of them."""

import json
import math
import pathlib
import tempfile

from validation.common import ROOT, expect, output_of, save_charts
from validation.literature import carnahan_starling

TITLE = "Studies"
INPUTS = {"overlap": ["bench", "core"], "contact-time": ["bench", "core"], "whole-run": ["bench", "core", "edmd"],
          "engine": ["bench", "core", "edmd"], "sampling": ["bench", "core", "mc"], "soft-contacts": ["bench", "core", "edmd"],
          "peers": ["bench", "core"], "dense": ["bench", "core", "mc", "edmd", "workflow"],
          "brownian-step": ["bench", "core", "edmd", "analysis"], "analysis": ["bench", "analysis", "core"], "thesis": ["bench", "core", "edmd"]}
FOLDER = ROOT / "docs" / "studies"
OPTIONS = {"contact-time": ["--pairs", "10000", "--seconds", "20"], "sampling": ["--seconds", "5"],
           "thesis": ["--seconds", "2"]}

ERROR_OF_CARNAHAN_STARLING = 0.004  # in a dense liquid
COST_RATIOS = {100_000: 1.6, 1_000_000: 2.5}  # of a collision, relative to 1000 particles
ANALYSIS_EXPONENT = 1.15  # of the cost of motion, in frames, particles and time differences
CHAINS_GAIN, COLLECTIVE_GAIN = 1.5, 2  # at least, over local moves and over motion
LONGEST_ACCURATE_STEP, ITS_DEVIATION = 0.1, 0.04  # of τα, beyond twice its error; the default step
WARNED_STEP, LEAST_DEVIATION = 0.3, 0.06
REACHED = {"disks, 1 : 1.4": 0.83, "κ = 1.4, 1 : 1.4": 0.86, "κ = 2": 0.8, "κ = 6": 0.8}  # by growth at the default rate
EXPONENTS = {("vitrel", "ellipses"): (0.8, 1.3), ("vitrel", "circles"): (0.8, 1.3),
             ("thesis", "ellipses"): (1.7, 2.5), ("thesis", "circles"): (2.4, 3.2)}


def of(rows, **values):
    return [row for row in rows if all(row.get(key) == value for key, value in values.items())]


def check_overlap(parts):
    for row in parts["plane"] + parts["space"]:
        exact = not row["method"].startswith(("polygon", "undecided")) and not row["method"].endswith(("_in_the_thesis", "_as_printed"))
        expect(not exact or row["wrong_overlap"] + row["wrong_disjoint"] == 0, f"overlap: {row}")


def check_contact_time(parts):
    for part in ("plane", "space"):
        for row in of(parts[part], method="separating_axis"):
            expect(row["correct"] == row["pairs"], f"{part}: the default method is wrong: {row}")
    for row in parts["passing_pair"]:
        expect(row["method"] != "separating_axis" or "time" in row, f"the passing pair: {row}")


def check_whole_run(parts):
    for row in of(parts["thesis"], method="separating_axis"):
        expect(row["correction_moves"] == 0, f"correction moves with the default method: {row}")


def check_engine(parts):
    for row in of(parts["speed"], shape="spheres"):
        known = carnahan_starling(row["packing_fraction"])
        expect(abs(row["z"] / known - 1) <= ERROR_OF_CARNAHAN_STARLING, f"spheres: Z = {row['z']}, not {known}")
    for row in parts["sizes"]:
        first = of(parts["sizes"], aspect_ratio=row["aspect_ratio"])[0]
        ratio = row["ns_per_collision"] / first["ns_per_collision"]
        expect(ratio <= COST_RATIOS.get(row["particles"], ratio), f"a collision costs {ratio:.2f} times as much: {row}")


def gain(rows, slow, fast, quantity):
    """How many times as fast one method forgets as another, and the error of that; nothing where one of them is not known."""
    found = [of(rows, method=method)[:1] for method in (slow, fast)]
    if not all(row and row[0].get(quantity) for row in found):
        return None
    (one,), (other,) = found
    value = one[quantity] / other[quantity]
    return value, value * math.hypot(*(row[f"{quantity}_error"] / row[quantity] for row in (one, other)))


def check_forgetting(rows):
    """Chains forget places sooner than local moves. Where motion of disks and spheres is slow but can still be measured,
    collective exchanges forget sizes sooner.
    """
    for liquid in sorted({row["liquid"] for row in rows}):
        states = [of(rows, liquid=liquid, packing_fraction=phi) for phi in sorted({row["packing_fraction"] for row in of(rows, liquid=liquid)})]
        for state in states:
            if found := gain(state, "local moves", "chains", "places"):
                expect(found[0] + 3 * found[1] > CHAINS_GAIN, f"{liquid}: event chains forget places only {found[0]:.2f} times as fast")
        known = [found[0] for state in states if (found := gain(state, "motion", "chains, collective exchanges", "sizes"))]
        expect(liquid == "ellipses" or (known and known[-1] > COLLECTIVE_GAIN), f"{liquid}: collective exchanges gain too little: {known}")


def check_sampling(parts):
    check_forgetting(parts["forgetting"])
    chains = {(row["shape"], row["packing_fraction"]): row for row in of(parts["pressure"], method="chains")}
    for row in parts["pressure"]:
        other = chains[row["shape"], row["packing_fraction"]]
        if row is not other and None not in (row["z_error"], other["z_error"]):  # else too short to tell
            off = abs(row["z"] - other["z"]) / math.hypot(row["z_error"], other["z_error"])
            expect(off <= 5, f"methods differ by {off:.1f} standard errors: {row}")
    for two in of(parts["threads"], method="two threads"):
        one = of(parts["threads"], method="one thread", shape=two["shape"])[0]
        expect(one["ns_per_trial"] / two["ns_per_trial"] >= 1.6, f"two threads gain too little: {two}")


def check_soft_contacts(parts):
    tables = of(parts["accuracy"], method="tables")[-1]
    finest = of(parts["accuracy"], method="force_based")[-1]
    expect(finest["median"] > tables["median"] and finest["ns_per_second"] > 100 * tables["ns_per_second"], f"{finest}")
    for row in of(parts["speed"], method="tables"):
        hard = of(parts["speed"], method="hard", packing_fraction=row["packing_fraction"])[0]
        expect(hard["ns_per_collision"] >= 0.4 * row["ns_per_collision"], f"tables are slow: {row}")
    for row in of(parts["restitution"], method="table"):
        expect(max(row["rate"], row["duration"]) <= row["tolerance"] and row["error"] <= 2 * row["tolerance"], f"table: {row}")
        expect(row["without_value"] <= 1e-3 * row["points"], f"table: {row}")
        expect(row["megabytes"] <= 200 and row["seconds"] <= 600 and row["ns_per_impact"] <= 1000, f"table: {row}")


def check_analysis(parts):
    for row in of(parts["motion"], method="vitrel"):
        expect(row["difference"] <= 1e-9, f"means differ: {row}")
    for varied in ("frames", "particles", "time differences"):
        found = growth_exponent(of(parts["motion"], method="vitrel", varied=varied), "ns", "size")
        expect(found <= ANALYSIS_EXPONENT, f"the analysis of motion costs {varied}^{found:.2f}")
    (direct,), (transforms,) = (of(parts["estimators"], method=method) for method in ("all origins", "transforms"))
    expect(abs(transforms["error"] / direct["error"] - 1) <= 1e-6, f"transforms differ from all origins: {transforms}")
    for row in of(parts["structure_factor"], method="transform"):
        expect(row["share_of_bound"] <= 1, f"an error above its bound: {row}")


def growth_exponent(rows, cost, size):
    """Of the cost, from the smallest to the largest size."""
    first, last = rows[0], rows[-1]
    return math.log(last[cost] / first[cost]) / math.log(last[size] / first[size])


def check_thesis(parts):
    for row in of(parts["sizes"], method="vitrel"):
        expect(row["correction_moves"] == 0 and row["samples_with_overlap"] == 0, f"thesis: {row}")
    for (method, shape), (low, high) in EXPONENTS.items():
        rows = of(parts["sizes"], method=method, shape=shape, dynamics="Newtonian", stood_still=False)
        found = growth_exponent(rows, "ns_per_time", "particles")
        expect(low <= found <= high, f"{method}, {shape}: cost as N^{found:.2f}")


def check_brownian_step(parts):
    for row in parts["relaxation"]:
        deviation, error = row.get("deviation", 0), 2 * row.get("deviation_error", 0)
        expect(row["brownian_step"] > LONGEST_ACCURATE_STEP or deviation <= ITS_DEVIATION + error, f"a short step: {row}")
        expect(row["brownian_step"] < WARNED_STEP or deviation >= LEAST_DEVIATION - error, f"a step that is warned of: {row}")


def check_dense(parts):
    for row in of(parts["density"], method="grow, rate 1e-3"):
        must = row["packing_fraction"] <= REACHED.get(row["system"], 0)
        expect(not must or row["end"] == "reached", f"not reached: {row}")


def check_peers(parts):
    for row in parts["plane"] + parts["space"]:
        wrong = row["wrong_overlap"] + row["wrong_disjoint"]
        expect(row["method"] != "separating_axis" or wrong == 0, f"the default is wrong: {row}")
    for row in of(parts["contact_time"], method="separating_axis"):
        expect(row["correct"] == row["pairs"], f"the default is wrong: {row}")


CHECKS = {"overlap": check_overlap, "contact-time": check_contact_time, "peers": check_peers, "whole-run": check_whole_run, "engine": check_engine,
          "sampling": check_sampling, "dense": check_dense, "brownian-step": check_brownian_step,
          "soft-contacts": check_soft_contacts, "analysis": check_analysis, "thesis": check_thesis}
PARTS = tuple(CHECKS)


def write(build, name):
    """Measures a study and writes its page, if it meets what is required; the first lines."""
    with tempfile.TemporaryDirectory() as folder:
        output_of([build / "bench/vitrel-bench", name, *OPTIONS.get(name, []), "-q", "-o", name], cwd=folder)
        made = pathlib.Path(folder, name, name)
        data = json.loads(made.with_suffix(".json").read_text(encoding="utf-8"))
        CHECKS[name]({part["name"]: part["rows"] for part in data["parts"]})
        save_charts(made.with_suffix(".html"), FOLDER / name)
        text = made.with_suffix(".md").read_text(encoding="utf-8")
        FOLDER.joinpath(f"{name}.md").write_text(text, encoding="utf-8")
    return f"- [{data['question']}](studies/{name}.md)"


def measure(build, parts=PARTS):
    for name in parts:
        write(build, name)
    pages = [f"- [{FOLDER.joinpath(name + '.md').read_text(encoding='utf-8').splitlines()[0][2:]}](studies/{name}.md)"
             for name in PARTS if FOLDER.joinpath(name + ".md").exists()]
    return "Speed against accuracy of everything that has a choice; each page says where it was measured.\n\n" + "\n".join(pages)
