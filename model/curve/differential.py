"""Tangents, normals, curvature and inflections of Bezier curves, also where the derivative is zero."""

from __future__ import annotations

from math import factorial

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .bernstein import basis, product, roots
from .bezier import derivatives, hodograph, homogeneous

Floats = NDArray[np.float64]

STILL = 1e-13
"""A derivative below this part of what it could be by the size of the curve counts as 0."""


def tangents(controls: ArrayLike, t: ArrayLike, weights: ArrayLike | None = None) -> Floats:
    """Unit tangents (..., d) at t (m,) or one number, of one curve (n + 1, d).

    Where the derivative is 0, as at a cusp or beside a doubled end point, the direction in which the curve goes on;
    at t = 1 that from which it comes. Zero for a curve that is a point.
    """
    along, t = _derivatives(controls, t, weights)
    made = _units(along[1])
    for k in range(2, len(along)):
        still = ~made.any(-1)
        if not still.any():
            break
        sign = np.where((t[still] >= 1.0) & (k % 2 == 0), -1.0, 1.0)
        made[still] = sign[..., None] * _units(along[k][still])
    return made


def normals(controls: ArrayLike, t: ArrayLike, weights: ArrayLike | None = None) -> Floats:
    """Unit normals (..., d) at t of one curve: the tangent turned left in the plane; in space the principal normal.

    In space zero where the curve is straight.
    """
    along = tangents(controls, t, weights)
    if along.shape[-1] == 2:
        return np.stack([-along[..., 1], along[..., 0]], -1)
    second = derivatives(controls, t, 2, weights)[2]
    across = second - (second * along).sum(-1, keepdims=True) * along
    size = np.linalg.norm(across, axis=-1, keepdims=True)
    real = size > STILL * np.maximum(np.linalg.norm(second, axis=-1, keepdims=True), np.finfo(float).tiny)
    return np.divide(across, size, out=np.zeros_like(across), where=real)


def curvatures(controls: ArrayLike, t: ArrayLike, weights: ArrayLike | None = None) -> Floats:
    """Curvature (...) in 1/mm at t of one curve; in the plane positive where it turns left, in space never negative.

    Where the derivative is 0 it is the limit: of the first derivatives A of order p and B of order q that are not
    parallel, the latter decides; infinite for q < 2 p, 0 for q > 2 p.
    """
    along, t = _derivatives(controls, t, weights)
    speed = np.linalg.norm(along[1], axis=-1)
    turn = _cross(along[1], along[2]) if len(along) > 2 else np.zeros(t.shape)
    with np.errstate(divide="ignore", invalid="ignore"):
        made = np.atleast_1d(turn / speed**3)
    for at in np.flatnonzero(np.atleast_1d(~along[1].any(-1))):
        made[at] = _limit(along.reshape(len(along), -1, along.shape[-1])[:, at], bool(np.atleast_1d(t)[at] >= 1.0))
    return made.reshape(t.shape)


def inflections(controls: ArrayLike, weights: ArrayLike | None = None) -> Floats:
    """Parameters (k,) inside a plane curve (n + 1, 2) at which its curvature changes its sign.

    Of a rational curve the sign is that of the determinant of its homogeneous points and their two derivatives.
    Raises ValueError for curves in space.
    """
    controls = np.asarray(controls, float)
    if controls.ndim != 2 or controls.shape[1] != 2:
        raise ValueError("inflections are of curves in the plane")
    if len(controls) < 3:
        return np.zeros(0)
    local = controls - controls.mean(0)
    first, second = hodograph(local).T, hodograph(local, 2).T
    if weights is None:
        turn = product(first[0], second[1]) - product(first[1], second[0])
    else:
        above = homogeneous(local, weights)
        x, u, v = above.T, hodograph(above).T, hodograph(above, 2).T
        cyclic = ((0, 1, 2), (1, 2, 0), (2, 0, 1))
        turn = np.add.reduce([product(x[i], product(u[j], v[k]) - product(u[k], v[j])) for i, j, k in cyclic])
    # What is straight but for rounding turns nowhere.
    if np.abs(turn).max() <= STILL * np.abs(local).max() ** 2:
        return np.zeros(0)
    _, t = roots(turn[None])
    middles = 0.5 * (np.concatenate([[0.0], t]) + np.concatenate([t, [1.0]]))
    signs = np.sign(basis(len(turn) - 1, middles) @ turn)
    return t[signs[:-1] * signs[1:] < 0.0]


def _derivatives(controls: ArrayLike, t: ArrayLike, weights: ArrayLike | None) -> tuple[Floats, Floats]:
    """Derivatives (k, ..., d) up to the degree, those that are rounding as zeros; and t."""
    controls, t = np.asarray(controls, float), np.asarray(t, float)
    degree = len(controls) - 1
    local = controls - controls.mean(0)
    along = derivatives(local, t, max(degree, 1) if weights is None else degree + 2, weights)
    size = np.abs(local).max()
    ranges = np.array([size * STILL * max(degree, 1) ** k for k in range(len(along))])
    small = np.linalg.norm(along, axis=-1) <= ranges.reshape(-1, *(1,) * t.ndim)
    along[small] = 0.0
    return along, t


def _units(vectors: Floats) -> Floats:
    size = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return np.divide(vectors, size, out=np.zeros_like(vectors), where=size > 0.0)


def _cross(first: Floats, second: Floats) -> Floats:
    """The cross product in the plane, its length in space."""
    if first.shape[-1] == 2:
        return first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]
    return np.linalg.norm(np.cross(first, second), axis=-1)


def _limit(along: Floats, at_end: bool) -> float:
    """The curvature where the derivatives (k, d) begin with a zero."""
    if at_end:  # run backwards from there, so that the sign turns
        along = along * (-1.0) ** np.arange(len(along))[:, None]
    orders = 1 + np.flatnonzero(along[1:].any(-1))
    for q in orders[1:]:
        p = int(orders[0])
        size = float(np.linalg.norm(along[p]))
        turn = float(_cross(along[p], along[q]))
        if abs(turn) > STILL * size * float(np.linalg.norm(along[q])):
            sign = -1.0 if at_end and along.shape[-1] == 2 else 1.0
            if q != 2 * p:
                return sign * float(np.copysign(np.inf, turn)) if q < 2 * p else 0.0
            return sign * 2.0 * factorial(p) ** 2 / factorial(2 * p) * turn / size**3
    return 0.0
