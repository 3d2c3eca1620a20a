"""The Problems panel: what could not be evaluated and what is doubtful; a click selects the node."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import QLabel, QListWidget, QListWidgetItem, QStackedLayout, QWidget

from ...model.editing.session import Session
from ..icons import severity_icon
from .property_edit import sentence

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ...model.worker.shown import Message

NODE = Qt.ItemDataRole.UserRole


class Problems(QWidget):
    """`counted` tells how many errors and warnings there are, for the tab's title."""

    counted = Signal(int)

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("problems")
        self._session = session
        self._problems: tuple[Message, ...] = ()
        self.list = QListWidget(self)
        self.list.setAccessibleName("Problems")
        self.list.setWordWrap(True)
        self.list.setIconSize(QSize(16, 16))
        self.list.setTextElideMode(Qt.TextElideMode.ElideRight)
        empty = QLabel("No problems.", self)
        empty.setProperty("muted", True)
        empty.setContentsMargins(12, 10, 12, 0)
        empty.setAlignment(Qt.AlignmentFlag.AlignTop | Qt.AlignmentFlag.AlignLeft)
        self._layout = QStackedLayout(self)
        self._layout.addWidget(empty)
        self._layout.addWidget(self.list)
        self.list.itemClicked.connect(self._select)
        self.list.itemActivated.connect(self._select)

    def set_problems(self, problems: Sequence[Message]) -> None:
        if tuple(problems) != self._problems:
            self._problems = tuple(problems)
            self._fill()
            self.counted.emit(len(self._problems))

    def _fill(self) -> None:
        self.list.clear()
        for problem in sorted(self._problems, key=lambda problem: not problem.error):
            named = f"“{problem.name}”" in problem.message or problem.message.startswith(problem.name)
            text = sentence(problem.message) if named else f"“{problem.name}”: {problem.message}"
            item = QListWidgetItem(severity_icon(problem.error), text)
            item.setData(NODE, problem.node_id)
            item.setToolTip(f"{'Error' if problem.error else 'Warning'}. Click to select “{problem.name}”")
            self.list.addItem(item)
        self._layout.setCurrentIndex(1 if self._problems else 0)

    def _select(self, item: QListWidgetItem) -> None:
        if item.data(NODE):
            self._session.select((item.data(NODE),))
