"""States: arrays, files, pictures."""

import multiprocessing
import pickle

import numpy
import pytest
import vitrel
from matplotlib import pyplot


@pytest.fixture(scope="module")
def state():
    return vitrel.prepare(particles=100, packing_fraction=0.5, aspect_ratio=2, seed=3, quality_sweeps=0)


def test_a_state_has_its_arrays(state):
    assert len(state) == 100 and state.dimension == 2
    assert state.position.shape == (100, 2) and state.angle.shape == (100,)
    assert state.packing_fraction == pytest.approx(0.5, rel=1e-12)
    assert state.check()["overlaps"].shape == (0, 2) and state.check()["smallest_gap"] > 0
    assert state.semi_axes[0] == pytest.approx([2**0.5, 0.5**0.5])
    assert not hasattr(state, "orientation")
    with pytest.raises(ValueError):
        state.position[0] = 0


def test_arrays_are_views_that_keep_the_state(state):
    assert state.position.base is not None
    position = vitrel.prepare(particles=10, packing_fraction=0.2, aspect_ratio=1, quality_sweeps=0).position
    assert numpy.isfinite(position).all()


def test_arrays_make_a_state(state):
    copy = vitrel.State.from_arrays(state.position, state.semi_axes, state.box, angle=state.angle)
    assert (copy.position == state.position).all() and (copy.angle == state.angle).all()
    assert copy.packing_fraction == state.packing_fraction
    with pytest.raises(vitrel.UserError, match="angle"):
        vitrel.State.from_arrays(state.position, state.semi_axes, state.box, angle=state.angle * numpy.nan)


def test_overlaps_are_found():
    overlapping = vitrel.State.from_arrays([[0, 0], [1.5, 0], [5, 5]], 1, [20, 20])
    assert overlapping.check()["overlaps"].tolist() == [[0, 1]]
    assert overlapping.shrunk().check()["overlaps"].size == 0
    shrunk = vitrel.prepare(start=overlapping, shrink=True)
    assert shrunk.check()["overlaps"].size == 0
    assert shrunk.semi_axes[0, 0] == pytest.approx(0.75, rel=1e-6)


def test_states_in_space_have_quaternions():
    turned = [0.5, 0.5, 0.5, 0.5]
    state = vitrel.State.from_arrays([[0, 0, 0]], [3, 2, 1], [10, 10, 10], orientation=[turned])
    assert state.orientation.tolist() == [turned] and state.dimension == 3
    assert state.packing_fraction == pytest.approx(4 / 3 * numpy.pi * 6 / 1000)


def test_a_picture_in_space_is_an_array_of_colours():
    rod = vitrel.State.from_arrays([[0, 0, 0]], [3, 1, 1], [10, 10, 10], orientation=[[1, 0, 0, 0]])
    picture = rod.picture(width=102, azimuth=0, elevation=0)  # along the rod; 10 lengths and a margin
    assert picture.shape == (102, 102, 3) and picture.dtype == numpy.uint8
    inside = numpy.ptp(picture.astype(int), axis=2) > 9  # the background and the edges are grey
    pixels = 102 / 10.2
    assert abs(inside.sum() - numpy.pi * pixels**2) < 2 * numpy.pi * pixels
    assert inside.sum() < 0.5 * (numpy.ptp(rod.picture(width=102, azimuth=90, elevation=0).astype(int), axis=2) > 9).sum()
    axes = rod.draw(width=50, whole=True)
    assert (axes.images[0].get_array() == rod.picture(width=50, whole=True)).all()
    with pytest.raises(vitrel.UserError, match="psi6 are for two dimensions"):
        rod.draw(colour="psi6")
    with pytest.raises(vitrel.UserError, match="width is 1, but"):
        rod.picture(width=1)
    pyplot.close("all")


def test_files_keep_a_state(state, tmp_path):
    state.write(tmp_path / "state.h5")
    assert (vitrel.read(tmp_path / "state.h5").position == state.position).all()
    with pytest.raises(vitrel.UserError, match="exists already"):
        state.write(tmp_path / "state.h5")
    with pytest.raises(vitrel.FileError, match="missing.h5"):
        vitrel.read(tmp_path / "missing.h5")


