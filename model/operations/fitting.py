"""What may stand where in a tree, and how a node keeps its place in space on its way to another one."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ..document.document import Document
from ..document.errors import Refusal
from ..document.from_outlines import FROM_OUTLINES, Revolve
from ..document.nodes import Mirror, Node
from ..document.outlines import OF_OUTLINES, Outlines
from ..document.placement import Move, Placement, Reflect, Scale, Step, Turn
from ..document.tree import Names, unique_name, walk

STANDING_UP = Turn((90.0, 0.0, 0.0))
"""What a revolution does to its outline: x stays x, y becomes z."""


def root_name(document: Document, wanted: str, leaving: Iterable[str] = ()) -> str:
    """A name for a root, unlike those of all solids and profiles but the ones with the ids that leave."""
    gone = set(leaving)
    return unique_name(wanted, [root.name for root in document.standing if root.id not in gone])


def check_free(document: Document, ids: Iterable[str]) -> None:
    """A definition's root stays where it is, because instances refer to it."""
    roots = {root.id: root for root in document.definitions}
    for node_id in ids:
        if node_id in roots:
            raise Refusal(f"“{roots[node_id].label}” is a definition; unlink an instance to work on a copy")


def check_fit(above: Node | None, child: Node, flat: Outlines) -> None:
    """Outlines stand under what makes solids of them, in operations on outlines, or by themselves; an operation without
    operands takes solids. Raises Refusal."""
    if above is None:
        return
    if child in flat:
        if isinstance(above, FROM_OUTLINES) or above in flat:
            return
        raise Refusal(f"“{child.label}” is an outline, which is flat, and “{above.label}” takes solids: extrude it")
    if isinstance(above, FROM_OUTLINES) or above in flat:
        raise Refusal(f"“{above.label}” takes {'an outline' if above.operands == (1, 1) else 'outlines'}, and "
                      f"“{child.label}” is none")  # fmt: skip


def check_tree(root: Node, flat: Outlines) -> None:
    """`check_fit` for all that stands in a tree."""
    for node in walk(root):
        for child in node.children:
            check_fit(node, child, flat)


def check_left(ways: Iterable[Sequence[Node]], flat: Outlines, stays: Node | None = None) -> None:
    """Refuse to take all operands of an operation on outlines, which would then be none; `ways` lead from the roots
    to the nodes that go, `stays` is the operation that they go into."""
    leaving: dict[str, tuple[Node, int]] = {}
    for way in ways:
        above = way[-2] if len(way) > 1 else None
        if above is not None and above is not stays and isinstance(above, OF_OUTLINES):
            leaving[above.id] = (above, leaving.get(above.id, (above, 0))[1] + 1)
    for above, count in leaving.values():
        if count == len(above.children) and above in flat:
            raise Refusal(f"“{above.label}” joins outlines and cannot be without the last of them: take it out as well")


def steps_of(node: Node) -> tuple[Step, ...]:
    """What a node does to the place of its operand, or of the first copy of it."""
    if isinstance(node, Mirror) and not node.keep:
        there, back = Move(node.point), Move(node.point).inverse()
        return (*back, Reflect(node.normal), there, *node.placement.steps)
    if isinstance(node, Revolve):
        start = (Turn((0.0, 0.0, node.start)),) if node.start != 0.0 else ()
        return (STANDING_UP, *start, *node.placement.steps)
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


def carried_into(node: Node, above: Sequence[Step]) -> Node:
    """The node, placed in the world, with the placement that it needs below these steps; what cancels out is left
    out."""
    steps, above = list(node.placement.steps), list(above)
    while steps and above and steps[-1] == above[-1]:
        del steps[-1], above[-1]
    back = [undo for step in reversed(above) for undo in step.inverse()]
    return node.with_(placement=then(Placement(), [*steps, *back]))


def lies_flat(placement: Placement) -> bool:
    """Whether an outline stays in the plane z = 0 under this placement; one of expressions where each step keeps it
    there."""
    if all(map(_keeps_flat, placement.steps)):
        return True
    if placement.symbolic():
        return False
    from ..outline.paths import in_plane

    return in_plane(placement.matrix()) is not None


def _keeps_flat(step: Step) -> bool:
    *_, z = step.numbers
    match step:
        case Move() | Reflect():
            return z == 0.0
        case Turn():
            return step.numbers[:2] == (0.0, 0.0)
        case _:
            return isinstance(step, Scale)


def named_apart(document: Document, nodes: Iterable[Node]) -> list[Node]:
    """The nodes as roots of the document, with names unlike those of its solids, its profiles and each other."""
    names = Names(root.name for root in document.standing)
    return [node if node.name == (name := names.take(node.label)) else node.with_(name=name) for node in nodes]
