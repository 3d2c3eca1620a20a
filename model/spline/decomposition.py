"""B-splines as Bezier pieces and back, and what is measured on these: bounds, length, nearest points, deviation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..curve import bezier, lengths
from ..curve.bernstein import basis as bernstein_basis
from ..curve.bernstein import derivative, product, roots
from ..curve.degree import elevated
from ..curve.nearest import nearest as nearest_on_bezier
from ..document.errors import Refusal
from .bspline import BSpline, Floats, basis_rows, combined, of_lifted, spans
from .knots import breaks, closed, on_knots, refined, snapped

TOLERANCE = 1e-12
"""How far pieces may be from a joint of a higher continuity, as a part of the curve's size."""

ROUNDING = 1e-14


@dataclass(frozen=True, slots=True, eq=False)
class Decomposition:
    """Bezier pieces, each of which begins where the one before ends."""

    controls: Floats  # (k, degree + 1, d)
    weights: Floats | None  # (k, degree + 1)
    breaks: Floats  # (k + 1,) the parameters of the B-spline where they begin and end

    @property
    def lifted(self) -> Floats:
        """(k, degree + 1, d), or (k, degree + 1, d + 1) homogeneous where there are weights."""
        return self.controls if self.weights is None else bezier.homogeneous(self.controls, self.weights)


def decomposed(spline: BSpline) -> Decomposition:
    """The Bezier pieces of a B-spline, one an interval: each inner knot is put in to `degree` (Boehm 1981)."""
    values, _ = breaks(spline)
    lifted = _pieces(spline.lifted, spline.degree, spline.knots, values)
    if spline.weights is None:
        return Decomposition(lifted, None, values)
    return Decomposition(*bezier.projected(lifted), values)


def composed(
    controls: ArrayLike,
    weights: ArrayLike | None = None,
    parameters: ArrayLike | None = None,
    tolerance: float = TOLERANCE,
) -> BSpline:
    """One clamped B-spline of Bezier pieces (k, degree + 1, d), each beginning where the one before ends.

    Every inner knot is as seldom as the pieces allow: `degree` times at a corner, once or never where all derivatives
    agree. `parameters` (k + 1,) are where the pieces meet; else their intervals are such that a joint with one tangent
    has one derivative, too. `tolerance` is a part of the curve's size. Raises Refusal for pieces with gaps.
    """
    controls = np.asarray(controls, float)
    count, p = len(controls), controls.shape[1] - 1
    size = float(np.ptp(controls.reshape(-1, controls.shape[-1]), axis=0).max())
    gaps = np.linalg.norm(controls[1:, 0] - controls[:-1, -1], axis=-1)
    if (gaps > max(tolerance, TOLERANCE) * size).any():
        number = int(np.argmax(gaps))
        raise Refusal(f"piece {number + 1} does not begin where piece {number} ends: {gaps[number]:g} mm are between")
    lifted = controls
    if weights is not None:
        lifted = bezier.homogeneous(controls, _hanging(weights))
    if parameters is None:
        parameters = np.concatenate([[0.0], np.cumsum(_steps(lifted))])
        parameters /= parameters[-1]
    where = np.asarray(parameters, float)
    if where.shape != (count + 1,) or not (np.diff(where) > 0.0).all():
        raise Refusal(f"{count} pieces need {count + 1} parameters that rise, with each piece some way of its own")
    scale = float(np.abs(lifted - lifted.reshape(-1, lifted.shape[-1]).mean(0)).max())
    order = _orders(lifted, np.diff(where), tolerance * scale)
    full = np.concatenate([where[:1], np.repeat(where, p), where[-1:]])
    chain = np.concatenate([lifted[0, :1], lifted[:, 1:].reshape(-1, lifted.shape[-1])])
    # Extrapolation from piece to piece may add up where the degree is high or the intervals differ much: joints of
    # pieces that it moves are given less, until none is.
    while (order > 0).any():
        knots = np.concatenate([np.full(p + 1, where[0]), np.repeat(where[1:-1], p - order), np.full(p + 1, where[-1])])
        made = _polar(chain, p, full, knots)
        off = np.abs(_pieces(made, p, knots, where) - lifted).max((1, 2)) > max(tolerance, TOLERANCE) * scale
        if not off.any():
            break
        order = np.maximum(order - (off[:-1] | off[1:]), 0)
    else:
        made, knots = chain, full
    return of_lifted(made, p, knots, weights is not None)


