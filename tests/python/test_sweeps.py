"""Sweeps: many runs, one table."""

import pytest
import vitrel

GRID = {"system.packing_fraction": [0.3, 0.4], "system.seed": [1, 2]}
SMALL = {"particles": 50, "aspect_ratio": 2, "duration": 10, "equilibration": 1}


@pytest.fixture(scope="module")
def sweep(tmp_path_factory, vitrel_program):
    return vitrel.sweep(output=tmp_path_factory.mktemp("sweep") / "runs", grid=GRID, program=vitrel_program, parallel=2,
                        prepare__quality_sweeps=0, **SMALL)


def test_results_are_one_table(sweep):
    runs = sweep.results["runs"].to_pandas()
    assert list(runs["packing_fraction"].round(6)) == [0.3, 0.3, 0.4, 0.4] and list(runs["seed"]) == [1, 2, 1, 2]
    assert len(sweep.runs) == 4 and sweep.unfinished == []
    assert runs["compressibility_factor"].is_monotonic_increasing or len(set(runs["compressibility_factor"])) == 4
    assert sweep.runs[0].msd.value[-1] > sweep.runs[-1].msd.value[-1]


@pytest.mark.parametrize("export, file", [("slurm", "job_array.sh"), ("snakemake", "Snakefile")])
def test_jobs_of_a_cluster_are_those_of_the_call(sweep, tmp_path, vitrel_program, capsys, export, file):
    other = vitrel.sweep(output=tmp_path / "cluster", grid=GRID, program=vitrel_program, export=export, prepare__quality_sweeps=0,
                         **SMALL)
    assert capsys.readouterr().out.startswith(f"{other.path}: in this folder, s") and (other.path / file).exists()
    jobs, exported = ({path.parent.name: path.read_bytes() for path in folder.glob("*/parameters.toml")}
                      for folder in (sweep.path, other.path))
    assert jobs and jobs == exported


def test_a_cluster_of_another_kind_is_refused(tmp_path, vitrel_program):
    with pytest.raises(vitrel.UserError, match="snakemake or slurm, not to 'slurn'; did you mean 'slurm'"):
        vitrel.sweep(output=tmp_path / "cluster", grid=GRID, program=vitrel_program, export="slurn", **SMALL)


def test_charts_show_one_number_of_every_run(sweep):
    chart = next(chart for chart in sweep.results.charts if "compressibility_factor" in chart.labels)
    assert list(chart.plot().containers[0].lines[0].get_xdata().round(6)) == [0.3, 0.4]
    lines = sweep.results["runs"].plot("compressibility_factor").containers[0].lines
    assert len(lines[0].get_xdata()) == 4


def test_curves_are_told_apart_by_what_else_the_sweep_runs_through(tmp_path, vitrel_program):
    grid = {"species.0.aspect_ratio": [2, 4], "system.packing_fraction": [0.2, 0.3, 0.4], "dynamics.kind": ["newtonian"]}
    results = vitrel.sweep(output=tmp_path / "runs", grid=grid, program=vitrel_program, prepare__quality_sweeps=0,
                           **{**SMALL, "aspect_ratio": None}).results
    axes = results["runs"].plot("compressibility_factor")
    assert [container.get_label() for container in axes.containers] == ["species_0_aspect_ratio = 2", "species_0_aspect_ratio = 4"]
    assert [len(container.lines[0].get_xdata()) for container in axes.containers] == [3, 3]
    assert list(results["runs"].to_pandas()["dynamics_kind"]) == ["newtonian"] * 6


def test_fits_and_remarks_are_in_the_summary(sweep):
    assert "fits" in sweep.results.summary


def test_a_sweep_is_loaded(sweep):
    again = vitrel.load_sweep(sweep.path)
    assert again.results["runs"].to_pandas().equals(sweep.results["runs"].to_pandas())
    assert again.report().read_text(encoding="utf-8").lower().startswith("<!doctype html")


def test_without_jobs_there_is_nothing_to_load(tmp_path):
    with pytest.raises(vitrel.UserError):
        vitrel.load_sweep(tmp_path).results


def test_jobs_that_fail_are_counted(tmp_path, vitrel_program):
    with pytest.raises(RuntimeError, match="1 of 1 jobs failed"):
        vitrel.sweep(output=tmp_path / "runs", program=vitrel_program, particles=50, packing_fraction=0.8, aspect_ratio=2,
                     prepare__stage=[{"method": "insert", "packing_fraction": 0.8}])


def test_the_program_of_the_environment_is_found(tmp_path, vitrel_program, monkeypatch):
    scripts = tmp_path / "scripts"
    scripts.mkdir()
    monkeypatch.setattr("sysconfig.get_path", lambda name: {"scripts": str(scripts)}[name])
    monkeypatch.setenv("PATH", "")
    with pytest.raises(vitrel.FileError, match="is not in the path"):
        vitrel.sweep(output=tmp_path / "runs", packing_fraction=0.3, **SMALL)
    (scripts / "vitrel").symlink_to(vitrel_program)
    sweep = vitrel.sweep(output=tmp_path / "runs", packing_fraction=0.3, prepare__quality_sweeps=0, **SMALL)
    assert len(sweep.runs) == 1 and sweep.unfinished == []
