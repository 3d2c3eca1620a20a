"""Cubics through dense points within a tolerance (Schneider 1990), with corners found first; freehand strokes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..curve.bernstein import basis
from ..curve.bezier import derivatives
from ..document.errors import Refusal
from .path import Contour, Floats, Node, Numbers, Path

ROUNDS = 10
"""Rounds of Newton's method on the parameters before a span is cut in two."""
NEAR = 0.05
"""Of the length of a span, how far off its first cubic may be for that."""
WINDOW = 4
"""Points to either side from which the tangent at a point is reckoned."""
SHARP = 50.0
"""Degrees by which a polyline turns at a corner."""


@dataclass(frozen=True, slots=True, eq=False)
class Fit:
    """Cubics that follow points."""

    controls: Floats  # (k, 4, d), each beginning where the one before ends
    breaks: Numbers  # (k + 1,) of the points, where the cubics meet
    corners: Numbers  # (c,) of the points that are corners, without the ends of an open curve
    deviation: float  # mm, the largest distance of a point from its place on the cubics


def fit(
    points: ArrayLike, tolerance: float, corners: ArrayLike | None = None, closed: bool = False, sharp: float = SHARP
) -> Fit:
    """The cubics through (n, d) points, in order, none of which they leave by more than `tolerance` mm.

    They meet with one tangent but at corners: the numbers in `corners`, else where the polyline turns by more than
    `sharp` degrees over a few tolerances of its length. Between corners a cubic of least squares is fitted, its
    parameters bettered by Newton's method; where it stays too far, it is cut where it is furthest off (Schneider 1990,
    "An Algorithm for Automatically Fitting Digitized Curves"). Raises Refusal for points that are not finite or too
    few, and for a tolerance that is not above 0.
    """
    given = _checked(points, tolerance)
    keep = np.append(True, (np.diff(given, axis=0) != 0.0).any(axis=1))
    number = np.flatnonzero(keep)
    dense = given[number]
    if closed and len(dense) > 1 and (dense[0] == dense[-1]).all():
        number, dense = number[:-1], dense[:-1]
    if len(dense) < 2 + closed:
        raise Refusal(f"a curve needs {2 + closed} points that differ")
    if corners is None:
        sharp_at = find_corners(dense, tolerance, closed, sharp)
    else:
        sharp_at = np.unique(np.searchsorted(number, np.asarray(corners, np.intp).ravel(), "right") - 1)
    count = len(dense)
    turn = 0
    if closed:
        turn = int(sharp_at[0]) if len(sharp_at) else 0
        dense = np.roll(dense, -turn, axis=0)
        dense = np.vstack((dense, dense[:1]))
        sharp_at = np.unique((sharp_at - turn) % count)
    inner = sharp_at[(sharp_at > 0) & (sharp_at < len(dense) - 1)]
    smooth_seam = closed and not len(sharp_at)
    fitted, breaks, worst = _spans(dense, tolerance, inner, smooth_seam)
    original = number[(breaks + turn) % count] if closed else number[breaks]
    return Fit(fitted, original, np.sort(number[(sharp_at + turn) % count] if closed else number[inner]), worst)


def stroke(points: ArrayLike, tolerance: float, closed: bool = False, sharp: float = SHARP) -> Path:
    """A freehand stroke (n, d) as a path of cubics, smooth but at its corners; see `fit`."""
    found = fit(points, tolerance, closed=closed, sharp=sharp)
    breaks = found.breaks[:-1] if closed else found.breaks
    nodes = np.where(np.isin(breaks, found.corners), Node.CUSP, Node.SMOOTH)
    if not closed:
        nodes[[0, -1]] = Node.CUSP
    return Path((Contour.of_segments(list(found.controls), closed, nodes),))


