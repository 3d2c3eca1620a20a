"""What may stand where in a tree, and how a node keeps its place in space on its way to another one."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ..document.document import Document
from ..document.errors import Refusal
from ..document.nodes import Mirror, Node
from ..document.placement import Move, Placement, Reflect, Step
from ..document.primitives import OUTLINES, Extrude, Revolve
from ..document.tree import unique_name


def solid_name(document: Document, wanted: str) -> str:
    return unique_name(wanted, [root.name for root in document.solids])


def check_free(document: Document, ids: Iterable[str]) -> None:
    """A definition's root stays where it is, because instances refer to it."""
    roots = {root.id: root for root in document.definitions}
    for node_id in ids:
        if node_id in roots:
            raise Refusal(f"“{roots[node_id].label}” is a definition; unlink an instance to work on a copy")


def check_fit(above: Node | None, child: Node) -> None:
    """Outlines stand under what makes solids of them, and nowhere else."""
    makes = isinstance(above, Extrude | Revolve)
    if isinstance(child, OUTLINES):
        if not makes:
            raise Refusal(f"“{child.label}” is an outline, which is flat: extrude or revolve it")
    elif makes:
        raise Refusal(f"“{above.label}” takes an outline, and “{child.label}” is none")


def steps_of(node: Node) -> tuple[Step, ...]:
    """What a node does to the place of its operand, or of the first copy of it."""
    if isinstance(node, Mirror) and not node.keep:
        there, back = Move(node.point), Move(node.point).inverse()
        return (*back, Reflect(node.normal), there, *node.placement.steps)
    return node.placement.steps


def steps_above(way: Sequence[Node]) -> list[Step]:
    """What the nodes from the root down do to the place of an operand of the last one, in order."""
    return [step for above in reversed(way) for step in steps_of(above)]


def then(placement: Placement, steps: Iterable[Step]) -> Placement:
    for step in steps:
        placement = placement.then(step)
    return placement


def carried(document: Document, way: tuple[Node, ...], new_way: tuple[Node, ...]) -> Node:
    """The last node of `way` with the placement that keeps it in its place in space below `new_way`; both are the nodes
    from the root down."""
    *old_way, node = way
    shared = 0
    while shared < min(len(old_way), len(new_way)) and old_way[shared] is new_way[shared]:
        shared += 1
    homes = {(way[0] if way else None) for way in (old_way, new_way)}
    if len(homes) > 1 and any(root is home for root in document.definitions for home in homes):
        return node  # a definition has no one place in space
    out, back = steps_above(old_way[shared:]), steps_above(new_way[shared:])
    placement = then(node.placement, [*out, *(undo for step in reversed(back) for undo in step.inverse())])
    return node if placement is node.placement else node.with_(placement=placement)


def named_apart(document: Document, nodes: Iterable[Node]) -> list[Node]:
    """The nodes as solids of the document, with names unlike those of its solids and of each other."""
    taken = {root.name for root in document.solids}
    named: list[Node] = []
    for node in nodes:
        name = unique_name(node.label, taken)
        taken.add(name)
        named.append(node if node.name == name else node.with_(name=name))
    return named
