"""The page of the platforms, from the records of their builds."""

from validation.common import table

LIBRARIES = ("CMake", "HDF5", "Eigen", "fmt", "CLI11", "Python")

HEAD = """# Platforms

vitrel is built from its sources in systems that have only what `apt` needs (debootstrap, variant minbase), with the
compilers and libraries of their distribution. Debian 13 for 64-bit ARM is compiled on x86-64 and emulated by qemu.
`scripts/validate platforms` measures all of it and writes this page.
"""

EXPLANATION = """
*Warnings* are those of CMake and of the compiler in all builds. The *demo* is `scripts/demo`: from the sources to the
page of a small sweep, after the installation of the packages. *Tests* are those of `scripts/test` (all), the unit
tests, or those of the folders named. *Results* are all datasets, attributes and tables of the scenes of
`scripts/checksums`, compared with those of GCC on Debian 12: trajectories and states must have the same bits, and
tables must agree within 10⁻¹² of their largest number (the smallest gap: of the unit of length). Times are in seconds.
"""


def problems(record):
    """Why a build is not as it must be; nothing of builds that were not measured."""
    if "failure" in record:
        yield record["failure"].splitlines()[0]
    for kind, number in record.get("warnings", {}).items():
        if number:
            yield f"{number} warnings of {'the compiler' if kind == 'compiler' else kind}"
    if failed := record.get("tests", {}).get("failed"):
        yield f"{len(failed)} tests fail"
    if different := record.get("results", {}).get("different"):
        yield f"{different} results differ"


def verdict(record):
    if "commit" not in record:
        return "not measured"
    return "; ".join(problems(record)) or "works"


def seconds(record, *names):
    found = [record.get("seconds", {}).get(name) for name in names]
    return next((f"{value:.0f}" for value in found if value is not None), "–")


def version_row(record):
    versions = record.get("versions", {})
    compiler = " ".join([record["compiler"], versions.get("compiler", "")]).strip()
    return [record["system"], compiler, *(versions.get(name, "–") for name in LIBRARIES)]


def tests_text(record):
    if "tests" not in record:
        return "–"
    tests = record["tests"]
    return f"{tests['number'] - len(tests['failed'])} of {tests['number']} ({tests['kind']})"


def results_text(record):
    if "results" not in record:
        return "–"
    results = record["results"]
    return f"{results['number'] - results['different']} of {results['number']}; {results['other bits']} not in all bits"


def outcome_row(record):
    warnings = sum(record["warnings"].values()) if "warnings" in record else "–"
    return [record["system"], record["compiler"], warnings, seconds(record, "packages"), seconds(record, "demo"),
            tests_text(record), seconds(record, "tests"), results_text(record), verdict(record)]


def details(record):
    """Names of what fails, differs or was left out."""
    tests, results = record.get("tests", {}), record.get("results", {})
    lists = {"tests that fail": tests.get("failed"), "results that differ, such as": results.get("such as")}
    for title, names in lists.items():
        if names:
            yield f"{title}: {', '.join(f'`{name}`' for name in names)}"
    yield from tests.get("left out", ())


def measured_text(record):
    return (f"{record['system']}, {record['compiler']}: {record['date']}, commit {record['commit']}, "
            f"{record['processor']}, load {record['load']} before")


def page(records):
    versions = table(["system", "compiler", *LIBRARIES], [version_row(record) for record in records])
    outcomes = table(["system", "compiler", "warnings", "packages (s)", "demo (s)", "tests", "tests (s)", "results",
                      "verdict"], [outcome_row(record) for record in records])
    parts = [HEAD, versions, outcomes, EXPLANATION]
    found = [f"- {record['system']}, {record['compiler']}: {text}" for record in records for text in details(record)]
    if found:
        parts += ["## Details", "\n".join(found)]
    if measured := [f"- {measured_text(record)}" for record in records if "commit" in record]:
        parts += ["## Measured", "\n".join(measured)]
    return "\n\n".join(part.strip() for part in parts) + "\n"
