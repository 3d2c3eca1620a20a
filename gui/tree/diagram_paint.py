"""A CSG diagram drawn with Qt: the same paths as in its SVG, in the colours of the theme."""

from __future__ import annotations

from functools import lru_cache

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QBrush, QColor, QFont, QLinearGradient, QPainter, QPainterPath, QPen, QRadialGradient

from ...render.drawing.csg_diagram import TEXT, Diagram, Item
from ...render.drawing.kind_pictures import (
    FRAME,
    PRIMITIVES,
    RADIUS,
    SYMBOLS,
    UNKNOWN,
    WIDTH,
    Gradient,
    Path,
    shaded,
)
from ..theme import Colours

SOLID, OUTLINE = "#a9b8c9", "#14181d"  # of a primitive without a colour of its own; of every primitive
SMALL = 0.4  # the scale below which letters cannot be read


@lru_cache(maxsize=256)
def painter_path(path: Path) -> QPainterPath:
    made = QPainterPath()
    made.setFillRule(Qt.FillRule.OddEvenFill)
    for command, numbers in path:
        match command:
            case "M":
                made.moveTo(*numbers)
            case "L":
                made.lineTo(*numbers)
            case "C":
                made.cubicTo(*numbers)
            case _:
                made.closeSubpath()
    return made


def _brush(fill: float | Gradient, colour: str) -> QBrush:
    if not isinstance(fill, Gradient):
        return QBrush(QColor(shaded(colour, fill)))
    start, end = QPointF(*fill.start), QPointF(*fill.end)
    if fill.radial:
        across = end - start
        gradient = QRadialGradient(start, (across.x() ** 2 + across.y() ** 2) ** 0.5)
    else:
        gradient = QLinearGradient(start, end)
    for place, shade in fill.stops:
        gradient.setColorAt(place, QColor(shaded(colour, shade)))
    return QBrush(gradient)


def _pen(colour: QColor, width: float) -> QPen:
    return QPen(colour, width, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap, Qt.PenJoinStyle.RoundJoin)


def letters(font: QFont) -> QFont:
    """The window's font in the size of the diagram's names."""
    font = QFont(font)
    font.setPixelSize(round(TEXT))
    return font


def box_of(item: Item) -> QRectF:
    return QRectF(item.x - item.left, item.y, item.left + item.right, item.height)


