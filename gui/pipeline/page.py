"""The widgets of the Pipeline panel: the vertex and its stages; frustum, matrices, pixels and counts."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QFrame,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QScrollArea,
    QSizePolicy,
    QSplitter,
    QTabWidget,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from ...model.document.errors import Refusal
from ..icons import icon
from ..panels.number_field import NumberField, Steps
from ..panels.property_edit import sentence
from ..panels.text_line import TextLine
from ..partition.model_page import point_from
from .counts_page import CountsPage
from .frustum.frustum_page import FrustumPage
from .inks import inks_now
from .matrices_page import MatricesPage
from .pixels_view import MODES, PixelsView
from .stage_table import StageTable

EMPTY = (
    "Pick a vertex to follow it to its pixel: press the cross and click a corner in the picture, write x, y, z, or "
    "choose a vertex by its number."
)


class PipelinePage(QWidget):
    """What is shown comes from the explorer. `point_typed` carries a point (x, y, z); `vertex_chosen` the place of a
    solid in the list and the number of its vertex; `refused` why a point cannot be read, "" when it can."""

    point_typed = Signal(object)
    vertex_chosen = Signal(int, int)
    pick_asked = Signal(bool)
    reset_asked = Signal()
    float_asked = Signal(bool)
    cull_asked = Signal(bool)
    refused = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.pick = QToolButton(self)
        self.pick.setProperty("flat", True)
        self.pick.setCheckable(True)
        self.pick.setIcon(icon("probe"))
        self.pick.setToolTip("Click a corner in the picture")
        self.pick.setAccessibleName(self.pick.toolTip())
        self.pick.clicked.connect(self.pick_asked)
        self.floating = QToolButton(self)
        self.floating.setProperty("flat", True)
        self.floating.setCheckable(True)
        self.floating.setIcon(icon("float"))
        self.floating.setToolTip("Let the panel float beside the picture, or put it back")
        self.floating.setAccessibleName(self.floating.toolTip())
        self.floating.clicked.connect(self.float_asked)
        self.point = TextLine(self)
        self.point.setPlaceholderText("x, y, z in mm")
        self.point.setAccessibleName("The followed point")
        self.point.setToolTip("Three numbers in the document\u2019s axes")
        self.point.editingFinished.connect(self._typed)
        self.solid = QComboBox(self)
        self.solid.setAccessibleName("Solid of the vertex")
        self.solid.setMinimumContentsLength(6)
        self.solid.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.solid.activated.connect(lambda place: self.vertex_chosen.emit(place, 0))
        self.vertex = NumberField(Steps(fine=1.0, minimum=0.0), self)
        self.vertex.setAccessibleName("Number of the vertex")
        self.vertex.setPlaceholderText("vertex")
        self.vertex.setToolTip("A vertex by its number in the mesh of the solid; arrow keys go to the next")
        self.vertex.typed.connect(self._number)
        self.vertex.stepping.connect(lambda number: self.vertex_chosen.emit(self.solid.currentIndex(), int(number)))
        self.stages = StageTable(self)
        self.stages.chosen.connect(self.explain)
        self.words = QLabel(EMPTY, self)
        self.words.setWordWrap(True)
        self.words.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.words.setContentsMargins(8, 6, 8, 6)
        self.words.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.state = QFrame(self)
        self.changed = QLabel(self.state)
        self.changed.setWordWrap(True)
        self.reset = QPushButton("Reset all", self.state)
        self.reset.setToolTip("The matrices and planes of the picture again")
        self.reset.clicked.connect(self.reset_asked)
        self.frame = FrustumPage(self)
        self.matrices = MatricesPage(self)
        self.matrices.refused.connect(self.refused)
        self.frame.lens.refused.connect(self.refused)
        self.pixels = PixelsView(self)
        self.counts = CountsPage(self)
        self.tabs = QTabWidget(self)
        self.tabs.setDocumentMode(True)
        self._lay_out()
        self.retint()
        self.show_trial("")

    def _lay_out(self) -> None:
        bar = QHBoxLayout()
        bar.setContentsMargins(8, 6, 8, 6)
        bar.setSpacing(4)
        for widget, stretch in ((self.pick, 0), (self.point, 3), (self.solid, 2), (self.vertex, 1), (self.floating, 0)):
            bar.addWidget(widget, stretch)
        trial = QHBoxLayout(self.state)
        trial.setContentsMargins(8, 4, 8, 4)
        trial.addWidget(self.changed, 1)
        trial.addWidget(self.reset)
        above = QWidget(self)
        column = QVBoxLayout(above)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        scroll = QScrollArea(above)
        scroll.setWidget(self.words)
        scroll.setWidgetResizable(True)
        scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        scroll.setMinimumHeight(44)
        column.addLayout(bar)
        column.addWidget(self.stages)
        column.addWidget(scroll, 1)
        for page, title, tip in (
            (self.frame, "Frustum", "The eye, what it sees, and what is clipped"),
            (self.matrices, "Matrices", "The numbers of each matrix, and what they do"),
            (self._pixels_page(), "Pixels", "What this pipeline draws by itself"),
            (self.counts, "Counts", "How many there are at each stage"),
        ):
            self.tabs.setTabToolTip(self.tabs.addTab(page, title), tip)
        below = QWidget(self)
        rest = QVBoxLayout(below)
        rest.setContentsMargins(0, 0, 0, 0)
        rest.setSpacing(0)
        rest.addWidget(self.state)
        rest.addWidget(self.tabs, 1)
        parts = QSplitter(Qt.Orientation.Vertical, self)
        parts.addWidget(above)
        parts.addWidget(below)
        parts.setStretchFactor(0, 0)
        parts.setStretchFactor(1, 1)
        parts.setChildrenCollapsible(False)
        parts.setSizes([320, 500])
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(parts)

    def _pixels_page(self) -> QWidget:
        page = QWidget(self)
        self.mode = QComboBox(page)
        self.mode.setAccessibleName("What the pixels show")
        for place, (name, title, tip) in enumerate(MODES):
            self.mode.addItem(title, name)
            self.mode.setItemData(place, tip, Qt.ItemDataRole.ToolTipRole)
        self.mode.currentIndexChanged.connect(lambda place: self.pixels.set_mode(self.mode.itemData(place)))
        self.cull = QCheckBox("Back-face culling", page)
        self.cull.setToolTip("Leave out the faces that are turned away from the eye, here and in the picture")
        self.cull.clicked.connect(self.cull_asked)
        words = QLabel(page)
        words.setProperty("muted", True)
        words.setContentsMargins(8, 2, 8, 6)
        words.setMinimumHeight(words.fontMetrics().lineSpacing() + 8)
        words.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.pixels.pointed.connect(words.setText)
        top = QHBoxLayout()
        top.setContentsMargins(8, 4, 8, 4)
        top.setSpacing(10)
        top.addWidget(self.mode)
        top.addWidget(self.cull)
        top.addStretch(1)
        layout = QVBoxLayout(page)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addLayout(top)
        layout.addWidget(self.pixels, 1)
        layout.addWidget(words)
        return page

    # What is shown.

    def explain(self) -> None:
        """The words below the table."""
        self.words.setText(self.stages.words() if self.stages.stages else EMPTY)

    def show_trial(self, words: str) -> None:
        """What is changed here, "" for nothing."""
        self.state.setVisible(bool(words))
        self.changed.setText(f'<b style="color:{inks_now().changed}">Changed here:</b> {words}')
        self.changed.setToolTip("The picture is as it was: this is tried in the panel alone")

    def show_point(self, point: tuple[float, ...] | None) -> None:
        """Write a point of the world into the field, unless the user is typing."""
        if self.point.hasFocus() and self.point.isModified():
            return
        text = "" if point is None else ", ".join(f"{round(value, 4) + 0.0:.10g}" for value in point)
        if self.point.text() != text:
            self.point.setText(text)
            self.point.setCursorPosition(0)
        self.point.setModified(False)

    def show_solids(self, names: list[str], place: int, most: int, vertex: int) -> None:
        """The solids to choose from, the one at `place` chosen; its vertices are numbered up to `most`, and `vertex` is
        followed, -1 for none."""
        self.solid.setVisible(len(names) > 1)
        if [self.solid.itemText(i) for i in range(self.solid.count())] != names:
            self.solid.clear()
            self.solid.addItems(names)
        self.solid.setCurrentIndex(place)
        self.vertex.setEnabled(most >= 0)
        self.vertex.steps = Steps(fine=1.0, minimum=0.0, maximum=float(max(most, 0)))
        self.vertex.set_value(float(vertex) if vertex >= 0 else None)

    def retint(self) -> None:
        """Take the colours of the theme."""
        self.frame.retint()
        self.pixels.set_mode(self.pixels.mode)

    def _number(self, text: str) -> None:
        """A vertex's number that was typed."""
        self.vertex.setModified(False)
        if text and not text.isdecimal():
            self.vertex.set_fault(True)
            self.refused.emit(f"\u201c{text}\u201d is no number of a vertex: write 0, 1, 2 and so on")
            return
        self.refused.emit("")
        self.vertex_chosen.emit(self.solid.currentIndex(), int(text) if text else -1)

    def _typed(self) -> None:
        if not self.point.isModified():
            return
        self.point.setModified(False)
        text = self.point.text()
        try:
            point = None if not text.strip() else point_from(text)
        except Refusal as refusal:
            self.refused.emit(sentence(refusal))
            return
        self.refused.emit("")
        self.point_typed.emit(point)
