"""Arc lengths of Bezier curves, the parameter at a length, and areas."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .bernstein import derivative, product, roots
from .bezier import derivatives, evaluated, hodograph, homogeneous

Floats = NDArray[np.float64]
Numbers = NDArray[np.intp]

NODES = 16
ACCURACY = 1e-15
"""How far the length of a piece may be from the sum of its halves', as a part of the whole curve's length."""
HALVINGS = 48


@dataclass(frozen=True, slots=True, eq=False)
class Pieces:
    """Intervals of parameters with their lengths: those of a curve in a row, ascending."""

    curve: Numbers  # (k,)
    start: Floats  # (k,)
    end: Floats  # (k,)
    length: Floats  # (k,)


def length(
    controls: ArrayLike, start: float = 0.0, end: float = 1.0, weights: ArrayLike | None = None
) -> NDArray[np.float64]:
    """(...) arc length in mm of each curve (..., n + 1, d) between two parameters; negative where `end` is the lesser.

    Gauss-Legendre quadrature with 16 nodes of the pieces between the minima of the speed, which are halved until the
    halves say the same to 1e-15 of the length: near a cusp the pieces grow short geometrically.
    """
    controls = np.asarray(controls, float)
    *lead, count, axes = controls.shape
    flat = controls.reshape(-1, count, axes)
    ratios = None if weights is None else np.broadcast_to(np.asarray(weights, float), controls.shape[:-1])
    ratios = None if ratios is None else ratios.reshape(-1, count)
    low, high = min(start, end), max(start, end)
    pieces = measured(flat, ratios, low, high)
    totals = np.zeros(len(flat))
    np.add.at(totals, pieces.curve, pieces.length)
    return (totals if start <= end else -totals).reshape(lead)[()]


def parameters_at(controls: ArrayLike, lengths: ArrayLike, weights: ArrayLike | None = None) -> Floats:
    """(...) the parameters at which one curve (n + 1, d) has the arc lengths (...) from its start.

    Below 0 and above the whole length these are the ends.
    """
    controls = np.asarray(controls, float)
    wanted = np.asarray(lengths, float)
    ratios = None if weights is None else np.asarray(weights, float)[None]
    pieces = measured(controls[None], ratios, 0.0, 1.0)
    before = np.concatenate([[0.0], np.cumsum(pieces.length)])
    goal = np.clip(wanted.ravel(), 0.0, before[-1])
    which = np.clip(np.searchsorted(before, goal, side="right") - 1, 0, len(pieces.length) - 1)
    start, whole, rest = pieces.start[which], pieces.length[which], goal - before[which]
    low, high = start.copy(), pieces.end[which]
    with np.errstate(divide="ignore", invalid="ignore"):
        t = np.where(whole > 0.0, start + (high - low) * np.minimum(rest / whole, 1.0), low)
    none = np.zeros(len(t), int)
    for _ in range(60):
        off = _quadrature(controls[None], ratios, none, start, t) - rest
        low, high = np.where(off < 0.0, t, low), np.where(off < 0.0, high, t)
        with np.errstate(divide="ignore", invalid="ignore"):
            step = t - off / _speed(controls[None], ratios, none, t[:, None])[:, 0]
        moved = np.where((step >= low) & (step <= high), step, 0.5 * (low + high))
        moved = np.where(off == 0.0, t, moved)
        done = np.abs(moved - t) <= 2.0 * np.finfo(float).eps * np.maximum(np.abs(t), np.finfo(float).tiny)
        t = moved
        if done.all():
            break
    t = np.where(goal <= 0.0, 0.0, np.where(goal >= before[-1], 1.0, t))
    return t.reshape(wanted.shape)[()]


def area(controls: ArrayLike, weights: ArrayLike | None = None) -> NDArray[np.float64]:
    """(...) the signed area between plane curves (..., n + 1, 2) and the origin, 1/2 of the integral of x dy - y dx.

    Around a closed contour the sum of these is its area, positive where it runs counter-clockwise (Green). Exact;
    that of a rational curve by Gauss-Legendre quadrature of 64 nodes.
    """
    controls = np.asarray(controls, float)
    first = controls[..., :1, :]
    # About the first point, so that what is far from the origin keeps its digits.
    local, away = controls - first, controls[..., -1, :] - first[..., 0, :]
    outer = first[..., 0, 0] * away[..., 1] - first[..., 0, 1] * away[..., 0]
    if weights is None:
        u, v = np.moveaxis(local, -1, 0)
        return 0.5 * ((product(u, derivative(v)) - product(v, derivative(u))).mean(-1) + outer)
    nodes, shares = np.polynomial.legendre.leggauss(64)
    points, along = derivatives(local, 0.5 + 0.5 * nodes, 1, weights)
    turn = points[..., 0] * along[..., 1] - points[..., 1] * along[..., 0]
    return 0.5 * (0.5 * (turn * shares).sum(-1) + outer)


def measured(controls: Floats, weights: Floats | None, low: float, high: float) -> Pieces:
    """Curves (c, n + 1, d) cut between two parameters into pieces whose quadrature is as exact as it gets."""
    curve, start, end = _monotone(controls, weights, low, high)
    whole = _quadrature(controls, weights, curve, start, end)
    scale = np.zeros(len(controls))
    np.add.at(scale, curve, whole)
    done: list[tuple[Numbers, Floats, Floats, Floats]] = []
    for depth in range(HALVINGS + 1):
        middle = 0.5 * (start + end)
        left = _quadrature(controls, weights, curve, start, middle)
        right = _quadrature(controls, weights, curve, middle, end)
        good = np.abs(left + right - whole) <= ACCURACY * scale[curve]
        if depth == HALVINGS:
            good[:] = True
        done.append((curve[good], start[good], middle[good], left[good]))
        done.append((curve[good], middle[good], end[good], right[good]))
        bad = ~good
        if not bad.any():
            break
        curve = np.concatenate([curve[bad], curve[bad]])
        start, end = np.concatenate([start[bad], middle[bad]]), np.concatenate([middle[bad], end[bad]])
        whole = np.concatenate([left[bad], right[bad]])
    curve, start, end, sizes = (np.concatenate(column) for column in zip(*done, strict=True))
    order = np.lexsort([start, curve])
    return Pieces(curve[order], start[order], end[order], sizes[order])


def _monotone(controls: Floats, weights: Floats | None, low: float, high: float) -> tuple[Numbers, Floats, Floats]:
    """Pieces (curve, start, end) between the parameters at which the square of the speed has an extremum.

    For rational curves that of their homogeneous points does as well: halving does the rest.
    """
    above = hodograph(controls if weights is None else homogeneous(controls, weights))
    along = np.moveaxis(above, -1, 1)  # (c, d, n)
    at, t = roots(product(along, derivative(along)).sum(1))
    inside = (t > low) & (t < high)
    every = np.arange(len(controls))
    curve = np.concatenate([every, at[inside], every])
    t = np.concatenate([np.full(len(controls), low), t[inside], np.full(len(controls), high)])
    order = np.lexsort([t, curve])
    curve, t = curve[order], t[order]
    same = np.flatnonzero(np.diff(curve) == 0)
    return curve[same], t[same], t[same + 1]


def _speed(controls: Floats, weights: Floats | None, curve: Numbers, t: Floats) -> Floats:
    """(k, m) lengths of the derivative of the curves `curve` (k,) at t (k, m)."""
    if weights is None:
        return np.linalg.norm(evaluated(hodograph(controls)[curve], t), axis=-1)
    return np.linalg.norm(derivatives(controls[curve], t, 1, weights[curve])[1], axis=-1)


_NODES, _SHARES = np.polynomial.legendre.leggauss(NODES)


def _quadrature(controls: Floats, weights: Floats | None, curve: Numbers, start: Floats, end: Floats) -> Floats:
    half = 0.5 * (end - start)
    t = (0.5 * (start + end))[:, None] + half[:, None] * _NODES
    return half * (_speed(controls, weights, curve, t) @ _SHARES)
