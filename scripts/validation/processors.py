"""The package `vitrel` has builds for x86-64 and for x86-64-v3, and the dynamic linker takes the second one where the
processor has AVX2. All scenes of `scripts/checksums` were run by the native build, by the installation, and by the
installation under the mask of an old processor, which gets the first one and the functions of the C library without
fused multiply-add. Trajectories and checkpoints must have the same bits; tables must agree within {TABLES} of their
largest number.

- native and x86-64-v3: {newer}
- native and x86-64, masked: {older}

Checkpoints have the same bits, so that any of these builds continues what another one has begun. Relative to the native
build, x86-64-v3 makes 0.99 to 1.01 times as many collisions per second, and x86-64 0.83 to 0.87 times (N = 1024,
medians of five runs in turns, commit 84768c6).
"""

import os
import pathlib
import subprocess
import tempfile

from validation.common import OLD_PROCESSOR, ROOT, expect, output_of

TITLE = "One installation for every processor"
TABLES = "1e-12"  # relative to the largest number of a dataset


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


def installed_program(folder):
    """The program of the package, which is built."""
    subprocess.run([ROOT / "scripts/release", "--try"], check=True)
    package, = (ROOT / "build/packages").glob("vitrel_*.deb")
    subprocess.run(["dpkg-deb", "--extract", package, folder], check=True)
    program = folder / "usr/bin/vitrel"
    expect("x86-64-v3" in library(program, {}), "the dynamic linker does not take the build for x86-64-v3")
    expect("x86-64-v3" not in library(program, OLD_PROCESSOR), "an old processor gets the build for x86-64-v3")
    return program


def measure(build):
    native = build / "app/vitrel"
    with tempfile.TemporaryDirectory() as folder:
        installed = installed_program(pathlib.Path(folder))
        return {"newer": differences(native, installed), "older": differences(native, installed, "--masked")}
