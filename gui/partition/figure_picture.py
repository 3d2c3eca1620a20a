"""The textbook's figure: objects and lines in the plane; an eye, its view cone and a point p, which can be dragged."""

from __future__ import annotations

import math

from PySide6.QtCore import QEvent, QPointF, Qt, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QWidget

from ...model.partition.figure import ALONG, ANGLE, EYE, HEIGHT, LINES, WIDTH, Point
from .figure_paint import FigurePainter

PROBE: Point = (30.0, 30.0)
MARGIN = 6.0  # pixels
REACH = 11.0  # pixels about a handle that catch the pointer
ARM, SIDE = 20.0, 27.0  # from the eye to the handle that turns it and to those that open the cone
NARROWEST, WIDEST = 4.0, 170.0  # degrees
ARROWS = {
    Qt.Key.Key_Left: (-1.0, 0.0),
    Qt.Key.Key_Right: (1.0, 0.0),
    Qt.Key.Key_Up: (0.0, 1.0),
    Qt.Key.Key_Down: (0.0, -1.0),
}

OPENING = (Qt.Key.Key_Plus, Qt.Key.Key_Equal, Qt.Key.Key_Minus)
ALT = Qt.KeyboardModifier.AltModifier


class FigurePicture(QWidget):
    """`changed` comes when the eye, the cone or p moved; `line_chosen` carries the name of a line that was clicked."""

    changed = Signal()
    line_chosen = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName("The textbook's figure")
        self.setToolTip(
            "Drag the eye, its direction, the sides of its cone, or the point p; click a line for its half-spaces.\n"
            "Arrow keys move p, with Shift the eye; Ctrl+arrows turn the view, + and \u2212 open and close the cone."
        )
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMinimumSize(160, 150)
        self.line = ""
        """The line whose half-spaces are tinted."""
        self.pruned: frozenset[str] = frozenset()
        self.order: tuple[str, ...] = ()
        """Objects that are drawn, from back to front."""
        self._held = ""
        self.hovered = ""
        self.reset()

    def reset(self) -> None:
        """The stored layout again."""
        self.eye, self.angle, self.probe = EYE, ANGLE, PROBE
        self.direction = math.atan2(ALONG[1], ALONG[0])  # radians
        self.changed.emit()
        self.update()

    def show_result(self, pruned: frozenset[str], order: tuple[str, ...]) -> None:
        """Which objects the cone prunes, and the others from back to front."""
        self.pruned, self.order = pruned, order
        self.update()

    def choose_line(self, name: str) -> None:
        self.line = name
        self.update()

    @property
    def forward(self) -> Point:
        return math.cos(self.direction), math.sin(self.direction)

    # From the figure's coordinates to the widget's.

    @property
    def scale(self) -> float:
        """Pixels a unit."""
        return max(min((self.width() - 2 * MARGIN) / WIDTH, (self.height() - 2 * MARGIN) / HEIGHT), 0.1)

    def to_widget(self, point: Point) -> QPointF:
        left, top = (self.width() - self.scale * WIDTH) / 2, (self.height() - self.scale * HEIGHT) / 2
        return QPointF(left + self.scale * point[0], top + self.scale * (HEIGHT - point[1]))

    def to_figure(self, place: QPointF) -> Point:
        origin = self.to_widget((0.0, HEIGHT))
        return (place.x() - origin.x()) / self.scale, HEIGHT - (place.y() - origin.y()) / self.scale

    def handles(self) -> dict[str, Point]:
        """What can be dragged, the first ones on top."""
        found = {"p": self.probe, "eye": self.eye, "turn": self._ahead(ARM, 0.0)}
        half = math.radians(self.angle) / 2
        return found | {"left": self._ahead(SIDE, half), "right": self._ahead(SIDE, -half)}

    def _ahead(self, distance: float, turned: float) -> Point:
        angle = self.direction + turned
        return self.eye[0] + distance * math.cos(angle), self.eye[1] + distance * math.sin(angle)

    # Mouse and keys.

    def _at(self, place: QPointF) -> str:
        near = {name: (self.to_widget(point) - place) for name, point in self.handles().items()}
        return next((name for name, way in near.items() if math.hypot(way.x(), way.y()) <= REACH), "")

    def _line_at(self, place: QPointF) -> str:
        point = self.to_figure(place)
        return next((line.name for line in LINES if abs(line.height(point)) * self.scale <= 5.0), "")

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self._held = self._at(event.position())
            if not self._held:
                self.line_chosen.emit(self._line_at(event.position()))

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self._held:
            self._drag(self._held, self.to_figure(event.position()))
            return
        hovered = self._at(event.position())
        over_line = not hovered and bool(self._line_at(event.position()))
        shape = Qt.CursorShape.OpenHandCursor if hovered else Qt.CursorShape.PointingHandCursor
        self.setCursor(shape) if hovered or over_line else self.unsetCursor()
        if hovered != self.hovered:
            self.hovered = hovered
            self.update()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        self._held = ""

    def _drag(self, name: str, point: Point) -> None:
        away = math.atan2(point[1] - self.eye[1], point[0] - self.eye[0])
        if name == "p":
            self.probe = _inside(point)
        elif name == "eye":
            self.eye = _inside(point)
        elif name == "turn":
            self.direction = away
        else:
            turned = math.remainder(away - self.direction, 2 * math.pi)
            self._open(math.degrees(2 * abs(turned)))
        self.changed.emit()
        self.update()

    def _open(self, angle: float) -> None:
        self.angle = min(max(angle, NARROWEST), WIDEST)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        key, held = Qt.Key(event.key()), event.modifiers()
        if key in ARROWS:
            x, y = ARROWS[key]
            if held & Qt.KeyboardModifier.ControlModifier:
                self.direction -= math.radians(4.0) * (x - y)
            elif held & Qt.KeyboardModifier.ShiftModifier:
                self.eye = _inside((self.eye[0] + x, self.eye[1] + y))
            else:
                self.probe = _inside((self.probe[0] + x, self.probe[1] + y))
        elif key in OPENING:
            self._open(self.angle + (-4.0 if key == Qt.Key.Key_Minus else 4.0))
        elif key == Qt.Key.Key_Home:
            self.reset()
            return
        else:
            super().keyPressEvent(event)
            return
        self.changed.emit()
        self.update()

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent) and self._has(event):
            event.accept()
            return True
        return super().event(event)

    def _has(self, event: QKeyEvent) -> bool:
        """Whether a key is the figure's own and not the window's."""
        return event.key() in (*ARROWS, *OPENING, Qt.Key.Key_Home) and not event.modifiers() & ALT

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        FigurePainter(self, painter).paint()
        painter.end()


def _inside(point: Point) -> Point:
    return min(max(point[0], 0.0), WIDTH), min(max(point[1], 0.0), HEIGHT)
