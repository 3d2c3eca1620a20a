"""The pairs of solids of which something of their own is asked: to touch, or a clearance."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QPoint, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QMenu, QTreeWidget, QTreeWidgetItem, QWidget

from ...model.proximity.words import length_text

if TYPE_CHECKING:
    from ...model.document.document import Document
    from ...model.proximity.checks import PairCheck

TITLES = ("Pair", "Asked")


class RuleList(QTreeWidget):
    """The signals carry a PairCheck."""

    dropped = Signal(object)
    clearance_asked = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setHeaderLabels(list(TITLES))
        self.setRootIsDecorated(False)
        self.setAccessibleName("Pairs with a rule of their own")
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.header().setStretchLastSection(False)
        self.header().setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        self.header().setSectionResizeMode(1, QHeaderView.ResizeMode.ResizeToContents)
        self.customContextMenuRequested.connect(self._open_menu)
        self.itemDoubleClicked.connect(lambda item: self.clearance_asked.emit(self._rule_of(item)))

    def show_rules(self, document: Document) -> None:
        self.clear()
        names = {root.id: root.name for root in document.solids}
        for rule in document.checks.pairs:
            if rule.one in names and rule.other in names:
                asked = "to touch" if rule.touching else length_text(rule.clearance or 0.0)
                item = QTreeWidgetItem([f"{names[rule.one]} and {names[rule.other]}", asked])
                item.setData(0, Qt.ItemDataRole.UserRole, rule)
                item.setToolTip(0, "Delete takes the rule away, a double click sets another clearance")
                item.setTextAlignment(1, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
                self.addTopLevelItem(item)
        self.setVisible(self.topLevelItemCount() > 0)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        rule = self._rule_of(self.currentItem())
        if rule is not None and event.key() in (Qt.Key.Key_Delete, Qt.Key.Key_Backspace):
            self.dropped.emit(rule)
        else:
            super().keyPressEvent(event)

    def _open_menu(self, at: QPoint) -> None:
        rule = self._rule_of(self.itemAt(at))
        if rule is None:
            return
        menu = QMenu(self)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        menu.addAction("Clearance of this pair …", lambda: self.clearance_asked.emit(rule))
        menu.addAction("As all others\tDel", lambda: self.dropped.emit(rule))
        menu.popup(self.viewport().mapToGlobal(at))

    def _rule_of(self, item: QTreeWidgetItem | None) -> PairCheck | None:
        return None if item is None else item.data(0, Qt.ItemDataRole.UserRole)