def find_corners(points: Floats, tolerance: float, closed: bool = False, sharp: float = SHARP) -> Numbers:
    """Numbers of the points (n, d) where the polyline turns by more than `sharp` degrees.

    The turn is measured between chords that reach four tolerances back and ahead, or to the next point where that is
    further, so that noise below the tolerance makes no corner; of neighbours within that reach the sharpest counts.
    """
    reach = 4.0 * tolerance
    steps = np.linalg.norm(np.diff(points, axis=0, append=points[:1]), axis=1)
    total = float(steps.sum())
    where = np.concatenate(([0.0], np.cumsum(steps[:-1])))
    rows = np.tile(np.arange(len(points)), 3 if closed else 1)
    tripled = np.concatenate((where - total, where, where + total)) if closed else where
    ahead = np.minimum(np.searchsorted(tripled, where + reach, "left"), len(tripled) - 1)
    back = np.maximum(np.searchsorted(tripled, where - reach, "right") - 1, 0)
    before, after = points - points[rows[back]], points[rows[ahead]] - points
    sizes = np.linalg.norm(before, axis=1) * np.linalg.norm(after, axis=1)
    cosine = np.einsum("ij,ij->i", before, after) / np.where(sizes > 0.0, sizes, 1.0)
    turning = np.where(sizes > 0.0, np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))), 0.0)
    found: list[int] = []
    taken = np.zeros(len(points), bool)
    for row in np.argsort(
        -turning, kind="stable"
    ).tolist():  # few reach `sharp`: the loop ends at the first that does not
        if turning[row] <= sharp:
            break
        if not taken[row]:
            found.append(row)
            apart = np.abs(where - where[row])
            taken |= (np.minimum(apart, total - apart) if closed else apart) <= reach
    return np.sort(np.array(found, np.intp))


def least_squares(
    points: Floats, parameters: Floats, first: Floats, last: Floats, along: Floats | None = None
) -> Floats:
    """(m, 4, d) cubics from the first to the last of points (m, s, d), nearest to them at parameters (m, s).

    `first` and `last` (m, d) are unit tangents that point into the curve from its ends. With `along` (m, s, d), unit
    tangents at the points, only what lies across these counts: the tangent distance of Wang, Pottmann and Liu (2006),
    which converges quadratically where parameters and cubic are bettered in turn. Where the result are handles that
    turn back, they are a third of the chord (Wu and Barsky's heuristic, in Schneider 1990).
    """
    b = basis(3, parameters)[..., None]
    begin, end = points[:, 0], points[:, -1]
    rest = points - (b[:, :, 0] + b[:, :, 1]) * begin[:, None] - (b[:, :, 2] + b[:, :, 3]) * end[:, None]
    one, two = b[:, :, 1] * first[:, None], b[:, :, 2] * last[:, None]
    if along is not None:
        rest, one, two = (column - (column * along).sum(-1, keepdims=True) * along for column in (rest, one, two))
    c11, c12, c22, x1, x2 = (
        np.einsum("msd,msd->m", *pair) for pair in ((one, one), (one, two), (two, two), (one, rest), (two, rest))
    )
    determinant = c11 * c22 - c12 * c12
    safe = np.where(determinant > 1e-12 * c11 * c22, determinant, np.inf)
    handles = np.stack((x1 * c22 - x2 * c12, x2 * c11 - x1 * c12)) / safe
    chord = np.linalg.norm(end - begin, axis=1)
    back = (handles <= 1e-6 * chord).any(axis=0)
    handles = np.where(back, chord / 3.0, handles)
    return np.stack((begin, begin + handles[0][:, None] * first, end + handles[1][:, None] * last, end), axis=1)


def nearer(points: Floats, parameters: Floats, controls: Floats) -> tuple[Floats, Floats]:
    """One step of Newton's method towards the feet of points (m, s, d) on cubics (m, 4, d).

    Parameters (m, s), and the unit tangents (m, s, d) there.
    """
    there, speed, bend = derivatives(controls, parameters, 2)
    off = there - points
    slope = (speed * speed).sum(axis=-1) + (off * bend).sum(axis=-1)
    step = (off * speed).sum(axis=-1) / np.where(slope > 0.0, slope, np.inf)
    moved = np.clip(parameters - step, 0.0, 1.0)
    along = derivatives(controls, moved, 1)[1]
    size = np.linalg.norm(along, axis=-1, keepdims=True)
    return moved, along / np.where(size > 0.0, size, 1.0)


