"""Newton's method for two curves that cross, and for two that touch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .bezier import derivatives, evaluated, extracted, homogeneous, projected

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

STEPS = 12
ASTRAY = 1.0
"""How far a solution may lie outside of the pieces it was begun from, as a part of their width."""
ROUNDED = 1e-13
"""How far beyond the ends of a curve a parameter may be by rounding."""
STILL = 1e-14
"""A derivative below this part of the curve's size gives no tangent."""
PARALLEL = 1e-6
"""How far unit tangents may differ where curves touch: what a double solution leaves of sixteen digits."""
SINGLE, DOUBLE = 1e-10, 1e-7
"""Crossings, and contacts, that are nearer to each other in both parameters are one."""


@dataclass(frozen=True, slots=True, eq=False)
class Curve:
    """A curve with what intersecting asks of it; `above` are its homogeneous points, or the control points."""

    controls: Floats
    weights: Floats | None
    above: Floats

    @classmethod
    def of(cls, controls: ArrayLike, weights: ArrayLike | None) -> Curve:
        controls = np.asarray(controls, float)
        if weights is None:
            return cls(controls, None, controls)
        return cls(controls, np.asarray(weights, float), homogeneous(controls, weights))

    @property
    def degree(self) -> int:
        return len(self.controls) - 1

    @property
    def size(self) -> float:
        """The greatest coordinate: what rounding is measured by."""
        return float(np.abs(self.controls).max())

    def plain(self, above: Floats) -> Floats:
        return above if self.weights is None else projected(above)[0]

    def part(self, start: float, end: float) -> Curve:
        above = extracted(self.above, start, end)
        return Curve(above, None, above) if self.weights is None else Curve(*projected(above), above)

    def points(self, t: ArrayLike) -> Floats:
        return evaluated(self.controls, t, self.weights)

    def derivatives(self, t: ArrayLike, order: int) -> Floats:
        return derivatives(self.controls, t, order, self.weights)


def crossings(a: Curve, b: Curve, start: Floats, width: Floats, slack: float) -> tuple[Floats, Flags]:
    """Rows (k, 3) of both parameters and 0, from start (k, 2); and whether they are crossings within the pieces.

    Gauss-Newton on the difference of the points, which is Newton's method in the plane.
    """
    found = start.copy()
    for _ in range(STEPS if len(start) else 0):
        p, q = a.derivatives(found[:, 0], 1), b.derivatives(found[:, 1], 1)
        step = _least(np.stack([p[1], -q[1]], -1), p[0] - q[0])
        found = found - np.clip(step, -2.0 * width, 2.0 * width)
        if (np.abs(step) <= np.finfo(float).eps).all():
            break
    if len(start):  # at a small angle rounding of the points moves the parameters by many times as much
        p, q = a.derivatives(found[:, 0], 1), b.derivatives(found[:, 1], 1)
        left = (_extended(a, found[:, 0]) - _extended(b, found[:, 1])).astype(float)
        found = found - np.clip(_least(np.stack([p[1], -q[1]], -1), left), -2.0 * width, 2.0 * width)
    rows, good = _accepted(a, b, found, start, width, slack, 0.0)
    flat = np.flatnonzero(good)[touching(a, b, rows[good, :2], 10.0 * PARALLEL)]
    if len(flat):  # a contact that pieces too short for it have parted
        better, fits = contacts(a, b, rows[flat, :2], np.full((len(flat), 2), 10.0 * PARALLEL), slack)
        rows[flat[fits]] = better[fits]
    return rows, good


def _extended(curve: Curve, t: Floats) -> NDArray[np.longdouble]:
    """(k, d) points at parameters t (k,) by de Casteljau, in the longest numbers that the machine has."""
    above = np.repeat(curve.above.astype(np.longdouble)[None], len(t), axis=0)
    for _ in range(curve.degree):
        above = above[:, :-1] + t[:, None, None] * (above[:, 1:] - above[:, :-1])
    return above[:, 0] if curve.weights is None else above[:, 0, :-1] / above[:, 0, -1:]


def contacts(a: Curve, b: Curve, start: Floats, width: Floats, slack: float) -> tuple[Floats, Flags]:
    """Rows (k, 3) of both parameters and 1, from start (k, 2); and whether the curves touch there within the pieces.

    Where points and tangents agree, simple contact is a simple solution; where the curvatures agree as well, the
    system with them is tried, and taken if it holds.
    """
    if not len(start):
        return np.zeros((0, 3)), np.zeros(0, bool)
    size = max(a.size, b.size)
    simple = _solved(a, b, start, width, 1, size)
    rows, good = _accepted(a, b, simple, start, width, slack, 1.0)
    if good.any():
        bent = _solved(a, b, simple[good], width[good], 2, size)
        left = np.abs(_residuals(a, b, bent, 2, size)).max(-1)
        better, fits = _accepted(a, b, bent, simple[good], np.full((1, 2), 1e-3), slack, 1.0)
        fits &= left <= 1e-7 * size
        at = np.flatnonzero(good)[fits]
        rows[at] = better[fits]
    rows[:, 2] = touching(a, b, rows[:, :2])
    return rows, good


