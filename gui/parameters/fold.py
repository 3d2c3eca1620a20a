"""A heading that folds away what stands below it."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QSizePolicy, QToolButton, QVBoxLayout, QWidget

from ..icons import icon


class Fold(QWidget):
    """`column` takes the rows; a click on the heading, or Space on it, shows and hides them."""

    def __init__(self, title: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.heading = QToolButton(self)
        self.heading.setText(title.replace("&", "&&"))
        self.heading.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.heading.setProperty("fold", True)
        self.heading.setCheckable(True)
        self.heading.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.heading.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.content = QWidget(self)
        self.column = QVBoxLayout(self.content)
        self.column.setContentsMargins(0, 4, 0, 8)
        self.column.setSpacing(0)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addWidget(self.heading)
        layout.addWidget(self.content)
        self.heading.toggled.connect(self._toggled)
        self.heading.setChecked(True)

    @property
    def open(self) -> bool:
        return self.heading.isChecked()

    def set_open(self, open_: bool) -> None:
        self.heading.setChecked(open_)

    def _toggled(self, shown: bool) -> None:
        self.heading.setIcon(icon("unfolded" if shown else "folded"))
        self.content.setVisible(shown)