def fitted(points: Floats, first: Floats, last: Floats, tolerance: float) -> tuple[Floats, Floats, Numbers]:
    """Cubics (m, 4, d) for spans of points (m, s, d) with end tangents, how far off each is, and at which point.

    Those that are off by more than `tolerance`, but not by much, are bettered by Newton's method.
    """
    steps = np.linalg.norm(np.diff(points, axis=1), axis=2)
    along = np.concatenate((np.zeros((len(points), 1)), np.cumsum(steps, axis=1)), axis=1)
    parameters = along / along[:, -1:]
    best = least_squares(points, parameters, first, last)
    off = np.linalg.norm(basis(3, parameters) @ best - points, axis=2)
    rows = np.flatnonzero((off.max(axis=1) > tolerance) & (off.max(axis=1) <= NEAR * along[:, -1]))
    tried = best[rows]
    for _ in range(ROUNDS):
        if not len(rows):
            break
        spans = points[rows]
        parameters[rows], along = nearer(spans, parameters[rows], tried)
        gap = np.linalg.norm(basis(3, parameters[rows]) @ tried - spans, axis=2)
        better = gap.max(axis=1) < off[rows].max(axis=1)
        best[rows[better]], off[rows[better]] = tried[better], gap[better]
        left = off[rows].max(axis=1) > tolerance
        rows = rows[left]
        # A step may make it worse at first: the best is kept, the last goes on.
        tried = least_squares(spans[left], parameters[rows], first[rows], last[rows], along[left])
    return best, off.max(axis=1), off.argmax(axis=1)


def _spans(points: Floats, tolerance: float, corners: Numbers, seam: bool) -> tuple[Floats, Numbers, float]:
    """Cubics (k, 4, d), their breaks (k + 1,), and the largest distance; `seam`: the ends meet with one tangent."""
    borders = np.concatenate(([0], corners, [len(points) - 1]))
    around = _direction(np.vstack((points[-1 - WINDOW : -1], points[: WINDOW + 1])), WINDOW) if seam else None
    todo = []
    for low, high in zip(borders[:-1].tolist(), borders[1:].tolist(), strict=True):
        span = points[low : high + 1]
        first = around if around is not None and low == 0 else _direction(span[: WINDOW + 1], 0)
        last = around if around is not None and high == len(points) - 1 else _direction(span[-WINDOW - 1 :], -1)
        todo.append((low, high, first, -last))
    todo.reverse()
    found, breaks, worst = [], [0], 0.0
    while todo:
        low, high, first, last = todo.pop()
        cubic, off, where = fitted(points[None, low : high + 1], first[None], last[None], tolerance)
        if off[0] <= tolerance or high - low < 2:
            found.append(cubic[0])
            breaks.append(high)
            worst = max(worst, float(off[0]))
            continue
        cut = min(max(low + int(where[0]), low + 1), high - 1)
        begin = max(cut - WINDOW, low)
        middle = _direction(points[begin : min(cut + WINDOW, high) + 1], cut - begin)
        todo += [(cut, high, middle, last), (low, cut, first, -middle)]
    return np.array(found), np.array(breaks), worst


def _direction(points: Floats, at: int) -> Floats:
    """(d,) unit tangent at one of a few points (k, d), of the parabola of least squares through all of them."""
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    along = np.concatenate(([0.0], np.cumsum(steps)))
    along = (along - along[at]) / along[-1]
    columns = along[:, None] ** np.arange(min(len(points), 3))
    tangent = np.linalg.lstsq(columns, points - points[at], rcond=None)[0][1]
    size = np.linalg.norm(tangent)
    return (
        tangent / size if size > 0.0 else (points[-1] - points[0]) / max(np.linalg.norm(points[-1] - points[0]), 1e-300)
    )


def _checked(points: ArrayLike, tolerance: float) -> Floats:
    if not (np.isfinite(tolerance) and tolerance > 0.0):
        raise Refusal(f"the tolerance of a curve must be above 0 mm, not {tolerance!r:.40}")
    given = np.asarray(points, float)
    if given.ndim != 2 or given.shape[1] not in (2, 3) or not len(given) or not np.isfinite(given).all():
        raise Refusal("a curve is fitted through points of two or three finite coordinates")
    return given
