"""Joints of outlines and combs of curvature: grades by construction, curvature by formula."""

from math import inf

import numpy as np
import pytest

from solidtree.model.outline.joints import comb_of, joints_of
from solidtree.model.outline.paths import path_of
from solidtree.model.script import bspline, circle, path, rectangle


def test_corners_of_a_rectangle_are_g0_of_ninety_degrees():
    joints = joints_of(path_of(rectangle(4, 3)))
    assert [(one.contour, one.node) for one in joints] == [(0, 1), (0, 2), (0, 3), (0, 0)]
    assert all(one.grade == 0 and one.joint.angle == pytest.approx(90) for one in joints)
    assert joints[0].radii == (inf, inf)


def test_a_handle_that_goes_straight_on_makes_g1_and_a_mirrored_one_g2():
    kinked = path([("move", (0, 0)), ("cubic", (0, 2), (1, 3), (3, 3)), ("cubic", (4, 3), (9, 2), (9, 0))])
    even = path([("move", (0, 0)), ("cubic", (0, 2), (1, 3), (3, 3)), ("cubic", (5, 3), (6, 2), (6, 0))])
    assert [one.grade for one in joints_of(path_of(kinked))] == [1]
    assert [one.grade for one in joints_of(path_of(even))] == [2]


def test_the_knots_of_a_cubic_spline_are_g2_and_a_double_one_g1():
    points = [(0, 0), (10, 10), (20, 0), (30, 10), (40, 0)]
    assert [(one.node, one.grade) for one in joints_of(path_of(bspline(points)))] == [(None, 2)]
    more = [*points, (50, 9)]
    double = bspline(more, knots=[0, 0, 0, 0, 1, 1, 2, 2, 2, 2])
    assert [one.grade for one in joints_of(path_of(double))] == [1]


def test_an_open_path_of_one_segment_has_no_joint():
    assert joints_of(path_of(path([("move", (0, 0)), ("line", (1, 0))]))) == []


def test_the_teeth_of_a_circle_are_all_of_one_length_and_stand_outside():
    comb = comb_of(path_of(circle(5)))
    assert comb is not None
    np.testing.assert_allclose(np.linalg.norm(comb.tips - comb.roots, axis=1), 0.15 * 10, rtol=1e-9)
    assert np.linalg.norm(comb.tips, axis=1).min() > 5
    assert comb.radius == pytest.approx(5, rel=1e-9)


def test_a_comb_is_as_much_longer_as_is_asked_and_has_the_teeth_that_are_asked():
    one, two = comb_of(path_of(circle(5))), comb_of(path_of(circle(5)), 2.0, 7)
    assert one is not None and two is not None
    assert np.linalg.norm(two.tips[0] - two.roots[0]) == pytest.approx(2 * np.linalg.norm(one.tips[0] - one.roots[0]))
    assert set(np.diff(two.starts)) == {7}


def test_the_sharpest_bend_of_an_ellipse_is_at_the_end_of_its_long_axis():
    comb = comb_of(path_of(circle(1).scaled(10, 5, 1)), teeth=25)
    assert comb is not None
    np.testing.assert_allclose(np.abs(comb.sharpest), (10, 0), atol=1e-9)
    assert comb.radius == pytest.approx(25 / 10, rel=1e-9)


def test_what_is_straight_has_no_comb():
    assert comb_of(path_of(rectangle(4, 3))) is None
