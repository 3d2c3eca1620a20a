"""Shapes: areas, bounds and errors by formula."""

from __future__ import annotations

import numpy as np
import pytest

from solidtree.model.curve.bezier import evaluated
from solidtree.model.document.errors import Refusal
from solidtree.model.path.path import Kind
from solidtree.model.path.shapes import arc, arc_error, ellipse, polygon, rectangle, star, svg_arc, unit_arc


@pytest.mark.parametrize("angle", [10.0, 45.0, 90.0, -120.0])
def test_the_cubic_of_an_arc_leaves_it_outwards_by_the_stated_error(angle: float) -> None:
    radii = np.linalg.norm(evaluated(unit_arc(17.0, angle, 1)[0], np.linspace(0.0, 1.0, 20001)), axis=1)
    assert radii.min() > 1.0 - 1e-15
    assert radii.max() - 1.0 == pytest.approx(arc_error(angle), rel=0.01, abs=1e-15)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9])
def test_a_circle_stays_within_its_tolerance_with_no_piece_too_many(tolerance: float) -> None:
    contour = ellipse((0, 0), 25, tolerance=tolerance).contours[0]
    radii = np.linalg.norm(np.array([evaluated(s, np.linspace(0, 1, 99)) for s in contour.segments()]), axis=-1)
    assert np.abs(radii - 25.0).max() <= tolerance + 1e-13
    assert len(contour) == 4 or 25.0 * arc_error(360.0 / (len(contour) - 1)) > tolerance


def test_an_exact_ellipse_is_one() -> None:
    path = ellipse((1, 2), (5, 3), 30, exact=True)
    assert path.contours[0].kinds.tolist() == [Kind.SPLINE]
    assert path.area() == pytest.approx(15.0 * np.pi, rel=1e-14)
    c, s = np.cos(np.pi / 6), np.sin(np.pi / 6)
    reach = np.hypot(5 * c, 3 * s), np.hypot(5 * s, 3 * c)
    assert path.bounds() == pytest.approx(np.array([(1 - reach[0], 2 - reach[1]), (1 + reach[0], 2 + reach[1])]))


def test_an_arc_begins_and_ends_where_it_should() -> None:
    path = arc((1, 0), (4, 2), 90, -180, tolerance=1e-6)
    assert path.contours[0].points[[0, -1]] == pytest.approx(np.array([(1.0, 2.0), (1.0, -2.0)]), abs=1e-15)
    assert path.bounds()[1, 0] == pytest.approx(5.0, abs=1e-6)
    assert not path.contours[0].closed


@pytest.mark.parametrize(
    ("radius", "kinds", "missing"),
    [
        (0.0, [1, 1, 1, 1], 0.0),
        (1.0, [1, 3] * 4, 4.0 - np.pi),
        (2.5, [1, 3, 3, 1, 3, 3], (4.0 - np.pi) * 6.25),
        ((0.0, 2.0, 0.0, 1.0), [1, 3, 1, 1, 3, 1], (1.0 - np.pi / 4.0) * 5.0),
    ],
)
def test_rectangles_with_round_corners(radius: float, kinds: list[int], missing: float) -> None:
    path = rectangle(10, 5, radius, corner=(2, 3))
    assert path.contours[0].kinds.tolist() == kinds
    # Cubics take away less than the circle: at most their error along the quarter.
    off = arc_error(90.0) * np.max(radius) ** 2 * 2.0 * np.pi
    assert 50.0 - missing <= path.area() + 1e-12
    assert path.area() <= 50.0 - missing + off + 1e-12
    assert path.bounds().tolist() == [[2.0, 3.0], [12.0, 8.0]]


def test_radii_that_do_not_fit_shrink_together() -> None:
    # The left side is 6 long and would need 9 + 3: all are halved.
    assert rectangle(20, 6, (3, 0, 0, 9)).area() == pytest.approx(rectangle(20, 6, (1.5, 0, 0, 4.5)).area())


def test_polygons_and_stars_by_formula() -> None:
    for sides in (3, 5, 12):
        assert polygon(sides, 2.0, (5, 5)).area() == pytest.approx(2.0 * sides * np.sin(2 * np.pi / sides))
        assert star(sides, 3.0, 1.0).area() == pytest.approx(sides * 3.0 * np.sin(np.pi / sides))
    assert polygon(4, 1.0, start=0).contours[0].points[0].tolist() == [1.0, 0.0]


@pytest.mark.parametrize("large", [False, True])
@pytest.mark.parametrize("sweep", [False, True])
def test_an_arc_of_svg_lies_on_the_ellipse_through_both_ends(large: bool, sweep: bool) -> None:
    begin, end, radii, rotation = (1.0, 2.0), (4.0, 3.0), (5.0, 2.5), 25.0
    curves = svg_arc(begin, radii, rotation, large, sweep, end, 1e-9)
    assert (curves[0, 0] == begin).all() and (curves[-1, -1] == end).all()
    points = evaluated(curves, np.linspace(0, 1, 9)).reshape(-1, 2)
    c, s = np.cos(np.radians(rotation)), np.sin(np.radians(rotation))
    unit = points @ np.array([[c, -s], [s, c]]) / radii
    # The circle through three of them is that of radius 1, and all lie on it.
    a, b, d = unit[0], unit[len(unit) // 2], unit[-1]
    centre = np.linalg.solve(2.0 * np.array([b - a, d - a]), [b @ b - a @ a, d @ d - a @ a])
    assert np.linalg.norm(unit - centre, axis=1) == pytest.approx(1.0, abs=1e-8)
    turns = np.unwrap(np.arctan2(*(unit - centre).T[::-1]))
    assert (abs(turns[-1] - turns[0]) > np.pi) == large
    assert (turns[-1] > turns[0]) == sweep


def test_svg_arcs_at_the_edge() -> None:
    assert len(svg_arc((1, 1), (3, 3), 0, False, True, (1, 1))) == 0
    line = svg_arc((0, 0), (0, 3), 0, False, True, (3, 6))
    assert np.allclose(line[0], np.arange(4)[:, None] * (1.0, 2.0))
    half = svg_arc((0, 0), (1, 1), 0, False, True, (10, 0), 1e-9)  # radii too small: a half circle of radius 5
    assert np.abs(half[..., 1]).max() == pytest.approx(5.0, rel=0.02)
    assert evaluated(half, 0.5)[len(half) // 2] == pytest.approx([5.0, -5.0], abs=1.5)


@pytest.mark.parametrize(
    "make",
    [
        lambda: rectangle(0, 1),
        lambda: rectangle(1, 1, -1),
        lambda: rectangle(1, 1, (1, 2)),
        lambda: ellipse((0, 0), 0),
        lambda: ellipse((0, np.nan), 1),
        lambda: ellipse((0, 0), 1, tolerance=0.0),
        lambda: arc((0, 0), 1, 0, 0),
        lambda: arc((0, 0), 1, 0, 400),
        lambda: polygon(2, 1),
        lambda: star(5, 1, 0),
        lambda: star(5, np.inf, 1),
    ],
)
def test_sizes_that_make_no_shape_are_refused(make) -> None:
    with pytest.raises(Refusal):
        make()
