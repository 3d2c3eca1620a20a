"""A field for one number: it takes units and expressions, and steps by keys and wheel."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QFocusEvent, QKeyEvent, QWheelEvent
from PySide6.QtWidgets import QWidget

from ...model.document.expression import Expression, Number
from .text_line import TextLine

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


class NumberField(TextLine):
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
            self.set_fault(False)

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

    def put(self, text: str) -> None:
        """Write a value over all that is there, or at the cursor into what is being typed."""
        if not self.isModified():
            self.selectAll()
        self.insert(text)

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
