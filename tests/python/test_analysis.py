"""Observables of states and arrays in memory: those of the command, and closed forms."""

import numpy
import pytest
import vitrel


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    return vitrel.run(output=tmp_path_factory.mktemp("analysis") / "run.h5", duration=10, equilibration=0, particles=100,
                      packing_fraction=0.5, aspect_ratio=2, seed=3, prepare__quality_sweeps=0)


@pytest.mark.parametrize("name", ["structure_factor", "pair_correlation", "order", "displacements", "self_scattering"])
def test_states_give_what_their_file_gives(run, name):
    table = getattr(vitrel.analysis, name)(list(run))
    ours = run.results[table.name]
    assert list(table) == list(ours)
    for column in ours:
        numpy.testing.assert_array_equal(table[column].value, ours[column].value)


def test_settings_are_those_of_the_analysis(run):
    table = vitrel.analysis.structure_factor(run[-1], structure__wave_number_max=3)
    assert numpy.nanmax(table["q"].value) < 3.05
    assert set(vitrel.analysis.analyze(run[::50], only="structure_factor,order")) >= {"structure_factor", "order"}


@pytest.mark.parametrize("dimension", [2, 3])
def test_the_mean_squared_displacement_of_random_walks(dimension):
    steps = numpy.random.default_rng(1).normal(scale=0.1, size=(400, 100, dimension))
    unwrapped = numpy.cumsum(steps, axis=0)
    free = vitrel.analysis.msd(unwrapped, numpy.arange(400.0))
    # 2 d D t, with a standard error of 1 % at the shortest time
    assert free["msd"][0] == pytest.approx(dimension * 0.01, rel=0.03)
    assert free["msd"][9] == pytest.approx(10 * dimension * 0.01, rel=0.1)
    wrapped = vitrel.analysis.msd((unwrapped + 3) % 6 - 3, numpy.arange(400.0), box=[6] * dimension)
    numpy.testing.assert_allclose(wrapped["msd"].value, free["msd"].value, rtol=1e-9)


def test_bodies_turn():
    angle = 0.1 * numpy.arange(50.0)[:, None] * numpy.ones(4)
    table = vitrel.analysis.msd(numpy.zeros((50, 4, 2)) + numpy.arange(4.0)[:, None] * 10, numpy.arange(50.0), angle=angle,
                                semi_axes=[2, 1])
    assert table["msr"].value[:3] == pytest.approx([0.01, 0.04, 0.09])


def test_what_cannot_be_analysed_is_refused(run):
    with pytest.raises(vitrel.UserError, match="no states"):
        vitrel.analysis.order([])
    with pytest.raises(vitrel.UserError, match=r"\(T, N, D\)"):
        vitrel.analysis.msd(numpy.zeros((3, 2)), [0, 1, 2])
    other = vitrel.State.from_arrays([[0, 0]], [1, 1], [10, 10])
    with pytest.raises(vitrel.UserError, match="other particles"):
        vitrel.analysis.order([run[0], other])
