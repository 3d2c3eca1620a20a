"""The model tree: selection in step with the session, inline rename, eyes, badges, keyboard, search."""

from __future__ import annotations

from PySide6.QtCore import QItemSelection, QItemSelectionModel, QModelIndex, QSize, Qt
from PySide6.QtGui import QContextMenuEvent, QKeyEvent, QMouseEvent, QResizeEvent
from PySide6.QtWidgets import QAbstractItemDelegate, QAbstractItemView, QHeaderView, QWidget

from ...model.document.errors import Refusal
from ...model.document.query import Query
from ...model.editing.session import Session, State
from ..commands.actions import Actions
from .drop_view import DropView
from .tree_cell import TreeCell
from .tree_filter import TreeFilter
from .tree_menu import node_menu
from .tree_model import BADGE, EYE, NAME, TreeModel
from .tree_rows import adjacent

OPEN_AT_MOST = 3000  # rows; a larger tree opens its first level only
DEEP = 24  # levels from which on rows are indented less
WIDE, NARROW = 16, 8  # pixels of indentation
NAME_WIDTH, NARROW_COLUMN = 110, 26


class Tree(DropView):
    """The nodes of the session's document."""

    def __init__(self, session: Session, actions: Actions, parent: QWidget | None = None) -> None:
        super().__init__(session, parent)
        self.setObjectName("tree")
        self.setAccessibleName("Model tree")
        self._actions = actions
        self._collapsed: set[str] = set()
        self._following = False
        self.nodes = TreeModel(session, self)
        self.nodes.refused.connect(self.refused)
        self.setModel(self.nodes)
        self.filter = TreeFilter(self)
        self.setHeaderHidden(True)
        header = self.header()
        header.setStretchLastSection(False)
        header.setMinimumSectionSize(20)
        header.setSectionResizeMode(NAME, QHeaderView.ResizeMode.Fixed)
        for column in (BADGE, EYE):
            header.setSectionResizeMode(column, QHeaderView.ResizeMode.Fixed)
            header.resizeSection(column, NARROW_COLUMN)
        self.setItemDelegate(TreeCell(self))
        self.setIconSize(QSize(18, 18))
        self.setUniformRowHeights(True)
        self.setSelectionMode(QAbstractItemView.SelectionMode.ExtendedSelection)
        self.setEditTriggers(QAbstractItemView.EditTrigger.EditKeyPressed | QAbstractItemView.EditTrigger.DoubleClicked)
        self.setExpandsOnDoubleClick(False)
        self.setAlternatingRowColors(False)
        self.selectionModel().selectionChanged.connect(self._chosen)
        self.nodes.rowsInserted.connect(self._open)
        self.collapsed.connect(lambda index: self._note(index, False))
        self.expanded.connect(lambda index: self._note(index, True))
        session_state = session.state
        self._fit_columns()
        self._open_all()
        self._select(session_state.selection)

    def session_changed(self, before: State, after: State) -> None:
        new = before.document is not after.document
        if new:
            self._following = True
            try:
                self.nodes.update(after.document)
                self._fit_columns()
            finally:
                self._following = False
            if not self._session.previewing:
                self.filter.refresh()
        if new or before.selection != after.selection:
            self._select(after.selection)

    def document_opened(self) -> None:
        """Forget what was collapsed in the document before."""
        self._collapsed.clear()
        self._open_all()

    # Selection.

    def _chosen(self, selected: QItemSelection, deselected: QItemSelection) -> None:
        if self._following:
            return
        ids = [node.id for index in self.selectionModel().selectedRows() if (node := self.nodes.node(index))]
        chosen = set(ids)
        earlier = [i for i in self._session.selection if i in chosen]  # the order counts: the first one is the base
        self._session.select(dict.fromkeys((*earlier, *ids)))

    def _select(self, ids: tuple[str, ...]) -> None:
        indexes = [index for i in ids if (index := self.nodes.index_of(i)).isValid()]
        shown = {index.internalId() for index in self.selectionModel().selectedRows()}
        if shown == {index.internalId() for index in indexes}:
            return
        self._following = True
        try:
            selection = QItemSelection()
            for first, last in adjacent(indexes):
                selection.select(first, last.siblingAtColumn(EYE))
            flags = QItemSelectionModel.SelectionFlag
            if indexes:
                self.selectionModel().setCurrentIndex(indexes[-1], flags.NoUpdate)
            self.selectionModel().select(selection, flags.ClearAndSelect)
            if indexes:
                self._reveal(indexes[-1])
        finally:
            self._following = False

    def _reveal(self, index: QModelIndex) -> None:
        """Scroll to a row, sideways too where names stand far to the right."""
        self.scrollTo(index)
        left, bar = self.visualRect(index).left(), self.horizontalScrollBar()
        if not 0 <= left <= self.viewport().width() - NAME_WIDTH // 2:
            bar.setValue(bar.value() + left - self.viewport().width() // 3)

    @property
    def selected(self) -> tuple[str, ...]:
        return self._session.selection

    # What is searched for.

    def search(self, query: Query) -> None:
        """Show the nodes that answer to the query, and what they stand in; all where it asks for nothing."""
        self.filter.apply(query)

    # What is open, and how wide it gets.

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._fit_columns()

    def _fit_columns(self) -> None:
        """Names fill the width; below many levels they go on to the right, where the view scrolls."""
        deepest = self.nodes.deepest
        indentation = WIDE if deepest < DEEP else NARROW
        if self.indentation() != indentation:
            self.setIndentation(indentation)
        room = self.viewport().width() - 2 * NARROW_COLUMN
        self.header().resizeSection(NAME, max(room, (deepest + 1) * indentation + NAME_WIDTH))

    def _open_all(self) -> None:
        if len(self.nodes) <= OPEN_AT_MOST:
            self.expandAll()
        else:
            self.expandToDepth(0)

    def _open(self, parent: QModelIndex, first: int, last: int) -> None:
        stack = [self.nodes.index(row, NAME, parent) for row in range(first, last + 1)]
        budget = OPEN_AT_MOST
        while stack and budget:
            index = stack.pop()
            node = self.nodes.node(index)
            budget -= 1
            if node is None or not node.children or node.id in self._collapsed:
                continue
            self.expand(index)
            stack += [self.nodes.index(row, NAME, index) for row in range(self.nodes.rowCount(index))]
        if parent.isValid():
            node = self.nodes.node(parent)
            if node is not None and node.id not in self._collapsed:
                self.expand(parent)

    def _note(self, index: QModelIndex, open_: bool) -> None:
        node = self.nodes.node(index)
        if node is not None and not self.filter.opening:
            (self._collapsed.discard if open_ else self._collapsed.add)(node.id)

    # Mouse and keys.

    def rename_selected(self) -> None:
        """Edit the name of the node selected last; several get what is typed, each with its number."""
        chosen = self._session.selection
        index = self.nodes.index_of(chosen[-1]) if chosen else QModelIndex()
        if index.isValid():
            self.setFocus()
            self.selectionModel().setCurrentIndex(index, QItemSelectionModel.SelectionFlag.NoUpdate)
            self.nodes.renamed_together = frozenset(chosen if len(chosen) > 1 else ())
            if len(chosen) > 1:
                self.refused.emit(f"A name for {len(chosen)} nodes: # stands for the number of each")
            self.edit(index)

    def closeEditor(self, editor: QWidget, hint: QAbstractItemDelegate.EndEditHint) -> None:
        super().closeEditor(editor, hint)
        self.nodes.renamed_together = frozenset()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        index = self.indexAt(event.position().toPoint())
        node = self.nodes.node(index)
        if node is not None and index.column() == EYE and event.button() == Qt.MouseButton.LeftButton:
            ids = list(self._session.selection) if node.id in self._session.selection else [node.id]
            show = not node.visible
            try:
                self._session.do("set_visible", ids, show, label="Show" if show else "Hide")
            except Refusal as refusal:
                self.refused.emit(str(refusal))
            event.accept()
            return
        super().mousePressEvent(event)
        if not index.isValid() and event.button() == Qt.MouseButton.LeftButton:
            self._session.select(())

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        if self.indexAt(event.position().toPoint()).column() == EYE:
            self.mousePressEvent(event)
        else:
            super().mouseDoubleClickEvent(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        editing = self.state() == QAbstractItemView.State.EditingState
        if event.key() == Qt.Key.Key_Escape and not editing:
            self._session.select(())
            event.accept()
        elif event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and not editing and not event.modifiers():
            self.rename_selected()
            event.accept()
        elif event.key() == Qt.Key.Key_Space and not editing and not event.modifiers() and not event.isAutoRepeat():
            self._actions.run("tool_menu")  # as in the picture
            event.accept()
        else:
            super().keyPressEvent(event)

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        node_menu(self._actions, self).popup(event.globalPos())