def ring(
    controls: ArrayLike,
    weights: ArrayLike | None = None,
    parameters: ArrayLike | None = None,
    tolerance: float = TOLERANCE,
) -> BSpline:
    """One closed B-spline, on 0 to 1, of Bezier pieces (k, degree + 1, d) that hang together, the last with the first.

    Like `composed`. The seam is at the first joint that asks for one knot; where all ask for more, at a knot put in
    half way along the first piece. The last piece of a rational curve is run through at another speed where its
    weights ask for that.
    """
    controls = np.asarray(controls, float)
    count, p = len(controls), controls.shape[1] - 1
    size = float(np.ptp(controls.reshape(-1, controls.shape[-1]), axis=0).max())
    gap = float(np.linalg.norm(controls[0, 0] - controls[-1, -1]))
    if gap > max(tolerance, TOLERANCE) * size:
        raise Refusal(f"the pieces are not closed: {gap:g} mm are between their ends")
    lifted = controls
    if weights is not None:
        ratios = _hanging(weights)
        ratios[-1] *= (ratios[-1, -1] / ratios[0, 0]) ** (-np.arange(p + 1) / p)
        lifted = bezier.homogeneous(controls, ratios)
    steps = _steps(lifted) if parameters is None else np.diff(np.asarray(parameters, float))
    if steps.shape != (count,) or not (steps > 0.0).all():
        raise Refusal(f"{count} pieces need {count + 1} parameters that rise, with each piece some way of its own")
    steps = steps / steps.sum()
    scale = float(np.abs(lifted - lifted.reshape(-1, lifted.shape[-1]).mean(0)).max())
    order = _orders(np.concatenate([lifted, lifted[:1]]), np.append(steps, steps[0]), tolerance * scale)
    # So many turns that no control point of the middle one reaches an end.
    aside = p // count + 2
    turns = np.arange(-aside, aside + 1)
    where = np.append((np.cumsum(steps) - steps + turns[:, None]).ravel(), aside + 1.0)
    pieces = np.tile(lifted, (len(turns), 1, 1))
    chain = np.concatenate([pieces[0, :1], pieces[:, 1:].reshape(-1, lifted.shape[-1])])
    full = np.concatenate([where[:1], np.repeat(where, p), where[-1:]])
    while True:
        inner = np.repeat(where[1:-1], p - np.tile(order, len(turns))[:-1])
        knots = np.concatenate([np.full(p + 1, where[0]), inner, np.full(p + 1, where[-1])])
        made = _polar(chain, p, full, knots)
        off = np.abs(_pieces(made, p, knots, where) - pieces).max((1, 2))[aside * count : (aside + 1) * count]
        wrong = off > max(tolerance, TOLERANCE) * scale
        if not wrong.any() or not order.any():
            break
        order = np.maximum(order - (wrong | np.roll(wrong, -1)), 0)
    tiled = of_lifted(made, p, knots, weights is not None)
    simple = np.flatnonzero(order == p - 1)
    if len(simple):
        seams = where[(int(simple[0]) + 1) % count :: count]
    else:
        seams = turns + 0.5 * steps[0]
        tiled = refined(tiled, seams)
    first, last = np.searchsorted(tiled.knots, seams[[aside, aside + 1]]).tolist()
    points, weights = tiled.points[first - p : last - p], tiled.weights
    return closed(
        points, p, np.diff(tiled.knots[first : last + 1]), None if weights is None else weights[first - p : last - p]
    )


