"""Operations on motions: parameters that go from one value to another in time, and nodes that follow them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..document.document import Document
from ..document.errors import Refusal
from ..document.expression import Expression, Number, number, vector
from ..document.nodes import Node
from ..document.placement import Move, Placement, Step, Turn
from ..document.tree import change_each, outermost
from ..proximity.motion import Motion
from .parameters import declaring, set_parameter
from .placing import AXES

FIELDS = ("parameter", "start", "end", "seconds", "steps")


def add_motion(document: Document, name: str, parameter: str, **more: Any) -> Document:
    """Let a parameter go from `start` (0) to `end` (1) in `seconds` (4), looked at in `steps` (50); one that is not in
    the document is made."""
    _known(more)
    if any(motion.name == name for motion in document.motions):
        raise Refusal(f"there is a motion called “{name}” already")
    motion = Motion(name, parameter, **more)
    return _driving(document, motion).with_(motions=(*document.motions, motion))


def set_motion(document: Document, name: str, **values: Any) -> Document:
    """Change some of a motion: `parameter`, `start`, `end`, `seconds`, `steps`."""
    _known(values)
    old = _called(document, name)
    new = old.with_(**values)
    if new == old:
        return document
    return _driving(document, new).with_(motions=tuple(new if one is old else one for one in document.motions))


def rename_motion(document: Document, name: str, new_name: str) -> Document:
    """Call a motion otherwise."""
    old = _called(document, name)
    if new_name == name:
        return document
    if any(motion.name == new_name for motion in document.motions):
        raise Refusal(f"there is a motion called “{new_name}” already")
    new = old.with_(name=new_name)
    return document.with_(motions=tuple(new if one is old else one for one in document.motions))


def delete_motion(document: Document, name: str) -> Document:
    """Take a motion out; its parameter stays."""
    old = _called(document, name)
    return document.with_(motions=tuple(one for one in document.motions if one is not old))


def set_in_motion(
    document: Document,
    ids: Sequence[str],
    name: str,
    by: Sequence[Number] = (0.0, 0.0, 0.0),
    turn: tuple[str, Number] | None = None,
) -> Document:
    """Let nodes go by `by`, millimetres in their parent's axes, and turn by `turn`, such as ("z", 90), about an axis
    through their own place, while the motion goes on.

    A motion that the document has not is made, with a parameter for it. The placements get expressions of the
    parameter, which are 0 where the motion starts now and all of it where it ends.
    """
    document = _with_motion(document, name)
    motion = _called(document, name)
    share = _share(motion)
    away = vector(by, "by")
    turned = _turn(turn)
    document = declaring(document, [*away, *(() if turned is None else turned[1:])])
    if not any(away) and turned is None:
        raise Refusal("say by how many millimetres the nodes go, or by how many degrees they turn")
    move = Move(tuple(_scaled(share, part) for part in away)) if any(away) else None

    def moving(node: Node) -> Node:
        steps: list[Step] = list(node.placement.steps)
        if turned is not None:
            # Before the move that is its position, so that it turns where it stands.
            place = len(steps) - 1 if steps and isinstance(steps[-1], Move) else len(steps)
            axis, degrees = turned
            steps.insert(place, Turn(tuple(_scaled(share, degrees) if k == axis else 0.0 for k in range(3))))
        if move is not None:
            steps.append(move)
        return node.with_(placement=Placement(tuple(steps)))

    return change_each(document, outermost(document, ids), moving)


def _with_motion(document: Document, name: str) -> Document:
    if any(motion.name == name for motion in document.motions):
        return document
    taken = {parameter.name for parameter in document.parameters}
    parameter = next(word for word in ("t", *(f"t{k}" for k in range(2, len(taken) + 3))) if word not in taken)
    return add_motion(document, name, parameter)


def _share(motion: Motion) -> Expression:
    """0 where the motion starts, 1 where it ends."""
    share: Expression = Expression(motion.parameter)
    if motion.start != 0.0:
        share = share - motion.start
    length = motion.end - motion.start
    return share if length == 1.0 else share / length


def _scaled(share: Expression, size: Number) -> Number:
    return 0.0 if size == 0.0 else share if size == 1.0 else share * size


def _turn(turn: tuple[str, Number] | None) -> tuple[int, Number] | None:
    """The number of the axis, and degrees."""
    if turn is None:
        return None
    try:
        axis, degrees = turn
    except (TypeError, ValueError):
        raise Refusal(f"a turn is an axis and degrees, such as ('z', 90), not {turn!r:.60}") from None
    if axis not in AXES:
        raise Refusal(f"an axis is x, y or z, not {axis!r:.60}")
    degrees = number(degrees, "the turn")
    return None if degrees == 0.0 else (int(np.argmax(AXES[axis])), degrees)


def _driving(document: Document, motion: Motion) -> Document:
    """With the motion's parameter, made where it is not there. Raises Refusal where it cannot have these values."""
    parameter = next((one for one in document.parameters if one.name == motion.parameter), None)
    if parameter is None:
        return set_parameter(document, motion.parameter, motion.start)
    for value in (motion.start, motion.end):
        fault = parameter.fault(value)
        if fault:
            raise Refusal(f"the motion “{motion.name}”: {fault}")
    if parameter.choices:
        raise Refusal(f"the motion “{motion.name}”: the parameter {parameter.name} has choices and cannot go evenly")
    return document


def _called(document: Document, name: str) -> Motion:
    for motion in document.motions:
        if motion.name == name:
            return motion
    raise Refusal(f"there is no motion called “{name}”")


def _known(values: dict[str, Any]) -> None:
    unknown = sorted(values.keys() - set(FIELDS))
    if unknown:
        raise Refusal(f"a motion has no {unknown[0]}")
