"""Paths: commands in and out, transforms, bounds, areas and lengths by formula."""

from __future__ import annotations

import numpy as np
import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.path.path import Contour, Kind, Node, Path
from solidtree.model.path.shapes import ellipse, polygon, rectangle
from solidtree.model.spline.bspline import BSpline
from solidtree.model.spline.knots import clamped_knots

SPLINE = BSpline(np.array([(6.0, 0.0), (9.0, 4.0), (4.0, 6.0), (8.0, 9.0), (0.0, 9.0)]), 3, clamped_knots(5, 3))
ALL = [
    ("move", (0.0, 0.0)),
    ("line", (2.0, 0.0)),
    ("quad", (4.0, -3.0), (5.0, 0.0)),
    ("cubic", (5.0, 1.0), (6.0, 1.0), (6.0, 0.0)),
    ("spline", SPLINE),
    ("close",),
    ("move", (20.0, 0.0)),
    ("line", (21.0, 5.0)),
]


def plain(commands: list) -> list:
    return [tuple(part.tolist() if isinstance(part, np.ndarray) else part for part in command) for command in commands]


def test_commands_come_back_as_they_went_in() -> None:
    path = Path.of_commands(ALL, "evenodd")
    assert [contour.closed for contour in path.contours] == [True, False]
    assert path.contours[0].kinds.tolist() == [Kind.LINE, Kind.QUADRATIC, Kind.CUBIC, Kind.SPLINE, Kind.LINE]
    wanted = [tuple(list(part) if isinstance(part, tuple) else part for part in command) for command in ALL]
    assert plain(path.commands()) == wanted
    assert Path.of_commands(path.commands()).commands()[4][1] is SPLINE


def test_after_a_close_the_next_contour_begins_where_the_closed_one_did() -> None:
    path = Path.of_commands([*ALL[:3], ("close",), ("line", (0.0, 7.0))])
    assert path.contours[1].points.tolist() == [[0.0, 0.0], [0.0, 7.0]]


def test_a_spline_that_begins_elsewhere_is_reached_by_a_line_and_bare_moves_are_nothing() -> None:
    path = Path.of_commands([("move", (0, 0)), ("move", (1, 1)), ("spline", SPLINE), ("move", (3, 3))])
    assert len(path.contours) == 1
    assert path.contours[0].kinds.tolist() == [Kind.LINE, Kind.SPLINE]


@pytest.mark.parametrize(
    ("commands", "words"),
    [
        ([("line", (0, 0))], "command 1 .*no point to begin"),
        ([("move", (0, 0)), ("cubic", (1, 1), (2, 2))], "command 2 .*needs 3 points, not 2"),
        ([("move", (0, 0)), ("line", (1, np.nan))], "command 2 .*finite"),
        ([("move", (0, 0)), ("line", (1, 2, 3))], "command 2 .*3 coordinates"),
        ([("move", "ab")], "command 1 .*finite"),
        ([("move", (0, 0)), ("arc", (1, 2))], "command 2 .*“arc”"),
        ([("move", (0, 0)), ("spline", 7)], "command 2 .*B-spline"),
        ([("move", (0, 0)), ()], "command 2 "),
    ],
)
def test_a_command_at_fault_is_named(commands: list, words: str) -> None:
    with pytest.raises(Refusal, match=words):
        Path.of_commands(commands)


def test_an_unknown_rule_is_refused() -> None:
    with pytest.raises(Refusal, match="nonzero"):
        Path.of_commands([], "positive")


