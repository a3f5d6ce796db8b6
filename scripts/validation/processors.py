"""One installation for processors of every age: the same trajectories from all builds, and their speed."""

import json
import os
import pathlib
import statistics
import subprocess
import tempfile

from validation.common import OLD_PROCESSOR, ROOT, differing_datasets, expect, output_of, table

TITLE = "One installation for every processor"
TABLES = "1e-12"  # relative to the largest number of a dataset
REPEATS = 5

PARAMETERS = """[system]
particles = 1024
packing_fraction = {packing_fraction}
seed = 1

[[species]]
name = "A"
fraction = 1.0
aspect_ratio = {aspect_ratio}

[[prepare.stage]]
method = "insert"
packing_fraction = 0.3

[[prepare.stage]]
method = "swell"

[[prepare.stage]]
method = "sample"
sweeps = 1000

[dynamics]
kind = "newtonian"
equilibration = 0.0
duration = 300

[output]
samples = {{ spacing = "linear", interval = 100 }}
"""
SCENES = [("disks", 1.0, 0.7), ("κ = 2", 2.0, 0.7), ("κ = 6", 6.0, 0.5)]


def library(program, variables):
    """The library with the program that the dynamic linker chooses."""
    lines = output_of([program], env={**os.environ, **variables, "LD_TRACE_LOADED_OBJECTS": "1"}).splitlines()
    return next(line.split("=>")[1].split()[0] for line in lines if "libvitrel_program" in line)


def differences(native, installed, *options):
    """How many results were the same; fails if one is not."""
    command = [ROOT / "scripts/checksums", native, "--against", installed, "--tables-within", TABLES, *options]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    expect(done.returncode == 0, f"{' '.join(map(str, command))}:\n{done.stdout}")
    return done.stdout.strip()


def run(program, variables, folder, output, *options):
    """Standard output and exit code of a run from state.h5."""
    words = [program, "run", "p.toml", "--from", "state.h5", "-o", output, "--json", *options]
    done = subprocess.run(words, cwd=folder, env={**os.environ, **variables}, capture_output=True, text=True, check=False)
    expect(done.returncode in (0, 5), done.stderr)
    return done.stdout, done.returncode


def summary(program, variables, folder, output):
    text, code = run(program, variables, folder, output)
    expect(code == 0, f"{output}: stopped")
    return json.loads(text)


def continues_elsewhere(programs, folder, seconds):
    """Runs begun by one build and ended by another one are compared with that of one build alone."""
    summary(*programs["native"], folder, "alone.h5")
    names = list(programs)
    for begin, end in zip(names, names[1:] + names[:1]):
        output = f"{begin}-{end}.h5"
        _, code = run(*programs[begin], folder, output, "--wall-time", f"{seconds:.3f}")
        expect(code == 5, f"{output}: ended before it could be continued")
        summary(*programs[end], folder, output)
        different = differing_datasets(folder / "alone.h5", folder / output)
        expect(not different, f"{output}: {', '.join(different)}")


def speeds(programs, scene, folder):
    """Median collisions per second of each program, run in turns."""
    folder.mkdir()
    _, kappa, phi = scene
    (folder / "p.toml").write_text(PARAMETERS.format(aspect_ratio=kappa, packing_fraction=phi), encoding="utf-8")
    output_of([programs["native"][0], "prepare", folder / "p.toml", "-o", folder / "state.h5"])
    found = {name: [] for name in programs}
    for repeat in range(REPEATS):
        for name, one in programs.items():
            found[name].append(summary(*one, folder, f"{name}_{repeat}.h5"))
    continues_elsewhere(programs, folder, min(one["wall_seconds"] for one in found["native"]) / 3)
    return {name: statistics.median(one["collisions_per_second"] for one in runs) for name, runs in found.items()}


def measure(build):
    native = build / "app/vitrel"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        subprocess.run([ROOT / "scripts/release", "--try"], check=True)
        package, = (ROOT / "build/packages").glob("vitrel_*.deb")
        subprocess.run(["dpkg-deb", "--extract", package, folder / "prefix"], check=True)
        installed = folder / "prefix/usr/bin/vitrel"
        expect("x86-64-v3" in library(installed, {}), "the dynamic linker does not take the build for x86-64-v3")
        expect("x86-64-v3" not in library(installed, OLD_PROCESSOR), "an old processor gets the build for x86-64-v3")
        same = [differences(native, installed), differences(native, installed, "--masked")]
        programs = {"native": (native, {}), "x86-64-v3": (installed, {}), "x86-64": (installed, OLD_PROCESSOR)}
        rows = []
        for scene in SCENES:
            found = speeds(programs, scene, folder / scene[0])
            rows.append([*scene[::2], *(f"{found[name] / found['native']:.2f}" for name in ("x86-64-v3", "x86-64"))])
    return f"""The package `vitrel` has builds for x86-64 and for x86-64-v3, and the dynamic linker takes the second one where
the processor has AVX2. All scenes of `scripts/checksums` were run by the native build, by the installation, and by
the installation under the mask of an old processor, which gets the first one and the functions of the C library without
fused multiply-add. Trajectories and checkpoints must have the same bits; tables must agree within {TABLES} of their
largest number.

- native and x86-64-v3: {same[0]}
- native and x86-64, masked: {same[1]}

Runs begun by one of these three, stopped and ended by the next one have the same bits as the run of the native build.
Collisions per second, relative to the native build (N = 1024, {REPEATS} runs of each in turns, medians):

{table(["", "φ", "x86-64-v3", "x86-64"], rows)}"""
