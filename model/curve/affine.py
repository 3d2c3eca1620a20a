"""Linear interpolation and what is built from it: points as affine combinations, and their barycentric coordinates."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..document.errors import Refusal

Floats = NDArray[np.float64]

ROUNDING = 1e-12
"""How far the sum of weights may be from 1, as a part of the sum of their absolute values."""


def interpolated(start: ArrayLike, end: ArrayLike, t: ArrayLike) -> Floats:
    """The affine combination (1 - t) start + t end, exactly `start` at 0 and `end` at 1; all are broadcast.

    An affine map of the ends maps the point in between alike, so that what is collinear stays so, in the same ratio.
    """
    t = np.asarray(t, float)
    return (1.0 - t) * np.asarray(start, float) + t * np.asarray(end, float)


def combined(points: ArrayLike, weights: ArrayLike) -> Floats:
    """The affine (barycentric) combinations (..., d) of points (n, d) with weights (..., n) whose sum is 1.

    Only such sums do not depend on the origin (Möbius 1827). Raises Refusal where the weights have another sum.
    """
    weights = np.asarray(weights, float)
    off = np.abs(weights.sum(-1) - 1.0)
    if not (off <= ROUNDING * np.maximum(np.abs(weights).sum(-1), 1.0)).all():
        raise Refusal(f"the weights of an affine combination add up to 1, not to {float(np.max(weights.sum(-1))):g}")
    return weights @ np.asarray(points, float)


def barycentric(points: ArrayLike, corners: ArrayLike) -> Floats:
    """The weights (..., k) with which the corners (k, d) of a segment, triangle or tetrahedron make points (..., d).

    Of points outside the corners' line or plane: those of the point nearest to them there. Raises Refusal for corners
    that are not in general position.
    """
    corners = np.asarray(corners, float)
    edges = corners[1:] - corners[0]
    if np.linalg.matrix_rank(edges) < len(edges):
        raise Refusal("barycentric coordinates need corners that do not lie on one point, line or plane; move one")
    inner = (np.asarray(points, float) - corners[0]) @ np.linalg.pinv(edges)
    return np.concatenate([1.0 - inner.sum(-1, keepdims=True), inner], -1)
