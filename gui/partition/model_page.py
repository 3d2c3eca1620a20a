"""The page of the model's tree: its picture, a chosen node, a probed point, the painter's order step by step."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QComboBox,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QScrollArea,
    QSizePolicy,
    QSplitter,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from ...model.document.errors import Refusal
from ...model.document.expression import Expression, number
from ..icons import icon
from ..panels.property_edit import sentence
from ..panels.text_line import TextLine
from .order_bar import OrderBar
from .tree_picture import TreePicture
from .tree_source import GOOD, TEXTBOOK
from .way_table import WayTable

BUILDERS = (
    (GOOD, "Good builder", "Looks for planes that cut few faces; the faces of one convex body need none"),
    (TEXTBOOK, "Textbook's builder", "The faces as they come: the first is the root, each further one is put in"),
)


LEGEND = (
    "Choose a node: its plane and both half-spaces are shown in the picture. Circles are planes, squares leaves with "
    "the number of their fragments, dashed ones folded sub-trees, rings half-spaces with nothing in them."
)


class ModelPage(QWidget):
    """The widgets of the page; what they show and do is the explorer's.

    `probed` carries a point that was typed, None where the field was emptied; `refused` why one cannot be read, "" when
    it can.
    """

    builder_chosen = Signal(str)
    sort_asked = Signal()
    probe_asked = Signal(bool)
    probed = Signal(object)
    refused = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.builder = QComboBox(self)
        self.builder.setAccessibleName("Builder of the tree")
        for place, (name, title, tip) in enumerate(BUILDERS):
            self.builder.addItem(title, name)
            self.builder.setItemData(place, tip, Qt.ItemDataRole.ToolTipRole)
        self.builder.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.builder.activated.connect(lambda place: self.builder_chosen.emit(self.builder.itemData(place)))
        self.counts = _words(self)
        self.seen = _words(self)
        self.seen.setProperty("muted", True)
        self.picture = TreePicture(self)
        self.empty = _words(self)
        self.sort = QPushButton("Sort by BSP", self)
        self.sort.setToolTip("Draw the faces in the order of a BSP tree instead of the z-buffer")
        self.sort.clicked.connect(self.sort_asked)
        self.node = _words(self)
        self.node.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.point = TextLine(self)
        self.point.setPlaceholderText("p: x, y, z in mm")
        self.point.setAccessibleName("The probed point p")
        self.point.setToolTip("Three numbers: the way of this point down the tree, with f(p) at each plane")
        self.point.editingFinished.connect(self._probe)
        self.pick = QToolButton(self)
        self.pick.setProperty("flat", True)
        self.pick.setCheckable(True)
        self.pick.setIcon(icon("probe"))
        self.pick.setToolTip("Click a point of a face in the picture")
        self.pick.setAccessibleName(self.pick.toolTip())
        self.pick.clicked.connect(self.probe_asked)
        self.table = WayTable("mm", self)
        self.table.hide()
        self.order = OrderBar(self)
        self._lay_out()
        self.say("", False)

    def _lay_out(self) -> None:
        top = QHBoxLayout()
        top.setContentsMargins(8, 6, 8, 0)
        top.addWidget(self.builder, 1)
        waiting = QVBoxLayout()
        waiting.setContentsMargins(8, 0, 8, 8)
        waiting.addWidget(self.sort, 0, Qt.AlignmentFlag.AlignLeft)
        point = QHBoxLayout()
        point.setContentsMargins(8, 2, 8, 4)
        point.setSpacing(4)
        point.addWidget(self.point, 1)
        point.addWidget(self.pick)
        details = QWidget(self)
        below = QVBoxLayout(details)
        below.setContentsMargins(0, 0, 0, 0)
        below.setSpacing(0)
        scroll = QScrollArea(details)
        scroll.setWidget(self.node)
        scroll.setWidgetResizable(True)
        scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.node.setAlignment(Qt.AlignmentFlag.AlignTop)
        below.addWidget(scroll, 2)
        below.addLayout(point)
        below.addWidget(self.table, 3)
        self._parts = QSplitter(Qt.Orientation.Vertical, self)
        self._parts.addWidget(self.picture)
        self._parts.addWidget(details)
        self._parts.setStretchFactor(0, 1)
        self._parts.setStretchFactor(1, 1)
        self._parts.setChildrenCollapsible(False)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addLayout(top)
        layout.addWidget(self.counts)
        layout.addWidget(self.empty)
        layout.addLayout(waiting)
        layout.addWidget(self._parts, 1)
        layout.addWidget(self.seen)
        layout.addWidget(self.order)
        layout.addStretch(0)

    def say(self, words: str, sortable: bool) -> None:
        """Say why there is no tree, and offer to sort; "" shows the tree."""
        there = not words
        self.empty.setText(words)
        self.empty.setHidden(there)
        self.sort.setVisible(sortable)
        for part in (self.counts, self._parts, self.seen, self.order):
            part.setVisible(there)

    def show_builder(self, builder: str) -> None:
        self.builder.setCurrentIndex(self.builder.findData(builder))

    def show_point(self, point: tuple[float, ...] | None) -> None:
        """Write a point into the field."""
        text = "" if point is None else ", ".join(f"{round(value, 4) + 0.0:.10g}" for value in point)
        if self.point.text() != text:
            self.point.setText(text)
        self.point.setModified(False)

    def _probe(self) -> None:
        if not self.point.isModified():
            return
        self.point.setModified(False)
        text = self.point.text()
        if not text.strip():
            self.refused.emit("")
            self.probed.emit(None)
            return
        try:
            point = point_from(text)
        except Refusal as refusal:
            self.refused.emit(sentence(refusal))
            return
        self.refused.emit("")
        self.probed.emit(point)


def point_from(text: str) -> tuple[float, float, float]:
    """The point that three numbers name. Raises Refusal."""
    parts = [part for part in text.replace(";", ",").split(",") if part.strip()]
    if len(parts) == 1:
        parts = text.split()
    if len(parts) != 3:
        raise Refusal(f"“{text}” is no point: write three numbers such as 10, \u221220, 5")
    x, y, z = (number(part.strip().replace("\u2212", "-"), "the number") for part in parts)
    values = [value.evaluate({}) if isinstance(value, Expression) else float(value) for value in (x, y, z)]
    return values[0], values[1], values[2]


def _words(parent: QWidget) -> QLabel:
    label = QLabel(parent)
    label.setWordWrap(True)
    label.setContentsMargins(8, 5, 8, 5)
    label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
    return label
