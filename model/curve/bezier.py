"""Bezier curves: evaluation, derivatives, de Casteljau with all its points, cutting, bounds, other forms.

A curve is its control points `controls` (..., n + 1, d): degree n, d coordinates, any axes before for many curves of
one degree. A rational curve has positive `weights` (..., n + 1) beside them. What is linear in the control points
(`levels`, `split`, `extracted`, degree elevation) serves rational ones through `homogeneous` and `projected`.
Parameters run from 0 to 1; beyond, the same polynomial goes on.
"""

from __future__ import annotations

from functools import cache
from math import comb

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..document.errors import Refusal
from .affine import interpolated
from .bernstein import basis, derivative, product, roots

Floats = NDArray[np.float64]

BLOCK = 16384
"""Parameters that are evaluated together: their basis stays in the cache of the processor."""


def evaluated(controls: ArrayLike, t: ArrayLike, weights: ArrayLike | None = None) -> Floats:
    """Points (..., m, d) at t (..., m), or (..., d) at one number t. The axes before are broadcast.

    So t (m,) is for all curves alike, and t (k, m) gives each of k curves its own. The Bernstein basis times the
    control points: rounding is that of a few units in the last place at any degree, and the ends are met exactly.
    """
    controls, t = np.asarray(controls, float), np.asarray(t, float)
    if weights is not None:
        return projected(evaluated(homogeneous(controls, weights), t))[0]
    degree = controls.shape[-2] - 1
    if t.ndim != 1 or controls.ndim > 2 or len(t) <= BLOCK:
        return basis(degree, t) @ controls
    points = np.empty((len(t), controls.shape[-1]))
    for start in range(0, len(t), BLOCK):
        np.matmul(basis(degree, t[start : start + BLOCK]), controls, out=points[start : start + BLOCK])
    return points


def homogeneous(controls: ArrayLike, weights: ArrayLike) -> Floats:
    """Control points (..., n + 1, d + 1) of the curve above the rational one: weighted, with the weight as last axis.

    Raises Refusal where a weight is not above 0 or their number is another than that of the points.
    """
    controls, weights = np.asarray(controls, float), np.asarray(weights, float)
    if weights.shape[-1:] != controls.shape[-2:-1]:
        raise Refusal(f"{controls.shape[-2]} control points need as many weights; there are {weights.shape[-1]}")
    if not ((weights > 0.0) & np.isfinite(weights)).all():
        raise Refusal("the weights of a rational curve are above 0; give each control point such a weight")
    weights = np.broadcast_to(weights, controls.shape[:-1])
    return np.concatenate([controls * weights[..., None], weights[..., None]], -1)


def projected(homogeneous_points: ArrayLike) -> tuple[Floats, Floats]:
    """Points (..., d) and weights (...) of homogeneous ones (..., d + 1): the inverse of `homogeneous`."""
    points = np.asarray(homogeneous_points, float)
    return points[..., :-1] / points[..., -1:], points[..., -1]


def hodograph(controls: ArrayLike, order: int = 1) -> Floats:
    """Control points (..., n + 1 - order, d) of the derivative of that order; one zero point above the degree."""
    points = np.asarray(controls, float)
    for _ in range(order):
        degree = points.shape[-2] - 1
        points = degree * np.diff(points, axis=-2) if degree else np.zeros_like(points)
    return points


def derivatives(controls: ArrayLike, t: ArrayLike, order: int, weights: ArrayLike | None = None) -> Floats:
    """(order + 1, ..., m, d): points and derivatives by t up to that order, at t as in `evaluated`.

    Of rational curves by Leibniz' rule (Piegl and Tiller 1995, A4.2).
    """
    if weights is None:
        return np.stack([evaluated(hodograph(controls, k), t) for k in range(order + 1)])
    above = derivatives(homogeneous(controls, weights), t, order)
    points, weight = above[..., :-1].copy(), above[..., -1:]
    for k in range(order + 1):
        for i in range(1, k + 1):
            points[k] -= comb(k, i) * weight[i] * points[k - i]
        points[k] /= weight[0]
    return points


def levels(controls: ArrayLike, t: ArrayLike) -> list[Floats]:
    """All points of de Casteljau's construction (1959): level k has (*t.shape, ..., n + 1 - k, d), the last the point.

    Of a rational curve, give `homogeneous` points and project each level.
    """
    row = np.asarray(controls, float)
    t = np.asarray(t, float)
    along = t.reshape(*t.shape, *(1,) * row.ndim)
    row = np.broadcast_to(row, (*t.shape, *row.shape))
    made = [row]
    while row.shape[-2] > 1:
        row = interpolated(row[..., :-1, :], row[..., 1:, :], along)
        made.append(row)
    return made


