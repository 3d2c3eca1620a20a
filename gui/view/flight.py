"""A smooth way from one camera to another."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QVariantAnimation, Signal

if TYPE_CHECKING:
    from ...render.camera import Camera

DURATION = 200  # milliseconds


class Flight(QObject):
    """`moved` brings the cameras on the way, the last one being the goal itself."""

    moved = Signal(object)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._way: tuple[Camera, Camera] | None = None
        self._clock = QVariantAnimation(self)
        self._clock.setDuration(DURATION)
        self._clock.setStartValue(0.0)
        self._clock.setEndValue(1.0)
        self._clock.valueChanged.connect(self._step)

    def go(self, start: Camera, goal: Camera) -> None:
        """Fly from `start` to `goal`; a flight under way ends where it is."""
        self._clock.stop()
        self._way = (start, goal)
        self._clock.start()

    def stop(self) -> None:
        self._clock.stop()
        self._way = None

    def _step(self, part: float) -> None:
        from ...render.views import interpolate

        if self._way is not None:
            self.moved.emit(interpolate(*self._way, part * part * (3.0 - 2.0 * part)))
