"""The sheet on which a CSG diagram is drawn: zoom, pan, fit, and what is under the pointer."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence

from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QHelpEvent, QPainter, QPaintEvent, QPen, QResizeEvent, QWheelEvent
from PySide6.QtWidgets import QToolTip, QWidget

from ...render.drawing.csg_diagram import Diagram, packed
from ..theme import colours_now
from .diagram_paint import DiagramPainter, box_of

SMALLEST, LARGEST, FULL = 0.02, 4.0, 1.0  # scales; FULL is the largest that fitting makes
MARGIN = 16  # pixels around what is fitted


class DiagramCanvas(QWidget):
    """Shows diagrams of several solids, in rows as the widget's shape has it. What it shows stays fitted until the
    user zooms or pans."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMinimumSize(120, 80)
        self.shown = Diagram((), 0, 0)
        """All that is drawn."""
        self._diagrams: Sequence[Diagram] = ()
        self._fitted = True
        self._scale, self._corner = 1.0, QPointF(0, 0)
        self._hovered = -1
        self._mark: tuple[int, str] | None = None

    def chosen(self) -> Collection[str]:
        """Ids of the nodes that are drawn as selected."""
        return ()

    def show_diagrams(self, diagrams: Sequence[Diagram]) -> None:
        self._diagrams = diagrams
        self._hovered, self._mark = -1, None
        self._pack()

    def _pack(self) -> None:
        self.shown = packed(self._diagrams, *self._room())
        if self._fitted:
            self.fit()
        self.update()

    def _room(self) -> tuple[float, float]:
        return max(self.width() - 2.0 * MARGIN, 1.0), max(self.height() - 2.0 * MARGIN, 1.0)

    def fit(self, ids: Iterable[str] = ()) -> None:
        """Show these nodes, or everything, hung from the top as a tree is."""
        wanted = set(ids)
        boxes = [box_of(item) for item in self.shown.items if not wanted or item.node_id in wanted]
        if not boxes:
            return
        area = boxes[0]
        for box in boxes[1:]:
            area = area.united(box)
        width, height = self._room()
        self._scale = max(min(width / area.width(), height / area.height(), FULL), SMALLEST)
        self._corner = QPointF(self.width() / 2, self.height() / 2) - area.center() * self._scale
        self._fitted = not wanted
        if not wanted:
            self._corner.setY(MARGIN - area.top() * self._scale)
        self.update()

    def place_of(self, node_id: str) -> QPoint | None:
        """Where in the widget a node's middle is drawn, None where it is folded away."""
        found = [item for item in self.shown.items if item.node_id == node_id and item.role in ("leaf", "operation")]
        if not found:
            return None
        place = QPointF(found[0].x, found[0].y + found[0].height / 2)
        return (place * self._scale + self._corner).toPoint()

    def to_diagram(self, point: QPointF) -> QPointF:
        return (point - self._corner) / self._scale

    def item_at(self, point: QPoint) -> int:
        """The place of the item under a point of the widget in the list of items, or -1."""
        place = self.to_diagram(QPointF(point))
        return next((i for i, item in enumerate(self.shown.items) if box_of(item).contains(place)), -1)

    def pan(self, by: QPoint) -> None:
        self._corner += QPointF(by)
        self._fitted = False
        self.update()

    def zoom(self, factor: float, point: QPointF) -> None:
        """By a factor about a point of the widget."""
        scale = min(max(self._scale * factor, SMALLEST), LARGEST)
        self._corner = point - (point - self._corner) * (scale / self._scale)
        self._scale, self._fitted = scale, False
        self.update()

    def mark(self, mark: tuple[int, str] | None) -> None:
        """Show where a drop goes: `on` an item, `before` or `after` it."""
        if mark != self._mark:
            self._mark = mark
            self.update()

    def hover(self, place: int) -> None:
        if place != self._hovered:
            self._hovered = place
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        colours = colours_now()
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(colours.ground))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if not self.shown.items:
            painter.setPen(QColor(colours.muted))
            painter.drawText(self.rect().adjusted(12, 10, -12, 0), Qt.TextFlag.TextWordWrap, "Nothing to draw yet.")
        else:
            painter.translate(self._corner)
            painter.scale(self._scale, self._scale)
            seen = QRectF(self.to_diagram(QPointF(0, 0)), self.to_diagram(QPointF(self.width(), self.height())))
            drawing = DiagramPainter(painter, colours, self.font(), self._scale)
            drawing.draw(self.shown, seen, set(self.chosen()), self._hovered)
            self._paint_mark(painter)
        painter.end()

    def _paint_mark(self, painter: QPainter) -> None:
        if self._mark is None:
            return
        place, side = self._mark
        box = box_of(self.shown.items[place]).adjusted(-5, -5, 5, 5)
        colour = QColor(colours_now().link)
        painter.setPen(QPen(colour, 2.5))
        if side == "on":
            colour.setAlpha(50)
            painter.setBrush(colour)
            painter.drawRoundedRect(box, 6, 6)
        else:
            x = box.left() if side == "before" else box.right()
            painter.drawLine(QPointF(x, box.top()), QPointF(x, box.bottom()))

    def leaveEvent(self, event: QEvent) -> None:
        self.hover(-1)

    def wheelEvent(self, event: QWheelEvent) -> None:
        self.zoom(1.2 ** (event.angleDelta().y() / 120), event.position())
        event.accept()

    def event(self, event: QEvent) -> bool:
        if isinstance(event, QHelpEvent) and event.type() == QEvent.Type.ToolTip:
            place = self.item_at(event.pos())
            if place >= 0:
                item = self.shown.items[place]
                hint = {"fold": "\nClick to show them", "result": "\nDouble click to fit"}.get(item.role, "")
                QToolTip.showText(event.globalPos(), item.label + hint, self)
            else:
                QToolTip.hideText()
            return True
        return super().event(event)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        if self._fitted:
            self._pack()
