"""Helpers shared by the validations."""

import json
import math
import os
import pathlib
import platform
import re
import statistics
import subprocess
import sys
import tempfile
import typing

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PARAMS = ROOT / "params"
# An environment in which glibc does as on a processor without AVX and fused multiply-add; elsewhere it has no effect.
OLD_PROCESSOR = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX,-AVX2,-FMA,-FMA4,-AVX512F"}


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


def save_charts(page, folder, names=None):
    """Charts of a page as SVG, drawn by the page; all, or those of these names."""
    sys.path.insert(0, str(ROOT / "tests/browser"))
    from browser import Browser  # needed only here

    folder.mkdir(parents=True, exist_ok=True)
    with Browser(os.environ.get("CHROMIUM", "chromium")) as browser:
        browser.resize(900, 700, "light")
        browser.open(f"file://{page}")
        charts = [(name, text) for name, text in browser.saved("SVG") if names is None or name in names]
    for name, text in charts:
        folder.joinpath(name).write_text(text, encoding="utf-8")
    missing = set(names or []) - {name for name, _ in charts}
    expect(not missing, f"{page.name} has no chart {', '.join(sorted(missing))}")


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


class Estimate(typing.NamedTuple):
    """A mean and its standard error."""

    mean: float
    error: float

    def __str__(self):
        return text_of(self.mean, self.error, self.digits()) if self.error else f"{self.mean:.6g}"

    def digits(self):
        """Decimals that show two digits of the error."""
        return max(0, 1 - math.floor(math.log10(self.error))) if math.isfinite(self.error) else 3


def estimate(values):
    """Of independent values."""
    return Estimate(statistics.mean(values), statistics.stdev(values) / math.sqrt(len(values)))


def series_estimate(values):
    """Of a series of values that are correlated: the correlations up to the first that is not positive are summed."""
    n, mean = len(values), statistics.mean(values)
    deviations = [value - mean for value in values]
    variance = sum(d * d for d in deviations) / n
    time = 1.0
    for lag in range(1, n // 2):
        correlation = sum(a * b for a, b in zip(deviations, deviations[lag:])) / n / variance
        if correlation <= 0:
            break
        time += 2 * correlation
    return Estimate(mean, math.sqrt(variance * n / (n - 1) * time / n))


def text_of(mean, error, digits=3):
    return f"{mean:.{digits}f} ± {error:.{digits}f}"


def processor():
    found = re.search(r"^model name\s*: (.+)$", pathlib.Path("/proc/cpuinfo").read_text(), re.MULTILINE)
    return found[1] if found else platform.machine()


def table(head, rows):
    """A Markdown table."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines)


def shape(kappa):
    return "disks" if kappa == 1 else f"κ = {kappa:g}"
