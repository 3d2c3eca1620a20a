"""The painter's order step by step: a slider and buttons for how many fragments are drawn."""

from __future__ import annotations

from PySide6.QtCore import QEvent, Qt, QTimer, Signal
from PySide6.QtGui import QHideEvent, QKeyEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSlider, QToolButton, QVBoxLayout, QWidget

from ..icons import icon

LASTING = 9000  # milliseconds that playing the whole order takes, unless there are few fragments
SHORTEST, LONGEST = 40, 350  # milliseconds from one picture to the next


KEYS = (Qt.Key.Key_Left, Qt.Key.Key_Right, Qt.Key.Key_Home, Qt.Key.Key_End, Qt.Key.Key_Space)


class StepSlider(QSlider):
    """Keeps its keys, of which the window has one as a shortcut; Space is its parent's."""

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent) and event.key() in KEYS:
            event.accept()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Space:
            event.ignore()
        else:
            super().keyPressEvent(event)


class OrderBar(QWidget):
    """`stepped` carries how many fragments are to be drawn, -1 for all, with no step marked."""

    stepped = Signal(int)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.slider = StepSlider(Qt.Orientation.Horizontal, self)
        self.slider.setAccessibleName("Fragments drawn, from back to front")
        self.slider.setToolTip("Draw only the first fragments of the painter's order, from back to front")
        self.slider.valueChanged.connect(self._moved)
        self.words = QLabel(self)
        self.words.setWordWrap(True)
        self.words.setContentsMargins(8, 0, 8, 2)
        self.words.setTextFormat(Qt.TextFormat.PlainText)
        self.words.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.words.setMinimumHeight(2 * self.words.fontMetrics().lineSpacing() + 2)  # nothing moves while it plays
        self._clock = QTimer(self)
        self._clock.timeout.connect(lambda: self.go(self.count + self._stride))
        self._stride = 1
        row = QHBoxLayout()
        row.setContentsMargins(6, 2, 8, 2)
        row.setSpacing(1)
        self.play = self._button("play", "Play the painter's order (Space)", self.toggle)
        for button in (
            self._button("to_start", "Draw nothing (Home)", lambda: self.go(0)),
            self._button("step_back", "One fragment less (Left)", lambda: self.go(self.count - 1)),
            self.play,
            self._button("step_forward", "One fragment more (Right)", lambda: self.go(self.count + 1)),
            self._button("to_end", "Draw all (End)", lambda: self.go(self.total)),
        ):
            row.addWidget(button)
        row.addWidget(self.slider, 1)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 2, 0, 4)
        layout.setSpacing(0)
        layout.addLayout(row)
        layout.addWidget(self.words)

    def _button(self, name: str, tip: str, act) -> QToolButton:
        button = QToolButton(self)
        button.setProperty("flat", True)
        button.setIcon(icon(name))
        button.setToolTip(tip)
        button.setAccessibleName(tip)
        button.clicked.connect(act)
        return button

    @property
    def total(self) -> int:
        return self.slider.maximum()

    @property
    def count(self) -> int:
        """How many are drawn; all of them where no step is shown."""
        return self.slider.value()

    @property
    def playing(self) -> bool:
        return self._clock.isActive()

    def set_total(self, total: int) -> None:
        """Another order with so many fragments: all are drawn."""
        self.stop()
        self.slider.blockSignals(True)
        self.slider.setRange(0, total)
        self.slider.setPageStep(max(total // 20, 1))
        self.slider.setValue(total)
        self.slider.blockSignals(False)
        self.setEnabled(total > 0)
        self.say("")

    def say(self, words: str) -> None:
        self.words.setText(words or f"All {self.total:,} fragments are drawn.")

    def go(self, count: int) -> None:
        """Draw so many fragments."""
        count = min(max(count, 0), self.total)
        if count == self.total:
            self.stop()
        self.slider.setValue(count)

    def toggle(self) -> None:
        """Play, from the beginning where all are drawn; or stop."""
        if self.playing:
            self.stop()
            return
        if not self.total:
            return
        if self.count >= self.total:
            self.go(0)
        interval = min(max(LASTING // self.total, SHORTEST), LONGEST)
        self._stride = max(round(self.total * interval / LASTING), 1)
        self._clock.start(interval)
        self._show_state()

    def stop(self) -> None:
        self._clock.stop()
        self._show_state()

    def _show_state(self) -> None:
        self.play.setIcon(icon("pause" if self.playing else "play"))

    def _moved(self, count: int) -> None:
        self.stepped.emit(-1 if count == self.total else count)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        moves = {Qt.Key.Key_Left: self.count - 1, Qt.Key.Key_Right: self.count + 1, Qt.Key.Key_Home: 0,
                 Qt.Key.Key_End: self.total}  # fmt: skip
        key = Qt.Key(event.key())
        if key == Qt.Key.Key_Space:
            self.toggle()
        elif key in moves:
            self.go(moves[key])
        else:
            super().keyPressEvent(event)

    def hideEvent(self, event: QHideEvent) -> None:
        super().hideEvent(event)
        self.stop()
