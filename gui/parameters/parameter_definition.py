"""What a parameter is: name, value, bounds, choices, note and group, each a field; one at a time is open."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QCompleter, QFrame, QGridLayout, QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from ...model.document.document import Document, Parameter
from ...model.document.errors import Refusal
from ...model.document.expression import number
from ...model.editing.session import Session
from ..panels.number_field import text_of
from ..panels.property_edit import sentence
from ..panels.text_line import TextLine
from .parameter_row import flat_button

FIELDS = (
    ("name", "Name", "Letters, digits and _; expressions use it"),
    ("value", "Value", "A number or an expression of other parameters"),
    ("minimum", "Minimum", "With a maximum, the parameter gets a slider"),
    ("maximum", "Maximum", "With a minimum, the parameter gets a slider"),
    ("choices", "Choices", "The numbers that may be chosen, separated by spaces or semicolons: 3; 4; 5"),
    ("note", "Note", "What it is, for whoever turns it"),
    ("group", "Group", "Parameters of a group stand under its heading"),
)


class Definition(QFrame):
    """`closed` comes with Done or Escape. When the parameter is called otherwise, `refresh` tells the new name."""

    closed = Signal()
    moved = Signal(str, int)
    delete_asked = Signal(str)

    def __init__(self, session: Session, parameter: Parameter, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("definition")
        self.setProperty("card", True)
        self._session = session
        self.name = parameter.name
        self.fields: dict[str, TextLine] = {}
        grid = QGridLayout()
        grid.setHorizontalSpacing(8)
        grid.setVerticalSpacing(4)
        for row, (field, title, tip) in enumerate(FIELDS):
            label = QLabel(title, self)
            label.setProperty("muted", True)
            label.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
            label.setToolTip(tip)
            line = TextLine(self)
            line.setObjectName(f"define_{field}")
            line.setAccessibleName(title)
            line.setToolTip(tip)
            line.setPlaceholderText({"minimum": "none", "maximum": "none", "choices": "any"}.get(field, ""))
            line.editingFinished.connect(lambda field=field: self._edited(field))
            grid.addWidget(label, row, 0)
            grid.addWidget(line, row, 1)
            self.fields[field] = line
        groups = sorted({p.group for p in session.document.parameters if p.group})
        self.fields["group"].setCompleter(QCompleter(groups, self))
        self.fault = QLabel(self)
        self.fault.setProperty("fault", True)
        self.fault.setWordWrap(True)
        self.fault.hide()
        self.up = flat_button("up", "Move up in its group", lambda: self.moved.emit(self.name, -1), self)
        self.down = flat_button("down", "Move down in its group", lambda: self.moved.emit(self.name, 1), self)
        self.delete = flat_button("delete", "Delete the parameter", lambda: self.delete_asked.emit(self.name), self)
        done = QPushButton("Done", self)
        done.setObjectName("done")
        done.clicked.connect(self.closed)
        buttons = QHBoxLayout()
        buttons.setSpacing(2)
        for button in (self.up, self.down, self.delete):
            buttons.addWidget(button)
        buttons.addStretch(1)
        buttons.addWidget(done)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(10, 10, 10, 8)
        layout.setSpacing(6)
        layout.addLayout(grid)
        layout.addWidget(self.fault)
        layout.addLayout(buttons)
        self.refresh(parameter)

    def refresh(self, parameter: Parameter) -> None:
        self.name = parameter.name
        texts = {
            "choices": "; ".join(text_of(choice) for choice in parameter.choices),
            "note": parameter.note, "group": parameter.group, "name": parameter.name,
        }  # fmt: skip
        for field, line in self.fields.items():
            text = texts[field] if field in texts else text_of(getattr(parameter, field))
            if line.text() != text and not (line.hasFocus() and line.isModified()):
                line.setText(text)
                line.setCursorPosition(0)
        self.follow_place(self._session.document)

    def follow_place(self, document: Document) -> None:
        """Grey the arrows at the ends of the group."""
        group = document.parameter(self.name).group
        names = [p.name for p in document.parameters if p.group == group]
        self.up.setEnabled(names[0] != self.name)
        self.down.setEnabled(names[-1] != self.name)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape:
            modified = [line for line in self.fields.values() if line.isModified()]
            for line in modified:
                line.setModified(False)
            if modified or self.fault.isVisible():
                self._tell("")
                self.refresh(self._session.document.parameter(self.name))
            else:
                self.closed.emit()
        else:
            super().keyPressEvent(event)

    def _edited(self, field: str) -> None:
        line = self.fields[field]
        if not line.isModified():
            return
        line.setModified(False)
        text = line.text().strip()
        parameter = self._session.document.parameter(self.name)
        try:
            if field == "name":
                if text != self.name:
                    self._session.do("rename_parameter", self.name, text, label=f"Rename {self.name}")
            else:
                value, more = _arguments(parameter, field, text)
                self._session.do("set_parameter", self.name, value, label=f"Change {self.name}", **more)
        except Refusal as refusal:
            self._tell(sentence(refusal))
            line.setProperty("fault", True)
            line.style().polish(line)
            return
        self._tell("")
        self.refresh(self._session.document.parameter(self.name))

    def _tell(self, text: str) -> None:
        self.fault.setText(text)
        self.fault.setVisible(bool(text))
        for line in self.fields.values():
            if line.property("fault"):
                line.setProperty("fault", False)
                line.style().polish(line)


def _arguments(parameter: Parameter, field: str, text: str) -> tuple[Any, dict[str, Any]]:
    """The value and the keywords of `set_parameter`. Raises Refusal."""
    if field == "value":
        return text, {}
    if field in ("note", "group"):
        return parameter.value, {field: " ".join(text.split())}
    if field == "choices":
        words = text.replace(";", " ").split()
        return parameter.value, {"choices": tuple(number(word, "a choice") for word in words)}
    return parameter.value, {field: text or None}
