"""The knots of a B-spline in its page: the line, the table, and what is done to them."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QGridLayout, QPushButton, QSizePolicy, QVBoxLayout, QWidget

from ....model.document.errors import Refusal
from ....model.document.expression import Expression, number
from ....model.document.outlines import BSpline
from ...panels.number_field import text_of
from .asked_tip import AskedTip
from .knot_line import KnotLine
from .knot_table import KnotTable
from .spline_edits import Previewed, do_and_tell, plain, would

if TYPE_CHECKING:
    from ....model.outline.basis import Basis
    from ..active import ActiveCurve, Call


class KnotSection(QWidget):
    """`told` has words of what was done."""

    told = Signal(str)

    def __init__(self, active: ActiveCurve, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._active = active
        self._previewed = Previewed(active)
        self._node_id = ""
        self._basis: Basis | None = None
        self._begun: Basis | None = None  # as it was when the drag began
        self._targets: dict[int, float] = {}
        self.line = KnotLine(self)
        self.table = KnotTable(self)
        self.buttons: dict[str, QPushButton] = {}
        work = QGridLayout()
        work.setSpacing(6)
        for place, button in enumerate((
            self._button("Repeat knot", "The chosen knot once more, for a sharper joint; the curve stays as it is",
                         lambda: self._insert(self.line.value)),
            self._button("Remove knot", "", lambda: self._remove(self.line.value)),
            self._button("Refine", "A knot in the middle of every interval; the curve stays as it is",
                         lambda: active.do("refine_knots", label="Refine knots")),
            self._button("Uniform knots", "Even steps from knot to knot; the curve changes",
                         lambda: active.do("set_field", "knots", (), label="Uniform knots")),
        )):  # fmt: skip
            work.addWidget(button, place // 2, place % 2)
        AskedTip(self.buttons["Remove knot"], self._remove_tip)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(6)
        layout.addWidget(self.line)
        layout.addWidget(self.table)
        layout.addLayout(work)
        self.line.moved.connect(self._moved)
        self.line.released.connect(self._released)
        self.line.cancelled.connect(self._cancelled)
        self.line.insert_asked.connect(self._insert)
        self.line.remove_asked.connect(self._remove)
        self.line.pointed.connect(lambda point, mode: active.choose([(0, point)], mode))
        self.line.focused_changed.connect(self._show)
        self.table.picked.connect(self._picked)
        self.table.written.connect(self._written)
        self.table.editor_closed.connect(self._show)

    def _button(self, title: str, tip: str, run: Callable[[], Any]) -> QPushButton:
        button = QPushButton(title, self)
        button.setToolTip(tip)
        button.setAutoDefault(False)
        button.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        button.clicked.connect(lambda: run())
        self.buttons[title] = button
        return button

    # What is done.

    def _moved(self, numbers: tuple[int, ...], value: float) -> None:
        if self._begun is None:
            self._begun = self._basis
        if self._begun is not None:
            targets = self._targets | dict.fromkeys(numbers, value)
            if self._previewed.show(_moves(self._begun, targets), "Move knot"):
                self._targets = targets

    def _released(self) -> None:
        self._begun, self._targets = None, {}
        self._previewed.keep()

    def _cancelled(self) -> None:
        self._begun, self._targets = None, {}
        self._previewed.forget()

    def _picked(self, row: int) -> None:
        if self._basis is not None:
            self.line.focus_knot(self._basis.stacks[row].numbers[0])

    def _written(self, row: int, text: str) -> None:
        """Another value for all knots of a row: a number or an expression."""
        basis = self._basis
        if basis is None or text == self._texts(basis)[row]:
            return
        try:
            given = number(text, "a knot")
            targets = dict.fromkeys(basis.stacks[row].numbers, plain(self._active, given))
        except Refusal as refusal:
            self._active.refused.emit(str(refusal))
        else:
            calls = [(name, (one, given), more) for name, (one, _), more in _moves(basis, targets)]
            self._active.do_all(calls, "Move knot")

    def _insert(self, parameter: float) -> None:
        self._active.do("insert_knot", parameter, label="Insert knot")

    def _remove(self, parameter: float) -> None:
        if self._removable():
            words = do_and_tell(self._active, "remove_knot", parameter, label="Remove knot")
            if words:
                self.told.emit(words)
        else:
            self._active.refused.emit("Knots at the ends and outside the curve stay: choose one between the ends")

    def _remove_tip(self) -> str:
        if not self._removable():
            return "Choose a knot between the ends to take it out"
        return f"Take the chosen knot out: {would(self._active, 'remove_knot', self.line.value)}"

    def _removable(self) -> bool:
        """Whether the focused knot stands between the ends of the curve."""
        return self._basis is not None and self._basis.domain[0] < self.line.value < self._basis.domain[1]

    # What is shown.

    def show_basis(self, basis: Basis | None) -> None:
        """Of the curve as it is now, previewed or not."""
        self._basis = basis
        node = self._active.node
        other = node is None or node.id != self._node_id
        self._node_id = "" if node is None else node.id
        self._show()
        if other and basis is not None:  # the first knot that can be moved without moving an end
            inner = [stack for stack in basis.stacks if basis.domain[0] < stack.value < basis.domain[1]]
            self.line.focus_knot((inner or list(basis.stacks))[0].numbers[0])

    def _texts(self, basis: Basis) -> list[str]:
        """What stands at the first knot of each stack."""
        given = getattr(self._active.node, "knots", ())
        firsts = [given[stack.numbers[0]] if given else None for stack in basis.stacks]
        return [
            text_of(first) if isinstance(first, Expression) else f"{stack.value:.6g}"
            for first, stack in zip(firsts, basis.stacks, strict=True)
        ]

    def _show(self) -> None:
        basis, resolved = self._basis, self._active.resolved
        given = getattr(self._active.node, "knots", ())
        locked = frozenset(row for row, knot in enumerate(given) if isinstance(knot, Expression))
        chosen = frozenset(place for _, place in self._active.chosen)
        if basis is None or not isinstance(resolved, BSpline):
            self.line.show_basis(None, chosen, locked, None)
            return
        from ....model.outline.basis import reach

        self.line.show_basis(basis, chosen, locked, lambda numbers: reach(resolved, basis, numbers))
        row = basis.stack_of(self.line.focused)
        self.table.show_stacks(basis, self._texts(basis), row)
        smoothness = basis.stacks[row].smoothness
        self.buttons["Repeat knot"].setEnabled(self._removable() and smoothness is not None and smoothness > 0)
        self.buttons["Remove knot"].setEnabled(self._removable())
        self.buttons["Uniform knots"].setEnabled(bool(given))


def _moves(basis: Basis, targets: dict[int, float]) -> list[Call]:
    from ....model.outline.basis import in_order

    return [("set_knot", (one, targets[one]), {}) for one in in_order(basis.knots, targets)]
