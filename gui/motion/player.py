"""The clock of a motion that is played: it keeps the time and leaves out pictures where drawing is slow."""

from __future__ import annotations

import time
from collections.abc import Callable

from PySide6.QtCore import QObject, QTimer, Signal

INTERVAL = 16  # milliseconds from one picture to the next, where drawing is quick


class Player(QObject):
    """`moved` carries the share of the time that has gone, 0 to 1; `changed` that it plays or does so no more."""

    moved = Signal(float)
    changed = Signal()

    def __init__(self, parent: QObject | None = None, clock: Callable[[], float] = time.monotonic) -> None:
        super().__init__(parent)
        self.clock = clock
        self._ticks = QTimer(self)
        self._ticks.setInterval(INTERVAL)
        self._ticks.timeout.connect(self.tick)
        self._begin = 0.0
        self.seconds = 1.0
        self.share = 0.0
        self.looping = False

    @property
    def playing(self) -> bool:
        return self._ticks.isActive()

    def go(self, share: float) -> None:
        """Go to a share of the time; playing goes on from there."""
        self.share = min(max(share, 0.0), 1.0)
        self._begin = self.clock() - self.share * self.seconds
        self.moved.emit(self.share)

    def play(self) -> None:
        """Go on, from the beginning where it is at the end."""
        if not self.playing:
            share = 0.0 if self.share >= 1.0 else self.share
            self._ticks.start()
            self.changed.emit()
            self.go(share)

    def pause(self) -> None:
        if self.playing:
            self._ticks.stop()
            self.changed.emit()

    def tick(self) -> None:
        """To where the clock is."""
        share = (self.clock() - self._begin) / self.seconds
        if share >= 1.0 and self.looping:
            self._begin += int(share) * self.seconds
            share %= 1.0
        elif share >= 1.0:
            self.pause()
        self.share = min(share, 1.0)
        self.moved.emit(self.share)
