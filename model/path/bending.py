"""Bending a segment where it is caught, as a hand pulls at a wire."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..document.errors import Refusal
from .editing import convert
from .nodes import move_handle
from .path import Contour, Kind


def bend(contour: Contour, segment: int, parameter: float, by: ArrayLike) -> Contour:
    """The point of a segment at a parameter in (0, 1) moved by (d,); the nodes stay, their handles move.

    A line becomes a cubic, a quadratic moves its one handle. Of a cubic the handle that is nearer moves more: near the
    ends one alone, between them shares by a cubic that is level at both (as Inkscape's CurveDragPoint, 2009). What
    hangs on the handles follows as in `nodes.move_handle`, and the handle of a smooth node beside a line stays on the
    line's direction, so that the point is not reached there. Raises Refusal for B-splines.
    """
    if not 0 <= segment < len(contour):
        raise Refusal(f"there is no segment {segment}; the curve has {len(contour)}, counted from 0")
    t = float(parameter)
    if not 0.0 < t < 1.0:
        raise Refusal(f"a segment is bent between its ends: at more than 0, less than 1, not {t:g}")
    kind = contour.kinds[segment]
    if kind == Kind.SPLINE:
        raise Refusal("a B-spline in a path cannot be bent: make the segment cubic first")
    if kind == Kind.LINE:
        contour, _ = convert(contour, segment, Kind.CUBIC)
        kind = Kind.CUBIC
    shift, row = np.asarray(by, float), int(contour.starts[segment])
    if kind == Kind.QUADRATIC:
        return move_handle(contour, row + 1, contour.points[row + 1] + shift / (2.0 * t * (1.0 - t)))
    share = _share(t)
    targets = (
        contour.points[row + 1] + (1.0 - share) / (3.0 * t * (1.0 - t) ** 2) * shift,
        contour.points[row + 2] + share / (3.0 * t**2 * (1.0 - t)) * shift,
    )
    for place, target in zip((row + 1, row + 2), targets, strict=True):
        if (target != contour.points[place]).any():
            contour = move_handle(contour, place, target)
    return contour


def _share(t: float) -> float:
    """How much of a pull at t falls to the second handle: none up to 1/6, all from 5/6 on."""
    if t <= 1.0 / 6.0:
        return 0.0
    if t >= 5.0 / 6.0:
        return 1.0
    if t <= 0.5:
        return 0.5 * ((6.0 * t - 1.0) / 2.0) ** 3
    return 1.0 - 0.5 * ((6.0 * (1.0 - t) - 1.0) / 2.0) ** 3
