"""How curves meet: gap, angle and curvature jump at joints, the orders of continuity, and combs of curvature."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..curve.bezier import derivatives
from ..curve.differential import curvatures, normals, tangents
from ..spline.bspline import BSpline
from ..spline.bspline import derivatives as spline_derivatives
from ..spline.decomposition import decomposed
from .path import Contour, ends

Floats = NDArray[np.float64]

GAP = 1e-9
"""Ends that are nearer than this part of the segments' size are one point."""
ANGLE = 1e-4
"""Degrees: tangents that differ by less are one."""
JUMP = 1e-5
"""Curvatures that differ by less than this part of the larger one are one, as are derivatives."""


@dataclass(frozen=True, slots=True, eq=False)
class Joint:
    """Where a segment ends and the next one begins."""

    point: Floats  # (d,) the end of the first segment
    gap: float  # mm from there to the beginning of the second
    angle: float  # degrees between the tangents, 0 to 180
    curvatures: tuple[float, float]  # 1/mm before and after; in the plane positive where the curve turns left
    jump: float  # 1/mm, the difference of the curvature vectors
    geometric: int  # -1 gap, 0 the ends meet, 1 one tangent, 2 one curvature
    parametric: int  # the same for the derivatives by the parameter: -1, 0, 1, 2

    def __str__(self) -> str:
        if self.geometric < 0:
            return f"gap of {self.gap:.3g} mm"
        return f"G{self.geometric}, angle {self.angle:.3g}°, curvature jump {self.jump:.3g}/mm"


def joint(
    first: ArrayLike,
    second: ArrayLike,
    weights: ArrayLike | None = None,
    second_weights: ArrayLike | None = None,
    gap: float = GAP,
    angle: float = ANGLE,
    jump: float = JUMP,
    steps: tuple[float, float] = (1.0, 1.0),
) -> Joint:
    """The joint of two Bezier segments (n + 1, d) and (m + 1, d) of any degrees, each with its weights where rational.

    Tangents and curvatures are the limits at the joint, also where a handle has no length. The tolerances `gap` and
    `jump` are relative, see `GAP` and `JUMP`, `angle` is in degrees. Order 2 asks for both curvature vectors to agree
    (Farin 1982), in space thus also for one osculating plane. `steps` are the intervals of the
    parameter on both sides, for the derivatives.
    """
    first, second = np.asarray(first, float), np.asarray(second, float)
    size = max(float(np.ptp(first, axis=0).max()), float(np.ptp(second, axis=0).max()))
    apart = float(np.linalg.norm(second[0] - first[-1]))
    ways = tangents(first, 1.0, weights), tangents(second, 0.0, second_weights)
    turn = _angle(*ways)
    bends = float(curvatures(first, 1.0, weights)), float(curvatures(second, 0.0, second_weights))
    vectors = _vector(first, 1.0, weights, bends[0]), _vector(second, 0.0, second_weights, bends[1])
    with np.errstate(invalid="ignore"):
        off = float(np.linalg.norm(vectors[1] - vectors[0]))
    if np.isnan(off):  # both infinite
        off = float("inf")
    geometric = parametric = -1
    if apart <= gap * size:
        geometric = parametric = 0
        if turn <= angle:
            # Against the size, what is straight but for rounding is straight.
            most = max(abs(bends[0]), abs(bends[1]), 1e-3 / size if size else 0.0)
            geometric = 2 if off <= jump * most else 1
        before, after = derivatives(first, 1.0, 2, weights), derivatives(second, 0.0, 2, second_weights)
        for order in (1, 2):
            before[order], after[order] = before[order] / steps[0] ** order, after[order] / steps[1] ** order
            scale = max(np.linalg.norm(before[order]), np.linalg.norm(after[order]), size * jump / min(steps) ** order)
            if np.linalg.norm(after[order] - before[order]) > jump * scale:
                break
            parametric = order
    return Joint(first[-1], apart, turn, bends, off, geometric, parametric)


