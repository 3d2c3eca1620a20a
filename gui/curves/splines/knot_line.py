"""The knots of a B-spline on a line that can be dragged, under the basis functions that they make."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QFocusEvent, QHelpEvent, QKeyEvent, QMouseEvent, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QToolTip, QWidget

from .knot_drag import KnotDrag, rounded
from .knot_paint import Look, Room, paint

if TYPE_CHECKING:
    from ....model.outline.basis import Basis

Reach = Callable[[tuple[int, ...]], tuple[float, float, bool, bool]]

NEAR, SNAP = 6, 5  # logical pixels
LEAST = 0.004  # of the height: what lies lower is not pointed at
WAY = (
    "Drag a knot; with Alt one of several. Double-click puts one in, Delete takes it out.\n"
    "Click a function to choose its control point."
)
KEYS = (Qt.Key.Key_Left, Qt.Key.Key_Right, Qt.Key.Key_Home, Qt.Key.Key_End, Qt.Key.Key_Delete, Qt.Key.Key_Insert)
TIMES = {1: "once", 2: "twice"}


class KnotLine(QWidget):
    """Shows a `Basis`. `moved` carries the numbers of knots and the value they are dragged to; then `released` or
    `cancelled`.

    `insert_asked` and `remove_asked` carry a parameter; `pointed` the control point whose function was clicked, and the
    mode of `ActiveCurve.choose`; `focused_changed` tells that another knot is the focused one.
    """

    moved = Signal(tuple, float)
    released = Signal()
    cancelled = Signal()
    insert_asked = Signal(float)
    remove_asked = Signal(float)
    pointed = Signal(int, str)
    focused_changed = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.basis: Basis | None = None
        self.chosen: frozenset[int] = frozenset()
        self.locked: frozenset[int] = frozenset()
        self.focused = 0  # the number of a knot
        self.hovered: int | None = None
        self._reach: Reach | None = None
        self._drag: KnotDrag | None = None
        self._keyed = False
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMouseTracking(True)
        self.setAccessibleName("Knots and basis functions")
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)

    def sizeHint(self) -> QSize:
        return QSize(260, 168)

    def minimumSizeHint(self) -> QSize:
        return QSize(120, 168)

    def show_basis(
        self, basis: Basis | None, chosen: frozenset[int], locked: frozenset[int], reach: Reach | None
    ) -> None:
        """`chosen` are control points; `locked` are knots that cannot be moved; `reach` tells how far others can be."""
        self.basis, self.chosen, self.locked, self._reach = basis, chosen, locked, reach
        if basis is None or self.focused >= len(basis.knots):
            self._drag = None
            self.focused = 0
        if basis is not None and self.hovered is not None and self.hovered >= basis.values.shape[1]:
            self.hovered = None
        self._describe()
        self.update()

    def focus_knot(self, number: int) -> None:
        """Make a knot, with those of its value, the focused one."""
        if self.basis is not None and 0 <= number < len(self.basis.knots) and number != self.focused:
            self.focused = number
            self._describe()
            self.update()
            self.focused_changed.emit()

    @property
    def value(self) -> float:
        """Of the focused knot."""
        return 0.0 if self.basis is None else float(self.basis.knots[self.focused])

    @property
    def dragging(self) -> bool:
        return self._drag is not None and self._drag.going

    def _describe(self) -> None:
        self.setAccessibleDescription("" if self.basis is None else self._words(self.basis.stack_of(self.focused)))

    def _words(self, row: int) -> str:
        assert self.basis is not None
        stack = self.basis.stacks[row]
        times = len(stack.numbers)
        words = f"knot {stack.value:.6g}, {TIMES.get(times, f'{times} times')}: "
        if stack.smoothness is not None:
            words += "a corner (C0)" if stack.smoothness == 0 else f"C{stack.smoothness}"
            if self.basis.closed and row in (0, len(self.basis.stacks) - 1):
                words += ", the seam"
        elif times > self.basis.degree:
            words += "the curve ends at its control point"
        else:
            words += "an end, not clamped" if stack.value in self.basis.domain else "outside the curve"
        return words + (" (an expression stands there)" if self.locked & set(stack.numbers) else "")

    # Where things are.

    @property
    def room(self) -> Room:
        """Where the parameters lie; during a drag as it was at its beginning."""
        if self._drag is not None:
            return self._drag.room
        assert self.basis is not None
        return Room.of(QRectF(self.rect()), self.basis)

    def place_of(self, number: int) -> QPointF:
        """The middle of a knot's marker."""
        assert self.basis is not None
        row = self.basis.stack_of(number)
        return self.room.marker(self.basis, row, self.basis.stacks[row].numbers.index(number))

    def _marker_at(self, place: QPointF) -> int | None:
        """The row of the stack at a place, the nearest of several."""
        if self.basis is None or place.y() < self.room.line - NEAR:
            return None
        away = [abs(self.room.x(stack.value) - place.x()) for stack in self.basis.stacks]
        row = min(range(len(away)), key=lambda one: (away[one], one))
        return row if away[row] <= NEAR else None

    def _function_at(self, place: QPointF) -> int | None:
        """The control point whose basis function passes by a place."""
        if self.basis is None or not self.room.top - NEAR <= place.y() <= self.room.line + NEAR:
            return None
        import numpy as np

        parameter = self.room.parameter(place.x())
        start, end = self.basis.domain
        if not start <= parameter <= end:
            return None
        weights = np.array([np.interp(parameter, self.basis.at, column) for column in self.basis.values.T])
        away = np.abs(self.room.y(weights) - place.y())
        away[weights < LEAST] = np.inf
        number = int(away.argmin())
        return number if away[number] <= NEAR else None

    # The mouse.

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() != Qt.MouseButton.LeftButton or self.basis is None or self._keyed:
            return
        row = self._marker_at(event.position())
        if row is None:
            number = self._function_at(event.position())
            if number is not None:
                modifiers = event.modifiers()
                adds = "add" if modifiers & Qt.KeyboardModifier.ShiftModifier else "replace"
                self.pointed.emit(number, "toggle" if modifiers & Qt.KeyboardModifier.ControlModifier else adds)
            return
        stack = self.basis.stacks[row]
        if self.focused not in stack.numbers:
            self.focus_knot(stack.numbers[0])
        if self._reach is not None and not self.locked & set(stack.numbers):
            self._drag = KnotDrag(self.room, stack.numbers, stack.value, event.position().x(), self._reach)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self._drag is None:
            self._hover(event.position())
            return
        modifiers = event.modifiers()
        value = self._drag.to(
            event.position().x(),
            bool(modifiers & Qt.KeyboardModifier.AltModifier),
            0 if modifiers & Qt.KeyboardModifier.ControlModifier else SNAP,
        )
        if value is not None:
            self.focus_knot(self._drag.numbers[0])
            self.moved.emit(self._drag.numbers, value)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton and self._drag is not None:
            going, self._drag = self._drag.going, None
            if going:
                self.released.emit()
            self.update()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        if event.button() != Qt.MouseButton.LeftButton or self.basis is None:
            return
        if self._marker_at(event.position()) is None:
            self._ask_insert(self.room.parameter(event.position().x()))

    def _ask_insert(self, parameter: float) -> None:
        assert self.basis is not None
        start, end = self.basis.domain
        value = rounded(parameter, self.room.step)
        if start < value < end:
            self.insert_asked.emit(value)

    def _hover(self, place: QPointF) -> None:
        marker = self._marker_at(place)
        hovered = None if marker is not None else self._function_at(place)
        if marker is not None:
            self.setCursor(Qt.CursorShape.SizeHorCursor)
        elif hovered is not None:
            self.setCursor(Qt.CursorShape.PointingHandCursor)
        else:
            self.unsetCursor()
        if hovered != self.hovered:
            self.hovered = hovered
            self.update()

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        self.hovered = None
        self.update()

    # The keys.

    def event(self, event: QEvent) -> bool:
        if isinstance(event, QKeyEvent) and event.type() == QEvent.Type.ShortcutOverride and self._takes(event.key()):
            event.accept()
            return True
        if isinstance(event, QHelpEvent) and event.type() == QEvent.Type.ToolTip and self.basis is not None:
            self._tell(event)
            return True
        return super().event(event)

    def _takes(self, key: int) -> bool:
        return key in KEYS or (key == Qt.Key.Key_Escape and (self._drag is not None or self._keyed))

    def _tell(self, event: QHelpEvent) -> None:
        assert self.basis is not None
        place = QPointF(event.pos())
        row, number = self._marker_at(place), self._function_at(place)
        if row is not None:
            words = self._words(row)
        elif number is not None:
            words = f"What control point {number} weighs along the curve"
        else:
            words = WAY
        QToolTip.showText(event.globalPos(), words, self)

    def focusNextPrevChild(self, forward: bool) -> bool:
        """Tab goes from knot to knot, and on from the last."""
        if self.basis is not None and self.hasFocus():
            row = self.basis.stack_of(self.focused) + (1 if forward else -1)
            if 0 <= row < len(self.basis.stacks):
                self.focus_knot(self.basis.stacks[row].numbers[0])
                return True
        return super().focusNextPrevChild(forward)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        key, basis = event.key(), self.basis
        if basis is None:
            super().keyPressEvent(event)
        elif key in (Qt.Key.Key_Left, Qt.Key.Key_Right):
            self._step(1 if key == Qt.Key.Key_Right else -1, event.modifiers())
        elif key in (Qt.Key.Key_Home, Qt.Key.Key_End):
            self.focus_knot(basis.stacks[0 if key == Qt.Key.Key_Home else -1].numbers[0])
        elif key == Qt.Key.Key_Delete:
            self.remove_asked.emit(self.value)
        elif key == Qt.Key.Key_Insert:
            after = min(basis.stack_of(self.focused) + 1, len(basis.stacks) - 1)
            self._ask_insert(0.5 * (basis.stacks[max(after - 1, 0)].value + basis.stacks[after].value))
        elif key == Qt.Key.Key_Escape and (self._drag is not None or self._keyed):
            self._drag, self._keyed = None, False
            self.cancelled.emit()
        else:
            super().keyPressEvent(event)

    def _step(self, way: int, modifiers: Qt.KeyboardModifier) -> None:
        """A hundredth of the line, with Shift a thousandth; with Alt one knot of several."""
        if self.basis is None or self._reach is None or self._drag is not None:
            return
        stack = self.basis.stacks[self.basis.stack_of(self.focused)]
        if self.locked & set(stack.numbers):
            return
        width = self.room.high - self.room.low
        drag = KnotDrag(self.room, stack.numbers, stack.value, 0.0, self._reach)
        share = 0.001 if modifiers & Qt.KeyboardModifier.ShiftModifier else 0.01
        value = drag.by(way * share * width, bool(modifiers & Qt.KeyboardModifier.AltModifier))
        if value is not None:
            self._keyed = True
            self.focus_knot(drag.numbers[0])
            self.moved.emit(drag.numbers, value)

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        if event.key() in (Qt.Key.Key_Left, Qt.Key.Key_Right) and not event.isAutoRepeat():
            self._end_keys()
        super().keyReleaseEvent(event)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        self._end_keys()

    def _end_keys(self) -> None:
        if self._keyed:
            self._keyed = False
            self.released.emit()

    def paintEvent(self, event: QPaintEvent) -> None:
        if self.basis is not None:
            look = Look(self.focused, self.hovered, self.chosen, self.locked, self.hasFocus())
            paint(self, self.room, self.basis, look)
