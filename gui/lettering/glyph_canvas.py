"""The canvas on which a glyph's own control points are moved, over the lines of its font's metrics."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QFocusEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QResizeEvent,
    QTransform,
    QWheelEvent,
)
from PySide6.QtWidgets import QWidget

from ...model.document.errors import Refusal
from ...model.lettering.fonts.drawn_glyph import DrawnGlyph
from ...model.path.nodes import move_handle
from ...model.path.path import Path
from ..curves.editing.edit_keys import ALT, ARROWS, CONTROL, SHIFT
from ..theme import colours_now
from . import glyph_edits
from .glyph_desk import GlyphDesk, Place
from .glyph_picture import Shown, draw_metrics, draw_outline, draw_points, handle_rows

REACH = 8.0  # logical pixels within which a point is caught
SIDE = 5.0
MARGIN = 0.12  # of the canvas, around a glyph that is fitted
NEAREST, FARTHEST = 1e-3, 100.0  # pixels a font unit
HINT = (
    "Drag nodes, handles and the right side bearing; Shift adds to the choice or keeps a drag straight. "
    "Double-click the outline for a node, wheel to zoom, middle button to pan, F to fit."
)


class GlyphCanvas(QWidget):
    """Coordinates are whole font units where Alt is not held. `chosen_changed` tells another choice of nodes."""

    chosen_changed = Signal()

    def __init__(self, desk: GlyphDesk, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.desk = desk
        self.setObjectName("glyph_canvas")
        self.setAccessibleName("Glyph")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMouseTracking(True)
        self.setToolTip("")
        self.chosen: frozenset[Place] = frozenset()
        self.before = True
        """Whether the glyph as the font's file has it is shown below."""
        self._scale, self._origin = 0.1, QPointF(0.0, 0.0)
        self._fitted = False
        self._hovered: tuple[int, int] | None = None
        self._drag: str = ""  # "nodes", "handle", "advance", "pan", "band"
        self._handle: tuple[int, int] = (0, 0)
        self._pressed, self._last = QPointF(), QPointF()
        self._start: DrawnGlyph | None = None
        self._kept: frozenset[Place] = frozenset()
        desk.glyph_changed.connect(self._glyph)
        desk.changed.connect(self._changed)

    def sizeHint(self) -> QSize:
        return QSize(560, 460)

    # Where things are.

    def to_screen(self, x: float, y: float) -> QPointF:
        return QPointF(self._origin.x() + self._scale * x, self._origin.y() - self._scale * y)

    def to_units(self, place: QPointF) -> tuple[float, float]:
        return (place.x() - self._origin.x()) / self._scale, (self._origin.y() - place.y()) / self._scale

    def fit(self) -> None:
        """Show the whole glyph between the font's ascender and descender."""
        face, drawn = self.desk.face, self.desk.drawn
        if face is None or drawn is None:
            return
        left, low, right, high = 0.0, face.metrics.descender, max(drawn.advance, 1.0), face.metrics.ascender
        if drawn.outline.contours:
            (x, y), (far, top) = drawn.outline.bounds().tolist()
            left, low, right, high = min(left, x), min(low, y), max(right, far), max(high, top)
        width, height = max(right - left, 1.0), max(high - low, 1.0)
        room = 1.0 - 2.0 * MARGIN
        self._scale = max(min(room * self.width() / width, room * self.height() / height), NEAREST)
        middle = QPointF(0.5 * (left + right), 0.5 * (low + high))
        self._origin = QPointF(
            0.5 * self.width() - self._scale * middle.x(), 0.5 * self.height() + self._scale * middle.y()
        )
        self._fitted = True
        self.update()

    def _glyph(self) -> None:
        self._drag, self._hovered = "", None
        self.choose(())
        self.fit()

    def _changed(self) -> None:
        drawn = self.desk.drawn
        counts = [len(c.nodes) for c in drawn.outline.contours] if drawn is not None else []
        left = frozenset((c, n) for c, n in self.chosen if c < len(counts) and n < counts[c])
        if left != self.chosen:
            self.choose(left)
        self.chosen_changed.emit()  # their places are others
        self.update()

    def choose(self, places: Iterable[Place]) -> None:
        self.chosen = frozenset(places)
        self.chosen_changed.emit()
        self.update()

    def choose_all(self) -> None:
        drawn = self.desk.drawn
        contours = drawn.outline.contours if drawn is not None else ()
        self.choose((c, n) for c, contour in enumerate(contours) for n in range(len(contour.nodes)))

    def set_before(self, shown: bool) -> None:
        self.before = shown
        self.update()

    # Pictures.

    def paintEvent(self, event: QPaintEvent) -> None:
        colours = colours_now()
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.fillRect(self.rect(), QColor(colours.ground))
        face, drawn = self.desk.face, self.desk.drawn
        if face is None or drawn is None:
            painter.setPen(QColor(colours.muted))
            room = self.rect().adjusted(40, 0, -40, 0)
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.drawText(room, int(flags), self.desk.fault or "Choose a glyph")
            return
        shown = Shown(face, drawn, self._own() if self.before else None, self.chosen, self._hovered)
        draw_metrics(painter, shown, self.to_screen, QRectF(self.rect()), colours)
        transform = QTransform(self._scale, 0, 0, -self._scale, self._origin.x(), self._origin.y())
        draw_outline(painter, shown, transform, colours)
        draw_points(painter, shown, self.to_screen, colours)
        if not drawn.outline.contours:
            painter.setPen(QColor(colours.muted))
            painter.drawText(self.rect(), Qt.AlignmentFlag.AlignCenter, "This glyph is empty")
        if self._drag == "band":
            painter.setPen(QPen(QColor(colours.accent), 1.0, Qt.PenStyle.DashLine))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRect(QRectF(self._pressed, self._last).normalized())

    def _own(self) -> DrawnGlyph | None:
        """The glyph as the font's file has it, where that is another one."""
        plain, glyph = self.desk.plain, self.desk.glyph
        if plain is None or (glyph not in self.desk.edited and self.desk.live is None):
            return None
        try:
            return DrawnGlyph(plain.outline(glyph), plain.advance(glyph))
        except Refusal:
            return None

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self.fit()

    # The mouse.

    def _point_at(self, place: QPointF) -> tuple[int, int, bool] | None:
        """Contour and row of the nearest point within reach, and whether it is a node; nodes come first."""
        drawn = self.desk.drawn
        best: tuple[float, tuple[int, int, bool]] | None = None
        for number, contour in enumerate(drawn.outline.contours if drawn is not None else ()):
            nodes = contour.starts[: len(contour.nodes)].tolist()
            for rows, node in ((nodes, True), (handle_rows(contour), False)):
                for row in rows:
                    here = self.to_screen(*contour.points[row].tolist())
                    off = abs(here.x() - place.x()) + abs(here.y() - place.y()) - (2.0 if node else 0.0)
                    if off <= REACH and (best is None or off < best[0]):
                        best = off, (number, int(row), node)
        return best[1] if best is not None else None

    def _on_advance(self, place: QPointF) -> bool:
        drawn = self.desk.drawn
        return drawn is not None and abs(self.to_screen(drawn.advance, 0.0).x() - place.x()) <= SIDE

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self._pressed = self._last = event.position()
        self._start, self._kept = self.desk.drawn, self.chosen
        held = event.modifiers()
        if event.button() == Qt.MouseButton.MiddleButton:
            self._drag = "pan"
            return
        if event.button() != Qt.MouseButton.LeftButton or self._start is None:
            return
        found = self._point_at(event.position())
        if found is None:
            self._drag = "advance" if self._on_advance(event.position()) else "band"
            if self._drag == "band" and not held & SHIFT:
                self.choose(())
                self._kept = frozenset()
            return
        contour, row, node = found
        if not node:
            self._drag, self._handle = "handle", (contour, row)
            return
        place = contour, int(np.flatnonzero(self._start.outline.contours[contour].starts == row)[0])
        if held & SHIFT:
            self.choose(self.chosen ^ {place})
        elif place not in self.chosen:
            self.choose((place,))
        self._drag = "nodes" if place in self.chosen else ""

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        place = event.position()
        if not self._drag:
            found = self._point_at(place)
            self._hovered = None if found is None else found[:2]
            side = found is None and self._on_advance(place)
            self.setCursor(Qt.CursorShape.SizeHorCursor if side else Qt.CursorShape.ArrowCursor)
            self.update()
            return
        if self._drag == "pan":
            self._origin += place - self._last
            self._last = place
            self.update()
            return
        self._last = place
        if self._drag == "band":
            self._band()
            return
        try:
            self._drag_to(place, event.modifiers())
        except Refusal as refusal:
            self.desk.refused.emit(str(refusal))

    def _drag_to(self, place: QPointF, held: Qt.KeyboardModifier) -> None:
        start = self._start
        if start is None:
            return
        by = (place - self._pressed) / self._scale
        dx, dy = by.x(), -by.y()
        if held & SHIFT:
            dx, dy = (dx, 0.0) if abs(dx) >= abs(dy) else (0.0, dy)
        whole = not held & ALT
        if self._drag == "advance":
            wide = start.advance + dx
            self.desk.preview(start.outline, float(round(wide)) if whole else wide)
        elif self._drag == "handle":
            contour, row = self._handle
            x, y = start.outline.contours[contour].points[row].tolist()
            to = np.array((x + dx, y + dy))
            moved = move_handle(start.outline.contours[contour], row, np.round(to) if whole else to)
            self.desk.preview(_with(start.outline, contour, moved))
        else:
            step = np.array((dx, dy))
            self.desk.preview(glyph_edits.moved(start.outline, self.chosen, np.round(step) if whole else step))

    def _band(self) -> None:
        drawn, box = self._start, QRectF(self._pressed, self._last).normalized()
        if drawn is None:
            return
        inside = {
            (number, place)
            for number, contour in enumerate(drawn.outline.contours)
            for place, point in enumerate(contour.points[contour.starts[: len(contour.nodes)]].tolist())
            if box.contains(self.to_screen(*point))
        }
        self.choose(self._kept | inside)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        drag, self._drag = self._drag, ""
        words = {"nodes": "Move nodes", "handle": "Move handle", "advance": "Change width"}
        if drag in words:
            self.desk.keep(words[drag])
        self.update()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        drawn = self.desk.drawn
        if event.button() != Qt.MouseButton.LeftButton or drawn is None or self._point_at(event.position()) is not None:
            return
        found = glyph_edits.place_on(drawn.outline, self.to_units(event.position()), REACH / self._scale)
        if found is not None:
            contour, segment, share = found
            self.desk.put("Insert node", glyph_edits.inserted(drawn.outline, contour, segment, share))
            self.choose(((contour, segment + 1),))

    def wheelEvent(self, event: QWheelEvent) -> None:
        place = event.position()
        x, y = self.to_units(place)
        self._scale = min(max(self._scale * 1.0015 ** event.angleDelta().y(), NEAREST), FARTHEST)
        self._origin = QPointF(place.x() - self._scale * x, place.y() + self._scale * y)
        self.update()
        event.accept()

    # Keys.

    def keyPressEvent(self, event: QKeyEvent) -> None:
        key, held = event.key(), event.modifiers()
        if key in ARROWS and self.chosen:
            length = 10.0 if held & SHIFT else 0.1 if held & ALT else 1.0
            drawn = self.desk.drawn
            if drawn is not None:
                by = length * np.array(ARROWS[Qt.Key(key)])
                self.desk.put("Move nodes", glyph_edits.moved(drawn.outline, self.chosen, by))
        elif key == Qt.Key.Key_Escape and (self._drag or self.chosen):
            if self._drag:
                self._drag = ""
                self.desk.cancel()
            else:
                self.choose(())
        elif key == Qt.Key.Key_A and held == CONTROL:
            self.choose_all()
        else:
            super().keyPressEvent(event)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        self._hovered = None
        self.update()


def _with(outline: Path, number: int, contour: object) -> Path:
    contours = list(outline.contours)
    contours[number] = contour  # type: ignore[assignment]
    return replace(outline, contours=tuple(contours))
