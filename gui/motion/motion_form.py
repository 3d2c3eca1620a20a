"""Which motion is played, what it is, and what the selected nodes do in it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QCompleter,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QSizePolicy,
    QToolButton,
    QWidget,
)

from ..icons import icon
from ..panels.number_field import NumberField, Steps

if TYPE_CHECKING:
    from ...model.document.document import Document
    from ...model.proximity.motion import Motion

FIELDS = {
    "start": ("from", "The parameter where the motion begins", Steps(1.0, 0.1, 10.0)),
    "end": ("to", "The parameter where the motion ends", Steps(1.0, 0.1, 10.0)),
    "seconds": ("seconds", "How long the motion lasts, in seconds", Steps(1.0, 0.1, 10.0, 0.0, True)),
    "steps": ("steps", "In how many steps contacts are looked for", Steps(1.0, 1.0, 10.0, 1.0)),
}
BETWEEN_TIP = "Follow all that comes near between the steps, too: slower, and nothing quick is jumped over"
AXES = ("x", "y", "z")


class MotionForm(QWidget):
    """`set_asked` carries what a field of the motion shall be, by its name; `moving_asked` the millimetres (3,), an
    axis and degrees by which the selected nodes shall go."""

    chosen = Signal(str)
    added = Signal()
    renamed = Signal(str)
    deleted = Signal()
    set_asked = Signal(str, object)
    moving_asked = Signal(tuple, str, object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Preferred)
        self.names = QComboBox(self)
        self.names.setEditable(True)
        self.names.setInsertPolicy(QComboBox.InsertPolicy.NoInsert)
        self.names.setCompleter(QCompleter([], self.names))  # a new name is not an old one begun
        self.names.setAccessibleName("Motion")
        self.names.setToolTip("The motion that is played; type another name to rename it")
        self.names.setMinimumContentsLength(12)
        self.names.activated.connect(lambda at: self.chosen.emit(self.names.itemText(at)))
        line_edit = self.names.lineEdit()
        assert line_edit is not None
        line_edit.editingFinished.connect(lambda: self.renamed.emit(self.names.currentText().strip()))
        self.add = _button("add", "", "Add a motion", self.added.emit, self)
        self.delete = _button("delete", "", "Take this motion out", self.deleted.emit, self)
        self.parameter = QComboBox(self)
        self.parameter.setAccessibleName("Parameter that goes")
        self.parameter.setToolTip("The parameter that goes; solids that depend on it move")
        self.parameter.setMinimumContentsLength(6)
        self.parameter.activated.connect(lambda at: self.set_asked.emit("parameter", self.parameter.itemText(at)))
        self.fields = {name: self._field(name, tip, steps) for name, (_, tip, steps) in FIELDS.items()}
        self.between = QCheckBox("between, too", self)
        self.between.setToolTip(BETWEEN_TIP)
        self.by = [self._moving_field(f"Millimetres along {axis}") for axis in AXES]
        self.axis = QComboBox(self)
        self.axis.addItems(AXES)
        self.axis.setAccessibleName("Axis of the turn")
        self.axis.setToolTip("The axis that the selected nodes turn about, through their own place")
        self.degrees = self._moving_field("Degrees of the turn")
        self.set_in = _button("motion_panel", "Set in motion", "", self._ask_moving, self)
        grid = QGridLayout(self)
        grid.setContentsMargins(8, 4, 8, 4)
        grid.setHorizontalSpacing(6)
        grid.setVerticalSpacing(4)
        head = QHBoxLayout()
        head.setSpacing(1)
        head.addWidget(self.names, 1)
        head.addWidget(self.add)
        head.addWidget(self.delete)
        grid.addLayout(head, 0, 0, 1, 6)
        for place, (words, widget) in enumerate((
            ("goes", self.parameter), ("from", self.fields["start"]), ("to", self.fields["end"]),
        )):  # fmt: skip
            grid.addWidget(_muted(words, self), 1, 2 * place)
            grid.addWidget(widget, 1, 2 * place + 1)
        for place, name in enumerate(("seconds", "steps")):
            grid.addWidget(_muted(FIELDS[name][0], self), 2, 2 * place)
            grid.addWidget(self.fields[name], 2, 2 * place + 1)
        grid.addWidget(self.between, 2, 4, 1, 3)
        self.moving_words = _muted("The selected nodes go by x, y, z in mm and turn about", self)
        self.moving_words.setContentsMargins(0, 6, 0, 0)
        grid.addWidget(self.moving_words, 3, 0, 1, 6)
        grid.addWidget(self.set_in, 5, 0, 1, 6, Qt.AlignmentFlag.AlignLeft)
        moving = QHBoxLayout()
        moving.setSpacing(4)
        for field in self.by:
            moving.addWidget(field)
        moving.addSpacing(4)
        moving.addWidget(self.axis)
        moving.addWidget(self.degrees)
        moving.addWidget(QLabel("°", self))
        moving.addStretch(1)
        grid.addLayout(moving, 4, 0, 1, 6)
        grid.setColumnStretch(6, 1)
        grid.setRowStretch(6, 1)

    def show_motion(self, document: Document, motion: Motion | None) -> None:
        """The motions of a document, and the values of one."""
        _fill(self.names, [one.name for one in document.motions], "" if motion is None else motion.name)
        _fill(self.parameter, [one.name for one in document.parameters], "" if motion is None else motion.parameter)
        for widget in (self.names, self.delete, self.parameter, self.between, *self.fields.values()):
            widget.setEnabled(motion is not None)
        for name, field in self.fields.items():
            field.set_value(None if motion is None else float(getattr(motion, name)))

    def show_selection(self, count: int) -> None:
        """How many nodes are selected, which could be set in motion."""
        self.set_in.setEnabled(count > 0)
        tip = "Let the selected nodes go by these millimetres and degrees while the motion lasts"
        self.set_in.setToolTip(tip if count else "Not now: select what shall move first")

    def _ask_moving(self) -> None:
        by = tuple(field.text().strip() or 0.0 for field in self.by)
        self.moving_asked.emit(by, self.axis.currentText(), self.degrees.text().strip() or 0.0)

    def _field(self, name: str, tip: str, steps: Steps) -> NumberField:
        field = NumberField(steps, self)
        field.setAccessibleName(tip)
        field.setToolTip(tip)
        field.setMaximumWidth(56)
        field.typed.connect(lambda text: self.set_asked.emit(name, text))
        field.stepping.connect(lambda value: self.set_asked.emit(name, value))
        return field

    def _moving_field(self, tip: str) -> NumberField:
        field = NumberField(Steps(), self)
        field.setAccessibleName(tip)
        field.setToolTip(f"{tip}, over the whole motion")
        field.setPlaceholderText("0")
        field.setMaximumWidth(46)
        return field


def _fill(box: QComboBox, names: Sequence[str], current: str) -> None:
    box.blockSignals(True)
    if [box.itemText(k) for k in range(box.count())] != list(names):
        box.clear()
        box.addItems(list(names))
    box.setCurrentIndex(box.findText(current, Qt.MatchFlag.MatchExactly))
    box.blockSignals(False)


def _muted(words: str, parent: QWidget) -> QLabel:
    label = QLabel(words, parent)
    label.setProperty("muted", True)
    return label


def _button(picture: str, text: str, tip: str, act: Callable[[], object], parent: QWidget) -> QToolButton:
    button = QToolButton(parent)
    button.setProperty("flat", True)
    button.setIcon(icon(picture))
    button.setToolTip(tip)
    button.setAccessibleName(text or tip)
    if text:
        button.setText(text)
        button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
    button.clicked.connect(lambda: act())
    return button
