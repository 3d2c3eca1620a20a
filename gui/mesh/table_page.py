"""One of the panel's tables with what picks out its rows: a filter, a number to go to, the clipboard, a file."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QIntValidator
from PySide6.QtWidgets import QComboBox, QDoubleSpinBox, QHBoxLayout, QLabel, QSizePolicy, QVBoxLayout, QWidget

from ..panels.text_line import TextLine
from .choices import ALL, FILTERS, Filter
from .element_table import ElementView

MOST = 1_000_000_000


class TablePage(QWidget):
    """`filtered` tells that another filter or limit is set; `asked_for` carries a number to go to, as typed."""

    filtered = Signal()
    asked_for = Signal(int)

    def __init__(self, name: str, parent: QWidget) -> None:
        super().__init__(parent)
        self.name = name
        self.view = ElementView(f"Table of {name}", self)
        self.filter = QComboBox(self)
        self.filter.setAccessibleName(f"Which {name} are listed")
        self.filter.setToolTip(f"Which {name} are listed")
        self.filter.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        for one in FILTERS[name]:
            self.filter.addItem(one.title, one.name)
        self.limits = {"sharp": self._limit("sharp", "°", 30.0, 1.0), "short": self._limit("short", " mm", 1.0, 0.1)}
        self.jump = TextLine(self)
        self.jump.setPlaceholderText("Go to no.")
        self.jump.setAccessibleName("Number to go to")
        self.jump.setToolTip("A number, and Enter: that row is chosen")
        self.jump.setValidator(QIntValidator(0, MOST, self))
        self.jump.setFixedWidth(76)
        self.words = QLabel(self)
        self.words.setProperty("muted", True)
        self.words.setContentsMargins(8, 3, 8, 3)
        top = QHBoxLayout()
        top.setContentsMargins(8, 6, 8, 6)
        top.setSpacing(4)
        top.addWidget(self.filter, 1)
        for field in self.limits.values():
            top.addWidget(field)
        top.addWidget(self.jump)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addLayout(top)
        layout.addWidget(self.view, 1)
        layout.addWidget(self.words)
        self.filter.setVisible(len(FILTERS[name]) > 1)
        if len(FILTERS[name]) < 2:
            top.addStretch(1)
        self.filter.activated.connect(self._follow)
        self.jump.returnPressed.connect(self._go)
        self._follow()

    @property
    def chosen_filter(self) -> Filter:
        return next(one for one in FILTERS[self.name] if one.name == self.filter.currentData())

    def set_filter(self, name: str) -> None:
        """List what this filter picks out."""
        self.filter.setCurrentIndex(max(self.filter.findData(name), self.filter.findData(ALL)))
        self._follow()

    def set_limit(self, name: str, value: float) -> None:
        """Show a limit that was set elsewhere."""
        field = self.limits[name]
        if field.value() != value:
            field.blockSignals(True)
            field.setValue(value)
            field.blockSignals(False)

    def say(self, listed: int, of: int) -> None:
        """How many rows there are."""
        words = (
            f"{listed:,} of {of:,} {self.name}"
            if listed
            else f"None of the {of:,} {self.name} is “{self.filter.currentText()}”"
        )
        self.words.setText(f"{of:,} {self.name}" if listed == of else words)

    def _limit(self, name: str, unit: str, value: float, step: float) -> QDoubleSpinBox:
        field = QDoubleSpinBox(self)
        field.setRange(0.0, 180.0 if name == "sharp" else 1e6)
        field.setDecimals(1 if name == "sharp" else 3)
        field.setSingleStep(step)
        field.setValue(value)
        field.setSuffix(unit)
        field.setKeyboardTracking(False)
        words = {"sharp": "An edge is sharp from so many degrees on", "short": "An edge is short up to this length"}
        field.setAccessibleName(words[name])
        field.setToolTip(words[name])
        field.setStepType(QDoubleSpinBox.StepType.AdaptiveDecimalStepType if name == "short" else field.stepType())
        field.valueChanged.connect(self.filtered)
        return field

    def _follow(self) -> None:
        wanted = self.chosen_filter.limit
        for name, field in self.limits.items():
            field.setVisible(name == wanted)
        self.filtered.emit()

    def _go(self) -> None:
        if self.jump.text():
            self.asked_for.emit(int(self.jump.text()))
            self.view.setFocus(Qt.FocusReason.OtherFocusReason)
