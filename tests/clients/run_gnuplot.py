"""Exports results for gnuplot, compares every number of the tables with those in HDF5, runs every script
and looks for the curves in the pictures: run_gnuplot.py <vitrel> <results> <gnuplot>."""
import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

import h5py
import numpy as np

program, source, gnuplot = sys.argv[1:]
folder = tempfile.TemporaryDirectory()
output = os.path.join(folder.name, "plots")
subprocess.run([program, "export", source, "--to", "gnuplot", "-o", output, "-q"], check=True)

# What is to be drawn, by table: logarithmic in x, and for each panel its unit (logarithmic in y or not)
# and its curves.
DRAWN = {
    "displacements_all": (True, [("length^2", True, ["msd", "msd_parallel"]), ("length^4", True, ["quartic"]),
                                 ("1", False, ["non_gaussian"]), ("rad^2", True, ["msr"])]),
    "self_scattering_all": (True, [("1", False, ["fs_1 (q = 1.5)", "fs_2 (q = 3.25)", "fs_3 (q = 6.125)"])]),
    "collective_scattering": (True, [("1", False, ["f_1 (q = 1.5)", "f_2 (q = 3.25)", "f_3 (q = 6.125)"])]),
    "susceptibility": (True, [("1", False, ["overlap", "chi_4"])]),
    "structure_factor": (False, [("1", False, ["s", "s_A_B"])]),
    "pair_correlation": (False, [("1", False, ["g", "g_2"])]),
    "orientation_distribution": (False, [("1/rad", False, ["density"])]),
    "energies": (False, [("kT", False, ["rotational", "total"])]),
    "runs": (False, [("1", False, ["compressibility_factor"]), ("length^2/time", True, ["diffusion"]),
                     ("rad^2/time", True, ["rotational_diffusion"])]),
}
NOT_DRAWN = {"summary", "wave_numbers"}


def stored_columns(group):
    """Names with units, and the values, each error after its value."""
    names, values = [], []
    for name in group.attrs["columns"].decode().split(","):
        for full in (name, name + "_error"):
            if full in group:
                names.append(f"{full} [{group[full].attrs['unit'].decode()}]")
                values.append(group[full][:])
    return names, np.array(values).T


def check_table(table, group):
    path = os.path.join(output, table + ".dat")
    names, values = stored_columns(group)
    found = np.loadtxt(path, ndmin=2)
    assert found.shape == values.shape and np.array_equal(found, values, equal_nan=True), table
    with open(path) as file:
        lines = [line.rstrip("\n") for line in file]
    assert [line for line in lines if line.startswith("# column")] == [
        f"# column {k}: {name}" for k, name in enumerate(names, 1)]
    assert "# source: run.h5" in lines and "# command_line: vitrel run -o run.h5" in lines


def panels(script):
    """Of every plot command: the y label, whether y is logarithmic, the titles."""
    found, logarithmic, label = [], False, ""
    for line in script.splitlines():
        if "set logscale y" in line:
            logarithmic = not line.startswith("unset")
        elif line.startswith("set ylabel"):
            label = line.split('"')[1] or "1"
        elif line.startswith("plot"):
            found.append((label, logarithmic, []))
        if " title " in line and line.startswith("  "):
            found[-1][2].append(re.search(r'title "([^"]*)"', line)[1])
    return found


def drawn_points(picture, titles):
    """The number of points that lines or marks of every curve with these titles have in the picture."""
    points = {}
    for group in xml.parse(picture).iter("{http://www.w3.org/2000/svg}g"):
        title = group.find("{http://www.w3.org/2000/svg}title")
        if title is None or title.text not in titles:
            continue
        marks = sum(1 for _ in group.iter("{http://www.w3.org/2000/svg}use"))
        paths = [path.get("d", "") for path in group.iter("{http://www.w3.org/2000/svg}path")]
        points[title.text] = max(marks, sum(len(re.findall("[ML]?-?[0-9.]+,-?[0-9.]+", d)) for d in paths))
    return points


def check_script(table):
    with open(os.path.join(output, table + ".gp")) as file:
        script = file.read()
    logarithmic, expected = DRAWN[table]
    assert ("\nset logscale x\n" in script) == logarithmic, table
    assert panels(script) == expected, (table, panels(script))
    done = subprocess.run([gnuplot, table + ".gp"], cwd=output, capture_output=True, text=True, check=True)
    assert done.stderr == "" and done.stdout == "", done.stderr + done.stdout
    titles = [title for _, _, names in expected for title in names]
    points = drawn_points(os.path.join(output, table + ".svg"), titles)
    assert set(points) == set(titles), (table, points)
    assert all(number >= 3 for number in points.values()), (table, points)


with h5py.File(source, "r") as file:
    tables = file.attrs["tables"].decode().split(",")
    for table in tables:
        check_table(table, file[table])
assert set(tables) == {*DRAWN, *NOT_DRAWN}
assert set(os.listdir(output)) == {t + ".dat" for t in tables} | {t + ".gp" for t in DRAWN}
for table in DRAWN:
    check_script(table)
