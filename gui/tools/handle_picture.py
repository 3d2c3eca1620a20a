"""What the handles show in the picture: their marks, the label beside the pointer, and what is snapped to."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from ...render.handles.handle_marks import HandleMarks
from ...render.handles.label import Label
from ...render.handles.snap import Snap, Snapper
from ...render.handles.snap_mark import SnapMark
from .gizmos import Gizmos

if TYPE_CHECKING:
    from ...model.editing.session import State
    from ...model.solid.display import DisplayMesh
    from ...render.viewer import Viewer

SNAPPED = ("vertex", "midpoint", "centre", "edge")


class HandlePicture:
    """The overlay's side of the handles, for as long as there is a viewer."""

    def __init__(self, viewer: Viewer, half_spaces_seen: Callable[[], bool]) -> None:
        self.viewer = viewer
        self.gizmos = Gizmos(viewer, half_spaces_seen)
        self._marks, self._label, self._snap_mark = HandleMarks(), Label(), SnapMark()
        self._snapper = Snapper(viewer)
        self._meshes: dict[str, DisplayMesh] = {}
        self._place = (0.0, 0.0)
        for mark in (self._marks, self._snap_mark, self._label):
            viewer.overlay.add(mark)

    @property
    def hovered(self) -> str | None:
        return self._marks.hover

    def show(self, state: State, mode: str, local: bool, dragging: bool) -> None:
        """Show the handles of the selected nodes."""
        self._marks.show(self.gizmos.handles(state, mode, local, dragging))

    def caught(self, x: float, y: float) -> str | None:
        """The name of the handle under pixel (x, y)."""
        if self.viewer.cube_hit(x, y):
            return None
        found = self._marks.caught(self.viewer.camera, self.viewer.size, x, y)
        return None if found is None else found.name

    def hover(self, name: str | None, x: float, y: float, telling: bool) -> None:
        """Brighten a handle, and tell what it holds."""
        self._marks.hover = name
        if telling:
            self._label.show("" if name is None else self.gizmos.words(name), x, y)

    def begin(self, name: str | None) -> None:
        """A drag begins; what it snaps to is what is shown now."""
        self._marks.hover, self._marks.active = None, name
        self._meshes = self.viewer.scene.meshes

    def end(self) -> None:
        self._marks.active = None
        self._meshes = {}
        self._label.show("")
        self._snap_mark.show(None)

    def go(self, x: float, y: float) -> None:
        """The label stands beside this pixel from now on."""
        self._place = (x, y)

    def say(self, words: str, fault: str) -> None:
        self._label.show(f"{words}\n {fault}" if fault else words, *self._place, fault=bool(fault))

    def snap(self, name: str, x: float, y: float, wanted: bool) -> Snap | None:
        """What the handle snaps to at pixel (x, y), which is marked."""
        snap = None
        if wanted and self.gizmos.snaps(name):
            found = self._snapper.find(x, y, self.gizmos.ids, self._meshes)
            kinds = (*SNAPPED, "face") if name == "move" else SNAPPED
            snap = found if found is not None and found.kind in kinds else None
        self._snap_mark.show(snap)
        return snap
