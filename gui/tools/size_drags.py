"""What the handles on sizes and planes do in a drag: from the pointer to a field's value."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ...model.document.errors import Refusal
from ...model.document.expression import Expression, Number
from ...model.document.nodes import Node
from ...model.document.placement import inverse, turn_about
from ...model.operations.sizing import PlaneHandle, SizeHandle, sized
from ...model.operations.steps import combined, tidy
from .entry import number_text
from .handle_drags import Call, Drag, Floats, Frame, Pointer, TurnDrag, steps_of

if TYPE_CHECKING:
    from ...render.viewer import Viewer


class SizeDrag(Drag):
    """One value of a node: a radius, a height, the side of a box."""

    def __init__(self, viewer: Viewer, node: Node, handle: SizeHandle, matrix: Floats) -> None:
        """`node` is the document's, `matrix` (3, 4) maps its own axes to the world's."""
        super().__init__(viewer)
        self._node, self._handle = node, handle
        self.names = (handle.name,)
        self.label = f"Change {handle.name}"
        self.numbers = [handle.value]
        self._point = matrix @ (*handle.point, 1.0)
        along = matrix[:, :3] @ handle.direction
        self._length = max(float(np.linalg.norm(along)), 1e-12)  # millimetres in the world of one of the node's own
        self._along_world = along / self._length
        self._start = 0.0

    def begin(self, x: float, y: float) -> None:
        self._start = self._along(x, y, self._point, self._along_world) or 0.0

    def follow(self, pointer: Pointer) -> None:
        handle = self._handle
        if pointer.target is not None:
            distance, step = float((pointer.target - self._point) @ self._along_world), None
        else:
            place = self._along(pointer.x, pointer.y, self._point, self._along_world)
            if place is None:
                return
            distance, step = place - self._start, self._step(pointer, self._point, self._length)
        value = handle.value_at(distance / self._length)
        value = tidy(round(value, 9)) if step is None else steps_of(value, step)
        least = handle.least + (step or 1e-3) if handle.above else handle.least
        self.numbers = [max(value, least)]

    def call(self) -> Call | None:
        (value,) = self.numbers
        if value == self._handle.value:
            return None
        arguments = sized(self._node, self._handle, value, self.resolve(value))
        return "set_fields", (self._node.id,), arguments

    def words(self) -> str:
        unit = "" if isinstance(self.numbers[0], Expression) else " mm"
        return f"{self._handle.name} {number_text(self.numbers[0])}{unit}"


class PlaneDrag(Drag):
    """Shifts a plane of a node along its normal."""

    names = ("distance",)
    label = "Shift plane"

    def __init__(self, viewer: Viewer, node: Node, plane: PlaneHandle, matrix: Floats, centre: Floats) -> None:
        """`centre` (3,) is a point on the plane in the world, where the handle stands."""
        super().__init__(viewer)
        self._node, self._plane, self._matrix, self._centre = node, plane, matrix, centre
        self.normal = world_normal(plane, matrix)
        self.numbers = [0.0]
        self._start = 0.0

    def begin(self, x: float, y: float) -> None:
        self._start = self._along(x, y, self._centre, self.normal) or 0.0

    def follow(self, pointer: Pointer) -> None:
        if pointer.target is not None:
            self.numbers = [tidy(round(float((pointer.target - self._centre) @ self.normal), 9))]
            return
        place = self._along(pointer.x, pointer.y, self._centre, self.normal)
        if place is not None:
            self.numbers = [steps_of(place - self._start, self._step(pointer, self._centre))]

    def call(self) -> Call | None:
        (distance,) = self.numbers
        if distance == 0.0:
            return None
        own = inverse(self._matrix)[:, :3] @ self.normal
        old = getattr(self._node, "point")  # noqa: B009  (half-spaces and mirrors have one)
        by = combined(np.diag(own), (distance, distance, distance))
        point = tuple(a if b == 0.0 else b if a == 0.0 else a + b for a, b in zip(old, by, strict=True))
        return "set_fields", (self._node.id,), {"point": tuple(_rounded(c) for c in point)}

    def words(self) -> str:
        return f"{number_text(self.numbers[0])} mm"


class TiltDrag(TurnDrag):
    """Turns a plane of a node about a line in it."""

    names = ("angle",)
    label = "Tilt plane"

    def __init__(
        self, viewer: Viewer, node: Node, plane: PlaneHandle, matrix: Floats, centre: Floats, axis: Floats
    ) -> None:
        """`axis` (3,) is the line's unit direction in the world; it goes through `centre` (3,)."""
        frame = Frame((node.id,), centre, np.array([axis, axis, axis]), True, False, True)
        super().__init__(viewer, frame, 0)
        self._node, self._plane, self._matrix, self._centre = node, plane, matrix, centre
        self.numbers = [0.0]

    def call(self) -> Call | None:
        (angle,) = self.numbers
        if isinstance(angle, Expression):
            raise Refusal("a plane is tilted by a number; an expression can be put into its normal in the properties")
        if angle == 0.0:
            return None
        axis = tuple(map(float, self._frame.axes[0]))
        turned = turn_about(axis, angle)[:, :3] @ world_normal(self._plane, self._matrix)
        normal = self._matrix[:, :3].T @ turned
        normal = normal / np.abs(normal).max() if np.count_nonzero(np.abs(normal) > 1e-9) == 1 else normal
        more: dict[str, Any] = {"normal": tuple(_rounded(float(c)) for c in normal)}
        point = inverse(self._matrix) @ np.append(self._centre, 1.0)
        if np.abs(point - self._plane.point).max() > 1e-9:
            more["point"] = tuple(_rounded(float(c)) for c in point)
        return "set_fields", (self._node.id,), more


def world_normal(plane: PlaneHandle, matrix: Floats) -> Floats:
    """The unit normal (3,) in the world: planes go with the inverse transpose."""
    normal = inverse(matrix)[:, :3].T @ plane.normal
    return normal / np.linalg.norm(normal)


def _rounded(value: Number) -> Number:
    return value if isinstance(value, Expression) else round(value, 9) + 0.0
