"""One run as other programs write it, by GSD's own writer, ASE, h5py, and LAMMPS' format: all give the results of the run."""
import pathlib

import ase
import ase.io
import gsd.hoomd
import h5py
import numpy as np

from gsd_versions import WRITE, Frame
from program import summary_of, work_in_a_new_folder

TABLES = {"displacements_all": ["msd", "msr"], "orientation_all": ["l_2"], "structure_factor": ["s"],
          "pair_correlation": ["g"]}
PARAMETERS = """[system]
particles = 20
packing_fraction = 0.5
[[species]]
name = "A"
fraction = 1
aspect_ratio = 2
[dynamics]
equilibration = 1
duration = 4
[output]
samples = { spacing = "linear", interval = 0.1 }
"""


def results(file, *settings):
    summary = summary_of("analyze", file, "-o", f"{file}.results.h5", *settings)
    assert ("seed" in summary) != ("import" in summary), summary
    with h5py.File(f"{file}.results.h5") as found:
        tables = {f"{table}/{name}": found[table][name][:] for table, names in TABLES.items() for name in names}
    return summary.get("import"), tables


class Run:
    """The frames of a run of ellipses."""

    def __init__(self, path):
        with h5py.File(path) as file:
            particles = file["particles/all"]
            self.times, self.steps = particles["position/time"][:], particles["position/step"][:]
            self.position, self.image = particles["position/value"][:], particles["image/value"][:]
            self.angle, self.edges = particles["angle/value"][:], np.diag(particles["box/edges/value"][0])
            self.axes = particles["semiaxes"][0]

    def quaternion(self, k):
        half, zero = self.angle[k] / 2, 0 * self.angle[k]
        return np.stack([np.cos(half), zero, zero, np.sin(half)], axis=1)


def write_gsd(run, path, images):
    """`images`: in all frames; otherwise in the first one only, as HOOMD-blue writes by default."""
    with gsd.hoomd.open(path, WRITE) as file:
        for k, step in enumerate(run.steps):
            frame = Frame()
            frame.configuration.step, frame.configuration.dimensions = int(step), 2
            frame.configuration.box = [*run.edges[:2], 0, 0, 0, 0]
            frame.particles.N, frame.particles.types = len(run.position[k]), ["A"]
            a, b = run.axes[:2]
            frame.particles.type_shapes = [{"type": "Ellipsoid", "a": a, "b": b, "c": b}]
            frame.particles.position, frame.particles.orientation = run.position[k], run.quaternion(k)
            if images or k == 0:
                frame.particles.image = run.image[k]
            file.append(frame)


def write_xyz(run, path):
    frames = []
    for k, time in enumerate(run.times):
        cell = [*run.edges[:2], 1]
        atoms = ase.Atoms("Ar" * len(run.position[k]), positions=run.position[k] + 0.5 * np.array([*run.edges[:2], 0]),
                          cell=cell, pbc=[True, True, False], info={"Time": float(time)})
        q = run.quaternion(k)
        atoms.arrays.update(orientation=q[:, [1, 2, 3, 0]], map_shift=run.image[k],
                            aspherical_shape=np.tile([*run.axes[:2], run.axes[1]], (len(q), 1)))
        frames.append(atoms)
    ase.io.write(path, frames, format="extxyz",
                 columns=["symbols", "positions", "orientation", "map_shift", "aspherical_shape"])


def write_h5md(run, path):
    order = np.random.default_rng(1).permuted(np.tile(np.arange(run.angle.shape[1]), (len(run.times), 1)), axis=1)
    with h5py.File(path, "w") as file:
        particles = file.create_group("particles/ellipses")
        box = particles.create_group("box")
        box.attrs["dimension"], box.attrs["boundary"] = 2, ["periodic", "periodic"]
        box["edges"] = run.edges[:2]
        particles["semiaxes"] = np.tile(run.axes[:2], (run.angle.shape[1], 1))
        values = {"position": run.position[:, :, :2], "image": run.image[:, :, :2], "angle": run.angle, "id": None}
        for name, value in values.items():
            group = particles.create_group(name)
            group["step"], group["time"] = run.steps, run.times
            # In every frame the particles stand in another order, which their ids tell.
            group["value"] = order if value is None else np.stack([value[k][order[k]] for k in range(len(order))])


def write_dump(run, path):
    """Scaled coordinates and whole axes, as LAMMPS has them, a shuffled order, the quaternion of a compute."""
    draw = np.random.default_rng(2)
    with open(path, "w", encoding="utf-8") as file:
        for k, step in enumerate(run.steps):
            q, s = run.quaternion(k), run.position[k] / run.edges + 0.5
            file.write(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{len(q)}\nITEM: BOX BOUNDS pp pp pp\n"
                       f"0 {float(run.edges[0])!r}\n0 {float(run.edges[1])!r}\n-0.5 0.5\nITEM: ATOMS id type xs ys zs ix iy iz "
                       "c_q[1] c_q[2] c_q[3] c_q[4] shapex shapey shapez\n")
            for i in draw.permutation(len(q)):
                x, y = (float(c) for c in s[i][:2])
                a, b = (2 * float(c) for c in run.axes[:2])
                turn = " ".join(repr(float(c)) for c in q[i])
                file.write(f"{i + 1} 1 {x!r} {y!r} 0.5 {run.image[k][i][0]} {run.image[k][i][1]} 0 {turn} {a!r} {b!r} {b!r}\n")


def columns_of_dump():
    pairs = ", ".join(f'{{file = "c_q[{k + 1}]", meaning = "{name}"}}' for k, name in enumerate(["qw", "qx", "qy", "qz"]))
    return f"import.columns=[{pairs}]"


with work_in_a_new_folder():
    pathlib.Path("p.toml").write_text(PARAMETERS, encoding="utf-8")
    summary_of("run", "p.toml", "-o", "run.h5")
    _, right = results("run.h5")
    run = Run("run.h5")
    interval = f"import.time_per_step={float(run.times[1] - run.times[0])!r}"
    write_gsd(run, "all_images.gsd", images=True)
    write_gsd(run, "first_images.gsd", images=False)
    write_xyz(run, "run.xyz")
    write_h5md(run, "other.h5")
    write_dump(run, "run.dump")
    for file, tolerance, *settings in (("all_images.gsd", 2e-4, interval),
                                       ("first_images.gsd", 2e-4, interval, "import.unwrap=nearest"),
                                       ("run.xyz", 2e-5),
                                       ("other.h5", 1e-9),
                                       ("run.dump", 1e-9, "import.dimension=2", interval, columns_of_dump())):
        words = [word for setting in settings for word in ("--set", setting)]
        assert summary_of("check", file, *words)["overlaps"] == 0 or tolerance > 1e-9
        imported, found = results(file, *words)
        assert imported["frames"] == f"{len(run.times)} of 20 particles in the plane", imported
        for name, values in right.items():
            np.testing.assert_allclose(found[name], values, rtol=tolerance, atol=tolerance, err_msg=f"{file}: {name}")
