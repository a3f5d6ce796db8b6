"""Opens an exported extended XYZ file with ASE and compares every column: the text carries all digits."""
import ase.io
import numpy as np

from exported import expect, expect_near, export

right, path = export("xyz")
in_plane = right.dimension == 2
frames = ase.io.read(path, index=":")
assert len(frames) == right.frames
for k, atoms in enumerate(frames):
    expect("cell", atoms.cell.array, np.diag(right.box[k]))
    expect("Origin", atoms.info["Origin"], -right.box[k] / 2)
    expect("pbc", atoms.pbc, [True, True, not in_plane])
    assert atoms.info["Time"] == right.time[k] and atoms.info["Step"] == right.step[k]
    expect("pos", atoms.positions, right.position[k])
    expect("map_shift", atoms.arrays["map_shift"], right.image[k])
    expect("type", atoms.arrays["type"], [name.replace(" ", "_") for name in right.species])
    expect("id", atoms.arrays["id"], np.arange(right.n))
    assert ("angle" in atoms.arrays) == in_plane
    if in_plane:
        expect("angle", atoms.arrays["angle"], right.angle[k])
    # One unit in the last place: the sine of another library may round differently.
    tolerance = 3e-16 if in_plane else 0
    expect_near("orientation", atoms.arrays["orientation"], right.orientation[k][:, [1, 2, 3, 0]], tolerance)
    expect("aspherical_shape", atoms.arrays["aspherical_shape"], right.axes)
    expect("mass", atoms.arrays["mass"], right.mass)
    assert ("velo" in atoms.arrays) == ("omega" in atoms.arrays) == right.has_velocity
    if right.has_velocity:
        expect("velo", atoms.arrays["velo"], right.velocity[k])
        expect("omega", atoms.arrays["omega"], right.angular_velocity[k])
