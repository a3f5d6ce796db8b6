"""Files are damaged at random: bits, bytes, lines and numbers change, parts are removed, repeated or exchanged; HDF5
files also lose objects, or get others of another type, shape or value. A command of `vitrel` reads each, under the
address and undefined-behaviour sanitizers. A finding is a crash, an input that takes more than 5 s of processor time,
an exit code other than 0, 2, 3, 4 and 5, or a refusal with no message or more than three lines. The Python package, under
the same sanitizers, passes all of its tests, among them calls with random arguments. None of these has a finding:

{table}
"""

import concurrent.futures
import os
import subprocess

from validation.common import ROOT, Failure, output_of, table

TITLE = "Damaged files"
INPUTS = ["tests/fuzz", "core/io", "workflow"]

COUNT = 100_000
CALLS = 10_000
TARGETS = {
    "parameters": "parameter files",
    "pairs": "files of pairs",
    "trajectory": "trajectories and states",
    "checkpoint": "checkpoints",
    "correlations": "correlations on the fly",
    "gsd": "GSD",
    "xyz": "extended XYZ",
    "csv": "CSV",
    "h5md": "H5MD of other programs",
    "lammps": "dumps and data files of LAMMPS",
    "python": "calls of the Python package",
}
PARTS = tuple(TARGETS)  # each keeps its commit among the data of the pages; the table shows all that were measured
KEPT = ROOT / "build/fuzz"  # files that were read badly
ENVIRONMENT = os.environ | {"UBSAN_OPTIONS": "halt_on_error=1:print_stacktrace=1", "VITREL_RANDOM_CALLS": str(CALLS),
                            "ASAN_OPTIONS": "detect_leaks=0:malloc_context_size=0:quarantine_size_mb=16"}


def sanitized_program():
    for step in (["--preset", "asan"], ["--build", "--preset", "asan", "--target", "vitrel-fuzz", "vitrel", "vitrel_python"]):
        subprocess.run(["cmake", *step], cwd=ROOT, check=True)
    return ROOT / "build/asan/tests/fuzz/vitrel-fuzz"


def expect_success(words):
    """What is wrong is shown; files that were read badly are kept below the build folder."""
    done = subprocess.run(words, capture_output=True, text=True, check=False, env=ENVIRONMENT)
    print(done.stdout + done.stderr, flush=True)
    if done.returncode:
        raise Failure(f"{' '.join(map(str, words))}: see above and {KEPT}")


def measure_target(program, target, pool):
    """All cores share the inputs of one target. Bound to its core, no process waits for threads of its own."""
    commit_file(target).unlink(missing_ok=True)
    cores = sorted(os.sched_getaffinity(0))
    share = -(-COUNT // len(cores))
    commands = [["taskset", "-c", str(core), program, "--target", target, "--first", str(first), "--inputs",
                 str(min(share, COUNT - first)), "--keep", KEPT] for core, first in zip(cores, range(0, COUNT, share))]
    if target == "python":
        commands = [["ctest", "--test-dir", ROOT / "build/asan", "--output-on-failure", "-R", r"^python\."]]
    list(pool.map(expect_success, commands))
    commit_file(target).parent.mkdir(parents=True, exist_ok=True)
    commit_file(target).write_text(output_of(["git", "-C", ROOT, "rev-parse", "--short=8", "HEAD"]).strip(), encoding="utf-8")


def commit_file(target):
    return ROOT / f"docs/data/damaged_files/{target}.commit"


def row(target):
    file, count = commit_file(target), CALLS if target == "python" else COUNT
    known = [f"{count:,}".replace(",", " "), file.read_text(encoding="utf-8")] if file.exists() else ["not measured", ""]
    return [TARGETS[target], *known]


def measure(_build, parts=PARTS):
    program = sanitized_program()
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for target in parts:
            measure_target(program, target, pool)
    return {"table": table(["files", "inputs", "commit"], map(row, TARGETS))}
