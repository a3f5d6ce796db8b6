"""States that other programs wrote: the examples of docs/imports.md, GSD by gsd.hoomd, extended XYZ by ASE."""
import pathlib
import re

import ase
import ase.io
import gsd.hoomd
import numpy as np

from gsd_versions import WRITE, Frame
from program import summary_of, work_in_a_new_folder

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs/imports.md"


def blocks(language):
    return re.findall(f"^```{language}\n(.*?)^```", PAGE.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


def check_start(file, dimension, particles, packing_fraction, tolerance=1e-15):
    """Checks the state, starts a run from it, and returns the summary of the run."""
    checked = summary_of("check", file)
    assert len(checked["box"]) == dimension, checked
    assert checked["particles"] == particles, checked
    assert checked["overlaps"] == 0, checked
    assert abs(checked["packing_fraction"] - packing_fraction) < tolerance, checked
    ran = summary_of("run", "p.toml", "--from", file, "-o", f"{file}.run.h5")
    assert ran["overlaps"] == 0 and abs(ran["packing_fraction"] - checked["packing_fraction"]) < 1e-15, ran


def read_examples_of_the_page():
    (code,) = blocks("python")
    assert len(code.strip().splitlines()) <= 10, "docs/imports.md promises a short example"
    exec(compile(code, str(PAGE), "exec"), {})
    check_start("mine.h5", 2, 2, 2 * np.pi * 0.5 / 36)
    (table,) = blocks("csv")
    pathlib.Path("mine.csv").write_text(table, encoding="utf-8")
    check_start("mine.csv", 2, 2, 2 * np.pi * 0.5 / 36)


def read_solids_of_h5py():
    import h5py  # after the example, which imports it itself

    with h5py.File("solids.h5", "w") as file:
        particles = file.create_group("particles/all")
        particles["box/edges"] = np.array([6.0, 7.0, 8.0])
        particles["semiaxes"] = np.array([[1.0, 0.5, 0.7], [1.2, 0.5, 0.5]])
        particles["position"] = np.array([[0.0, 0.0, 0.0], [2.5, 0.1, 1.0]])
        particles["orientation"] = np.array([[1.0, 0.0, 0.0, 0.0], [0.6, 0.0, 0.8, 0.0]])
    check_start("solids.h5", 3, 2, 4 * np.pi / 3 * (0.35 + 0.3) / 336)


def read_gsd():
    frame = Frame()
    frame.configuration.step = 100
    frame.configuration.box = [10, 10, 10, 0, 0, 0]
    frame.particles.N = 3
    frame.particles.types = ["rod", "ball"]
    frame.particles.typeid = [0, 1, 0]
    frame.particles.type_shapes = [{"type": "Ellipsoid", "a": 2.0, "b": 1.0, "c": 0.5},
                                   {"type": "Sphere", "diameter": 2.0}]
    frame.particles.position = [[0, 0, 0], [4, 0, 0], [0, 4, 1]]
    frame.particles.orientation = [[1, 0, 0, 0], [1, 0, 0, 0], [0.6, 0.8, 0, 0]]
    with gsd.hoomd.open("rods.gsd", WRITE) as file:
        file.append(frame)
        frame.configuration.step = 200
        frame.particles.position = [[0, 0, 1], [4, 0, 0], [0, 4, 1]]
        file.append(frame)
    assert summary_of("check", "rods.gsd")["frames"] == 2
    check_start("rods.gsd", 3, 3, 4 * np.pi / 3 * (1 + 1 + 1) / 1000)
    summary_of("export", "rods.gsd", "--to", "csv", "-o", "rods.csv")
    rows = [line.split(",") for line in pathlib.Path("rods.csv").read_text(encoding="utf-8").splitlines()]
    name = [cell.split(" ")[0] for cell in rows[0]]
    last = dict(zip(name, rows[4]))
    assert (last["step"], last["species"], last["z"], last["a"]) == ("200", "rod", "1", "2"), last


def read_xyz_of_ase():
    atoms = ase.Atoms("ArKrAr", positions=[[1, 1, 1], [4, 4, 4], [1, 4, 1]], cell=[7, 8, 9], pbc=True)
    atoms.arrays["radius"] = np.array([1.0, 1.5, 1.0])
    ase.io.write("balls.xyz", atoms, format="extxyz", columns=["symbols", "positions", "radius"])
    check_start("balls.xyz", 3, 3, 4 * np.pi / 3 * (2 + 1.5**3) / 504)


with work_in_a_new_folder():
    pathlib.Path("p.toml").write_text("[dynamics]\nequilibration = 0\nduration = 1\n", encoding="utf-8")
    read_examples_of_the_page()
    read_solids_of_h5py()
    read_gsd()
    read_xyz_of_ase()
