"""Pairs of bodies, against the command line and closed forms."""

import json
import subprocess

import numpy
import pytest
import vitrel


def circles(position, velocity=(0, 0)):
    return vitrel.Bodies([1, 1], position, velocity=velocity)


def test_circles_meet_when_their_distance_is_two():
    distance = numpy.array([3.0, 5.0, 10.0])
    far = numpy.stack([distance, 0 * distance], axis=1)
    one = vitrel.Bodies([1, 1], numpy.zeros((3, 2)))
    found = vitrel.first_contact(one, circles(far, velocity=(-1, 0)), horizon=7)
    assert found.time[:2] == pytest.approx(distance[:2] - 2, rel=1e-12)
    assert numpy.isinf(found.time[2]) and numpy.isnan(found.normal[2]).all()
    assert found.normal[0] == pytest.approx([1, 0])
    assert found.point[0] == pytest.approx([1, 0])


def test_gaps_and_overlaps_of_circles():
    one = vitrel.Bodies([1, 1], numpy.zeros((3, 2)))
    two = circles([[3, 0], [2, 0], [1.5, 0]])
    assert vitrel.overlap(one, two).tolist() == [False, False, True]
    found = vitrel.gap(one, two)
    assert found.gap == pytest.approx([1, 0, -0.5], abs=1e-15)
    assert found.point_1[0] == pytest.approx([1, 0]) and found.point_2[0] == pytest.approx([2, 0])


def test_any_image_counts_in_a_box():
    one, two = vitrel.Bodies([1, 1], [[-4, 0]]), vitrel.Bodies([1, 1], [[4, 0]])
    assert not vitrel.overlap(one, two)[0]
    assert vitrel.overlap(one, two, box=[9, 9])[0]


def test_ellipsoids_that_tumble():
    n = 5
    one = vitrel.Bodies([2, 1, 0.5], numpy.zeros((n, 3)), angular_velocity=[0.3, 0.2, 0.1])
    two = vitrel.Bodies([1, 1, 1], [[3.5, 0, 0]] * n, velocity=[[-0.1 * k, 0, 0] for k in range(n)])
    found = vitrel.first_contact(one, two, horizon=20)
    assert (numpy.diff(found.time[1:]) < 0).all()
    at_contact = numpy.isfinite(found.time)
    assert found.normal[at_contact] @ [1, 0, 0] == pytest.approx(1, abs=0.9)


@pytest.mark.parametrize("axes, position, words", [
    ([1, 2], [[0, 0]], "descending"), ([1, -1], [[0, 0]], "positive"), ([1, 1], [[0, numpy.nan]], "position"),
    ([1, 1, 1, 1], [[0, 0]], "three"),
])
def test_mistakes_are_named(axes, position, words):
    with pytest.raises(vitrel.UserError, match=words):
        vitrel.Bodies(axes, position)


def test_numbers_of_bodies_must_agree():
    with pytest.raises(vitrel.UserError, match="as many"):
        vitrel.overlap(circles([[0, 0]] * 2), circles([[0, 0]] * 3))


def test_elastic_spheres_keep_their_speed():
    found = vitrel.restitution([0.5, 1, 2], [0, 0.3, 0.9], law="linear_dashpot", damping="0 kg/s")
    assert found.rate == pytest.approx([-1] * 3) and found.distance == pytest.approx([1] * 3)
    assert found.angle[0] == pytest.approx(0) and (found.angle[1:] > 0).all() and (found.time > 0).all()


def test_a_restitution_matrix_is_that_of_the_command_line(vitrel_program):
    given = {"law": "viscoelastic", "dissipative_time": "1e-5 s"}
    printed = subprocess.run(
        [vitrel_program, "pair", "restitution", "--speed", "1.5 m/s", "--impact-parameter", "0.4", "--json",
         "--set", "law=\"viscoelastic\"", "--set", "dissipative_time=\"1e-5 s\""],
        check=True, capture_output=True, text=True)
    integrated = json.loads(printed.stdout)["integrated"]
    found = vitrel.restitution(1.5, 0.4, **given)
    for name, value in integrated.items():
        assert getattr(found, name)[0] == value
    with pytest.raises(vitrel.UserError, match="impact_parameter"):
        vitrel.restitution(1, 2)
