"""How a knot line looks: basis functions in the colours of their control points, and stacks of markers below."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPaintDevice, QPainter, QPen, QPolygonF

from ...theme import LIGHT, colours_now

if TYPE_CHECKING:
    from ....model.outline.basis import Basis

SIDE, TOP = 12, 8  # room beside and above the functions, in logical pixels
MARKERS, BELOW = 40, 16  # room for the markers, and for numbers below these
RADIUS, STEP = 4.0, 9.0  # of a marker, and from one to the next below


@dataclass(frozen=True, slots=True)
class Room:
    """Where parameters and weights lie in a knot line."""

    low: float
    high: float
    left: float
    right: float
    top: float
    line: float  # height of the line, where weights are 0
    bottom: float

    @classmethod
    def of(cls, area: QRectF, basis: Basis) -> Room:
        low, high = float(basis.knots[0]), float(basis.knots[-1])
        line = area.bottom() - MARKERS - BELOW
        return cls(low, high, area.left() + SIDE, max(area.right() - SIDE, area.left() + SIDE + 10),
                   area.top() + TOP, line, area.bottom())  # fmt: skip

    @property
    def scale(self) -> float:
        """Pixels for each unit of the parameter."""
        return (self.right - self.left) / (self.high - self.low)

    @property
    def step(self) -> float:
        """Of the parameter, for each pixel."""
        return 1.0 / self.scale

    def x(self, parameter: Any) -> Any:
        return self.left + (parameter - self.low) * self.scale

    def parameter(self, x: float) -> float:
        return self.low + (x - self.left) / self.scale

    def y(self, weight: Any) -> Any:
        return self.line + weight * (self.top - self.line)

    def marker(self, basis: Basis, row: int, place: int) -> QPointF:
        """The middle of one of a stack's markers, from the top; many stand closer."""
        stack = basis.stacks[row]
        step = min(STEP, (MARKERS - 3 * RADIUS) / max(len(stack.numbers) - 1, 1))
        return QPointF(self.x(stack.value), self.line + 2 * RADIUS + place * step)


@dataclass(frozen=True, slots=True)
class Look:
    """What is told from the rest: the focused knot, the control points hovered over and chosen, and locked knots."""

    focused: int
    hovered: int | None
    chosen: frozenset[int]
    locked: frozenset[int]
    keyboard: bool


def paint(device: QPaintDevice, room: Room, basis: Basis, look: Look) -> None:
    painter = QPainter(device)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    _paint_ground(painter, room, basis)
    painter.save()
    painter.setClipRect(QRectF(0.0, 0.0, room.right + SIDE, room.bottom))
    _paint_functions(painter, room, basis, look)
    painter.restore()
    _paint_knots(painter, room, basis, look)
    painter.end()


def _paint_ground(painter: QPainter, room: Room, basis: Basis) -> None:
    colours = colours_now()
    start, end = (room.x(one) for one in basis.domain)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(colours.ground))
    painter.drawRect(QRectF(start, room.top, end - start, room.line - room.top))
    painter.setPen(QPen(QColor(colours.border), 1))
    painter.drawLine(QPointF(start, room.top), QPointF(end, room.top))
    for stack in basis.stacks:
        x = room.x(stack.value)
        painter.drawLine(QPointF(x, room.top), QPointF(x, room.line))
    painter.setPen(QPen(QColor(colours.muted), 1))
    first, last = room.x(float(basis.knots[0])), room.x(float(basis.knots[-1]))
    painter.drawLine(QPointF(first, room.line), QPointF(last, room.line))


def _paint_functions(painter: QPainter, room: Room, basis: Basis, look: Look) -> None:
    import numpy as np

    from ....render.curves.construction_colours import colour_of_point

    across, heights = room.x(basis.at), room.y(basis.values)
    told = look.chosen | ({look.hovered} if look.hovered is not None else set())
    order = sorted(range(basis.values.shape[1]), key=lambda number: (number in told, number == look.hovered))
    for number in order:
        for low, high in _humps(np.flatnonzero(basis.values[:, number] > 0.0)):
            rows = slice(max(low - 1, 0), high + 2)
            places = [QPointF(x, y) for x, y in zip(across[rows].tolist(), heights[rows, number].tolist(), strict=True)]
            colour = QColor(colour_of_point(number, colours_now() is LIGHT))
            if number in told:
                fill = QColor(colour)
                fill.setAlpha(60 if number == look.hovered else 36)
                painter.setPen(Qt.PenStyle.NoPen)
                painter.setBrush(fill)
                ground = [QPointF(places[-1].x(), room.line), QPointF(places[0].x(), room.line)]
                painter.drawPolygon(QPolygonF([*places, *ground]))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QPen(colour, 2.5 if number in told else 1.4))
            painter.drawPolyline(QPolygonF(places))


def _humps(rows: Any) -> list[tuple[int, int]]:
    """First and last of each run of neighbouring rows (k,): a function that goes over the seam has two."""
    import numpy as np

    runs = np.split(rows, np.flatnonzero(np.diff(rows) > 1) + 1)
    return [(int(run[0]), int(run[-1])) for run in runs if len(run)]


def _paint_knots(painter: QPainter, room: Room, basis: Basis, look: Look) -> None:
    colours = colours_now()
    focused = basis.stack_of(look.focused)
    for row, stack in enumerate(basis.stacks):
        mine = row == focused
        ink = QColor(colours.link if mine else colours.muted)
        for place, number in enumerate(stack.numbers):
            middle = room.marker(basis, row, place)
            painter.setPen(QPen(QColor(colours.link) if mine else QColor(colours.window), 1.2))
            painter.setBrush(Qt.BrushStyle.NoBrush if number in look.locked else ink)
            if number in look.locked:
                painter.setPen(QPen(ink, 1.4))
            painter.drawEllipse(middle, RADIUS + 0.5 * mine, RADIUS + 0.5 * mine)
        if mine and look.keyboard:
            last = room.marker(basis, row, len(stack.numbers) - 1)
            first = room.marker(basis, row, 0)
            around = QRectF(first.x() - 7.5, first.y() - 7.5, 15.0, last.y() - first.y() + 15.0)
            painter.setPen(QPen(QColor(colours.link), 1.2))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRoundedRect(around, 7.5, 7.5)
    _paint_numbers(painter, room, basis, focused)


def _paint_numbers(painter: QPainter, room: Room, basis: Basis, focused: int) -> None:
    """Of the focused knot, and of the first and the last where there is room."""
    colours = colours_now()
    metrics = painter.fontMetrics()
    taken: list[QRectF] = []
    for row in dict.fromkeys((focused, 0, len(basis.stacks) - 1)):
        value = basis.stacks[row].value
        words = f"{value:.4g}"
        wide = metrics.horizontalAdvance(words) + 4.0
        left = min(max(room.x(value) - 0.5 * wide, 0.0), room.right + SIDE - wide)
        place = QRectF(left, room.bottom - BELOW, wide, BELOW)
        if any(place.intersects(one) for one in taken):
            continue
        taken.append(place)
        painter.setPen(QColor(colours.text if row == focused else colours.muted))
        painter.drawText(place, Qt.AlignmentFlag.AlignCenter, words)
