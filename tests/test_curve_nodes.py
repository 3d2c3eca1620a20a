"""Nodes and handles of outlines in a document: moved, put in, taken out; expressions and words."""

import math
import time

import numpy as np
import pytest
from curve_session import (
    LEAF,
    OPEN,
    contour,
    curves,
    moved_by,
    one,
    refused,
    session,
)

from solidtree.model.document.document import Parameter
from solidtree.model.document.expression import Expression
from solidtree.model.document.nodes import Union
from solidtree.model.document.outlines import Bezier, BSpline, Circle, Path, Rectangle
from solidtree.model.document.primitives import Box
from solidtree.model.document.tree import find
from solidtree.model.outline.paths import path_of
from solidtree.model.path.continuity import report
from solidtree.model.scripting.outlines import path


def test_nodes_move_with_their_handles_and_undo_brings_the_document_back():
    work = one(path(LEAF))
    before, old = work.document, contour(work)
    work.do("move_nodes", "n1", [(0, 1)], (1, 2))
    new = contour(work)
    moved = np.flatnonzero((new.points != old.points).any(axis=1))
    assert moved.tolist() == [2, 3, 4]
    assert (new.points[moved] - old.points[moved]).tolist() == [[1, 2]] * 3
    assert work.log[-1] == "move_nodes('n1', [(0, 1)], (1, 2))"
    work.undo()
    assert work.document is before
    work.do("move_nodes", "n1", [(0, 1)], (0, 0))
    assert work.document is before and work.undo_label is None


def test_all_nodes_moved_move_the_whole_curve_quadratics_and_splines_included():
    spline = (2, (0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0), ())
    drawn = Path(points=((0, 0), (4, 6), (8, 0), (8, 0), (10, 4), (12, -4), (16, 0)), segments="MQS", splines=(spline,))
    work = one(drawn)
    old = curves(work)
    work.do("move_nodes", "n1", [(0, 0), (0, 1), (0, 2)], (3, -2))
    shift = old.transformed([[1, 0, 3], [0, 1, -2]])
    new = curves(work)
    assert np.allclose(new.contours[0].points, shift.contours[0].points, atol=1e-14)
    assert np.allclose(new.contours[0].splines[0].points, shift.contours[0].splines[0].points, atol=1e-14)


def test_nodes_are_put_exactly_where_they_are_wanted():
    work = one(path(LEAF))
    work.do("place_nodes", "n1", [(0, 2), (0, 1)], [(0.1, 30.3), (20.7, 0.3)])
    assert contour(work).places[[2, 1]].tolist() == [[0.1, 30.3], [20.7, 0.3]]
    refused(work, "one for each", "place_nodes", "n1", [(0, 2), (0, 1)], [(1, 2)])


def test_a_handle_has_length_and_angle_and_turns_the_one_across():
    work = one(path("M 0 0 C 5 0 10 5 10 10 C 10 15 5 20 0 20"))
    work.do("set_joints", "n1", [(0, 1)], "smooth")
    work.do("set_handle", "n1", (0, 4), length=8, angle=60)
    node, before, after = contour(work).points[[3, 2, 4]]
    way = np.array([math.cos(math.radians(60)), math.sin(math.radians(60))])
    assert np.allclose(after - node, 8 * way) and np.allclose(before - node, -5 * way)
    work.do("set_handle", "n1", (0, 2), length=2)
    assert np.allclose(contour(work).points[[2, 4]] - node, [-2 * way, 8 * way])
    refused(work, "no handle", "move_handle", "n1", (0, 3), (0, 0))
    work.do("move_handle", "n1", (0, 1), (0, 0))
    refused(work, "has no direction", "set_handle", "n1", (0, 1), 3)


