"""A column of labelled rows that show a node's values and refresh in place."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QToolButton, QVBoxLayout, QWidget

from ...model.document.errors import Refusal
from ...model.document.expression import Number, resolved
from ...model.document.nodes import Node
from ...model.editing.session import Session
from .number_field import Steps
from .property_edit import Edit, sentence
from .property_fields import LABEL_WIDTH, NumberRow


class Form(QWidget):
    """Rows are functions of (node, parameter values) that bring their widgets up to date."""

    refused = Signal(str)

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.session = session
        self.rows: list[Callable[[Node, dict[str, float]], None]] = []
        self.column = QVBoxLayout(self)
        self.column.setContentsMargins(12, 12, 12, 12)
        self.column.setSpacing(6)

    def refresh(self, node: Node, values: dict[str, float]) -> None:
        for row in self.rows:
            row(node, values)

    def retire(self) -> None:
        """Before it goes: what loses the focus by that must not change the document."""
        for child in self.findChildren(QWidget):
            child.blockSignals(True)
        self.deleteLater()

    def heading(self, text: str, button: QToolButton | None = None) -> None:
        label = QLabel(text, self)
        label.setProperty("heading", True)
        line = QHBoxLayout()
        line.setContentsMargins(0, 10, 0, 0)
        line.addWidget(label, 1)
        if button is not None:
            line.addWidget(button)
        self.column.addLayout(line)

    def line(self, label: str, widget: QWidget, tip: str = "") -> None:
        words = QLabel(label, self)
        words.setProperty("muted", True)
        words.setFixedWidth(LABEL_WIDTH)
        words.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        words.setToolTip(tip)
        widget.setToolTip(widget.toolTip() or tip)
        line = QHBoxLayout()
        line.setSpacing(8)
        line.addWidget(words)
        line.addWidget(widget, 1)
        self.column.addLayout(line)

    def number(
        self,
        name: str,
        label: str,
        unit: str,
        steps: Steps,
        edit: Edit,
        value: Callable[[Node], Number | None],
        tip: str = "",
        optional: bool = False,
    ) -> None:
        """A row for one number; `value` finds it in the node."""
        row = NumberRow(label, unit, steps, edit.preview, edit.commit, edit.cancel, tip, optional, self)
        row.field.setObjectName(name)

        def refresh(node: Node, values: dict[str, float]) -> None:
            now = value(node)
            try:
                number = None if now is None else resolved(now, values)
            except Refusal:
                number = None
            row.set_value(now, number)

        self.rows.append(refresh)
        self.column.addWidget(row)

    def tell(self, fault: str | None) -> None:
        """A fault goes to the status bar."""
        if fault:
            self.refused.emit(fault)

    def do(self, operation: str, label: str, *arguments: object) -> bool:
        """Do an operation; a refusal goes to the status bar."""
        try:
            self.session.do(operation, *arguments, label=label)
        except Refusal as refusal:
            self.refused.emit(sentence(refusal))
            return False
        return True
