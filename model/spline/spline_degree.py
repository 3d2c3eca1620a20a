"""The degree of B-splines: elevation without change, reduction with the deviation it makes."""

from __future__ import annotations

import numpy as np

from ..document.errors import Refusal
from .banded import least_squares
from .bspline import HIGHEST, BSpline, Floats, basis_rows, evaluated, of_lifted, spans
from .decomposition import farthest
from .knots import breaks, clamped, closed, on_domain, on_knots


def elevated(spline: BSpline, times: int = 1) -> BSpline:
    """The same curve of a higher degree, clamped; knots stand `times` more often, so that joints stay as they are.

    The control points are means of those on degree + 1 refinements, each without every (degree + 1)-th of the new knots
    (Prautzsch 1984): convex combinations throughout. Raises Refusal above the highest degree.
    """
    if times < 0 or spline.degree + times > HIGHEST:
        raise Refusal(
            f"a B-spline of degree {spline.degree} cannot be raised by {times}; {HIGHEST} is the highest degree"
        )
    made = clamped(spline)
    for _ in range(times):
        points, knots = _raised(made.lifted, made.degree, made.knots)
        made = of_lifted(points, made.degree + 1, knots, made.weights is not None)
    return made


def reduced(spline: BSpline, times: int = 1) -> tuple[BSpline, float]:
    """The best curve of a lower degree, clamped, with both ends kept, and the deviation in mm (see `farthest`).

    Best is the one with the least mean square distance between points of one parameter (homogeneous where there are
    weights). Every inner knot stands `times` less often, but once at least. A periodic curve stays so, instead of
    clamped. Raises Refusal below degree 1.
    """
    degree = spline.degree - times
    if times < 0 or degree < 1:
        raise Refusal(f"a B-spline of degree {spline.degree} cannot be reduced by {times}; 1 is the lowest degree")
    if spline.periodic:
        return _reduced_ring(spline, times)
    old = clamped(spline)
    values, counts = breaks(old)
    less = np.maximum(counts[1:-1] - times, 1)
    knots = np.concatenate(
        [np.full(degree + 1, values[0]), np.repeat(values[1:-1], less), np.full(degree + 1, values[-1])]
    )
    t, root = _sampled(values, old.degree)
    span = spans(knots, degree, t)
    lifted = old.lifted
    wanted = evaluated(BSpline(lifted, old.degree, old.knots), t)
    rows = basis_rows(knots, degree, span, t)
    points = least_squares(rows * root, span - degree, wanted * root[:, None], len(knots) - degree - 1, lifted[[0, -1]])
    made = of_lifted(points, degree, knots, spline.weights is not None)
    return made, farthest(old, made)


def _sampled(values: Floats, degree: int) -> tuple[Floats, Floats]:
    """Parameters (m,) between the breaks, and the roots of their shares in an integral over squares of that degree."""
    nodes, shares = np.polynomial.legendre.leggauss(degree + 1)  # exact for the square of the difference
    steps = np.diff(values)
    t = (values[:-1, None] + steps[:, None] * (0.5 + 0.5 * nodes)).ravel()
    return t, np.sqrt(steps[:, None] * shares).ravel()


def _reduced_ring(spline: BSpline, times: int) -> tuple[BSpline, float]:
    degree, (start, end) = spline.degree - times, spline.domain
    old = on_domain(spline, 0.0, 1.0)
    values, counts = breaks(old)
    base = np.repeat(values[:-1], np.append(1, np.maximum(counts[1:-1] - times, 1)))
    steps = np.diff(base, append=values[-1])
    shape = closed(np.zeros((len(base), 2)), degree, steps)
    t, root = _sampled(values, old.degree)
    span = spans(shape.knots, degree, t)
    rows = basis_rows(shape.knots, degree, span, t)
    wanted = evaluated(BSpline(old.lifted, old.degree, old.knots), t)
    lifted = least_squares(rows * root, span - degree, wanted * root[:, None], len(base), cyclic=True)
    again = lifted[np.arange(len(base) + degree) % len(base)]
    made = of_lifted(again, degree, shape.knots, spline.weights is not None)
    return on_domain(made, start, end), farthest(old, made)


def _raised(points: Floats, degree: int, knots: Floats) -> tuple[Floats, Floats]:
    """Control points and knots of a clamped curve of one degree more."""
    values, counts = np.unique(knots, return_counts=True)
    higher = np.repeat(values, counts + 1)
    padded = np.concatenate([higher[:1], higher, higher[-1:]])
    count = len(higher) - degree - 2
    made = np.zeros((count, points.shape[1]))
    for rest in range(degree + 1):
        left_out = np.arange(len(padded)) % (degree + 1) == rest
        finer = on_knots(points, degree, knots, padded[~left_out], degree)
        made += finer[np.arange(1, count + 1) - np.cumsum(left_out)[1 : count + 1]]
    made /= degree + 1
    made[0], made[-1] = points[0], points[-1]
    return made, higher
