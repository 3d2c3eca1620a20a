"""The placement of the bitmap on the selected node: arrows that shift its frame, rings that turn it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject, Signal

from ....model.document.errors import Refusal
from ....model.document.resolve import Resolver
from ....model.document.tree import find
from ....model.solid.places import places_of
from ....model.surface.mapping import TextureMapping
from ..in_force import mapping_changes, mapping_in_force
from .handle_tool import Drag, HandleTool

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ....model.editing.session import Session, State
    from ....render.handles.handle import Handle
    from ....render.viewer import Viewer
    from ...view.viewport import Viewport

NATURAL = "With the natural projection each primitive has a place of its own: choose another projection first"
HINT = "Drag the arrows and the rings to shift and turn the texture; Escape ends this"
NOWHERE = "The selected node stands nowhere in the picture"


class MappingTool(HandleTool):
    """Works on one selected node, and ends when another one is selected, or with Escape."""

    began = Signal()
    ended = Signal()

    def __init__(self, session: Session, viewport: Viewport, parent: QObject | None = None) -> None:
        super().__init__(session, viewport, parent)
        self._resolver = Resolver()
        self._node_id = ""

    @property
    def active(self) -> bool:
        return bool(self._node_id)

    def switch(self) -> None:
        """Begin or end. Raises Refusal where the node's bitmap cannot be placed so."""
        if self.active:
            self.end()
        else:
            self.start()

    def start(self) -> None:
        node_id = self._session.selection[0]
        natural = mapping_in_force(self._session.document, node_id).projection == "natural"
        if natural and find(self._session.document, node_id).children:
            raise Refusal(NATURAL)
        self._node_id = node_id
        if self._axes() is None:
            self._node_id = ""
            raise Refusal(NOWHERE)
        self.began.emit()
        self.said.emit(HINT)
        self.show_handles()

    def end(self) -> None:
        if self.active:
            self._node_id = ""
            self.said.emit("")
            self.ended.emit()
            self.show_handles()

    def session_changed(self, before: State, after: State) -> None:
        if self.active and after.selection != (self._node_id,):
            self.end()
        super().session_changed(before, after)

    def key(self, event: Any) -> bool:
        from PySide6.QtCore import Qt

        if super().key(event):
            return True
        if self.active and event.key() == Qt.Key.Key_Escape:
            self.end()
            return True
        return False

    def _axes(self) -> tuple[NDArray[np.float64], TextureMapping] | None:
        """(3, 4) from the node's axes to the world's where it stands first, and its mapping."""
        document = self._session.document
        resolved = self._resolver.resolve(document)
        places = places_of(resolved.standing, [self._node_id]).get(self._node_id)
        return (places[0].matrix, mapping_in_force(document, self._node_id)) if places else None

    def handles(self, viewer: Viewer) -> tuple[Handle, ...]:
        found = self._axes() if self.active else None
        if found is None:
            return ()
        import numpy as np

        from ....model.surface.mapping import rotation_of
        from ....render.handles.gizmo import move_handles, turn_handles
        from ....render.handles.handle import Handle, Piece
        from ....render.handles.shapes import tube

        matrix, mapping = found
        origin = matrix[:, :3] @ np.array(mapping.origin) + matrix[:, 3]
        axes = (matrix[:, :3] @ rotation_of(mapping.turned)).T
        scales = np.linalg.norm(axes, axis=1, keepdims=True)
        axes = axes / np.where(scales > 0.0, scales, 1.0)
        handles = [*move_handles(origin, axes), *turn_handles(origin, axes)]
        if mapping.projection in ("planar", "box"):
            width, height = (abs(n * scale) for n, scale in zip(mapping.size, mapping.scale, strict=True))
            corners = np.array([(0, 0, 0), (width, 0, 0), (width, height, 0), (0, height, 0)]) * scales[0, 0]
            rim = Piece(tube(corners, 0.012 * max(width, height) * scales[0, 0], closed=True), opacity=0.85)
            nowhere = np.full((1, 3), np.nan)
            handles.append(Handle("copy", "plane", origin, axes, (rim,), nowhere, order=9, unit=1.0))
        return tuple(handles)

    def begin(self, viewer: Viewer, handle: Handle, x: float, y: float) -> Drag | None:
        found = self._axes()
        if found is None:
            return None
        return (self._turn if handle.name.startswith("turn") else self._move)(viewer, handle, x, y, *found)

    def _move(
        self, viewer: Viewer, handle: Handle, x: float, y: float, matrix: NDArray[np.float64], mapping: TextureMapping
    ) -> Drag | None:
        import numpy as np

        from ....render.handles.drag import pixel_length, step_for, stepped
        from .light_handles import moved_place

        start = moved_place(handle, viewer.camera, viewer.ray(x, y), handle.origin)
        if start is None or abs(np.linalg.det(matrix[:, :3])) < 1e-12:
            return None
        inverse = np.linalg.inv(matrix[:, :3])
        others = mapping_changes(self._session.document, self._node_id)

        def follow(x: float, y: float, fine: bool) -> tuple[dict[str, Any], str] | None:
            reached = moved_place(handle, viewer.camera, viewer.ray(x, y), handle.origin)
            if reached is None:
                return None
            step = step_for(pixel_length(viewer.camera, handle.origin, viewer.size), 4.0) * (0.1 if fine else 1.0)
            by = handle.axes.T @ np.array([stepped(float(one), step) for one in handle.axes @ (reached - start)])
            origin = tuple(round(float(one), 6) + 0.0 for one in np.array(mapping.origin) + inverse @ by)
            return others | {"origin": origin}, "Texture at " + ", ".join(f"{one:.6g}" for one in origin) + " mm"

        return Drag("Shift texture", "set_mapping", ([self._node_id],), follow)

    def _turn(
        self, viewer: Viewer, handle: Handle, x: float, y: float, matrix: NDArray[np.float64], mapping: TextureMapping
    ) -> Drag | None:
        import numpy as np

        from ....model.surface.mapping import rotation_of
        from ....render.handles.drag import grabbed_on_ring, ring_angle, stepped_angle, unwrapped

        axis = "xyz".index(handle.name[-1])
        about = handle.axes[axis]
        grabbed = grabbed_on_ring(viewer.camera, *viewer.ray(x, y), handle.origin, about)
        if grabbed is None:
            return None
        sense = 1.0 if np.linalg.det(matrix[:, :3]) > 0.0 else -1.0
        rotation, last = rotation_of(mapping.turned), 0.0
        others = mapping_changes(self._session.document, self._node_id)

        def follow(x: float, y: float, fine: bool) -> tuple[dict[str, Any], str] | None:
            nonlocal last
            angle = ring_angle(viewer.camera, viewer.size, (x, y), handle.origin, about, grabbed)
            if angle is None:
                return None
            last = unwrapped(angle, last)
            degrees = stepped_angle(last, fine)
            own = [0.0, 0.0, 0.0]
            own[axis] = sense * degrees
            turned = tuple(round(part, 6) + 0.0 for part in turned_of(rotation @ rotation_of(tuple(own))))
            return others | {"turned": turned}, f"Texture turned by {degrees:g}° about its {handle.name[-1]} axis"

        return Drag("Turn texture", "set_mapping", ([self._node_id],), follow)


def turned_of(rotation: NDArray[np.float64]) -> tuple[float, float, float]:
    """Degrees about x, then y, then z that make up a rotation (3, 3); about x none where y is at 90 degrees."""
    from math import asin, atan2, degrees, hypot

    r = rotation
    if hypot(r[2, 1], r[2, 2]) < 1e-9:
        x, y, z = 0.0, asin(max(min(-r[2, 0], 1.0), -1.0)), atan2(-r[0, 1], r[1, 1])
    else:
        x, y, z = atan2(r[2, 1], r[2, 2]), atan2(-r[2, 0], hypot(r[2, 1], r[2, 2])), atan2(r[1, 0], r[0, 0])
    return degrees(x), degrees(y), degrees(z)