def touching(a: Curve, b: Curve, t: Floats, angle: float = PARALLEL) -> Flags:
    """(k,) whether the tangents at parameters t (k, 2) are parallel within that angle."""
    return np.abs(_residuals(a, b, t, 1, 1.0)[:, a.controls.shape[1] :]).max(-1, initial=0.0) <= angle


def distinct(rows: Floats) -> Floats:
    """Rows (k, 3) by the first parameter; of those that are one, the first given."""
    apart = np.abs(rows[:, None, :2] - rows[None, :, :2]).max(-1)
    near = apart <= np.where(np.maximum(rows[:, None, 2], rows[None, :, 2]) > 0.0, DOUBLE, SINGLE)
    kept: list[int] = []
    for i in range(len(rows)):
        if not near[i, kept].any():
            kept.append(i)
    rows = rows[kept]
    return rows[np.lexsort([rows[:, 1], rows[:, 0]])]


def joined(a: Curve, b: Curve, rows: Floats, known: Floats, slack: float) -> Floats:
    """Rows (k, 3) of `distinct` where those between which the curves do not part are one: a known one, else their mean.

    They come of contact of a high order and of cusps, where rounding leaves many solutions.
    """
    middle = 0.5 * (rows[1:] + rows[:-1])
    apart = np.linalg.norm(a.points(middle[:, 0]) - b.points(middle[:, 1]), axis=-1) > 8.0 * slack
    made = [group.mean(0) for group in np.split(rows, np.flatnonzero(apart) + 1) if len(group)]
    for i, group in enumerate(np.split(rows, np.flatnonzero(apart) + 1)):
        held = group[(group[:, None] == known).all(-1).any(-1)]
        if len(held):
            made[i] = held[0]
    rows = np.array(made).reshape(-1, 3)
    return np.column_stack([rows[:, :2], touching(a, b, rows[:, :2]).astype(float)])


def _accepted(
    a: Curve, b: Curve, found: Floats, start: Floats, width: Floats, slack: float, touching: float
) -> tuple[Floats, Flags]:
    inside = (np.abs(found - start) <= (0.5 + ASTRAY) * width + ROUNDED).all(-1)
    inside &= ((found >= -ROUNDED) & (found <= 1.0 + ROUNDED)).all(-1)
    found = np.clip(np.where(np.isfinite(found), found, 0.0), 0.0, 1.0)
    gap = np.linalg.norm(a.points(found[:, 0]) - b.points(found[:, 1]), axis=-1)
    return np.column_stack([found, np.full(len(found), touching)]), inside & (gap <= 8.0 * slack)


def _least(matrix: Floats, right: Floats) -> Floats:
    """(k, 2) least-squares solutions, the shortest ones where the columns are parallel, of (k, r, 2) and (k, r)."""
    return (np.linalg.pinv(matrix, rcond=1e-14) @ right[..., None])[..., 0]


def _residuals(a: Curve, b: Curve, t: Floats, order: int, size: float) -> Floats:
    """(k, (order + 1) d) differences of points, unit tangents and curvature vectors, all in the unit of the size."""
    (p, tangent, bend), (q, other, turn) = _frenet(a, t[:, 0]), _frenet(b, t[:, 1])
    sign = np.where((tangent * other).sum(-1, keepdims=True) < 0.0, -1.0, 1.0)
    parts = [p - q, size * (tangent - sign * other), size**2 * (bend - turn)]
    return np.concatenate(parts[: order + 1], -1)


def _frenet(curve: Curve, t: Floats) -> tuple[Floats, Floats, Floats]:
    """Points, unit tangents and curvature vectors (k, d); the latter two 0 at a cusp."""
    points, along, second = curve.derivatives(t, 2)
    speed = np.linalg.norm(along, axis=-1, keepdims=True)
    moving = speed > STILL * max(curve.size, np.finfo(float).tiny)
    tangent = np.divide(along, speed, out=np.zeros_like(along), where=moving)
    across = second - (second * tangent).sum(-1, keepdims=True) * tangent
    return points, tangent, np.divide(across, speed * speed, out=np.zeros_like(across), where=moving)


def _solved(a: Curve, b: Curve, start: Floats, width: Floats, order: int, size: float) -> Floats:
    """Gauss-Newton on `_residuals`, with central differences; the solution is one without residual."""
    found = start.copy()
    step = 1e-6
    for _ in range(STEPS):
        columns = [
            (_residuals(a, b, found + move, order, size) - _residuals(a, b, found - move, order, size)) / (2.0 * step)
            for move in step * np.eye(2)
        ]
        change = _least(np.stack(columns, -1), _residuals(a, b, found, order, size))
        found = found - np.clip(change, -2.0 * width, 2.0 * width)
        if (np.abs(change) <= 1e-15).all():
            break
    return found
