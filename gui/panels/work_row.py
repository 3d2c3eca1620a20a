"""What is under way: words, how far it is, and a button that gives it up."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QProgressBar, QSizePolicy, QToolButton, QWidget

from ..icons import icon


class WorkRow(QWidget):
    """Hidden where there is nothing."""

    cancel_asked = Signal()

    def __init__(self, tip: str, parent: QWidget | None = None) -> None:
        """`tip` says what the button gives up."""
        super().__init__(parent)
        self.doing = QLabel(self)
        self.doing.setProperty("muted", True)
        self.doing.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)  # long words widen nothing
        self.progress = QProgressBar(self)
        self.progress.setTextVisible(False)
        self.progress.setAccessibleName("Progress")
        self.cancel = QToolButton(self)
        self.cancel.setProperty("flat", True)
        self.cancel.setIcon(icon("cancel"))
        self.cancel.setText("Cancel")
        self.cancel.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.cancel.setToolTip(tip)
        self.cancel.clicked.connect(self.cancel_asked)
        line = QHBoxLayout(self)
        line.setContentsMargins(10, 0, 6, 4)
        line.setSpacing(8)
        line.addWidget(self.doing, 3)
        line.addWidget(self.progress, 2)
        line.addWidget(self.cancel)
        self.hide()

    def show_work(self, words: str, done: int = 0, total: int = 0) -> None:
        """What is under way, "" for nothing."""
        self.setVisible(bool(words))
        self.doing.setText(words)
        self.progress.setRange(0, total)
        self.progress.setValue(done)