def test_the_control_point_of_a_quadratic_turns_the_handle_of_a_smooth_neighbour():
    work = one(path("M 0 0 Q 5 5 10 0 C 12 -2 18 -2 20 0"))
    work.do("set_joints", "n1", [(0, 1)], "smooth")
    work.do("move_handle", "n1", (0, 1), (10, 6))
    assert report(contour(work))[0].geometric >= 1
    assert np.linalg.norm(contour(work).points[3] - (10, 0)) == pytest.approx(math.hypot(2, 2))


@pytest.mark.parametrize("segment", range(4))
def test_a_node_put_in_leaves_the_curve_and_the_kinds_of_the_others(segment):
    work = one(path(LEAF))
    work.do("set_joints", "n1", [(0, 1)], "smooth")
    start = find(work.document, "n1")
    kinds = contour(work).nodes.tolist()
    work.do("insert_node", "n1", 0, segment, 0.3)
    assert moved_by(start, work) < 1e-12
    assert len(contour(work).nodes) == 5
    assert np.delete(contour(work).nodes, segment + 1).tolist() == kinds


def test_deleting_refits_and_empties_only_what_is_asked():
    work = one(path(LEAF + " M 100 0 H 110 V 10 Z"))
    start = find(work.document, "n1")
    work.do("insert_node", "n1", 0, 1, 0.4)
    work.do("delete_nodes", "n1", [(0, 2)])
    assert moved_by(start, work) < 1e-6
    work.do("delete_nodes", "n1", [(1, 0), (1, 1), (1, 2)])
    assert len(curves(work).contours) == 1
    refused(work, "delete the outline instead", "delete_nodes", "n1", [(0, i) for i in range(4)])
    refused(work, "no node 9 in contour 0", "delete_nodes", "n1", [(0, 9)])
    refused(work, "no contour 5", "delete_nodes", "n1", [(5, 0)])


def test_nodes_are_mapped_with_their_handles():
    work = one(path(LEAF))
    old = contour(work).points
    turn = [(0, -1, 5), (1, 0, 0)]
    work.do("transform_nodes", "n1", [(0, 1)], turn)
    rows = [2, 3, 4]
    assert np.allclose(contour(work).points[rows], old[rows] @ [[0, 1], [-1, 0]] + (5, 0))
    assert np.array_equal(np.delete(contour(work).points, rows, axis=0), np.delete(old, rows, axis=0))
    work.do("transform_nodes", "n1", [(0, i) for i in range(4)], [(2, 0, 0), (0, 3, 0)])
    assert contour(work).points[0].tolist() == [0, 0]
    assert work.document.profiles[0].segments == "MCCLq"


def test_nodes_are_lined_up_and_spread():
    work = one(path("M 0 0 L 4 1 L 5 5 L 20 2"))
    every = [(0, i) for i in range(4)]
    work.do("distribute_nodes", "n1", every, "x")
    assert np.allclose(contour(work).places[:, 0], [0, 20 / 3, 40 / 3, 20])
    for to, height in (("min", 0), ("max", 5), ("middle", 2.5)):
        work.do("align_nodes", "n1", every, "y", to)
        assert contour(work).places[:, 1].tolist() == [height] * 4
        work.undo()
    refused(work, "x and y", "align_nodes", "n1", every, "z")
    refused(work, "three", "distribute_nodes", "n1", every[:2], "x")


def test_outlines_are_mirrored_where_they_are():
    for node in (path(LEAF), BSpline(points=((0, 0), (10, 0), (10, 8), (3, 9)), closed=True), Circle(segments=5),
                 Union(children=(Rectangle(), Circle(radius=3).at(20)))):  # fmt: skip
        work = one(node.at(7))
        old = path_of(find(work.document, "n1").placed())
        work.do("mirror_outline", "n1", "x")
        new = path_of(find(work.document, "n1").at(-7))
        assert np.allclose(new.bounds(), old.bounds(), atol=1e-12)
        assert abs(new.area()) == pytest.approx(abs(old.area()), rel=1e-12)
        mirrored = old.transformed([[-1, 0, old.bounds()[:, 0].sum()], [0, 1, 0]])
        assert np.allclose(new.contours[0].points, mirrored.contours[0].points, atol=1e-12)
        work.do("mirror_outline", "n1", "x")
        assert np.allclose(path_of(find(work.document, "n1").at(-7)).contours[0].points, old.contours[0].points)


