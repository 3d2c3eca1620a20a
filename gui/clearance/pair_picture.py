"""A pair in the picture: the way between its solids or the body that they share, others faint, and the flight there."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent

from ...model.proximity.words import length_text, volume_text
from ..tools.tool import Tool

if TYPE_CHECKING:
    from ...model.proximity.findings import Finding
    from ...render.handles.clearance_marks import ClearanceMarks
    from ...render.viewer import Viewer
    from ..window import MainWindow

AROUND, CLOSE = 1.6, 0.9
"""Times the size of the place: what is seen on either side of it, chosen and zoomed to."""
GAPS = 3.0
FAR, NEAR = 0.08, 1e-4
"""Of the picture's solids: the least that is seen then."""


class PairPicture(Tool):
    """`left` tells that Escape was pressed in the picture while a pair was shown; `began` and `ended` that one is shown
    and that none is any more."""

    left = Signal()
    began = Signal()
    ended = Signal()

    def __init__(self, window: MainWindow, parent: QObject) -> None:
        super().__init__(parent)
        self._viewport = window.viewport
        self._marks: ClearanceMarks | None = None
        self._viewer: Viewer | None = None
        self.chosen: Finding | None = None
        window.viewport.add_tool(self)
        window.viewport.displayed.connect(self._fade)

    def attached(self, viewer: Viewer) -> None:
        from ...render.handles.clearance_marks import ClearanceMarks

        self._viewer = viewer
        self._marks = ClearanceMarks()
        viewer.overlay.add(self._marks)

    def closing(self) -> None:
        self._viewer = self._marks = None

    def key(self, event: QKeyEvent) -> bool:
        if self.chosen is None or event.key() != Qt.Key.Key_Escape:
            return False
        self.left.emit()
        return True

    def show(self, chosen: Finding | None) -> None:
        before, self.chosen = self.chosen, chosen
        self._draw()
        if (before is None) != (chosen is None):
            (self.ended if chosen is None else self.began).emit()

    def fly(self, close: bool = False) -> None:
        """Bring the pair's place into the middle of the picture; `close`: as near as it is large."""
        from ...render.camera import fit

        finding, viewer = self.chosen, self._viewer
        if finding is None or viewer is None:
            return
        bounds = viewer.scene.visible_bounds()
        scene = 100.0 if bounds is None else float(np.linalg.norm(np.ptp(bounds, axis=0)))
        size = float(np.ptp(finding.bounds, axis=0).max())
        half = max((CLOSE if close else AROUND) * size, GAPS * finding.gap, (NEAR if close else FAR) * scene)
        middle = finding.bounds.mean(axis=0)
        box = np.array([middle - half, middle + half])
        self._viewport.move_to(fit(viewer.camera, box, viewer.size[0] / viewer.size[1], 1.0))

    def _draw(self) -> None:
        marks, viewer, finding = self._marks, self._viewer, self.chosen
        if marks is None or viewer is None:
            return
        from ...render.handles.clearance_marks import MarkedPair

        if finding is None:
            marks.show(None)
            viewer.set_faded(())
        else:
            body, overlap = finding.body, finding.overlap
            vertices, triangles = (np.zeros((0, 3)), np.zeros((0, 3), int)) if body is None else (
                body.vertices, body.triangles)  # fmt: skip
            words = length_text(finding.gap) if finding.points is not None else volume_text(overlap or 0.0)
            words = "contact" if finding.points is not None and finding.gap == 0.0 else words
            marks.show(MarkedPair(finding.bounds.mean(axis=0), words, finding.points, vertices, triangles))
            self._fade()
        viewer.needs_render = True
        self._viewport.refresh()

    def _fade(self) -> None:
        """All but the chosen pair, also of what comes into the picture later."""
        finding, viewer = self.chosen, self._viewer
        if finding is not None and viewer is not None:
            viewer.set_faded(key for key in viewer.scene.meshes if key not in finding.ids)
