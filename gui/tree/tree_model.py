"""The document as a model for Qt's tree view: rows follow the immutable document by identity.

A sub-tree that is the very object shown before is not looked at, so what is expanded and selected in it stays.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QAbstractItemModel, QModelIndex, QObject, QPersistentModelIndex, Qt, Signal
from PySide6.QtGui import QFont, QGuiApplication, QIcon, QPalette

from ...model.document.distinct_colours import distinct_colour
from ...model.document.document import Document
from ...model.document.errors import Refusal
from ...model.document.nodes import Instance, Node
from ...model.document.outlines import OUTLINES
from ...model.editing.session import Session
from ...model.solid.provenance import begins_faces
from ..icons import chip_icon, icon, kind_icon, severity_icon
from .drops import MIME
from .tree_rows import Row, longest_rising, runs

if TYPE_CHECKING:
    from ...model.worker.shown import Message

NAME, BADGE, EYE = range(3)
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
        self._definitions: dict[str, Node] = {}
        self.matches: frozenset[str] = frozenset()
        """Ids of the nodes that were searched for, shown in bold."""
        self.renamed_together: frozenset[str] = frozenset()
        """Ids of the nodes that all get what is typed as the name of one of them."""
        self._problems: dict[str, tuple[str, str]] = {}
        self._colour_by_node = False
        self.update(session.document)

    # The document's side.

    def update(self, document: Document) -> None:
        """Follow the document; signals tell only what differs."""
        definitions = {node.id: node for node in document.definitions}
        relabelled = definitions.items() ^ self._definitions.items() if definitions or self._definitions else ()
        self._definitions = definitions
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

        if relabelled:
            self._tell(row.node.id for row in list(self._by_id.values()) if isinstance(row.node, Instance))

    def _tell(self, ids: Iterable[str]) -> None:
        """These rows look otherwise now."""
        for node_id in ids:
            row = self._by_id.get(node_id)
            if row is not None:
                self.dataChanged.emit(self._index(row, NAME), self._index(row, EYE))

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
        self._tell(changed)

    @property
    def problems(self) -> frozenset[str]:
        """Ids of the nodes with an error or a warning."""
        return frozenset(self._problems)

    def rows(self) -> Iterator[Row]:
        """Every row, those above before those below them, from the top of the tree to its foot."""
        stack = list(reversed(self._root.children))
        while stack:
            row = stack.pop()
            yield row
            stack += reversed(row.children)

    def top_rows(self) -> Sequence[Row]:
        return self._root.children

    def holds(self, row: Row) -> bool:
        """Whether the row is still one of the tree's."""
        return self._rows.get(row.key) is row

    def above(self, ids: Iterable[str]) -> set[str]:
        """The ids of the nodes in which these stand."""
        found: set[str] = set()
        for node_id in ids:
            row = self._by_id.get(node_id)
            above = None if row is None else row.parent
            while above is not None and above.node is not None and above.node.id not in found:
                found.add(above.node.id)
                above = above.parent
        return found

    def in_order(self, ids: Collection[str]) -> list[str]:
        """Those of the ids that are shown, from the top of the tree to its foot."""
        return [row.node.id for row in self.rows() if row.node.id in ids]

    def __len__(self) -> int:
        return len(self._by_id)

    def set_colour_by_node(self, by_node: bool) -> None:
        """Show the nodes that make faces in the colours that Colour by node gives them."""
        if by_node != self._colour_by_node:
            self._colour_by_node = by_node
            for row in self._by_id.values():
                index = self._index(row)
                self.dataChanged.emit(index, index, [Qt.ItemDataRole.DecorationRole])

    def _picture(self, node: Node) -> QIcon:
        makes = self._colour_by_node and begins_faces(node) and not isinstance(node, (Instance, *OUTLINES))
        return chip_icon(type(node), distinct_colour(node.id)) if makes else kind_icon(type(node))

    def index_of(self, node_id: str) -> QModelIndex:
        row = self._by_id.get(node_id)
        return NOWHERE if row is None else self._index(row)

    def node(self, index: Index) -> Node | None:
        return self._rows[index.internalId()].node if index.isValid() else None

    def _index(self, row: Row, column: int = NAME) -> QModelIndex:
        if row.parent is None:
            return NOWHERE
        return self.createIndex(row.place(), column, row.key)

    def index_of_row(self, row: Row) -> QModelIndex:
        return self._index(row)

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
                return self._picture(node)
            if role == roles.FontRole and node.id in self.matches:
                font = QFont()
                font.setBold(True)
                return font
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
            shared = self._definitions.get(node.definition)
            if shared is None:
                return node.label
            if not node.name:
                return f"Instance of {shared.label}"
            return (
                f"{node.name} (instance)" if node.name == shared.label else f"{node.name} (instance of {shared.label})"
            )
        return f"{node.label} (definition)" if node.id in self._definitions else node.label

    def label_of(self, node_id: str) -> str:
        """What a node is called, "" where it is not shown."""
        row = self._by_id.get(node_id)
        return "" if row is None else self._label(row.node)

    def flags(self, index: Index) -> Qt.ItemFlag:
        flags = Qt.ItemFlag
        if not index.isValid():
            return flags.ItemIsDropEnabled
        result = flags.ItemIsEnabled | flags.ItemIsSelectable | flags.ItemIsDragEnabled | flags.ItemIsDropEnabled
        return result | flags.ItemIsEditable if index.column() == NAME else result

    def setData(self, index: Index, value: Any, role: int = Qt.ItemDataRole.EditRole) -> bool:
        node = self.node(index)
        if node is None or role != Qt.ItemDataRole.EditRole:
            return False
        if " ".join(str(value).split()) == node.name and node.id not in self.renamed_together:
            return False
        try:
            if node.id in self.renamed_together:
                ids = self.in_order(self.renamed_together)
                self._session.do("rename_each", ids, str(value), label=f"Rename {len(ids)} nodes")
            else:
                self._session.do("rename", node.id, str(value))
        except Refusal as refusal:
            self.refused.emit(str(refusal))
            return False
        return True

    def mimeTypes(self) -> list[str]:
        return [MIME]

    def supportedDropActions(self) -> Qt.DropAction:
        return Qt.DropAction.MoveAction | Qt.DropAction.CopyAction