def _hanging(weights: ArrayLike) -> Floats:
    """(k, degree + 1) weights of pieces, each piece's by a factor, so that there is one weight at each joint."""
    ratios = np.array(weights, float)
    ratios[1:] *= np.cumprod(ratios[:-1, -1] / ratios[1:, 0])[:, None]
    return ratios


def _steps(lifted: Floats) -> Floats:
    """(k,) intervals of pieces, by which a joint with one tangent has one derivative, too."""
    before = np.linalg.norm(lifted[:-1, -1] - lifted[:-1, -2], axis=-1)
    after = np.linalg.norm(lifted[1:, 1] - lifted[1:, 0], axis=-1)
    ratio = np.divide(after, before, out=np.ones(len(lifted) - 1), where=(before > 0.0) & (after > 0.0))
    return np.concatenate([[1.0], np.cumprod(ratio)])


def bounds(spline: BSpline) -> Floats:
    """(2, d) the lowest and highest coordinates that the curve itself reaches."""
    pieces = decomposed(spline)
    found = bezier.bounds(pieces.controls, pieces.weights)
    return np.array([found[:, 0].min(0), found[:, 1].max(0)])


def length(spline: BSpline) -> float:
    """Arc length in mm, to rounding."""
    pieces = decomposed(spline)
    return float(lengths.length(pieces.controls, weights=pieces.weights).sum())


def parameters_at(spline: BSpline, distances: ArrayLike) -> Floats:
    """(...) the parameters at which the curve has the arc lengths (...) from its start; beyond it its ends."""
    pieces = decomposed(spline)
    before = np.concatenate([[0.0], np.cumsum(lengths.length(pieces.controls, weights=pieces.weights))])
    wanted = np.asarray(distances, float)
    flat = wanted.ravel()
    which = np.clip(np.searchsorted(before, flat, side="right") - 1, 0, len(pieces.controls) - 1)
    local = np.empty(len(flat))
    for piece in np.unique(which).tolist():
        here = which == piece
        weights = None if pieces.weights is None else pieces.weights[piece]
        local[here] = lengths.parameters_at(pieces.controls[piece], flat[here] - before[piece], weights)
    start, end = pieces.breaks[which], pieces.breaks[which + 1]
    return ((1.0 - local) * start + local * end).reshape(wanted.shape)[()]


def nearest(spline: BSpline, points: ArrayLike) -> tuple[Floats, Floats]:
    """The parameter (...) and the distance (...) of the point of the curve that is nearest to points (..., d).

    Of several that are as near the first. A piece is looked at where the box of its control points is near enough.
    """
    points = np.asarray(points, float)
    flat = points.reshape(-1, points.shape[-1])
    pieces = decomposed(spline)
    low, high = pieces.controls.min(1), pieces.controls.max(1)
    found, least = np.full(len(flat), pieces.breaks[0]), np.linalg.norm(flat - pieces.controls[0, 0], axis=-1)
    for i, end in enumerate(pieces.controls[:, -1]):
        away = np.linalg.norm(flat - end, axis=-1)
        found, least = np.where(away < least, pieces.breaks[i + 1], found), np.minimum(away, least)
    for i, controls in enumerate(pieces.controls):
        off = np.linalg.norm(np.maximum(np.maximum(low[i] - flat, flat - high[i]), 0.0), axis=-1)
        rows = np.flatnonzero(off <= least)
        if not len(rows):
            continue
        t, away = nearest_on_bezier(controls, flat[rows], None if pieces.weights is None else pieces.weights[i])
        t = (1.0 - t) * pieces.breaks[i] + t * pieces.breaks[i + 1]
        better = (away < least[rows]) | ((away == least[rows]) & (t < found[rows]))
        found[rows[better]], least[rows[better]] = t[better], away[better]
    return found.reshape(points.shape[:-1])[()], least.reshape(points.shape[:-1])[()]


