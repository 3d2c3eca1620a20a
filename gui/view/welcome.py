"""What stands in the middle of an empty picture: how to begin, by keys and by files."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtWidgets import QFrame, QGridLayout, QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from ..commands.actions import Actions

FIRST = ("add_box", "add_sphere", "add_cylinder", "add_halfspace")
RECENT = 4


class Welcome(QFrame):
    """A card over the viewport. It has a native window of its own, for VTK draws over all that has not."""

    open_asked = Signal(str)

    def __init__(self, actions: Actions, viewport: QWidget) -> None:
        super().__init__(viewport)
        self.setObjectName("welcome")
        self.setAttribute(Qt.WidgetAttribute.WA_NativeWindow)
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setProperty("welcome", True)
        self._viewport = viewport
        viewport.installEventFilter(self)
        self._actions = actions
        self._keys: dict[str, QLabel] = {}
        title = QLabel("Start with a solid", self)
        title.setProperty("title", True)
        keys = QGridLayout()
        keys.setHorizontalSpacing(12)
        keys.setVerticalSpacing(6)
        for row, name in enumerate(FIRST):
            key = self._keys[name] = QLabel(self)
            key.setProperty("key", True)
            key.setAlignment(Qt.AlignmentFlag.AlignCenter)
            button = QPushButton(actions[name].icon(), actions[name].text(), self)
            button.setFlat(True)
            button.setProperty("line", True)
            button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
            button.clicked.connect(actions[name].trigger)
            keys.addWidget(key, row, 0)
            keys.addWidget(button, row, 1, Qt.AlignmentFlag.AlignLeft)
        keys.setColumnStretch(1, 1)
        self._follow_keys()
        actions.keys_changed.connect(self._follow_keys)
        buttons = QHBoxLayout()
        buttons.setSpacing(8)
        for name, text in (("open", "Open a file …"), ("palette", "Find a command …")):
            button = QPushButton(text, self)
            button.setToolTip(actions[name].toolTip())
            button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
            button.clicked.connect(actions[name].trigger)
            buttons.addWidget(button)
        self._recent = QVBoxLayout()
        self._recent.setSpacing(2)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(24, 20, 24, 20)
        layout.setSpacing(12)
        layout.addWidget(title)
        layout.addLayout(keys)
        layout.addLayout(buttons)
        layout.addLayout(self._recent)

    def set_recent(self, paths: list[str]) -> None:
        while (item := self._recent.takeAt(0)) is not None:
            if (widget := item.widget()) is not None:
                widget.deleteLater()
        present = [path for path in paths if Path(path).is_file()][:RECENT]
        if present:
            heading = QLabel("Opened last", self)
            heading.setProperty("heading", True)
            self._recent.addWidget(heading)
        for path in present:
            button = QPushButton(Path(path).name, self)
            button.setFlat(True)
            button.setProperty("line", True)
            button.setToolTip(path)
            button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
            button.clicked.connect(lambda _=False, path=path: self.open_asked.emit(path))
            self._recent.addWidget(button, 0, Qt.AlignmentFlag.AlignLeft)
        self._centre()

    def _follow_keys(self) -> None:
        for name, label in self._keys.items():
            label.setText(self._actions[name].shortcut().toString())
            label.setVisible(bool(label.text()))

    def set_empty(self, empty: bool) -> None:
        """Show the card over an empty document alone."""
        if empty:
            self._centre()
        self.setVisible(empty)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Resize:
            self._centre()
        return super().eventFilter(watched, event)

    def _centre(self) -> None:
        self.adjustSize()
        area = self._viewport.rect()
        self.move((area.width() - self.width()) // 2, max(8, (area.height() - self.height()) // 2))
