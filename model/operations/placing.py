"""Operations on where nodes stand: move, turn, scale, and placement step by step.

They keep placements readable: a step joins the one before it where that is the same map, a turn or a scaling goes
before the move that is the node's position, and steps that hold expressions stay as they are.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from ..document.document import Document, parameter_values
from ..document.errors import Refusal
from ..document.expression import Expression, Number, number, symbolic, vector
from ..document.nodes import Node
from ..document.placement import IDENTITY, Placement, Scale, Step, Turn, inverse, turn_about, unit
from ..document.tree import change, change_each, find, outermost
from .parameters import declaring
from .steps import EXACT, Matrix, combined, followed, led, linear_step, shifted

AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


def place(document: Document, node_id: str, *steps: Step) -> Document:
    """Give a node these placement steps instead of its own."""
    placement = Placement(tuple(steps))
    node = find(document, node_id)
    if node.placement == placement:
        return document
    document = declaring(document, [step.numbers for step in steps])
    return change(document, node_id, lambda node: node.with_(placement=placement))


def move(
    document: Document,
    ids: Sequence[str],
    x: Number = 0.0,
    y: Number = 0.0,
    z: Number = 0.0,
    *,
    world: bool = False,
) -> Document:
    """Move nodes by millimetres, in their parent's axes, or with `world` in the world's (see `outer_maps`)."""
    by = vector((x, y, z), "move")
    document = declaring(document, by)
    ids = outermost(document, ids)
    outer = outer_maps(document, ids) if world else {}

    def moved(node: Node) -> Node:
        own = by if not world else combined(inverse(outer[node.id])[:, :3], by)
        return _placed(node, shifted(node.placement, own))

    return change_each(document, ids, moved)


def turn(
    document: Document,
    ids: Sequence[str],
    axis: str | Sequence[float] = "z",
    angle: Number = 0.0,
    point: Sequence[float] | None = None,
    *,
    world: bool = False,
    local: bool = False,
) -> Document:
    """Turn nodes by degrees about the line along `axis` (x, y, z, or three numbers) through `point`.

    Without a point each turns about its own origin. Axis and point are the parent's, with `world` the world's, with
    `local` the axis is the node's own. Raises Refusal for an expression as angle about any axis but x, y and z.
    """
    direction = _axis(axis)
    angle = number(angle, "angle")
    document = declaring(document, angle)
    main = next((i for i, name in enumerate(AXES) if AXES[name] == direction), None)
    values = parameter_values(document.parameters)[0]

    def steps(node: Node, outer: Matrix) -> Step | None:
        if isinstance(angle, Expression):
            along = main if not local else _own_axis(node, direction, values)
            if along is None or not np.array_equal(outer[:, :3], np.eye(3)):
                raise Refusal("an expression turns about x, y or z of the parent only; type a number")
            return Turn(tuple(angle if i == along else 0.0 for i in range(3)))
        if local:
            own = node.placement.resolve(values).matrix()[:, :3] @ np.array(direction)
            return linear_step(turn_about(tuple(own), angle)[:, :3])
        if main is not None and np.array_equal(outer[:, :3], np.eye(3)):
            return Turn(tuple(angle if i == main else 0.0 for i in range(3)))
        inner = inverse(outer)[:, :3]
        return linear_step(inner @ turn_about(direction, angle)[:, :3] @ outer[:, :3])

    return _mapped(document, ids, steps, point, world, values)


def scale(
    document: Document,
    ids: Sequence[str],
    x: Number = 1.0,
    y: Number | None = None,
    z: Number | None = None,
    point: Sequence[float] | None = None,
    *,
    world: bool = False,
    local: bool = False,
) -> Document:
    """Scale nodes by one factor, or by one for each axis, about `point`; without a point each about its own origin.

    Axes and point are the parent's, with `world` the world's; with `local` the axes are the node's own. Raises Refusal
    for a factor of 0.
    """
    rest = x if y is None and z is None else 1.0
    factors = vector((x, rest if y is None else y, rest if z is None else z), "scale")
    document = declaring(document, factors)
    if 0.0 in factors:
        raise Refusal("a scale factor is 0: the solid would be flat")
    values = parameter_values(document.parameters)[0]
    if local:
        if point is not None:
            raise Refusal("a scaling along a node's own axes goes about its own origin")
        return change_each(
            document,
            outermost(document, ids),
            lambda node: _placed(node, Placement(tuple(led(node.placement.steps, Scale(factors))))),
        )

    def steps(node: Node, outer: Matrix) -> Step | None:
        if symbolic(factors):
            if not np.array_equal(outer[:, :3], np.eye(3)):
                raise Refusal("an expression scales along the axes of the parent only; type a number")
            return Scale(factors)
        linear = np.diag(np.array(factors, dtype=np.float64))
        return linear_step(inverse(outer)[:, :3] @ linear @ outer[:, :3])

    return _mapped(document, ids, steps, point, world, values)


def outer_maps(document: Document, ids: Sequence[str]) -> dict[str, Matrix]:
    """(3, 4) from the parent's axes to the world's, of the first place where each node stands. Raises Refusal."""
    from ..document.resolve import resolve
    from ..solid.places import places_of

    places = places_of(resolve(document).solids, ids)
    for node_id in ids:
        if node_id not in places:
            raise Refusal(f"“{find(document, node_id).label}” stands in no solid: it has no place in the world")
    return {node_id: places[node_id][0].outer for node_id in ids}


def shifted_within(document: Document, placement: Placement, shift: Sequence[float]) -> Placement:
    """The placement with a move before it, by `shift` along its own axes, as a move after it."""
    own = tuple(_plain(c) for c in vector(shift, "shift"))
    values = parameter_values(document.parameters)[0]
    return shifted(placement, combined(placement.resolve(values).matrix()[:, :3], own))


def _mapped(
    document: Document,
    ids: Sequence[str],
    step_of: Callable[[Node, Matrix], Step | None],
    point: Sequence[float] | None,
    world: bool,
    values: Mapping[str, float],
) -> Document:
    """Let each node's placement be followed by what `step_of(node, outer map)` gives."""
    ids = outermost(document, ids)
    outer = outer_maps(document, ids) if world else {}
    centre = None if point is None else tuple(_plain(c) for c in vector(point, "point"))

    def mapped(node: Node) -> Node:
        axes = outer.get(node.id, IDENTITY)
        step = step_of(node, axes)
        if step is None:
            return node
        about = centre if centre is None or not world else tuple(inverse(axes) @ np.append(centre, 1.0))
        return _placed(node, followed(node.placement, step, about, values))

    return change_each(document, ids, mapped)


def _placed(node: Node, placement: Placement) -> Node:
    return node if placement == node.placement else node.with_(placement=placement)


def _own_axis(node: Node, direction: tuple[float, ...], values: Mapping[str, float]) -> int | None:
    """Which of the parent's axes the node's own axis lies along, None for none."""
    own = unit(tuple(node.placement.resolve(values).matrix()[:, :3] @ np.array(direction)), "the axis")
    along = np.flatnonzero(np.abs(own - 1.0) <= EXACT)
    return int(along[0]) if len(along) else None


def _axis(axis: str | Sequence[float]) -> tuple[float, ...]:
    if isinstance(axis, str):
        if axis not in AXES:
            raise Refusal(f"an axis is x, y, z or three numbers, not {axis!r:.60}")
        return AXES[axis]
    direction = tuple(_plain(c) for c in vector(axis, "axis"))
    unit(direction, "the axis")
    return direction


def _plain(value: Number) -> float:
    if isinstance(value, Expression):
        raise Refusal(f"a number is needed here, not “{value.text}”")
    return value
