"""The third picture: what the panel's own pipeline draws, as wire-frame, by depth, or by how often pixels are drawn."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QEvent, QLineF, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QColor, QImage, QMouseEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QWidget

from ...model.pipeline.stages import divided
from ..theme import colours_now
from .flow import Flow
from .inks import inks_now

MODES = (
    ("wires", "Wire-frame", "The sides of the polygons that are drawn"),
    ("depth", "Depth", "What is in front at each pixel: the stronger, the nearer"),
    ("layers", "Overdraw", "How many polygons cover each pixel: the stronger, the more"),
)
MOST_SIDES = 10_000
SMOOTH = 2000
MARGIN = 6.0  # pixels
WAITING = "The pixels are worked out when the picture rests."
NOTHING = "Nothing is shown: add a solid, or show one."


class PixelsView(QWidget):
    """`pointed` carries words on the pixel under the pointer, "" for none; `clicked` the point (x, y, z) of the world
    that is in front at a pixel."""

    pointed = Signal(str)
    clicked = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName("What the panel's own pipeline draws")
        self.setToolTip("Point at a pixel for its fragments; a click follows what is in front there")
        self.setMouseTracking(True)
        self.setMinimumSize(180, 120)
        self.flow: Flow | None = None
        self.mode = "wires"
        self._image: QImage | None = None

    def show_flow(self, flow: Flow | None) -> None:
        self.flow = flow
        self._image = None
        self.update()

    def set_mode(self, mode: str) -> None:
        """One of MODES."""
        self.mode = mode
        self._image = None
        self.update()

    @property
    def frame(self) -> QRectF:
        """Where the picture stands in the widget."""
        width, height = self.flow.size if self.flow is not None else (3, 2)
        scale = min((self.width() - 2 * MARGIN) / width, (self.height() - 2 * MARGIN) / height)
        wide, high = max(width * scale, 1.0), max(height * scale, 1.0)
        return QRectF((self.width() - wide) / 2, (self.height() - high) / 2, wide, high)

    def to_pixel(self, place: QPointF) -> tuple[float, float]:
        """The pixel of the picture at a place of the widget."""
        frame = self.frame
        assert self.flow is not None
        width, height = self.flow.size
        return (place.x() - frame.x()) / frame.width() * width, (place.y() - frame.y()) / frame.height() * height

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        self.pointed.emit(self._words(event.position()))

    def leaveEvent(self, event: QEvent) -> None:
        self.pointed.emit("")

    def mousePressEvent(self, event: QMouseEvent) -> None:
        found = self._at(event.position()) if event.button() == Qt.MouseButton.LeftButton else None
        if found is not None and self.flow is not None and found[2]:
            column, row, _, depth = found
            point = self.flow.matrices.unprojected([(column + 0.5, row + 0.5, depth)])[0]
            self.clicked.emit(tuple(point.tolist()))

    def _at(self, place: QPointF) -> tuple[int, int, int, float] | None:
        """Column and row of the pixel at a place of the widget, its fragments, and the depth of the nearest; None
        outside, and while that is worked out."""
        if self.flow is None or self.flow.result is None or not self.frame.contains(place):
            return None
        x, y = self.to_pixel(place)
        row, column = min(int(y), self.flow.size[1] - 1), min(int(x), self.flow.size[0] - 1)
        raster = self.flow.result.raster
        return column, row, int(raster.layers[row, column]), float(raster.depth[row, column])

    def _words(self, place: QPointF) -> str:
        found = self._at(place)
        if found is None:
            return ""
        column, row, layers, depth = found
        words = f"Pixel {column}, {row}"
        if not layers:
            return f"{words}: background"
        return f"{words}: {layers} {'fragment' if layers == 1 else 'fragments'}, the nearest at depth {depth:.5f}"

    def paintEvent(self, event: QPaintEvent) -> None:
        painter, colours = QPainter(self), colours_now()
        painter.fillRect(self.rect(), QColor(colours.window))
        frame = self.frame
        if self.flow is None:
            self._say(painter, NOTHING)
            painter.end()
            return
        painter.fillRect(frame, QColor(colours.ground))
        painter.save()
        painter.setClipRect(frame)
        if self.mode == "wires":
            self._wires(painter, self.flow, frame)
        else:
            self._pixels(painter, self.flow, frame)
        self._vertex(painter, self.flow, frame)
        painter.restore()
        painter.setPen(QPen(QColor(colours.border), 1.0))
        painter.drawRect(frame)
        painter.end()

    def _say(self, painter: QPainter, words: str) -> None:
        painter.setPen(QColor(colours_now().muted))
        painter.drawText(QRectF(self.rect()), Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap, words)

    def _wires(self, painter: QPainter, flow: Flow, frame: QRectF) -> None:
        found = flow.drawn
        if found is None:
            self._say(painter, WAITING)
            return
        polygons = found.polygons
        place, counts = np.arange(polygons.corners.shape[1]), polygons.counts[:, None]
        used, after = place < counts, np.where(place + 1 < counts, place + 1, 0)
        with np.errstate(all="ignore"):
            corners = divided(polygons.corners @ flow.matrices.viewport.T)[..., :2]
        following = np.take_along_axis(corners, after[..., None], axis=1)
        sides = np.concatenate((corners[used], following[used]), axis=1)
        sides = sides[np.isfinite(sides).all(axis=1) & (np.abs(sides) < 1e6).all(axis=1)]
        if len(sides) > MOST_SIDES:
            sides = sides[np.linspace(0, len(sides) - 1, MOST_SIDES).astype(int)]
        scale = frame.width() / flow.size[0]
        sides = sides * scale + np.array((frame.x(), frame.y(), frame.x(), frame.y()))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, len(sides) <= SMOOTH)
        painter.setPen(QPen(QColor(inks_now().inside), 1.0))
        painter.drawLines([QLineF(*row) for row in sides.tolist()])

    def _pixels(self, painter: QPainter, flow: Flow, frame: QRectF) -> None:
        if self._image is None and flow.result is not None:
            self._image = self._drawn(flow)
        if self._image is None:
            self._say(painter, WAITING)
            return
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, True)
        painter.drawImage(frame, self._image)

    def _drawn(self, flow: Flow) -> QImage:
        """Shares from the ground's colour to the ink's."""
        assert flow.result is not None
        raster = flow.result.raster
        covered = raster.layers > 0
        if self.mode == "layers":
            share = raster.layers / max(float(raster.layers.max(initial=1)), 2.0)
        else:
            depths = raster.depth[covered]
            low, high = (float(depths.min()), float(depths.max())) if len(depths) else (0.0, 1.0)
            share = 1.0 - 0.85 * (raster.depth - low) / max(high - low, 1e-12)
        share = np.where(covered, np.clip(share, 0.0, 1.0), 0.0)[..., None]
        ground, ink = _rgb(colours_now().ground), _rgb(inks_now().inside if self.mode == "depth" else inks_now().cut)
        pixels = np.ascontiguousarray(np.round(ground + share * (ink - ground)).astype(np.uint8))
        height, width = pixels.shape[:2]
        return QImage(pixels.data, width, height, 3 * width, QImage.Format.Format_RGB888).copy()

    def _vertex(self, painter: QPainter, flow: Flow, frame: QRectF) -> None:
        """The pixel of the followed vertex, where no plane has cut it off."""
        point = flow.clip_point
        if point is None or point[3] <= 0.0 or (flow.planes @ point < 0.0).any():
            return
        x, y = divided(point @ flow.matrices.viewport.T)[:2]
        scale = frame.width() / flow.size[0]
        place = QPointF(frame.x() + x * scale, frame.y() + y * scale)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        painter.setPen(QPen(QColor(inks_now().ray), 2.0))
        for way in (QPointF(1.0, 0.0), QPointF(-1.0, 0.0), QPointF(0.0, 1.0), QPointF(0.0, -1.0)):
            painter.drawLine(place + way * 2.5, place + way * 8.0)


def _rgb(name: str) -> NDArray[np.float64]:
    colour = QColor(name)
    return np.array([colour.red(), colour.green(), colour.blue()], float)