class DiagramPainter:
    """Draws what lies in `seen` (in the diagram's pixels) with a painter that is set to these."""

    def __init__(self, painter: QPainter, colours: Colours, font: QFont, scale: float) -> None:
        self._painter, self._colours, self._scale = painter, colours, scale
        self._font = letters(font)

    def draw(self, diagram: Diagram, seen: QRectF, chosen: set[str], hovered: int) -> None:
        painter = self._painter
        painter.setFont(self._font)
        self._edges(diagram, seen)
        for place, item in enumerate(diagram.items):
            if not box_of(item).adjusted(-6, -6, 6, 6).intersects(seen):
                continue
            painter.save()
            painter.translate(item.x, item.y)
            chosen_here = item.node_id in chosen and item.role != "fold"
            self._ground(item, chosen_here, place == hovered)
            painter.setOpacity(1.0 if item.visible else 0.4)
            if item.role == "operation":
                self._operation(item, chosen_here)
            elif item.role == "leaf":
                self._leaf(item)
            else:
                self._cartouche(item, chosen_here, place == hovered)
            painter.restore()

    def _edges(self, diagram: Diagram, seen: QRectF) -> None:
        lines = QPainterPath()
        for item in diagram.items:
            if item.parent < 0:
                continue
            above = diagram.items[item.parent]
            left, right = min(item.x, above.x), max(item.x, above.x)
            if QRectF(left - 1, above.y, right - left + 2, item.y - above.y).intersects(seen):
                lines.moveTo(above.x, above.y + above.height)
                for x, y in diagram.edge(item):
                    lines.lineTo(x, y)
        self._painter.strokePath(lines, _pen(QColor(self._colours.muted), 1.2))

    def _ground(self, item: Item, chosen: bool, hovered: bool) -> None:
        if item.role != "leaf" or not (chosen or hovered):
            return
        colours = self._colours
        self._painter.setPen(QPen(QColor(colours.accent), 1.5) if chosen else Qt.PenStyle.NoPen)
        self._painter.setBrush(QColor(colours.checked if chosen else colours.hover))
        self._painter.drawRoundedRect(QRectF(-item.left - 4, -4, item.left + item.right + 8, item.height + 6), 5, 5)

    def _operation(self, item: Item, chosen: bool) -> None:
        painter, colours = self._painter, self._colours
        fill = shaded(item.colour, 0.4) if item.colour else colours.checked if chosen else colours.raised
        ink = "#1d242d" if item.colour else colours.text
        painter.setPen(QPen(QColor(colours.accent if chosen else colours.muted), 2.4 if chosen else 1.3))
        painter.setBrush(QColor(fill))
        painter.drawEllipse(QPointF(0, RADIUS), RADIUS, RADIUS)
        painter.save()
        painter.translate(0, RADIUS)
        painter.strokePath(painter_path(SYMBOLS[item.kind]), _pen(QColor(ink), 1.8))
        painter.restore()
        if item.text:
            self._words(item.text, QRectF(RADIUS + 6, 0, item.right + 40, 2 * RADIUS), Qt.AlignmentFlag.AlignLeft)

    def _leaf(self, item: Item) -> None:
        painter, colours = self._painter, self._colours
        painter.save()
        painter.translate(-WIDTH / 2, 0)
        symbol = SYMBOLS.get(item.kind)
        if symbol is None:
            outline = _pen(QColor(OUTLINE if colours.ground > "#8" else "#0b0d10"), 0.9)
            bare = _pen(QColor(colours.text), 0.9)
            for shape in PRIMITIVES.get(item.kind, UNKNOWN):
                path = painter_path(shape.path)
                if shape.fill is not None:
                    painter.fillPath(path, _brush(shape.fill, item.colour or SOLID))
                if shape.line:
                    painter.strokePath(path, bare if shape.fill is None else outline)
        else:
            painter.save()
            painter.translate(WIDTH / 2, 19)
            painter.strokePath(painter_path(symbol), _pen(QColor(colours.text), 1.8))
            painter.restore()
        if item.instance:
            painter.strokePath(painter_path(FRAME), QPen(QColor(colours.muted), 1, Qt.PenStyle.DashLine))
        painter.restore()
        self._words(item.text, QRectF(-item.left - 20, item.height - TEXT - 5, item.left + item.right + 40, TEXT + 5),
                    Qt.AlignmentFlag.AlignHCenter)  # fmt: skip

    def _cartouche(self, item: Item, chosen: bool, hovered: bool) -> None:
        painter, colours = self._painter, self._colours
        result = item.role == "result"
        style = Qt.PenStyle.SolidLine if result else Qt.PenStyle.DashLine
        painter.setPen(QPen(QColor(colours.accent if chosen else colours.muted), 1.6 if chosen else 1.2, style))
        painter.setBrush(QColor(colours.checked if chosen else colours.hover if hovered else colours.raised))
        area = QRectF(-item.left, 0, item.left + item.right, item.height)
        painter.drawRoundedRect(area, 6 if result else 12, 6 if result else 12)
        font = QFont(self._font)
        font.setBold(result)
        painter.setFont(font)
        self._words(item.text, area, Qt.AlignmentFlag.AlignHCenter)

    def _words(self, text: str, area: QRectF, side: Qt.AlignmentFlag) -> None:
        if self._scale >= SMALL:
            self._painter.setPen(QColor(self._colours.text))
            self._painter.drawText(area, side | Qt.AlignmentFlag.AlignVCenter | Qt.TextFlag.TextDontClip, text)
