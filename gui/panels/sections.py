"""The Sections panel: the planes that open the picture, and what each of them cuts."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QSizePolicy,
    QTableWidget,
    QTableWidgetItem,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from ...model.document.errors import Refusal
from ...model.document.expression import Expression, number
from ...model.editing.session import Session, State
from ...model.operations.sections import moved_to, position
from ..status import figure
from .property_edit import sentence

if TYPE_CHECKING:
    from ..commands.actions import Actions
    from ..tools.section_tool import SectionTool

NAME, NORMAL, PLACE, AREA, PERIMETER = range(5)
TITLES = ("Section", "Keeps", "Position", "Cut area", "Perimeter")
TIPS = (
    "Ticked: it opens the picture",
    "The side that stays: -z is what lies below. An axis, or three numbers",
    "Of the plane, along its axis, in millimetres",
    "Of the visible solids, in mm², as precise as the picture",
    "Of the cut areas with their holes, in mm",
)
WIDTHS = (170, 130, 110, 120, 110)
BUTTONS = ("section_x", "section_y", "section_z", "section_face", "", "flip_section", "delete_section", "",
           "export_section")  # fmt: skip
AXES = ("x", "y", "z")


class Sections(QWidget):
    """`refused` carries why a change was not made; `figures` gives area and perimeter of an open section, by name."""

    refused = Signal(str)

    def __init__(
        self,
        session: Session,
        tool: SectionTool,
        actions: Actions,
        figures: Callable[[str], tuple[float, float] | None],
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self.setObjectName("sections")
        self._session, self._tool, self._figures = session, tool, figures
        self._filling = False
        self.table = QTableWidget(0, len(TITLES), self)
        self.table.setHorizontalHeaderLabels(TITLES)
        self.table.setAccessibleName("Sections")
        self.table.verticalHeader().hide()
        self.table.verticalHeader().setDefaultSectionSize(26)
        self.table.setShowGrid(False)
        self.table.setWordWrap(False)
        self.table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        triggers = QAbstractItemView.EditTrigger
        self.table.setEditTriggers(triggers.DoubleClicked | triggers.EditKeyPressed | triggers.SelectedClicked)
        header = self.table.horizontalHeader()
        header.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        header.setHighlightSections(False)
        header.setSectionResizeMode(PERIMETER, QHeaderView.ResizeMode.Stretch)
        for column, (width, tip) in enumerate(zip(WIDTHS, TIPS, strict=True)):
            self.table.setColumnWidth(column, width)
            item = self.table.horizontalHeaderItem(column)
            if item is not None:
                item.setToolTip(tip)
        self.hint = QLabel("A section opens the picture by a plane. Add one across an axis, or at a face.", self)
        self.hint.setProperty("muted", True)
        self.hint.setContentsMargins(10, 4, 10, 4)
        self.hint.setWordWrap(True)
        buttons = QWidget(self)
        buttons.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)  # the panel may be narrow
        bar = QHBoxLayout(buttons)
        bar.setContentsMargins(6, 4, 6, 4)
        bar.setSpacing(2)
        for name in BUTTONS:
            if name:
                bar.addWidget(_button(actions[name], self))
            else:
                bar.addSpacing(10)
        bar.addStretch(1)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addWidget(buttons)
        layout.addWidget(self.hint)
        layout.addWidget(self.table, 1)
        layout.addStretch(0)
        self._later = QTimer(self)
        self._later.setSingleShot(True)
        self._later.timeout.connect(self._measure)
        self.table.itemChanged.connect(self._edited)
        self.table.itemSelectionChanged.connect(self._selected)
        tool.chosen.connect(self._follow)
        self._fill()

    def session_changed(self, before: State, after: State) -> None:
        if before.document.sections is not after.document.sections:
            self._fill()
        elif before.document is not after.document:
            self.measure()

    def measure(self) -> None:
        """Bring the figures up to date soon."""
        self._later.start(0)

    def _fill(self) -> None:
        sections = self._session.document.sections
        self._filling = True
        try:
            self.table.setRowCount(len(sections))
            for row, section in enumerate(sections):
                texts = (section.name, normal_text(section.normal), f"{position(section):.10g}")
                for column in range(len(TITLES)):
                    item = self.table.item(row, column)
                    if item is None:
                        item = QTableWidgetItem()
                        if column >= AREA:
                            item.setFlags(item.flags() & ~Qt.ItemFlag.ItemIsEditable)
                        self.table.setItem(row, column, item)
                    if column < AREA and item.text() != texts[column]:
                        item.setText(texts[column])
                first = self.table.item(row, NAME)
                if first is not None:
                    first.setCheckState(Qt.CheckState.Checked if section.active else Qt.CheckState.Unchecked)
        finally:
            self._filling = False
        self.hint.setVisible(not sections)
        self.table.setVisible(bool(sections))
        self._follow(self._tool.name)
        self.measure()

    def _measure(self) -> None:
        if not self.isVisible():
            return
        for row, section in enumerate(self._session.document.sections):
            found = self._figures(section.name) if section.active else None
            texts = (figure(None),) * 2 if found is None else (f"{figure(found[0])} mm²", f"{figure(found[1])} mm")
            for column, text in zip((AREA, PERIMETER), texts, strict=True):
                item = self.table.item(row, column)
                if item is not None and item.text() != text:
                    self._filling = True
                    item.setText(text)
                    self._filling = False

    def showEvent(self, event: Any) -> None:
        super().showEvent(event)
        self.measure()

    def _follow(self, name: str) -> None:
        """Select the row of the tool's section."""
        rows = [row for row, section in enumerate(self._session.document.sections) if section.name == name]
        self.table.blockSignals(True)
        if rows:
            self.table.selectRow(rows[0])
        else:
            self.table.clearSelection()
        self.table.blockSignals(False)

    def _selected(self) -> None:
        rows = self.table.selectionModel().selectedRows()
        sections = self._session.document.sections
        if rows and rows[0].row() < len(sections):
            self._tool.choose(sections[rows[0].row()].name)

    def _edited(self, item: QTableWidgetItem) -> None:
        sections = self._session.document.sections
        if self._filling or item.row() >= len(sections):
            return
        section = sections[item.row()]
        text = item.text().strip()
        active = item.checkState() == Qt.CheckState.Checked
        try:
            if item.column() == NAME and active != section.active:
                label = f"{'Open' if active else 'Close'} {section.name}"
                self._session.do("set_section", section.name, active=active, label=label)
            elif item.column() == NAME and text != section.name:
                chosen = self._tool.name == section.name
                self._session.do("rename_section", section.name, text, label=f"Rename {section.name}")
                if chosen:
                    self._tool.choose(self._session.document.sections[item.row()].name)
            elif item.column() == NORMAL and text != normal_text(section.normal):
                normal = normal_from(text)
                self._session.do("set_section", section.name, normal=normal, label=f"Turn {section.name}")
            elif item.column() == PLACE and text != f"{position(section):.10g}":
                self._session.do("set_section", section.name, point=moved_to(section, _number(text)),
                                 label=f"Shift {section.name}")  # fmt: skip
        except Refusal as refusal:
            self.refused.emit(sentence(refusal))
            self._fill()


