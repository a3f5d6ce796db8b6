"""Opens files with VTK."""
from vtk.util.numpy_support import vtk_to_numpy


def opened(reader, path):
    reader.SetFileName(path)
    reader.Update()
    assert reader.GetErrorCode() == 0
    return reader.GetOutput()


def point_data(points):
    data = points.GetPointData()
    return {data.GetArrayName(k): vtk_to_numpy(data.GetArray(k)) for k in range(data.GetNumberOfArrays())}
