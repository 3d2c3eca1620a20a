"""Editing: inserting changes nothing, deleting gives back, handles follow their node's kind."""

from __future__ import annotations

import numpy as np
import pytest

from solidtree.model.curve.bezier import evaluated
from solidtree.model.document.errors import Refusal
from solidtree.model.path.editing import break_at, close, convert, delete, insert, join
from solidtree.model.path.flatten import chords
from solidtree.model.path.nodes import inferred, move, move_handle, set_kind
from solidtree.model.path.path import Contour, Kind, Node, Path
from solidtree.model.path.shapes import ellipse, rectangle
from solidtree.model.spline.bspline import BSpline
from solidtree.model.spline.bspline import evaluated as on_spline

KNOTS = np.array([0.0, 0, 0, 0, 1, 3, 3, 3, 3])
SPLINE = BSpline(np.array([(8.0, 0.0), (9.0, 4.0), (4.0, 6.0), (8.0, 9.0), (0.0, 9.0)]), 3, KNOTS)
MIXED = Path.of_commands(
    [
        ("move", (0, 0)),
        ("line", (3, -1)),
        ("quad", (4, -3), (5, 0)),
        ("cubic", (5, 1), (8, 2), (8, 0)),
        ("spline", SPLINE),
        ("close",),
    ]
).contours[0]


def at(contour: Contour, segment: int, t: np.ndarray) -> np.ndarray:
    """Points of a segment, by its own evaluation."""
    found = contour.segment(segment)
    if isinstance(found, BSpline):
        start, end = found.domain
        return on_spline(found, start + t * (end - start))
    return evaluated(found, t)


@pytest.mark.parametrize("segment", range(5))
@pytest.mark.parametrize("parameter", [1e-3, 0.3, 0.5])
def test_a_node_put_in_leaves_the_curve_as_it_is(segment: int, parameter: float) -> None:
    after = insert(MIXED, segment, parameter)
    assert len(after) == len(MIXED) + 1
    assert after.kinds.tolist() == np.insert(MIXED.kinds, segment, MIXED.kinds[segment]).tolist()
    t = np.linspace(0.0, 1.0, 41)
    left, right = at(MIXED, segment, parameter * t), at(MIXED, segment, parameter + (1.0 - parameter) * t)
    assert np.abs(at(after, segment, t) - left).max() <= 1e-12
    assert np.abs(at(after, segment + 1, t) - right).max() <= 1e-12
    assert after.closed


def test_symmetric_neighbours_of_a_node_put_in_become_smooth() -> None:
    circle = ellipse((0, 0), 5).contours[0]
    assert insert(circle, 3, 0.5).nodes.tolist() == [Node.SMOOTH, Node.SYMMETRIC, Node.SYMMETRIC, 1, Node.SMOOTH]


def test_deleting_what_was_put_in_gives_the_curve_back() -> None:
    circle = ellipse((0, 0), (5, 3)).contours[0]
    for parameter in (0.1, 0.5, 0.8):
        back = delete(insert(circle, 1, parameter), 2)
        assert back is not None
        assert np.abs(back.points - circle.points).max() < 1e-9
    back = delete(insert(circle, 3, 0.5), 4)  # over the seam
    assert back is not None
    assert np.abs(back.points - circle.points).max() < 1e-9


def test_deleting_refits_better_than_it_keeps_handles() -> None:
    circle = ellipse((0, 0), 5).contours[0]
    refitted, kept = delete(circle, 1), delete(circle, 1, refit=False)
    assert refitted is not None and kept is not None
    assert len(refitted) == len(kept) == 3
    wanted = 25.0 * np.pi
    assert abs(refitted.area() - wanted) < 0.3 * abs(kept.area() - wanted)


