"""B-splines, also rational ones (NURBS): the value, its basis functions, points and derivatives.

Parameters are those of the knots: the curve runs from knot `degree` to knot n (both counted from 0), its domain.
What is linear in the control points is done in homogeneous coordinates where there are weights.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import comb

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..curve.bezier import homogeneous, projected
from ..document.errors import Refusal

Floats = NDArray[np.float64]
Numbers = NDArray[np.intp]

HIGHEST = 25
"""The highest degree; of higher ones the rounding is larger than what they are good for."""
BLOCK = 8192
"""Parameters that are evaluated together: their basis stays in the cache of the processor."""


@dataclass(frozen=True, slots=True, eq=False)
class BSpline:
    """A curve of control points `points` (n, d), a degree, `knots` (n + degree + 1,), and weights (n,) above 0 or None.

    Arrays are copied and read-only. Raises Refusal where they make no curve: too few points, knots that fall, that are
    too many or too few, that break the curve inside, and weights that are not above 0.
    """

    points: Floats
    degree: int
    knots: Floats
    weights: Floats | None = None

    def __post_init__(self) -> None:
        points = _finite(self.points, 2, "the control points of a B-spline are rows of finite coordinates")
        knots = _finite(self.knots, 1, "the knots of a B-spline are finite numbers")
        if int(self.degree) != self.degree or not 1 <= self.degree <= HIGHEST:
            raise Refusal(f"the degree of a B-spline is a whole number from 1 to {HIGHEST}, not {self.degree!s:.40}")
        object.__setattr__(self, "degree", int(self.degree))
        _check(len(points), self.degree, knots)
        weights = self.weights
        if weights is not None:
            weights = _finite(weights, 1, "the weights of a B-spline are finite numbers")
            if len(weights) != len(points):
                raise Refusal(f"{len(points)} control points need as many weights; there are {len(weights)}")
            if (weights <= 0.0).any():
                number = int(np.argmax(weights <= 0.0))
                raise Refusal(
                    f"the weights of a B-spline are above 0, but that of control point {number} is {weights[number]:g}"
                )
        for name, array in (("points", points), ("knots", knots), ("weights", weights)):
            if array is not None:
                array.setflags(write=False)
            object.__setattr__(self, name, array)

    def __repr__(self) -> str:
        kind = "" if self.weights is None else ", rational"
        return f"BSpline(degree {self.degree}, {len(self.points)} points{kind})"

    @property
    def domain(self) -> tuple[float, float]:
        """The parameters between which the curve runs."""
        return float(self.knots[self.degree]), float(self.knots[len(self.points)])

    @property
    def dimension(self) -> int:
        return self.points.shape[1]

    @property
    def lifted(self) -> Floats:
        """The control points (n, d), or (n, d + 1) in homogeneous coordinates where there are weights."""
        return self.points if self.weights is None else homogeneous(self.points, self.weights)

    @property
    def clamped(self) -> bool:
        """Whether the curve begins and ends at its outermost control points, with `degree` equal knots there."""
        start, end = self.domain
        return bool(self.knots[1] == start and self.knots[-2] == end)

    @property
    def periodic(self) -> bool:
        """Whether its end goes on as its beginning: the last `degree` points and knot intervals are the first."""
        turn = len(self.points) - self.degree
        steps, lifted = np.diff(self.knots), self.lifted
        off = np.abs(steps[turn:] - steps[:-turn]).max()
        return bool(off <= 1e-12 * (self.knots[-1] - self.knots[0]) and (lifted[turn:] == lifted[:-turn]).all())

    @property
    def abscissae(self) -> Floats:
        """(n,) the parameters that belong to the control points: means of `degree` knots (Greville 1967)."""
        windows = np.lib.stride_tricks.sliding_window_view(self.knots[1:-1], self.degree)
        return windows.mean(-1)

    def reversed(self) -> BSpline:
        """The same curve run through the other way, on the same domain."""
        start, end = self.domain
        knots = (start + end) - self.knots[::-1]
        knots[self.knots[::-1] == start], knots[self.knots[::-1] == end] = end, start
        return BSpline(self.points[::-1], self.degree, knots, None if self.weights is None else self.weights[::-1])


def of_lifted(lifted: Floats, degree: int, knots: ArrayLike, rational: bool) -> BSpline:
    """A B-spline of control points as `BSpline.lifted` has them. Raises Refusal where a weight is not above 0."""
    if not rational:
        return BSpline(lifted, degree, np.asarray(knots, float))
    if not (lifted[:, -1] > 0.0).all():
        raise Refusal("this would need a weight that is not above 0; the weights of the curve differ too much")
    points, weights = projected(lifted)
    return BSpline(points, degree, np.asarray(knots, float), weights)


def spans(knots: Floats, degree: int, t: ArrayLike) -> Numbers:
    """(...) i with knots[i] <= t < knots[i + 1] for parameters t; the first or the last interval beyond the domain."""
    found = np.searchsorted(knots, np.asarray(t, float), side="right") - 1
    return np.clip(found, degree, len(knots) - degree - 2)


def basis_rows(knots: Floats, degree: int, span: Numbers, arguments: Floats) -> Floats:
    """(degree + 1, ...) what the points span - degree to span weigh in the value at t (...): Cox 1972, de Boor 1972.

    With `degree` arguments (degree, ...) instead of one: in the value of the polar form (blossom) of that interval.
    For control points on finer knots those are the discrete B-splines of the Oslo algorithm (Cohen, Lyche and
    Riesenfeld 1980); where a point stays, its weight is exactly 1.
    """
    rows = np.empty((degree + 1, *span.shape))
    rows[0] = 1.0
    several = arguments.ndim > span.ndim
    around = [knots[np.maximum(span + k, 0)] for k in range(1 - degree, degree + 1)]
    for level in range(1, degree + 1):
        t = arguments[level - 1] if several else arguments
        carried: Floats | float = 0.0
        for i in range(level):
            low, high = around[degree - level + i], around[degree + i]
            moved = rows[i] * ((t - low) / (high - low))
            rows[i] += carried - moved
            carried = moved
        rows[level] = carried
    return rows


def combined(rows: Floats, first: Numbers, points: Floats) -> Floats:
    """(m, d) sums of rows (k, m) times points (n, d) first to first + k - 1; a row before the first point counts 0."""
    made = np.zeros((len(first), points.shape[1]))
    for i, row in enumerate(rows):
        made += np.where(first + i < 0, 0.0, row)[:, None] * points[np.maximum(first + i, 0)]
    return made


def evaluated(spline: BSpline, t: ArrayLike) -> Floats:
    """Points (..., d) at parameters t (...); beyond the domain the polynomial of the outermost interval goes on."""
    return derivatives(spline, t, 0)[0]


def derivatives(spline: BSpline, t: ArrayLike, order: int) -> Floats:
    """(order + 1, ..., d) points and derivatives by the parameter up to that order at t (...).

    At a knot where a derivative jumps it is that of the interval after, at the end of the domain of the one before.
    Differences of control points (de Boor 1972); of rational curves by Leibniz' rule (Piegl and Tiller 1995, A4.2).
    """
    t = np.asarray(t, float)
    flat = t.ravel()
    lifted = spline.lifted
    made = np.zeros((order + 1, len(flat), lifted.shape[1]))
    levels = [(lifted, spline.knots)]
    for k in range(1, min(order, spline.degree) + 1):
        levels.append(hodograph(*levels[-1], spline.degree + 1 - k))
    for start in range(0, len(flat), BLOCK):
        block = slice(start, start + BLOCK)
        span = spans(spline.knots, spline.degree, flat[block])
        for k, (points, knots) in enumerate(levels):
            rows = basis_rows(knots, spline.degree - k, span - k, flat[block])
            made[k, block] = combined(rows, span - spline.degree, points)
    if spline.weights is not None:
        made = _quotients(made)
    return made.reshape(order + 1, *t.shape, spline.dimension)


def hodograph(points: Floats, knots: Floats, degree: int) -> tuple[Floats, Floats]:
    """Control points (n - 1, d) and knots of the derivative, of one degree less."""
    count = len(points)
    steps = knots[degree + 1 : degree + count] - knots[1:count]
    # No step where the curve has a corner: such a point belongs to no interval.
    shares = np.divide(degree, steps, out=np.zeros_like(steps), where=steps > 0.0)
    return np.diff(points, axis=0) * shares[:, None], knots[1:-1]


def basis(spline: BSpline, t: ArrayLike) -> Floats:
    """(..., n) the weights that all control points have in the points at t (...): not below 0, their sum is 1."""
    t = np.asarray(t, float)
    flat = t.ravel()
    span = spans(spline.knots, spline.degree, flat)
    values = np.zeros((len(flat), len(spline.points)))
    columns = span - spline.degree + np.arange(spline.degree + 1)[:, None]
    values[np.arange(len(flat)), columns] = basis_rows(spline.knots, spline.degree, span, flat)
    if spline.weights is not None:
        values *= spline.weights
        values /= values.sum(-1, keepdims=True)
    return values.reshape(*t.shape, len(spline.points))


def levels(spline: BSpline, t: ArrayLike) -> list[Floats]:
    """All points of de Boor's construction (1972) at t (...): level k has (..., degree + 1 - k, d), the last the point.

    Level 0 are the control points of the interval. Of a rational curve all are projected.
    """
    t = np.asarray(t, float)
    p = spline.degree
    span = spans(spline.knots, p, t)
    row = spline.lifted[span[..., None] - p + np.arange(p + 1)]
    made = [row]
    for level in range(1, p + 1):
        at = span[..., None] - p + level + np.arange(p + 1 - level)
        low, high = spline.knots[at], spline.knots[at + p + 1 - level]
        share = ((t[..., None] - low) / (high - low))[..., None]
        row = (1.0 - share) * row[..., :-1, :] + share * row[..., 1:, :]
        made.append(row)
    return made if spline.weights is None else [projected(row)[0] for row in made]


def ends(spline: BSpline) -> Floats:
    """(2, d) where the curve begins and where it ends; exactly its control points where these are."""
    found = evaluated(spline, np.array(spline.domain))
    if spline.knots[1] == spline.domain[0]:
        found[0] = spline.points[0]
    if spline.knots[-2] == spline.domain[1]:
        found[1] = spline.points[-1]
    return found


def _quotients(above: Floats) -> Floats:
    """(k, m, d) derivatives of the rational curve below homogeneous ones (k, m, d + 1)."""
    points, weight = above[..., :-1].copy(), above[..., -1:]
    for k in range(len(points)):
        for i in range(1, k + 1):
            points[k] -= comb(k, i) * weight[i] * points[k - i]
        points[k] /= weight[0]
    return points


def _finite(given: ArrayLike, axes: int, words: str) -> Floats:
    try:
        array = np.array(given, float)
    except (TypeError, ValueError):
        raise Refusal(words) from None
    if array.ndim != axes or not array.size or not np.isfinite(array).all():
        raise Refusal(words)
    return array


def _check(count: int, degree: int, knots: Floats) -> None:
    if count <= degree:
        raise Refusal(f"a B-spline of degree {degree} needs {degree + 1} control points or more; there are {count}")
    if len(knots) != count + degree + 1:
        raise Refusal(
            f"a B-spline of degree {degree} with {count} control points needs {count + degree + 1} knots; "
            f"there are {len(knots)}"
        )
    falls = np.flatnonzero(np.diff(knots) < 0.0)
    if len(falls):
        i = int(falls[0])
        raise Refusal(
            f"the knots of a B-spline must not fall, but knot {i} is {knots[i]:g} and knot {i + 1} {knots[i + 1]:g}"
        )
    if knots[degree] == knots[degree + 1] or knots[count - 1] == knots[count]:
        end, value = ("start", knots[degree]) if knots[degree] == knots[degree + 1] else ("end", knots[count])
        raise Refusal(
            f"too many knots of a B-spline of degree {degree} are {value:g} at its {end}: there may be {degree + 1}, "
            "and with each beyond these a control point has to go"
        )
    inner = knots[degree + 1 : count]
    broken = np.flatnonzero(inner[degree:] == inner[:-degree])
    if len(broken):
        raise Refusal(
            f"{degree + 1} knots of a B-spline of degree {degree} are {inner[broken[0]]:g}, where it would break in "
            f"two: leave {degree} of them at most, or make it two curves"
        )
