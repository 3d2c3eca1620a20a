"""What was done so far as lines of Python, as the script API takes them; for reading and copying."""

from __future__ import annotations

from PySide6.QtGui import QFontDatabase, QTextCursor
from PySide6.QtWidgets import QPlainTextEdit, QWidget

from ...model.editing.session import Session, State


class ScriptLog(QPlainTextEdit):
    """Follows the session's log: a step adds a line, undo takes it back."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("script")
        self.setAccessibleName("Script")
        self.setReadOnly(True)
        self.setUndoRedoEnabled(False)
        self.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
        self.setPlaceholderText("Each step appears here as a line of Python.")
        self.document().setDocumentMargin(8)
        self._session = session
        self._lines: tuple[str, ...] = ()
        self._follow()

    def session_changed(self, before: State, after: State) -> None:
        if before.document is not after.document:
            self._follow()

    def _follow(self) -> None:
        lines = self._session.log
        if lines == self._lines:
            return
        if lines[: len(self._lines)] == self._lines:
            for line in lines[len(self._lines) :]:
                self.appendPlainText(line)
        else:
            self.setPlainText("\n".join(lines))
        self._lines = lines
        self.moveCursor(QTextCursor.MoveOperation.End)
        self.ensureCursorVisible()
