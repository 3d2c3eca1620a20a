"""The named parameters as a table; bounded ones have a slider that updates the solid while it moves."""

from __future__ import annotations

import math
from typing import Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QSlider,
    QTableWidget,
    QTableWidgetItem,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from ...model.document.document import Document, Parameter, parameter_values
from ...model.document.errors import Refusal
from ...model.document.tree import unique_name
from ...model.editing.operations import OPERATIONS
from ...model.editing.session import Session, State
from ..icons import icon
from .number_field import text_of
from .property_edit import sentence

NAME, VALUE, SLIDER, RESULT, MINIMUM, MAXIMUM, NOTE = range(7)
TITLES = ("Name", "Value", "", "=", "Minimum", "Maximum", "Note")
WIDTHS = (110, 120, 130, 80, 84, 86, 120)


class Parameters(QWidget):
    """`refused` carries why a change was not made; the table then shows the old value again."""

    refused = Signal(str)

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("parameters")
        self._session = session
        self._filling = False
        self._shape: Any = None
        self.table = QTableWidget(0, len(TITLES), self)
        self.table.setHorizontalHeaderLabels(TITLES)
        self.table.setAccessibleName("Parameters")
        self.table.verticalHeader().hide()
        self.table.verticalHeader().setDefaultSectionSize(28)
        self.table.setShowGrid(False)
        self.table.setWordWrap(False)
        self.table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        triggers = QAbstractItemView.EditTrigger
        self.table.setEditTriggers(triggers.DoubleClicked | triggers.EditKeyPressed | triggers.SelectedClicked)
        header = self.table.horizontalHeader()
        header.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        header.setHighlightSections(False)
        header.setSectionResizeMode(NOTE, QHeaderView.ResizeMode.Stretch)
        for column, width in enumerate(WIDTHS):
            self.table.setColumnWidth(column, width)
        self.add = self._button("add", "Add a parameter", self._add)
        self.delete = self._button("delete", "Delete the selected parameters", self._delete)
        self.hint = QLabel("No parameters yet. Add one, then write its name in any number field.", self)
        self.hint.setProperty("muted", True)
        bar = QHBoxLayout()
        bar.setContentsMargins(6, 4, 6, 4)
        bar.setSpacing(2)
        for widget in (self.add, self.delete, self.hint):
            bar.addWidget(widget)
        bar.addStretch(1)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addLayout(bar)
        layout.addWidget(self.table, 1)
        layout.addStretch(0)
        self.table.itemChanged.connect(self._edited)
        self.table.itemSelectionChanged.connect(self._selected)
        self._fill(session.document)

    def session_changed(self, before: State, after: State) -> None:
        if before.document.parameters is not after.document.parameters:
            self._fill(after.document)

    def _button(self, name: str, tip: str, run: Any) -> QToolButton:
        button = QToolButton(self)
        button.setObjectName(f"{name}_parameter")
        button.setProperty("flat", True)
        button.setIcon(icon(name))
        button.setToolTip(tip)
        button.clicked.connect(run)
        return button

    def _fill(self, document: Document) -> None:
        parameters = document.parameters
        values, faults = parameter_values(parameters)
        shape = [(p.name, slides(p)) for p in parameters]
        self._filling = True
        try:
            if shape != self._shape:
                self._shape = shape
                self.table.setRowCount(0)
                self.table.setRowCount(len(parameters))
                for row, parameter in enumerate(parameters):
                    self._make_row(row, parameter)
            for row, parameter in enumerate(parameters):
                self._refresh_row(row, parameter, values.get(parameter.name), faults.get(parameter.name))
        finally:
            self._filling = False
        self.hint.setVisible(not parameters)
        self.table.setVisible(bool(parameters))
        self._selected()

    def _make_row(self, row: int, parameter: Parameter) -> None:
        for column in range(len(TITLES)):
            item = QTableWidgetItem()
            if column in (SLIDER, RESULT):
                item.setFlags(item.flags() & ~Qt.ItemFlag.ItemIsEditable)
            self.table.setItem(row, column, item)
        if slides(parameter):
            slider = QSlider(Qt.Orientation.Horizontal, self.table)
            slider.setAccessibleName(parameter.name)
            slider.setToolTip("Drag: the solid follows")
            slider.valueChanged.connect(lambda place, name=parameter.name: self._slid(name, slider, place))
            slider.sliderReleased.connect(lambda name=parameter.name: self._slid(name, slider, slider.value(), True))
            self.table.setCellWidget(row, SLIDER, slider)

    def _refresh_row(self, row: int, parameter: Parameter, value: float | None, fault: str | None) -> None:
        texts = (
            parameter.name, text_of(parameter.value), "", text_of(value) if fault is None else "error",
            text_of(parameter.minimum), text_of(parameter.maximum), parameter.note,
        )  # fmt: skip
        for column, text in enumerate(texts):
            item = self.table.item(row, column)
            if item is not None and item.text() != text:
                item.setText(text)
        result = self.table.item(row, RESULT)
        if result is not None:
            result.setToolTip(fault or "")
        slider = self.table.cellWidget(row, SLIDER)
        if isinstance(slider, QSlider) and not slider.isSliderDown() and isinstance(parameter.value, float):
            slider.blockSignals(True)
            slider.setRange(0, slider_steps(parameter))
            slider.setValue(round((parameter.value - float(parameter.minimum or 0)) / slider_step(parameter)))
            slider.blockSignals(False)

    def _slid(self, name: str, slider: QSlider, place: int, released: bool = False) -> None:
        parameter = self._session.document.parameter(name)
        low, high = float(parameter.minimum or 0), float(parameter.maximum or 0)
        value = min(high, round(low + place * slider_step(parameter), 9))
        if slider.isSliderDown() and not released:
            self._session.preview(OPERATIONS["set_parameter"](self._session.document, name, value))
        else:
            self._do("set_parameter", f"Change {name}", name, value)

    def _edited(self, item: QTableWidgetItem) -> None:
        if self._filling or item.row() >= len(self._session.document.parameters):
            return
        parameter = self._session.document.parameters[item.row()]
        text = item.text().strip()
        match item.column():
            case 0:  # NAME
                self._rename(parameter, text)
            case 1:  # VALUE
                self._do("set_parameter", f"Change {parameter.name}", parameter.name, text)
            case 4 | 5:  # MINIMUM, MAXIMUM
                bound = "minimum" if item.column() == MINIMUM else "maximum"
                value = text or None
                self._do("set_parameter", f"Change {parameter.name}", parameter.name, parameter.value, **{bound: value})
            case 6:  # NOTE
                self._do("set_parameter", f"Change {parameter.name}", parameter.name, parameter.value, note=text)

    def _rename(self, parameter: Parameter, name: str) -> None:
        if name == parameter.name:
            return
        try:
            self._session.do("rename_parameter", parameter.name, name, label=f"Rename {parameter.name}")
        except Refusal as refusal:
            self.refused.emit(sentence(refusal))
            self._fill(self._session.document)

    def _add(self) -> None:
        name = unique_name("size", [p.name for p in self._session.document.parameters]).replace(" ", "_")
        self._do("set_parameter", "Add parameter", name, 10.0)
        row = self.table.rowCount() - 1
        item = self.table.item(row, NAME)
        if item is not None:
            self.table.setFocus()
            self.table.setCurrentItem(item)
            self.table.editItem(item)

    def _delete(self) -> None:
        parameters = self._session.document.parameters
        rows = sorted({index.row() for index in self.table.selectionModel().selectedRows()})
        for name in [parameters[row].name for row in rows]:
            self._do("delete_parameter", f"Delete {name}", name)

    def _selected(self) -> None:
        self.delete.setEnabled(bool(self.table.selectionModel().selectedRows()))

    def _do(self, operation: str, label: str, *arguments: Any, **keywords: Any) -> None:
        try:
            self._session.do(operation, *arguments, label=label, **keywords)
        except Refusal as refusal:
            self._session.cancel()
            self.refused.emit(sentence(refusal))
            self._fill(self._session.document)


def slides(parameter: Parameter) -> bool:
    plain = isinstance(parameter.value, float)
    return (
        plain
        and parameter.minimum is not None
        and parameter.maximum is not None
        and parameter.minimum < parameter.maximum
    )


def slider_step(parameter: Parameter) -> float:
    """A round number that cuts the parameter's range into about a hundred steps."""
    span = float(parameter.maximum or 0) - float(parameter.minimum or 0)
    return 10.0 ** math.floor(math.log10(span / 50)) if span > 0 else 1.0


def slider_steps(parameter: Parameter) -> int:
    return math.ceil((float(parameter.maximum or 0) - float(parameter.minimum or 0)) / slider_step(parameter) - 1e-9)
