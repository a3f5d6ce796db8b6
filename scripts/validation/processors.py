"""The package `vitrel` has builds for x86-64 and for x86-64-v3, and the dynamic linker takes the second one where the
processor has AVX2. All scenes of `scripts/checksums` were run by the native build, by the installation, and by the
installation under the mask of an old processor, which gets the first one and the functions of the C library without
fused multiply-add. Trajectories and checkpoints must have the same bits; tables must agree within {TABLES} of their
largest number.

- native and x86-64-v3: {newer}
- native and x86-64, masked: {older}

Checkpoints have the same bits, so that any of these builds continues what another one has begun. Which build the dynamic
linker takes is a part of `scripts/validate packages`.
"""

import pathlib
import subprocess
import tempfile

from validation.common import ROOT, expect

TITLE = "One installation for every processor"
TABLES = "1e-12"  # relative to the largest number of a dataset


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
    return folder / "usr/bin/vitrel"


def measure(build):
    native = build / "app/vitrel"
    with tempfile.TemporaryDirectory() as folder:
        installed = installed_program(pathlib.Path(folder))
        return {"newer": differences(native, installed), "older": differences(native, installed, "--masked")}
