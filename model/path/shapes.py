"""Outlines by their sizes: rectangles, ellipses and arcs, polygons, stars. All run counter-clockwise, y up."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil, cos, hypot, isfinite, pi, radians, sin, tan

import numpy as np
from numpy.typing import ArrayLike

from ..document.errors import Refusal
from .path import ROUNDING, Contour, Floats, Kind, Node, Path

QUARTER = 2.0 / 27.0 * sin(pi / 8.0) ** 6 / cos(pi / 8.0) ** 2
"""How far the cubic of a quarter circle of radius 1 reaches beyond it: 2.7253e-4."""


def arc_error(angle: float) -> float:
    """How far the cubic of an arc of radius 1 over `angle` degrees leaves it: outwards alone, and largest at 2 places.

    2/27 sin⁶(φ/4) / cos²(φ/4), after Goldapp (1991): a half of the angle is a 64th of the error.
    """
    quarter = radians(abs(angle)) / 4.0
    return 2.0 / 27.0 * sin(quarter) ** 6 / cos(quarter) ** 2


def arc_pieces(radius: float, angle: float, tolerance: float | None = None) -> int:
    """How many cubics an arc over `angle` degrees needs: a quarter each, more where `tolerance` mm asks for it."""
    count = max(ceil(abs(angle) / 90.0 - 1e-9), 1)
    if tolerance is not None:
        if not tolerance > 0.0:
            raise Refusal(f"the tolerance of a curve must be above 0 mm, not {tolerance!r:.40}")
        while radius * arc_error(angle / count) > tolerance and count < 10_000:
            count += 1
    return count


def unit_arc(start: float, sweep: float, count: int) -> Floats:
    """(count, 4, 2) cubics of the unit circle from `start` over `sweep` degrees, counter-clockwise where positive."""
    step = radians(sweep) / count
    handle = 4.0 / 3.0 * tan(step / 4.0)
    angles = radians(start) + step * np.arange(count + 1)
    points = np.stack((np.cos(angles), np.sin(angles)), axis=1)
    points[np.abs(points) < 1e-16] = 0.0
    along = handle * np.stack((-points[:, 1], points[:, 0]), axis=1)
    return np.stack((points[:-1], points[:-1] + along[:-1], points[1:] - along[1:], points[1:]), axis=1)


def arc(
    centre: ArrayLike,
    radii: float | tuple[float, float],
    start: float,
    sweep: float,
    rotation: float = 0.0,
    tolerance: float | None = None,
) -> Path:
    """An open arc of a circle or an ellipse as cubics, from `start` over `sweep` degrees (at most 360).

    Angles of an ellipse are those of the circle that it is made from. It leaves the true arc by at most `arc_error` of
    a piece times the larger radius: 0.027 % of it for quarters, less than `tolerance` mm where that is given.
    """
    across = _radii(radii)
    _finite("an arc", start, sweep, rotation)
    if not 0.0 < abs(sweep) <= 360.0:
        raise Refusal(f"an arc runs over more than 0 and at most 360 degrees, not {sweep:g}")
    curves = unit_arc(start, sweep, arc_pieces(max(across), sweep, tolerance))
    return Path((_chain(curves, False).transformed(_ellipse_matrix(centre, across, rotation)),))


def ellipse(
    centre: ArrayLike,
    radii: float | tuple[float, float],
    rotation: float = 0.0,
    tolerance: float | None = None,
    exact: bool = False,
) -> Path:
    """A circle or an ellipse: four cubics or more (see `arc`), or `exact`: one closed rational quadratic B-spline."""
    across = _radii(radii)
    _finite("an ellipse", rotation)
    matrix = _ellipse_matrix(centre, across, rotation)
    if not exact:
        curves = unit_arc(0.0, 360.0, arc_pieces(max(across), 360.0, tolerance))
        contour = _chain(curves, True)
        even = np.full(len(contour), Node.SYMMETRIC, np.uint8)
        return Path((Contour(contour.points, contour.kinds, True, (), even).transformed(matrix),))
    from ..spline.bspline import BSpline

    # Nine points on the square around the circle, weights 1 and cos 45° in turn (Piegl and Tiller 1989).
    square = np.array([(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)], float)
    weights = np.where(np.arange(9) % 2, np.sqrt(0.5), 1.0)
    knots = np.array([0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4]) / 4.0
    circle = Contour.of_segments([BSpline(square, 2, knots, weights)], closed=True)
    return Path((circle.transformed(matrix),))


def rectangle(
    width: float, height: float, radius: float | Sequence[float] = 0.0, corner: ArrayLike = (0.0, 0.0)
) -> Path:
    """From its lower left corner; `radius` of all corners or of each, from that one counter-clockwise.

    Radii that do not fit are made smaller together, as CSS Backgrounds (2017, section 5.5) has it. Round corners are
    cubics that reach 0.027 % of the radius beyond their circle.
    """
    _finite("a rectangle", width, height)
    if not (width > 0.0 and height > 0.0):
        raise Refusal(f"a rectangle needs a width and a height above 0 mm, not {width:g} × {height:g}")
    given = np.asarray(radius, float)
    if given.shape not in ((), (4,)) or not (np.isfinite(given).all() and (given >= 0.0).all()):
        raise Refusal("a rectangle has one radius of its corners or four, none below 0 mm")
    rounds = np.broadcast_to(given, (4,))
    sides = np.array([width, height, width, height])
    both = rounds + np.roll(rounds, -1)
    rounds = rounds * min(1.0, (sides[both > 0.0] / both[both > 0.0]).min(initial=1.0))
    corners = np.array([(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)])
    inwards = np.array([(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)])
    bows = [
        corners[number] + rounds[number] * (inwards[number] + unit_arc(180.0 + 90.0 * number, 90.0, 1)[0])
        for number in range(4)
    ]
    segments: list[Floats] = []
    here = bows[0][-1]
    for number in (1, 2, 3, 0):
        if np.abs(bows[number][0] - here).max() > ROUNDING * max(width, height):
            segments.append(np.stack((here, bows[number][0])))
        if rounds[number]:
            segments.append(bows[number])
        here = bows[number][-1]
    return Path((Contour.of_segments(segments, True).transformed(np.column_stack((np.eye(2), _point(corner)))),))


def polygon(sides: int, radius: float, centre: ArrayLike = (0.0, 0.0), start: float = 90.0) -> Path:
    """A regular polygon; `radius` mm to its corners, the first of them at `start` degrees."""
    _finite("a polygon", radius, start)
    if not (3 <= sides <= 100_000 and radius > 0.0):
        raise Refusal(f"a polygon needs 3 to 100,000 sides and a radius above 0 mm, not {sides} and {radius:g}")
    return _corners(np.full(sides, radius), centre, start)


def star(points: int, outer: float, inner: float, centre: ArrayLike = (0.0, 0.0), start: float = 90.0) -> Path:
    """A star with tips `outer` mm from the centre, the first at `start` degrees, and dents `inner` mm from it."""
    _finite("a star", outer, inner, start)
    if not (2 <= points <= 100_000 and outer > 0.0 and inner > 0.0):
        raise Refusal(f"a star needs 2 to 100,000 tips and radii above 0 mm, not {points}, {outer:g} and {inner:g}")
    return _corners(np.tile([outer, inner], points), centre, start)


def svg_arc(
    begin: ArrayLike,
    radii: tuple[float, float],
    rotation: float,
    large: bool,
    sweep: bool,
    end: ArrayLike,
    tolerance: float | None = None,
) -> Floats:
    """(k, 4, 2) cubics of the elliptical arc of SVG 2 (section 9.5.1; appendix B.2.4), ends exact.

    Too small radii are made as large as is needed. A line, as a cubic, where a radius is 0; (0, 4, 2) where the ends
    are one point. `sweep` is towards growing angles: clockwise on paper where y runs down.
    """
    first, last = _point(begin), _point(end)
    rx, ry = abs(radii[0]), abs(radii[1])
    _finite("an arc", rx, ry, rotation)
    if (first == last).all():
        return np.zeros((0, 4, 2))
    if not (rx and ry):
        return (first + np.arange(4)[:, None] / 3.0 * (last - first))[None]
    turn = np.array(
        [[cos(radians(rotation)), sin(radians(rotation))], [-sin(radians(rotation)), cos(radians(rotation))]]
    )
    half = turn @ (first - last) / 2.0 / (rx, ry)  # on the unit circle, about the middle of the ends
    apart = hypot(*half)
    if apart > 1.0:
        rx, ry, half = rx * apart, ry * apart, half / apart
    side = np.sqrt(max(1.0 - half @ half, 0.0)) / hypot(*half) * (1.0 if large != sweep else -1.0)
    centre = side * np.array([half[1], -half[0]])
    from_, to = half - centre, -half - centre
    start = np.degrees(np.arctan2(from_[1], from_[0]))
    swept = (np.degrees(np.arctan2(to[1], to[0])) - start) % 360.0
    if not sweep:
        swept -= 360.0
    curves = unit_arc(start, swept, arc_pieces(max(rx, ry), swept, tolerance))
    found = ((curves + centre) * (rx, ry)) @ turn + (first + last) / 2.0
    found[0, 0], found[-1, -1] = first, last
    return found


def _corners(radii: Floats, centre: ArrayLike, start: float) -> Path:
    angles = radians(start) + 2.0 * pi * np.arange(len(radii)) / len(radii)
    points = _point(centre) + radii[:, None] * np.stack((np.cos(angles), np.sin(angles)), axis=1)
    return Path((Contour(np.vstack((points, points[:1])), np.full(len(points), Kind.LINE, np.uint8), True),))


def _chain(curves: Floats, closed: bool) -> Contour:
    return Contour.of_segments(list(curves), closed)


def _radii(radii: float | tuple[float, float]) -> tuple[float, float]:
    rx, ry = (radii, radii) if isinstance(radii, int | float) else radii
    if not (isfinite(rx) and isfinite(ry) and rx > 0.0 and ry > 0.0):
        raise Refusal(f"a circle or an ellipse needs radii above 0 mm, not {rx:g} and {ry:g}")
    return float(rx), float(ry)


def _ellipse_matrix(centre: ArrayLike, radii: tuple[float, float], rotation: float) -> Floats:
    c, s = cos(radians(rotation)), sin(radians(rotation))
    return np.column_stack((np.array([[c, -s], [s, c]]) * radii, _point(centre)))


def _point(given: ArrayLike) -> Floats:
    point = np.asarray(given, float)
    if point.shape != (2,) or not np.isfinite(point).all():
        raise Refusal(f"a point of an outline is two finite numbers, not {given!r:.60}")
    return point


def _finite(what: str, *numbers: float) -> None:
    if not all(isfinite(number) for number in numbers):
        raise Refusal(f"the sizes and angles of {what} must be finite numbers")
