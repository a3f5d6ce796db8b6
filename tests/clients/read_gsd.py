"""Opens an exported GSD file with gsd.hoomd, by its C library and by its own Python reader, compares every
array, which are in single precision, and appends a frame."""
import re

import gsd.fl
import gsd.hoomd
import gsd.pygsd
import numpy as np

from exported import expect, expect_near, export

right, path = export("gsd")
# One half of a unit in the last place of single precision, relative.
half_unit = 2.0**-24


def product(p, q):
    """Of quaternions w, x, y, z, one per row."""
    w, x, y, z = p.T
    a, b, c, d = q.T
    return np.stack([w * a - x * b - y * c - z * d, w * b + x * a + y * d - z * c,
                     w * c - x * d + y * a + z * b, w * d + x * c - y * b + z * a], axis=1)


def check_box(box, k):
    expect("box", box[2:], [0, 0, 0, 0])
    for found, exact in zip(box[:2], right.box[k]):
        assert found >= exact > np.nextafter(found, np.float32(0)) or found == exact, (found, exact)


def check_position(position, box, k):
    assert position.dtype == np.float32
    half = box[:2] / 2
    assert np.all(position[:, :2] >= -half) and np.all(position[:, :2] < half), position
    # The last number inside the box stands for what would be rounded to its upper edge.
    expected = right.position[k].astype(np.float32)
    expected[:, :2] = np.minimum(expected[:, :2], np.nextafter(half, np.float32(0)))
    expect("position", position, expected)


def check_orientation(orientation, k):
    half = right.angle[k] / 2
    zero = np.zeros(right.n)
    exact = np.stack([np.cos(half), zero, zero, np.sin(half)], axis=1)
    expect_near("orientation", orientation, exact, 1.01 * half_unit)


def check_momentum(particles, k):
    """S = (0, 0, 0, I ω) = conj(q) p / 2, as HOOMD-blue defines the quaternion p."""
    conjugate = particles.orientation.astype(float) * [1, -1, -1, -1]
    spin = product(conjugate, particles.angmom.astype(float)) / 2
    momentum = right.inertia * right.angular_velocity[k]
    exact = np.zeros((right.n, 4))
    exact[:, 3] = momentum
    expect_near("angmom", spin, exact, 4 * half_unit * np.abs(momentum)[:, None])


def check_types(particles):
    """Each particle's type tells its species and its semi-axes; equal particles share a type."""
    assert len(set(particles.types)) == len(particles.types) == len(particles.type_shapes)
    kinds = {(s, *axes) for s, axes in zip(right.species, right.axes)}
    assert len(kinds) == len(particles.types)
    several = {s for s in right.species if sum(kind[0] == s for kind in kinds) > 1}
    for i, number in enumerate(particles.typeid):
        a, b = right.axes[i]
        assert particles.type_shapes[number] == {"type": "Ellipsoid", "a": a, "b": b, "c": b}
        name = particles.types[number]
        species = right.species[i]
        assert re.fullmatch(re.escape(species) + "#[0-9]+", name) if species in several else name == species


def check_frame(frame, k):
    particles = frame.particles
    assert frame.configuration.step == right.step[k] and frame.configuration.dimensions == 2
    assert frame.log["time"] == right.time[k]
    assert particles.N == right.n
    check_box(frame.configuration.box, k)
    check_position(particles.position, frame.configuration.box, k)
    expect("image", particles.image, right.image[k])
    check_orientation(particles.orientation, k)
    check_types(particles)
    expect("mass", particles.mass, right.mass.astype(np.float32))
    expect("moment_inertia", particles.moment_inertia[:, :2], np.zeros((right.n, 2)))
    expect_near("moment_inertia", particles.moment_inertia[:, 2], right.inertia, 1.01 * half_unit * right.inertia)
    if right.has_velocity:
        expect("velocity", particles.velocity, right.velocity[k].astype(np.float32))
        check_momentum(particles, k)
    else:
        assert not np.any(particles.velocity) and not np.any(particles.angmom)


def check_trajectory(trajectory):
    assert trajectory.file.schema == "hoomd" and trajectory.file.schema_version == (1, 4)
    assert trajectory.file.application.startswith("vitrel ")
    assert len(trajectory) == right.frames
    for k, frame in enumerate(trajectory):
        check_frame(frame, k)


def append_last_frame():
    with gsd.hoomd.open(path, "rb+") as trajectory:
        frame = trajectory[right.frames - 1]
        frame.configuration.step = 12345
        frame.particles.charge = np.arange(right.n)  # an array that the file did not have
        trajectory.append(frame)
    with gsd.hoomd.open(path, "rb") as trajectory:
        assert len(trajectory) == right.frames + 1
        assert trajectory[right.frames].configuration.step == 12345
        expect("charge", trajectory[right.frames].particles.charge, np.arange(right.n))
        for k in range(right.frames):
            check_frame(trajectory[k], k)


with gsd.hoomd.open(path, "rb") as trajectory:
    assert isinstance(trajectory.file, gsd.fl.GSDFile)
    check_trajectory(trajectory)
with gsd.pygsd.GSDFile(open(path, "rb")) as file:
    check_trajectory(gsd.hoomd.HOOMDTrajectory(file))
append_last_frame()
