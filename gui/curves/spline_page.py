"""The B-spline page of the Curve panel: knots under their basis functions, degree, weights, and conversion."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import (
    QCheckBox,
    QFrame,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QScrollArea,
    QSizePolicy,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from ...model.document.document import parameter_values
from ...model.document.errors import Refusal
from ...model.document.expression import Expression, number
from ...model.document.outlines import Bezier, BSpline
from ..icons import icon
from ..panels.number_field import text_of
from .knot_line import KnotLine
from .knot_table import KnotTable
from .spline_words import changes_by, curve_words
from .weight_row import WeightRow

if TYPE_CHECKING:
    from ...model.outline.basis import Basis
    from .active import ActiveCurve, Call

SAMPLED = 400  # control points; of more, what would change is not looked for in a tooltip


class SplinePage(QScrollArea):
    """For the one selected B-spline; of a Bezier curve the degree and the conversion. `told` has words of what was
    done."""

    told = Signal(str)

    def __init__(self, active: ActiveCurve, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._active = active
        self._basis: Basis | None = None
        self._begun: Basis | None = None  # as it was when the drag of a knot began
        self._targets: dict[int, float] = {}
        self._pending: tuple[str, list[Call], str] | None = None  # what is previewed: of which node, and its name
        self._tips: dict[QObject, Callable[[], str]] = {}
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setFrameShape(QFrame.Shape.NoFrame)
        body = QWidget(self)
        self.facts = QLabel(body)
        self.facts.setWordWrap(True)
        self.less = self._small("minus", "One degree less", self.reduce_degree, body)
        self.degree = QLabel(body)
        self.degree.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.more = self._small("add", "One degree more", self.elevate_degree, body)
        self.more.setToolTip("One degree more; the curve stays as it is")
        self._tips[self.less] = lambda: f"One degree less: {self._would('reduce_degree')}"
        self.closed = QCheckBox("Closed", body)
        self.line = KnotLine(body)
        self.table = KnotTable(body)
        self.weight = WeightRow(body)
        self.buttons: dict[str, QPushButton] = {}
        self.knot_part, self.weight_part = QWidget(body), QWidget(body)
        self._lay_out(body)
        self.setWidget(body)
        self._connect()
        active.changed.connect(self.follow)
        self.follow()

    def applies(self) -> bool:
        return isinstance(self._active.node, (Bezier, BSpline))

    # How it stands.

    def _small(self, name: str, words: str, run: Callable[[], None], parent: QWidget) -> QToolButton:
        button = QToolButton(parent)
        button.setIcon(icon(name))
        button.setAccessibleName(words)
        button.setToolTip(words)
        button.clicked.connect(run)
        button.installEventFilter(self)
        return button

    def _button(self, title: str, tip: str, run: Callable[[], Any]) -> QPushButton:
        button = QPushButton(title, self)
        button.setToolTip(tip)
        button.setAutoDefault(False)
        button.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        button.clicked.connect(lambda: run())
        button.installEventFilter(self)
        self.buttons[title] = button
        return button

    def _lay_out(self, body: QWidget) -> None:
        first = QHBoxLayout()
        first.setSpacing(4)
        first.addWidget(QLabel("Degree", body))
        for widget in (self.less, self.degree, self.more):
            first.addWidget(widget)
        first.addStretch(1)
        first.addWidget(self.closed)
        knots = QVBoxLayout(self.knot_part)
        knots.setContentsMargins(0, 0, 0, 0)
        knots.setSpacing(6)
        knots.addWidget(_heading("Knots and basis functions", body))
        knots.addWidget(self.line)
        knots.addWidget(self.table)
        work = QGridLayout()
        work.setSpacing(6)
        for place, button in enumerate((
            self._button("Repeat knot", "The chosen knot once more, for a sharper joint; the curve stays as it is",
                         lambda: self._insert(self.line.value)),
            self._button("Remove knot", "", lambda: self._remove(self.line.value)),
            self._button("Refine", "A knot in the middle of every interval; the curve stays as it is",
                         lambda: self._active.do("refine_knots", label="Refine knots")),
            self._button("Uniform knots", "Even steps from knot to knot; the curve changes",
                         lambda: self._active.do("set_field", "knots", (), label="Uniform knots")),
        )):  # fmt: skip
            work.addWidget(button, place // 2, place % 2)
        self._tips[self.buttons["Remove knot"]] = self._remove_tip
        knots.addLayout(work)
        weights = QVBoxLayout(self.weight_part)
        weights.setContentsMargins(0, 0, 0, 0)
        weights.setSpacing(6)
        weights.addWidget(_heading("Weight", body))
        weights.addWidget(self.weight)
        layout = QVBoxLayout(body)
        layout.setContentsMargins(10, 8, 10, 8)
        layout.setSpacing(6)
        layout.addWidget(self.facts)
        layout.addLayout(first)
        layout.addWidget(self.knot_part)
        layout.addWidget(self.weight_part)
        layout.addWidget(_heading("Conversion", body))
        layout.addWidget(self._button("Convert to path", "Bezier segments with nodes and handles, in one step",
                                      lambda: self._active.do("convert_to_path", label="Convert to path")))  # fmt: skip
        layout.addWidget(self._button("Convert to B-spline", "The same curve with knots, so that it can be refined",
                                      lambda: self._active.do("convert_to_bspline", label="Convert to B-spline"))
                         )  # fmt: skip
        layout.addStretch(1)

    def _connect(self) -> None:
        line, table, weight = self.line, self.table, self.weight
        line.moved.connect(self._moved)
        line.released.connect(self._commit)
        line.cancelled.connect(self._forget)
        line.insert_asked.connect(self._insert)
        line.remove_asked.connect(self._remove)
        line.pointed.connect(lambda point, mode: self._active.choose([(0, point)], mode))
        line.focused_changed.connect(self._show_knots)
        table.picked.connect(lambda row: line.focus_knot(self._basis.stacks[row].numbers[0]) if self._basis else None)
        table.written.connect(self._written)
        weight.stepping.connect(lambda value: self._preview([self._weigh(value)], "Weigh control points"))
        weight.stepped.connect(self._commit)
        weight.typed.connect(self._weight_typed)
        weight.all_one.connect(lambda: self._active.do_all([self._weigh(1.0, True)], "Weights of 1"))
        self.closed.clicked.connect(self._close)

    # What is done.

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ToolTip and watched in self._tips and isinstance(watched, QWidget):
            watched.setToolTip(self._tips[watched]())
        return super().eventFilter(watched, event)

    def _preview(self, calls: list[Call], label: str) -> bool:
        node = self._active.node
        if node is None:
            return False
        try:
            self._active.preview_all(calls)
        except Refusal as refusal:
            self._active.refused.emit(str(refusal))
            return False
        self._pending = node.id, calls, label
        return True

    def _commit(self) -> None:
        """Make what is previewed a step."""
        pending, node = self._pending, self._active.node
        self._pending, self._begun, self._targets = None, None, {}
        if pending is not None and node is not None and node.id == pending[0]:
            self._active.do_all(pending[1], pending[2])

    def _forget(self) -> None:
        self._pending, self._begun, self._targets = None, None, {}
        self._active.cancel()

    def _moved(self, numbers: tuple[int, ...], value: float) -> None:
        if self._begun is None:
            self._begun = self._basis
        if self._begun is None:
            return
        targets = self._targets | dict.fromkeys(numbers, value)
        if self._preview(_moves(self._begun, targets), "Move knot"):
            self._targets = targets

    def _written(self, row: int, text: str) -> None:
        """Another value for all knots of a row: a number or an expression."""
        basis = self._basis
        if basis is None:
            return
        try:
            given = number(text, "a knot")
            numbers = basis.stacks[row].numbers
            calls = _moves(basis, dict.fromkeys(numbers, self._plain(given)))
            calls = [(name, (one, given), more) for name, (one, _), more in calls]
        except Refusal as refusal:
            self._active.refused.emit(str(refusal))
        else:
            if text != self._texts(basis)[row]:
                self._active.do_all(calls, "Move knot")
        self._show_knots()

    def _plain(self, value: float | Expression) -> float:
        """Raises Refusal."""
        if isinstance(value, Expression):
            return value.evaluate(parameter_values(self._active.document.parameters)[0])
        return value

    def _insert(self, parameter: float) -> None:
        self._active.do("insert_knot", parameter, label="Insert knot")

    def _remove(self, parameter: float) -> None:
        if not self._removable():
            self._active.refused.emit("Knots at the ends and outside the curve stay: choose one between them")
        else:
            self._changing("remove_knot", parameter, label="Remove knot")

    def elevate_degree(self) -> None:
        self._active.do("elevate_degree", label="Elevate degree")

    def reduce_degree(self) -> None:
        """One degree less; how far the curve moved is told."""
        self._changing("reduce_degree", label="Reduce degree")

    def _changing(self, name: str, *arguments: Any, label: str) -> None:
        """An operation that changes the shape; by how much is told afterwards."""
        before = self._active.document
        node = self._active.node
        if node is not None and self._active.do(name, *arguments, label=label):
            off = changes_by(before, self._active.document, node.id)
            self.told.emit(f"{label}: " + ("the curve is the same" if off is None else f"the curve moved by {off}"))

    def _would(self, name: str, *arguments: Any) -> str:
        """By how much an operation would move the curve, in words."""
        node = self._active.node
        if node is None or len(self._active.rows) > SAMPLED:
            return "the curve changes a little"
        from ...model.operations.operations import OPERATIONS

        try:
            after = OPERATIONS[name](self._active.document, node.id, *arguments)
            off = changes_by(self._active.document, after, node.id)
        except Refusal as refusal:
            return str(refusal)
        return "the curve stays as it is" if off is None else f"the curve moves by {off}"

    def _remove_tip(self) -> str:
        if not self._removable():
            return "Choose a knot between the ends to take it out"
        return f"Take the chosen knot out: {self._would('remove_knot', self.line.value)}"

    def _close(self, closed: bool) -> None:
        label = "Close" if closed else "Open"
        if getattr(self._active.node, "knots", ()):
            self._active.do("set_fields", label=label, closed=closed, knots=())
        else:
            self._active.do("set_field", "closed", closed, label=label)

    def _weigh(self, value: Any, all_points: bool = False) -> Call:
        rows = self._active.rows if all_points else sorted(self._active.chosen)
        return "set_weights", ([place for _, place in rows], value), {}

    def _weight_typed(self, text: str) -> None:
        field = self.weight.field
        try:
            value = self._plain(number(text, "the weight of a control point"))
        except Refusal as refusal:
            field.set_fault(True)
            self._active.refused.emit(str(refusal))
            return
        if not self._active.do_all([self._weigh(value)], "Weigh control points"):
            field.set_fault(True)
            return
        field.setModified(False)
        self._show_weights()

    # What is shown.

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self.follow()

    def follow(self) -> None:
        """Show the curve as it is now."""
        node, resolved = self._active.node, self._active.resolved
        if self._pending is not None and (node is None or node.id != self._pending[0]):
            self._pending, self._begun, self._targets = None, None, {}
        if not self.isVisible():
            return
        self._basis = None
        if isinstance(resolved, BSpline):
            from ...model.outline.basis import basis_of

            try:
                self._basis = basis_of(resolved)
            except Refusal:  # its row in the tree says why
                self._basis = None
        splined = isinstance(node, BSpline)
        self.knot_part.setVisible(splined)
        self.weight_part.setVisible(splined)
        self.closed.setVisible(splined)
        self.buttons["Convert to B-spline"].setVisible(isinstance(node, Bezier))
        if not isinstance(resolved, (Bezier, BSpline)):
            return
        degree = int(resolved.degree) if isinstance(resolved, BSpline) else len(resolved.points) - 1  # type: ignore
        self.facts.setText(curve_words(resolved, self._basis))
        self.degree.setText(str(degree))
        self.less.setEnabled(degree > 1)
        self.closed.setChecked(bool(resolved.closed))
        self.closed.setToolTip("Runs round smoothly" + ("; its knots become uniform" if getattr(node, "knots", ())
                               else ""))  # fmt: skip
        self.buttons["Uniform knots"].setEnabled(bool(getattr(node, "knots", ())))
        self._show_knots()
        self._show_weights()

    def _texts(self, basis: Basis) -> list[str]:
        """What stands at the first knot of each stack."""
        given = getattr(self._active.node, "knots", ())
        return [
            text_of(given[stack.numbers[0]]) if given and isinstance(given[stack.numbers[0]], Expression)
            else f"{stack.value:.6g}"
            for stack in basis.stacks
        ]  # fmt: skip

    def _show_knots(self) -> None:
        basis, node, resolved = self._basis, self._active.node, self._active.resolved
        given = getattr(node, "knots", ())
        locked = frozenset(number for number, knot in enumerate(given) if isinstance(knot, Expression))
        chosen = frozenset(place for _, place in self._active.chosen)
        if basis is None or not isinstance(resolved, BSpline):
            self.line.show_basis(None, chosen, locked, None)
            return
        from ...model.outline.basis import reach

        self.line.show_basis(basis, chosen, locked, lambda numbers: reach(resolved, basis, numbers))
        row = basis.stack_of(self.line.focused)
        self.table.show_stacks(basis, self._texts(basis), row)
        smoothness = basis.stacks[row].smoothness
        self.buttons["Repeat knot"].setEnabled(self._removable() and smoothness is not None and smoothness > 0)
        self.buttons["Remove knot"].setEnabled(self._removable())

    def _removable(self) -> bool:
        """Whether the focused knot stands between the ends of the curve."""
        return self._basis is not None and self._basis.domain[0] < self.line.value < self._basis.domain[1]

    def _show_weights(self) -> None:
        resolved = self._active.resolved
        if isinstance(resolved, BSpline):
            weights = [float(one) for one in resolved.weights or (1.0,) * len(resolved.points)]  # type: ignore
            self.weight.show_weights(weights, [place for _, place in sorted(self._active.chosen)])


def _moves(basis: Basis, targets: dict[int, float]) -> list[Call]:
    from ...model.outline.basis import in_order

    return [("set_knot", (one, targets[one]), {}) for one in in_order(basis.knots, targets)]


def _heading(title: str, parent: QWidget) -> QLabel:
    label = QLabel(title, parent)
    label.setProperty("heading", True)
    label.setContentsMargins(0, 6, 0, 0)
    return label
