"""The picture of a BSP tree: zoom, pan, fold and unfold, and a chosen node that arrow keys move."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QHelpEvent, QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QResizeEvent, QWheelEvent
from PySide6.QtWidgets import QApplication, QToolTip, QWidget

from .tree_paint import TreePainter, box_of

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...model.partition.tree import Tree
    from ...render.drawing.bsp_diagram import Item

SMALLEST, LARGEST, FULL = 0.05, 4.0, 1.0  # scales; FULL is the largest that fitting makes
MARGIN = 12  # pixels around what is fitted
ARROWS = {Qt.Key.Key_Left: "left", Qt.Key.Key_Right: "right", Qt.Key.Key_Up: "up", Qt.Key.Key_Down: "down"}

ZOOM = (Qt.Key.Key_Plus, Qt.Key.Key_Minus, Qt.Key.Key_Equal)
SHIFT = Qt.KeyboardModifier.ShiftModifier | Qt.KeyboardModifier.KeypadModifier


class TreePicture(QWidget):
    """`chosen` carries a node of the tree that the user chose, -1 for none."""

    chosen = Signal(int)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName("BSP tree")
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMinimumSize(120, 110)
        self.items: tuple[Item, ...] = ()
        self.node = -1
        """The chosen one."""
        self.greyed: frozenset[int] = frozenset()
        self.way: frozenset[int] = frozenset()
        self.numbers: Mapping[int, str] = {}
        self.step = -1
        """The place in `items` of the one that has what was drawn last."""
        self._above: NDArray[np.int64] | None = None
        self._tree: Tree | None = None
        self._names: Sequence[str] = ()
        self._step_node = -1
        self._opened: frozenset[int] = frozenset()
        self._fitted = True
        self._scale, self._corner = 1.0, QPointF(0, 0)
        self._hovered = -1
        self._from: QPointF | None = None
        self._panning = False

    # What is shown.

    def show_tree(self, tree: Tree | None, names: Sequence[str] = ()) -> None:
        """`names` (k,) of the nodes."""
        self._tree, self._names = tree, names
        self._opened, self._hovered, self.node = frozenset(), -1, -1
        self.greyed, self.way, self.numbers = frozenset(), frozenset(), {}
        self._above, self._step_node = None, -1
        self._fitted = True
        self._lay_out()

    def choose(self, node: int) -> None:
        """Mark a node, and unfold the way to it; -1 marks none."""
        self.node = node
        if node >= 0:
            self._reveal({node})
        self.update()

    def show_pruned(self, nodes: frozenset[int]) -> None:
        """Grey these nodes and what leads to them."""
        if nodes != self.greyed:
            self.greyed = nodes
            self.update()

    def show_way(self, nodes: Sequence[int]) -> None:
        """Mark the way down of a point."""
        self.way = frozenset(nodes)
        self._reveal(self.way)
        self.update()

    def show_numbers(self, numbers: Mapping[int, str]) -> None:
        """A small text at some nodes: their place in an order."""
        self.numbers = numbers
        self.update()

    def show_step(self, node: int) -> None:
        """Mark the node that has what was drawn last, or what it is folded into; -1 none."""
        self._step_node = node
        self.step = -1
        shown = {item.node: place for place, item in enumerate(self.items) if item.node >= 0}
        while node >= 0 and self.step < 0:
            self.step = shown.get(node, -1)
            node = int(self._parents()[node])
        self.update()

    def _parents(self) -> NDArray[np.int64]:
        from ...model.partition.descent import parents

        if self._above is None:
            assert self._tree is not None
            self._above = parents(self._tree)
        return self._above

    def _reveal(self, nodes: set[int] | frozenset[int]) -> None:
        if self._tree is None or nodes <= {item.node for item in self.items if item.role != "fold"}:
            return
        above = self._parents()
        opened = set(self._opened)
        for node in nodes:
            while (node := int(above[node])) >= 0:
                opened.add(node)
        self._opened = frozenset(opened)
        self._lay_out()

    def _lay_out(self) -> None:
        from ...render.drawing.bsp_diagram import bsp_diagram

        self.items = () if self._tree is None else bsp_diagram(self._tree, self._names, self._opened)
        self._hovered = -1
        self.show_step(self._step_node)
        if self._fitted:
            self.fit()
        self.update()

    def fit(self) -> None:
        """Show everything, hung from the top."""
        self._fitted = True
        if self.items:
            area = QRectF()
            for item in self.items:
                area = area.united(box_of(item))
            room = max(self.width() - 2 * MARGIN, 1), max(self.height() - 2 * MARGIN, 1)
            self._scale = max(min(room[0] / area.width(), room[1] / area.height(), FULL), SMALLEST)
            self._corner = QPointF(
                self.width() / 2 - area.center().x() * self._scale, MARGIN - area.top() * self._scale
            )
        self.update()

    def _unfold(self, node: int) -> None:
        from ...render.drawing.bsp_diagram import unfolded

        if self._tree is not None:
            self._opened = unfolded(self._tree, node, self._opened)
            self._lay_out()

    # Mouse and keys.

    def place_of(self, node: int) -> QPointF | None:
        """Where in the widget a node's middle is drawn, None where it is folded away."""
        found = next((item for item in self.items if item.node == node and item.role in ("plane", "leaf")), None)
        return None if found is None else QPointF(found.x, found.y) * self._scale + self._corner

    def item_at(self, point: QPointF) -> int:
        """The place of the item under a point of the widget in the list of items, or -1."""
        place = (point - self._corner) / self._scale
        return next((i for i, item in enumerate(self.items) if box_of(item).contains(place)), -1)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self._from = event.position()
        self._panning = event.button() == Qt.MouseButton.MiddleButton

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        point = event.position()
        if self._from is None or not event.buttons():
            self._hover(self.item_at(point))
        elif self._panning or (point - self._from).manhattanLength() >= QApplication.startDragDistance():
            self._panning, self._fitted = True, False
            self._corner += point - self._from
            self._from = point
            self.update()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if self._from is not None and not self._panning and event.button() == Qt.MouseButton.LeftButton:
            place = self.item_at(event.position())
            self._take(place)
        self._from, self._panning = None, False

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        if self.item_at(event.position()) < 0:
            self.fit()

    def _take(self, place: int) -> None:
        item = self.items[place] if place >= 0 else None
        if item is not None and item.role == "fold":
            self._unfold(item.node)
        else:
            self.chosen.emit(-1 if item is None or item.role == "empty" else item.node)

    def _hover(self, place: int) -> None:
        if place != self._hovered:
            self._hovered = place
            self.update()

    def leaveEvent(self, event: QEvent) -> None:
        self._hover(-1)

    def wheelEvent(self, event: QWheelEvent) -> None:
        self._zoom(1.2 ** (event.angleDelta().y() / 120), event.position())
        event.accept()

    def _zoom(self, factor: float, point: QPointF) -> None:
        scale = min(max(self._scale * factor, SMALLEST), LARGEST)
        self._corner = point - (point - self._corner) * (scale / self._scale)
        self._scale, self._fitted = scale, False
        self.update()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        key = Qt.Key(event.key())
        if key in ARROWS:
            self._walk(ARROWS[key])
        elif key in ZOOM:
            self._zoom(1 / 1.2 if key == Qt.Key.Key_Minus else 1.2, QPointF(self.rect().center()))
        elif key == Qt.Key.Key_Home:
            self.fit()
        elif key == Qt.Key.Key_Escape and self.node >= 0:
            self.chosen.emit(-1)
        else:
            super().keyPressEvent(event)

    def _walk(self, way: str) -> None:
        """Choose the node above, the one below (unfolding it), or the neighbour on the same level."""
        places = [i for i, item in enumerate(self.items) if item.role in ("plane", "leaf")]
        here = next((i for i in places if self.items[i].node == self.node), -1)
        if here < 0:
            found = places[:1]
        elif way == "up":
            found = [i for i in (self.items[here].parent,) if i >= 0]
        elif way == "down":
            if any(item.role == "fold" and item.parent == here for item in self.items):
                self._unfold(self.node)
                self._walk(way)
                return
            found = [i for i in places if self.items[i].parent == here][:1]
        else:
            level = sorted((i for i in places if self.items[i].y == self.items[here].y), key=lambda i: self.items[i].x)
            at = level.index(here) + (1 if way == "right" else -1)
            found = level[at : at + 1] if at >= 0 else []
        if found:
            self.chosen.emit(self.items[found[0]].node)
            self._show_place(self.items[found[0]].node)

    def _show_place(self, node: int) -> None:
        """Pan so far that a node can be seen."""
        place = self.place_of(node)
        if place is None:
            return
        room = QRectF(self.rect()).adjusted(24, 24, -24, -24)
        shift = QPointF(
            min(max(place.x(), room.left()), room.right()) - place.x(),
            min(max(place.y(), room.top()), room.bottom()) - place.y(),
        )
        if not shift.isNull():
            self._corner += shift
            self._fitted = False
            self.update()

    # The widget.

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        TreePainter(self, painter, self._corner, self._scale, self._hovered).paint()
        painter.end()

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent) and self._has(event):
            event.accept()
            return True
        if isinstance(event, QHelpEvent) and event.type() == QEvent.Type.ToolTip:
            place = self.item_at(QPointF(event.pos()))
            QToolTip.showText(event.globalPos(), self._tip(self.items[place]) if place >= 0 else "", self)
            return True
        return super().event(event)

    def _has(self, event: QKeyEvent) -> bool:
        """Whether a key is the picture's own and not the window's."""
        own = event.key() in (*ARROWS, *ZOOM, Qt.Key.Key_Home) and not event.modifiers() & ~SHIFT
        return own or (event.key() == Qt.Key.Key_Escape and self.node >= 0)

    def _tip(self, item: Item) -> str:
        match item.role:
            case "plane":
                return f"{item.text}: a plane; behind it on the left, before it on the right"
            case "leaf":
                return f"A leaf: {item.text} of one convex body, which need no order among them"
            case "fold":
                return f"{item.text[1:]} more nodes: click to show some of them"
        return "Nothing lies on this side"

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        if self._fitted:
            self.fit()
