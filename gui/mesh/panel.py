"""The Mesh panel. Nothing of it is made before it is looked at."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

if TYPE_CHECKING:
    from ...model.editing.session import State
    from ..window import MainWindow
    from .inspector import MeshInspector


class MeshPanel(QWidget):
    """`refused` carries why something cannot be done; `made` that the inspector is there, once."""

    refused = Signal(str)
    made = Signal()

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window)
        self.setObjectName("mesh")
        self._window = window
        self.in_front = False
        self.inspector: MeshInspector | None = None

    def set_in_front(self, seen: bool) -> None:
        """Whether its tab is the one that is open."""
        self.in_front = seen
        if seen and self.inspector is None:
            from .inspector import MeshInspector

            self.inspector = MeshInspector(self._window, self)
            layout = QVBoxLayout(self)
            layout.setContentsMargins(0, 0, 0, 0)
            layout.addWidget(self.inspector.page)
            self.made.emit()
        if self.inspector is not None:
            self.inspector.set_active(seen)

    def session_changed(self, before: State, after: State) -> None:
        if self.inspector is not None and self.in_front:
            self.inspector.session_changed(before, after)
