"""Opens an exported extended XYZ file with ASE and compares every column: the text carries all digits."""
import ase.io
import numpy as np

from exported import expect, expect_near, export

right, path = export("xyz")
frames = ase.io.read(path, index=":")
assert len(frames) == right.frames
for k, atoms in enumerate(frames):
    zero = np.zeros(right.n)
    half = right.angle[k] / 2
    expect("cell", atoms.cell.array, np.diag([*right.box[k], 1]))
    expect("Origin", atoms.info["Origin"], [*(-right.box[k] / 2), -0.5])
    expect("pbc", atoms.pbc, [True, True, False])
    assert atoms.info["Time"] == right.time[k] and atoms.info["Step"] == right.step[k]
    expect("pos", atoms.positions, right.position[k])
    expect("map_shift", atoms.arrays["map_shift"], right.image[k])
    expect("type", atoms.arrays["type"], [name.replace(" ", "_") for name in right.species])
    expect("id", atoms.arrays["id"], np.arange(right.n))
    expect("angle", atoms.arrays["angle"], right.angle[k])
    # One unit in the last place: the sine of another library may round differently.
    quaternions = np.stack([zero, zero, np.sin(half), np.cos(half)], axis=1)
    expect_near("orientation", atoms.arrays["orientation"], quaternions, 3e-16)
    expect("aspherical_shape", atoms.arrays["aspherical_shape"], right.axes[:, [0, 1, 1]])
    expect("mass", atoms.arrays["mass"], right.mass)
    assert ("velo" in atoms.arrays) == ("omega" in atoms.arrays) == right.has_velocity
    if right.has_velocity:
        expect("velo", atoms.arrays["velo"], right.velocity[k])
        omega = np.stack([zero, zero, right.angular_velocity[k]], axis=1)
        expect("omega", atoms.arrays["omega"], omega)
