"""B-splines through points, and near them: interpolation, least squares, and as few knots as a tolerance needs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..document.errors import Refusal
from .banded import least_squares, solved
from .bspline import HIGHEST, BSpline, Floats, basis_rows, derivatives, evaluated, hodograph, spans
from .knots import closed as closed_spline

SPACINGS = {"uniform": 0.0, "centripetal": 0.5, "chord": 1.0}
ENDS = ("free", "natural", "clamped", "closed")
ROUNDS = 64
CORRECTIONS = 3


@dataclass(frozen=True, slots=True, eq=False)
class SplineFit:
    """A B-spline that follows points."""

    spline: BSpline
    parameters: Floats  # (m,) where on it each point has its place
    deviation: float  # mm, the largest distance of a point from its place


def spaced(points: ArrayLike, spacing: str = "chord", closed: bool = False) -> Floats:
    """(m,) parameters from 0 to 1 for points (m, d), or (m + 1,) with the way back to the first one where closed.

    In proportion to the chords' lengths ("chord", Ahlberg and others 1967), their roots ("centripetal", Lee 1989: less
    swing at sharp turns), or even ("uniform"). Raises Refusal where two neighbours are one point.
    """
    if spacing not in SPACINGS:
        raise Refusal(f"the parameters of points are chord, centripetal or uniform, not “{spacing!s:.40}”")
    points = np.asarray(points, float)
    following = np.roll(points, -1, axis=0) if closed else points[1:]
    chords = np.linalg.norm(following - points[: len(following)], axis=1)
    if (chords == 0.0).any():
        number = int(np.argmax(chords == 0.0))
        raise Refusal(f"points {number} and {(number + 1) % len(points)} are at one place; leave one of them out")
    along = np.concatenate([[0.0], np.cumsum(chords ** SPACINGS[spacing])])
    return along / along[-1]


def interpolated(
    points: ArrayLike,
    degree: int = 3,
    ends: str = "free",
    spacing: str | ArrayLike = "chord",
    tangents: ArrayLike | None = None,
) -> BSpline:
    """The B-spline through points (m, d), in order, on the domain from 0 to 1.

    `ends`: "free" has m control points, and knots that are means of `degree` parameters (de Boor 1978). "natural", of
    odd degree, has knots at the points, and at both ends the derivatives (degree + 1) / 2 to degree - 1 are 0: the
    curvature of a cubic (Schoenberg 1964). "clamped" has the end directions `tangents` (2, d): unit vectors for the
    speed of a parameter along the chords. "closed" goes on from the last point to the first, which need not be
    repeated, smooth throughout, with knots at the points where the degree is odd, else between them, the seam half way
    before the first.
    `spacing` may be the parameters themselves, (m,) or for a closed curve (m + 1,), rising from 0 to 1.
    """
    given = _checked(points, degree)
    if ends not in ENDS:
        raise Refusal(f"the ends of a curve through points are free, natural, clamped or closed, not “{ends!s:.40}”")
    if ends == "closed" and (given[0] == given[-1]).all():
        given = given[:-1]
    t = _parameters(given, spacing, ends == "closed")
    if ends == "closed":
        if len(given) < 3:
            raise Refusal("a closed curve goes through three points or more")
        return _closed_through(given, degree, t)
    if ends == "natural" and degree % 2 == 0:
        raise Refusal(f"natural ends need an odd degree, not {degree}; take free ends")
    if ends == "natural" and degree == 1:
        ends = "free"
    orders = {"free": [], "natural": list(range((degree + 1) // 2, degree)), "clamped": [1]}[ends]
    count = len(given) + 2 * len(orders)
    if count <= degree:
        raise Refusal(
            f"a curve of degree {degree} needs {degree + 1 - 2 * len(orders)} points or more; there are {len(given)}"
        )
    aims = np.zeros((2, len(orders), given.shape[1]))
    if ends == "clamped":
        aims[:, 0] = _directions(given, tangents, degree)
    if ends == "natural" or (ends == "clamped" and degree == 3):
        inner = t[1:-1]
    elif count == degree + 1:  # one Bezier curve
        inner = np.zeros(0)
    else:
        sites = np.concatenate([t[:1].repeat(len(orders)), t, t[-1:].repeat(len(orders))])
        inner = np.lib.stride_tricks.sliding_window_view(sites[1:-1], degree).mean(-1)[: count - degree - 1]
    knots = np.concatenate([np.zeros(degree + 1), inner, np.ones(degree + 1)])
    span = spans(knots, degree, t)
    rows = basis_rows(knots, degree, span, t).T
    begin, finish = _end_rows(knots, degree, orders)
    entries = np.concatenate([rows[:1], begin, rows[1:-1], finish, rows[-1:]])
    first = np.concatenate([[0] * (1 + len(orders)), span[1:-1] - degree, [count - degree - 1] * (1 + len(orders))])
    right = np.concatenate([given[:1], aims[0], given[1:-1], aims[1], given[-1:]])
    scale = np.abs(entries).max(1, keepdims=True)
    made = solved(entries / scale, first, right / scale)
    made[0], made[-1] = given[0], given[-1]
    return BSpline(made, degree, knots)


def approximated(
    points: ArrayLike, count: int, degree: int = 3, closed: bool = False, spacing: str | ArrayLike = "chord"
) -> SplineFit:
    """The B-spline of least squares with `count` control points (of a closed one: different ones) for points (m, d).

    It begins and ends at the first and the last point; the knots leave as many points in each interval.
    """
    given = _checked(points, degree)
    if closed and (given[0] == given[-1]).all():
        given = given[:-1]
    least = 3 if closed else degree + 1
    if not least <= count <= len(given):
        raise Refusal(
            f"a curve of degree {degree} near {len(given)} points has {least} to {len(given)} control points, "
            f"not {count}"
        )
    t = _parameters(given, spacing, closed)
    pieces = count if closed else count - degree
    breaks = np.interp(np.linspace(0, len(t) - 1, pieces + 1), np.arange(len(t)), t)
    t = t[: len(given)]
    spline = _near(given, t, breaks, degree, closed)
    return SplineFit(spline, t, float(np.linalg.norm(evaluated(spline, t) - given, axis=1).max()))


def fitted(
    points: ArrayLike, tolerance: float, degree: int = 3, closed: bool = False, spacing: str | ArrayLike = "chord"
) -> SplineFit:
    """A B-spline that leaves none of the points (m, d) by more than `tolerance` mm, with knots where it needs them.

    Least squares; the parameters are moved to the feet of the points (Hoschek 1988); every interval with a point that
    is too far gets a knot in the middle of its points, until all fit. Where that ends at a knot for every other point,
    it is the curve through all of them.
    """
    if not (np.isfinite(tolerance) and tolerance > 0.0):
        raise Refusal(f"the tolerance of a curve must be above 0 mm, not {tolerance!r:.40}")
    given = _checked(points, degree)
    if closed and (given[0] == given[-1]).all():
        given = given[:-1]
    least = 3 if closed else degree + 1
    if len(given) < least:
        raise Refusal(f"a curve of degree {degree} is fitted to {least} points or more; there are {len(given)}")
    whole = _parameters(given, spacing, closed)
    start = whole[: len(given)]
    breaks = np.interp(np.linspace(0, len(whole) - 1, (3 if closed else 1) + 1), np.arange(len(whole)), whole)
    for _ in range(ROUNDS):
        if len(breaks) - 1 + (0 if closed else degree) > len(given):
            break
        try:
            found = _corrected(given, start, breaks, degree, closed, tolerance)
        except np.linalg.LinAlgError:
            break
        if found.deviation <= tolerance:
            return found
        off = np.linalg.norm(evaluated(found.spline, found.parameters) - given, axis=1)
        more = _new_breaks(found.parameters, off > tolerance, breaks)
        if not len(more):
            break
        breaks = np.sort(np.concatenate([breaks, more]))
        start = found.parameters
        if closed:  # from the first point on they rise, if also beyond the seam
            start = start + np.cumsum(np.diff(start, prepend=start[0]) < 0.0) - (start[0] > 0.5)
    through = interpolated(given, degree, "closed" if closed else "free", whole)
    place = _places(whole, degree) if closed else whole
    return SplineFit(through, place, float(np.linalg.norm(evaluated(through, place) - given, axis=1).max()))


def _near(points: Floats, t: Floats, breaks: Floats, degree: int, closed: bool) -> BSpline:
    """The B-spline of least squares with simple knots at `breaks`, from 0 to 1."""
    if closed:
        count = len(breaks) - 1
        shape = closed_spline(np.zeros((count, points.shape[1])), degree, np.diff(breaks))
        span = spans(shape.knots, degree, t)
        rows = basis_rows(shape.knots, degree, span, t)
        return closed_spline(least_squares(rows, span - degree, points, count, cyclic=True), degree, np.diff(breaks))
    knots = np.concatenate([np.zeros(degree), breaks, np.ones(degree)])
    span = spans(knots, degree, t)
    rows = basis_rows(knots, degree, span, t)
    made = least_squares(rows, span - degree, points, len(knots) - degree - 1, points[[0, -1]])
    return BSpline(made, degree, knots)


def _corrected(points: Floats, t: Floats, breaks: Floats, degree: int, closed: bool, tolerance: float) -> SplineFit:
    """The best of some rounds of least squares, each with the parameters one Newton step nearer to the feet."""
    best: SplineFit | None = None
    for _ in range(CORRECTIONS + 1):
        around = t % 1.0 if closed else t
        spline = _near(points, around, breaks, degree, closed)
        place, along, bend = derivatives(spline, around, 2)
        gap = place - points
        worst = float(np.linalg.norm(gap, axis=1).max())
        if best is None or worst < best.deviation:
            best = SplineFit(spline, around, worst)
        if worst <= tolerance:
            break
        slope = (along * along).sum(1) + (gap * bend).sum(1)
        step = np.divide((gap * along).sum(1), slope, out=np.zeros(len(t)), where=slope > 0.0)
        moved = t - step
        if not closed:
            moved[[0, -1]] = t[[0, -1]]
        if not (np.diff(moved) > 0.0).all() or moved[-1] > moved[0] + 1.0:
            break
        t = moved
    assert best is not None
    return best


def _new_breaks(t: Floats, bad: np.ndarray, breaks: Floats) -> Floats:
    """A parameter in the middle of the points of each interval with a bad one, where both sides keep two of them."""
    interval = np.clip(np.searchsorted(breaks, t, side="right") - 1, 0, len(breaks) - 2)
    counts = np.bincount(interval, minlength=len(breaks) - 1)
    wanted = np.zeros(len(counts), bool)
    wanted[interval[bad]] = True
    which = np.flatnonzero(wanted & (counts >= 4))
    t = np.sort(t)
    middle = np.cumsum(counts)[which] - counts[which] + counts[which] // 2
    return 0.5 * (t[middle - 1] + t[middle])


def _closed_through(points: Floats, degree: int, t: Floats) -> BSpline:
    steps, where = np.diff(t), _places(t, degree)
    if degree % 2 == 0:  # knots in the middles
        steps = 0.5 * (np.roll(steps, 1) + steps)
    shape = closed_spline(points, degree, steps)
    span = spans(shape.knots, degree, where)
    rows = basis_rows(shape.knots, degree, span, where).T
    # The row of a point stands where its own control point is in the middle of the band.
    turn = degree // 2
    made = solved(np.roll(rows, turn, axis=0), np.roll(span - degree, turn), np.roll(points, turn, axis=0))
    return closed_spline(made, degree, steps)


def _places(t: Floats, degree: int) -> Floats:
    """(m,) where on the closed curve through points with t (m + 1,) these lie; its seam may be half way."""
    return t[:-1] if degree % 2 else t[:-1] + 0.5 * (t[-1] - t[-2])


def _end_rows(knots: Floats, degree: int, orders: list[int]) -> tuple[Floats, Floats]:
    """(k, degree + 1) each: how the first and the last control points make the end derivatives of some orders."""
    rows = []
    for side, some in ((0, knots[: 2 * degree + 2]), (-1, knots[-2 * degree - 2 :])):
        points, found = np.eye(degree + 1), [np.zeros(0)] * degree
        for k in range(1, degree):
            points, some = hodograph(points, some, degree + 1 - k)
            found[k] = points[side]
        rows.append(np.array([found[k] for k in orders]).reshape(len(orders), degree + 1))
    return rows[0], rows[1]


def _directions(points: Floats, tangents: ArrayLike | None, degree: int) -> Floats:
    if degree < 2:
        raise Refusal("end directions need degree 2 or more")
    given = np.asarray(tangents if tangents is not None else np.zeros(0), float)
    if given.shape != (2, points.shape[1]) or not np.isfinite(given).all():
        raise Refusal("clamped ends need two tangents, one for each end, with as many coordinates as the points")
    return given * np.linalg.norm(np.diff(points, axis=0), axis=1).sum()


def _parameters(points: Floats, spacing: str | ArrayLike, closed: bool) -> Floats:
    if isinstance(spacing, str):
        return spaced(points, spacing, closed)
    t = np.asarray(spacing, float)
    if t.shape != (len(points) + closed,) or t[0] != 0.0 or t[-1] != 1.0 or not (np.diff(t) > 0.0).all():
        raise Refusal(
            f"the parameters of {len(points)} points are {len(points) + closed} numbers that rise from 0 to 1"
        )
    return t


def _checked(points: ArrayLike, degree: int) -> Floats:
    if int(degree) != degree or not 1 <= degree <= HIGHEST:
        raise Refusal(f"the degree of a B-spline is a whole number from 1 to {HIGHEST}, not {degree!s:.40}")
    given = np.asarray(points, float)
    if given.ndim != 2 or len(given) < 2 or not np.isfinite(given).all():
        raise Refusal("a curve goes through two points or more, all of finite coordinates")
    return given
