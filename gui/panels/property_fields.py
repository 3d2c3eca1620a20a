"""The rows of forms: a label that is a slider, a number field, its unit or value, and what is wrong with it."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QPoint, Qt, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSizePolicy, QVBoxLayout, QWidget

from ...model.document.expression import Expression, Number
from .number_field import NumberField, Steps

LABEL_WIDTH = 88
UNIT_WIDTH = 26
PIXELS_A_STEP = 4


class DragLabel(QLabel):
    """A label that is a slider: `dragged` tells the steps since the press, `released` ends it, `escaped` undoes it."""

    dragged = Signal(int, Qt.KeyboardModifier)
    released = Signal()
    escaped = Signal()

    def __init__(self, text: str, parent: QWidget | None = None) -> None:
        super().__init__(text, parent)
        self.setProperty("drag", True)
        self.setCursor(Qt.CursorShape.SizeHorCursor)
        self._from: QPoint | None = None
        self._steps = 0

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self._from, self._steps = event.globalPosition().toPoint(), 0
            self.grabKeyboard()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self._from is not None:
            steps = round((event.globalPosition().x() - self._from.x()) / PIXELS_A_STEP)
            if steps != self._steps:
                self._steps = steps
                self.dragged.emit(steps, event.modifiers())

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if self._from is not None and event.button() == Qt.MouseButton.LeftButton:
            self._end()
            self.released.emit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if self._from is not None and event.key() == Qt.Key.Key_Escape:
            self._end()
            self.escaped.emit()
        else:
            super().keyPressEvent(event)

    def _end(self) -> None:
        self._from = None
        self.releaseKeyboard()


class NumberRow(QWidget):
    """Label, field, unit or an expression's value, and below them what is wrong.

    `preview` and `commit` take the new value (a float, or text as typed) and raise nothing: they return the fault.
    """

    def __init__(
        self,
        label: str,
        unit: str,
        steps: Steps,
        preview: Callable[[float], str | None],
        commit: Callable[[str | float | None], str | None],
        cancel: Callable[[], None],
        tip: str = "",
        optional: bool = False,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self._unit, self._optional = unit, optional
        self._preview, self._commit, self._cancel = preview, commit, cancel
        self._start: float | None = None
        self._latest: float | None = None
        self.label = DragLabel(label, self)
        self.label.setFixedWidth(LABEL_WIDTH)
        self.label.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.field = NumberField(steps, self)
        self.field.setAccessibleName(label)
        if optional:
            self.field.setPlaceholderText("auto")
        hint = "A number, with a unit if you like, or an expression such as width / 2 + 3 mm<br>"
        hint += "↑ ↓ or the wheel: steps; with Shift finer, with Ctrl coarser"
        self.field.setToolTip(f"<b>{tip or label}</b><br>{hint}")
        self.label.setToolTip(f"{tip + chr(10) if tip else ''}Drag to change; Escape takes it back")
        self.unit = QLabel(unit, self)
        self.unit.setProperty("muted", True)
        self.unit.setMinimumWidth(UNIT_WIDTH)
        self.unit.setSizePolicy(QSizePolicy.Policy.Minimum, QSizePolicy.Policy.Preferred)
        self.fault = QLabel(self)
        self.fault.setProperty("fault", True)
        self.fault.setWordWrap(True)
        self.fault.setContentsMargins(LABEL_WIDTH + 8, 0, 0, 2)
        self.fault.hide()
        self.line = line = QHBoxLayout()
        line.setContentsMargins(0, 0, 0, 0)
        line.setSpacing(8)
        for widget in (self.label, self.field, self.unit):
            line.addWidget(widget)
        line.setStretch(1, 1)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(2)
        layout.addLayout(line)
        layout.addWidget(self.fault)
        self.field.typed.connect(self._typed)
        self.field.stepping.connect(self._stepping)
        self.field.stepped.connect(self._stepped)
        self.field.reverted.connect(lambda: self.tell(None))
        self.label.dragged.connect(self._dragged)
        self.label.released.connect(self._stepped)
        self.label.escaped.connect(self._escaped)

    def set_value(self, value: Number | None, resolved: float | None) -> None:
        """Show a value; `resolved` is the number that an expression has now, None where it has none."""
        self.field.set_value(value)
        expression = isinstance(value, Expression)
        known = expression and resolved is not None
        self.unit.setText(f"= {resolved:.6g} {self._unit}".strip() if known else self._unit)
        self.label.setCursor(Qt.CursorShape.SizeHorCursor if isinstance(value, float) else Qt.CursorShape.ArrowCursor)

    def tell(self, fault: str | None) -> None:
        """Show what is wrong with what was typed, None for nothing."""
        self.fault.setText(fault or "")
        self.fault.setVisible(bool(fault))
        self.field.set_fault(bool(fault))

    def _typed(self, text: str) -> None:
        fault = self._commit(None if self._optional and not text else text)
        self.tell(fault)
        if fault is None:
            self.field.revert()

    def _stepping(self, value: float) -> None:
        self._latest = value
        self.tell(self._preview(value))

    def _stepped(self) -> None:
        latest, self._latest, self._start = self._latest, None, None
        if latest is not None:
            self.tell(self._commit(latest))

    def _dragged(self, steps: int, modifiers: Qt.KeyboardModifier) -> None:
        value = self.field._value
        if self._start is None:
            if not isinstance(value, float):
                return
            self._start = value
        self._stepping(self.field.steps.moved(self._start, steps * self.field.steps.size(modifiers)))

    def _escaped(self) -> None:
        self._latest = self._start = None
        self._cancel()
        self.tell(None)
