"""Outlines as Qt draws them."""

from __future__ import annotations

from PySide6.QtGui import QPainterPath

from ...model.path.path import Path


def painter_path(path: Path) -> QPainterPath:
    """The contours, y up, filled by the non-zero rule; B-splines do not occur in glyphs."""
    from PySide6.QtCore import Qt

    found = QPainterPath()
    found.setFillRule(Qt.FillRule.WindingFill)
    for contour in path.contours:
        rows = contour.points.tolist()
        found.moveTo(*rows[0])
        at = 1
        for kind in contour.kinds.tolist():
            flat = [number for row in rows[at : at + kind] for number in row]
            (found.lineTo, found.quadTo, found.cubicTo)[kind - 1](*flat)
            at += kind
        if contour.closed:
            found.closeSubpath()
    return found
