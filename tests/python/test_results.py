"""Results: tables, charts, pages."""

import math
import re
import subprocess

import h5py
import numpy
import pytest
import vitrel
from matplotlib import pyplot


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    path = tmp_path_factory.mktemp("run") / "run.h5"
    return vitrel.run(output=path, duration=20, equilibration=1, kind="brownian", particles=100, packing_fraction=0.5,
                      aspect_ratio=2, seed=3, prepare__quality_sweeps=0)


@pytest.fixture(autouse=True)
def close_figures():
    yield
    pyplot.close("all")


def test_results_are_those_of_the_command_line(run, tmp_path, vitrel_program):
    subprocess.run([vitrel_program, "analyze", run.path, "-o", tmp_path / "results.h5", "--quiet"], check=True)
    with h5py.File(tmp_path / "results.h5") as file:
        assert set(run.results) == {name for name in file if name != "provenance"}
        for name, table in run.results.items():
            for column in table.values():
                assert numpy.array_equal(file[name][column.name][()], column.value, equal_nan=True)


def columns_of_the_page(program):
    """For every table of the page, the pattern of each of its columns with its error and unit."""
    page = subprocess.run([program, "analyze", "--list"], check=True, capture_output=True, text=True).stdout
    tables = {}
    for line in page.splitlines():
        if heading := re.match(r"## `(\w+)(_<group>)?`", line):
            table = tables.setdefault(heading[1] + (r"_\w+" if heading[2] else ""), set())
        elif column := re.match(r"- `([\w#*]+)`( ±)?( \((.+?)\))?: ", line):
            table.add((column[1], bool(column[2]), column[4] or "1"))
    return tables


def matches(pattern, text):
    return re.fullmatch(re.escape(pattern).replace(r"\#", r"\d+").replace(r"\*", r"\w+"), text)


def mixture_with_everything(path, dimension, shapes):
    path.write_text(f"""
[system]
dimension = {dimension}
particles = 60
packing_fraction = 0.2
[[species]]
name = "A"
fraction = 0.5
{shapes[0]}
[[species]]
name = "B"
fraction = 0.5
{shapes[1]}
[dynamics]
equilibration = 0
duration = 20
[output]
velocities = true
samples = {{ spacing = "linear", interval = 0.1 }}
correlations = {{ interval = 0.1 }}
[analysis]
waiting_times = [0, 5]
""", encoding="utf-8")
    return path


def test_the_page_of_tables_describes_every_column_and_no_other(tmp_path, vitrel_program):
    described, found = columns_of_the_page(vitrel_program), set()
    for dimension, shapes in (2, ["aspect_ratio = 2", "aspect_ratio = 1"]), (3, ["semi_axes = [1.5, 1, 0.7]"] * 2):
        file = tmp_path / f"{dimension}.h5"
        parameters = mixture_with_everything(tmp_path / f"{dimension}.toml", dimension, shapes)
        subprocess.run([vitrel_program, "run", parameters, "-o", file, "-q"], check=True)
        results = vitrel.load(file).results
        for name, table in results.items():
            kinds = [(kind, column) for kind, columns in described.items() if re.fullmatch(kind, name) for column in columns]
            for column in table.values():
                its = [(kind, (pattern, error, unit)) for kind, (pattern, error, unit) in kinds
                       if matches(pattern, column.name) and matches(unit, column.unit) and error == (column.error is not None)]
                assert its, f"{name}: {column.name} in {column.unit}"
                found.update(its)
    assert found == {(kind, column) for kind, columns in described.items() for column in columns}
    # The mean for 60 random axes in space; the formula of the plane gives 10 % more.
    by_chance = 9 / 4 * math.sqrt(2 / (5 * math.pi * 60))
    assert results["relaxation"]["nematic_by_chance"].value[0] == pytest.approx(by_chance)


def test_columns_have_errors_and_units(run):
    msd = run.msd
    assert msd is run.results["displacements_all"]["msd"]
    assert msd.value.shape == msd.error.shape == run.results["displacements_all"]["time"].value.shape
    assert msd.unit == "length^2" and numpy.asarray(msd) is msd.value
    assert run.summary["particles"] == 100 and run.results.summary["particles"] == 100
    with pytest.raises(AttributeError, match="no_such"):
        run.no_such


