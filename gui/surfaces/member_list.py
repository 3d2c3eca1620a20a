"""The list of materials or of lights: one is chosen, double click and F2 rename, Delete takes out."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QSize, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QAbstractItemView, QListWidget, QListWidgetItem, QWidget

MOST_ROWS = 6  # before it scrolls
KEYS = (Qt.Key.Key_F2, Qt.Key.Key_Delete)


class MemberList(QListWidget):
    """As high as its rows; keeps the keys of which the window has other uses."""

    delete_asked = Signal()

    def __init__(self, name: str, picture: int, row: int, parent: QWidget | None = None) -> None:
        """`picture` and `row` are pixels."""
        super().__init__(parent)
        self.setObjectName(name)
        self.setAccessibleName(name.capitalize())
        self.setIconSize(QSize(picture, picture))
        self.setUniformItemSizes(True)
        self._row = row
        triggers = QAbstractItemView.EditTrigger
        self.setEditTriggers(triggers.DoubleClicked | triggers.EditKeyPressed)

    def row_at(self, place: int) -> QListWidgetItem:
        """The item of a row, which is made where it is the next one."""
        item = self.item(place)
        if item is None:
            item = QListWidgetItem(self)
            item.setFlags(item.flags() | Qt.ItemFlag.ItemIsEditable)
            item.setSizeHint(QSize(0, self._row))
        return item

    def cut_to(self, count: int) -> None:
        """Take the rows after the first `count` ones away, and be as high as those need."""
        while self.count() > count:
            self.takeItem(self.count() - 1)
        self.setVisible(count > 0)
        self.setFixedHeight(self._row * min(count, MOST_ROWS) + 3)

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent) and event.key() in KEYS:
            event.accept()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Delete:
            self.delete_asked.emit()
        else:
            super().keyPressEvent(event)
