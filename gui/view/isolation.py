"""The card in a corner of the picture that says that only a part of the model is shown, and ends that."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QPushButton, QWidget

from ...model.document.errors import Refusal
from ...model.document.tree import find
from ...model.editing.session import Session
from ..commands.actions import Actions

GAP = 12  # pixels from the corner


class IsolationCard(QFrame):
    """It has a native window of its own, for VTK draws over all that has not."""

    def __init__(self, session: Session, actions: Actions, viewport: QWidget) -> None:
        super().__init__(viewport)
        self.setObjectName("isolation")
        self.setAttribute(Qt.WidgetAttribute.WA_NativeWindow)
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setProperty("welcome", True)
        self._session = session
        self._viewport = viewport
        viewport.installEventFilter(self)
        self.words = QLabel(self)
        button = QPushButton("Show all", self)
        button.setObjectName("end_isolation")
        button.setToolTip(actions["show_all"].toolTip())
        button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        button.clicked.connect(actions["show_all"].trigger)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(10, 6, 6, 6)
        layout.setSpacing(10)
        layout.addWidget(self.words)
        layout.addWidget(button)
        self.hide()

    def follow(self) -> None:
        """Show what the session isolates, or go."""
        ids = self._session.isolated
        if ids:
            try:
                what = f"“{find(self._session.document, ids[0]).label}”" if len(ids) == 1 else f"{len(ids)} nodes"
            except Refusal:
                what = f"{len(ids)} nodes"
            what = self.words.fontMetrics().elidedText(what, Qt.TextElideMode.ElideMiddle, 200)
            self.words.setText(f"Only {what} shown" if len(ids) == 1 else f"Only {what} are shown")
            self._place()
        self.setVisible(bool(ids))

    def _place(self) -> None:
        self.adjustSize()
        self.move(GAP, GAP)
        self.raise_()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if watched is self._viewport and event.type() == QEvent.Type.Resize and self.isVisible():
            self._place()
        return super().eventFilter(watched, event)