def normal_text(normal: tuple[float, ...]) -> str:
    """`-z` for an axis, else three numbers."""
    for axis, value in zip(AXES, normal, strict=True):
        if abs(value) == 1.0:
            return axis if value > 0 else f"-{axis}"
    return ", ".join(f"{value:.4g}" for value in normal)


def normal_from(text: str) -> tuple[float, ...]:
    """The direction that such a text names. Raises Refusal."""
    words = text.replace("\u2212", "-").strip().lower()
    if words.lstrip("+-") in AXES:
        sign = -1.0 if words.startswith("-") else 1.0
        return tuple(sign if axis == words.lstrip("+-") else 0.0 for axis in AXES)
    parts = [part for part in words.replace(",", " ").split() if part]
    if len(parts) != 3:
        raise Refusal(f"“{text}” is no direction: write an axis such as -z, or three numbers")
    return tuple(_number(part) for part in parts)


def _number(text: str) -> float:
    value = number(text, "the number")
    return value.evaluate({}) if isinstance(value, Expression) else value


def _button(action: QAction, parent: QWidget) -> QToolButton:
    button = QToolButton(parent)
    button.setProperty("flat", True)
    button.setDefaultAction(action)
    words = {"section_x": "x", "section_y": "y", "section_z": "z", "section_face": "Face", "export_section": "Export"}
    word = words.get(action.objectName())
    if word:
        button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        action.setIconText(word)
    return button
