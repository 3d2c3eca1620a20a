"""What can be dragged on a node to change its size: one table from kinds to handles."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..document.expression import Expression, Number
from ..document.from_outlines import Extrude
from ..document.nodes import LinearArray, Mirror, Node, field_specs
from ..document.outlines import Circle, Polygon, Rectangle
from ..document.placement import unit
from ..document.primitives import Box, Cone, Cylinder, Halfspace, Sphere, Torus

Vector = tuple[float, float, float]

AHEAD = np.eye(3)


@dataclass(frozen=True, slots=True)
class SizeHandle:
    """One value of a node, at a place on its surface.

    `point` and `direction` (unit) lie in the node's own axes. Where the handle is dragged by a millimetre along its
    direction the value grows by `gain`, and the node moves by `shift` along the direction, so that its far side stays.
    """

    name: str
    field: str
    point: Vector
    direction: Vector
    value: float
    component: int | None = None
    gain: float = 1.0
    shift: float = 0.0
    least: float = 0.0
    above: bool = True
    """Whether the least value itself is refused."""
    along: Vector | None = None
    """For a vector that is lengthened as a whole: its direction."""

    def value_at(self, distance: float) -> float:
        return self.value + self.gain * distance

    def distance_to(self, value: float) -> float:
        """How far the handle stands from where it is when the value is this one."""
        return (value - self.value) / self.gain


@dataclass(frozen=True, slots=True)
class PlaneHandle:
    """A plane of a node, in its own axes: `normal` is unit, `point` as its fields have it."""

    point: Vector
    normal: Vector


def size_handles(node: Node) -> tuple[SizeHandle, ...]:
    """The handles of a resolved node; none for kinds without a size of their own."""
    make = _TABLE.get(type(node))
    return () if make is None else tuple(make(node))


def plane_handle(node: Node) -> PlaneHandle | None:
    """The plane of a resolved half-space or mirror, None for other kinds."""
    if not isinstance(node, Halfspace | Mirror):
        return None
    return PlaneHandle(_vector(node.point), _vector(unit(node.normal, "the normal")))


def field_of(node: Node, handle: SizeHandle) -> Number:
    """What stands in the handle's field: a number, or an expression that a drag must not write over."""
    value = getattr(node, handle.field)
    if handle.component is not None:
        return value[handle.component]
    if handle.along is not None:
        return next((c for c in value if isinstance(c, Expression)), handle.value)
    return value


def sized(node: Node, handle: SizeHandle, value: Number, number: float) -> dict[str, Any]:
    """What `set_fields` takes, after the node's id, to give the handle's field a value; `number` is what that is now.

    The other components of a vector stay as they stand in `node`, the node of the document.
    """
    given: Any = value
    if handle.component is not None:
        old = getattr(node, handle.field)
        given = (*old[: handle.component], value, *old[handle.component + 1 :])
    elif handle.along is not None:
        given = tuple(value * c if c else 0.0 for c in handle.along)
    result = {handle.field: given}
    if handle.shift:
        by = round(handle.shift * handle.distance_to(number), 12)
        result["shift"] = tuple(by * c + 0.0 for c in handle.direction)
    return result


def _vector(values: Any) -> Vector:
    x, y, z = (float(value) + 0.0 for value in values)
    return x, y, z


def _handle(node: Node, name: str, field: str, point: Any, direction: Any, value: Number, **more: Any) -> SizeHandle:
    spec = next(spec for spec in field_specs(type(node)) if spec.name == field)
    least, above = (-np.inf, False) if spec.minimum is None else (spec.minimum, spec.above)
    return SizeHandle(
        name,
        field,
        _vector(point),
        _vector(direction),
        float(value),
        least=least,
        above=above,
        **more,  # type: ignore[arg-type]
    )


def _box(node: Box) -> list[SizeHandle]:
    size = np.array(node.size, dtype=np.float64)
    low = -size / 2 if node.centred else np.zeros(3)
    middle = low + size / 2
    handles = []
    for axis in range(3):
        for side in (1.0, -1.0):
            point = middle + side * size[axis] / 2 * AHEAD[axis]
            follows = {"gain": 2.0} if node.centred else {"shift": 1.0 if side < 0 else 0.0}
            name = f"size {'xyz'[axis]}"
            handles.append(
                _handle(node, name, "size", point, side * AHEAD[axis], size[axis], component=axis, **follows)
            )
    return handles