def report(contour: Contour) -> list[Joint]:
    """The joints of a contour, at node i + 1 between segments i and i + 1; of a closed one also that at its first node.

    Those inside a B-spline are `knot_joints`.
    """
    outer = [_outer(segment) for segment in contour.segments()]
    pairs = list(pairwise(outer)) + ([(outer[-1], outer[0])] if contour.closed else [])
    return [joint(before[1][0], after[0][0], before[1][1], after[0][1]) for before, after in pairs]


def knot_joints(spline: BSpline) -> list[Joint]:
    """The joints at the inner knots of a B-spline, ascending; of a closed one also that at its seam."""
    pieces = decomposed(spline)
    ratios = pieces.weights if pieces.weights is not None else [None] * len(pieces.controls)
    steps = np.diff(pieces.breaks).tolist()
    parts = list(zip(pieces.controls, ratios, steps, strict=True))
    begin, end = pieces.controls[0, 0], pieces.controls[-1, -1]
    seam = [(parts[-1], parts[0])] if np.linalg.norm(end - begin) <= GAP * np.ptp(spline.points, axis=0).max() else []
    return [
        joint(one, other, first, second, steps=(before, after))
        for (one, first, before), (other, second, after) in [*pairwise(parts), *seam]
    ]


def comb(
    curve: ArrayLike | BSpline, t: ArrayLike, scale: float, weights: ArrayLike | None = None, longest: float = np.inf
) -> tuple[Floats, Floats]:
    """Points (m, d) at t (m,) of a Bezier curve (n + 1, d) or a B-spline, and the tips (m, d) of its comb of curvature.

    The teeth stand away from the centre of curvature, `scale` mm² times the curvature long, `longest` mm at most.
    """
    t = np.asarray(t, float)
    if isinstance(curve, BSpline):
        points, along, bend = spline_derivatives(curve, t, 2)
        speed = (along * along).sum(-1, keepdims=True)
        across = (
            bend
            - np.divide((along * bend).sum(-1, keepdims=True), speed, out=np.zeros_like(speed), where=speed > 0.0)
            * along
        )
        vectors = np.divide(across, speed, out=np.zeros_like(across), where=speed > 0.0)
        sizes = np.linalg.norm(vectors, axis=-1)
        units = np.divide(vectors, sizes[:, None], out=np.zeros_like(vectors), where=sizes[:, None] > 0.0)
    else:
        points = derivatives(curve, t, 0, weights)[0]
        sizes, units = curvatures(curve, t, weights), normals(curve, t, weights)
    with np.errstate(invalid="ignore"):
        teeth = np.clip(
            np.nan_to_num(scale * sizes, posinf=np.finfo(float).max, neginf=-np.finfo(float).max), -longest, longest
        )
    return points, points - teeth[:, None] * units


def _outer(segment: Floats | BSpline) -> tuple[tuple[Floats, Floats | None], tuple[Floats, Floats | None]]:
    """The Bezier curves with which a segment begins and ends, and their weights."""
    if not isinstance(segment, BSpline):
        return (segment, None), (segment, None)
    pieces = decomposed(segment)
    weights = pieces.weights
    first, last = pieces.controls[0].copy(), pieces.controls[-1].copy()
    first[0], last[-1] = ends(segment)
    return (first, None if weights is None else weights[0]), (last, None if weights is None else weights[-1])


def _angle(one: Floats, other: Floats) -> float:
    """Degrees between two unit vectors, as exact for small angles as for large ones (Kahan 2006)."""
    return float(np.degrees(2.0 * np.arctan2(np.linalg.norm(one - other), np.linalg.norm(one + other))))


def _vector(controls: Floats, t: float, weights: ArrayLike | None, curvature: float) -> Floats:
    if curvature == 0.0:
        return np.zeros(controls.shape[1])
    normal = normals(controls, t, weights)
    return np.where(normal == 0.0, 0.0, curvature * normal)
