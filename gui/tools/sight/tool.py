"""The tools for lines of sight: whether two points see each other, what is before and behind a face, what is seen of a
part from here, and what of a face from a point."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QPointF, Qt, Signal
from PySide6.QtGui import QKeyEvent

from ....model.document.tree import walk
from ....model.editing.session import Session
from ...hidden_surfaces import HiddenSurfaces
from ...view.viewport import Viewport
from ..click_tool import ClickTool
from .seen_surface import SeenSurface
from .words import ANEW, FIRST, SECOND, WORDS, Mode

if TYPE_CHECKING:
    from ....model.measuring.sight import SolidRays
    from ....model.measuring.visibility import Eye
    from ....model.partition.rays import Hit
    from ....model.partition.sight import Sight
    from ....render.handles.sight_marks import SightMarks
    from ....render.handles.snap import Snap, Snapper
    from ....render.handles.snap_mark import SnapMark
    from ....render.viewer import Viewer

Vector = tuple[float, float, float]

SORTING = "The faces are being sorted …"
UNSORTED = "The faces of this model could not be sorted; change it to try again"
LIVE = 0.03  # seconds that an answer may take for the line to be judged while the pointer moves


class SightTool(ClickTool):
    """Does nothing until `start`. `said` tells what to do and what was found, "" at the end."""

    said = Signal(str)
    began = Signal()
    ended = Signal()

    def __init__(
        self, session: Session, viewport: Viewport, hidden_surfaces: HiddenSurfaces, parent: QObject | None = None
    ) -> None:
        super().__init__(viewport, parent)
        self._session = session
        self._hidden_surfaces = hidden_surfaces
        self._snapper: Snapper | None = None
        self._snap_mark: SnapMark | None = None
        self._marks: SightMarks | None = None
        self._known: SolidRays | None = None
        self._seconds = 0.0  # that the last answer took
        self.mode: Mode | None = None
        self.points: tuple[Vector, ...] = ()
        """Those clicked; of a face a point on it and its normal."""
        self.sight: Sight | None = None
        """The answer about two points; None as long as there is none."""
        self.about: tuple[Hit | None, Hit | None] | None = None
        """The answer about a face: what stands before it, and what ends the wall below it."""
        self.seen = SeenSurface(session, viewport, self)
        """The answer about a part or a face that is looked at."""
        self._looked_at = ""
        self._eye: Eye | None = None
        self.seen.said.connect(self._say_seen)
        self.seen.rested.connect(self._judge)
        hidden_surfaces.changed.connect(self._sorted)
        viewport.displayed.connect(self._displayed)

    @property
    def active(self) -> bool:
        return self.mode is not None

    def start(self, mode: Mode) -> None:
        fresh = not self.active
        self.mode = mode
        self._forget()
        if fresh:
            self.began.emit()
            self._viewport.setCursor(Qt.CursorShape.CrossCursor)
        self._viewport.setFocus()
        self._rays()  # where the worker has to sort the faces, it begins now
        self.said.emit(FIRST[mode])

    def end(self) -> None:
        if self.active:
            self.mode = None
            self._forget()
            self._known = None
            self.drop_press()
            if self._snap_mark is not None:
                self._snap_mark.show(None)
            self._draw()
            self._viewport.unsetCursor()
            self.said.emit("")
            self.ended.emit()

    # Events.

    def attached(self, viewer: Viewer) -> None:
        from ....render.handles.sight_marks import SightMarks
        from ....render.handles.snap import Snapper
        from ....render.handles.snap_mark import SnapMark

        super().attached(viewer)
        self._snapper, self._snap_mark, self._marks = Snapper(viewer), SnapMark(), SightMarks()
        self.seen.attached(viewer)
        viewer.overlay.add(self._marks)
        viewer.overlay.add(self._snap_mark)

    def closing(self) -> None:
        self.end()
        self.seen.closing()
        super().closing()
        self._snapper = self._snap_mark = self._marks = None

    def takes_clicks(self) -> bool:
        return self.active

    def key(self, event: QKeyEvent) -> bool:
        if self.mode is None:
            return False
        if self.mode == "map" and event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self._look_from(self.seen.eye())
            return True
        if event.key() != Qt.Key.Key_Escape:
            return False
        if self.points or self._eye is not None:
            self._forget()
            self.said.emit(FIRST[self.mode])
        else:
            self.end()
        return True

    def pointed(self, position: QPointF | None) -> None:
        snap = None if position is None else self._find(position)
        if self._snap_mark is not None:
            self._snap_mark.show(snap)
        if self.mode == "points" and len(self.points) == 1:
            self._judge(None if snap is None else snap.point)
        elif not self.points and self._eye is None and self.mode is not None:
            self.said.emit(FIRST[self.mode] if snap is None else f"{WORDS[snap.kind]}. {FIRST[self.mode]}")
        self._draw()

    def clicked(self, position: QPointF) -> None:
        snap = self._find(position)
        if snap is None:
            return
        if self.mode == "map" and self._eye is None:
            from ....model.measuring.visibility import Eye

            self._look_from(Eye(snap.point), snap.point)
            return
        if self.mode in ("part", "map"):
            self.points = (snap.point,)
            self._looked_at = str(snap.path[0])
        elif self.mode == "ray":
            assert snap.direction is not None
            self._forget()
            self.points = (snap.point, snap.direction)
        elif len(self.points) == 1:
            self.points = (*self.points, snap.point)
        else:
            self._forget()
            self.points = (snap.point,)
        self._judge()

    def _look_from(self, eye: Eye | None, point: Vector | None = None) -> None:
        """Of the visibility map: from a point that was clicked, or the camera's eye, which gets no mark."""
        self._forget()
        self._eye, self.points = eye, () if point is None else (point,)
        if point is not None:
            self._show_point()
        self.said.emit(SECOND["map"])

    def _displayed(self) -> None:
        if self.active:
            self._judge()

    def _sorted(self) -> None:
        if self.active and self.points and self.sight is None and self.about is None and self.seen.view is None:
            self._judge()

    def _find(self, position: QPointF) -> Snap | None:
        if self._snapper is None:
            return None
        if self.mode == "points" or (self.mode == "map" and self._eye is None):
            return self._snapper.find(position.x(), position.y())
        pick = self._snapper.pick(position.x(), position.y())
        if pick is None:
            return None
        from ....render.handles.snap import Snap

        return Snap("face", pick.point, pick.normal, pick.path)

    # What is seen.

    def _rays(self) -> SolidRays | None:
        """Rays through what is shown; None while its faces are being sorted, or something moves."""
        from ....model.measuring.sight import SolidRays

        if self._viewer is None or self._session.previewing:
            return None
        found = self._hidden_surfaces.find()
        if found is None:
            return None
        if self._known is None or self._known.rays.tree is not found.tree:
            meshes = self._viewer.scene.solid_meshes
            if any(solid_id not in meshes for solid_id in found.solid_ids):
                return None
            self._known = SolidRays(found.tree, [meshes[solid_id] for solid_id in found.solid_ids])
        return self._known

    def _judge(self, target: Vector | None = None) -> None:
        """Answer for the points that were clicked, or for the first one and the one under the pointer."""
        from time import perf_counter

        if self.mode is None or not self.points:
            return
        if self.mode in ("part", "map"):
            self._judge_seen()
            return
        pending = self.mode == "points" and len(self.points) == 1
        self.sight = self.about = None
        if pending and target is None:
            self._show_point()
            self.said.emit(SECOND["points"])
            return
        slow = pending and self._seconds > LIVE
        start = perf_counter()
        rays = None if slow else self._rays()
        if self.mode == "ray":
            self._show_about(rays)
        else:
            self._show_sight(rays, self.points[0], self.points[-1] if target is None else target, pending)
        if rays is not None:
            self._seconds = perf_counter() - start
        self._draw()

    def _judge_seen(self) -> None:
        eye = self.seen.eye() if self.mode == "part" else self._eye
        if not self._looked_at or eye is None:
            return
        rays = self._rays()
        if rays is None:
            self.seen.forget()
            self.said.emit(self._why_not())
        else:
            self.seen.ask(rays, self._looked_at, None if self.mode == "part" else self.points[-1], eye)
        self._draw()

    def _say_seen(self, words: str) -> None:
        if self.mode is not None:
            self.said.emit(f"{words}; {ANEW[self.mode]}" if self.seen.view is not None else words)

    def _show_point(self) -> None:
        import numpy as np

        if self._marks is not None:
            self._marks.show((), [np.array(self.points[0])])
        self._draw()

    def _show_sight(self, rays: SolidRays | None, a: Vector, b: Vector, pending: bool) -> None:
        from .lines import show_sight, show_unknown

        if self._marks is None:
            return
        if rays is None:
            show_unknown(self._marks, a, b)
            self.said.emit(SECOND["points"] if pending else self._why_not())
            return
        sight = rays.sight(a, b)
        if not pending:
            self.sight = sight
        words = show_sight(self._marks, rays, sight, self._name)
        self.said.emit(f"{words}; {SECOND['points'] if pending else ANEW['points']}")

    def _show_about(self, rays: SolidRays | None) -> None:
        from .lines import show_about

        if self._marks is None:
            return
        point, normal = self.points
        if rays is None:
            self._show_point()
            self.said.emit(self._why_not())
            return
        self.about = gap, wall = rays.about(point, normal)
        words = show_about(self._marks, rays, point, normal, gap, wall, self._name)
        self.said.emit(f"{words}; {ANEW['ray']}")

    def _why_not(self) -> str:
        return UNSORTED if self._hidden_surfaces.unsortable else SORTING

    def _name(self, rays: SolidRays, hit: Hit) -> str:
        node_id = next(step for step in reversed(rays.owner(hit.face)) if isinstance(step, str))
        return next((node.label for node in walk(*self._session.view.roots) if node.id == node_id), node_id)

    def _forget(self) -> None:
        self.points, self.sight, self.about = (), None, None
        self._looked_at, self._eye = "", None
        self.seen.forget()
        if self._marks is not None:
            self._marks.show(())
        self._draw()

    def _draw(self) -> None:
        if self._viewer is not None:
            self._viewer.needs_render = True
            self._viewport.refresh()