def test_other_formats_are_read(tmp_path):
    (tmp_path / "two.csv").write_text("x,y,a,b,angle\n0,0,1,0.5,0\n3,0,1,0.5,1\n", encoding="utf-8")
    state = vitrel.prepare(stage=[{"method": "state", "file": str(tmp_path / "two.csv"), "box": [10, 10]}])
    assert state.angle.tolist() == [0, 1]


def test_a_picture_shows_every_particle_and_its_images(state, tmp_path):
    axes = state.draw()
    drawn = axes.collections[0]
    assert len(drawn.get_offsets()) > len(state)
    axes.figure.savefig(tmp_path / "state.pdf")
    assert (tmp_path / "state.pdf").read_bytes().startswith(b"%PDF")
    assert state.picture(width=50).shape == (50, 50, 3)
    colours = state.draw(colour=numpy.arange(100)).collections[0].get_facecolors()[:, :3] * 255
    assert numpy.isclose(colours, [68, 1, 84]).all(axis=1).any()  # the ends of viridis
    assert numpy.isclose(colours, [253, 231, 37]).all(axis=1).any()
    for wrong in ([1, 2, 3], [numpy.nan] * 100, "colours"):
        with pytest.raises(vitrel.UserError, match="colour"):
            state.draw(colour=wrong)
    with pytest.raises(vitrel.UserError, match="width: for states in space"):
        state.draw(width=10)
    pyplot.close("all")


def test_states_are_pickled_bit_by_bit(state, tmp_path):
    copy = pickle.loads(pickle.dumps(state))
    assert copy == state and copy.parameters == state.parameters and (copy.angle == state.angle).all()
    other = vitrel.State.from_arrays(state.position, state.semi_axes, state.box, angle=state.angle + 1e-16)
    assert other != state and state != "a state"
    solid = vitrel.prepare(dimension=3, particles=20, packing_fraction=0.2, semi_axes=[2, 1, 1], quality_sweeps=0)
    assert pickle.loads(pickle.dumps(solid)) == solid
    with multiprocessing.Pool(2) as pool:
        assert pool.map(len, [state, solid]) == [100, 20]


@pytest.mark.parametrize("suffix", ["gsd", "xyz", "csv"])
def test_the_suffix_of_a_file_is_its_format(state, tmp_path, suffix):
    state.write(tmp_path / f"state.{suffix}")
    again = vitrel.read(tmp_path / f"state.{suffix}")
    assert again.position == pytest.approx(state.position, abs=1e-4) and again.semi_axes == pytest.approx(state.semi_axes, abs=1e-4)


def test_unknown_formats_are_refused_with_those_there_are(state, tmp_path):
    with pytest.raises(vitrel.UserError, match="'pdb' is no format .* gsd, xyz, csv"):
        state.write(tmp_path / "state.pdb")
    with pytest.raises(vitrel.UserError, match="overwrite is for .h5"):
        state.write(tmp_path / "state.gsd", overwrite=True)
    with pytest.raises(vitrel.UserError, match="geo"):
        vitrel.State.from_arrays([[0, 0, 0]], 1, [10, 10, 10]).write(tmp_path / "state.xytheta")


@pytest.mark.parametrize("arguments, words", [
    ((numpy.zeros((5, 3)), [2, 1], [10, 10]), r"box has the shape \(2,\), but must have \(3,\): .* space"),
    ((numpy.zeros((5, 2)), [2, 1, 1], [10, 10]), r"semi_axes has the shape \(3,\), but must have \(5, 2\), or \(2,\) for all"),
    (([0, 0], 1, [10, 10]), r"position has the shape \(2,\)"),
])
def test_wrong_shapes_are_named(arguments, words):
    with pytest.raises(vitrel.UserError, match=words):
        vitrel.State.from_arrays(*arguments)
