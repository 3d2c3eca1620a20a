"""The Joints page of the Curve panel: how smoothly the segments meet, what mends it, and the comb of curvature."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QAbstractItemView,
    QCheckBox,
    QComboBox,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QPushButton,
    QSlider,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from ...model.document.errors import Refusal
from ...model.operations.operations import OPERATIONS

if TYPE_CHECKING:
    from ...model.document.document import Document
    from ...model.outline.joints import JointAt
    from .active import ActiveCurve, Call
    from .comb import CombView

TITLES = ("Node", "Grade", "Angle", "Radius before", "Radius after", "Jump")
TIPS = (
    "Contour and node, counted from 0; “knot” inside a B-spline",
    "G0: the ends meet; G1: with one tangent; G2: with one curvature",
    "Between the tangents, in degrees",
    "Of curvature where the segment ends, in mm",
    "Of curvature where the next one begins, in mm",
    "Of the curvature, as a part of the larger one",
)
MOST_ROWS = 2000
GRADES = {-1: "gap", 0: "G0", 1: "G1", 2: "G2"}
WAYS = {
    "Make smooth": ("smooth_joints", "Turn the handles of the chosen nodes on to one line (G1)"),
    "Harmonise": ("harmonise_joints", "Move the chosen nodes along their handles until the curvatures agree (G2)"),
    "Same curvature": ("match_curvature", "Change the length of handles at the chosen nodes until the curvatures "
                                          "agree (G2); the nodes stay"),
}  # fmt: skip


class JointsPage(QWidget):
    """Lists the joints of the active curve; while seen, it marks those below the wanted grade in the picture."""

    def __init__(self, active: ActiveCurve, view: CombView, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._active, self._view = active, view
        self._rows: list[JointAt] = []
        self._filling = False
        self.facts = QLabel(self)
        self.facts.setProperty("muted", True)
        self.facts.setWordWrap(True)
        self.wanted = QComboBox(self)
        self.wanted.addItem("G1: one tangent", 1)
        self.wanted.addItem("G2: one curvature", 2)
        self.wanted.setCurrentIndex(1)
        self.wanted.setAccessibleName("Wanted grade")
        self.wanted.setToolTip("Joints below this grade are marked in the viewport, and mended by “Fix all”")
        self.table = QTableWidget(0, len(TITLES), self)
        self._set_up_table()
        self.comb = QCheckBox("Curvature comb", self)
        self.comb.setToolTip("Teeth across the curve, as long as it is bent: kinks and bumps of the curvature show")
        self.factor = QSlider(Qt.Orientation.Horizontal, self)
        self.factor.setRange(-20, 20)
        self.factor.setAccessibleName("Length of the comb's teeth")
        self.factor.setToolTip("How long the teeth are")
        self.teeth = QSlider(Qt.Orientation.Horizontal, self)
        self.teeth.setRange(4, 80)
        self.teeth.setValue(24)
        self.teeth.setAccessibleName("Teeth of the comb for each segment")
        self.teeth.setToolTip("How many teeth each segment has")
        self.sharpest = QLabel(self)
        self.sharpest.setProperty("muted", True)
        self.buttons: dict[str, QPushButton] = {}
        self._lay_out()
        self.wanted.currentIndexChanged.connect(lambda _: view.set_wanted(self.wanted.currentData()))
        self.comb.toggled.connect(view.set_on)
        for slider in (self.factor, self.teeth):
            slider.valueChanged.connect(lambda _: view.set_comb(2.0 ** (self.factor.value() / 5.0), self.teeth.value()))
        self.table.itemSelectionChanged.connect(self._picked)
        view.changed.connect(self._fill)
        self._fill()

    def applies(self) -> bool:
        return self._active.path is not None

    def _set_up_table(self) -> None:
        table = self.table
        table.setHorizontalHeaderLabels(TITLES)
        table.setAccessibleName("Joints")
        table.verticalHeader().hide()
        table.verticalHeader().setDefaultSectionSize(24)
        table.setShowGrid(False)
        table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        header = table.horizontalHeader()
        header.setHighlightSections(False)
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        header.setStretchLastSection(True)
        for column, tip in enumerate(TIPS):
            item = table.horizontalHeaderItem(column)
            if item is not None:
                item.setToolTip(tip)

    def _lay_out(self) -> None:
        first = QHBoxLayout()
        first.addWidget(QLabel("Wanted", self))
        first.addWidget(self.wanted, 1)
        ways = QHBoxLayout()
        ways.setSpacing(6)
        for title, (operation, tip) in WAYS.items():
            ways.addWidget(self._button(title, tip, lambda _=False, name=operation, t=title: self._mend(name, t)))
        every = QHBoxLayout()
        every.setSpacing(6)
        for grade in (1, 2):
            tip = f"Bring every joint that is less to G{grade}, in one step"
            every.addWidget(self._button(f"Fix all to G{grade}", tip, lambda _=False, g=grade: self.fix_all(g)))
        lengths = QHBoxLayout()
        lengths.addWidget(self.comb)
        lengths.addWidget(self.factor, 1)
        lengths.addWidget(self.teeth, 1)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(10, 8, 10, 8)
        layout.setSpacing(6)
        layout.addLayout(first)
        layout.addWidget(self.facts)
        layout.addWidget(self.table, 1)
        layout.addLayout(ways)
        layout.addLayout(every)
        layout.addSpacing(4)
        layout.addLayout(lengths)
        layout.addWidget(self.sharpest)

    def _button(self, title: str, tip: str, run: Any) -> QPushButton:
        button = QPushButton(title, self)
        button.setToolTip(tip)
        button.setAutoDefault(False)
        button.clicked.connect(run)
        self.buttons[title] = button
        return button

    def set_seen(self, page: object) -> None:
        """Which page of the panel is seen now: marks stand at joints while it is this one."""
        self._view.set_badges(page is self)

    # What is listed.

    def _fill(self) -> None:
        """The joints, those that are least smooth first."""
        if not self._view.badges:
            return
        self.comb.blockSignals(True)
        self.comb.setChecked(self._view.on)
        self.comb.blockSignals(False)
        rows = sorted(self._view.joints, key=_worst)[:MOST_ROWS]
        self._filling = True
        try:
            self._rows = rows
            self.table.setRowCount(len(rows))
            for row, one in enumerate(rows):
                for column, text in enumerate(_texts(one)):
                    item = self.table.item(row, column)
                    if item is None:
                        item = QTableWidgetItem()
                        side = Qt.AlignmentFlag.AlignLeft if column < 2 else Qt.AlignmentFlag.AlignRight
                        item.setTextAlignment(side | Qt.AlignmentFlag.AlignVCenter)
                        self.table.setItem(row, column, item)
                    if item.text() != text:
                        item.setText(text)
            self._mark_chosen()
        finally:
            self._filling = False
        self.facts.setText(self._summary())
        comb = self._view.comb
        radius = None if comb is None else comb.radius
        self.factor.setEnabled(self._view.on)
        self.teeth.setEnabled(self._view.on)
        self.sharpest.setText(
            "" if radius is None else f"Smallest radius of curvature {radius:.4g} mm, marked by a ring"
        )
        chosen = bool(self._active.chosen) and not self._active.by_points
        for title in WAYS:
            self.buttons[title].setEnabled(chosen)
        below = [min((one.grade for one in self._mendable()), default=2) < grade for grade in (1, 2)]
        for grade, any_below in zip((1, 2), below, strict=True):
            self.buttons[f"Fix all to G{grade}"].setEnabled(any_below)

    def _summary(self) -> str:
        if self._active.path is None:
            return "Select an outline to see how its segments meet."
        joints = self._view.joints
        if not joints:
            return "One piece, without joints."
        counts = [sum(one.grade == grade for one in joints) for grade in (-1, 0, 1, 2)]
        words = ["with a gap", "G0", "G1", "G2 or better"]
        told = ", ".join(f"{count} {word}" for count, word in zip(counts, words, strict=True) if count)
        return f"{len(joints)} joint{'s' * (len(joints) != 1)}: {told}"

    def _mark_chosen(self) -> None:
        self.table.clearSelection()
        mode = self.table.selectionMode()
        self.table.setSelectionMode(QAbstractItemView.SelectionMode.MultiSelection)
        for row, one in enumerate(self._rows):
            if one.node is not None and (one.contour, one.node) in self._active.chosen:
                self.table.selectRow(row)
        self.table.setSelectionMode(mode)

    def _picked(self) -> None:
        if self._filling:
            return
        rows = {index.row() for index in self.table.selectionModel().selectedRows()}
        places = [(self._rows[row].contour, self._rows[row].node) for row in rows]
        self._active.choose((contour, node) for contour, node in places if node is not None)

    # What mends them.

    def _mend(self, operation: str, title: str) -> None:
        self._active.do(operation, sorted(self._active.chosen), label=title)

    def _mendable(self) -> list[JointAt]:
        return [one for one in self._view.joints if one.node is not None]

    def fix_all(self, grade: int) -> None:
        """Every joint below the grade, in one step; what cannot be mended is told."""
        node = self._active.node
        if node is None:
            return
        document, calls, faults = self._active.document, [], []
        for one in self._mendable():
            if one.grade >= grade:
                continue
            try:
                for operation in (["smooth_joints"] if one.grade < 1 else []) + ["harmonise_joints"] * (grade == 2):
                    document, call = _with(document, node.id, operation, one)
                    calls.append(call)
            except Refusal as refusal:
                faults.append(f"node {one.node}: {refusal}")
        if calls:
            self._active.do_all(calls, f"Fix joints to G{grade}")
        if faults:
            more = f" (and {len(faults) - 1} more)" if len(faults) > 1 else ""
            self._active.refused.emit(f"{faults[0]}{more}")


def _with(document: Document, node_id: str, operation: str, one: JointAt) -> tuple[Document, Call]:
    """The document with one joint mended, and the call that does it. Raises Refusal."""
    arguments = ([(one.contour, one.node)],)
    return OPERATIONS[operation](document, node_id, *arguments), (operation, arguments, {})


def _worst(one: JointAt) -> tuple[float, ...]:
    return (one.grade, -one.joint.angle, -one.joint.jump, one.contour, -1 if one.node is None else one.node)


def _texts(one: JointAt) -> tuple[str, ...]:
    node = "knot" if one.node is None else str(one.node)
    joint = one.joint
    before, after = (abs(k) for k in joint.curvatures)
    most = max(before, after)
    jump = "" if one.grade < 1 or not most else f"{100.0 * joint.jump / most:.3g} %"
    radii = ("straight" if radius == float("inf") else f"{radius:.4g}" for radius in one.radii)
    place = node if one.contour == 0 else f"{one.contour}: {node}"
    return place, GRADES[min(one.grade, 2)], f"{joint.angle:.3g}°", *radii, jump