def farthest(first: BSpline, second: BSpline) -> float:
    """The greatest distance in mm between points of one parameter on two B-splines of one domain; a bound for theirs.

    Found where its derivative is 0 on the Bezier pieces of both, of any degrees.
    """
    values = np.unique(np.concatenate([breaks(first)[0], snapped(first, breaks(second)[0])]))
    degree = max(first.degree, second.degree)
    rational = first.weights is not None or second.weights is not None
    above = []
    for spline in (first, second):
        lifted = spline.lifted
        if rational and spline.weights is None:
            lifted = np.column_stack([lifted, np.ones(len(lifted))])
        pieces = _pieces(lifted, spline.degree, spline.knots, values)
        above.append(elevated(pieces, degree - spline.degree))
    if not rational:
        apart, bottom = np.moveaxis(above[0] - above[1], -1, 1), None
    else:
        one, other = (np.moveaxis(part, -1, 1) for part in above)
        apart = product(one[:, :-1], other[:, -1:]) - product(other[:, :-1], one[:, -1:])
        bottom = product(one[:, -1], other[:, -1])
    # For what is rounding alone, the control points of the difference tell enough.
    size = float(np.abs(apart).max())
    if size <= ROUNDING * max(float(np.abs(part).max()) for part in above):
        bound = np.linalg.norm(apart, axis=1)
        return float((bound if bottom is None else bound / bottom.min()).max())
    apart = apart / size
    square = product(apart, apart).sum(1)
    slope = derivative(square)
    if bottom is not None:
        slope = product(slope, bottom) - 2.0 * product(square, derivative(bottom))
    at, t = roots(slope)
    every = np.arange(len(apart))
    at, t = np.concatenate([at, every, every]), np.concatenate([t, np.zeros(len(every)), np.ones(len(every))])
    away = np.linalg.norm((bernstein_basis(apart.shape[-1] - 1, t)[:, None] * apart[at]).sum(-1), axis=-1)
    if bottom is not None:
        away /= (bernstein_basis(bottom.shape[-1] - 1, t) * bottom[at]).sum(-1)
    return size * float(away.max())


def _pieces(lifted: Floats, degree: int, knots: Floats, values: Floats) -> Floats:
    """(k, degree + 1, d) Bezier control points between the parameters `values` (k + 1,), all knots among them."""
    finer = np.concatenate([values[:1], np.repeat(values, degree), values[-1:]])
    made = on_knots(lifted, degree, knots, finer, degree)
    return made[np.arange(len(values) - 1)[:, None] * degree + np.arange(degree + 1)]


def _orders(lifted: Floats, steps: Floats, tolerance: float) -> np.ndarray:
    """(k - 1,) how many derivatives agree at the joints: the control points of a piece follow from those before it."""
    before, after = lifted[:-1, ::-1], lifted[1:]  # both from the joint outwards
    wide = (steps[:-1] >= steps[1:])[:, None, None]
    far, near = np.where(wide, before, after), np.where(wide, after, before)
    ratio = np.minimum(steps[:-1], steps[1:]) / np.maximum(steps[:-1], steps[1:])
    off = np.linalg.norm(bezier.extracted(far, 0.0, -ratio) - near, axis=-1)
    return (np.cumprod(off <= tolerance, axis=-1).sum(-1) - 1).clip(0)


def _polar(points: Floats, degree: int, full: Floats, knots: Floats) -> Floats:
    """Control points on `knots`, coarser ones than `full`, by the polar form of the widest interval of each."""
    windows = np.lib.stride_tricks.sliding_window_view(knots, degree + 2)
    widest = np.diff(windows, axis=-1).argmax(-1)[:, None]
    centre = 0.5 * (np.take_along_axis(windows, widest, -1) + np.take_along_axis(windows, widest + 1, -1))[:, 0]
    arguments = windows[:, 1:-1].T
    nearest_first = np.argsort(np.abs(arguments - centre), axis=0, kind="stable")
    span = spans(full, degree, centre)
    rows = basis_rows(full, degree, span, np.take_along_axis(arguments, nearest_first, axis=0))
    return combined(rows, span - degree, points)
