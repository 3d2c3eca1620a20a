"""The model tree: selection in step with the session, inline rename, eyes, badges, drag and drop, keyboard."""

from __future__ import annotations

from PySide6.QtCore import (
    QEvent,
    QItemSelection,
    QItemSelectionModel,
    QModelIndex,
    QPersistentModelIndex,
    QRect,
    QSize,
    Qt,
    Signal,
)
from PySide6.QtGui import (
    QContextMenuEvent,
    QDragMoveEvent,
    QDropEvent,
    QIcon,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QResizeEvent,
)
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QMenu,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTreeView,
    QWidget,
)

from ...model.document.errors import Refusal
from ...model.editing.session import Session, State
from ..actions import Actions
from .tree_model import BADGE, EYE, NAME, TreeModel

OPEN_AT_MOST = 3000  # rows; a larger tree opens its first level only
DEEP = 24  # levels from which on rows are indented less
WIDE, NARROW = 16, 8  # pixels of indentation
NAME_WIDTH, NARROW_COLUMN = 110, 26
CONTEXT_MENU = (
    "rename", "toggle_visible", "", "union", "difference", "intersection", "hull", "", "linear_array", "polar_array",
    "mirror", "", "duplicate", "link", "unlink", "dissolve", "delete", "", "fit_selection",
)  # fmt: skip


class Tree(QTreeView):
    """The nodes of the session's document. `refused` carries words for the status bar, "" takes them back."""

    refused = Signal(str)

    def __init__(self, session: Session, actions: Actions, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("tree")
        self.setAccessibleName("Model tree")
        self._session = session
        self._actions = actions
        self._collapsed: set[str] = set()
        self._following = False
        self.nodes = TreeModel(session, self)
        self.nodes.refused.connect(self.refused)
        self.setModel(self.nodes)
        self.setHeaderHidden(True)
        header = self.header()
        header.setStretchLastSection(False)
        header.setMinimumSectionSize(20)
        header.setSectionResizeMode(NAME, QHeaderView.ResizeMode.Fixed)
        for column in (BADGE, EYE):
            header.setSectionResizeMode(column, QHeaderView.ResizeMode.Fixed)
            header.resizeSection(column, NARROW_COLUMN)
        self.setItemDelegate(_Cell(self))
        self.setIconSize(QSize(18, 18))
        self.setUniformRowHeights(True)
        self.setSelectionMode(QAbstractItemView.SelectionMode.ExtendedSelection)
        self.setEditTriggers(QAbstractItemView.EditTrigger.EditKeyPressed | QAbstractItemView.EditTrigger.DoubleClicked)
        self.setExpandsOnDoubleClick(False)
        self.setDragDropMode(QAbstractItemView.DragDropMode.DragDrop)
        self.setDefaultDropAction(Qt.DropAction.MoveAction)
        self.setAutoExpandDelay(500)
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
        self._session.select([*earlier, *(i for i in ids if i not in earlier)])

    def _select(self, ids: tuple[str, ...]) -> None:
        indexes = [index for i in ids if (index := self.nodes.index_of(i)).isValid()]
        shown = {index.internalId() for index in self.selectionModel().selectedRows()}
        if shown == {index.internalId() for index in indexes}:
            return
        self._following = True
        try:
            selection = QItemSelection()
            for index in indexes:
                selection.select(index, index.siblingAtColumn(EYE))
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
        if len(self.nodes._by_id) <= OPEN_AT_MOST:
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
        if node is not None:
            (self._collapsed.discard if open_ else self._collapsed.add)(node.id)

    # Mouse and keys.

    def rename_selected(self) -> None:
        index = self.nodes.index_of(self._session.selection[-1]) if self._session.selection else QModelIndex()
        if index.isValid():
            self.setFocus()
            self.setCurrentIndex(index)
            self.edit(index)

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
        if event.key() == Qt.Key.Key_Escape and self.state() != QAbstractItemView.State.EditingState:
            self._session.select(())
            event.accept()
            return
        super().keyPressEvent(event)

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        menu = QMenu(self)
        menu.setToolTipsVisible(True)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        for name in CONTEXT_MENU:
            if name:
                menu.addAction(self._actions[name])
            else:
                menu.addSeparator()
        menu.popup(event.globalPos())

    def dragMoveEvent(self, event: QDragMoveEvent) -> None:
        event.setDropAction(_action_of(event))
        super().dragMoveEvent(event)

    def dropEvent(self, event: QDropEvent) -> None:
        event.setDropAction(_action_of(event))
        super().dropEvent(event)
        self.refused.emit("")


def _action_of(event: QDropEvent) -> Qt.DropAction:
    copy = event.modifiers() & Qt.KeyboardModifier.ControlModifier
    return Qt.DropAction.CopyAction if copy else Qt.DropAction.MoveAction


class _Cell(QStyledItemDelegate):
    """Icons of the narrow columns stand in the middle; the editor of a name is as high as its row."""

    def paint(
        self, painter: QPainter, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        if index.column() == NAME:
            super().paint(painter, option, index)
            return
        self.initStyleOption(option, index)
        picture, option.icon = QIcon(option.icon), QIcon()
        option.features &= ~QStyleOptionViewItem.ViewItemFeature.HasDecoration
        option.widget.style().drawControl(QStyle.ControlElement.CE_ItemViewItem, option, painter, option.widget)
        if not picture.isNull():
            chosen = bool(option.state & QStyle.StateFlag.State_Selected)
            quiet = index.column() == EYE and not chosen
            area = QRect(0, 0, 16, 16)
            area.moveCenter(option.rect.center())
            painter.save()
            painter.setOpacity(0.6 if quiet else 1.0)
            picture.paint(painter, area, mode=picture.Mode.Selected if chosen else picture.Mode.Normal)
            painter.restore()

    def updateEditorGeometry(
        self, editor: QWidget, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        super().updateEditorGeometry(editor, option, index)
        editor.setGeometry(editor.geometry().adjusted(0, 1, 0, -1))

    def eventFilter(self, editor, event) -> bool:  # type: ignore[no-untyped-def]
        # Plain letters belong to the name being typed, not to the shortcuts of the window.
        if event.type() == QEvent.Type.ShortcutOverride:
            event.accept()
            return False
        return super().eventFilter(editor, event)
