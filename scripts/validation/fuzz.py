"""Damaged files for every reader of the program, under the address and undefined-behaviour sanitizers."""

import concurrent.futures
import os
import re
import subprocess

from validation.common import ROOT, Failure, table

TITLE = "Damaged files"

INPUTS = 100_000
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
}


def sanitized_program():
    for step in (["--preset", "asan"], ["--build", "--preset", "asan", "--target", "vitrel-fuzz"]):
        subprocess.run(["cmake", *step], cwd=ROOT, check=True)
    return ROOT / "build/asan/tests/fuzz/vitrel-fuzz"


def findings(program, target):
    """The number of inputs that were read badly; they are kept below the build folder."""
    options = {"UBSAN_OPTIONS": "halt_on_error=1:print_stacktrace=1", "ASAN_OPTIONS": "detect_leaks=0"}
    kept = ROOT / "build" / "fuzz"
    done = subprocess.run([program, "--target", target, "--inputs", str(INPUTS), "--keep", kept], capture_output=True,
                          text=True, check=False, env=os.environ | options)
    print(done.stdout + done.stderr, flush=True)
    counted = re.search(rf"^{target}: {INPUTS} inputs, (\d+) findings$", done.stdout, re.MULTILINE)
    if not counted or int(counted[1]) > 0:
        raise Failure(f"{target}: see above and {kept}")
    return int(counted[1])


def measure(_build):
    program = sanitized_program()
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        counts = list(pool.map(lambda target: findings(program, target), TARGETS))
    rows = [[name, f"{INPUTS:,}".replace(",", " "), count] for name, count in zip(TARGETS.values(), counts)]
    return f"""Files are damaged at random: bits, bytes, lines and numbers change, parts are removed, repeated or exchanged; HDF5 files
also lose objects, or get others of another type, shape or value. A command of `vitrel` reads each, under the address and
undefined-behaviour sanitizers. A finding is a crash, an input that takes more than 5 s of processor time, an exit code other
than 0, 2, 3, 4 and 5, or a refusal with no message or more than three lines.

{table(["files", "inputs", "findings"], rows)}
"""
