"""Files are damaged at random: bits, bytes, lines and numbers change, parts are removed, repeated or exchanged; HDF5
files also lose objects, or get others of another type, shape or value. A command of `vitrel` reads each, under the
address and undefined-behaviour sanitizers. A finding is a crash, an input that takes more than 5 s of processor time,
an exit code other than 0, 2, 3, 4 and 5, or a refusal with no message or more than three lines.

{table}
"""

import concurrent.futures
import json
import os
import re
import subprocess

from validation.common import ROOT, Failure, output_of, table

TITLE = "Damaged files"
INPUTS = ["tests/fuzz", "core/io", "workflow"]

COUNT = 100_000
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
PARTS = tuple(TARGETS)  # of which each keeps its result in build/fuzz; the table shows all that were measured
KEPT = ROOT / "build" / "fuzz"


def sanitized_program():
    for step in (["--preset", "asan"], ["--build", "--preset", "asan", "--target", "vitrel-fuzz"]):
        subprocess.run(["cmake", *step], cwd=ROOT, check=True)
    return ROOT / "build/asan/tests/fuzz/vitrel-fuzz"


def findings(program, target, inputs):
    """The number of these inputs that were read badly; they are kept below the build folder."""
    options = {"UBSAN_OPTIONS": "halt_on_error=1:print_stacktrace=1", "ASAN_OPTIONS": "detect_leaks=0"}
    words = [program, "--target", target, "--first", str(inputs.start), "--inputs", str(len(inputs)), "--keep", KEPT]
    done = subprocess.run(words, capture_output=True, text=True, check=False, env=os.environ | options)
    print(done.stdout + done.stderr, flush=True)
    counted = re.search(rf"^{target}: {len(inputs)} inputs, (\d+) findings$", done.stdout, re.MULTILINE)
    if not counted or int(counted[1]) > 0:
        raise Failure(f"{target}: see above and {KEPT}")
    return int(counted[1])


def measure_target(program, target, pool):
    """All cores share the inputs of one target."""
    result_file(target).unlink(missing_ok=True)
    share = -(-COUNT // os.cpu_count())
    ranges = [range(first, min(first + share, COUNT)) for first in range(0, COUNT, share)]
    found = sum(pool.map(lambda inputs: findings(program, target, inputs), ranges))
    commit = output_of(["git", "-C", ROOT, "rev-parse", "--short=8", "HEAD"]).strip()
    KEPT.mkdir(parents=True, exist_ok=True)
    result_file(target).write_text(json.dumps({"findings": found, "commit": commit}), encoding="utf-8")


def result_file(target):
    return KEPT / f"{target}.json"


def row(target):
    if not result_file(target).exists():
        return [TARGETS[target], "not measured", "", ""]
    result = json.loads(result_file(target).read_text(encoding="utf-8"))
    return [TARGETS[target], f"{COUNT:,}".replace(",", " "), result["findings"], result["commit"]]


def measure(_build, parts=PARTS):
    program = sanitized_program()
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for target in parts:
            measure_target(program, target, pool)
    rows = [row(target) for target in TARGETS]
    return {"table": table(["files", "inputs", "findings", "commit"], rows)}
