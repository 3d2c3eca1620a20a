"""The points of a Bezier curve that are nearest to given ones."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .bernstein import derivative, product, roots
from .bezier import derivatives, evaluated, homogeneous

Floats = NDArray[np.float64]
Numbers = NDArray[np.intp]

BLOCK = 4096
"""Points that are looked for together."""


def nearest(controls: ArrayLike, points: ArrayLike, weights: ArrayLike | None = None) -> tuple[Floats, Floats]:
    """Of points (..., d) the parameter (...) of the nearest point of one curve (n + 1, d), and the distance (...).

    All stationary distances and both ends are compared; of several that are as near the first.
    """
    controls, points = np.asarray(controls, float), np.asarray(points, float)
    flat = points.reshape(-1, points.shape[-1])
    best, least = np.zeros(len(flat)), np.zeros(len(flat))
    for start in range(0, len(flat), BLOCK):
        block = slice(start, start + BLOCK)
        at, t = feet(controls, flat[block], weights)
        count = len(flat[block])
        at = np.concatenate([np.arange(count), at, np.arange(count)])
        t = np.concatenate([np.zeros(count), t, np.ones(count)])
        away = np.linalg.norm(evaluated(controls, t, weights) - flat[block][at], axis=-1)
        order = np.lexsort([t, away, at])
        firsts = order[np.flatnonzero(np.diff(at[order], prepend=-1))]
        best[block], least[block] = t[firsts], away[firsts]
    return best.reshape(points.shape[:-1])[()], least.reshape(points.shape[:-1])[()]


def feet(controls: ArrayLike, points: ArrayLike, weights: ArrayLike | None = None) -> tuple[Numbers, Floats]:
    """Which of the points (k, d) and the parameter (r,) of all places where the distance to it is stationary.

    They are the roots of (C - P) . C', a polynomial of degree 2 n - 1 (3 n - 1 times the square of the denominator for
    a rational curve); see Schneider 1990. Newton steps on the curve itself take away what the product has rounded.
    """
    controls, points = np.asarray(controls, float), np.asarray(points, float)
    bottom = None if weights is None else homogeneous(controls, weights)[:, -1]
    from_ = controls[None] - points[:, None]  # (k, n + 1, d)
    top = np.moveaxis(from_ if bottom is None else from_ * bottom[:, None], -1, 1)
    slope = product(top, derivative(top)).sum(1)
    if bottom is not None:
        slope = product(slope, bottom) - product(product(top, top).sum(1), derivative(bottom))
    at, t = roots(slope)
    for _ in range(2):
        place, along, bend = derivatives(controls, t, 2, weights)
        off = place - points[at]
        down, change = (off * along).sum(-1), (along * along).sum(-1) + (off * bend).sum(-1)
        with np.errstate(divide="ignore", invalid="ignore"):
            moved = np.clip(t - down / change, 0.0, 1.0)
        closer = np.abs(moved - t) < 1e-6
        t = np.where(closer, moved, t)
    return at, t
