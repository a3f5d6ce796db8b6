"""Dumps and data files that LAMMPS wrote: displacements are those that it computed itself."""
import json
import pathlib
import subprocess
import sys

import h5py
import numpy as np

from program import summary_of, vitrel, work_in_a_new_folder

LAMMPS = pathlib.Path(sys.argv[2]).resolve()
ATOMS = 108
# A liquid of Lennard-Jones atoms of two types in the units of lj, with dumps of several forms.
SCRIPT = """units lj
atom_style atomic
lattice fcc 0.6
region box block 0 3 0 3 0 3
create_box 2 box
create_atoms 1 box
set type 1 type/fraction 2 0.3 81
mass 1 1
mass 2 2
velocity all create 1.5 87287
pair_style lj/cut 2.5
pair_coeff * * 1 1
fix 1 all nve
compute msd all msd
thermo_style custom step c_msd[4]
thermo 100
dump plain all atom 100 plain.dump
dump images all custom 100 images.dump id type x y z ix iy iz vx vy vz
dump unwrapped all custom 100 unwrapped.dump id type xu yu zu mass
dump xyz all xyz 100 plain.xyz
run 2000
write_data end.data nocoeff
"""
SIZES = """[[import.species]]
name = "1"
diameter = 0.7
mass = 1
[[import.species]]
name = "2"
diameter = 0.7
mass = 2
"""


def analyzed(dump, output, *settings):
    return summary_of("analyze", dump, "-o", output, "--params", "sizes.toml", *settings)["import"]


def paths():
    """Unwrapped by LAMMPS: frames × atoms × 3; their displacements are those that it computed."""
    words = pathlib.Path("unwrapped.dump").read_text(encoding="utf-8").split("ITEM: ATOMS id type xu yu zu mass")[1:]
    frames = [np.array([line.split() for line in text.split("ITEM:")[0].strip().splitlines()], float) for text in words]
    paths_of_atoms = np.array([frame[np.argsort(frame[:, 0]), 2:5] for frame in frames])
    rows = [line.split() for line in pathlib.Path("log.lammps").read_text(encoding="utf-8").splitlines()]
    from_first = {int(row[0]): float(row[1]) for row in rows if len(row) == 2 and row[0].isdigit()}
    np.testing.assert_allclose(np.sum((paths_of_atoms[-1] - paths_of_atoms[0])**2, axis=1).mean(), from_first[2000], rtol=1e-3)
    return paths_of_atoms


def compare_motion(dump, accuracy, *settings):
    imported = analyzed(dump, "results.h5", *settings)
    assert imported["format"] == "LAMMPS dump", imported
    unwrapped = paths()
    with h5py.File("results.h5") as results:
        moved = results["displacements_all"]
        assert moved["time"].attrs["unit"] in ("steps", b"steps"), moved["time"].attrs["unit"]
        for time, msd in zip(moved["time"][:], moved["msd"][:]):
            lag = round(time / 100)
            expected = np.sum((unwrapped[lag:] - unwrapped[:-lag])**2, axis=2).mean()
            np.testing.assert_allclose(msd, expected, rtol=accuracy)


with work_in_a_new_folder():
    pathlib.Path("in.lammps").write_text(SCRIPT, encoding="utf-8")
    pathlib.Path("sizes.toml").write_text(SIZES, encoding="utf-8")
    subprocess.run([LAMMPS, "-in", "in.lammps", "-log", "log.lammps"], stdout=subprocess.DEVNULL, check=True)
    compare_motion("images.dump", 2e-4)
    compare_motion("unwrapped.dump", 2e-4)
    compare_motion("plain.dump", 2e-4, "--set", "import.unwrap=nearest")
    left_out = analyzed("plain.dump", "plain.h5")["absent"]
    assert "box crossings (motion is left out)" in left_out, left_out
    for file, what in (("end.data", "LAMMPS data"), ("plain.xyz", "extended XYZ")):
        settings = [] if what == "LAMMPS data" else ["--set", "import.box=[5.6462, 5.6462, 5.6462]"]
        done = vitrel("check", file, "--params", "sizes.toml", "--json", *settings)
        summary = json.loads(done.stdout)  # some atoms are closer than the diameters that are given here
        assert done.returncode in (0, 4) and summary["particles"] == ATOMS, done.stderr
        assert summary["import"]["format"] == what, summary
