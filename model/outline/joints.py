"""The joints of an outline, and its comb of curvature."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..curve.differential import curvatures
from ..path.continuity import Joint, comb, knot_joints, report
from ..path.path import Kind, Path
from ..spline.bspline import BSpline
from ..spline.decomposition import decomposed

Floats = NDArray[np.float64]

TOOTH = 0.15
"""How long the teeth of a comb are by themselves, as a part of the outline's size: those of nearly all curvatures."""
NEARLY_ALL = 95.0  # percent


@dataclass(frozen=True, slots=True, eq=False)
class JointAt:
    """A joint and where it is: at a node of a contour, or, with node None, at an inner knot of a B-spline."""

    contour: int
    node: int | None
    joint: Joint

    @property
    def grade(self) -> int:
        """-1 the ends are apart, 0 they meet, 1 with one tangent (G1), 2 with one curvature (G2)."""
        return self.joint.geometric

    @property
    def radii(self) -> tuple[float, float]:
        """mm before and after, infinite where it is straight."""
        before, after = (1.0 / abs(k) if k else float("inf") for k in self.joint.curvatures)
        return before, after


def joints_of(path: Path) -> list[JointAt]:
    """All joints of a path, contour after contour, those of nodes before those of knots."""
    found: list[JointAt] = []
    for number, contour in enumerate(path.contours):
        count = len(contour.nodes)
        if len(contour) > 1 or (contour.closed and contour.kinds[0] != Kind.SPLINE):
            found += [JointAt(number, (i + 1) % count, joint) for i, joint in enumerate(report(contour))]
        for spline in contour.splines:
            found += [JointAt(number, None, joint) for joint in knot_joints(spline)]
    return found


@dataclass(frozen=True, slots=True, eq=False)
class Comb:
    """Teeth from the curve (n, d) to their tips (n, d), and where segments begin in them: the tips of one segment make
    a line."""

    roots: Floats
    tips: Floats
    starts: NDArray[np.intp]  # (s + 1,)
    sharpest: Floats  # (d,) where the curve bends most
    radius: float  # mm, its radius there; infinite where nothing bends


def comb_of(path: Path, factor: float = 1.0, teeth: int = 24) -> Comb | None:
    """The comb of curvature, with so many teeth a piece; `factor` times as long as they are by themselves.

    None for a path without a bend.
    """
    pieces = [piece for contour in path.contours for segment in contour.segments() for piece in _pieces(segment)]
    if not pieces:
        return None
    t = np.linspace(0.0, 1.0, teeth)
    bends = np.abs([curvatures(controls, t, weights) for controls, weights in pieces])
    usual = np.nan_to_num(bends, posinf=0.0)
    most = float(np.percentile(usual[usual > 0.0], NEARLY_ALL)) if (usual > 0.0).any() else 0.0
    size = float(np.ptp(path.bounds(), axis=0).max())
    if not most * size > 1e-9:
        return None
    scale, longest = factor * TOOTH * size / most, 3.0 * factor * TOOTH * size
    lines = [comb(controls, t, scale, weights, longest) for controls, weights in pieces]
    roots, tips = np.vstack([root for root, _ in lines]), np.vstack([tip for _, tip in lines])
    place = int(np.argmax(np.nan_to_num(bends, posinf=np.finfo(float).max)))
    sharp = float(bends.ravel()[place])
    return Comb(roots, tips, teeth * np.arange(len(pieces) + 1), roots[place], 1.0 / sharp if sharp else float("inf"))


def _pieces(segment: Floats | BSpline) -> list[tuple[Floats, Floats | None]]:
    """The Bezier curves of a segment that is no line."""
    if isinstance(segment, np.ndarray):
        return [(segment, None)] if len(segment) > 2 else []
    pieces = decomposed(segment)
    if segment.degree == 1:
        return []
    weights = pieces.weights if pieces.weights is not None else [None] * len(pieces.controls)
    return list(zip(pieces.controls, weights, strict=True))
