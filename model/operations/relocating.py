"""Operations that put nodes, or copies of them, elsewhere in the tree. Nothing moves in space."""

from __future__ import annotations

from collections.abc import Sequence

from ..document.document import Document
from ..document.errors import Refusal
from ..document.nodes import Instance, Node
from ..document.outlines import Outlines
from ..document.tree import (
    change,
    change_each,
    check_room,
    family_of,
    find,
    listed,
    next_number,
    numbered,
    outermost,
    parent,
    position,
    put,
    trail,
    trails,
)
from .checks import copied_pairs
from .fitting import carried, check_fit, check_free, check_left, named_apart, root_name
from .linking import check_definitions


def relocate(document: Document, ids: Sequence[str], parent_id: str | None, index: int | None = None) -> Document:
    """Move nodes to another place in the tree, before the sibling now at `index` (None: last).

    They keep their place in space. Among the roots the index is a place in the family of the first node, solids or
    profiles; nodes of the other one come last in it.
    """
    ids = outermost(document, ids)
    way = () if parent_id is None else trail(document, parent_id)
    moved = set(ids)
    if any(node.id in moved for node in way):
        raise Refusal("a node cannot be moved into itself")
    check_free(document, ids)
    above = way[-1] if way else None
    old_ways = trails(document, ids)
    nodes = [carried(document, old_way, way) for old_way in old_ways.values()]
    flat = Outlines(document.definitions)
    for node in nodes:
        check_fit(above, node, flat)
    check_left(old_ways.values(), flat, above)
    check_definitions(document, nodes, parent_id, known=False)
    home = family_of(nodes[0], flat) if nodes else "solids"
    family = getattr(document, home) if above is None else above.children
    place = position(family, index)
    place -= sum(member.id in moved for member in family[:place])
    stay = [member for member in family if member.id not in moved]
    order = [*stay[:place], *nodes, *stay[place:]]
    if len(order) == len(family) and all(a is b for a, b in zip(order, family, strict=True)):
        return document
    document = change_each(document, ids, lambda node: None)
    return put(document, named_apart(document, nodes) if above is None else nodes, parent_id, place)


def copy_to(document: Document, ids: Sequence[str], parent_id: str | None, index: int | None = None) -> Document:
    """Put copies of nodes at another place in the tree, before the operand now at `index` (None: last).

    The copies stand in space where the originals stand. Of a definition it is an instance that comes.
    """
    ids = outermost(document, ids)
    way = () if parent_id is None else trail(document, parent_id)
    above = way[-1] if way else None
    roots = {root.id for root in document.definitions}
    old_ways = trails(document, ids)
    nodes = [Instance(definition=i) if i in roots else carried(document, old_ways[i], way) for i in ids]
    flat = Outlines(document.definitions)
    for node in nodes:
        check_fit(above, node, flat)
    check_definitions(document, nodes, parent_id, known=False)
    copies = numbered(nodes, next_number(document))
    if above is None:
        labels = [old_ways[i][-1].label for i in ids]
        copies = named_apart(document, [c.with_(name=label) for c, label in zip(copies, labels, strict=True)])
    return put(document, copies, parent_id, index)


def reorder(document: Document, ids: Sequence[str], by: int) -> Document:
    """Move nodes among their siblings by some places, towards the last where `by` is above 0; at an end they stay."""
    if isinstance(by, bool) or not isinstance(by, int):
        raise Refusal(f"places are whole numbers, not {by!r:.60}")
    wanted = listed(ids)
    check_free(document, wanted)
    chosen = set(wanted)
    above = [way[-2] if len(way) > 1 else None for way in trails(document, wanted).values()]
    if None in above:
        for family in ("solids", "profiles"):
            old = getattr(document, family)
            new = _shifted(old, chosen, by)
            document = document if new is old else document.with_(**{family: new})

    def shifted(node: Node) -> Node:
        children = _shifted(node.children, chosen, by)
        return node if children is node.children else node.with_(children=children)

    return change_each(document, [node.id for node in above if node is not None], shifted)


def _shifted(family: tuple[Node, ...], chosen: set[str], by: int) -> tuple[Node, ...]:
    order = list(family) if by < 0 else list(reversed(family))
    for _ in range(min(abs(by), len(order))):
        for place in range(1, len(order)):
            if order[place].id in chosen and order[place - 1].id not in chosen:
                order[place - 1 : place + 1] = order[place], order[place - 1]
    if by > 0:
        order.reverse()
    return family if all(a is b for a, b in zip(order, family, strict=True)) else tuple(order)


def promote(document: Document, node_id: str) -> Document:
    """Make a node the first operand of its operation: the base of a difference."""
    above = parent(document, node_id)
    if above is None:
        raise Refusal(f"“{find(document, node_id).label}” is no operand")
    rest = tuple(child for child in above.children if child.id != node_id)
    first = next(child for child in above.children if child.id == node_id)
    if first is above.children[0]:
        return document
    return change(document, above.id, lambda node: node.with_(children=(first, *rest)))


def swap(document: Document, one_id: str, other_id: str) -> Document:
    """Let two nodes change places in the tree. They keep their places in space."""
    pair = [one_id, other_id]
    if len(outermost(document, pair)) < 2:
        raise Refusal("two nodes change places, and neither may stand in the other")
    check_free(document, pair)
    ways = trails(document, pair)
    flat = Outlines(document.definitions)
    if len({family_of(way[-1], flat) for way in ways.values()}) > 1:
        raise Refusal("an outline and a solid cannot change places: one is flat, the other is not")
    new: dict[str, Node] = {}
    for node_id, stranger in zip(reversed(pair), pair, strict=True):
        way = ways[stranger][:-1]
        node = carried(document, ways[node_id], way)
        check_fit(way[-1] if way else None, node, flat)
        check_definitions(document, [node], way[-1].id if way else None, known=False)
        if not way:
            node = node.with_(name=root_name(document, node.label, pair))
        new[stranger] = node
    return change_each(document, pair, lambda node: new[node.id])


def duplicate(document: Document, ids: Sequence[str]) -> Document:
    """Copy nodes, each beside its original."""
    ways = trails(document, outermost(document, ids))
    above: dict[str, list[Node]] = {}
    definitions = {root.id for root in document.definitions}
    for *over, node in ways.values():
        if not over and node.id in definitions:
            raise Refusal(f"“{node.label}” is a definition; duplicate one of its instances")
        if over:
            above.setdefault(over[-1].id, []).append(over[-1])
    for same in above.values():
        check_room(same[0], len(same))
    copies = numbered([way[-1] for way in ways.values()], next_number(document))
    beside = dict(zip(ways, copies, strict=True))
    roots = [node_id for node_id, way in ways.items() if len(way) == 1]
    pairs = copied_pairs(document.checks.pairs, {node_id: beside[node_id].id for node_id in roots})
    beside |= zip(roots, named_apart(document, [beside[node_id] for node_id in roots]), strict=True)

    def doubled(family: tuple[Node, ...]) -> tuple[Node, ...]:
        return tuple(one for node in family for one in (node, beside.get(node.id)) if one is not None)

    if roots:
        checks = document.checks.with_(pairs=(*document.checks.pairs, *pairs))
        document = document.with_(solids=doubled(document.solids), profiles=doubled(document.profiles), checks=checks)
    return change_each(document, above, lambda node: node.with_(children=doubled(node.children)))
