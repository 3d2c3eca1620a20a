"""One parameter of the customizer: name, the editor that its range or choices call for, its note and what is wrong."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QContextMenuEvent, QMouseEvent, QPainter, QPaintEvent, QPalette, QWheelEvent
from PySide6.QtWidgets import QComboBox, QFrame, QHBoxLayout, QLabel, QSizePolicy, QToolButton, QVBoxLayout, QWidget

from ...model.document.document import Document, Parameter, parameter_values
from ...model.document.errors import Refusal
from ...model.document.expression import Expression, Number
from ...model.editing.session import Session
from ...model.operations.operations import OPERATIONS
from ..icons import icon
from ..panels.number_field import LENGTH, NumberField, Steps, text_of
from ..panels.property_edit import sentence
from .value_slider import ValueSlider, slider_step

EDITOR_WIDTH = 104
CHOICES, RANGE, NUMBER = "choices", "range", "number"


def editor_of(parameter: Parameter) -> str:
    """Which editor a parameter gets: an expression is edited as text whatever bounds it has."""
    if isinstance(parameter.value, Expression):
        return NUMBER
    if parameter.choices:
        return CHOICES
    low, high = parameter.minimum, parameter.maximum
    return RANGE if low is not None and high is not None and low < high else NUMBER


def flat_button(name: str, tip: str, run: Callable[[], Any], parent: QWidget) -> QToolButton:
    button = QToolButton(parent)
    button.setObjectName(name)
    button.setProperty("flat", True)
    button.setIcon(icon(name))
    button.setToolTip(tip)
    button.setAccessibleName(tip)
    button.clicked.connect(run)
    return button


class ChoiceBox(QComboBox):
    """A drop-down that the wheel turns only while it has the focus."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)

    def wheelEvent(self, event: QWheelEvent) -> None:
        if self.hasFocus():
            super().wheelEvent(event)
        else:
            event.ignore()


class NameLabel(QLabel):
    """The parameter's name, elided where there is no room; a double click asks for its definition."""

    double_clicked = Signal()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        text = self.fontMetrics().elidedText(self.text(), Qt.TextElideMode.ElideMiddle, self.width())
        self.style().drawItemText(
            painter,
            self.rect(),
            Qt.AlignmentFlag.AlignVCenter,
            self.palette(),
            True,
            text,
            QPalette.ColorRole.WindowText,
        )

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        self.double_clicked.emit()


