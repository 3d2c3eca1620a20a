"""The tool that lays a node on a face: hover shows where it would go, a click puts it there."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QPointF, Qt, Signal
from PySide6.QtGui import QKeyEvent

from ...model.document.errors import Refusal
from ...model.document.tree import find
from ...model.editing.session import Session, State
from ...model.operations.operations import OPERATIONS
from ..view.viewport import Viewport
from .click_tool import ClickTool

if TYPE_CHECKING:
    from ...model.document.document import Document
    from ...model.measuring.landmarks import Face
    from ...model.solid.display import DisplayMesh
    from ...model.worker.shown import Part
    from ...render.handles.face_mark import FaceMark
    from ...render.handles.laying import Laying
    from ...render.handles.overlay import Mark
    from ...render.handles.snap import Snap
    from ...render.handles.snap_mark import SnapMark
    from ...render.viewer import Viewer


@dataclass(slots=True)
class _Task:
    """The document that the tool began with, the node, its name, and where it goes."""

    document: Document
    node_id: str
    label: str
    laying: Laying
    cuts: bool


class PlaceOnFace(ClickTool):
    """Does nothing until `start`. `said` carries what to do next, "" at the end; `ended` comes once for each start."""

    said = Signal(str)
    refused = Signal(str)
    ended = Signal()

    def __init__(
        self, session: Session, viewport: Viewport, part: Callable[[str], Part | None], parent: QObject | None = None
    ) -> None:
        """`part` gives a selected node by itself, None where it has not been looked at."""
        super().__init__(viewport, parent)
        self._session = session
        self._part = part
        self._snap_mark: SnapMark | None = None
        self._face_mark: FaceMark | None = None
        self._task: _Task | None = None
        self._previewed: Document | None = None
        self._other_marks: list[Mark] = []
        """What else was drawn over the solids; it would only be in the way, and comes back at the end."""

    @property
    def active(self) -> bool:
        return self._task is not None

    def start(self) -> None:
        """Begin to lay the selected node. Raises Refusal."""
        from ...model.document.resolve import resolve
        from ...model.solid.places import places_of
        from ...model.solid.roles import Role, role_of
        from ...render.handles.laying import Laying

        self.end()
        if self._viewer is None:
            raise Refusal("the picture is not there yet")
        document, (node_id,) = self._session.document, self._session.selection
        label = find(document, node_id).label
        part = self._part(node_id)
        resolved = resolve(document)
        places = places_of(resolved.solids, [node_id]).get(node_id)
        if part is None or part.mesh is None or part.measures is None or not len(part.mesh.triangles) or not places:
            raise Refusal(f"“{label}” has no surface of its own that could lie on a face")
        node = find(document, node_id)
        cuts = role_of(resolved.solids, places[0].path) is Role.SUBTRACTED
        laying = Laying(self._viewer, places[0], node.placement, part.mesh, resolved.values, cuts)
        self._task = _Task(document, node_id, label, laying, cuts)
        overlay = self._viewer.overlay
        self._other_marks = [mark for mark in overlay.marks if mark is not self._snap_mark]
        for mark in self._other_marks:
            overlay.remove(mark)
        self._viewer.needs_render = True
        self._viewport.setCursor(Qt.CursorShape.CrossCursor)
        self._viewport.setFocus()
        self._say()

    def end(self) -> None:
        """Stop, and take back what is previewed."""
        task, self._task = self._task, None
        self.drop_press()
        if task is None:
            return
        if self._session.document is self._previewed:
            self._session.cancel()
        self._previewed = None
        if self._viewer is not None:
            for mark in self._other_marks:
                self._viewer.overlay.add(mark)
        self._other_marks = []
        self._show()
        self._viewport.unsetCursor()
        self.said.emit("")
        self.ended.emit()

    def _say(self) -> None:
        assert self._task is not None
        if self._task.laying.chosen:
            words = "should cut into" if self._task.cuts else "should lie on"
        else:
            does = "should cut into" if self._task.cuts else "should stand on"
            words = f"{does}, or first the face of its own to put there"
        self.said.emit(f"Click the face that “{self._task.label}” {words}; Escape ends this")

    # Events.

    def attached(self, viewer: Viewer) -> None:
        from ...render.handles.face_mark import FaceMark
        from ...render.handles.snap_mark import SnapMark

        super().attached(viewer)
        self._snap_mark, self._face_mark = SnapMark(), FaceMark(viewer)
        viewer.overlay.add(self._snap_mark)

    def closing(self) -> None:
        self.end()
        super().closing()
        self._snap_mark = self._face_mark = None

    def takes_clicks(self) -> bool:
        return self.active

    def pointed(self, position: QPointF | None) -> None:
        if position is None:
            self._away()
        else:
            self._hover(position)

    def key(self, event: QKeyEvent) -> bool:
        if self._task is None or event.key() != Qt.Key.Key_Escape:
            return False
        self.end()
        return True

    def session_changed(self, before: State, after: State) -> None:
        task = self._task
        if task is None:
            return
        other = after.document is not task.document and after.document is not self._previewed
        if other or after.selection != (task.node_id,):
            self.end()

    def shown(self) -> None:
        task = self._task
        if task is not None and self._viewer is not None and not self._session.previewing:
            task.laying.meshes = self._viewer.scene.solid_meshes

    # What the pointer means.

    def _hover(self, position: QPointF) -> None:
        task = self._task
        if task is None:
            return
        own = task.laying.own(position.x(), position.y())
        if own is not None:
            self._session.cancel()
            self._show(*task.laying.own_face(own))
            return
        found = task.laying.at(position.x(), position.y())
        if found is None:
            self._away()
            return
        self._show(found.mesh, found.face, found.snap)
        try:
            self._previewed = OPERATIONS["place"](task.document, task.node_id, *found.placement.steps)
            self._session.preview(self._previewed)
        except Refusal as refusal:
            self.refused.emit(str(refusal))

    def clicked(self, position: QPointF) -> None:
        task = self._task
        if task is None:
            return
        own = task.laying.own(position.x(), position.y())
        if own is not None:
            task.laying.choose(own)
            self._away()
            self._say()
            return
        found = task.laying.at(position.x(), position.y())
        if found is None:
            return
        self.end()
        try:
            self._session.do("place", task.node_id, *found.placement.steps, label="Place on face")
        except Refusal as refusal:
            self.refused.emit(str(refusal))

    def _away(self) -> None:
        """The pointer is on nothing to lie on."""
        self._session.cancel()
        self._show()

    def _show(self, mesh: DisplayMesh | None = None, face: Face | None = None, snap: Snap | None = None) -> None:
        """Mark a face and a landmark, and nothing beside them."""
        if self._viewer is None or self._face_mark is None or self._snap_mark is None:
            return
        self._face_mark.show(mesh, face)
        if self._snap_mark.show(snap):
            self._viewer.needs_render = True
        self._viewport.refresh()
