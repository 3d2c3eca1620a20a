"""The parts of forms: number fields that take expressions, steps and drags, and the row that holds one with its words."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from PySide6.QtCore import QEvent, QPoint, Qt, QTimer, Signal
from PySide6.QtGui import QFocusEvent, QKeyEvent, QKeySequence, QMouseEvent, QWheelEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QLineEdit, QSizePolicy, QVBoxLayout, QWidget

from ...model.document.expression import Expression, Number

LABEL_WIDTH = 88
UNIT_WIDTH = 26
PIXELS_A_STEP = 4
QUIET = 300  # milliseconds without a notch of the wheel that end a run of them


@dataclass(frozen=True, slots=True)
class Steps:
    """How far a field goes by one step: plain, with Shift, with Ctrl; and its bounds."""

    plain: float = 1.0
    fine: float = 0.1
    coarse: float = 10.0
    minimum: float | None = None
    above: bool = False
    maximum: float | None = None

    def size(self, modifiers: Qt.KeyboardModifier) -> float:
        if modifiers & Qt.KeyboardModifier.ShiftModifier:
            return self.fine
        return self.coarse if modifiers & Qt.KeyboardModifier.ControlModifier else self.plain

    def moved(self, value: float, by: float) -> float:
        new = round(value + by, 9)
        if self.minimum is not None and (new < self.minimum or (self.above and new == self.minimum)):
            new = value if self.above else self.minimum
        return new if self.maximum is None else min(new, self.maximum)


LENGTH = Steps()
STEPS = {
    "angle": Steps(5.0, 1.0, 45.0),
    "count": Steps(1.0, 1.0, 10.0),
    "factor": Steps(0.1, 0.01, 1.0),
    "direction": Steps(0.1, 0.01, 1.0),
}


def text_of(value: Number | None) -> str:
    """A value as its field shows it."""
    if value is None:
        return ""
    return value.text if isinstance(value, Expression) else f"{value:.10g}"


class NumberField(QLineEdit):
    """One number: `typed` on Enter or when the focus goes, `stepping` on the way of steps, then `stepped`.

    `reverted` tells that Escape took back what was typed.
    """

    typed = Signal(str)
    stepping = Signal(float)
    stepped = Signal()
    reverted = Signal()

    def __init__(self, steps: Steps = LENGTH, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.steps = steps
        self._value: Number | None = None
        self._wheel = QTimer(self)
        self._wheel.setSingleShot(True)
        self._wheel.setInterval(QUIET)
        self._wheel.timeout.connect(self._end_steps)
        self._stepping = False
        self.setMinimumWidth(40)
        self.textEdited.connect(lambda: self.set_fault(False))

    def set_value(self, value: Number | None) -> None:
        """Show a value, unless the user is typing another one."""
        typing = self.hasFocus() and self.isModified() and self.text() != text_of(self._value)
        self._value = value
        if not typing and self.text() != text_of(value):
            self.setText(text_of(value))

    def set_fault(self, fault: bool) -> None:
        if bool(self.property("fault")) != fault:
            self.setProperty("fault", fault)
            self.style().unpolish(self)
            self.style().polish(self)

    def revert(self) -> None:
        self.setText(text_of(self._value))
        self.setModified(False)
        self.set_fault(False)
        self.reverted.emit()

    def step(self, count: float, size: float) -> None:
        if isinstance(self._value, float):
            new = self.steps.moved(self._value, count * size)
            if new != self._value:
                self._stepping = True
                self.stepping.emit(new)

    def submit(self) -> None:
        self._end_steps()
        if self.text().strip() != text_of(self._value):
            self.typed.emit(self.text().strip())

    def _end_steps(self) -> None:
        self._wheel.stop()
        if self._stepping:
            self._stepping = False
            self.stepped.emit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        match event.key():
            case Qt.Key.Key_Return | Qt.Key.Key_Enter:
                self.submit()
                self.selectAll()
            case Qt.Key.Key_Escape if self.isModified() or self.property("fault"):
                self.revert()
                self.selectAll()
            case Qt.Key.Key_Up | Qt.Key.Key_Down:
                self.step(1 if event.key() == Qt.Key.Key_Up else -1, self.steps.size(event.modifiers()))
            case _:
                super().keyPressEvent(event)

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        if event.key() in (Qt.Key.Key_Up, Qt.Key.Key_Down) and not event.isAutoRepeat():
            self._end_steps()
        super().keyReleaseEvent(event)

    def wheelEvent(self, event: QWheelEvent) -> None:
        if not self.hasFocus():  # the form scrolls instead
            event.ignore()
            return
        delta = event.angleDelta().y() or event.angleDelta().x()  # Qt swaps the axes with Alt alone
        self.step(delta / 120, self.steps.size(event.modifiers()))
        self._wheel.start()
        event.accept()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        if event.reason() == Qt.FocusReason.PopupFocusReason:
            return
        self.submit()
        if self.property("fault"):
            self.revert()

    def event(self, event: QEvent) -> bool:
        # Undo goes to the document once the typing is done.
        if event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent):
            undo = event.matches(QKeySequence.StandardKey.Undo) and not self.isUndoAvailable()
            redo = event.matches(QKeySequence.StandardKey.Redo) and not self.isRedoAvailable()
            if undo or redo:
                event.ignore()
                return True
        return super().event(event)


class DragLabel(QLabel):
    """A label that is a slider: `dragged` tells whole steps since the press, `released` ends it, `escaped` undoes it."""

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
        line = QHBoxLayout()
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
