"""A line of text that leaves the window's shortcuts to the window."""

from __future__ import annotations

from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import QLineEdit

OWN = (
    QKeySequence.StandardKey.Copy,
    QKeySequence.StandardKey.Cut,
    QKeySequence.StandardKey.Paste,
    QKeySequence.StandardKey.SelectAll,
)


class TextLine(QLineEdit):
    """With Ctrl only the clipboard and what undoes the typing are its own: Qt would take Ctrl+K, Ctrl+U and more."""

    def submit(self) -> None:
        """Make what is typed count now."""
        if self.isModified():
            self.editingFinished.emit()

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent) and not self._takes(event):
            event.ignore()
            return True
        return super().event(event)

    def _takes(self, event: QKeyEvent) -> bool:
        if not event.modifiers() & Qt.KeyboardModifier.ControlModifier:
            return True
        if event.matches(QKeySequence.StandardKey.Undo):
            return self.isUndoAvailable()
        if event.matches(QKeySequence.StandardKey.Redo):
            return self.isRedoAvailable()
        moves = event.key() in (Qt.Key.Key_Left, Qt.Key.Key_Right, Qt.Key.Key_Home, Qt.Key.Key_End)
        erases = event.key() in (Qt.Key.Key_Backspace, Qt.Key.Key_Delete)
        return moves or erases or any(event.matches(key) for key in OWN)
