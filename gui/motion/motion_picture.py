"""A motion in the picture: parts where they are at a time, those that touch in a colour, the chosen contact marked."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent

from ..tools.tool import Tool

if TYPE_CHECKING:
    from ...model.proximity.moving.playing import Played, Touch
    from ...render.handles.fault_marks import FaultMarks
    from ...render.viewer import Viewer
    from ..window import MainWindow

AROUND = 0.3  # of the picture's solids: what is seen on either side of a contact that is gone to


class MotionPicture(Tool):
    """`left` tells that Escape was pressed in the picture while a motion is shown."""

    left = Signal()

    def __init__(self, window: MainWindow, parent: QObject) -> None:
        super().__init__(parent)
        self._window, self._viewport = window, window.viewport
        self._viewer: Viewer | None = None
        self._marks: FaultMarks | None = None
        self.away = False
        """Whether the picture shows another moment than the document's own."""
        window.viewport.add_tool(self)

    def attached(self, viewer: Viewer) -> None:
        from ...render.handles.fault_marks import FaultMarks

        self._viewer = viewer
        self._marks = FaultMarks()
        viewer.overlay.add(self._marks)

    def closing(self) -> None:
        self._viewer = self._marks = None

    def key(self, event: QKeyEvent) -> bool:
        if not self.away or event.key() != Qt.Key.Key_Escape:
            return False
        self.left.emit()
        return True

    def show(self, played: Played, share: float, listed: tuple[Touch, ...], chosen: Touch | None = None) -> None:
        """The parts at a share of the time, coloured where contacts `listed` there are new; a `chosen` one is marked,
        and all but its parts are faint."""
        viewer = self._viewer
        if viewer is None:
            return
        self.away = True
        if not played.recut.any():
            moves = played.move(share)
            moving = np.flatnonzero(played.moving)
            viewer.set_moves({played.ids[part]: moves[part] for part in moving.tolist()})
        lit = [] if chosen is not None else [touch for touch in listed if played.is_new(touch)]
        viewer.set_touched(played.ids[part] for touch in lit for part in (touch.one, touch.other))
        pair = () if chosen is None else (played.ids[chosen.one], played.ids[chosen.other])
        viewer.set_faded(key for key in viewer.scene.meshes if pair and key not in pair)
        self._mark(listed, chosen)
        self._viewport.refresh()

    def _mark(self, listed: tuple[Touch, ...], chosen: Touch | None) -> None:
        from ...render.handles.fault_marks import MarkedFault
        from .contact_rows import words_of

        if self._marks is None:
            return
        places = np.array([touch.place for touch in listed]).reshape(-1, 3)
        if chosen is None:
            self._marks.show(places)
            return
        lines = np.zeros((0, 2, 3)) if chosen.points is None else chosen.points[None]
        words = words_of(chosen).replace("\u202f", " ")
        self._marks.show(places, MarkedFault(chosen.place, chosen.gap, words, lines, np.zeros((0, 3, 3))))

    def fly(self, touch: Touch) -> None:
        """Bring a contact into the middle of the picture."""
        from ...render.camera import fit

        viewer = self._viewer
        bounds = None if viewer is None else viewer.scene.visible_bounds()
        if viewer is None or bounds is None:
            return
        half = AROUND * float(np.linalg.norm(np.ptp(bounds, axis=0)))
        box = np.array([touch.place - half, touch.place + half])
        self._viewport.move_to(fit(viewer.camera, box, viewer.size[0] / viewer.size[1], 1.0))

    def rest(self) -> None:
        """Everything where the document has it."""
        viewer = self._viewer
        if viewer is None or not self.away:
            return
        self.away = False
        viewer.set_moves({})
        viewer.set_touched(())
        viewer.set_faded(())
        if self._marks is not None:
            self._marks.show(np.zeros((0, 3)))
        self._viewport.refresh()
