"""The choices for a drawing: its views, its page, what it shows."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QCheckBox, QComboBox, QFormLayout, QHBoxLayout, QLabel, QWidget

from ...model.document.document import Document
from ...model.document.errors import Refusal
from ...model.document.expression import Expression, number
from ...model.drafting.paper import SIZES, scale_from
from ...model.drafting.plan import Eye, Plan

VIEWS = (
    ("Isometric", "iso"),
    ("Front", "front"),
    ("Top", "top"),
    ("Right", "right"),
    ("Back", "back"),
    ("Bottom", "bottom"),
    ("Left", "left"),
)
SHEETS = (("Three views, first angle", "first"), ("Three views, third angle", "third"))
SCALES = ("Fit", "10:1", "5:1", "2:1", "1:1", "1:2", "1:5", "1:10", "1:20", "1:50", "1:100")
AUTOMATIC = "Automatic"
TOLERANCES = (AUTOMATIC, "0.05", "0.02", "0.01", "0.005")
ORIENTATIONS = ((AUTOMATIC, ""), ("Landscape", "-landscape"), ("Portrait", "-portrait"))


class Choices(QWidget):
    """`changed` when another one is taken, `typed` while one is being written.

    `present` is what the viewport shows: an eye and the angle of its perspective, None in parallel projection.
    """

    changed = Signal()
    typed = Signal()

    def __init__(
        self, document: Document, name: str, present: tuple[Eye, float | None] | None, parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._name, self._present = name, present
        self.view = QComboBox(self)
        if self._present is not None:
            self.view.addItem("As in the window", ("present", ""))
        for words, view in VIEWS:
            self.view.addItem(words, ("view", view))
        self.view.insertSeparator(self.view.count())
        for words, angle in SHEETS:
            self.view.addItem(words, ("sheet", angle))
        self.iso = Tick("A fourth from a corner", "Three views, of either angle, have room for a fourth", self)
        self.iso.setChecked(True)
        self.page = _editable(SIZES, "A size, or width x height in mm, such as 300x200", self)
        self.orientation = QComboBox(self)
        for words, ending in ORIENTATIONS:
            self.orientation.addItem(words, ending)
        self.scale = _editable(SCALES, "Fit takes the largest standard scale; or write one such as 1:2.5", self)
        self.hidden = QCheckBox("Hidden lines, dashed", self)
        self.hidden.setChecked(True)
        self.faces = QCheckBox("Faces in their colours", self)
        self.dimensions = Tick(
            "Dimensions of the bounding box", "Not in perspective, where lengths change with depth", self
        )
        self.dimensions.setChecked(True)
        self.dimensions.setToolTip("Width, depth and height in mm")
        names = [root.name for root in document.solids if root.visible]
        self.solid = QComboBox(self)
        self.solid.addItem("All visible solids" if len(names) != 1 else names[0], None)
        for name in names if len(names) > 1 else ():
            self.solid.addItem(name, name)
        self.tolerance = _editable(
            TOLERANCES,
            "The largest distance between the true surface and its facets, in millimetres of the model; "
            "Automatic takes what the scale asks for, so that no corners show on the paper",
            self,
        )
        for box in (self.view, self.orientation, self.solid):
            box.currentIndexChanged.connect(self._follow)
        for check in (self.iso, self.hidden, self.faces, self.dimensions):
            check.toggled.connect(self._follow)
        self.page.currentTextChanged.connect(self._follow_page)
        self.scale.currentTextChanged.connect(self.typed)
        self.tolerance.currentTextChanged.connect(self.typed)
        tolerance = QHBoxLayout()
        tolerance.setSpacing(8)
        tolerance.addWidget(self.tolerance, 1)
        tolerance.addWidget(QLabel("mm", self))
        form = QFormLayout(self)
        form.setContentsMargins(0, 0, 0, 0)
        form.setHorizontalSpacing(12)
        form.setVerticalSpacing(8)
        form.setLabelAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        for words, field in (
            ("View", self.view),
            ("", self.iso),
            ("Page", self.page),
            ("Orientation", self.orientation),
            ("Scale", self.scale),
            ("Show", self.hidden),
            ("", self.faces),
            ("", self.dimensions),
            ("Solids", self.solid),
            ("Tolerance", tolerance),
        ):
            form.addRow(words, field)
        self._follow()

    def _follow(self) -> None:
        """Let only those be chosen that count."""
        kind, _ = self.view.currentData()
        self.iso.set_available(kind == "sheet")
        self.dimensions.set_available(kind != "present" or self._present is None or self._present[1] is None)
        self.changed.emit()

    def _follow_page(self) -> None:
        self.orientation.setEnabled(self._size() is not None)
        self.typed.emit()

    def _size(self) -> str | None:
        """The name of the chosen size; None for one of the user's own."""
        written = self.page.currentText().strip().lower()
        return next((size for size in SIZES if size.lower() == written), None)

    def plan(self) -> Plan:
        """What is chosen. Raises Refusal."""
        kind, what = self.view.currentData()
        sheet = what if kind == "sheet" else None
        view: str | Eye = what if kind == "view" else "iso"
        perspective = None
        if kind == "present" and self._present is not None:
            view, perspective = self._present
        size = self._size()
        return Plan(
            view=view,
            perspective=perspective,
            sheet=sheet,
            iso=self.iso.wanted,
            page=self.page.currentText() if size is None else size + self.orientation.currentData(),
            scale=scale_from(self.scale.currentText()),
            hidden="dashed" if self.hidden.isChecked() else "omit",
            faces="fill" if self.faces.isChecked() else "none",
            dimensions=self.dimensions.wanted,
            title=self._name,
        )

    def chosen_tolerance(self) -> float | None:
        """In mm; None for what the scale asks for. Raises Refusal."""
        words = self.tolerance.currentText().strip()
        if words.lower() in ("", AUTOMATIC.lower()):
            return None
        value = number(words, "the tolerance")
        value = value.evaluate({}) if isinstance(value, Expression) else value
        if value <= 0:
            raise Refusal("the tolerance must be above 0")
        return value


class Tick(QCheckBox):
    """A choice that is not there at times: it is grey then, without its tick, and its tip tells why."""

    def __init__(self, words: str, why_not: str, parent: QWidget) -> None:
        super().__init__(words, parent)
        self._why_not, self._tip = why_not, ""
        self._kept: bool | None = None

    @property
    def wanted(self) -> bool:
        """Whether it is ticked, or was when it was there last."""
        return self.isChecked() if self._kept is None else self._kept

    def set_available(self, available: bool) -> None:
        if available == (self._kept is None):
            return
        with QSignalBlocker(self):
            if available:
                self.setChecked(self.wanted)
                self._kept = None
                self.setToolTip(self._tip)
            else:
                self._kept, self._tip = self.isChecked(), self.toolTip()
                self.setChecked(False)
                self.setToolTip(self._why_not)
        self.setEnabled(available)


def _editable(choices: Iterable[str], tip: str, parent: QWidget) -> QComboBox:
    """Choices, or what is typed."""
    box = QComboBox(parent)
    box.setEditable(True)
    box.setInsertPolicy(QComboBox.InsertPolicy.NoInsert)
    box.addItems(list(choices))
    box.setToolTip(tip)
    return box
