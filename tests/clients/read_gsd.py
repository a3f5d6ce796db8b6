"""Opens an exported GSD file with gsd.hoomd, by its C library and by its own Python reader, compares every
array, which are in single precision, and appends a frame."""
import gsd.fl
import gsd.hoomd
import gsd.pygsd
import numpy as np

from exported import expect, expect_near, export
from gsd_versions import READ, READ_AND_WRITE

right, path = export("gsd")
d = right.dimension
# One half of a unit in the last place of single precision, relative.
half_unit = 2.0**-24


def product(p, q):
    """Of quaternions w, x, y, z, one per row."""
    w, x, y, z = p.T
    a, b, c, d = q.T
    return np.stack([w * a - x * b - y * c - z * d, w * b + x * a + y * d - z * c,
                     w * c - x * d + y * a + z * b, w * d + x * c - y * b + z * a], axis=1)


def modelled_inertia():
    """Of homogeneous ellipses and ellipsoids, about the own axes; 0 about an axis of symmetry."""
    squares = right.axes**2
    if right.dimension == 2:
        inertia = right.mass[:, None] * [0, 0, 1] * squares[:, :2].sum(axis=1, keepdims=True) / 4
    else:
        inertia = right.mass[:, None] * (squares.sum(axis=1, keepdims=True) - squares) / 5
    a, b, c = right.axes.T
    inertia[np.stack([b == c, c == a, a == b], axis=1)] = 0
    return inertia


def momentum(k):
    """L in the own axes; of a spheroid ω = L / I⊥ also along its axis."""
    inertia = modelled_inertia()
    of_spheroid = (inertia == 0).sum(axis=1) == 1
    inertia[of_spheroid] = inertia[of_spheroid].max(axis=1, keepdims=True)
    omega = np.pad(right.angular_velocity[k], ((0, 0), (1, 0)))
    own = product(product(right.orientation[k] * [1, -1, -1, -1], omega), right.orientation[k])
    return inertia * own[:, 1:]


def check_box(box, k):
    expect("box", box[d:], np.zeros(6 - d))
    for found, exact in zip(box[:d], right.box[k]):
        assert found >= exact > np.nextafter(found, np.float32(0)) or found == exact, (found, exact)


def check_position(position, box, k):
    assert position.dtype == np.float32
    half = box[:d] / 2
    assert np.all(position[:, :d] >= -half) and np.all(position[:, :d] < half), position
    # The last number inside the box stands for what would be rounded to its upper edge.
    expected = right.position[k].astype(np.float32)
    expected[:, :d] = np.minimum(expected[:, :d], np.nextafter(half, np.float32(0)))
    expect("position", position, expected)


def check_momentum(particles, k):
    """S = (0, L) = conj(q) p / 2, as HOOMD-blue defines the quaternion p; q and p are rounded, each by half a unit."""
    conjugate = particles.orientation.astype(float) * [1, -1, -1, -1]
    spin = product(conjugate, particles.angmom.astype(float)) / 2
    exact = np.pad(momentum(k), ((0, 0), (1, 0)))
    expect_near("angmom", spin, exact, 4 * half_unit * np.linalg.norm(exact, axis=1, keepdims=True))


def check_shapes(frame):
    """Types are the species; semi-axes stand with the type, or with the particle if those of its type differ."""
    particles = frame.particles
    assert len(set(particles.types)) == len(particles.types) == len(particles.type_shapes)
    own = frame.log.get("particles/semiaxes")
    for i, number in enumerate(particles.typeid):
        name, shape = particles.types[number], particles.type_shapes[number]
        assert name == right.species[i]
        a, b, c = right.axes[i]
        sphere, ellipsoid = {"type": "Sphere", "diameter": 2 * a}, {"type": "Ellipsoid", "a": a, "b": b, "c": c}
        if len({tuple(axes) for axes, species in zip(right.axes, right.species) if species == name}) == 1:
            assert shape == (sphere if d == 3 and a == b == c else ellipsoid)
        else:
            assert shape == {}
            expect("semi-axes", own[i], right.axes[i])


def check_frame(frame, k):
    particles, inertia = frame.particles, modelled_inertia()
    assert frame.configuration.step == right.step[k] and frame.configuration.dimensions == d
    assert frame.log["time"] == right.time[k]
    assert particles.N == right.n
    check_box(frame.configuration.box, k)
    check_position(particles.position, frame.configuration.box, k)
    expect("image", particles.image, right.image[k])
    expect_near("orientation", particles.orientation, right.orientation[k], 1.01 * half_unit)
    check_shapes(frame)
    expect("mass", particles.mass, right.mass.astype(np.float32))
    expect_near("moment_inertia", particles.moment_inertia, inertia, 1.01 * half_unit * inertia)
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
    with gsd.hoomd.open(path, READ_AND_WRITE) as trajectory:
        frame = trajectory[right.frames - 1]
        frame.configuration.step = 12345
        frame.particles.charge = np.arange(right.n)  # an array that the file did not have
        trajectory.append(frame)
    with gsd.hoomd.open(path, READ) as trajectory:
        assert len(trajectory) == right.frames + 1
        assert trajectory[right.frames].configuration.step == 12345
        expect("charge", trajectory[right.frames].particles.charge, np.arange(right.n))
        for k in range(right.frames):
            check_frame(trajectory[k], k)


with gsd.hoomd.open(path, READ) as trajectory:
    assert isinstance(trajectory.file, gsd.fl.GSDFile)
    check_trajectory(trajectory)
with gsd.pygsd.GSDFile(open(path, "rb")) as file:
    check_trajectory(gsd.hoomd.HOOMDTrajectory(file))
append_last_frame()
