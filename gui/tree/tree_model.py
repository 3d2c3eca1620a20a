"""The document as a model for Qt's tree view: rows follow the immutable document by identity.

A sub-tree that is the very object shown before is not looked at, so what is expanded and selected in it stays.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QAbstractItemModel, QMimeData, QModelIndex, QObject, QPersistentModelIndex, Qt, Signal
from PySide6.QtGui import QGuiApplication, QPalette

from ...model.document.document import Document
from ...model.document.errors import Refusal
from ...model.document.nodes import Instance, Node
from ...model.document.tree import find
from ...model.editing.operations import OPERATIONS
from ...model.editing.session import Session
from ..icons import icon, kind_icon, severity_icon
from .tree_rows import Row, longest_rising, runs

if TYPE_CHECKING:
    from ...model.worker.shown import Message

NAME, BADGE, EYE = range(3)
MIME = "application/x-solidtree-nodes"
Index = QModelIndex | QPersistentModelIndex
NOWHERE = QModelIndex()


class TreeModel(QAbstractItemModel):
    """Columns: name with icon, badge of a problem, eye. `refused` carries words for the status bar."""

    refused = Signal(str)

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._next = 1
        self._root = Row(None, None, 0)
        self._rows: dict[int, Row] = {0: self._root}
        self._by_id: dict[str, Row] = {}
        self._roots: tuple[Node, ...] = ()
        self.deepest = 0
        """The level of the lowest row since the model was empty."""
        self._definitions: frozenset[str] = frozenset()
        self._problems: dict[str, tuple[str, str]] = {}
        self.update(session.document)

    # The document's side.

    def update(self, document: Document) -> None:
        """Follow the document; signals tell only what differs."""
        self._definitions = frozenset(node.id for node in document.definitions)
        roots = document.roots
        before, self._roots = self._roots, roots
        pairs = zip(before, roots, strict=False)
        if len(before) == len(roots) and all(a is b for a, b in pairs):
            return
        stack: list[tuple[Row, Sequence[Node]]] = [(self._root, roots)]
        while stack:
            row, nodes = stack.pop()
            self._match(row, nodes)
            for child, node in zip(row.children, nodes, strict=True):
                if child.node is node:
                    continue
                below = child.node.children is not node.children
                child.node = node
                self.dataChanged.emit(self._index(child, NAME), self._index(child, EYE))
                if below:
                    stack.append((child, node.children))

    def _match(self, row: Row, nodes: Sequence[Node]) -> None:
        """Make the row's children stand for the nodes, in this order, keeping the longest part that does already."""
        if [child.node.id for child in row.children] == [node.id for node in nodes]:
            return
        wanted = {node.id: place for place, node in enumerate(nodes)}
        kept = set(longest_rising([wanted.get(child.node.id, -1) for child in row.children]))
        for first, last in reversed(list(runs(i for i in range(len(row.children)) if i not in kept))):
            self.beginRemoveRows(self._index(row), first, last)
            gone, row.children[first : last + 1] = row.children[first : last + 1], []
            self._forget(gone)
            self.endRemoveRows()
            if not self._by_id:
                self.deepest = 0
        have = {child.node.id for child in row.children}
        for first, last in runs(i for i, node in enumerate(nodes) if node.id not in have):
            self.beginInsertRows(self._index(row), first, last)
            row.children[first:first] = [self._make(node, row) for node in nodes[first : last + 1]]
            self.endInsertRows()

    def _make(self, node: Node, parent: Row) -> Row:
        top = Row(node, parent, 0)
        level, above = 0, parent
        while above.parent is not None:
            level, above = level + 1, above.parent
        stack = [(top, level)]
        while stack:
            row, level = stack.pop()
            self.deepest = max(self.deepest, level)
            row.key = self._next
            self._next += 1
            self._rows[row.key] = row
            self._by_id[row.node.id] = row
            row.children = [Row(child, row, 0) for child in row.node.children]
            stack += [(child, level + 1) for child in row.children]
        return top

    def _forget(self, rows: list[Row]) -> None:
        stack = list(rows)
        while stack:
            row = stack.pop()
            del self._rows[row.key]
            if self._by_id.get(row.node.id) is row:
                del self._by_id[row.node.id]
            stack += row.children

    def set_problems(self, problems: Iterable[Message]) -> None:
        """Show these as badges; an error hides a warning."""
        new: dict[str, tuple[str, str]] = {}
        for problem in problems:
            if problem.node_id not in new or problem.error:
                new[problem.node_id] = ("error" if problem.error else "warning", problem.message)
        changed = [i for i in {*new, *self._problems} if new.get(i) != self._problems.get(i)]
        self._problems = new
        for node_id in changed:
            row = self._by_id.get(node_id)
            if row is not None:
                self.dataChanged.emit(self._index(row, NAME), self._index(row, EYE))

    def index_of(self, node_id: str) -> QModelIndex:
        row = self._by_id.get(node_id)
        return NOWHERE if row is None else self._index(row)

    def node(self, index: Index) -> Node | None:
        return self._rows[index.internalId()].node if index.isValid() else None

    def _index(self, row: Row, column: int = NAME) -> QModelIndex:
        if row.parent is None:
            return NOWHERE
        return self.createIndex(row.parent.children.index(row), column, row.key)

    def _row(self, index: Index) -> Row:
        return self._rows.get(index.internalId(), self._root) if index.isValid() else self._root

    # Qt's side.

    def index(self, row: int, column: int, parent: Index = NOWHERE) -> QModelIndex:
        children = self._row(parent).children
        return self.createIndex(row, column, children[row].key) if 0 <= row < len(children) else NOWHERE

    def parent(self, index: Index = NOWHERE) -> QModelIndex:  # type: ignore[override]
        above = self._row(index).parent if index.isValid() else None
        return NOWHERE if above is None else self._index(above)

    def rowCount(self, parent: Index = NOWHERE) -> int:
        return 0 if parent.column() > 0 else len(self._row(parent).children)

    def columnCount(self, parent: Index = NOWHERE) -> int:
        return 3

    def hasChildren(self, parent: Index = NOWHERE) -> bool:
        return self.rowCount(parent) > 0

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        node = self.node(index)
        if node is None:
            return None
        roles = Qt.ItemDataRole
        column = index.column()
        severity, message = self._problems.get(node.id, ("", ""))
        if column == NAME:
            if role in (roles.DisplayRole, roles.EditRole):
                return node.name if role == roles.EditRole else self._label(node)
            if role == roles.DecorationRole:
                return kind_icon(type(node))
            if role == roles.ForegroundRole and not node.visible:
                return QGuiApplication.palette().color(QPalette.ColorGroup.Disabled, QPalette.ColorRole.Text)
            if role == roles.ToolTipRole:
                return "\n".join(part for part in (f"{node.label}: {node.title.lower()}", node.note, message) if part)
        elif column == BADGE:
            if role == roles.DecorationRole and severity:
                return severity_icon(severity == "error")
            if role == roles.ToolTipRole:
                return message or None
        elif column == EYE:
            if role == roles.DecorationRole:
                return icon("eye" if node.visible else "hidden")
            if role == roles.ToolTipRole:
                return f"Hide “{node.label}”" if node.visible else f"Show “{node.label}”"
        return None

    def _label(self, node: Node) -> str:
        if isinstance(node, Instance):
            row = self._by_id.get(node.definition)
            return node.name or (f"Instance of {row.node.label}" if row else node.label)
        return f"{node.label} (definition)" if node.id in self._definitions else node.label

    def flags(self, index: Index) -> Qt.ItemFlag:
        flags = Qt.ItemFlag
        if not index.isValid():
            return flags.ItemIsDropEnabled
        result = flags.ItemIsEnabled | flags.ItemIsSelectable | flags.ItemIsDragEnabled | flags.ItemIsDropEnabled
        return result | flags.ItemIsEditable if index.column() == NAME else result

    def setData(self, index: Index, value: Any, role: int = Qt.ItemDataRole.EditRole) -> bool:
        node = self.node(index)
        if node is None or role != Qt.ItemDataRole.EditRole or " ".join(str(value).split()) == node.name:
            return False
        return self._try(lambda: self._session.do("rename", node.id, str(value)))

    # Drag and drop.

    def supportedDropActions(self) -> Qt.DropAction:
        return Qt.DropAction.MoveAction | Qt.DropAction.CopyAction

    def mimeTypes(self) -> list[str]:
        return [MIME]

    def mimeData(self, indexes: Sequence[QModelIndex]) -> QMimeData:
        ids = [node.id for index in indexes if index.column() == NAME and (node := self.node(index)) is not None]
        data = QMimeData()
        data.setData(MIME, "\n".join(ids).encode())
        return data

    def canDropMimeData(self, data: QMimeData, action: Qt.DropAction, row: int, column: int, parent: Index) -> bool:
        ids = ids_of(data)
        if not ids:
            return False
        try:
            self._dropped(action, ids, *self._place(row, parent))
        except Refusal as refusal:
            self.refused.emit(str(refusal))
            return False
        self.refused.emit("")
        return True

    def dropMimeData(self, data: QMimeData, action: Qt.DropAction, row: int, column: int, parent: Index) -> bool:
        ids = ids_of(data)
        parent_id, index = self._place(row, parent)
        if action != Qt.DropAction.CopyAction:
            arguments = [ids, parent_id] if index is None else [ids, parent_id, index]
            return self._try(lambda: self._session.do("relocate", *arguments, label="Move in tree", select=ids))

        def copy() -> None:
            document, lines = self._dropped(action, ids, parent_id, index)
            self._session.commit("Copy in tree", document, line="\n".join(lines))

        return self._try(copy)

    def _place(self, row: int, parent: Index) -> tuple[str | None, int | None]:
        node = self.node(parent)
        if node is None:
            solids = len(self._session.document.solids)
            return None, None if row < 0 else min(row, solids)
        return node.id, None if row < 0 else row

    def _dropped(
        self, action: Qt.DropAction, ids: list[str], parent_id: str | None, index: int | None
    ) -> tuple[Document, list[str]]:
        """The document after the drop, and the lines of Python that do a copy. Raises Refusal."""
        from ...model.editing.echo import call

        document = self._session.document
        if action != Qt.DropAction.CopyAction:
            return OPERATIONS["relocate"](document, ids, parent_id, index), []
        lines = []
        for offset, node_id in enumerate(ids):
            arguments = [find(document, node_id), parent_id, None if index is None else index + offset]
            if index is None:
                del arguments[2]
            document = OPERATIONS["insert"](document, *arguments)
            lines.append(call("insert", *arguments))
        return document, lines

    def _try(self, change: Callable[[], Any]) -> bool:
        try:
            change()
        except Refusal as refusal:
            self.refused.emit(str(refusal))
            return False
        return True


def ids_of(data: QMimeData) -> list[str]:
    return bytes(data.data(MIME).data()).decode().split("\n") if data.hasFormat(MIME) else []
