"""Opens a trajectory with h5py and compares every dataset and the attributes of H5MD 1.1."""
import sys

import h5py
import numpy as np

import sample
from exported import expect


def check_h5md(file):
    expect("version", file["h5md"].attrs["version"], [1, 1])
    assert file["h5md/creator"].attrs["name"] == b"vitrel"
    assert len(file["h5md/author"].attrs["name"]) > 0
    assert list(file["particles"]) == ["all"]
    box = file["particles/all/box"]
    assert box.attrs["dimension"] == 3
    expect("boundary", box.attrs["boundary"], [b"periodic", b"periodic", b"none"])
    assert box.attrs["boundary"].dtype == np.dtype("S8")


def check_series(file):
    particles = file["particles/all"]
    frames = range(sample.FRAMES)
    for name in ("position", "image", "angle", "velocity", "angular_velocity"):
        right = np.array([getattr(sample, name)(k) for k in frames])
        expect(name, particles[name]["value"][:], right)
    assert "orientation" not in particles  # follows from the angle
    expect("edges", particles["box/edges/value"][:], [sample.edges(k) for k in frames])
    expect("step", particles["position/step"][:], [10 * k for k in frames])
    expect("time", particles["position/time"][:], [0.25 * k for k in frames])
    expect("collisions", file["observables/collisions/value"][:], [100.0 * k for k in frames])


def check_links(file):
    for name in ("image", "angle", "velocity", "angular_velocity", "box/edges"):
        for axis in ("step", "time"):
            assert file[f"particles/all/{name}/{axis}"] == file[f"particles/all/position/{axis}"]
    assert file["observables/collisions/step"] == file["particles/all/position/step"]


def check_fixed(file):
    particles = file["particles/all"]
    expect("species", particles["species"][:], sample.species)
    assert h5py.check_enum_dtype(particles["species"].dtype) == {"long": 0, "round": 1}
    expect("id", particles["id"][:], sample.i)
    expect("mass", particles["mass"][:], sample.mass)
    expect("semiaxes", particles["semiaxes"][:], sample.semiaxes)


def check_storage(file):
    value = file["particles/all/position/value"]
    assert value.chunks == (128, sample.N, 3) and value.dtype == np.dtype("<f8")
    assert value.fletcher32 and value.compression is None
    image = file["particles/all/image/value"]
    assert image.chunks == value.chunks and image.dtype == np.dtype("<i2") and image.fletcher32
    assert file["particles/all/position/step"].dtype == np.dtype("<i8")


def check_parameters(file):
    attributes = file["parameters"].attrs
    assert attributes["toml"] == b"[system]\nseed = 3\n"
    assert attributes["seed"] == 3 and attributes["dimension"] == 2
    assert attributes["command_line"] == b"write_sample"
    assert len(attributes["commit"]) > 0 and len(attributes["version"]) > 0


with h5py.File(sys.argv[1], "r") as trajectory:
    check_h5md(trajectory)
    check_series(trajectory)
    check_links(trajectory)
    check_fixed(trajectory)
    check_storage(trajectory)
    check_parameters(trajectory)
