"""What a drawing tool shows in the picture: the draft, the plane, what is snapped to, and the numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ....model.path.flatten import flatten
from ....model.path.path import Path
from ....render.camera import vector_of
from ....render.curves.draft_marks import DraftMarks, DraftPicture, PlaneMark
from ....render.handles.label import Label
from ....render.handles.snap import Kind as LandmarkKind
from ....render.handles.snap import Snap as Landmark
from ....render.handles.snap_mark import SnapMark

if TYPE_CHECKING:
    from ....render.viewer import Viewer
    from .draft import Sketch
    from .snapping import Snap

Floats = NDArray[np.float64]

SIGNS: dict[str, LandmarkKind] = {
    "node": "vertex", "corner": "vertex", "midpoint": "midpoint", "centre": "centre", "curve": "edge", "edge": "edge",
    "grid": "grid",
}  # fmt: skip
SMOOTH = 0.3
"""Pixels that the chords may be off a curve."""


class DraftView:
    """The overlay's side of a drawing tool, for as long as there is a viewer."""

    def __init__(self, viewer: Viewer) -> None:
        self.viewer = viewer
        self._marks, self._snap_mark, self._label = DraftMarks(), SnapMark(), Label()
        self._plane = PlaneMark(viewer.overlay.renderer)
        for mark in (self._plane, self._marks, self._snap_mark, self._label):
            viewer.overlay.add(mark)

    @property
    def pixel(self) -> float:
        """Millimetres that a pixel has at the depth of what is looked at."""
        return 2.0 * self.viewer.camera.half_height / self.viewer.size[1]

    def hide(self) -> None:
        self._marks.show(None)
        self._snap_mark.show(None)
        self._plane.show(None)
        self._label.show("")

    def show(
        self, sketch: Sketch, frame: Floats, snap: Snap | None, words: str, place: tuple[float, float] | None
    ) -> None:
        """A sketch in the plane of `frame` (3, 4), and what the pointer at pixel `place` has snapped to."""
        guides = [] if snap is None else [_world(line, frame) for line in snap.guides]
        self._plane.show(frame)
        self._marks.show(
            DraftPicture(
                self._lines(sketch.settled, frame),
                self._lines(sketch.coming, frame),
                guides,
                _world(sketch.nodes, frame),
                _world(sketch.arms.reshape(-1, 2), frame).reshape(-1, 2, 3),
            )
        )
        sign = None if snap is None else SIGNS.get(snap.kind)
        if snap is None or sign is None:
            self._snap_mark.show(None)
        else:
            self._snap_mark.show(Landmark(sign, vector_of(_world(snap.point[None], frame)[0]), None, ()))
        x, y = place or (0.0, 0.0)
        self._label.show("" if place is None else words, x, y)

    def _lines(self, path: Path | None, frame: Floats) -> list[Floats]:
        if path is None:
            return []
        closing = [contour.closed for contour in path.contours]
        return [
            _world(np.vstack((line, line[:1])) if closed else line, frame)
            for line, closed in zip(flatten(path, SMOOTH * self.pixel), closing, strict=True)
        ]


def _world(points: Floats, frame: Floats) -> Floats:
    """(k, 3) of points (k, 2) in a plane."""
    return points @ frame[:, :2].T + frame[:, 3]
