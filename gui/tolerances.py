"""How fine curved things become: one tolerance for the picture, another one for what is exported."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QVBoxLayout,
    QWidget,
)

from ..model.document.errors import Refusal
from ..model.document.expression import Expression, number

FINEST, COARSEST = 1e-4, 100.0  # mm; finer than that the picture would take minutes
DISPLAY = "Largest distance between the true surface and its facets in the picture.\nSmaller is rounder, and slower."
EXPORT = "Largest distance between the true surface and its facets in files.\nThe export dialog begins with it."


def tolerance_of(text: str, what: str = "the tolerance") -> float:
    """The millimetres that a user typed. Raises Refusal."""
    typed = number(text.strip(), what)
    value = typed.evaluate({}) if isinstance(typed, Expression) else typed
    if not FINEST <= value <= COARSEST:
        raise Refusal(f"{what} lies between {FINEST:g} and {COARSEST:g} mm, not at {value:g}")
    return value


class Tolerances(QDialog):
    """Asks for both; `then` takes (display, export) in mm."""

    def __init__(self, parent: QWidget, display: float, export: float, then: Callable[[float, float], None]) -> None:
        super().__init__(parent)
        self.setWindowTitle("Tolerances")
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._then = then
        self.display = self._field(display, DISPLAY)
        self.export = self._field(export, EXPORT)
        self.fault = QLabel(self)
        self.fault.setProperty("fault", True)
        self.fault.setWordWrap(True)
        words = QLabel(
            "How far curved surfaces and outlines may be from their facets. The document is not changed.", self
        )
        words.setProperty("muted", True)
        words.setWordWrap(True)
        form = QFormLayout()
        form.setHorizontalSpacing(12)
        form.setVerticalSpacing(8)
        form.setLabelAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        form.addRow("&Display", self._line(self.display))
        form.addRow("&Export", self._line(self.export))
        for label, field in zip(("Display", "Export"), (self.display, self.export), strict=True):
            field.setAccessibleName(f"{label} tolerance")
        form.addRow("", self.fault)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Ok | QDialogButtonBox.StandardButton.Cancel, self)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(16, 16, 16, 16)
        layout.addWidget(words)
        layout.addLayout(form)
        layout.addWidget(buttons)

    def _field(self, value: float, tip: str) -> QLineEdit:
        field = QLineEdit(f"{value:g}", self)
        field.setToolTip(tip)
        return field

    def _line(self, field: QLineEdit) -> QHBoxLayout:
        line = QHBoxLayout()
        line.setSpacing(8)
        line.addWidget(field, 1)
        line.addWidget(QLabel("mm", self))
        return line

    def accept(self) -> None:
        try:
            display = tolerance_of(self.display.text(), "the display tolerance")
            export = tolerance_of(self.export.text(), "the export tolerance")
        except Refusal as refusal:
            text = str(refusal)
            self.fault.setText(text[:1].upper() + text[1:])
            return
        super().accept()
        self._then(display, export)
