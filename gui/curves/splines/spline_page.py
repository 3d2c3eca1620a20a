"""The B-spline page of the Curve panel: degree, knots under their basis functions, weights, and conversion."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import (
    QCheckBox,
    QFrame,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QScrollArea,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from ....model.document.errors import Refusal
from ....model.document.expression import number
from ....model.document.outlines import Bezier, BSpline
from ...icons import icon
from ...panels.heading import heading
from .asked_tip import AskedTip
from .knot_section import KnotSection
from .spline_edits import Previewed, do_and_tell, plain, would
from .spline_words import curve_words
from .weight_row import WeightRow

if TYPE_CHECKING:
    from ....model.outline.basis import Basis
    from ..active import ActiveCurve, Call


class SplinePage(QScrollArea):
    """For the one selected B-spline; of a Bezier curve the degree and the conversion. `told` has words of what was
    done."""

    told = Signal(str)

    def __init__(self, active: ActiveCurve, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._active = active
        self._previewed = Previewed(active)
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setFrameShape(QFrame.Shape.NoFrame)
        body = QWidget(self)
        self.facts = QLabel(body)
        self.facts.setWordWrap(True)
        self.less = _small("minus", "One degree less", self.reduce_degree, body)
        AskedTip(self.less, lambda: f"One degree less: {would(active, 'reduce_degree')}")
        self.degree = QLabel(body)
        self.degree.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.more = _small("add", "One degree more", self.elevate_degree, body)
        self.more.setToolTip("One degree more; the curve stays as it is")
        self.closed = QCheckBox("Closed", body)
        self.knots = KnotSection(active, body)
        self.weight = WeightRow(body)
        self.to_path = _wide("Convert to path", "Bezier segments with nodes and handles, in one step", body)
        self.to_bspline = _wide("Convert to B-spline", "The same curve with knots, so that it can be refined", body)
        self._of_splines = [self.closed, self.knots, self.weight]
        self._lay_out(body)
        self.setWidget(body)
        weight = self.weight
        weight.stepping.connect(lambda value: self._previewed.show([self._weigh(value)], "Weigh control points"))
        weight.stepped.connect(self._previewed.keep)
        weight.typed.connect(self._weight_typed)
        weight.all_one.connect(lambda: active.do_all([self._weigh(1.0, every=True)], "Weights of 1"))
        self.knots.told.connect(self.told)
        self.closed.clicked.connect(self._close)
        self.to_path.clicked.connect(lambda: active.do("convert_to_path", label="Convert to path"))
        self.to_bspline.clicked.connect(lambda: active.do("convert_to_bspline", label="Convert to B-spline"))
        active.changed.connect(self.follow)
        self.follow()

    def applies(self) -> bool:
        return isinstance(self._active.node, (Bezier, BSpline))

    def _lay_out(self, body: QWidget) -> None:
        first = QHBoxLayout()
        first.setSpacing(4)
        first.addWidget(QLabel("Degree", body))
        for widget in (self.less, self.degree, self.more):
            first.addWidget(widget)
        first.addStretch(1)
        first.addWidget(self.closed)
        layout = QVBoxLayout(body)
        layout.setContentsMargins(10, 8, 10, 8)
        layout.setSpacing(6)
        layout.addWidget(self.facts)
        layout.addLayout(first)
        for title, part in (("Knots and basis functions", self.knots), ("Weight", self.weight)):
            above = heading(title, body)
            self._of_splines.append(above)
            layout.addWidget(above)
            layout.addWidget(part)
        layout.addWidget(heading("Conversion", body))
        layout.addWidget(self.to_path)
        layout.addWidget(self.to_bspline)
        layout.addStretch(1)

    # What is done.

    def elevate_degree(self) -> None:
        self._active.do("elevate_degree", label="Elevate degree")

    def reduce_degree(self) -> None:
        """One degree less; how far the curve moved is told."""
        words = do_and_tell(self._active, "reduce_degree", label="Reduce degree")
        if words:
            self.told.emit(words)

    def _close(self, closed: bool) -> None:
        """Knots of an open curve and of a turn differ in number: both begin with even ones."""
        label = "Close" if closed else "Open"
        if getattr(self._active.node, "knots", ()):
            self._active.do("set_fields", label=label, closed=closed, knots=())
        else:
            self._active.do("set_field", "closed", closed, label=label)
        self.follow()

    def _weigh(self, value: float, every: bool = False) -> Call:
        rows = self._active.rows if every else sorted(self._active.chosen)
        return "set_weights", ([place for _, place in rows], value), {}

    def _weight_typed(self, text: str) -> None:
        field = self.weight.field
        try:
            value = plain(self._active, number(text, "the weight of a control point"))
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
        if not self.isVisible() or not isinstance(resolved, (Bezier, BSpline)):
            return
        basis = _basis_of(resolved)
        for widget in self._of_splines:
            widget.setVisible(isinstance(node, BSpline))
        self.to_bspline.setVisible(isinstance(node, Bezier))
        degree = len(resolved.points) - 1 if isinstance(resolved, Bezier) else round(float(resolved.degree))  # type: ignore[arg-type]
        self.facts.setText(curve_words(resolved, basis))
        self.degree.setText(str(degree))
        self.less.setEnabled(degree > 1)
        self.closed.setChecked(resolved.closed)
        uniform = "; its knots become uniform" if getattr(node, "knots", ()) else ""
        self.closed.setToolTip(f"Runs round smoothly{uniform}")
        self.knots.show_basis(basis)
        self._show_weights()

    def _show_weights(self) -> None:
        resolved = self._active.resolved
        if isinstance(resolved, BSpline):
            given: Any = resolved.weights or (1.0,) * len(resolved.points)
            self.weight.show_weights(given, [place for _, place in sorted(self._active.chosen)])


def _basis_of(node: Bezier | BSpline) -> Basis | None:
    if isinstance(node, Bezier):
        return None
    from ....model.outline.basis import basis_of

    try:
        return basis_of(node)
    except Refusal:  # its row in the tree says why
        return None


def _small(name: str, words: str, run: Callable[[], None], parent: QWidget) -> QToolButton:
    button = QToolButton(parent)
    button.setProperty("flat", True)
    button.setIcon(icon(name))
    button.setAccessibleName(words)
    button.clicked.connect(lambda: run())
    return button


def _wide(title: str, tip: str, parent: QWidget) -> QPushButton:
    button = QPushButton(title, parent)
    button.setToolTip(tip)
    button.setAutoDefault(False)
    return button
