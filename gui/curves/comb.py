"""The comb of curvature and the marks at joints in the viewport, for the outline that is being edited."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Signal

from ..tools.tool import Tool

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...model.outline.joints import Comb, JointAt
    from ...render.curves.comb_marks import CombMarks, CombPicture
    from ...render.viewer import Viewer
    from ..settings import Settings
    from ..view.viewport import Viewport
    from .active import ActiveCurve

MOST_PIECES = 4000
"""Segments of an outline of which more get no comb: it would be a blot, and take long."""


class CombView(Tool):
    """`changed` tells that the switches, the comb or the joints are others.

    `factor` and `teeth` are those of `comb_of`; marks are shown at joints below `wanted`, while `badges` is on.
    """

    changed = Signal()

    def __init__(self, active: ActiveCurve, viewport: Viewport, settings: Settings) -> None:
        super().__init__(viewport)
        self._active, self._viewport, self._settings = active, viewport, settings
        self.on = settings.flag("curvature_comb", False)
        self.badges = False
        self.factor, self.teeth, self.wanted = 1.0, 24, 2
        self.comb: Comb | None = None
        self.joints: list[JointAt] = []
        self._marks: CombMarks | None = None
        self._viewer: Viewer | None = None
        active.changed.connect(self.refresh)

    def attached(self, viewer: Viewer) -> None:
        from ...render.curves.comb_marks import CombMarks

        self._viewer, self._marks = viewer, CombMarks()
        viewer.overlay.add(self._marks)
        self.refresh()

    def closing(self) -> None:
        self._viewer = self._marks = None

    def set_on(self, on: bool) -> None:
        self.on = on
        self._settings.set_flag("curvature_comb", on)
        self.refresh()

    def set_badges(self, on: bool) -> None:
        self.badges = on
        self.refresh()

    def set_comb(self, factor: float, teeth: int) -> None:
        self.factor, self.teeth = factor, teeth
        self.refresh()

    def set_wanted(self, grade: int) -> None:
        self.wanted = grade
        self.refresh()

    def refresh(self) -> None:
        """Follow the outline and the switches."""
        path = self._active.path
        self.comb, self.joints = None, []
        if path is not None and (self.on or self.badges):
            from ...model.outline.joints import comb_of, joints_of

            few = sum(len(contour) for contour in path.contours) <= MOST_PIECES
            if self.on and few:
                self.comb = comb_of(path, self.factor, self.teeth)
            if self.badges and few:
                self.joints = joints_of(path)
        if self._marks is not None and self._viewer is not None:
            self._marks.show(self._picture() if self.comb is not None or self.joints else None)
            self._viewer.needs_render = True
            self._viewport.refresh()
        self.changed.emit()

    def _picture(self) -> CombPicture:
        import numpy as np

        from ...render.curves.comb_marks import CombPicture

        teeth = envelope = np.zeros((0, 2, 3))
        sharpest = np.zeros((0, 3))
        if self.comb is not None:
            roots, tips = self._world(self.comb.roots), self._world(self.comb.tips)
            teeth = np.stack((roots, tips), axis=1)
            along = np.ones(len(tips) - 1, bool)
            along[self.comb.starts[1:-1] - 1] = False  # from one segment to the next it may jump
            envelope = np.stack((tips[:-1], tips[1:]), axis=1)[along]
            sharpest = self._world(self.comb.sharpest[None])
        low = [one for one in self.joints if one.grade < self.wanted]
        points = self._world(np.array([one.joint.point for one in low]).reshape(len(low), -1)) if low else sharpest[:0]
        return CombPicture(teeth, envelope, points, np.array([one.grade for one in low], np.int8), sharpest)

    def _world(self, points: NDArray) -> NDArray:
        frame = self._active.frame
        return points @ frame[:, : points.shape[1]].T + frame[:, 3]
