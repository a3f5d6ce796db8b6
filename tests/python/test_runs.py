"""States, runs and results: the same as from the command line."""

import subprocess

import h5py
import numpy
import pytest
import vitrel

SMALL = {"particles": 100, "packing_fraction": 0.5, "aspect_ratio": 2, "seed": 3}


@pytest.fixture(scope="module")
def state():
    return vitrel.prepare(quality_sweeps=0, **SMALL)


def test_a_state_has_its_arrays(state):
    assert len(state) == 100 and state.dimension == 2
    assert state.position.shape == (100, 2) and state.angle.shape == (100,)
    assert state.packing_fraction == pytest.approx(0.5, rel=1e-12)
    assert state.check()["overlaps"].shape == (0, 2)
    assert state.semi_axes[0] == pytest.approx([2**0.5, 0.5**0.5])
    with pytest.raises(ValueError):
        state.position[0] = 0


def test_arrays_make_a_state(state):
    copy = vitrel.State.from_arrays(state.position, state.semi_axes, state.box, angle=state.angle)
    assert (copy.position == state.position).all() and (copy.angle == state.angle).all()
    assert copy.packing_fraction == state.packing_fraction
    with pytest.raises(vitrel.UserError, match="angle"):
        vitrel.State.from_arrays(state.position, state.semi_axes, state.box, angle=state.angle * numpy.nan)


def test_files_keep_a_state(state, tmp_path):
    state.write(tmp_path / "state.h5")
    assert (vitrel.read(tmp_path / "state.h5").position == state.position).all()
    with pytest.raises(vitrel.FileError, match="missing.h5"):
        vitrel.read(tmp_path / "missing.h5")


def datasets(path):
    found = {}
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.update({name: item[()].tobytes()})
                        if isinstance(item, h5py.Dataset) and not name.startswith("parameters") else None)
    return found


def test_a_run_is_that_of_the_command_line(tmp_path, vitrel_program):
    run = vitrel.run(output=tmp_path / "a.h5", duration=5, equilibration=0, prepare__quality_sweeps=0, **SMALL)
    (tmp_path / "p.toml").write_text(
        "[system]\nparticles = 100\npacking_fraction = 0.5\nseed = 3\n[[species]]\naspect_ratio = 2\n"
        "[dynamics]\nduration = 5\nequilibration = 0\n", encoding="utf-8")
    subprocess.run([vitrel_program, "run", tmp_path / "p.toml", "-o", tmp_path / "b.h5", "--quiet"], check=True)
    assert datasets(tmp_path / "a.h5") == datasets(tmp_path / "b.h5")
    assert run.summary["overlaps"] == 0 and len(run) == len(run.times)
    assert run[-1].position.shape == (100, 2)


def test_results_are_arrays(state, tmp_path):
    run = vitrel.run(state, output=tmp_path / "run.h5", duration=20, equilibration=1, kind="brownian")
    results = run.analyze()
    table = results["displacements_all"]
    assert table["msd"].value.shape == table["time"].value.shape and table["msd"].unit == "length^2"
    assert results.summary["particles"] == 100
    frame = table.to_pandas()
    assert list(frame["msd"]) == list(table["msd"].value)


def test_mistakes_are_those_of_the_program(tmp_path):
    with pytest.raises(vitrel.UserError, match="packing_fraction"):
        vitrel.prepare(particles=10, packing_fraction=2.0, aspect_ratio=1)
    with pytest.raises(vitrel.UserError, match="unknown"):
        vitrel.run(output=tmp_path / "x.h5", no_such_key=1)
