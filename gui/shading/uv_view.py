"""Triangles over the bitmap that they wear: pan, zoom, point, shift the bitmap."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, QTimer, Signal
from PySide6.QtGui import (
    QColor,
    QImage,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPolygonF,
    QResizeEvent,
    QTransform,
    QWheelEvent,
)
from PySide6.QtWidgets import QWidget

from ...model.surface.unwrapped import triangles_at
from ..bitmap.pixel_view import qimage
from ..theme import colours_now
from .unwrapping import Sheet
from .uv_layer import AT_ONCE, layer_of

ZOOM = 1.2
NEAREST, FARTHEST = 1e5, 1.0  # logical pixels for one copy of the bitmap
COPIES = 8  # on each side that are drawn at most
FAINT = 0.35  # of the copies around the bitmap itself
SLACK = 4.0  # pixels the pointer may move in a click
QUIET = 60  # milliseconds after which more are


class UvView(QWidget):
    """`pointed` tells the triangle under the pointer, -1 for none; `clicked` one that is clicked. `shifted` tells by
    how much the triangles are dragged, in copies (u, v), and whether the drag has ended; `scaled` a factor."""

    pointed = Signal(int)
    clicked = Signal(int)
    shifted = Signal(float, float, bool)
    scaled = Signal(float)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("uv_view")
        self.setAccessibleName("Texture coordinates")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMouseTracking(True)
        self.filled = True
        self._sheet: Sheet | None = None
        self._bitmap: QImage | None = None
        self._scale, self._origin = 200.0, QPointF()
        self._fitted = True
        self._hovered = -1
        self._press: QPointF | None = None
        self._last = QPointF()
        self._shifting = self._moved = False
        self._layer: QImage | None = None
        self._layer_view = (1.0, QPointF())
        self._quiet = QTimer(self)
        self._quiet.setSingleShot(True)
        self._quiet.timeout.connect(self._draw_layer)

    def show_sheet(self, sheet: Sheet | None) -> None:
        fresh = self._sheet is None
        if sheet is None or self._sheet is None or sheet.texels is not self._sheet.texels:
            self._bitmap = None if sheet is None or sheet.texels is None else qimage(sheet.texels)
        self._sheet, self._hovered = sheet, -1
        if fresh or self._fitted:
            self.fit()
        self._drop_layer()

    def set_filled(self, filled: bool) -> None:
        self.filled = filled
        self._drop_layer()

    def fit(self) -> None:
        """Show all triangles, and one copy of the bitmap at least."""
        self._fitted = True
        low, high = np.zeros(2), np.ones(2)
        if self._sheet is not None and len(self._sheet.coordinates):
            flat = self._sheet.coordinates.reshape(-1, 2)
            low, high = np.minimum(low, flat.min(axis=0)), np.maximum(high, flat.max(axis=0))
        span = np.maximum(high - low, 1e-6)
        self._scale = float(min(0.92 * self.width() / span[0], 0.92 * self.height() / span[1]))
        self._scale = min(max(self._scale, FARTHEST), NEAREST)
        middle = (low + high) / 2.0
        self._origin = QPointF(self.width() / 2 - self._scale * middle[0], self.height() / 2 + self._scale * middle[1])
        self._drop_layer()

    def to_uv(self, place: QPointF) -> tuple[float, float]:
        return (place.x() - self._origin.x()) / self._scale, (self._origin.y() - place.y()) / self._scale

    def to_screen(self, u: float, v: float) -> QPointF:
        return QPointF(self._origin.x() + self._scale * u, self._origin.y() - self._scale * v)

    def _pixels(self, coordinates: NDArray[np.float64]) -> NDArray[np.float64]:
        return coordinates * (self._scale, -self._scale) + (self._origin.x(), self._origin.y())

    # Drawing.

    def _drop_layer(self) -> None:
        self._layer = None
        self.update()

    def _view_changed(self) -> None:
        if self._sheet is not None and len(self._sheet.coordinates) > AT_ONCE and self._layer is not None:
            self._quiet.start(QUIET)
            self.update()
        else:
            self._drop_layer()

    def _draw_layer(self) -> None:
        corners = np.zeros((0, 3, 2)) if self._sheet is None else self._pixels(self._sheet.coordinates)
        self._layer = layer_of(self._sheet, corners, self.size(), self.devicePixelRatioF(), self.filled)
        self._layer_view = (self._scale, QPointF(self._origin))
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        colours = colours_now()
        painter.fillRect(self.rect(), QColor(colours.ground))
        self._draw_bitmap(painter)
        if self._layer is None:
            self._draw_layer()
        assert self._layer is not None
        scale, origin = self._layer_view
        if scale == self._scale and origin == self._origin:
            painter.drawImage(QPointF(), self._layer)
        else:
            painter.save()
            factor = self._scale / scale
            painter.setTransform(QTransform(factor, 0, 0, factor, self._origin.x() - factor * origin.x(),
                                            self._origin.y() - factor * origin.y()), True)  # fmt: skip
            painter.drawImage(QPointF(), self._layer)
            painter.restore()
        painter.setPen(QPen(QColor(colours.text), 1.0))
        painter.drawRect(QRectF(self.to_screen(0.0, 1.0), self.to_screen(1.0, 0.0)))
        for u, v, words in ((0.0, 0.0, "0, 0"), (1.0, 1.0, "1, 1")):
            painter.drawText(self.to_screen(u, v) + QPointF(3, 13 if v == 0.0 else -4), words)
        if self._sheet is not None and 0 <= self._hovered < len(self._sheet.coordinates):
            lit = self._pixels(self._sheet.coordinates[self._hovered])
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setPen(QPen(QColor(colours.error), 2.0))
            painter.setBrush(QColor(255, 255, 255, 90))
            painter.drawPolygon(QPolygonF([QPointF(*corner) for corner in lit.tolist()]))

    def _draw_bitmap(self, painter: QPainter) -> None:
        if self._bitmap is None:
            return
        (left, bottom), (right, top) = self.to_uv(QPointF(0, self.height())), self.to_uv(QPointF(self.width(), 0))
        wrap = "repeat" if self._sheet is None else self._sheet.wrap
        first, last = max(int(np.floor(left)), -COPIES), min(int(np.floor(right)), COPIES)
        low, high = max(int(np.floor(bottom)), -COPIES), min(int(np.floor(top)), COPIES)
        if wrap == "clamp":
            first = last = low = high = 0
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, self._scale < 2 * self._bitmap.width())
        for column in range(first, last + 1):
            for row in range(low, high + 1):
                painter.setOpacity(1.0 if (column, row) == (0, 0) else FAINT)
                image = self._bitmap
                if wrap == "mirror" and (column % 2 or row % 2):
                    flip = Qt.Orientation.Horizontal if column % 2 else Qt.Orientation(0)
                    if row % 2:
                        flip |= Qt.Orientation.Vertical
                    image = image.flipped(flip)
                painter.drawImage(QRectF(self.to_screen(column, row + 1), self.to_screen(column + 1, row)), image)
        painter.setOpacity(1.0)

    # Hands.

    def _find(self, place: QPointF) -> int:
        if self._sheet is None or not len(self._sheet.coordinates):
            return -1
        found = triangles_at(self._sheet.coordinates, np.array(self.to_uv(place)))
        return int(found[0]) if len(found) else -1

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self._press = self._last = event.position()
        self._moved = False
        self._shifting = (
            event.button() == Qt.MouseButton.LeftButton and event.modifiers() == Qt.KeyboardModifier.ShiftModifier
        )

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        place = event.position()
        if self._press is None:
            self._hover(self._find(place))
            return
        if (place - self._press).manhattanLength() > SLACK:
            self._moved = True
        if not self._moved:
            return
        if self._shifting:
            way = place - self._press
            self.shifted.emit(way.x() / self._scale, -way.y() / self._scale, False)
        else:
            self._origin += place - self._last
            self._fitted = False
            self._view_changed()
        self._last = place

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        press, self._press = self._press, None
        if press is None:
            return
        if self._shifting and self._moved:
            way = event.position() - press
            self.shifted.emit(way.x() / self._scale, -way.y() / self._scale, True)
        elif not self._moved and event.button() == Qt.MouseButton.LeftButton:
            self.clicked.emit(self._find(event.position()))

    def wheelEvent(self, event: QWheelEvent) -> None:
        factor = ZOOM ** (event.angleDelta().y() / 120.0)
        if event.modifiers() & Qt.KeyboardModifier.ControlModifier:
            self.scaled.emit(factor)
        else:
            self._zoom(factor, event.position())
        event.accept()

    def _zoom(self, factor: float, about: QPointF) -> None:
        u, v = self.to_uv(about)
        self._fitted = False
        self._scale = min(max(self._scale * factor, FARTHEST), NEAREST)
        self._origin = QPointF(about.x() - self._scale * u, about.y() + self._scale * v)
        self._view_changed()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        middle = QPointF(self.width() / 2, self.height() / 2)
        match event.key():
            case Qt.Key.Key_Plus | Qt.Key.Key_Equal:
                self._zoom(ZOOM, middle)
            case Qt.Key.Key_Minus:
                self._zoom(1.0 / ZOOM, middle)
            case Qt.Key.Key_Home | Qt.Key.Key_F | Qt.Key.Key_0:
                self.fit()
            case _:
                super().keyPressEvent(event)

    def leaveEvent(self, event: object) -> None:
        self._hover(-1)

    def _hover(self, triangle: int) -> None:
        if triangle != self._hovered:
            self._hovered = triangle
            self.pointed.emit(triangle)
            self.update()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        if self._fitted:
            self.fit()
        self._drop_layer()

    def sizeHint(self) -> QSize:
        return QSize(640, 560)

    def minimumSizeHint(self) -> QSize:
        return QSize(240, 200)
