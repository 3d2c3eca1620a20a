"""The basic shapes of SVG as outlines (SVG 2 chapter 10): rectangle, circle, ellipse, line, polyline, polygon."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .drawing_shapes import Outline, ellipse_arc
from .svg_units import numbers

Size = Callable[[str, str], float | None]
"""The length an attribute gives along the axis "x", "y" or "", in user units; None where it is missing or wrong."""

BASIC = ("rect", "circle", "ellipse", "line", "polyline", "polygon")


def basic_shape(tag: str, size: Size, points: str, tolerance: float | None) -> tuple[Outline, str]:
    """The outline of a basic shape, empty where its sizes say so, and words for what is wrong (empty: nothing).

    Round parts are cubics as in `svg_path.read_path`; `points` is the attribute of polylines and polygons.
    """
    if tag == "rect":
        return _rectangle(size, tolerance), ""
    if tag in ("circle", "ellipse"):
        return _ellipse(size, tag == "circle", tolerance), ""
    outline = Outline()
    if tag == "line":
        outline.add("move", size("x1", "x") or 0.0, size("y1", "y") or 0.0)
        outline.add("line", size("x2", "x") or 0.0, size("y2", "y") or 0.0)
        return outline, ""
    values, whole = numbers(points)
    even = len(values) - len(values) % 2
    if even >= 4:
        outline.points = values[:even]
        outline.words = ["move", *["line"] * (even // 2 - 1)]
        if tag == "polygon":
            outline.add("close")
    if not whole:
        return outline, f"only the first {even // 2:,} of its points can be read"
    return outline, "its last point has no y" if even < len(values) else ""


def _radii(size: Size) -> tuple[float, float] | None:
    """rx and ry, each of which is as the other where it is missing or below 0; None: neither is given."""
    rx, ry = size("rx", "x"), size("ry", "y")
    rx, ry = (None if r is None or r < 0.0 else r for r in (rx, ry))
    if rx is None and ry is None:
        return None
    return (ry if rx is None else rx), (rx if ry is None else ry)  # type: ignore[return-value]


def _rectangle(size: Size, tolerance: float | None) -> Outline:
    outline = Outline()
    x, y = size("x", "x") or 0.0, size("y", "y") or 0.0
    width, height = size("width", "x") or 0.0, size("height", "y") or 0.0
    if not (width > 0.0 and height > 0.0):
        return outline
    rx, ry = _radii(size) or (0.0, 0.0)
    rx, ry = min(rx, 0.5 * width), min(ry, 0.5 * height)
    corners = np.array([(x + width, y), (x + width, y + height), (x, y + height), (x, y)])
    if not (rx and ry):
        outline.add("move", x, y)
        for corner in corners[:3].tolist():
            outline.add("line", *corner)
        outline.add("close")
        return outline
    inwards = np.array([(-rx, ry), (-rx, -ry), (rx, -ry), (rx, ry)])
    outline.add("move", x + rx, y)
    here = np.array([x + rx, y])
    for number, centre in enumerate(corners + inwards):
        curves = ellipse_arc(centre, (rx, ry), 90.0 * number - 90.0, 90.0, tolerance)
        if np.abs(curves[0, 0] - here).max() > 1e-12 * max(width, height):
            outline.add("line", *curves[0, 0].tolist())
        outline.cubics(curves)
        here = curves[-1, -1]
    outline.add("close")
    return outline


def _ellipse(size: Size, circle: bool, tolerance: float | None) -> Outline:
    outline = Outline()
    radius = size("r", "") if circle else None
    radii = (radius or 0.0, radius or 0.0) if circle else _radii(size)
    if radii is None or not (radii[0] > 0.0 and radii[1] > 0.0):
        return outline
    centre = (size("cx", "x") or 0.0, size("cy", "y") or 0.0)
    curves = ellipse_arc(centre, radii, 0.0, 360.0, tolerance)
    outline.add("move", *curves[0, 0].tolist())
    curves[-1, -1] = curves[0, 0]
    outline.cubics(curves)
    outline.add("close")
    return outline
