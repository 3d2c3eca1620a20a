"""A picture whose pixels can be looked at one by one: zoom, pan, a cursor, a grid where pixels are large."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, QSize, QSizeF, Qt, Signal
from PySide6.QtGui import QColor, QImage, QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QPen, QResizeEvent, QWheelEvent
from PySide6.QtWidgets import QWidget

from ..theme import colours_now

ZOOM = 1.25
NEAREST, FARTHEST = 64.0, 1 / 64  # logical pixels a texel
MARGIN = 8.0  # pixels around the cursor when it is brought into the view
SLACK = 3.0  # that the pointer may move in a click
GRID = 8.0  # from this size on pixels have lines between them
SQUARE = 8  # of the ground behind what is transparent
LIGHT_SQUARE, DARK_SQUARE = "#cdcdcd", "#a5a5a5"


def qimage(pixels: NDArray[np.uint8]) -> QImage:
    """Of (height, width, 3 or 4) bytes; it keeps its own copy."""
    data = np.ascontiguousarray(pixels)
    height, width, channels = data.shape
    kind = QImage.Format.Format_RGB888 if channels == 3 else QImage.Format.Format_RGBA8888
    return QImage(data.data, width, height, channels * width, kind).copy()


class PixelView(QWidget):
    """`pointed` tells the column and the row of the pixel that the cursor comes to."""

    pointed = Signal(int, int)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("pixels")
        self.setAccessibleName("Pixels")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMouseTracking(True)
        self.cursor_at: tuple[int, int] | None = None
        self.pinned = False
        """Whether a click holds the cursor, so that it does not follow the pointer."""
        self.marks: list[QRectF] = []
        """Parts of the picture, in pixels, that are outlined."""
        self._image: QImage | None = None
        self._scale, self._origin = 1.0, QPointF()
        self._fitted = True
        self._press = QPointF()
        self._last: QPointF | None = None
        self.setToolTip("A click holds the cursor at a pixel, another one there lets it go; drag to pan, wheel to zoom")

    @property
    def scale(self) -> float:
        """Logical pixels a texel."""
        return self._scale

    @property
    def size_in_pixels(self) -> tuple[int, int] | None:
        return None if self._image is None else (self._image.width(), self._image.height())

    def show_pixels(self, pixels: NDArray[np.uint8] | None) -> None:
        """(height, width, 3 or 4); another size is fitted into the view."""
        before = self.size_in_pixels
        self._image = None if pixels is None else qimage(pixels)
        if self.size_in_pixels != before:
            self.cursor_at, self.marks, self.pinned = None, [], False
            self.fit()
        self.update()

    def fit(self) -> None:
        """Show the whole picture; enlarged by whole steps only."""
        self._fitted = True
        if self._image is None or not self.width() or not self.height():
            return
        scale = min((self.width() - 16) / self._image.width(), (self.height() - 16) / self._image.height())
        self._scale = min(float(int(scale)), NEAREST) if scale > 1.0 else max(scale, FARTHEST)
        self.centre()

    def plain_size(self) -> None:
        """One texel a pixel of the screen."""
        self._fitted = False
        self._scale = 1.0 / self.devicePixelRatioF()
        self.centre()

    def centre(self) -> None:
        if self._image is not None:
            shown = QPointF(self._image.width(), self._image.height()) * self._scale
            self._origin = (QPointF(self.width(), self.height()) - shown) * 0.5
            self.update()

    def zoom(self, factor: float, about: QPointF | None = None) -> None:
        place = about if about is not None else QPointF(self.width() / 2, self.height() / 2)
        texel = (place - self._origin) / self._scale
        self._fitted = False
        self._scale = min(max(self._scale * factor, FARTHEST), NEAREST)
        self._origin = place - texel * self._scale
        self.update()

    def point_at(self, x: int, y: int) -> None:
        """Bring the cursor to a pixel."""
        size = self.size_in_pixels
        if size is None:
            return
        x, y = min(max(x, 0), size[0] - 1), min(max(y, 0), size[1] - 1)
        if self.cursor_at != (x, y):
            self.cursor_at = (x, y)
            self.pointed.emit(x, y)
        self.update()

    def _bring_into_view(self) -> None:
        """Shift the picture so that the cursor is seen."""
        if self.cursor_at is None:
            return
        frame = self._on_screen(QRectF(*self.cursor_at, 1, 1))
        right = min(self.width() - MARGIN - frame.right(), 0.0) + max(MARGIN - frame.left(), 0.0)
        down = min(self.height() - MARGIN - frame.bottom(), 0.0) + max(MARGIN - frame.top(), 0.0)
        if right or down:
            self._origin += QPointF(right, down)
            self._fitted = False
            self.update()

    def _pixel(self, place: QPointF) -> tuple[int, int] | None:
        size = self.size_in_pixels
        if size is None:
            return None
        at = (place - self._origin) / self._scale
        x, y = int(np.floor(at.x())), int(np.floor(at.y()))
        return (x, y) if 0 <= x < size[0] and 0 <= y < size[1] else None

    def _on_screen(self, part: QRectF) -> QRectF:
        return QRectF(self._origin + part.topLeft() * self._scale, part.size() * self._scale)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        colours = colours_now()
        painter.fillRect(self.rect(), QColor(colours.ground))
        if self._image is None:
            return
        whole = QRectF(0, 0, self._image.width(), self._image.height())
        shown = self._on_screen(whole)
        if self._image.hasAlphaChannel():
            _squares(painter, shown.intersected(QRectF(self.rect())))
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, self._scale < 1.0)
        shown.setSize(shown.size().expandedTo(QSizeF(1.0, 1.0)))  # a strip is seen
        painter.drawImage(shown, self._image, whole)
        if self._scale >= GRID:
            self._draw_grid(painter, whole)
        for mark in self.marks:
            self._outline(painter, mark, colours.accent, 2.0)
        if self.cursor_at is not None:
            x, y = self.cursor_at
            self._outline(painter, QRectF(x, y, 1, 1), colours.error, 2.0)
        painter.setPen(QPen(QColor(colours.accent if self.hasFocus() else colours.border), 1.0))
        painter.drawRect(self.rect().adjusted(0, 0, -1, -1))

    def _draw_grid(self, painter: QPainter, whole: QRectF) -> None:
        line = QColor(128, 128, 128, 110)
        painter.setPen(QPen(line, 1.0))
        seen = self._on_screen(whole).intersected(QRectF(self.rect()))
        first = (seen.topLeft() - self._origin) / self._scale
        last = (seen.bottomRight() - self._origin) / self._scale
        for x in range(int(first.x()), int(last.x()) + 1):
            at = self._origin.x() + self._scale * x
            painter.drawLine(QPointF(at, seen.top()), QPointF(at, seen.bottom()))
        for y in range(int(first.y()), int(last.y()) + 1):
            at = self._origin.y() + self._scale * y
            painter.drawLine(QPointF(seen.left(), at), QPointF(seen.right(), at))

    def _outline(self, painter: QPainter, part: QRectF, colour: str, width: float) -> None:
        frame = self._on_screen(part)
        if min(frame.width(), frame.height()) < 5.0:  # so that it is seen
            frame = frame.adjusted(-3, -3, 3, 3)
        painter.setPen(QPen(QColor("white"), width + 2.0))
        painter.drawRect(frame)
        painter.setPen(QPen(QColor(colour), width))
        painter.drawRect(frame)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self._press = self._last = event.position()
        self.setCursor(Qt.CursorShape.ClosedHandCursor)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self._last is not None and event.buttons() != Qt.MouseButton.NoButton:
            self._origin += event.position() - self._last
            self._last = event.position()
            self._fitted = False
            self.update()
            return
        pixel = self._pixel(event.position())
        if pixel is not None and not self.pinned:
            self.point_at(*pixel)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        self._last = None
        self.unsetCursor()
        pixel = self._pixel(event.position())
        if pixel is not None and (event.position() - self._press).manhattanLength() <= SLACK:
            self.pinned = not (self.pinned and pixel == self.cursor_at)
            self.point_at(*pixel)

    def wheelEvent(self, event: QWheelEvent) -> None:
        self.zoom(ZOOM ** (event.angleDelta().y() / 120.0), event.position())
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        ways = {Qt.Key.Key_Left: (-1, 0), Qt.Key.Key_Right: (1, 0), Qt.Key.Key_Up: (0, -1), Qt.Key.Key_Down: (0, 1)}
        key = Qt.Key(event.key())
        if key in ways:
            x, y = self.cursor_at or (0, 0)
            far = 10 if event.modifiers() & Qt.KeyboardModifier.ShiftModifier else 1
            self.point_at(x + far * ways[key][0], y + far * ways[key][1])
            self._bring_into_view()
        elif key in (Qt.Key.Key_Plus, Qt.Key.Key_Equal):
            self.zoom(ZOOM)
        elif key == Qt.Key.Key_Minus:
            self.zoom(1.0 / ZOOM)
        elif key in (Qt.Key.Key_0, Qt.Key.Key_F):
            self.fit()
        elif key == Qt.Key.Key_1:
            self.plain_size()
        else:
            super().keyPressEvent(event)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        if self._fitted:
            self.fit()

    def sizeHint(self) -> QSize:
        return QSize(560, 480)

    def minimumSizeHint(self) -> QSize:
        return QSize(200, 160)


def _squares(painter: QPainter, area: QRectF) -> None:
    """The ground by which transparency is known."""
    painter.save()
    painter.setClipRect(area)
    painter.fillRect(area, QColor(LIGHT_SQUARE))
    left, top = int(area.left() // SQUARE), int(area.top() // SQUARE)
    for row in range(top, int(area.bottom() // SQUARE) + 1):
        for column in range(left, int(area.right() // SQUARE) + 1):
            if (row + column) % 2:
                painter.fillRect(column * SQUARE, row * SQUARE, SQUARE, SQUARE, QColor(DARK_SQUARE))
    painter.restore()
