"""The CSG diagram as a panel: it follows the session, and what is clicked or dropped in it goes to the session."""

from __future__ import annotations

from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt, Signal
from PySide6.QtGui import (
    QContextMenuEvent,
    QDrag,
    QDragEnterEvent,
    QDragLeaveEvent,
    QDragMoveEvent,
    QDropEvent,
    QFontMetricsF,
    QKeyEvent,
    QMouseEvent,
)
from PySide6.QtWidgets import QApplication, QWidget

from ...model.document.errors import Refusal
from ...model.document.nodes import Node
from ...model.document.tree import index_of, parent
from ...model.editing.session import Session, State
from ...render.drawing import csg_diagram
from ...render.drawing.csg_diagram import Item
from ..commands.actions import Actions
from .diagram_canvas import DiagramCanvas
from .diagram_paint import letters
from .drop_view import drag_picture
from .drops import answer, copies, dragged, drop, drop_fault, is_drop, root_place
from .tree_menu import node_menu

Part = tuple[Node, str, tuple[Node, ...], frozenset[str], csg_diagram.Diagram]


class Diagram(DiagramCanvas):
    """`refused` carries words for the status bar, "" takes them back. Only solids that changed are laid out again."""

    refused = Signal(str)

    def __init__(self, session: Session, actions: Actions, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("diagram")
        self.setAccessibleName("Diagram of the tree")
        self.setAcceptDrops(True)
        self._session = session
        self._actions = actions
        self._parts: dict[str, Part] = {}
        self._opened: frozenset[str] = frozenset()
        self.in_front = False
        self._stale = True
        self._pressed = -1
        self._from: QPoint | None = None
        self._panning = False
        self._told = ""

    # What is shown.

    def session_changed(self, before: State, after: State) -> None:
        if before.document is not after.document and not self._session.previewing:
            self._stale = True
            if self.in_front:
                self._follow()
        if before.selection != after.selection:
            self.update()

    def document_opened(self) -> None:
        self._opened = frozenset()
        self._fitted = self._stale = True
        if self.in_front:
            self._follow()

    def set_in_front(self, seen: bool) -> None:
        """Whether its tab is the one that is open; behind another one it does no work."""
        self.in_front = seen
        if seen and self._stale:
            self._follow()

    def _follow(self) -> None:
        document = self._session.document
        definitions = {root.id: root for root in document.definitions}
        metrics = QFontMetricsF(letters(self.font()))
        parts: dict[str, Part] = {}
        for root, title in csg_diagram.roots_of(document):
            kept = self._parts.get(root.id)
            same = kept is not None and kept[:2] == (root, title) and kept[0] is root and kept[3] is self._opened
            if kept is None or not same or kept[2] is not document.definitions:
                laid = csg_diagram.diagram_of(root, definitions, self._opened, metrics.horizontalAdvance, title)
                kept = (root, title, document.definitions, self._opened, laid)
            parts[root.id] = kept
        self._parts = parts
        self._stale = False
        self.show_diagrams([part[4] for part in parts.values()])

    def chosen(self) -> tuple[str, ...]:
        return self._session.selection

    # Mouse and keys.

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self._from = event.position().toPoint()
        self._pressed = self.item_at(self._from) if event.button() == Qt.MouseButton.LeftButton else -1
        self._panning = event.button() == Qt.MouseButton.MiddleButton

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        point = event.position().toPoint()
        if self._from is None or not event.buttons() & (Qt.MouseButton.LeftButton | Qt.MouseButton.MiddleButton):
            self.hover(self.item_at(point))
        elif self._panning or (point - self._from).manhattanLength() >= QApplication.startDragDistance():
            if self._pressed >= 0 and self.shown.items[self._pressed].role != "fold" and not self._panning:
                self._start_drag(self.shown.items[self._pressed])
                return
            self._panning = True
            self.setCursor(Qt.CursorShape.ClosedHandCursor)
            self.pan(point - self._from)
            self._from = point

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if self._from is not None and not self._panning and event.button() == Qt.MouseButton.LeftButton:
            self._click(self._pressed, bool(event.modifiers() & Qt.KeyboardModifier.ControlModifier))
        self._from, self._pressed, self._panning = None, -1, False
        self.unsetCursor()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        place = self.item_at(event.position().toPoint())
        item = self.shown.items[place] if place >= 0 else None
        if item is None or item.role == "result":
            self.fit()
        elif item.role == "operation" and item.node_id in self._opened:
            self._open(self._opened - {item.node_id})

    def _click(self, place: int, adds: bool) -> None:
        if place < 0:
            if not adds:
                self._session.select(())
            return
        item, selection = self.shown.items[place], self._session.selection
        if item.role == "fold":
            self._open(self._opened | {item.node_id})
        elif not adds:
            self._session.select((item.node_id,))
        elif item.node_id in selection:
            self._session.select(i for i in selection if i != item.node_id)
        else:
            self._session.select((*selection, item.node_id))

    def _open(self, opened: frozenset[str]) -> None:
        self._opened = opened
        self._follow()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        moves = {Qt.Key.Key_Left: "left", Qt.Key.Key_Right: "right", Qt.Key.Key_Up: "up", Qt.Key.Key_Down: "down"}
        key = Qt.Key(event.key())
        if key in moves:
            self._step(moves[key])
        elif key in (Qt.Key.Key_Plus, Qt.Key.Key_Minus, Qt.Key.Key_Equal):
            self.zoom(1 / 1.2 if key == Qt.Key.Key_Minus else 1.2, QPointF(self.rect().center()))
        elif key == Qt.Key.Key_Escape:
            self._session.select(())
        elif key in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self._actions.run("rename")
        else:
            super().keyPressEvent(event)

    def _step(self, way: str) -> None:
        """Select the parent, the first operand, or the neighbour on the same level."""
        items = self.shown.items
        places = [i for i, item in enumerate(items) if item.role in ("leaf", "operation")]
        chosen = self._session.selection[-1] if self._session.selection else ""
        here = next((i for i in places if items[i].node_id == chosen), -1)
        if here < 0:
            found = places[:1]
        elif way == "up":
            found = [i for i in (items[here].parent,) if i in places]
        elif way == "down":
            found = [i for i in places if items[i].parent == here][:1]
        else:
            level = [i for i in places if items[i].y == items[here].y]
            level.sort(key=lambda i: items[i].x)
            at = level.index(here) + (1 if way == "right" else -1)
            found = level[at : at + 1] if at >= 0 else []
        if found:
            self._session.select((items[found[0]].node_id,))

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        place = self.item_at(event.pos())
        if place >= 0 and self.shown.items[place].node_id not in self._session.selection:
            self._session.select((self.shown.items[place].node_id,))
        menu = node_menu(self._actions, self)
        first = menu.actions()[0]
        menu.insertAction(first, self._actions["export_diagram"])
        menu.insertSeparator(first)
        menu.popup(event.globalPos())

    # Drag and drop.

    def _start_drag(self, item: Item) -> None:
        self._from, self._pressed = None, -1
        if item.node_id not in self._session.selection:
            self._session.select((item.node_id,))
        ids = list(self._session.selection)
        drag = QDrag(self)
        drag.setMimeData(dragged(self._session, ids))
        drag.setPixmap(drag_picture(self, item.label if len(ids) == 1 else f"{len(ids)} nodes"))
        drag.setHotSpot(QPoint(-14, -6))
        drag.exec(Qt.DropAction.MoveAction | Qt.DropAction.CopyAction, Qt.DropAction.MoveAction)
        self._end()

    def _drop_place(self, point: QPoint, data: QMimeData) -> tuple[str | None, int | None, tuple[int, str] | None]:
        """The operation and place that a drop at a point means: on a circle its last operand, beside a leaf there."""
        place = self.item_at(point)
        if place < 0:
            return None, None, None
        item, document = self.shown.items[place], self._session.document
        if item.role == "result":
            rows = {root.id: row for row, root in enumerate(document.standing)}
            index = root_place(self._session, data, rows[item.node_id]) if item.node_id in rows else None
            return None, index, (place, "before")
        if item.role != "leaf":
            return item.node_id, None, (place, "on")
        above = parent(document, item.node_id)
        after = self.to_diagram(QPointF(point)).x() > item.x
        index = index_of(document, item.node_id) + after
        if above is None and not any(root.id == item.node_id for root in document.definitions):
            rows = [root.id for root in document.standing]
            index = root_place(self._session, data, rows.index(item.node_id) + after)
        return (None if above is None else above.id), index, (place, "after" if after else "before")

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        event.accept() if is_drop(event.mimeData()) else event.ignore()

    def dragMoveEvent(self, event: QDragMoveEvent) -> None:
        parent_id, index, mark = self._drop_place(event.position().toPoint(), event.mimeData())
        copy = copies(event)
        fault = drop_fault(self._session, event.mimeData(), copy, parent_id, index)
        self._tell(fault or "")
        self.mark(None if fault else mark)
        answer(event, copy, fault)

    def dragLeaveEvent(self, event: QDragLeaveEvent) -> None:
        self._end()

    def dropEvent(self, event: QDropEvent) -> None:
        parent_id, index, _ = self._drop_place(event.position().toPoint(), event.mimeData())
        copy = copies(event)
        self._end()
        try:
            drop(self._session, event.mimeData(), copy, parent_id, index)
            event.accept()
        except Refusal as refusal:
            self._tell(str(refusal))
            event.ignore()

    def _end(self) -> None:
        self.mark(None)
        self._tell("")

    def _tell(self, words: str) -> None:
        if words != self._told:
            self._told = words
            self.refused.emit(words)
