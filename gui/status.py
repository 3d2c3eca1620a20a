"""The status bar: what the solid measures, how long it took, and what is going on."""

from __future__ import annotations

from html import escape
from typing import Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QProgressBar, QSizePolicy, QStatusBar, QToolButton, QWidget

from ..model.document.document import Document
from ..model.document.tree import homes
from .icons import icon, severity_icon

LASTING = 8000  # milliseconds that a message stays


def figure(value: float | None, digits: int = 6) -> str:
    """A measured number as people read it: thin spaces between thousands, no exponent, `digits` significant ones."""
    if value is None:
        return "\u2013"
    if abs(value) > 1e-9 and not 1e-4 <= abs(value) < 1e12:
        return f"{value:.{digits}g}"
    whole = len(str(int(abs(value))))
    places = max(0, digits - whole)
    text = f"{round(value, places) + 0.0:,.{places}f}".replace(",", "\u202f")  # no -0
    return text.rstrip("0").rstrip(".") if "." in text else text


def shown_solids(document: Document, selection: tuple[str, ...], shown: Any) -> tuple[str, list[Any]]:
    """What the status bar sums up, in words, and the measured solids: those that hold the selection, or all visible."""
    if shown is None:
        return "", []
    roots = {root.id for root in document.solids}
    chosen = [root for root in homes(document, selection) if root in roots]
    wanted = chosen or [root.id for root in document.solids if root.visible]
    solids = [shown.solids[root] for root in wanted if root in shown.solids and shown.solids[root].measures is not None]
    count = len(wanted)
    words = "" if count == 1 else f"{count} selected" if chosen else f"{count} solids"
    return words, solids


class _Shortened(QLabel):
    """A line that never makes its window wider: what does not fit is left out in the middle."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setTextFormat(Qt.TextFormat.PlainText)
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)

    def paintEvent(self, event: QPaintEvent) -> None:
        room = self.contentsRect()
        text = self.fontMetrics().elidedText(self.text(), Qt.TextElideMode.ElideMiddle, room.width())
        painter = QPainter(self)
        self.style().drawItemText(
            painter, room, Qt.AlignmentFlag.AlignVCenter, self.palette(), self.isEnabled(), text, self.foregroundRole()
        )
        painter.end()


class StatusBar(QStatusBar):
    """`cancel_asked` comes from the button beside the progress, `problems_asked` from a click on the first problem."""

    cancel_asked = Signal()
    problems_asked = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setSizeGripEnabled(False)
        self.hover = _Shortened(self)
        self.problem = QToolButton(self)
        self.problem.setObjectName("problem")
        self.problem.setProperty("flat", True)
        self.problem.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.problem.clicked.connect(self.problems_asked)
        self.problem.hide()
        self._problem = ""
        self._hint = ""
        self.messageChanged.connect(self._follow_message)
        self.addWidget(self.problem)
        self.addWidget(self.hover, 1)
        self.measures = QLabel(self)
        self.measures.setObjectName("measures")
        self.measures.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.time = QLabel(self)
        self.time.setObjectName("time")
        self.time.setToolTip("How long the last evaluation took")
        self.hidden_surface = QLabel(self)
        self.hidden_surface.setObjectName("hidden_surface")
        self.hidden_surface.hide()
        self.busy = QWidget(self)
        self.busy.setObjectName("busy")
        self._label = QLabel("Evaluating", self.busy)
        self.bar = QProgressBar(self.busy)
        self.bar.setTextVisible(False)
        self.bar.setFixedWidth(120)
        self.cancel = QToolButton(self.busy)
        self.cancel.setObjectName("cancel")
        self.cancel.setProperty("flat", True)
        self.cancel.setIcon(icon("cancel"))
        self.cancel.setText("Cancel")
        self.cancel.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.cancel.setToolTip("<b>Cancel</b>&nbsp;&nbsp;Ctrl+.<br>Give up this evaluation; what is shown stays")
        self.cancel.clicked.connect(self.cancel_asked)
        layout = QHBoxLayout(self.busy)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(4)
        for widget in (self._label, self.bar, self.cancel):
            layout.addWidget(widget)
        self.busy.hide()
        for widget in (self.busy, self.hidden_surface, self.measures, self.time):
            self.addPermanentWidget(widget)

    def say(self, text: str) -> None:
        """A passing message; "" takes it back."""
        if text:
            self.showMessage(text, LASTING)
        else:
            self.clearMessage()

    def set_hint(self, text: str) -> None:
        """What to do next in a tool, for as long as nothing else has to be said; "" ends it."""
        before, self._hint = self._hint, text
        if self.currentMessage() in ("", before):
            self.showMessage(text)

    def set_hover(self, text: str) -> None:
        self.hover.setText(text)

    def set_busy(self, busy: bool) -> None:
        self.bar.setRange(0, 0)
        self._label.setText("Evaluating")
        self.busy.setVisible(busy)

    def set_progress(self, done: int, total: int, label: str) -> None:
        self.bar.setRange(0, max(total, 0))
        self.bar.setValue(done)
        if label:
            self._label.setText(self._label.fontMetrics().elidedText(label, Qt.TextElideMode.ElideMiddle, 220))

    def set_hidden_surface(self, words: str, reason: str) -> None:
        """What the picture is drawn with, and why; "" where that is a matter of course."""
        self.hidden_surface.setText(words)
        self.hidden_surface.setToolTip(reason)
        self.hidden_surface.setVisible(bool(words))

    def set_outdated(self) -> None:
        self.time.setText("out of date")
        self.time.setToolTip("The picture shows an earlier result; F5 evaluates again")
        self.time.show()

    def set_time(self, seconds: float) -> None:
        self.time.setToolTip("How long the last evaluation took")
        self.time.setText(f"{seconds * 1000:.0f} ms" if seconds < 1 else f"{seconds:.1f} s")

    def set_problem(self, text: str) -> None:
        """The first error, for as long as it lasts; "" where all is well."""
        self._problem = text
        self._follow_message()
        if text:
            self.problem.setIcon(severity_icon(True))
            self.problem.setText(self.problem.fontMetrics().elidedText(text, Qt.TextElideMode.ElideRight, 520))
            self.problem.setToolTip(f"{escape(text)}<br>Click to see all problems")

    def _follow_message(self) -> None:
        if self._hint and not self.currentMessage():
            self.showMessage(self._hint)
        # A passing message has the place to itself.
        self.problem.setVisible(bool(self._problem) and not self.currentMessage())

    def set_measures(self, words: str, solids: list[Any]) -> None:
        """Sums over measured solids; empty where there are none."""
        self.time.setVisible(bool(solids))
        if not solids:
            self.measures.setText("")
            return
        all_ = [solid.measures for solid in solids]
        volumes = [m.volume for m in all_]
        volume = None if any(v is None for v in volumes) else sum(volumes)
        parts = [words] if words else []
        parts.append(f"{figure(sum(m.triangles for m in all_), 12)} triangles")
        parts.append(f"{figure(volume)} mm³")
        parts.append(f"{figure(sum(m.area for m in all_))} mm²")
        self.measures.setText("    ".join(parts))
        self.measures.setToolTip("Triangles, volume and area" + (f" of {words}" if words else ""))
