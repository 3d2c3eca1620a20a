"""How the textbook's figure is drawn."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QPainter, QPen, QPolygonF

from ...model.partition.figure import HEIGHT, LINES, OBJECTS, SPLIT, WIDTH, Line, Point
from ..theme import colours_now
from .inks import inks_now

if TYPE_CHECKING:
    from .figure_picture import FigurePicture

TINT, FAINT = 34, 0.4  # alpha of a half-space, opacity of what is pruned
FAR = 4.0 * (WIDTH + HEIGHT)
FRAME: tuple[Point, ...] = ((0.0, 0.0), (WIDTH, 0.0), (WIDTH, HEIGHT), (0.0, HEIGHT))


class FigurePainter:
    """Draws one picture of a FigurePicture."""

    def __init__(self, picture: FigurePicture, painter: QPainter) -> None:
        self._picture, self._painter = picture, painter
        self._colours, self._inks = colours_now(), inks_now()

    def paint(self) -> None:
        painter, picture = self._painter, self._picture
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        font = QFont(picture.font())
        font.setPixelSize(12)
        painter.setFont(font)
        painter.fillRect(picture.rect(), QColor(self._colours.ground))
        frame = QRectF(picture.to_widget((0.0, HEIGHT)), picture.to_widget((WIDTH, 0.0)))
        painter.save()
        painter.setClipRect(frame)
        for line in LINES:
            if line.name == picture.line:
                self._halves(line)
        self._cone()
        for line in LINES:
            self._line(line)
        self._split()
        for name in OBJECTS:
            self._object(name)
        painter.restore()
        self._probe()
        self._eye()
        painter.setPen(QPen(QColor(self._colours.accent if picture.hasFocus() else self._colours.border), 1))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRect(frame)

    def _polygon(self, points: list[Point] | tuple[Point, ...]) -> QPolygonF:
        return QPolygonF([self._picture.to_widget(point) for point in points])

    def _halves(self, line: Line) -> None:
        for sign, ink in ((1.0, self._inks.front), (-1.0, self._inks.back)):
            colour = QColor(ink)
            colour.setAlpha(TINT)
            self._painter.setPen(Qt.PenStyle.NoPen)
            self._painter.setBrush(colour)
            self._painter.drawPolygon(self._polygon(_kept(FRAME, line, sign)))

    def _cone(self) -> None:
        picture, half = self._picture, math.radians(self._picture.angle) / 2
        ends = [
            (picture.eye[0] + FAR * math.cos(angle), picture.eye[1] + FAR * math.sin(angle))
            for angle in (picture.direction + half, picture.direction - half)
        ]
        ground = QColor(self._colours.accent)
        ground.setAlpha(30)
        self._painter.setPen(QPen(QColor(self._colours.link), 1.2))
        self._painter.setBrush(ground)
        self._painter.drawPolygon(self._polygon([picture.eye, *ends]))

    def _line(self, line: Line) -> None:
        painter, picture = self._painter, self._picture
        x, y = line.end[0] - line.start[0], line.end[1] - line.start[1]
        length = math.hypot(x, y)
        along, across = (x / length, y / length), (-y / length, x / length)
        chosen = line.name == picture.line
        painter.setPen(QPen(QColor(self._colours.text), 2.4 if chosen else 1.4))
        ends = [(line.start[0] + t * along[0], line.start[1] + t * along[1]) for t in (-FAR, FAR)]
        painter.drawLine(picture.to_widget(ends[0]), picture.to_widget(ends[1]))
        upper = line.start if line.start[1] > line.end[1] else line.end
        down = 1.0 if upper is line.start else -1.0

        def at(distance: float, side: float) -> QPointF:
            return picture.to_widget(
                (upper[0] + down * distance * along[0] + side * across[0],
                 upper[1] + down * distance * along[1] + side * across[1])
            )  # fmt: skip

        font = QFont(painter.font())
        font.setBold(True)
        painter.save()
        painter.setFont(font)
        room = 13.0 / picture.scale
        inner = min((room, -room), key=lambda side: abs(at(9.0, side).x() - picture.width() / 2))
        self._words(line.name, at(9.0, inner), self._colours.text)
        self._words("+", at(22.0, 0.8 * room), self._inks.front)
        self._words("\u2212", at(22.0, -0.8 * room), self._inks.back)
        painter.restore()

    def _split(self) -> None:
        picture = self._picture
        self._painter.setPen(QPen(QColor(self._colours.muted), 1.2, Qt.PenStyle.DashLine))
        start, end = picture.to_widget(SPLIT.start), picture.to_widget(SPLIT.end)
        self._painter.drawLine(start, end)
        self._words(SPLIT.name, start + QPointF(-6, 0), self._colours.muted)

    def _object(self, name: str) -> None:
        painter, picture = self._painter, self._picture
        gone = name in picture.pruned
        painter.setOpacity(FAINT if gone else 1.0)
        style = Qt.PenStyle.DashLine if gone else Qt.PenStyle.SolidLine
        painter.setPen(QPen(QColor(self._colours.text), 1.4, style))
        painter.setBrush(QColor(self._colours.raised if gone else self._colours.checked))
        ring = OBJECTS[name]
        painter.drawPolygon(self._polygon(ring))
        middle = sum(x for x, _ in ring) / len(ring), sum(y for _, y in ring) / len(ring)
        place = picture.to_widget(middle)
        self._words(name, place, self._colours.text)
        painter.setOpacity(1.0)
        if name in picture.order:
            badge = QRectF(place.x() + 6, place.y() - 17, 14, 14)
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(QColor(self._colours.accent))
            painter.drawEllipse(badge)
            self._words(str(picture.order.index(name) + 1), badge.center(), self._colours.on_accent)

    def _probe(self) -> None:
        painter, place = self._painter, self._picture.to_widget(self._picture.probe)
        width = 3.0 if self._picture.hovered == "p" else 2.0
        painter.setPen(QPen(QColor(self._inks.step), width))
        for way in (QPointF(5, 5), QPointF(5, -5)):
            painter.drawLine(place - way, place + way)
        self._words("p", place + QPointF(11, -8), self._inks.step)

    def _eye(self) -> None:
        painter, picture = self._painter, self._picture
        handles = {name: picture.to_widget(point) for name, point in picture.handles().items() if name != "p"}
        painter.setPen(QPen(QColor(self._colours.link), 1.2, Qt.PenStyle.DotLine))
        painter.drawLine(handles["eye"], handles["turn"])
        painter.setPen(QPen(QColor(self._colours.link), 1.5))
        for name, place in handles.items():
            bright = name == picture.hovered
            painter.setBrush(QColor(self._colours.link if bright or name == "eye" else self._colours.ground))
            size = 6.0 if name == "eye" else 4.0
            painter.drawEllipse(place, size, size)
        painter.setBrush(QColor(self._colours.ground))
        painter.drawEllipse(handles["eye"], 2.2, 2.2)

    def _words(self, text: str, middle: QPointF, colour: str) -> None:
        self._painter.setPen(QColor(colour))
        area = QRectF(middle - QPointF(14, 10), middle + QPointF(14, 10))
        self._painter.drawText(area, Qt.AlignmentFlag.AlignCenter, text)


def _kept(ring: tuple[Point, ...], line: Line, sign: float) -> list[Point]:
    """The part of a convex ring before a line, or with sign -1 behind it."""
    kept: list[Point] = []
    for here, there in zip(ring, (*ring[1:], ring[0]), strict=True):
        a, b = sign * line.height(here), sign * line.height(there)
        if a >= 0:
            kept.append(here)
        if (a < 0) != (b < 0):
            share = a / (a - b)
            kept.append((here[0] + share * (there[0] - here[0]), here[1] + share * (there[1] - here[1])))
    return kept