def split(controls: ArrayLike, t: float) -> tuple[Floats, Floats]:
    """Control points (..., n + 1, d) of the curve before and after t (de Casteljau); both have its point exactly."""
    rows = levels(controls, t)
    return (
        np.stack([row[..., 0, :] for row in rows], -2),
        np.stack([row[..., -1, :] for row in reversed(rows)], -2),
    )


def extracted(controls: ArrayLike, start: ArrayLike, end: ArrayLike) -> Floats:
    """Control points of the part from `start` to `end`, by the blossom (Ramshaw 1987).

    It runs backwards where `end` is less than `start`, and goes on beyond the ends of the curve. Numbers, or arrays
    of the shape of the axes before the control points, broadcast.
    """
    controls = np.asarray(controls, float)
    degree = controls.shape[-2] - 1
    start, end = (np.asarray(t, float)[..., None, None, None] for t in (start, end))
    row = controls[..., None, :, :]  # copy j will have j arguments `end`, the others `start`
    copies = np.arange(degree + 1)[:, None, None]
    for level in range(1, degree + 1):
        row = interpolated(row[..., :-1, :], row[..., 1:, :], np.where(copies >= level, end, start))
    shape = (*np.broadcast_shapes(row.shape[:-3], start.shape[:-3]), degree + 1, controls.shape[-1])
    return np.broadcast_to(row[..., 0, :], shape).copy()


@cache
def _power_matrix(degree: int) -> Floats:
    matrix = [[(-1) ** (k - i) * comb(degree, k) * comb(k, i) for i in range(degree + 1)] for k in range(degree + 1)]
    return np.array(matrix, float)


def polynomial(controls: ArrayLike) -> Floats:
    """Coefficients (..., n + 1, d) of 1, t, t^2, ... t^n."""
    controls = np.asarray(controls, float)
    return _power_matrix(controls.shape[-2] - 1) @ controls


def of_polynomial(coefficients: ArrayLike) -> Floats:
    """Control points (..., n + 1, d) of the polynomial with the coefficients (..., n + 1, d) of 1, t, t^2, ..."""
    coefficients = np.asarray(coefficients, float)
    degree = coefficients.shape[-2] - 1
    matrix = np.array([[comb(i, k) / comb(degree, k) for k in range(degree + 1)] for i in range(degree + 1)])
    return matrix @ coefficients


def bounds(controls: ArrayLike, weights: ArrayLike | None = None) -> Floats:
    """(..., 2, d) the lowest and highest coordinates of the curve itself: at its ends and where a derivative is 0."""
    controls = np.asarray(controls, float)
    *lead, count, axes = controls.shape
    rows = np.moveaxis(controls, -1, -2).reshape(-1, count)
    low, high = np.minimum(rows[:, 0], rows[:, -1]), np.maximum(rows[:, 0], rows[:, -1])
    # A coordinate whose control points lie between its ends has no extremum beyond them.
    loose = np.flatnonzero((rows.min(-1) < low) | (rows.max(-1) > high))
    if weights is None:
        slopes, bottom = derivative(rows[loose]), np.ones(1)
    else:
        weight = homogeneous(controls, weights)[..., -1]
        bottom = np.repeat(weight.reshape(-1, count), axes, 0)[loose]
        top = rows[loose] * bottom
        slopes = product(derivative(top), bottom) - product(top, derivative(bottom))
    at, t = roots(slopes)
    values = basis(count - 1, t)
    if weights is None:
        found = (values * rows[loose[at]]).sum(-1)
    else:
        values = values * bottom[at]
        found = (values * rows[loose[at]]).sum(-1) / values.sum(-1)
    np.minimum.at(low, loose[at], found)
    np.maximum.at(high, loose[at], found)
    return np.stack([low.reshape(*lead, axes), high.reshape(*lead, axes)], -2)


def basis_values(degree: int, t: ArrayLike, weights: ArrayLike | None = None) -> Floats:
    """(*t.shape, degree + 1) the weights that the control points have in the point at t; their sum is 1."""
    values = basis(degree, t)
    if weights is None:
        return values
    values = values * np.asarray(weights, float)
    return values / values.sum(-1, keepdims=True)