def test_expressions_of_coordinates_that_stay_are_kept_and_others_refused():
    drawn = Path(points=((0, 0), ("w", 0), ("w", "w / 2"), (0, 10)), segments="MLLLl")
    work = one(drawn, parameters=(Parameter("w", 20.0),))
    refused(work, "point 1 follows the expression “w”", "move_nodes", "n1", [(0, 1)], (1, 0))
    work.do("move_nodes", "n1", [(0, 1)], (0, -3))
    assert find(work.document, "n1").points[1] == (Expression("w"), -3.0)
    work.do("insert_node", "n1", 0, 1, 0.5)
    work.do("reverse_contours", "n1")
    work.do("break_path", "n1", [(0, 0)])
    work.do("add_contour", "n1", "M 50 50 h 1 v 1 z")
    points = find(work.document, "n1").points
    assert (Expression("w"), -3.0) in points and (Expression("w"), Expression("w / 2")) in points
    work.do("delete_nodes", "n1", [(0, 2)])
    points = find(work.document, "n1").points
    assert (Expression("w"), -3.0) in points and (Expression("w"), Expression("w / 2")) not in points
    work.do("set_parameter", "w", 30)
    assert curves(work).bounds()[1, 0] == 51.0 and contour(work).points[:, 0].max() == 30.0


def test_a_handle_with_an_expression_is_not_overwritten_by_a_new_node():
    drawn = Path(points=((0, 0), ("w", 5), (10, 5), (10, 0)), segments="MC")
    work = one(drawn, parameters=(Parameter("w", 2.0),))
    refused(work, "follows the expression", "insert_node", "n1", 0, 0, 0.5)


def test_what_has_no_nodes_is_told_so():
    work = session(
        Rectangle(id="n1", name="A"), BSpline(id="n2", name="B", points=OPEN.points), solids=(Box(id="n3", name="C"),)
    )
    refused(work, "“A” is a rectangle.*convert it to a path first", "move_nodes", "n1", [(0, 0)], (1, 0))
    refused(work, "“B” is a B-spline.*convert it to a path first", "insert_node", "n2", 0, 0, 0.5)
    refused(work, "“C” is no outline", "break_path", "n3", [(0, 0)])
    refused(work, "“C” is no outline", "convert_to_path", "n3")
    refused(work, "“A” is a rectangle and has no control points", "move_points", "n1", [0], (1, 0))
    work.do("convert_to_path", "n1")
    for nodes in (5, ["x"], [(0, 0.5)]):
        refused(work, "pairs of numbers|whole number", "delete_nodes", "n1", nodes)
    refused(work, "select nodes", "move_nodes", "n1", [], (1, 0))
    refused(work, "numbers", "move_nodes", "n1", [(0, 0)], (1, 0, 0))


def test_a_bezier_curve_of_a_path_s_degree_becomes_one_when_nodes_are_edited():
    work = one(Bezier(points=((0, 0), (5, 9), (12, 1))).named("Bow"))
    before = find(work.document, "n1")
    work.do("insert_node", "n1", 0, 0, 0.5)
    assert isinstance(find(work.document, "n1"), Path) and find(work.document, "n1").name == "Bow"
    assert moved_by(before, work) < 1e-12


def test_moving_a_node_of_ten_thousand_segments_keeps_up_with_the_pointer():
    points = np.random.default_rng(1).random((30_001, 2)).tolist()
    work = one(Path(points=points, segments="M" + "C" * 10_000))
    spent = []
    for _ in range(7):
        start = time.process_time()
        work.do("move_nodes", "n1", [(0, 5)], (1, 0))
        spent.append(time.process_time() - start)
    assert min(spent) < 0.08
