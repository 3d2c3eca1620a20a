"""The Model panel: the tree, and over it the field that searches it."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt, QTimer
from PySide6.QtGui import QAction, QKeyEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QLineEdit, QToolButton, QVBoxLayout, QWidget

from ...model.document.query import HELP, query
from ...model.editing.session import Session, State
from ..icons import icon
from .tree import Tree

TYPING = 120  # milliseconds of rest before a large tree is searched
LARGE = 2000  # nodes


class ModelPanel(QWidget):
    """Enter goes to the next match, Shift+Enter back, Ctrl+Enter selects all, Down goes into the tree."""

    def __init__(self, session: Session, tree: Tree, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("model")
        self._session = session
        self.tree = tree
        self.field = QLineEdit(self)
        self.field.setObjectName("search")
        self.field.setAccessibleName("Search the tree")
        self.field.setPlaceholderText("Search …")
        self.field.setToolTip(
            "<b>Search the tree</b>&nbsp;&nbsp;Ctrl+F<br>" + HELP.replace("  ", "&nbsp; ")
            + "<br>Enter: next match. Ctrl+Enter: select all matches. Escape: clear."
        )  # fmt: skip
        self._clear = QAction(icon("close"), "Clear", self)
        self._clear.triggered.connect(self._end)
        self.field.addAction(QAction(icon("search"), "", self.field), QLineEdit.ActionPosition.LeadingPosition)
        self.field.addAction(self._clear, QLineEdit.ActionPosition.TrailingPosition)
        self._clear.setVisible(False)
        self.field.installEventFilter(self)
        self.count = QLabel(self)
        self.count.setProperty("muted", True)
        self.count.hide()
        self.all = QToolButton(self)
        self.all.setObjectName("select_matches")
        self.all.setProperty("flat", True)
        self.all.setIcon(icon("select_all"))
        self.all.setToolTip("<b>Select all matches</b>&nbsp;&nbsp;Ctrl+Enter")
        self.all.setAccessibleName("Select all matches")
        self.all.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.all.clicked.connect(self.select_all)
        self.all.hide()
        self._faulty = False
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.timeout.connect(self._search)
        self.field.textChanged.connect(self._typed)
        line = QHBoxLayout()
        line.setContentsMargins(6, 4, 6, 4)
        line.setSpacing(4)
        line.addWidget(self.field, 1)
        line.addWidget(self.count)
        line.addWidget(self.all)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addLayout(line)
        layout.addWidget(tree, 1)
        self.setFocusProxy(tree)

    def session_changed(self, before: State, after: State) -> None:
        """After the tree has followed the session."""
        if self.tree.filter.active:
            self._tell()

    def start(self) -> None:
        self.field.setFocus(Qt.FocusReason.ShortcutFocusReason)
        self.field.selectAll()

    def _typed(self, text: str) -> None:
        self._clear.setVisible(bool(text))
        self._soon.start(TYPING if len(self.tree.nodes) > LARGE and text else 0)

    def _search(self) -> None:
        self._soon.stop()
        asked = query(self.field.text())
        self.tree.search(asked)
        self.field.setProperty("fault", bool(asked.fault))
        self.field.style().polish(self.field)
        self._tell(asked.fault)

    def _tell(self, fault: str = "") -> None:
        """How many there are, and which of them is selected."""
        found, active = self.tree.filter.matches, self.tree.filter.active
        chosen = self._session.selection[-1] if self._session.selection else ""
        place = f"{found.index(chosen) + 1} of " if chosen in found else ""
        self.count.setText(f"{place}{len(found)}" if found else "none")
        self.count.setToolTip(fault or f"{len(found)} nodes match")
        self.count.setVisible(active)
        self.all.setVisible(active and bool(found))
        if fault or self._faulty:
            self.tree.refused.emit(fault[:1].upper() + fault[1:])
        self._faulty = bool(fault)

    def step(self, by: int) -> None:
        """Select the next match, or the one before, round the ends."""
        if self._soon.isActive():
            self._search()
        found = self.tree.filter.matches
        if not found:
            return
        chosen = self._session.selection[-1] if self._session.selection else ""
        place = found.index(chosen) + by if chosen in found else 0 if by > 0 else -1
        self._session.select([found[place % len(found)]])

    def select_all(self) -> None:
        if self._soon.isActive():
            self._search()
        self._session.select(self.tree.filter.matches)

    def _end(self) -> None:
        self.field.clear()
        self._search()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if isinstance(event, QKeyEvent) and event.type() == QEvent.Type.KeyPress:
            held = event.modifiers()
            match event.key():
                case Qt.Key.Key_Return | Qt.Key.Key_Enter:
                    if held & Qt.KeyboardModifier.ControlModifier:
                        self.select_all()
                    else:
                        self.step(-1 if held & Qt.KeyboardModifier.ShiftModifier else 1)
                    return True
                case Qt.Key.Key_Down:
                    self.tree.setFocus()
                    return True
                case Qt.Key.Key_Escape:
                    if self.field.text():
                        self._end()
                    else:
                        self.tree.setFocus()
                    return True
        return super().eventFilter(watched, event)
