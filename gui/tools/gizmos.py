"""Which handles the selected nodes have, where they stand, and the drag that each of them begins."""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ...model.document.document import Document
from ...model.document.errors import Refusal
from ...model.document.expression import Expression, symbolic
from ...model.document.nodes import Node
from ...model.document.primitives import Halfspace
from ...model.document.resolve import Resolver
from ...model.document.tree import find, outermost
from ...model.operations.sizing import PlaneHandle, SizeHandle, field_of, plane_handle, size_handles
from ...model.solid.places import Place, places_of
from ...render.camera import project
from ...render.handles import gizmo
from ...render.handles.handle import Handle
from .handle_drags import Drag, Frame, MoveDrag, ScaleDrag, TurnDrag
from .size_drags import PlaneDrag, SizeDrag, TiltDrag, world_normal

if TYPE_CHECKING:
    from ...model.editing.session import State
    from ...render.viewer import Viewer

Floats = NDArray[np.float64]

MOST = 64  # selected nodes that have handles
ROOM = 1.2  # the side of a plane's square, beside the diagonal of what is shown
ALONE = 60.0  # millimetres: that side where nothing is shown


class Gizmos:
    """Keeps what it made for one document and selection; places come from a resolver of its own."""

    def __init__(self, viewer: Viewer, half_spaces_seen: Callable[[], bool] = lambda: False) -> None:
        """`half_spaces_seen` tells whether somebody else draws the planes of selected half-spaces."""
        self._viewer = viewer
        self._half_spaces_seen = half_spaces_seen
        self._resolver = Resolver()
        self._key: tuple[object, ...] = ()
        self._handles: tuple[Handle, ...] = ()
        self._drags: dict[str, Callable[[], Drag]] = {}
        self._words: dict[str, str] = {}
        self._frame: Frame | None = None
        self._square: tuple[str, float, Floats] | None = None
        self.ids: Collection[str] = ()
        """The nodes that are dragged."""

    def handles(self, state: State, mode: str, local: bool, dragging: bool) -> tuple[Handle, ...]:
        """The handles of the selected nodes in a mode of the tool; () where there is nothing to hold."""
        scene = None if dragging else self._bounds_key()
        key = (state.document, state.selection, mode, local, scene, self._half_spaces_seen())
        if self._key and key[0] is self._key[0] and key[1:] == self._key[1:]:
            return self._handles
        self._key = key
        self._make(state.document, state.selection, mode, local, dragging)
        return self._handles

    def drag(self, name: str) -> Drag:
        """What a handle begins. Raises Refusal for one whose value is an expression."""
        return self._drags[name]()

    def typed_drag(self, mode: str) -> Drag | None:
        """The drag without a pointer of a mode; None where nothing can be moved."""
        frame = self._frame
        if frame is None:
            return None
        match mode:
            case "turn":
                return TurnDrag(self._viewer, frame, 2)
            case "scale":
                return ScaleDrag(self._viewer, frame, None)
        return MoveDrag(self._viewer, frame, (0, 1, 2))

    def words(self, name: str) -> str:
        """What is said of a handle under the pointer."""
        return self._words.get(name, "")

    def snaps(self, name: str) -> bool:
        """Whether dragging this handle snaps to geometry."""
        return name.startswith(("move", "size")) or name == "plane"

    def pixel(self) -> tuple[float, float]:
        """Where the handles' middle stands in the picture."""
        if self._frame is None:
            return 0.0, 0.0
        x, y, _ = project(self._viewer.camera, [self._frame.origin], self._viewer.size)[0]
        return (float(x), float(y)) if np.isfinite((x, y)).all() else (0.0, 0.0)

    def _bounds_key(self) -> object:
        bounds = self._viewer.scene.visible_bounds()
        return None if bounds is None else tuple(bounds.ravel().tolist())

    def _make(self, document: Document, selection: tuple[str, ...], mode: str, local: bool, dragging: bool) -> None:
        self._handles, self._drags, self._words, self._frame, self.ids = (), {}, {}, None, ()
        if not selection or len(selection) > MOST:
            return
        ids = outermost(document, selection)
        places = places_of(self._resolver.resolve(document).standing, ids)
        if len(places) != len(ids):
            return
        firsts = [places[node_id][0] for node_id in ids]
        try:
            self._frame = frame = _frame(tuple(ids), firsts, local or (mode == "scale" and len(ids) == 1))
        except (Refusal, np.linalg.LinAlgError):
            return  # flattened: there is nothing to hold
        self.ids = ids
        made: list[Handle] = []
        alone = firsts[0] if len(firsts) == 1 else None
        plane = None if alone is None else plane_handle(alone.node)
        if mode == "move" or (mode == "" and plane is None):
            made += self._moves(frame)
        elif mode == "turn":
            made += self._turns(frame)
        elif mode == "scale":
            made += self._scales(frame)
        if alone is not None and mode in ("", "size"):
            node = find(document, ids[0])
            made += self._sizes(node, alone)
            if plane is not None:
                made += self._plane(node, alone, plane, dragging)
        self._handles = tuple(made)

    def _moves(self, frame: Frame) -> tuple[Handle, ...]:
        viewer = self._viewer
        self._drags["move"] = lambda: MoveDrag(viewer, frame, (0, 1, 2))
        for name in ("x", "y", "z", "xy", "xz", "yz"):
            axes = tuple("xyz".index(letter) for letter in name)
            self._drags[f"move {name}"] = lambda axes=axes: MoveDrag(viewer, frame, axes)
        return gizmo.move_handles(frame.origin, frame.axes)

    def _turns(self, frame: Frame) -> tuple[Handle, ...]:
        for axis, name in enumerate("xyz"):
            self._drags[f"turn {name}"] = lambda axis=axis: TurnDrag(self._viewer, frame, axis)
        return gizmo.turn_handles(frame.origin, frame.axes)

    def _scales(self, frame: Frame) -> tuple[Handle, ...]:
        self._drags["scale"] = lambda: ScaleDrag(self._viewer, frame, None)
        for axis, name in enumerate("xyz"):
            self._drags[f"scale {name}"] = lambda axis=axis: ScaleDrag(self._viewer, frame, axis)
        return gizmo.scale_handles(frame.origin, frame.axes)

    def _sizes(self, node: Node, place: Place) -> list[Handle]:
        made = []
        for i, handle in enumerate(size_handles(place.node)):
            name = f"size {i}"
            stands = field_of(node, handle)
            locked = isinstance(stands, Expression)
            along = place.matrix[:, :3] @ handle.direction
            along /= np.linalg.norm(along)
            made.append(gizmo.size_handle(name, place.matrix @ (*handle.point, 1.0), along, locked))
            value = f"= {stands.text}" if isinstance(stands, Expression) else f"{handle.value:.6g} mm"
            self._words[name] = f"{handle.name} {value}"
            self._drags[name] = lambda handle=handle: self._size_drag(node, handle, place)
        return made

    def _size_drag(self, node: Node, handle: SizeHandle, place: Place) -> Drag:
        _check(handle.name, field_of(node, handle))
        return SizeDrag(self._viewer, node, handle, place.matrix)

    def _plane(self, node: Node, place: Place, plane: PlaneHandle, dragging: bool) -> tuple[Handle, ...]:
        point, matrix = getattr(node, "point"), place.matrix  # noqa: B009  (all nodes with a plane have one)
        normal = world_normal(plane, matrix)
        on_plane = matrix @ (*plane.point, 1.0)
        side, middle = self._square_of(node.id, str(place.path[0]), on_plane, dragging)
        centre = middle - normal * float(normal @ (middle - on_plane))
        self._drags["plane"] = lambda: self._plane_drag(node, plane, matrix, centre)
        rows = gizmo.plane_axes(normal)
        for word, axis in zip("uv", rows, strict=False):
            self._drags[f"plane tilt {word}"] = lambda axis=axis: self._tilt_drag(node, plane, matrix, centre, axis)
        self._words["plane"] = "shift the plane"
        self._words["plane tilt u"] = self._words["plane tilt v"] = "tilt the plane"
        locked = (symbolic(point), symbolic(point) or symbolic(getattr(node, "normal")))  # noqa: B009
        seen = isinstance(node, Halfspace) and self._half_spaces_seen()
        return gizmo.plane_handles("plane", centre, normal, None if seen else side, locked)

    def _square_of(self, node_id: str, root_id: str, point: Floats, dragging: bool) -> tuple[float, Floats]:
        """The side of a plane's square and the place that it is near to, those of its solid: of the drag's begin while
        that lasts."""
        if self._square is None or self._square[0] != node_id or not dragging:
            mesh = self._viewer.scene.meshes.get(root_id)
            bounds = self._viewer.scene.visible_bounds() if mesh is None else np.reshape(mesh.bounds, (2, 3))
            side = ALONE if bounds is None else ROOM * float(np.linalg.norm(np.ptp(bounds, axis=0)))
            self._square = (node_id, side, point if bounds is None else bounds.mean(axis=0))
        return self._square[1], self._square[2]

    def _plane_drag(self, node: Node, plane: PlaneHandle, matrix: Floats, centre: Floats) -> Drag:
        for value in getattr(node, "point"):  # noqa: B009
            _check("point", value)
        return PlaneDrag(self._viewer, node, plane, matrix, centre)

    def _tilt_drag(self, node: Node, plane: PlaneHandle, matrix: Floats, centre: Floats, axis: Floats) -> Drag:
        for name in ("normal", "point"):
            for value in getattr(node, name):
                _check(name, value)
        return TiltDrag(self._viewer, node, plane, matrix, centre, axis)


def _frame(ids: tuple[str, ...], places: list[Place], local: bool) -> Frame:
    """Of one node about its own origin, of several about their middle. Raises Refusal or LinAlgError."""
    origins = np.array([place.matrix[:, 3] for place in places])
    plain = all(np.array_equal(place.outer, np.eye(3, 4)) for place in places)
    rows = np.eye(3)
    if local:
        columns = places[0].matrix[:, :3]
        if abs(np.linalg.det(columns)) < 1e-300:
            raise Refusal("the node is flat")
        rows = (columns / np.linalg.norm(columns, axis=0)).T
        if np.abs(rows @ rows.T - np.eye(3)).max() > 1e-9:  # sheared: the rotation that is nearest
            u, _, v = np.linalg.svd(rows)
            rows = u @ v
        rows = np.where(np.abs(rows) < 1e-15, 0.0, rows)
    mirrored = bool(np.linalg.det(places[0].outer[:, :3]) < 0)
    return Frame(ids, origins.mean(axis=0), rows, plain, local, len(places) == 1, mirrored)


def _check(name: str, value: object) -> None:
    if isinstance(value, Expression):
        raise Refusal(f"{name} is `{value.text}`: change it in the properties")
