"""Pictures in a row that turn together under the pointer, with their names above them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRect, QSize, Qt, QTimer, Signal
from PySide6.QtGui import QImage, QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QResizeEvent, QWheelEvent
from PySide6.QtWidgets import QWidget

from ..theme import colours_now

if TYPE_CHECKING:
    from ...render.camera import Camera

Picture = NDArray[np.uint8]

TURN = 0.5  # degrees a pixel of a drag
STEP = 5.0  # degrees for an arrow key
ZOOM = 1.1
NAMES = 26  # pixels above the pictures
GAP = 2


class Board(QWidget):
    """`draw` gives the pictures, each of the size in device pixels that it is called with; `frame` how the model is
    fitted into one of them."""

    drawn = Signal()

    def __init__(
        self,
        draw: Callable[[Camera, tuple[int, int]], Sequence[Picture]],
        frame: Callable[[float], Camera],
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self._draw, self._frame = draw, frame
        self.names: tuple[str, ...] = ()
        self.pictures: Sequence[Picture] = ()
        self.camera: Camera | None = None
        self._last: QPointF | None = None
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self._redraw)
        self.setObjectName("board")
        self.setAccessibleName("The model under several shadings")
        self.setToolTip("Drag or arrow keys turn all of them, the wheel zooms, Home fits")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setCursor(Qt.CursorShape.OpenHandCursor)

    def show_names(self, names: Sequence[str]) -> None:
        """Of the columns, from left to right."""
        self.names = tuple(names)
        self.redraw()

    def redraw(self) -> None:
        """Draw soon; many calls in one pass of the event loop draw once."""
        if not self._timer.isActive():
            self._timer.start(0)

    def fit(self) -> None:
        self.camera = None
        self.redraw()

    def column(self, place: int) -> QRect:
        """Where a picture is, in logical pixels."""
        count = max(len(self.names), 1)
        left, right = place * self.width() // count, (place + 1) * self.width() // count
        return QRect(left, NAMES, right - left - GAP, self.height() - NAMES)

    def _redraw(self) -> None:
        ratio = self.devicePixelRatioF()
        cell = self.column(0)
        size = (max(round(cell.width() * ratio), 1), max(round(cell.height() * ratio), 1))
        if not self.isVisible() or not self.names:
            return
        if self.camera is None:
            self.camera = self._frame(size[0] / size[1])
        self.pictures = self._draw(self.camera, size)
        self.update()
        self.drawn.emit()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setPen(colours_now().text)
        for place, name in enumerate(self.names):
            cell = self.column(place)
            painter.drawText(QRect(cell.x(), 0, cell.width(), NAMES), Qt.AlignmentFlag.AlignCenter, name)
        for place, picture in enumerate(self.pictures[: len(self.names)]):
            height, width = picture.shape[:2]
            painter.drawImage(
                self.column(place), QImage(picture.data, width, height, 3 * width, QImage.Format.Format_RGB888)
            )
        if self.hasFocus():
            painter.setPen(colours_now().accent)
            painter.drawRect(self.rect().adjusted(0, NAMES - 1, -1 - GAP, -1))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self._last = event.position()
        self.setCursor(Qt.CursorShape.ClosedHandCursor)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self._last is not None:
            way = event.position() - self._last
            self._last = event.position()
            self._turn(TURN * way.x(), TURN * way.y())

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        self._last = None
        self.setCursor(Qt.CursorShape.OpenHandCursor)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        self.fit()

    def wheelEvent(self, event: QWheelEvent) -> None:
        self._nearer(ZOOM ** (event.angleDelta().y() / 120.0))
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        key = event.key()
        ways = {Qt.Key.Key_Left: (-STEP, 0.0), Qt.Key.Key_Right: (STEP, 0.0),
                Qt.Key.Key_Up: (0.0, -STEP), Qt.Key.Key_Down: (0.0, STEP)}  # fmt: skip
        if key in ways:
            self._turn(*ways[Qt.Key(key)])
        elif key in (Qt.Key.Key_Plus, Qt.Key.Key_Equal, Qt.Key.Key_Minus):
            self._nearer(1.0 / ZOOM if key == Qt.Key.Key_Minus else ZOOM)
        elif key == Qt.Key.Key_Home:
            self.fit()
        else:
            super().keyPressEvent(event)

    def _turn(self, right: float, down: float) -> None:
        from ...render.camera import orbit

        if self.camera is not None:
            self.camera = orbit(self.camera, right, down)
            self.redraw()

    def _nearer(self, factor: float) -> None:
        from ...render.camera import zoom

        if self.camera is not None:
            self.camera = zoom(self.camera, factor)
            self.redraw()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self.redraw()

    def sizeHint(self) -> QSize:
        return QSize(960, 300)

    def minimumSizeHint(self) -> QSize:
        return QSize(400, 160)