def test_tables_become_data_frames(run):
    frame = run.displacements_all.to_pandas()
    assert list(frame["msd"]) == list(run.msd.value) and list(frame["msd_error"]) == list(run.msd.error)
    series = run.msd.to_pandas()
    assert list(series) == list(run.msd.value) and series.index.name == "time"


def test_a_column_has_the_axes_of_the_page(run, tmp_path):
    axes = run.msd.plot()
    assert axes.get_xscale() == axes.get_yscale() == "log"
    assert "ab" in axes.get_ylabel() and axes.get_xlabel().startswith("t /")
    line = axes.containers[0].lines[0]
    assert line.get_ydata().tolist() == run.msd.value.tolist()
    axes.figure.savefig(tmp_path / "msd.svg")


def test_every_chart_of_the_page_can_be_drawn(run):
    assert {"Mean squared displacement", "Pair correlation"} <= {chart.heading for chart in run.results.charts}
    for chart in run.results.charts:
        axes = chart.plot()
        assert len(axes.containers) == len(chart.labels)
        pyplot.close("all")


def test_curves_are_named_after_their_wave_numbers(run):
    results = run.analyze(wave_numbers=[2.0, 5.0])
    labels = next(chart.labels for chart in results.charts if chart.table.name == "self_scattering_all")
    assert list(labels.values()) == ["q = 2", "q = 5"]
    assert list(next(chart.labels for chart in results.charts if "l_2" in chart.labels).values()) == ["L₂", "L₄"]


def test_pages(run, tmp_path):
    page = run.report(tmp_path / "page.html").read_text(encoding="utf-8")
    assert page.lower().startswith("<!doctype html")
    assert run._repr_html_().startswith("<iframe srcdoc=")


def test_a_page_replaces_nothing_but_a_page(run, tmp_path):
    notes = tmp_path / "notes.html"
    notes.write_text("mine", encoding="utf-8")
    for other in (notes, run.path):
        before = other.read_bytes()
        with pytest.raises(vitrel.UserError, match="is not an HTML page"):
            run.report(other)
        assert other.read_bytes() == before


def test_a_label_names_the_curve(run):
    axes = run.msd.plot(label="φ = 0.5")
    run.msd.plot(axes, label="again")
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["φ = 0.5", "again"]
    several = run.orientation_all.plot("l_2", "l_4", label="mine")
    assert all(text.get_text().startswith("mine, ") for text in several.get_legend().get_texts())


def test_columns_of_several_charts_are_named_by_their_symbols(run):
    axes = run.results["displacements_all"].plot("msd", "msr")
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["⟨|Δr(t)|²⟩", "⟨Δθ(t)²⟩"]
    assert axes.get_ylabel() == ""


@pytest.mark.filterwarnings("error")
def test_errors_that_are_not_known_are_not_drawn(run):
    table = vitrel.analysis.structure_factor(run[-1])
    assert numpy.isnan(table["s"].error).all()  # of one state
    assert len(table.plot("s").lines) > 0


def test_a_wrong_name_comes_with_the_nearest(run):
    with pytest.raises(KeyError, match="did you mean 'self_scattering_all'"):
        run.results["self_scattering"]
    with pytest.raises(KeyError, match="is none of time, msd, "):
        run.results["displacements_all"][0]


def test_units_on_axes_are_those_of_the_run(run, tmp_path):
    assert run.msd.plot().get_ylabel().endswith("/ ab")
    run.export(tmp_path / "run.gsd")
    assert not vitrel.load(tmp_path / "run.gsd").msd.plot().get_ylabel().endswith("/ ab")


def test_tables_are_shown_in_notebooks(run):
    page = run.displacements_all._repr_html_()
    assert page.count("<tr>") == 11 and "msd / length^2" in page and " ± " in page and "more rows" in page
    assert "displacements_all" in run.results._repr_html_()
    assert "<td>" in run.relaxation_times._repr_html_()
