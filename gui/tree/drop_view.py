"""A tree view into which nodes are dropped: between rows, onto operations, out of them, or into the empty space."""

from __future__ import annotations

from PySide6.QtCore import QMimeData, QModelIndex, QPoint, QPointF, QRect, Qt, QTimer, Signal
from PySide6.QtGui import (
    QColor,
    QDrag,
    QDragEnterEvent,
    QDragLeaveEvent,
    QDragMoveEvent,
    QDropEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPixmap,
)
from PySide6.QtWidgets import QTreeView, QWidget

from ...model.document.errors import Refusal
from ...model.editing.session import Session
from ..theme import colours_now
from .drops import answer, copies, dragged, drop, drop_fault, is_drop, root_place
from .tree_model import NAME, TreeModel

EDGE = 0.28  # of a row's height: the part above and below in which a drop goes beside it
MARGIN = 24  # pixels from the edge within which the tree scrolls
SCROLL, OPEN = 40, 600  # milliseconds between two steps of scrolling; until a closed row opens
Place = tuple[str | None, int | None]
"""The operation (None: a solid), and the operand before which the nodes come (None: last)."""


def drag_picture(widget: QWidget, text: str) -> QPixmap:
    """A label that goes with the pointer."""
    colours, ratio = colours_now(), widget.devicePixelRatioF()
    metrics = widget.fontMetrics()
    text = metrics.elidedText(text, Qt.TextElideMode.ElideRight, 220)
    width, height = metrics.horizontalAdvance(text) + 16, metrics.height() + 8
    picture = QPixmap(int(width * ratio), int(height * ratio))
    picture.setDevicePixelRatio(ratio)
    picture.fill(Qt.GlobalColor.transparent)
    painter = QPainter(picture)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setFont(widget.font())
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(colours.accent))
    painter.drawRoundedRect(0, 0, width, height, 4, 4)
    painter.setPen(QColor(colours.on_accent))
    painter.drawText(QRect(0, 0, width, height), Qt.AlignmentFlag.AlignCenter, text)
    painter.end()
    return picture


