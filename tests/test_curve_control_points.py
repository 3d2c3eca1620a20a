"""Control points, weights, knots and degrees of outlines in a document."""

import numpy as np
import pytest
from curve_session import CLOSED, OPEN, OWN_TURN, RATIONAL, SPLINES, contour, curves, moved_by, one, refused

from solidtree.model.document.outlines import Bezier
from solidtree.model.document.tree import find
from solidtree.model.operations.curves.addressing import plain_values
from solidtree.model.operations.curves.deviations import deviation
from solidtree.model.outline.paths import path_of, spline_of


@pytest.mark.parametrize("node", SPLINES, ids=["open", "rational", "closed", "own turn"])
def test_knots_and_degrees_put_in_leave_the_curve(node):
    work = one(node)
    before = find(work.document, "n1")
    low, high = (2, 10) if node is OWN_TURN else (0, 1)
    work.do("insert_knot", "n1", low + 0.37 * (high - low), 2)
    assert moved_by(before, work) < 1e-12
    after = find(work.document, "n1")
    assert len(after.points) == 8 and after.closed == node.closed
    if after.knots:
        assert (after.knots[0], after.knots[-1]) == pytest.approx((low, high))
        assert np.isclose(after.knots, low + 0.37 * (high - low)).sum() == 2
    work.do("remove_knot", "n1", low + 0.37 * (high - low), 2)
    assert np.allclose(find(work.document, "n1").points, node.points, atol=1e-9)
    work.do("refine_knots", "n1")
    assert moved_by(before, work) < 1e-12
    work.do("elevate_degree", "n1", 2)
    assert moved_by(before, work) < 1e-12
    assert find(work.document, "n1").degree == node.degree + 2 and find(work.document, "n1").closed == node.closed
    work.do("reduce_degree", "n1", 2)
    assert moved_by(before, work) < 1e-9
    assert find(work.document, "n1").degree == node.degree and find(work.document, "n1").closed == node.closed


def test_a_bezier_curve_gains_and_loses_degrees():
    work = one(Bezier(points=((0, 0), (5, 9), (12, 1)), weights=(1, 2, 1)))
    before = find(work.document, "n1")
    work.do("elevate_degree", "n1")
    assert len(find(work.document, "n1").points) == 4 and moved_by(before, work) < 1e-12
    work.do("reduce_degree", "n1")
    assert np.allclose(find(work.document, "n1").points, before.points, atol=1e-9)
    refused(work, "convert it to a B-spline", "insert_knot", "n1", 0.5)
    refused(work, "lowest degree", "reduce_degree", "n1", 2)


def test_control_points_move_and_go_to_places():
    work = one(OPEN)
    work.do("move_points", "n1", [1, 2], (1, 1))
    work.do("place_points", "n1", [0], [(-5, 0.1)])
    assert find(work.document, "n1").points[:3] == ((-5.0, 0.1), (6.0, 10.0), (13.0, 2.0))
    work.do("transform_nodes", "n1", [(0, 0)], [(1, 0, 5), (0, 1, 0)])
    work.do("align_nodes", "n1", [(0, 0), (0, 1)], "y", "max")
    assert find(work.document, "n1").points[:2] == ((0.0, 10.0), (6.0, 10.0))
    refused(work, "no control point 6", "move_points", "n1", [6], (0, 1))
    refused(work, "control points instead of nodes", "move_nodes", "n1", [(0, 0)], (1, 0))


@pytest.mark.parametrize("node", [*SPLINES, RATIONAL.with_(weights=())])
@pytest.mark.parametrize("number", [0, 3, 6])
def test_a_control_point_more_and_less(node, number):
    work = one(node)
    work.do("insert_point", "n1", number, (7, 7))
    after = find(work.document, "n1")
    assert len(after.points) == 7 and after.points[number] == (7.0, 7.0)
    spline_of(after)
    assert list(after.knots) == sorted(after.knots)
    work.do("delete_points", "n1", [number])
    assert find(work.document, "n1").points == node.points
    refused(work, "delete the outline instead", "delete_points", "n1", [0, 1, 2, 3, 4])


def test_weights_make_a_curve_rational_and_all_ones_take_that_back():
    work = one(OPEN)
    before = work.document.profiles[0]
    work.do("set_weights", "n1", [2], 3)
    assert find(work.document, "n1").weights == (1, 1, 3, 1, 1, 1)
    work.do("set_weights", "n1", [2], 1)
    assert find(work.document, "n1").weights == () and find(work.document, "n1") == before
    refused(work, "above 0", "set_weights", "n1", [2], 0)
    work.do("set_parameter", "k", 2)
    work.do("set_weights", "n1", [1], "k + 1")
    assert plain_values(work.document, find(work.document, "n1")).weights[1] == 3.0


def test_knots_appear_when_one_is_set_and_stay_in_order():
    work = one(OPEN)
    work.do("set_knot", "n1", 4, 0.2)
    assert find(work.document, "n1").knots == pytest.approx((0, 0, 0, 0, 0.2, 2 / 3, 1, 1, 1, 1))
    refused(work, "stays at 0.666667 or below", "set_knot", "n1", 4, 0.9)
    refused(work, "stays at 0.2 or above", "set_knot", "n1", 5, 0.1)
    refused(work, "no knot 10", "set_knot", "n1", 10, 1)
    refused(work, "hold", "insert_knot", "n1", 0.2, 3)
    work = one(CLOSED)
    work.do("set_knot", "n1", 2, 0.4)
    assert find(work.document, "n1").knots == pytest.approx((0, 1 / 6, 0.4, 3 / 6, 4 / 6, 5 / 6, 1))


def test_a_removed_knot_moves_the_curve_as_far_as_the_deviation_says():
    work = one(OPEN)
    before = find(work.document, "n1")
    work.do("remove_knot", "n1", 1 / 3)
    after = find(work.document, "n1")
    t = np.linspace(0, 1, 2001)
    from solidtree.model.spline.bspline import evaluated

    one_, other = evaluated(spline_of(before), t), evaluated(spline_of(after), t)
    true = np.linalg.norm(one_[:, None] - other[None], axis=2)
    assert deviation(before, after) == pytest.approx(max(true.min(0).max(), true.min(1).max()), rel=0.01)


@pytest.mark.parametrize("number", range(5))
def test_curves_with_control_points_are_reversed_and_closed_as_what_they_are(number):
    node = [*SPLINES, Bezier(points=((0, 0), (5, 9), (12, 1)), weights=(1, 2, 1))][number]
    work = one(node)
    before = find(work.document, "n1")
    work.do("reverse_contours", "n1")
    after = find(work.document, "n1")
    assert type(after) is type(before) and moved_by(before, work) < 1e-12
    ends = [curves(work).contours[0].points[0], path_of(before).contours[0].points[-1]]
    assert np.allclose(*ends, atol=1e-12) and after.points != before.points
    if node.closed:
        assert curves(work).area() == pytest.approx(-path_of(before).area(), rel=1e-12)
        refused(work, "closed already", "close_contours", "n1")
    else:
        work.do("close_contours", "n1")
        assert contour(work).closed and type(find(work.document, "n1")) is type(before)