def test_transforms_keep_the_kinds_and_move_every_point_alike() -> None:
    path, matrix = Path.of_commands(ALL), np.array([[2.0, 1.0, 3.0], [0.0, -1.0, 4.0]])
    moved = path.transformed(matrix)
    assert moved.contours[0].kinds.tolist() == path.contours[0].kinds.tolist()
    assert moved.area() == pytest.approx(-2.0 * path.area(), rel=1e-13)  # the determinant
    back = moved.transformed(
        np.column_stack((np.linalg.inv(matrix[:, :2]), -np.linalg.inv(matrix[:, :2]) @ matrix[:, 2]))
    )
    assert np.allclose(back.contours[0].points, path.contours[0].points, rtol=0.0, atol=1e-13)
    lifted = path.transformed(np.array([[1.0, 0, 0, 0], [0, 0, 1, 5], [0, 1, 0, 0]]))
    assert lifted.bounds()[:, [0, 2]] == pytest.approx(path.bounds())
    assert lifted.length() == pytest.approx(path.length(), rel=1e-13)
    with pytest.raises(ValueError, match="does not move"):
        lifted.transformed(matrix)


def test_a_shear_makes_symmetric_nodes_smooth_and_a_turn_does_not() -> None:
    circle = ellipse((0, 0), 1)
    assert set(circle.transformed([[0, -3, 1], [3, 0, 1]]).contours[0].nodes.tolist()) == {Node.SYMMETRIC}
    assert set(circle.transformed([[1, 1, 0], [0, 1, 0]]).contours[0].nodes.tolist()) == {Node.SMOOTH}


def test_reversing_turns_the_area_and_twice_is_the_same() -> None:
    path = Path.of_commands(ALL)
    assert path.reversed().area() == pytest.approx(-path.area(), rel=1e-13)
    twice = path.reversed().reversed().contours[0]
    assert (twice.points == path.contours[0].points).all()
    assert (twice.splines[0].points == SPLINE.points).all()


def test_bounds_are_those_of_the_curve() -> None:
    # The cubic's y is 3 t (1 - t)² + 3 t² (1 - t) = 3 t (1 - t); the quadratic's -6 t (1 - t).
    path = Path.of_commands(ALL[:4])
    assert path.bounds().tolist() == [[0.0, -1.5], [6.0, 0.75]]
    with pytest.raises(ValueError, match="no bounds"):
        Path(()).bounds()


def test_areas_by_formula() -> None:
    assert rectangle(3, 4).area() == 12.0
    assert polygon(6, 2.0).area() == pytest.approx(6.0 * np.sqrt(3.0), rel=1e-14)
    parabola = Path.of_commands([("move", (0, 0)), ("quad", (1, -2), (2, 0)), ("close",)])
    assert parabola.area() == pytest.approx(4.0 / 3.0, rel=1e-15)  # two thirds of its box (Archimedes)
    far = ellipse((1e4, -1e4), (3, 2), 20, exact=True)  # control points are rounded to 2e-12 there
    assert far.area() == pytest.approx(6.0 * np.pi, abs=far.length() * 2e-12)
    ring = Path(ellipse((0, 0), 3, exact=True).contours + ellipse((0, 0), 1, exact=True).reversed().contours)
    assert ring.area() == pytest.approx(8.0 * np.pi, rel=1e-13)
    with pytest.raises(ValueError, match="plane"):
        Path.of_commands([("move", (0, 0, 0)), ("line", (1, 1, 1))]).area()


def test_lengths_by_formula() -> None:
    assert ellipse((0, 0), 2, exact=True).length() == pytest.approx(4.0 * np.pi, rel=1e-13)
    arch = Path.of_commands([("move", (-1, 1)), ("quad", (0, -1), (1, 1))])  # y = x²
    assert arch.length() == pytest.approx(np.sqrt(5.0) + 0.5 * np.arcsinh(2.0), rel=1e-14)


def test_a_contour_that_does_not_hang_together_cannot_be_made() -> None:
    with pytest.raises(ValueError, match="do not fit"):
        Contour(np.zeros((3, 2)), np.array([Kind.CUBIC]))
    with pytest.raises(ValueError, match="end where it begins"):
        Contour(np.array([(0.0, 0.0), (1.0, 0.0)]), np.array([Kind.LINE]), closed=True)
    with pytest.raises(ValueError, match="read-only"):
        rectangle(1, 1).contours[0].points[0] = 1.0
