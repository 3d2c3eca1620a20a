"""Triangles drawn on a clear picture: sides and fill, or points where there are many."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QLineF, QPointF, QSize, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPen, QPolygonF

from .unwrapping import Sheet

AT_ONCE = 4000  # triangles that are drawn anew with every change of the view
MOST = 12_000  # that are drawn with their sides; of more, points are
MIRRORED, PLAIN, FLAT = "#d9822b", "#2f6fca", "#b3261e"


def layer_of(sheet: Sheet | None, corners: NDArray[np.float64], size: QSize, ratio: float, filled: bool) -> QImage:
    """The triangles of a sheet, at `corners` (t, 3, 2) in logical pixels of a picture of this size."""
    layer = QImage(round(size.width() * ratio), round(size.height() * ratio), QImage.Format.Format_ARGB32_Premultiplied)
    layer.setDevicePixelRatio(ratio)
    layer.fill(Qt.GlobalColor.transparent)
    if sheet is None or not len(corners):
        return layer
    low, high = corners.min(axis=1), corners.max(axis=1)
    seen = ((high >= 0.0) & (low <= (size.width(), size.height()))).all(axis=1)
    kinds = (
        (~sheet.facts.mirrored & ~sheet.facts.flat, PLAIN),
        (sheet.facts.mirrored, MIRRORED),
        (sheet.facts.flat, FLAT),
    )
    if int(seen.sum()) > MOST:
        for rows, colour in kinds:
            _scatter(layer, ratio * corners[rows & seen], QColor(colour))
        return layer
    painter = QPainter(layer)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, len(corners) <= AT_ONCE)
    for rows, colour in kinds:
        _draw(painter, corners[rows & seen], QColor(colour), filled, 2.0 if colour == FLAT else 1.0)
    painter.end()
    return layer


def _draw(painter: QPainter, corners: NDArray[np.float64], tint: QColor, filled: bool, width: float) -> None:
    if not len(corners):
        return
    if filled:
        tint.setAlpha(70)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(tint)
        for a, b, c in corners.tolist():
            painter.drawConvexPolygon(QPolygonF([QPointF(*a), QPointF(*b), QPointF(*c)]))
    tint.setAlpha(230)
    painter.setPen(QPen(tint, width))
    lines = corners[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 4)
    # Each side once, though both its triangles have it.
    keys = np.round(lines.reshape(-1, 2, 2) * 4.0).astype(np.int64)
    swapped = (keys[:, 0, 0] > keys[:, 1, 0]) | ((keys[:, 0, 0] == keys[:, 1, 0]) & (keys[:, 0, 1] > keys[:, 1, 1]))
    keys[swapped] = keys[swapped][:, ::-1]
    _, first = np.unique(keys.reshape(-1, 4), axis=0, return_index=True)
    painter.drawLines([QLineF(*line) for line in lines[first].tolist()])


def _scatter(layer: QImage, corners: NDArray[np.float64], colour: QColor) -> None:
    """Points of triangles (t, 3, 2), which are small where there are many: corners, middles of sides, middle."""
    sides = (corners + np.roll(corners, 1, axis=1)) / 2.0
    points = np.concatenate((corners, sides, corners.mean(axis=1, keepdims=True)), axis=1).reshape(-1, 2)
    column, row = np.floor(points).astype(np.int64).T
    within = (column >= 0) & (column < layer.width()) & (row >= 0) & (row < layer.height())
    words = np.frombuffer(layer.bits(), np.uint32).reshape(layer.height(), layer.bytesPerLine() // 4)
    words[row[within], column[within]] = colour.rgba()