class DropView(QTreeView):
    """`refused` carries words for the status bar on why nodes cannot be dropped here, "" takes them back."""

    refused = Signal(str)
    nodes: TreeModel

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.setDragEnabled(True)
        self.setAcceptDrops(True)
        self.setDropIndicatorShown(False)  # it is painted here
        self._mark: tuple[str, QRect] | None = None
        self._told = ""
        self._pointer = QPoint()
        self._over = QModelIndex()
        self._opening = QTimer(self)
        self._opening.setSingleShot(True)
        self._opening.setInterval(OPEN)
        self._opening.timeout.connect(lambda: self.expand(self._over))
        self._scrolling = QTimer(self)
        self._scrolling.setInterval(SCROLL)
        self._scrolling.timeout.connect(self._scroll)

    def startDrag(self, supportedActions: Qt.DropAction) -> None:
        chosen = set(self._session.selection)
        ids = self.nodes.in_order(chosen)
        if not ids:
            return
        drag = QDrag(self)
        drag.setMimeData(dragged(self._session, ids))
        label = self.nodes.label_of(ids[0])
        drag.setPixmap(drag_picture(self, label if len(ids) == 1 else f"{len(ids)} nodes"))
        drag.setHotSpot(QPoint(-14, -6))
        actions = Qt.DropAction.MoveAction | Qt.DropAction.CopyAction
        drag.exec(actions, Qt.DropAction.MoveAction)
        self._end()

    # Where a drop goes.

    def place_at(self, point: QPoint, data: QMimeData) -> tuple[Place, str, QRect]:
        """What a drop at a point of the viewport means, and the mark that shows it: `line` or `box`, and where.

        Below the last operand of an operation the pointer's place sideways tells how far out the drop goes.
        """
        index = self.indexAt(point)
        index = index.siblingAtColumn(NAME) if index.isValid() else index
        node = self.nodes.node(index)
        if node is None:
            return (None, None), "line", self._line(self._last(), below=True, left=0)
        rect = self._row_rect(index)
        share = (point.y() - rect.top()) / max(rect.height(), 1)
        if share < EDGE:
            return self._beside(index, 0, data), "line", self._line(index, below=False)
        if share <= 1 - EDGE:
            return (node.id, None), "box", rect
        if self.isExpanded(index) and self.nodes.rowCount(index):
            first = self.nodes.index(0, NAME, index)
            return (node.id, 0), "line", self._line(first, below=False)
        lowest = index
        while index.parent().isValid() and point.x() < self._row_rect(index).left() and self._is_last(index):
            index = index.parent()
        return self._beside(index, 1, data), "line", self._line(lowest, below=True, left=self._row_rect(index).left())

    def _beside(self, index: QModelIndex, offset: int, data: QMimeData) -> Place:
        above = self.nodes.node(index.parent())
        if above is not None:
            return above.id, index.row() + offset
        return None, root_place(self._session, data, index.row() + offset)

    def _is_last(self, index: QModelIndex) -> bool:
        return index.row() == self.nodes.rowCount(index.parent()) - 1

    def _last(self) -> QModelIndex:
        """The lowest row on the screen's list."""
        index, below = QModelIndex(), self.nodes.rowCount()
        while below:
            index = self.nodes.index(below - 1, NAME, index)
            below = self.nodes.rowCount(index) if self.isExpanded(index) else 0
        return index

    def _row_rect(self, index: QModelIndex) -> QRect:
        """From the row's own indentation to the right edge of what is seen."""
        rect = self.visualRect(index)
        rect.setRight(self.viewport().width() - 1)
        return rect

    def _line(self, index: QModelIndex, below: bool, left: int | None = None) -> QRect:
        rect = self._row_rect(index) if index.isValid() else QRect(0, 2, self.viewport().width(), 0)
        y = rect.bottom() + 1 if below and index.isValid() else rect.top()
        start = rect.left() if left is None else left
        return QRect(start, y, self.viewport().width() - start, 0)

    # What is dragged over it.

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        if is_drop(event.mimeData()):
            event.accept()
        else:
            event.ignore()  # files belong to the window

    def dragMoveEvent(self, event: QDragMoveEvent) -> None:
        self._pointer = event.position().toPoint()
        (parent_id, index), shape, rect = self.place_at(self._pointer, event.mimeData())
        copy = copies(event)
        fault = drop_fault(self._session, event.mimeData(), copy, parent_id, index)
        over = self.indexAt(self._pointer).siblingAtColumn(NAME)
        if over != self._over:
            self._over = over
            self._opening.start() if over.isValid() and not self.isExpanded(over) else self._opening.stop()
        if not self._scrolling.isActive():
            self._scrolling.start()
        self._tell(fault or "")
        self._set_mark(None if fault else (shape, rect))
        answer(event, copy, fault)

    def dragLeaveEvent(self, event: QDragLeaveEvent) -> None:
        self._end()
        event.accept()

    def dropEvent(self, event: QDropEvent) -> None:
        (parent_id, index), _, _ = self.place_at(event.position().toPoint(), event.mimeData())
        copy = copies(event)
        self._end()
        try:
            drop(self._session, event.mimeData(), copy, parent_id, index)
        except Refusal as refusal:
            self._tell(str(refusal))
            event.ignore()
            return
        event.setDropAction(Qt.DropAction.CopyAction if copy else Qt.DropAction.MoveAction)
        event.accept()

    def _end(self) -> None:
        self._opening.stop()
        self._scrolling.stop()
        self._over = QModelIndex()
        self._set_mark(None)
        self._tell("")

    def _tell(self, words: str) -> None:
        if words != self._told:
            self._told = words
            self.refused.emit(words)

    def _set_mark(self, mark: tuple[str, QRect] | None) -> None:
        if mark != self._mark:
            self._mark = mark
            self.viewport().update()

    def _scroll(self) -> None:
        """One step where the pointer is near the upper or the lower edge."""
        bar, y, height = self.verticalScrollBar(), self._pointer.y(), self.viewport().height()
        step = -1 if y < MARGIN else 1 if y > height - MARGIN else 0
        before = bar.value()
        bar.setValue(before + step * bar.singleStep())
        if bar.value() != before:
            self._set_mark(None)  # the next move of the mouse tells where it is now

    def paintEvent(self, event: QPaintEvent) -> None:
        super().paintEvent(event)
        if self._mark is None:
            return
        shape, rect = self._mark
        painter = QPainter(self.viewport())
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        colour = QColor(colours_now().link)
        painter.setPen(QPen(colour, 2))
        if shape == "box":
            colour.setAlpha(50)
            painter.setBrush(colour)
            painter.drawRoundedRect(rect.adjusted(1, 1, -2, -1), 4, 4)
        else:
            y = max(rect.y(), 4)
            painter.drawLine(rect.left() + 9, y, rect.right() - 4, y)
            painter.setBrush(QColor(colours_now().ground))
            painter.drawEllipse(QPointF(rect.left() + 5.5, y), 3.5, 3.5)
        painter.end()
