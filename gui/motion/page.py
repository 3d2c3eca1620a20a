"""The widgets of the Motion panel: the motion, the bar that plays it, and the contacts of the step."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QHBoxLayout,
    QLabel,
    QPushButton,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from ..icons import icon
from ..panels.work_row import WorkRow
from .contact_rows import ContactTable
from .motion_form import MotionForm
from .play_bar import PlayBar

EMPTY = (
    "There is no motion yet. A motion lets a parameter go from one value to another; solids whose place or size "
    "depends on it move. Select what shall move and set it in motion, or add a motion and write its parameter in any "
    "number field."
)


class MotionPage(QWidget):
    """What it shows and does is the panel's."""

    cancel_asked = Signal()
    first_asked = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.form = MotionForm(self)
        self.bar = PlayBar(self)
        self.table = ContactTable(self)
        self.empty = QLabel(EMPTY, self)
        self.empty.setProperty("muted", True)
        self.empty.setWordWrap(True)
        self.empty.setContentsMargins(12, 8, 12, 8)
        self.empty.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.time = QLabel(self)
        self.time.setProperty("muted", True)
        self.time.setMinimumWidth(self.time.fontMetrics().horizontalAdvance("00.00 s, tt = 0.000"))
        self.time.setAccessibleName("Time")
        self.words = QLabel(self)
        self.words.setWordWrap(True)
        self.words.setTextFormat(Qt.TextFormat.PlainText)
        self.words.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.first = QPushButton(icon("contact_next"), "Show", self)
        self.first.setFlat(True)
        self.first.setToolTip("Show the moment of the first contact")
        self.first.clicked.connect(self.first_asked)
        self.words.setContentsMargins(10, 0, 8, 4)
        head = QHBoxLayout()
        head.setContentsMargins(10, 0, 8, 0)
        head.addWidget(self.time)
        head.addStretch(1)
        head.addWidget(self.first)
        self.working = WorkRow("Give up looking for contacts", self)
        self.working.cancel_asked.connect(self.cancel_asked)
        self.right = QWidget(self)
        column = QVBoxLayout(self.right)
        column.setContentsMargins(0, 2, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.bar)
        column.addWidget(self.working)
        column.addLayout(head)
        column.addWidget(self.words)
        column.addWidget(self.table, 1)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addWidget(self.form)
        layout.addWidget(self.empty, 1)
        layout.addWidget(self.right, 1)

    def show_there(self, there: bool) -> None:
        """Whether there is a motion to play."""
        self.empty.setVisible(not there)
        self.right.setVisible(there)

    def show_work(self, words: str, done: int = 0, total: int = 0) -> None:
        """What is under way, "" for nothing."""
        self.working.show_work(words, done, total)

    def say(self, words: str, first: bool = False) -> None:
        """What meets first, or why nothing is known; `first`: there is such a moment to go to."""
        self.words.setText(words)
        self.first.setVisible(first)
