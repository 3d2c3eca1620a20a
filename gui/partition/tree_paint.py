"""How a BSP tree is drawn: planes as circles, leaves as boxes, the sides of a plane in their own colours."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QPainter, QPen

from ..theme import colours_now
from .inks import inks_now

if TYPE_CHECKING:
    from ...render.drawing.bsp_diagram import Item
    from .tree_picture import TreePicture

HEIGHT = 28.0  # of an item
LETTERS = 11  # pixels
SMALL = 0.45  # the scale below which letters cannot be read
FAINT = 0.35  # opacity of what is pruned


def box_of(item: Item) -> QRectF:
    high = 8.0 if item.role == "empty" else HEIGHT
    return QRectF(item.x - item.half, item.y - high / 2, 2 * item.half, high)


class TreePainter:
    """Draws one picture of `picture`'s items."""

    def __init__(self, picture: TreePicture, painter: QPainter, corner: QPointF, scale: float, hovered: int) -> None:
        self._picture, self._painter = picture, painter
        self._corner, self._scale, self._hovered = corner, scale, hovered
        self._colours, self._inks = colours_now(), inks_now()

    def paint(self) -> None:
        painter, picture = self._painter, self._picture
        painter.fillRect(picture.rect(), QColor(self._colours.ground))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if not picture.items:
            painter.setPen(QColor(self._colours.muted))
            painter.drawText(picture.rect().adjusted(12, 10, -12, 0), Qt.TextFlag.TextWordWrap, "No tree yet.")
            return
        font = QFont(picture.font())
        font.setPixelSize(LETTERS)
        painter.setFont(font)
        painter.translate(self._corner)
        painter.scale(self._scale, self._scale)
        seen = QRectF(-self._corner / self._scale, picture.size().toSizeF() / self._scale).adjusted(-60, -60, 60, 60)
        for item in picture.items:
            above = picture.items[item.parent] if item.parent >= 0 else None
            if above is not None and QRectF(QPointF(item.x, item.y), QPointF(above.x, above.y)).normalized().adjusted(
                -1, -1, 1, 1
            ).intersects(seen):
                self._edge(item, above)
        for place, item in enumerate(picture.items):
            if box_of(item).intersects(seen):
                painter.setOpacity(FAINT if item.node in picture.greyed else 1.0)
                self._item(item, place == self._hovered, place == picture.step)
        painter.setOpacity(1.0)
        if picture.hasFocus():
            painter.resetTransform()
            painter.setPen(QPen(QColor(self._colours.accent), 1))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRect(QRectF(picture.rect()).adjusted(0.5, 0.5, -0.5, -0.5))

    def _side(self, side: str) -> QColor:
        return QColor({"front": self._inks.front, "back": self._inks.back}.get(side, self._colours.muted))

    def _edge(self, item: Item, above: Item) -> None:
        painter, picture = self._painter, self._picture
        grey = item.node in picture.greyed
        on_way = item.role != "fold" and item.node >= 0 and item.node in picture.way
        painter.setOpacity(FAINT if grey else 1.0)
        dashed = grey or item.role in ("empty", "fold")
        style = Qt.PenStyle.DashLine if dashed else Qt.PenStyle.SolidLine
        painter.setPen(QPen(self._side(item.side), 3.5 if on_way else 1.5, style))
        start, end = QPointF(above.x, above.y + HEIGHT / 2), QPointF(item.x, box_of(item).top())
        painter.drawLine(start, end)
        if item.side and item.role != "empty" and self._scale >= SMALL:
            middle = (start + end) / 2 + QPointF(-9 if item.side == "back" else 9, 0)
            painter.drawText(QRectF(middle - QPointF(8, 8), middle + QPointF(8, 8)), Qt.AlignmentFlag.AlignCenter,
                             "+" if item.side == "front" else "\u2212")  # fmt: skip

    def _item(self, item: Item, hovered: bool, stepped: bool) -> None:
        painter, colours, picture = self._painter, self._colours, self._picture
        if item.role == "empty":
            painter.setPen(QPen(QColor(colours.muted), 1))
            painter.setBrush(QColor(colours.ground))
            painter.drawEllipse(QPointF(item.x, item.y), 2.5, 2.5)
            return
        chosen = item.role != "fold" and item.node == picture.node
        on_way = item.role != "fold" and item.node in picture.way
        ground = colours.checked if chosen else colours.hover if hovered else colours.raised
        line = colours.accent if chosen else colours.text if on_way else colours.muted
        style = Qt.PenStyle.DashLine if item.role == "fold" else Qt.PenStyle.SolidLine
        painter.setPen(QPen(QColor(line), 2.4 if chosen or on_way else 1.3, style))
        painter.setBrush(QColor(ground))
        box = box_of(item)
        radius = HEIGHT / 2 if item.role in ("plane", "fold") else 4
        painter.drawRoundedRect(box, radius, radius)
        if stepped:
            painter.setPen(QPen(QColor(self._inks.step), 2.4))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRoundedRect(box.adjusted(-4, -4, 4, 4), radius + 4, radius + 4)
        if self._scale >= SMALL:
            painter.setPen(QColor(colours.text))
            painter.drawText(box, Qt.AlignmentFlag.AlignCenter, item.text)
        number = picture.numbers.get(item.node) if item.role != "fold" else None
        if number:
            badge = QRectF(box.right() - 7, box.top() - 7, 15, 15)
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(QColor(colours.accent))
            painter.drawEllipse(badge)
            painter.setPen(QColor(colours.on_accent))
            painter.drawText(badge, Qt.AlignmentFlag.AlignCenter, number)
