"""Offset and stroke of outlines: a small dialog whose choices show in the picture at once."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QEvent, QObject, QPoint, Qt, QTimer
from PySide6.QtGui import QKeyEvent, QShowEvent
from PySide6.QtWidgets import QComboBox, QDialog, QDialogButtonBox, QFormLayout, QHBoxLayout, QLabel, QVBoxLayout

from ...model.document.document import parameter_values
from ...model.document.errors import Refusal
from ...model.document.expression import number, resolved
from ...model.operations.operations import OPERATIONS
from ..panels.number_field import NumberField
from ..panels.property_edit import sentence
from .outline_work import commit

if TYPE_CHECKING:
    from ...model.document.document import Document
    from ..window import MainWindow

PAUSE = 120  # milliseconds of typing before the picture follows
MARGIN = 16  # logical pixels to the picture's corner
JOINS = (("Round", "round"), ("Pointed", "miter"), ("Cut off", "bevel"))
ENDS = (("Round", "round"), ("Flat", "butt"), ("Square, half a width longer", "square"))


def ask_offset(window: MainWindow) -> None:
    OutlineDialog(
        window, "offset_outline", "Offset", "Distance", 2.0, "Above 0 makes it larger, below 0 smaller"
    ).open()


def ask_stroke(window: MainWindow) -> None:
    OutlineDialog(window, "stroke_outline", "Stroke to outline", "Width", 2.0, "From one side of the pen to the other",
                  ends=True).open()  # fmt: skip


class OutlineDialog(QDialog):
    """Previews an operation on the selected outlines while its numbers are typed; OK makes it a step."""

    def __init__(
        self, window: MainWindow, operation: str, label: str, words: str, value: float, tip: str, ends: bool = False
    ) -> None:
        super().__init__(window)
        self.setObjectName(operation)
        self.setWindowTitle(label)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowModality(Qt.WindowModality.WindowModal)
        self._window, self._operation, self._label = window, operation, label
        window.session.cancel()
        self._before, self._ids = window.session.document, list(window.session.selection)
        self._made: tuple[list[Any], Document] | None = None
        self._running = self._stale = self._accepting = self._closed = False
        self.size_field = NumberField(parent=self)
        self.size_field.setObjectName("size")
        self.size_field.setAccessibleName(words)
        self.size_field.setToolTip(tip)
        self.size_field.set_value(value)
        self.size_field.installEventFilter(self)
        self.size_field.stepping.connect(lambda new: (self.size_field.set_value(new), self._later.start(PAUSE)))
        self.join = _choices(JOINS, "What stands at corners", self)
        self.ends = _choices(ENDS, "How open curves end", self) if ends else None
        unit = QLabel("mm", self)
        row = QHBoxLayout()
        row.setSpacing(8)
        row.addWidget(self.size_field, 1)
        row.addWidget(unit)
        form = QFormLayout()
        form.setHorizontalSpacing(12)
        form.setVerticalSpacing(8)
        form.setLabelAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.addRow(words, row)
        form.addRow("Corners", self.join)
        if self.ends is not None:
            form.addRow("Ends", self.ends)
        self.hint = QLabel(tip, self)
        self.hint.setWordWrap(True)
        self.hint.setTextFormat(Qt.TextFormat.PlainText)
        self.hint.setProperty("muted", True)
        self._tip = tip
        self.buttons = QDialogButtonBox(
            QDialogButtonBox.StandardButton.Ok | QDialogButtonBox.StandardButton.Cancel, self
        )
        self.buttons.accepted.connect(self._take)
        self.buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(16, 16, 16, 16)
        layout.setSpacing(12)
        layout.addLayout(form)
        layout.addWidget(self.hint)
        layout.addStretch(1)
        layout.addWidget(self.buttons)
        self._later = QTimer(self)
        self._later.setSingleShot(True)
        self._later.timeout.connect(self._show)
        self.size_field.textEdited.connect(lambda _: self._later.start(PAUSE))
        for box in (self.join, self.ends):
            if box is not None:
                box.currentIndexChanged.connect(lambda _: self._later.start(0))
        self.finished.connect(self._end)
        self.setMinimumWidth(320)
        self.size_field.selectAll()
        self._later.start(0)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Enter in the field is OK, Escape closes whatever is written there."""
        if event.type() == QEvent.Type.KeyPress and isinstance(event, QKeyEvent):
            if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
                self._take()
                return True
            if event.key() == Qt.Key.Key_Escape:
                self.reject()
                return True
        return super().eventFilter(watched, event)

    def showEvent(self, event: QShowEvent) -> None:
        """In a corner of the picture, where it hides least of the outlines."""
        super().showEvent(event)
        viewport = self._window.viewport
        self.move(viewport.mapToGlobal(QPoint(MARGIN, MARGIN)))

    def _arguments(self) -> list[Any]:
        """What the operation takes behind the document. Raises Refusal."""
        values, _ = parameter_values(self._before.parameters)
        size = resolved(number(self.size_field.text().strip(), "the number"), values)
        ends = [] if self.ends is None else [self.ends.currentData()]
        return [self._ids, size, self.join.currentData(), *ends]

    def _show(self) -> None:
        if self._running:
            self._stale = True
            return
        try:
            arguments = self._arguments()
        except Refusal as refusal:
            self._fail(refusal)
            return
        before, work = self._before, OPERATIONS[self._operation]
        self._running = True
        self._window.files.background.run(
            self._label,
            lambda: work(before, *arguments),
            lambda after: self._shown(arguments, after),
            self._refused,
        )

    def _shown(self, arguments: list[Any], after: Document) -> None:
        self._running = False
        if self._closed:
            return
        if self._stale:
            self._stale = False
            self._show()
            return
        self._made = arguments, after
        self.size_field.set_fault(False)
        self.hint.setText(self._tip)
        self._window.session.preview(after)
        if self._accepting:
            self._take()

    def _refused(self, refusal: Refusal) -> None:
        self._running = False
        if self._closed:
            return
        if self._stale:
            self._stale = False
            self._show()
            return
        self._fail(refusal)

    def _fail(self, refusal: Refusal) -> None:
        self._made, self._accepting = None, False
        self._window.session.cancel()
        self.size_field.set_fault(True)
        self.hint.setText(sentence(refusal))

    def _take(self) -> None:
        """Make the step, at once or when what is typed has been computed."""
        try:
            arguments = self._arguments()
        except Refusal as refusal:
            self._fail(refusal)
            return
        if self._made is None or self._made[0] != arguments:
            self._accepting = True
            self._later.stop()
            self._show()
            return
        after = self._made[1]
        self._made = None
        self._closed = True
        commit(self._window, self._before, after, self._operation, *arguments, label=self._label)
        self.accept()

    def _end(self, _: int) -> None:
        self._later.stop()
        if not self._closed:
            self._closed = True
            self._window.session.cancel()


def _choices(entries: tuple[tuple[str, str], ...], tip: str, parent: QDialog) -> QComboBox:
    box = QComboBox(parent)
    for words, value in entries:
        box.addItem(words, value)
    box.setToolTip(tip)
    box.setAccessibleName(tip)
    return box