class ParameterRow(QFrame):
    """`menu_asked` and `define_asked` carry the parameter's name; `reset_asked` too."""

    menu_asked = Signal(str, object)
    define_asked = Signal(str)
    reset_asked = Signal(str)

    def __init__(self, session: Session, name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.name = name
        self._session = session
        self._kind: object = None
        self._parameter: Parameter | None = None
        self._latest: float | None = None
        self._refused = self._fault = ""
        self.label = NameLabel(name, self)
        self.label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.label.double_clicked.connect(lambda: self.define_asked.emit(self.name))
        self.reset = flat_button("reset", "", lambda: self.reset_asked.emit(self.name), self)
        self.more = flat_button(
            "more", "Define, reset, find users", lambda: self.menu_asked.emit(self.name, None), self
        )
        self.field = NumberField(LENGTH, self)
        self.field.setFixedWidth(EDITOR_WIDTH)
        self.choice = ChoiceBox(self)
        self.choice.setFixedWidth(EDITOR_WIDTH)
        self.slider = ValueSlider(self)
        self.note = QLabel(self)
        self.note.setProperty("muted", True)
        self.note.setWordWrap(True)
        self.note.setTextFormat(Qt.TextFormat.PlainText)
        self.fault = QLabel(self)
        self.fault.setProperty("fault", True)
        self.fault.setWordWrap(True)
        self.fault.setTextFormat(Qt.TextFormat.PlainText)
        line = QHBoxLayout()
        line.setContentsMargins(0, 0, 0, 0)
        line.setSpacing(2)
        line.addWidget(self.label, 1)
        for widget in (self.reset, self.field, self.choice, self.more):
            line.addWidget(widget)
        self.column = QVBoxLayout(self)
        self.column.setContentsMargins(12, 4, 6, 4)
        self.column.setSpacing(2)
        self.column.addLayout(line)
        self._below = QVBoxLayout()
        self._below.setContentsMargins(0, 0, 6, 0)
        self._below.setSpacing(2)
        for widget in (self.slider, self.note, self.fault):
            self._below.addWidget(widget)
        self.column.addLayout(self._below)
        self.field.typed.connect(self._commit)
        self.field.stepping.connect(self._preview)
        self.field.stepped.connect(self._settle)
        self.field.reverted.connect(lambda: self._tell(""))
        self.slider.stepping.connect(self._preview)
        self.slider.stepped.connect(self._settle)
        self.slider.reverted.connect(self._revert)
        self.choice.activated.connect(lambda place: self._commit(self.choice.itemData(place)))
        self.rename(name)

    def rename(self, name: str) -> None:
        """Go on as the row of a parameter that is called otherwise now."""
        self.name = name
        self.setObjectName(f"parameter_{name}")
        self.label.setText(name)
        for editor in (self.field, self.choice, self.slider):
            editor.setAccessibleName(name)

    def _ask_menu(self) -> None:
        self.menu_asked.emit(self.name, None)

    def focus_editor(self) -> None:
        """Put the focus where the value is changed."""
        editor = self.choice if self._kind and self._kind[0] == CHOICES else self.field  # type: ignore[index]
        editor.setFocus(Qt.FocusReason.OtherFocusReason)
        if editor is self.field:
            self.field.selectAll()

    def refresh(self, parameter: Parameter, value: float | None, fault: str, kept: Number | None, whose: str) -> None:
        """Show a parameter, its number and what is wrong with it; `kept` is what `whose` words say it is reset to."""
        if parameter is not self._parameter:
            self._parameter = parameter
            self._refused = ""
            self._show(parameter)
        words = [f"= {value:.6g}"] if value is not None and isinstance(parameter.value, Expression) else []
        words += [parameter.note] if parameter.note else []
        text = "  \u00b7  ".join(words)
        if self.note.text() != text:
            self.note.setText(text)
        self.note.setVisible(bool(text))
        self._fault = fault
        self._tell(self._refused)
        differs = kept is not None and kept != parameter.value
        self.reset.setVisible(differs)
        if differs:
            self.reset.setToolTip(f"Back to {text_of(kept)}, {whose}")

    def _show(self, parameter: Parameter) -> None:
        editor = editor_of(parameter)
        kind = (editor, parameter.name, parameter.minimum, parameter.maximum, parameter.choices)
        if kind != self._kind:
            self._kind = kind
            self.choice.setVisible(editor == CHOICES)
            self.field.setVisible(editor != CHOICES)
            self.slider.setVisible(editor == RANGE)
            self.field.steps = _steps(parameter)
            if editor == RANGE:
                self.slider.set_range(float(parameter.minimum or 0), float(parameter.maximum or 0))
            if editor == CHOICES:
                self.choice.clear()
                for choice in parameter.choices:
                    self.choice.addItem(text_of(choice), choice)
            self.label.setToolTip(self._tip(parameter))
            self.field.setToolTip(self._tip(parameter))
        if editor == CHOICES:
            self.choice.setCurrentIndex(self.choice.findData(parameter.value))
        else:
            self.field.set_value(parameter.value)
        if editor == RANGE:
            self.slider.set_value(float(parameter.value))  # type: ignore[arg-type]

    def _tip(self, parameter: Parameter) -> str:
        low, high = text_of(parameter.minimum), text_of(parameter.maximum)
        bounds = f"{low} to {high}" if low and high else f"at least {low}" if low else f"at most {high}" if high else ""
        lines = [f"<b>{parameter.name}</b>" + (f"&nbsp;&nbsp;{bounds}" if bounds else "")]
        lines.append("A number, with a unit if you like, or an expression of other parameters")
        lines.append("↑ ↓ or the wheel: steps; with Shift finer, with Ctrl coarser")
        return "<br>".join(lines)

    def _tell(self, refused: str) -> None:
        """What was refused just now, else what is wrong with the parameter."""
        self._refused = refused
        text = refused or (sentence(self._fault) if self._fault else "")
        if self.fault.text() != text:
            self.fault.setText(text)
        self.fault.setVisible(bool(text))
        self.field.set_fault(bool(text))

    def _checked(self, document: Document, value: Any) -> Document:
        """The document with the value; refused where the parameter itself would be left without one."""
        after = OPERATIONS["set_parameter"](document, self.name, value)
        fault = parameter_values(after.parameters)[1].get(self.name)
        if fault and self.name not in parameter_values(document.parameters)[1]:
            raise Refusal(fault)
        return after

    def _preview(self, value: float) -> None:
        try:
            self._latest = value
            self._session.preview(self._checked(self._session.document, value))
        except Refusal as refusal:
            self._tell(sentence(refusal))

    def _settle(self) -> None:
        latest, self._latest = self._latest, None
        if latest is not None:
            self._commit(latest)

    def _revert(self) -> None:
        self._latest = None
        self._session.cancel()

    def _commit(self, value: Any) -> None:
        try:
            self._checked(self._session.document, value)
            self._session.do("set_parameter", self.name, value, label=f"Change {self.name}")
        except Refusal as refusal:
            self._session.cancel()
            self._tell(sentence(refusal))
            return
        self._tell("")
        if self.field.isVisible():
            self.field.revert()

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ContextMenu and isinstance(event, QContextMenuEvent):
            self.menu_asked.emit(self.name, event.globalPos())
            return True
        return super().event(event)


def _steps(parameter: Parameter) -> Steps:
    """Of the number field: as fine as the slider with Shift, ten times that without."""
    low, high = parameter.minimum, parameter.maximum
    if low is None or high is None or low >= high:
        return Steps(minimum=low, maximum=high)
    step = slider_step(low, high)
    return Steps(10 * step, step, 100 * step, minimum=low, maximum=high)
