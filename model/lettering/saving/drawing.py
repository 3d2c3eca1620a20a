"""Our contours drawn by a fontTools pen."""

from __future__ import annotations

from typing import Any

from ...path.path import Path


def draw(outline: Path, pen: Any) -> None:
    """Every contour closed; contours that have lost their inside are left out."""
    for contour in outline.contours:
        points = [tuple(point) for point in contour.points.tolist()]
        if len(points) < 3:
            continue
        pen.moveTo(points[0])
        at = 1
        kinds = contour.kinds.tolist()
        for number, kind in enumerate(kinds):
            if not (number == len(kinds) - 1 and kind == 1):  # closing draws the last line
                (pen.lineTo, pen.qCurveTo, pen.curveTo)[kind - 1](*points[at : at + kind])
            at += kind
        pen.closePath()
