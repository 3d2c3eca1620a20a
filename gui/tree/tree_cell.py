"""How one cell of the model tree is drawn and edited."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QModelIndex, QPersistentModelIndex, QRect
from PySide6.QtGui import QIcon, QPainter
from PySide6.QtWidgets import QStyle, QStyledItemDelegate, QStyleOptionViewItem, QWidget

from .tree_model import EYE, NAME


class TreeCell(QStyledItemDelegate):
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
