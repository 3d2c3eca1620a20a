"""Joints of two Bezier segments made smooth, symmetric, harmonic or of one curvature.

All take the control points (n + 1, d) and (m + 1, d) of a segment and the next one, which begins at its end, and give
both back. Only the joint and the control points beside it, the handles, move. Weights are kept; where there are some,
they are given for the curvature.
"""

from __future__ import annotations

from math import sqrt

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..document.errors import Refusal

Floats = NDArray[np.float64]
Pair = tuple[Floats, Floats]

FLAT = 1e-9
"""A turn away from the tangent by less than this part of the handles is none."""


def smooth(first: ArrayLike, second: ArrayLike, keep: str | None = None) -> Pair:
    """One tangent (G1) by turning the handles about the joint; their lengths stay.

    `keep` "first" or "second" leaves that side; else both turn, the shorter handle more: the common direction is that
    from the end of one handle to the end of the other. A line keeps its direction. Raises Refusal where nothing may
    turn, and where a handle has no length or lies on the other one.
    """
    first, second = _joined(first, second)
    place = first[-1]
    before, after = place - first[-2], second[1] - place
    lengths = _lengths(before, after)
    fixed = (keep == "first" or len(first) == 2, keep == "second" or len(second) == 2)
    if all(fixed):
        raise Refusal("neither side of the joint can turn: make one of the lines a curve first")
    way = before if fixed[0] else after if fixed[1] else before + after
    size = float(np.linalg.norm(way))
    if size <= FLAT * (lengths[0] + lengths[1]):
        raise Refusal("the handles lie on each other, and no direction is between them; turn one of them first")
    if not fixed[0]:
        first[-2] = place - way * (lengths[0] / size)
    if not fixed[1]:
        second[1] = place + way * (lengths[1] / size)
    return first, second


def symmetric(first: ArrayLike, second: ArrayLike) -> Pair:
    """Handles on one line and of one length, the mean of theirs: for segments of one degree also C1."""
    if len(np.asarray(first)) == 2 or len(np.asarray(second)) == 2:
        raise Refusal("a line has no handle that could be symmetric: make it a curve first")
    first, second = smooth(first, second)
    place = first[-1]
    before, after = place - first[-2], second[1] - place
    one, other = _lengths(before, after)
    first[-2] = place - before * (0.5 * (one + other) / one)
    second[1] = place + after * (0.5 * (one + other) / other)
    return first, second


def harmonised(
    first: ArrayLike, second: ArrayLike, weights: ArrayLike | None = None, second_weights: ArrayLike | None = None
) -> Pair:
    """One curvature (G2) by moving the joint along the line of its handles, which stay, as does the tangent.

    What font editors call harmonise. With a and b from the joint to the handles, h and k from the handles' line to the
    next control points, the curvatures are in proportion to h / a² and k / b²: the joint divides the line as the roots
    of h and k do. Raises Refusal where the tangents differ, or the sides turn to different sides or not at all.
    """
    first, second = _joined(first, second)
    way = _tangent(first, second)
    one, other = _offset(first[::-1], way), _offset(second, way)
    sizes = float(np.linalg.norm(one)), float(np.linalg.norm(other))
    span = float(np.linalg.norm(second[1] - first[-2]))
    if min(sizes) <= FLAT * span:
        raise Refusal("one side of the joint is straight there, so that the curvatures cannot be equal; bend it first")
    _same_side(one, other)
    factors = _factor(len(first) - 1, weights, True), _factor(len(second) - 1, second_weights, False)
    share = sqrt(factors[0] * sizes[0]) / (sqrt(factors[0] * sizes[0]) + sqrt(factors[1] * sizes[1]))
    place = first[-2] + share * (second[1] - first[-2])
    first[-1] = second[0] = place
    return first, second


