"""The degree of Bezier curves: elevation without change, reduction with the deviation it makes."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..document.errors import Refusal
from .bernstein import basis, derivative, product, roots
from .bezier import evaluated

Floats = NDArray[np.float64]


def elevated(controls: ArrayLike, times: int = 1) -> Floats:
    """Control points (..., n + 1 + times, d) of the same curve with a higher degree (Forrest 1972).

    Of a rational curve, give `homogeneous` points.
    """
    controls = np.asarray(controls, float)
    for _ in range(times):
        count = controls.shape[-2]
        share = (np.arange(1, count) / count)[:, None]
        inner = share * controls[..., :-1, :] + (1.0 - share) * controls[..., 1:, :]
        controls = np.concatenate([controls[..., :1, :], inner, controls[..., -1:, :]], -2)
    return controls.copy() if not times else controls


def reduced(controls: ArrayLike, times: int = 1) -> tuple[Floats, float]:
    """Control points (n + 1 - times, d) of the best curve of a lower degree, and its greatest distance from the curve.

    Best is the one with the least mean square distance between points of one parameter, of those that keep both ends
    (the norm of Ahn, Lee, Park and Yoo 2004). The greatest distance is between points of one parameter, too, thus a
    bound for the distance of the curves. Raises Refusal below degree 1.
    """
    controls = np.asarray(controls, float)
    degree = len(controls) - 1
    lower = degree - times
    if lower < 1:
        raise Refusal(f"a curve of degree {degree} cannot be reduced {times} times; degree 1 is the least")
    nodes, shares = np.polynomial.legendre.leggauss(degree + 1)  # exact for the square of the difference
    t, root = 0.5 + 0.5 * nodes, np.sqrt(shares)[:, None]
    values = basis(lower, t)
    wanted = evaluated(controls, t) - values[:, [0, -1]] @ controls[[0, -1]]
    inner = np.linalg.lstsq(root * values[:, 1:-1], root * wanted, rcond=None)[0]
    made = np.concatenate([controls[:1], np.asarray(inner, float), controls[-1:]])
    return made, farthest(elevated(made, times), controls)


def farthest(first: ArrayLike, second: ArrayLike) -> float:
    """The greatest distance between points of one parameter on two curves (n + 1, d) of one degree; exact."""
    apart = np.asarray(first, float) - np.asarray(second, float)
    size = np.abs(apart).max()
    if size == 0.0:
        return 0.0
    coordinates = (apart / size).T
    _, t = roots(derivative(product(coordinates, coordinates).sum(0))[None])
    t = np.concatenate([[0.0, 1.0], t])
    return float(size * np.linalg.norm(evaluated(apart / size, t), axis=-1).max())
