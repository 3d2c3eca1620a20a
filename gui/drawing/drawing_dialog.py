"""File, Export drawing: the choices for a drawing beside its preview, which the worker draws anew for each of them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from ...model.document.document import Document
from ...model.document.errors import Refusal
from ...model.drafting.plan import Eye, Plan
from ..dialogs import ask_drawing_path
from ..panels.property_edit import sentence
from .choices import Choices
from .page_view import PageView

if TYPE_CHECKING:
    from ...model.drafting.page import Page
    from ...model.worker.shown import Message
    from ..jobs import Jobs

PAUSE = 150  # milliseconds of typing before the preview follows
PATIENCE = 250  # milliseconds before the progress shows
PANEL = 250  # logical pixels, the width of the choices

Save = Callable[[str, Plan, "float | None", "str | None"], None]


class DrawingDialog(QDialog):
    """`save` takes (path, plan, tolerance, solid or None for all), and None for a tolerance that follows the scale.
    `present` is what the viewport shows: an eye and the angle of its perspective, None in parallel projection."""

    def __init__(
        self,
        parent: QWidget,
        document: Document,
        name: str,
        folder: Path,
        present: tuple[Eye, float | None] | None,
        jobs: Jobs,
        save: Save,
    ) -> None:
        super().__init__(parent)
        self.setObjectName("drawing")
        self.setWindowTitle("Export drawing")
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._document, self._start = document, folder / f"{name}.svg"
        self._jobs, self._save = jobs, save
        self._asked: tuple[Plan, float | None, str | None] | None = None
        self.choices = Choices(document, name, present, self)
        self.preview = PageView(self)
        self.hint = QLabel(self)
        self.hint.setWordWrap(True)
        self.hint.setTextFormat(Qt.TextFormat.PlainText)
        self.progress = QProgressBar(self)
        self.progress.setTextVisible(False)
        self.progress.setAccessibleName("Progress of the drawing")
        self.doing = QLabel(self)
        self.doing.setProperty("muted", True)
        self.stop = QPushButton("Cancel drawing", self)
        self.stop.setAutoDefault(False)
        self.stop.clicked.connect(self._stop)
        self.buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close, self)
        self.save_button = self.buttons.addButton("Save as …", QDialogButtonBox.ButtonRole.AcceptRole)
        self.save_button.setToolTip("Write the drawing as SVG, PDF or DXF")
        self.save_button.setDefault(True)
        self.save_button.setEnabled(False)
        self.buttons.accepted.connect(self._ask_path)
        self.buttons.rejected.connect(self.reject)
        self._lay_out()
        self._later = QTimer(self)
        self._later.setSingleShot(True)
        self._later.timeout.connect(self._draw)
        self._patience = QTimer(self)
        self._patience.setSingleShot(True)
        self._patience.setInterval(PATIENCE)
        self._patience.timeout.connect(lambda: self._set_working(True))
        self.choices.changed.connect(lambda: self._draw_in(0))
        self.choices.typed.connect(lambda: self._draw_in(PAUSE))
        jobs.drawn.connect(self._drawn)
        jobs.drawing_progress.connect(self._progressed)
        self.finished.connect(lambda _: jobs.stop_drawing())
        self._set_working(False)
        self.resize(1000, 680)
        self._later.start(0)

    def _lay_out(self) -> None:
        column = QVBoxLayout()
        column.setSpacing(10)
        column.addWidget(self.choices)
        column.addWidget(self.hint)
        column.addStretch(1)
        column.addWidget(self.doing)
        column.addWidget(self.progress)
        column.addWidget(self.stop, 0, Qt.AlignmentFlag.AlignLeft)
        side = QWidget(self)
        side.setMinimumWidth(max(PANEL, self.choices.minimumSizeHint().width()))
        side.setLayout(column)
        column.setContentsMargins(0, 0, 0, 0)
        both = QHBoxLayout()
        both.setSpacing(16)
        both.addWidget(self.preview, 1)
        both.addWidget(side)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(16, 16, 16, 16)
        layout.setSpacing(12)
        layout.addLayout(both, 1)
        layout.addWidget(self.buttons)

    def _draw_in(self, pause: int) -> None:
        """Follow the choices after some milliseconds; what is shown until then is not what Enter should save."""
        self.save_button.setEnabled(False)
        self._later.start(pause)

    def _draw(self) -> None:
        try:
            asked = (self.choices.plan(), self.choices.chosen_tolerance(), self.choices.solid.currentData())
        except Refusal as refusal:
            self._jobs.stop_drawing()
            self._fail(str(refusal))
            return
        self._asked = asked
        self._jobs.draw(self._document, *asked)
        if self.stop.isHidden():
            self._patience.start()

    def _drawn(self, page: Page | None, messages: tuple[Message, ...], fault: str) -> None:
        if page is None:
            self._fail(fault)
            return
        self._set_working(False)
        self.preview.show_page(page)
        self.save_button.setEnabled(True)
        self._say(next((message.sentence for message in messages), ""), any(message.error for message in messages))

    def _progressed(self, done: int, total: int, label: str) -> None:
        self.progress.setRange(0, total)
        self.progress.setValue(done)
        self.doing.setText(label[:1].upper() + label[1:])

    def _stop(self) -> None:
        self._jobs.stop_drawing()
        self._fail("Cancelled; change a choice to draw again", False)

    def _fail(self, why: str, fault: bool = True) -> None:
        self._asked = None
        self._set_working(False)
        self.preview.set_outdated(True)
        self.save_button.setEnabled(False)
        self._say(sentence(Refusal(why)), fault)

    def _say(self, words: str, fault: bool) -> None:
        self.hint.setProperty("fault", fault)
        self.hint.setProperty("muted", not fault)
        self.hint.style().unpolish(self.hint)
        self.hint.style().polish(self.hint)
        self.hint.setText(words)

    def _set_working(self, working: bool) -> None:
        self._patience.stop()
        if not working:
            self.progress.setRange(0, 0)
            self.doing.setText("")
        else:
            self.preview.set_outdated(True)
        for widget in (self.progress, self.doing, self.stop):
            widget.setVisible(working)

    # Saving.

    def _ask_path(self) -> None:
        if self._asked is not None:
            ask_drawing_path(self, self._start, self._save_to)

    def _save_to(self, path: str) -> None:
        if self._asked is not None:
            asked = self._asked
            self.accept()
            self._save(path, *asked)
