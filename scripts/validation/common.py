"""Helpers shared by the validations."""

import contextlib
import json
import math
import os
import pathlib
import platform
import re
import statistics
import subprocess
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PARAMS = ROOT / "params"
# An environment in which glibc does as on a processor without AVX and fused multiply-add; elsewhere it has no effect.
OLD_PROCESSOR = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX,-AVX2,-FMA,-FMA4,-AVX512F"}


COLOURS = ["#0072b2", "#c65200", "#00805c", "#b1407f", "#8a7a00", "#6a4fc4", "#a8281c", "#3c434b"]


class Failure(Exception):
    """A measurement failed or contradicts a requirement."""


def expect(condition, message):
    if not condition:
        raise Failure(message)


def output_of(command, **options):
    """The standard output of a command that must succeed."""
    done = subprocess.run(command, capture_output=True, text=True, check=False, **options)
    words = " ".join(map(str, command))
    expect(done.returncode == 0, f"{words}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def expect_chart(page):
    """A page of the program that shows results."""
    text = page.read_text(encoding="utf-8")
    expect("<svg" in text or "<canvas" in text or "uPlot" in text, f"{page.name} has no chart")


def fluid_pressures():
    """By aspect ratio and packing fraction, Z of fluids of hard ellipses in the literature."""
    table = (ROOT / "bench/reference/literature.h").read_text(encoding="utf-8").split("fluid_pressures[] = {")[1].split("};")[0]
    entries = [tuple(map(float, entry.split(","))) for entry in re.findall(r"\{([^{}]+)\}", table)]
    return {(kappa, phi): z for kappa, phi, z, _ in entries}


def carnahan_starling(phi):
    """Z of the fluid of hard spheres (1969)."""
    return (1 + phi + phi**2 - phi**3) / (1 - phi)**3


def properties_of_test(program, test, **variables):
    """The properties that one test records when it runs with these environment variables."""
    with tempfile.TemporaryDirectory() as folder:
        result = pathlib.Path(folder, "result.json")
        output_of([program, f"--gtest_filter={test}", f"--gtest_output=json:{result}"],
                  env={**os.environ, **{name: str(value) for name, value in variables.items()}})
        report = json.loads(result.read_text())
    expect(report["tests"] == 1, f"{test} was not run")
    return report["testsuites"][0]["testsuite"][0]


def summary_of(build, command, *arguments):
    """The JSON summary of a command of the program."""
    return json.loads(output_of([build / "app/vitrel", command, *arguments, "--json"]))


def settings(overrides):
    """The options of the command line that set these parameters."""
    return [word for override in overrides for word in ("--set", override)]


def run_and_check(build, parameters, *overrides, frames=()):
    """The summaries of a run and of its exact check, of all frames or, with ("--last",), of the last frame."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "run.h5")
        run = summary_of(build, "run", parameters, "-o", file, *settings(overrides))
        return run, summary_of(build, "check", file, *frames)


def article_sweep(build, name, *overrides, parallel=1):
    """The summary of the sweep of params/articles/<name>.toml. Every job ends in a state that passes the exact check."""
    with tempfile.TemporaryDirectory() as folder:
        summary = summary_of(build, "sweep", PARAMS / "articles" / f"{name}.toml", "-o", folder, "-j", str(parallel),
                             *settings(overrides))
    for job in summary["jobs"]:
        overlaps = job["run" if "run" in job else "prepare"]["overlaps"]
        expect(overlaps == 0, f"{name}: {job['id']}: {overlaps} overlaps")
    return summary


def preparation(particles, aspect_ratio, sizes, *sections):
    """Parameters of an equimolar mixture of these sizes (TOML values), followed by these sections."""
    species = "\n".join(
        f'[[species]]\nname = "{name}"\nfraction = {1 / len(sizes)}\naspect_ratio = {aspect_ratio}\nsize = {size}'
        for name, size in zip("AB", sizes))
    system = f"[system]\nparticles = {particles}\nseed = 1"
    return "\n\n".join((system, species, *sections)) + "\n"


# Sizes ∝ σ⁻³ between 0.45 and 1 of the largest, 23 % polydispersity.
POWER_LAW = '{ distribution = "power_law", low = 0.725, high = 1.61 }'
INSERT = '[[prepare.stage]]\nmethod = "insert"\npacking_fraction = 0.3'


def estimate(values):
    """Mean and standard error of independent values."""
    return statistics.mean(values), statistics.stdev(values) / math.sqrt(len(values))


def series_estimate(values):
    """Mean and standard error of a series of values that are correlated: the correlations up to the first that is not
    positive are summed.
    """
    n, mean = len(values), statistics.mean(values)
    deviations = [value - mean for value in values]
    variance = sum(d * d for d in deviations) / n
    time = 1.0
    for lag in range(1, n // 2):
        correlation = sum(a * b for a, b in zip(deviations, deviations[lag:])) / n / variance
        if correlation <= 0:
            break
        time += 2 * correlation
    return mean, math.sqrt(variance * n / (n - 1) * time / n)


def text_of(mean, error, digits=3):
    return f"{mean:.{digits}f} ± {error:.{digits}f}"


def apart(one, other):
    """The distance of two estimates, in standard errors."""
    return abs(one[0] - other[0]) / math.hypot(one[1], other[1])


def processor():
    found = re.search(r"^model name\s*: (.+)$", pathlib.Path("/proc/cpuinfo").read_text(), re.MULTILINE)
    return found[1] if found else platform.machine()


def table(head, rows):
    """A Markdown table."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines)


def pyplot():
    """Matplotlib, set up to write reproducible SVG files."""
    import matplotlib  # only here: a test imports all validations

    matplotlib.use("svg")
    from matplotlib import pyplot as plots

    matplotlib.rcParams.update({"svg.hashsalt": "vitrel", "svg.fonttype": "none", "font.size": 10})
    return plots


def save_figure(figure, folder, name):
    """Writes docs/<folder>/<name>.svg and closes the figure."""
    write_figure(figure, ROOT / "docs" / folder / f"{name}.svg")


def write_figure(figure, file):
    """Writes an SVG file and closes the figure."""
    file.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(file, metadata={"Date": None}, dpi=100)
    pyplot().close(figure)


def shape(kappa):
    return "disks" if kappa == 1 else f"κ = {kappa:g}"


def datasets(file):
    """Type, shape and bytes of all datasets of an HDF5 file except its provenance, by name."""
    import h5py  # needed only to compare files

    found = {}

    def note(name, item):
        if isinstance(item, h5py.Dataset) and not name.startswith("provenance/"):
            found[name] = (str(item.dtype), item.shape, item[()].tobytes())

    with h5py.File(file) as content:
        content.visititems(note)
    return found


def differing_datasets(first, second):
    left, right = datasets(first), datasets(second)
    return sorted(name for name in left.keys() | right.keys() if left.get(name) != right.get(name))


def differing_files(first, second, jobs):
    """The differences between the states, runs and results of two sweeps, and the number of files compared."""
    different, count = [], 0
    for job in jobs:
        names = {str(file.relative_to(sweep / job)) for sweep in (first, second) for kind in ("h5", "csv")
                 for file in (sweep / job).rglob(f"*.{kind}")}
        expect({"state.h5", "run.h5", "results.h5"} <= names, f"{job}: files are missing; found only {', '.join(sorted(names))}")
        for name in sorted(names):
            pair = first / job / name, second / job / name
            if not all(file.exists() for file in pair):
                different.append(f"{job}/{name}: present in only one of the sweeps")
            elif name.endswith(".h5"):
                different += [f"{job}/{name}: {dataset}" for dataset in differing_datasets(*pair)]
            elif pair[0].read_bytes() != pair[1].read_bytes():
                different.append(f"{job}/{name}")
            count += 1
    return different, count


def wait_until(condition, seconds, what):
    """Waits until `condition` returns a true value and returns that value."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if found := condition():
            return found
        time.sleep(0.05)
    raise Failure(f"timeout after {seconds} s: {what}")


def process_of_run(sweep, job):
    """The process of `vitrel run` of a job of an exported sweep, or None."""
    for entry in pathlib.Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):
            words = (entry / "cmdline").read_bytes().split(b"\0")
            if words[1:2] == [b"run"] and f"./{job}/run.h5".encode() in words and (entry / "cwd").readlink() == sweep:
                return int(entry.name)
    return None