def test_deleting_nodes_between_lines_leaves_a_line_and_too_few_nodes_nothing() -> None:
    square = rectangle(4, 4).contours[0]
    triangle = delete(square, 1)
    assert triangle is not None
    assert triangle.kinds.tolist() == [Kind.LINE] * 3
    assert triangle.area() == 8.0
    assert delete(square, [0, 1, 2]) is None
    line = break_at(square, 0)[0]
    shorter = delete(line, [0, 4])
    assert shorter is not None
    assert shorter.places.tolist() == [[4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]


def test_breaking_joining_and_closing() -> None:
    (opened,) = break_at(MIXED, 2)
    assert not opened.closed
    assert opened.length() == pytest.approx(MIXED.length(), rel=1e-13)
    first, second = break_at(opened, 3)
    assert len(first) + len(second) == len(opened)
    whole = join(first, second)
    assert len(whole) == len(opened)
    assert close(whole).area() == pytest.approx(MIXED.area(), rel=1e-13)
    with pytest.raises(Refusal, match="already"):
        break_at(opened, 0)
    with pytest.raises(Refusal, match="closed already"):
        close(MIXED)
    with pytest.raises(Refusal, match="break it first"):
        join(MIXED, opened)


def test_ends_apart_are_joined_by_a_line_or_merged_midway() -> None:
    first, second = Path.of_commands(
        [("move", (0, 0)), ("cubic", (1, 1), (2, 1), (3, 0)), ("move", (5, 0)), ("line", (5, 4))]
    ).contours
    assert join(first, second).kinds.tolist() == [Kind.CUBIC, Kind.LINE, Kind.LINE]
    merged = join(first, second, merge=True)
    assert merged.places.tolist() == [[0.0, 0.0], [4.0, 0.0], [5.0, 4.0]]
    assert merged.points[2].tolist() == [3.0, 1.0]  # the handle went along
    assert close(merged).kinds.tolist() == [Kind.CUBIC, Kind.LINE, Kind.LINE]
    assert close(merged, merge=True).places.tolist() == [[2.5, 2.0], [4.0, 0.0]]


def test_converting_says_how_far_the_curve_moved() -> None:
    higher, off = convert(MIXED, 1, Kind.CUBIC)
    assert off == 0.0
    assert np.abs(at(higher, 1, np.linspace(0, 1, 33)) - at(MIXED, 1, np.linspace(0, 1, 33))).max() < 1e-14
    line, off = convert(MIXED, 1, Kind.LINE)
    assert line.kinds[1] == Kind.LINE
    way, chord = at(MIXED, 1, np.linspace(0, 1, 5001)) - (3.0, -1.0), np.array([2.0, 1.0])
    assert off == pytest.approx(np.abs(way @ (-chord[1], chord[0])).max() / np.hypot(2, 1), rel=1e-3)
    cubics, off = convert(MIXED, 3, Kind.CUBIC)
    assert off == 0.0
    assert len(cubics) == len(MIXED) + 1  # a spline of two intervals
    assert cubics.area() == pytest.approx(MIXED.area(), rel=1e-13)


@pytest.mark.parametrize("tolerance", [None, 1e-2, 1e-4])
def test_a_cubic_as_quadratics_keeps_the_tolerance(tolerance: float | None) -> None:
    path = Path.of_commands([("move", (0, 0)), ("cubic", (0, 5), (8, 9), (9, 0))])
    after, off = convert(path.contours[0], 0, Kind.QUADRATIC, tolerance)
    assert set(after.kinds.tolist()) == {Kind.QUADRATIC}
    pieces = len(after)
    assert pieces == 1 if tolerance is None else off <= tolerance
    t = np.linspace(0.0, 1.0, 101)
    apart = max(
        np.linalg.norm(at(after, i, t) - at(path.contours[0], 0, (i + t) / pieces), axis=1).max() for i in range(pieces)
    )
    assert apart == pytest.approx(off, rel=1e-3)  # the bound is met


def test_moving_a_node_takes_its_handles_along_and_the_seam_stays_shut() -> None:
    circle = ellipse((0, 0), 5).contours[0]
    moved = move(circle, [0, 2], [(1, 1), (0, -1)])
    shift = moved.points - circle.points
    assert shift[[0, 1, 11, 12]].tolist() == [[1.0, 1.0]] * 4
    assert shift[[5, 6, 7]].tolist() == [[0.0, -1.0]] * 3
    assert not shift[[2, 3, 4, 8, 9, 10]].any()
    spline = move(MIXED, 3, (0, 1)).splines[0]
    assert (spline.points[0] - SPLINE.points[0]).tolist() == [0.0, 1.0]
    assert (spline.points[1:] == SPLINE.points[1:]).all()
    with pytest.raises(Refusal, match="no such node"):
        move(circle, 4, (1, 1))


@pytest.mark.parametrize(("kind", "length"), [(Node.CUSP, None), (Node.SMOOTH, 2.0), (Node.SYMMETRIC, 3.0)])
def test_a_handle_turns_the_one_across_as_the_node_says(kind: Node, length: float | None) -> None:
    path = Path.of_commands([("move", (0, 0)), ("cubic", (1, 0), (3, 0), (5, 0)), ("cubic", (6, 0), (9, 0), (9, 1))])
    contour = set_kind(path.contours[0], 1, kind)
    moved = move_handle(contour, 4, (5, 3))
    across = moved.points[2] - moved.points[3]
    if length is None:
        assert (moved.points[2] == contour.points[2]).all()
    else:
        assert across[0] == pytest.approx(0.0, abs=1e-15)
        assert np.linalg.norm(across) == pytest.approx(
            np.linalg.norm(contour.points[2] - contour.points[3]) if kind == Node.SMOOTH else 3.0
        )
    with pytest.raises(Refusal, match="no handle"):
        move_handle(contour, 3, (0, 0))


def test_a_smooth_node_beside_a_line_keeps_its_handle_on_the_line() -> None:
    path = Path.of_commands([("move", (0, 0)), ("line", (4, 0)), ("cubic", (5, 5), (9, 5), (9, 0))])
    smooth = set_kind(path.contours[0], 1, Node.SMOOTH)
    assert smooth.points[2] == pytest.approx([4.0 + np.hypot(1, 5), 0.0])
    assert move_handle(smooth, 2, (7, 3)).points[2] == pytest.approx([7.0, 0.0])
    assert move(smooth, 0, (0, -4)).points[2] - (4.0, 0.0) == pytest.approx(np.hypot(1, 5) / np.sqrt(2) * np.ones(2))


def test_automatic_nodes_round_a_square_and_follow() -> None:
    square = rectangle(4, 4).contours[0]
    round_ = set_kind(square, range(4), Node.AUTO)
    assert set(round_.kinds.tolist()) == {Kind.CUBIC}
    # Tangents at the corners of a square are those of its circle, handles a third of a side.
    assert round_.points[1] == pytest.approx(np.array([1.0, -1.0]) / np.sqrt(2.0) * 4.0 / 3.0)
    assert (round_.points[11] == -round_.points[1]).all()
    pulled = move(round_, 2, (2, 2))
    assert (pulled.points[4:9] != round_.points[4:9]).any(axis=1).sum() >= 4  # neighbours turn as well
    assert (pulled.points[[0, 1, 11]] == round_.points[[0, 1, 11]]).all()


def test_kinds_of_nodes_are_told_from_the_curve() -> None:
    outline = rectangle(10, 6, 2).contours[0]
    assert set(inferred(outline).nodes.tolist()) == {Node.SMOOTH}
    assert set(inferred(rectangle(4, 4).contours[0]).nodes.tolist()) == {Node.CUSP}
    assert set(inferred(ellipse((0, 0), 3).contours[0]).nodes.tolist()) == {Node.SYMMETRIC}


@pytest.mark.parametrize("parameter", [0.0, 1.0, np.nan])
def test_a_node_at_the_end_of_a_segment_is_refused(parameter: float) -> None:
    with pytest.raises(Refusal):
        insert(MIXED, 0, parameter)
    with pytest.raises(Refusal, match="segment 9"):
        insert(MIXED, 9, 0.5)


def test_flattening_agrees_after_editing() -> None:
    edited = insert(insert(MIXED, 3, 0.4), 1, 0.7)
    flat = [chords(Path((contour,)), 1e-5).points for contour in (MIXED, edited)]
    lengths = [np.linalg.norm(np.diff(points, axis=0), axis=1).sum() for points in flat]
    assert lengths[0] == pytest.approx(lengths[1], rel=1e-5)
