"""Opens the voxels and the points of a packing with VTK."""
import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from packing import export, grid
from vtk_files import opened, point_data

N = 40

right, path = export("vti", "--voxels", str(N))
image = opened(vtk.vtkXMLImageDataReader(), path)
assert image.GetDimensions() == (N + 1,) * 3
assert np.allclose(image.GetSpacing(), right.box / N, rtol=1e-14)
assert np.allclose(image.GetBounds(), np.stack([-right.box / 2, right.box / 2], axis=1).ravel(), rtol=1e-14)
holder = vtk_to_numpy(image.GetCellData().GetArray("particle"))
centres = grid(right.box, N)
expected = np.full(N**3, -1)
for i, shift in right.images(centres):
    expected[right.inside(i, np.array(shift), centres)] = i
assert np.array_equal(holder, expected)
# Voxels hold the volume to about the surface times an eighth of a voxel.
assert abs((holder >= 0).mean() - right.volumes().sum() / right.box.prod()) < 0.01

right, path = export("vtp")
points = opened(vtk.vtkXMLPolyDataReader(), path)
data = point_data(points)
particle, shift = data["particle"], data["image"]
assert [(i, tuple(s)) for i, s in zip(particle, shift)] == list(right.images(grid(right.box, 80)))
assert points.GetNumberOfVerts() == len(particle)
assert np.array_equal(vtk_to_numpy(points.GetPoints().GetData()), right.position[particle] + shift * right.box)
assert np.array_equal(data["species"], right.kind[particle])
assert np.array_equal(data["semi-axes"], right.axes[particle])
assert np.array_equal(data["orientation"], right.orientation[particle])
for i, tensor in zip(particle, data["tensor"]):
    assert np.allclose(tensor.reshape(3, 3), right.turn[i] @ np.diag(right.axes[i]) @ right.turn[i].T, atol=1e-15)

# Tensor glyphs of a sphere of radius 1 are the bodies: each fills its extents √Σ_kk about its centre.
sphere = vtk.vtkSphereSource()
sphere.SetRadius(1)
sphere.SetThetaResolution(100)
sphere.SetPhiResolution(100)
glyphs = vtk.vtkTensorGlyph()
glyphs.SetInputData(points)
glyphs.SetSourceConnection(sphere.GetOutputPort())
glyphs.Update()
surface = vtk_to_numpy(glyphs.GetOutput().GetPoints().GetData()).reshape(len(particle), -1, 3)
for i, s, body in zip(particle, shift, surface):
    extents = np.sqrt(np.diag(right.turn[i] @ np.diag(right.axes[i]**2) @ right.turn[i].T))
    assert np.allclose(body.max(axis=0), right.position[i] + s * right.box + extents, atol=2e-3)
