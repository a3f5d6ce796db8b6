"""Opens the ParaView series of a trajectory: the collection as XML, as VTK has no reader of it, and its files with
VTK. Which images there are is compared for a single frame (read_vtk.py), of which every file must be a copy."""
import os
import subprocess
import sys
import xml.etree.ElementTree

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from exported import expect, export
from vtk_files import opened, point_data


def single(k):
    """The bytes of frame k, exported alone."""
    program, source = sys.argv[1:]
    path = os.path.join(os.path.dirname(folder), f"{k}.vtp")
    subprocess.run([program, "export", source, "--to", "vtp", "--frames", str(k), "-o", path, "-q"], check=True)
    with open(path, "rb") as file:
        return file.read()


right, folder = export("vtp", "series")
name = os.path.splitext(os.path.basename(sys.argv[2]))[0] + ".pvd"
collection = xml.etree.ElementTree.parse(os.path.join(folder, name)).getroot()
assert collection.tag == "VTKFile" and collection.get("type") == "Collection"
datasets = collection.findall("Collection/DataSet")
expect("times", [float(dataset.get("timestep")) for dataset in datasets], right.time)
files = [dataset.get("file") for dataset in datasets]
assert sorted(os.listdir(folder)) == sorted([name, *files])
for k, file in enumerate(files):
    path = os.path.join(folder, file)
    with open(path, "rb") as vtp:
        assert vtp.read() == single(k)
    points = opened(vtk.vtkXMLPolyDataReader(), path)
    data = point_data(points)
    i, shift = data["particle"], data["image"]
    expect("particle", i[(shift == 0).all(axis=1)], np.arange(right.n))
    expect("position", vtk_to_numpy(points.GetPoints().GetData()), right.position[k][i] + shift * right.box[k])
    expect("orientation", data["orientation"], right.orientation[k][i])
    expect("semi-axes", data["semi-axes"], right.axes[i])
    assert ("velocity" in data) == ("angular velocity" in data) == right.has_velocity
    if right.has_velocity:
        expect("velocity", data["velocity"], right.velocity[k][i])
        expect("angular velocity", data["angular velocity"], right.angular_velocity[k][i])
