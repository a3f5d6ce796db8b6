"""Analyses an H5MD file of another program: two-dimensional, a fixed box, other names, nothing of vitrel's own."""
import json
import pathlib
import tempfile

import h5py
import numpy as np

from program import vitrel

FRAMES, PARTICLES, INTERVAL, SIDE = 300, 40, 0.25, 30.0

draw = np.random.default_rng(1)
unwrapped = np.cumsum(draw.normal(0, 0.3, (FRAMES, PARTICLES, 2)), axis=0)
angle = np.cumsum(draw.normal(0, 0.1, (FRAMES, PARTICLES)), axis=0)
image = np.round(unwrapped / SIDE).astype(np.int32)


def write(path, *left_out):
    with h5py.File(path, "w") as file:
        file.create_group("h5md").attrs["version"] = np.array([1, 1], dtype=np.int32)
        rods = file.create_group("particles/rods")
        rods.create_group("box").attrs["dimension"] = 2
        rods["box/edges"] = np.array([SIDE, SIDE])
        rods["semiaxes"] = np.tile([1.5, 0.5], (PARTICLES, 1))
        series = {"position": unwrapped - image * SIDE, "image": image, "angle": angle}
        for name, values in series.items():
            if name in left_out:
                continue
            group = rods.create_group(name)
            group["step"] = np.arange(FRAMES)
            group["time"] = INTERVAL * np.arange(FRAMES)
            group["value"] = values


def analyze(path, *settings):
    return vitrel("analyze", path, "-o", path.with_suffix(".results.h5"), "--json", *settings)


def mean_over_origins(function, lag):
    return np.mean([function(k, k + lag) for k in range(FRAMES - lag)])


with tempfile.TemporaryDirectory() as folder:
    file = pathlib.Path(folder, "rods.h5")
    write(file)
    done = analyze(file)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["particles"] == PARTICLES
    with h5py.File(file.with_suffix(".results.h5")) as results:
        moved, turned = results["displacements_all"], results["orientation_all"]
        for lag in (1, 7, 60):
            row = np.flatnonzero(np.isclose(moved["time"][:], lag * INTERVAL))[0]
            msd = mean_over_origins(lambda a, b: np.sum((unwrapped[b] - unwrapped[a])**2, axis=1).mean(), lag)
            l_2 = mean_over_origins(lambda a, b: np.cos(2 * (angle[b] - angle[a])).mean(), lag)
            np.testing.assert_allclose(moved["msd"][row], msd, rtol=1e-12)
            np.testing.assert_allclose(turned["l_2"][row], l_2, rtol=1e-12)
    directors = ["--set", "import.angles=directors"]
    assert analyze(file, *directors).returncode == 0
    done = analyze(file, *directors, "--set", "analysis.orders=[1, 2]")
    assert done.returncode == 2 and "analysis.orders has 1, but should be even" in done.stderr, done.stderr
    alike = pathlib.Path(folder, "alike.h5")
    write(alike)
    with h5py.File(alike, "a") as rods:
        names = h5py.enum_dtype({"a-1": 0, "a 1": 1}, basetype="i4")
        rods["particles/rods"].create_dataset("species", data=np.arange(PARTICLES) % 2, dtype=names)
    done = analyze(alike)
    assert done.returncode == 3, (done.returncode, done.stderr)
    assert f'{alike}: the name of species 1 is "a-1", which tables of results call a_1' in done.stderr, done.stderr
    no_images = pathlib.Path(folder, "without_image.h5")
    write(no_images, "image")
    done = analyze(no_images)
    assert done.returncode == 0, done.stderr
    assert "motion is left out: box crossings are unknown: it has no dataset image/value" in done.stderr, done.stderr
    with h5py.File(no_images.with_suffix(".results.h5")) as results:
        assert "structure_factor" in results and "displacements_all" not in results
    for missing in ("angle", "position"):
        incomplete = pathlib.Path(folder, f"without_{missing}.h5")
        write(incomplete, missing)
        done = analyze(incomplete)
        assert done.returncode == 3, (missing, done.returncode, done.stderr)
        assert f"{incomplete}: " in done.stderr and f"has no {missing}" in done.stderr, done.stderr
        assert not incomplete.with_suffix(".results.h5").exists()