def same_curvature(
    first: ArrayLike,
    second: ArrayLike,
    keep: str = "first",
    weights: ArrayLike | None = None,
    second_weights: ArrayLike | None = None,
) -> Pair:
    """One curvature (G2) by the length of one handle; the side `keep`, "first" or "second", and the joint stay.

    Raises Refusal where the tangents differ, or the other side cannot have that curvature with any handle.
    """
    first, second = _joined(first, second)
    if keep not in ("first", "second"):
        raise Refusal(f"the side of a joint that is kept is first or second, not “{keep!s:.40}”")
    way = _tangent(first, second)
    kept, moved = (first[::-1], second) if keep == "first" else (second, first[::-1])
    given, changed = (weights, second_weights) if keep == "first" else (second_weights, weights)
    one, other = _offset(kept, way), _offset(moved, way)
    arm = float(np.linalg.norm(kept[1] - kept[0]))
    size, target = float(np.linalg.norm(other)), float(np.linalg.norm(one))
    span = arm + float(np.linalg.norm(moved[1] - moved[0]))
    if target <= FLAT * span and size <= FLAT * span:
        return first, second
    if target <= FLAT * span:
        raise Refusal("the side that is kept is straight at the joint; a handle's length makes no curve straight")
    if size <= FLAT * span:
        raise Refusal("the side that changes is straight at the joint; move its other handle off the tangent first")
    _same_side(one, other)
    factors = _factor(len(kept) - 1, given, keep == "first"), _factor(len(moved) - 1, changed, keep == "second")
    reach = arm * sqrt(factors[1] * size / (factors[0] * target))
    moved[1] = moved[0] + (moved[1] - moved[0]) * (reach / float(np.linalg.norm(moved[1] - moved[0])))
    return first, second


def _joined(first: ArrayLike, second: ArrayLike) -> Pair:
    """Copies that meet exactly."""
    one, other = np.array(first, float), np.array(second, float)
    gap = float(np.linalg.norm(other[0] - one[-1]))
    if gap > FLAT * max(float(np.ptp(one, axis=0).max()), float(np.ptp(other, axis=0).max())):
        raise Refusal(f"the segments do not meet: {gap:g} mm are between them; join them first")
    other[0] = one[-1]
    return one, other


def _lengths(before: Floats, after: Floats) -> tuple[float, float]:
    found = float(np.linalg.norm(before)), float(np.linalg.norm(after))
    if 0.0 in found:
        raise Refusal("a handle at this joint has no length and so no direction; pull it out first")
    return found


def _tangent(first: Floats, second: Floats) -> Floats:
    """(d,) the common unit tangent."""
    before, after = first[-1] - first[-2], second[1] - second[0]
    lengths = _lengths(before, after)
    units = before / lengths[0], after / lengths[1]
    if len(first) < 3 or len(second) < 3:
        raise Refusal("a line has no curvature to share: make it a curve first")
    if np.linalg.norm(units[0] - units[1]) > 1e-6:
        raise Refusal("the segments have no common tangent at this joint; make it smooth first")
    way = before + after
    return way / np.linalg.norm(way)


def _offset(outwards: Floats, way: Floats) -> Floats:
    """(d,) from the tangent at the first control point to the third one."""
    along = outwards[2] - outwards[0]
    return along - (along @ way) * way


def _same_side(one: Floats, other: Floats) -> None:
    sizes = float(np.linalg.norm(one)) * float(np.linalg.norm(other))
    if one @ other < 0.0:
        raise Refusal("the curve turns to the other side at this joint: its curvatures cannot be equal but for 0")
    if sizes - one @ other > 1e-9 * sizes:
        raise Refusal("the sides of this joint do not lie in one plane: their curvatures cannot be equal")


def _factor(degree: int, weights: ArrayLike | None, at_end: bool) -> float:
    """The curvature at an end times the square of the handle by the offset of the third control point."""
    plain = (degree - 1) / degree
    if weights is None:
        return plain
    outwards = np.asarray(weights, float)[:: -1 if at_end else 1]
    return plain * float(outwards[0] * outwards[2] / outwards[1] ** 2)
