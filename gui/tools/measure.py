"""The measure tool: a click picks a corner, an edge or a face and tells its figures, a second one how far it is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QPointF, Qt, Signal
from PySide6.QtGui import QKeyEvent

from ...model.editing.session import Session, State
from ..view.viewport import Viewport
from .click_tool import ClickTool

if TYPE_CHECKING:
    from ...model.measuring.elements import Element
    from ...model.measuring.measurement import Measurement
    from ...model.solid.display import DisplayMesh
    from ...render.handles.dimension import DimensionMarks
    from ...render.handles.snap import Snap, Snapper
    from ...render.handles.snap_mark import SnapMark
    from ...render.viewer import Viewer

WORDS = {"vertex": "Corner", "midpoint": "Middle", "centre": "Centre", "edge": "Edge", "face": "Face"}
FIRST = "Click a corner, an edge or a face to measure it; Escape ends this"
SECOND = "Click another one for distance and angle, or press Escape to keep this one alone"


@dataclass(eq=False, slots=True)
class Taken:
    """A measurement in the list, and the meshes by solid that it was taken on."""

    measurement: Measurement
    meshes: dict[str, DisplayMesh]
    stale: bool = False


class MeasureTool(ClickTool):
    """`changed` tells that the list, or what is chosen in it, is another one; `said` what to do next, "" at the end."""

    changed = Signal()
    said = Signal(str)
    began = Signal()
    ended = Signal()

    def __init__(self, session: Session, viewport: Viewport, parent: QObject | None = None) -> None:
        super().__init__(viewport, parent)
        self._session = session
        self._snapper: Snapper | None = None
        self._snap_mark: SnapMark | None = None
        self._marks: DimensionMarks | None = None
        self._first: tuple[Element, dict[str, DisplayMesh]] | None = None
        self.active = False
        self.taken: list[Taken] = []
        self.current: Taken | None = None

    def start(self) -> None:
        if not self.active:
            self.active = True
            self.began.emit()
            self._viewport.setCursor(Qt.CursorShape.CrossCursor)
            self._viewport.setFocus()
            self.said.emit(FIRST)

    def end(self) -> None:
        """Stop picking; the measurements stay."""
        if self.active:
            self.active = False
            self._first = None
            self.drop_press()
            self._point_at(None)
            self._viewport.unsetCursor()
            self.said.emit("")
            self.ended.emit()

    def choose(self, taken: Taken | None) -> None:
        """Show one of the list as the one that is looked at."""
        if taken is not self.current:
            self.current = taken
            self._follow()

    def remove(self, taken: Taken) -> None:
        self._forget([taken])

    def clear(self) -> None:
        self._forget(list(self.taken))

    # Events.

    def attached(self, viewer: Viewer) -> None:
        from ...render.handles.dimension import DimensionMarks
        from ...render.handles.snap import Snapper
        from ...render.handles.snap_mark import SnapMark

        super().attached(viewer)
        self._snapper, self._snap_mark, self._marks = Snapper(viewer), SnapMark(), DimensionMarks()
        viewer.overlay.add(self._marks)
        viewer.overlay.add(self._snap_mark)

    def closing(self) -> None:
        self.end()
        super().closing()
        self._snapper = self._snap_mark = self._marks = None

    def takes_clicks(self) -> bool:
        return self.active

    def pointed(self, position: QPointF | None) -> None:
        self._point_at(None if position is None else self._find(position))

    def key(self, event: QKeyEvent) -> bool:
        if not self.active or event.key() != Qt.Key.Key_Escape:
            return False
        if self._first is not None:
            self._first = None
            self.said.emit(FIRST)
        else:
            self.end()
        return True

    def shown(self) -> None:
        """What was measured on a mesh that is gone is out of date, and right again when that comes back."""
        if self._viewer is None:
            return
        meshes = self._viewer.scene.meshes
        gone = False
        for taken in self.taken:
            stale = any(meshes.get(root) is not mesh for root, mesh in taken.meshes.items())
            gone, taken.stale = gone or stale != taken.stale, stale
        if self._first is not None and any(meshes.get(root) is not mesh for root, mesh in self._first[1].items()):
            self._first = None
            self.said.emit(FIRST)
        if gone:
            self._follow()

    def session_changed(self, before: State, after: State) -> None:
        held = {root.id for root in after.document.solids}
        if self.taken and not self._session.previewing and not held:
            self.clear()

    # What is picked.

    def _find(self, position: QPointF) -> Snap | None:
        snap = None if self._snapper is None else self._snapper.find(position.x(), position.y())
        return None if snap is None or snap.kind == "grid" else snap

    def _point_at(self, snap: Snap | None) -> None:
        if self._snap_mark is None or self._viewer is None:
            return
        self._snap_mark.show(snap)
        if snap is not None:
            self.said.emit(f"{WORDS[snap.kind]}. {FIRST if self._first is None else SECOND}")
        self._draw()

    def clicked(self, position: QPointF) -> None:
        from ...model.measuring.measurement import measurement

        picked = self._element(position)
        if picked is None:
            self.said.emit(FIRST if self._first is None else SECOND)
            return
        element, meshes = picked
        if self._first is None:
            self._first = picked
            taken = Taken(measurement(element), meshes)
        else:
            first, older = self._first
            self._first = None
            if self.current is not None and self.current in self.taken:
                self.taken.remove(self.current)  # what the first click told is in the answer to both
            taken = Taken(measurement(first, element), {**older, **meshes})
        self.taken.append(taken)
        self.current = taken
        self.said.emit(FIRST if self._first is None else SECOND)
        self._follow()

    def _element(self, position: QPointF) -> tuple[Element, dict[str, DisplayMesh]] | None:
        """What lies under the pointer, and the mesh it belongs to by its solid."""
        from ...model.document.resolve import resolve
        from ...model.measuring.elements import edge_element, face_element, point_element

        snap = self._find(position)
        if snap is None or self._snapper is None or self._viewer is None:
            return None
        meshes = self._viewer.scene.meshes
        root_id = str(snap.path[0]) if snap.path else ""
        mine = {root_id: meshes[root_id]} if root_id in meshes else {}
        if snap.kind not in ("edge", "face") or not mine:
            return point_element(snap.point, WORDS[snap.kind]), mine
        root = next((root for root in resolve(self._session.view).solids if root.id == root_id), None)
        if root is None:  # the picture is behind the document
            return None
        if snap.kind == "edge":
            return edge_element(root, mine[root_id], snap.point), mine
        pick = self._snapper.pick(position.x(), position.y())
        if pick is None or pick.triangle < 0:  # the hatched face of a section
            return point_element(snap.point, "Point in a section"), mine
        return face_element(root, mine[root_id], pick.triangle, pick.point), mine

    # The list.

    def _forget(self, gone: list[Taken]) -> None:
        self.taken = [taken for taken in self.taken if taken not in gone]
        if self.current not in self.taken:
            self.current = self.taken[-1] if self.taken else None
            self._first = None
        self._follow()

    def _follow(self) -> None:
        if self._marks is not None:
            from ...render.handles.dimension import Dimension

            shown = sorted(self.taken, key=lambda taken: taken is self.current)
            self._marks.show(
                [
                    Dimension(
                        taken.measurement.line,
                        taken.measurement.legs,
                        taken.measurement.outline,
                        taken is self.current,
                        taken.stale,
                    )
                    for taken in shown
                ]
            )
        self._draw()
        self.changed.emit()

    def _draw(self) -> None:
        if self._viewer is not None:
            self._viewer.needs_render = True
            self._viewport.refresh()
