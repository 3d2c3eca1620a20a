"""Rows of a form for what is written or chosen in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtGui import QFocusEvent, QKeyEvent
from PySide6.QtWidgets import QComboBox, QPlainTextEdit, QWidget

from ....model.document.fields import FieldSpec
from ....model.document.nodes import Node
from ..property_edit import field_edit
from ..text_line import TextLine

if TYPE_CHECKING:
    from ..form import Form

MOST_LINES = 8
WORDS = {"ltr": "left to right", "rtl": "right to left"}


def text_row(form: Form, node_id: str, spec: FieldSpec) -> QWidget:
    """The widget for a field of words, which shows and changes it."""
    if spec.type == "choice":
        return ChoiceRow(form, node_id, spec)
    return (LinesRow if spec.editor == "lines" else LineRow)(form, node_id, spec)


class LinesRow(QPlainTextEdit):
    """Several lines: what is typed is shown at once and becomes one step when the field is left, or with Ctrl+Enter."""

    def __init__(self, form: Form, node_id: str, spec: FieldSpec) -> None:
        super().__init__(form)
        self._edit, self._name, self._form = field_edit(form.session, node_id, spec), spec.name, form
        self.setObjectName(spec.name)
        self.setAccessibleName(spec.label)
        self.setToolTip(f"<b>{spec.tip}</b><br>Ctrl+Enter keeps what is typed, Escape takes it back")
        self.setProperty("field", True)
        self.setTabChangesFocus(True)
        self.document().setDocumentMargin(2)
        self.textChanged.connect(self._typed)
        form.rows.append(self._refresh)

    def _refresh(self, node: Node, values: dict[str, float]) -> None:
        text = str(getattr(node, self._name))
        if text != self.toPlainText():
            self.blockSignals(True)
            self.setPlainText(text)
            self.blockSignals(False)
        lines = min(max(text.count("\n") + 1, 2), MOST_LINES)
        self.setFixedHeight(lines * self.fontMetrics().lineSpacing() + 16)

    def _typed(self) -> None:
        if self.hasFocus():
            self._form.tell(self._edit.preview(self.toPlainText()))

    def _keep(self) -> None:
        if self._form.session.previewing:
            self._form.tell(self._edit.commit(self.toPlainText()))

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        if not self.signalsBlocked():
            self._keep()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        control = event.modifiers() & Qt.KeyboardModifier.ControlModifier
        if control and event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self._keep()
        elif event.key() == Qt.Key.Key_Escape and self._form.session.previewing:
            self._edit.cancel()
        else:
            super().keyPressEvent(event)


class LineRow(TextLine):
    """One line, which counts when it is left or with Enter."""

    def __init__(self, form: Form, node_id: str, spec: FieldSpec) -> None:
        super().__init__(parent=form)
        self._edit, self._name, self._form = field_edit(form.session, node_id, spec), spec.name, form
        self.setObjectName(spec.name)
        self.setAccessibleName(spec.label)
        self.setPlaceholderText("none")
        self.editingFinished.connect(self._done)
        form.rows.append(self._refresh)

    def _refresh(self, node: Node, values: dict[str, float]) -> None:
        text = str(getattr(node, self._name))
        if not (self.hasFocus() and self.isModified()) and text != self.text():
            self.setText(text)

    def _done(self) -> None:
        if self.isModified():
            self.setModified(False)
            self._form.tell(self._edit.commit(self.text()))


class ChoiceRow(QComboBox):
    """One of some words."""

    def __init__(self, form: Form, node_id: str, spec: FieldSpec) -> None:
        super().__init__(form)
        edit = field_edit(form.session, node_id, spec)
        self.setObjectName(spec.name)
        self.setAccessibleName(spec.label)
        for option in spec.options:
            self.addItem(WORDS.get(option, option).capitalize(), option)
        self.activated.connect(lambda: form.tell(edit.commit(self.currentData())))
        form.rows.append(lambda node, values: self.setCurrentIndex(self.findData(getattr(node, spec.name))))