def _round(node: Node, field: str, name: str, radius: float, height: float) -> list[SizeHandle]:
    """Handles of a radius on the sides where the arrows of the axes do not stand."""
    return [
        _handle(node, name, field, -radius * AHEAD[axis] + height * AHEAD[2], -AHEAD[axis], radius) for axis in (0, 1)
    ]


def _sphere(node: Sphere) -> list[SizeHandle]:
    radius = float(node.radius)  # type: ignore[arg-type]
    return [_handle(node, "radius", "radius", -radius * axis, -axis, radius) for axis in AHEAD]


def _heights(node: Cylinder | Cone | Extrude, x: float = 0.0, y: float = 0.0) -> list[SizeHandle]:
    height = float(node.height)  # type: ignore[arg-type]
    if not node.centred:
        return [_handle(node, "height", "height", (x, y, height), AHEAD[2], height)]
    return [
        _handle(node, "height", "height", (x, y, side * height / 2), side * AHEAD[2], height, gain=2.0)
        for side in (1.0, -1.0)
    ]


def _foot_and_top(node: Cylinder | Cone) -> tuple[float, float]:
    height = float(node.height)  # type: ignore[arg-type]
    return (-height / 2, height / 2) if node.centred else (0.0, height)


def _cylinder(node: Cylinder) -> list[SizeHandle]:
    radius = float(node.radius)  # type: ignore[arg-type]
    return [*_round(node, "radius", "radius", radius, sum(_foot_and_top(node)) / 2), *_heights(node)]


def _cone(node: Cone) -> list[SizeHandle]:
    foot, top = _foot_and_top(node)
    return [
        *_round(node, "radius", "radius", float(node.radius), foot),  # type: ignore[arg-type]
        *_round(node, "top_radius", "top radius", float(node.top_radius), top),  # type: ignore[arg-type]
        *_heights(node),
    ]


def _torus(node: Torus) -> list[SizeHandle]:
    radius, tube = float(node.radius), float(node.tube_radius)  # type: ignore[arg-type]
    handles = []
    for axis in AHEAD[:2]:
        handles.append(_handle(node, "radius", "radius", -(radius + tube) * axis, -axis, radius))
        handles.append(_handle(node, "tube radius", "tube_radius", -radius * axis + tube * AHEAD[2], AHEAD[2], tube))
    return handles


def _rectangle(node: Rectangle) -> list[SizeHandle]:
    size = np.array((node.width, node.height), dtype=np.float64)
    low = -size / 2 if node.centred else np.zeros(2)
    handles = []
    for axis, field in enumerate(("width", "height")):
        for side in (1.0, -1.0):
            point = low + size / 2
            point[axis] += side * size[axis] / 2
            follows = {"gain": 2.0} if node.centred else {"shift": 1.0 if side < 0 else 0.0}
            handles.append(_handle(node, field, field, (*point, 0.0), side * AHEAD[axis], size[axis], **follows))
    return handles


def _circle(node: Circle) -> list[SizeHandle]:
    return _round(node, "radius", "radius", float(node.radius), 0.0)  # type: ignore[arg-type]


def _extrude(node: Extrude) -> list[SizeHandle]:
    x, y = _middle(node.children[0])
    return _heights(node, x, y)


def _middle(outline: Node) -> NDArray[np.float64]:
    """(2,) a point in the middle of an outline, in its parent's axes."""
    own = np.zeros(3)
    if isinstance(outline, Rectangle) and not outline.centred:
        own[:2] = np.array((outline.width, outline.height), dtype=np.float64) / 2
    elif isinstance(outline, Polygon) and outline.points:
        corners = np.array(outline.points, dtype=np.float64)
        own[:2] = (corners.min(axis=0) + corners.max(axis=0)) / 2
    return (outline.placement.matrix() @ np.append(own, 1.0))[:2]


def _linear_array(node: LinearArray) -> list[SizeHandle]:
    step = np.array(node.step, dtype=np.float64)
    length = float(np.linalg.norm(step))
    if length == 0.0:
        return []
    along = _vector(step / length)
    return [_handle(node, "step", "step", step, along, length, along=along)]


_TABLE: dict[type[Node], Callable[[Any], list[SizeHandle]]] = {
    Box: _box,
    Sphere: _sphere,
    Cylinder: _cylinder,
    Cone: _cone,
    Torus: _torus,
    Rectangle: _rectangle,
    Circle: _circle,
    Extrude: _extrude,
    LinearArray: _linear_array,
}
