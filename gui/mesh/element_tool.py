"""The tool that chooses vertices, edges, faces, loops and chains of the inspected mesh in the picture."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np
from PySide6.QtCore import QObject, QPointF, Qt, Signal
from PySide6.QtGui import QKeyEvent

from ...model.mesh import selecting
from ...model.mesh.selecting import Kind
from ...model.mesh.winged import LEFT
from ..tools.click_tool import ClickTool
from .chosen import Chosen
from .source import MeshSource

if TYPE_CHECKING:
    from ..view.viewport import Viewport

Mode = Literal["vertex", "edge", "face", "loop", "chain"]
KINDS: dict[Mode, Kind] = {"vertex": "vertex", "edge": "edge", "face": "face", "loop": "edge", "chain": "edge"}
HINTS: dict[Mode, str] = {
    "vertex": "Click a vertex",
    "edge": "Click an edge: its wings are drawn",
    "face": "Click a face",
    "loop": "Click in a face, near the loop that is meant",
    "chain": "Click an edge: those that go on smoothly from it are chosen too",
}
MORE = "Shift adds, Ctrl adds and takes away, Escape chooses nothing, then ends this"
LIVE = 200_000  # edges of a mesh whose chains are followed while the pointer moves


class ElementTool(ClickTool):
    """`hovered` carries a kind, None for nothing, and elements; `solid_asked` the root's id of a solid that was clicked
    and is not the inspected one; `picked` tells that a click has chosen something; `said` what to do, "" at the end."""

    hovered = Signal(object, object)
    solid_asked = Signal(str)
    picked = Signal()
    said = Signal(str)
    began = Signal()
    ended = Signal()

    modifiers = (
        Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.ControlModifier,
    )  # fmt: skip

    def __init__(self, viewport: Viewport, source: MeshSource, chosen: Chosen, parent: QObject) -> None:
        super().__init__(viewport, parent)
        self._source, self._chosen = source, chosen
        self.mode: Mode = "edge"
        self.active = False
        self._hover: tuple[Kind | None, tuple[int, ...]] = (None, ())

    def takes_clicks(self) -> bool:
        return self.active

    def start(self, mode: Mode | None = None) -> None:
        if mode is not None:
            self.mode = mode
        fresh, self.active = not self.active, True
        self.said.emit(f"{HINTS[self.mode]}; {MORE}")
        if fresh:
            self.began.emit()

    def end(self) -> None:
        if self.active:
            self.active = False
            self.drop_press()
            self._show(None, ())
            self.said.emit("")
            self.ended.emit()

    def closing(self) -> None:
        self.end()
        super().closing()

    def pointed(self, position: QPointF | None) -> None:
        kind, elements, _, _ = (None, (), -1, "") if position is None else self._at(position, hovering=True)
        self._show(kind, tuple(elements))

    def clicked(self, position: QPointF) -> None:
        if self._source.mesh is not None and not self._source.up_to_date:
            return  # what is in the picture is on its way
        kind, elements, current, solid = self._at(position)
        if solid and solid != self._source.solid:
            self.solid_asked.emit(solid)
            return
        way = {
            Qt.KeyboardModifier.ShiftModifier: "add", Qt.KeyboardModifier.ControlModifier: "toggle",
        }.get(self.held, "only")  # fmt: skip
        if kind is not None:
            self._chosen.choose(KINDS[self.mode], elements, current, way)
            self.picked.emit()
        elif way == "only":
            self._chosen.clear()

    def key(self, event: QKeyEvent) -> bool:
        if not self.active or event.key() != Qt.Key.Key_Escape:
            return False
        if self._chosen.count:
            self._chosen.clear()
        else:
            self.end()
        return True

    def _show(self, kind: Kind | None, elements: tuple[int, ...]) -> None:
        if (kind, elements) != self._hover:
            self._hover = kind, elements
            self.hovered.emit(kind, np.array(elements, np.int64))

    def _at(self, position: QPointF, hovering: bool = False) -> tuple[Kind | None, list[int], int, str]:
        """Kind and elements under the pointer, the one that is meant, and the solid; None and "" for none."""
        from ...render.mesh.element_pick import REACH, element_at, pick_near

        viewer, mesh = self._viewer, self._source.mesh
        if viewer is None or (mesh is not None and not self._source.up_to_date):
            return None, [], -1, ""
        x, y = position.x(), position.y()
        pick = pick_near(viewer, x, y)
        if pick is None:
            return None, [], -1, ""
        if mesh is None or pick.solid_id != self._source.solid:
            return None, [], -1, pick.solid_id
        kind = KINDS[self.mode]
        found = element_at(viewer, mesh, pick.triangle, kind, x, y, np.inf if self.mode == "loop" else REACH)
        if found < 0:
            return None, [], -1, pick.solid_id
        if self.mode == "loop":
            face = int(mesh.triangle_face[pick.triangle])
            side = int(mesh.winged.table[found, LEFT] != face)
            return kind, selecting.loop_of_edge(mesh, found, side), found, pick.solid_id
        if self.mode == "chain" and not (hovering and len(mesh.winged) > LIVE):
            return kind, selecting.chain_of_edge(mesh, found), found, pick.solid_id
        return kind, [found], found, pick.solid_id
