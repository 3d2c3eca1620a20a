"""Operations on the tree: what stands where."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ..document.document import Document
from ..document.errors import Refusal
from ..document.nodes import (
    KINDS,
    Broken,
    Difference,
    Hull,
    Instance,
    Intersection,
    LinearArray,
    Minkowski,
    Mirror,
    Node,
    PolarArray,
    Union,
    field_specs,
)
from ..document.placement import Move, Placement, Reflect, Step
from ..document.primitives import OUTLINES, Extrude, Revolve
from ..document.tree import (
    change,
    change_each,
    find,
    index_of,
    next_number,
    numbered,
    outermost,
    parent,
    position,
    put,
    trail,
    unique_name,
    walk,
)
from .echo import function_name
from .linking import check_definitions
from .parameters import declaring

OF_SOLIDS: tuple[type[Node], ...] = (
    Union, Difference, Intersection, Hull, Minkowski, LinearArray, PolarArray, Mirror,
)  # fmt: skip
"""The operations that take solids."""


def insert(document: Document, node: Node, parent_id: str | None = None, index: int | None = None) -> Document:
    """Add a solid, or an operand of `parent_id` at `index` (None: last), and the parameters declared in it."""
    document, fresh = _coming(document, node, parent_id)
    above = None if parent_id is None else find(document, parent_id)
    if above is None:
        fresh = fresh.with_(name=_solid_name(document, fresh.label))
    after = put(document, (fresh,), parent_id, index)
    _check_fit(above, fresh)
    return after


def replace(document: Document, node_id: str, node: Node) -> Document:
    """Put a new node in the place of another one, which goes; an unnamed one takes over the name."""
    old, above = find(document, node_id), parent(document, node_id)
    _check_free(document, [node_id])
    document, fresh = _coming(document, node, None if above is None else above.id)
    _check_fit(above, fresh)
    name = fresh.name or old.name
    if above is None:
        name = unique_name(name, [root.name for root in document.solids if root.id != node_id])
    return change(document, node_id, lambda old: fresh.with_(name=name))


def _coming(document: Document, node: Node, parent_id: str | None) -> tuple[Document, Node]:
    """The node with ids of this document, and the document with the parameters that it declares. Raises Refusal."""
    if not isinstance(node, Node):
        raise Refusal(f"a solid is needed, not {node!r:.60}")
    (fresh,) = numbered([node], next_number(document))
    for part in walk(fresh):
        if isinstance(part, Broken) or (isinstance(part, Instance) and part.children):
            raise Refusal(f"“{part.label}” stands in resolved trees only, not in a document")
        for child in part.children:
            _check_fit(part, child)
    check_definitions(document, [fresh], parent_id)
    return declaring(document, [part.expressions() for part in walk(fresh)]), fresh


def delete(document: Document, ids: Sequence[str]) -> Document:
    """Take nodes out of the document."""
    ids = outermost(document, ids)
    after = change_each(document, ids, lambda node: None)
    gone = {root.id for root in document.definitions} - {root.id for root in after.definitions}
    for node in walk(*after.roots) if gone else ():
        if isinstance(node, Instance) and node.definition in gone:
            label = find(document, node.definition).label
            raise Refusal(f"“{label}” is still used by “{node.label}”; delete or unlink that first")
    return after


def combine(document: Document, kind: str, ids: Sequence[str]) -> Document:
    """Put nodes under a new operation, which takes the place of the first; `kind` as in scripts, such as `union`.

    The nodes keep their place in space.
    """
    wanted = _kind(kind)
    if wanted not in OF_SOLIDS:
        raise Refusal(f"a {wanted.title.lower()} does not join solids")
    ids = outermost(document, ids)
    if not ids:
        raise Refusal(f"select what the {wanted.title.lower()} should take")
    for node_id in ids:
        if isinstance(find(document, node_id), OUTLINES):
            raise Refusal(f"an outline is flat; a {wanted.title.lower()} takes solids")
    _check_free(document, ids)
    first = trail(document, ids[0])
    above = first[-2] if len(first) > 1 else None
    nodes = [_carried(document, node_id, first[:-1]) for node_id in ids]
    check_definitions(document, nodes, ids[0], known=False)
    number = next_number(document)
    most = wanted.operands[1]
    if most is not None and len(nodes) > most:
        nodes = [Union(id=f"n{number + 1}", children=tuple(nodes))]
    new = wanted(id=f"n{number}", children=tuple(nodes))
    if above is None:
        new = new.with_(name=unique_name(new.title, [root.name for root in document.solids if root.id not in ids]))
    return change_each(document, ids, lambda node: new if node.id == ids[0] else None)


def dissolve(document: Document, node_id: str) -> Document:
    """Replace an operation by its operands, which keep their place in space, and the colour that it gave them."""
    node, above = find(document, node_id), parent(document, node_id)
    if not node.children:
        raise Refusal(f"“{node.label}” has no operands to set free")
    _check_free(document, [node_id])
    for child in node.children:
        _check_fit(above, child)
    most = None if above is None else type(above).operands[1]
    if above is not None and most is not None and len(above.children) - 1 + len(node.children) > most:
        raise Refusal(f"“{above.label}” takes only {most} operand{'' if most == 1 else 's'}")
    steps = _steps(node)
    freed = [
        child.with_(
            placement=_then(child.placement, steps),
            colour=child.colour or node.colour,
            visible=child.visible and node.visible,
        )
        for child in node.children
    ]
    if above is None:
        taken = {root.name for root in document.solids if root.id != node_id}
        for i, child in enumerate(freed):
            freed[i] = child.with_(name=unique_name(child.label, taken))
            taken.add(freed[i].name)
    family, place = (document.solids if above is None else above.children), index_of(document, node_id)
    new = (*family[:place], *freed, *family[place + 1 :])
    if above is None:
        return document.with_(solids=new)
    return change(document, above.id, lambda above: above.with_(children=new))


def change_kind(document: Document, node_id: str, kind: str) -> Document:
    """Turn an operation into another one with the same operands, and the same values where both have a field."""
    wanted = _kind(kind)
    node = find(document, node_id)
    if type(node) is wanted:
        return document
    joining = isinstance(node, OF_SOLIDS) and wanted in OF_SOLIDS
    if not joining and not (isinstance(node, Extrude | Revolve) and wanted in (Extrude, Revolve)):
        raise Refusal(f"“{node.label}” cannot become a {wanted.title.lower()}")
    fewest, most = wanted.operands
    if len(node.children) < fewest:
        raise Refusal(f"a {wanted.title.lower()} needs an operand")
    if most is not None and len(node.children) > most:
        raise Refusal(f"a {wanted.title.lower()} takes only {most} operand")
    own = {spec.name: spec.type for spec in field_specs(type(node))}
    shared = [spec.name for spec in field_specs(wanted) if own.get(spec.name) == spec.type]
    kept = {n: getattr(node, n) for n in ("id", "colour", "visible", "note", "placement", "children", *shared)}
    name = node.name
    if name.rstrip("0123456789 ") == node.title:  # the name that it was given, not one that somebody chose
        name = unique_name(wanted.title, [root.name for root in document.solids])
    return change(document, node_id, lambda node: wanted(name=name, **kept))


def relocate(document: Document, ids: Sequence[str], parent_id: str | None, index: int | None = None) -> Document:
    """Move nodes to another place in the tree, before the sibling now at `index` (None: last).

    They keep their place in space.
    """
    ids = outermost(document, ids)
    way = () if parent_id is None else trail(document, parent_id)
    if any(node.id in ids for node in way):
        raise Refusal("a node cannot be moved into itself")
    _check_free(document, ids)
    above = way[-1] if way else None
    nodes = [_carried(document, node_id, way) for node_id in ids]
    for node in nodes:
        _check_fit(above, node)
    check_definitions(document, nodes, parent_id, known=False)
    family = document.solids if above is None else above.children
    place = position(family, index)
    place -= sum(member.id in ids for member in family[:place])
    stay = [member for member in family if member.id not in ids]
    order = [*stay[:place], *nodes, *stay[place:]]
    if len(order) == len(family) and all(a is b for a, b in zip(order, family, strict=True)):
        return document
    document = change_each(document, ids, lambda node: None)
    if above is None:
        taken = {root.name for root in document.solids}
        for i, node in enumerate(nodes):
            nodes[i] = node.with_(name=unique_name(node.label, taken))
            taken.add(nodes[i].name)
    return put(document, nodes, parent_id, place)


def duplicate(document: Document, ids: Sequence[str]) -> Document:
    """Copy nodes, each beside its original."""
    for node_id in outermost(document, ids):
        node, above, place = find(document, node_id), parent(document, node_id), index_of(document, node_id) + 1
        if any(root is node for root in document.definitions):
            raise Refusal(f"“{node.label}” is a definition; duplicate one of its instances")
        _check_fit(above, node)
        (copy,) = numbered([node], next_number(document))
        if above is None:
            copy = copy.with_(name=_solid_name(document, node.label))
        document = put(document, (copy,), None if above is None else above.id, place)
    return document


def _kind(word: str | type[Node]) -> type[Node]:
    for kind in KINDS.values():
        if kind is not Broken and word in (kind, kind.__name__, function_name(kind)):
            return kind
    raise Refusal(f"there is no operation called {word!r:.60}")


def _solid_name(document: Document, wanted: str) -> str:
    return unique_name(wanted, [root.name for root in document.solids])


def _check_free(document: Document, ids: Iterable[str]) -> None:
    """A definition's root stays where it is, because instances refer to it."""
    roots = {root.id: root for root in document.definitions}
    for node_id in ids:
        if node_id in roots:
            raise Refusal(f"“{roots[node_id].label}” is a definition; unlink an instance to work on a copy")


def _check_fit(above: Node | None, child: Node) -> None:
    """Outlines stand under what makes solids of them, and nowhere else."""
    makes = isinstance(above, Extrude | Revolve)
    if isinstance(child, OUTLINES):
        if not makes:
            raise Refusal(f"“{child.label}” is an outline, which is flat: extrude or revolve it")
    elif makes:
        raise Refusal(f"“{above.label}” takes an outline, and “{child.label}” is none")


def _steps(node: Node) -> tuple[Step, ...]:
    """What a node does to the place of its operand, or of the first copy of it."""
    if isinstance(node, Mirror) and not node.keep:
        there, back = Move(node.point), Move(node.point).inverse()
        return (*back, Reflect(node.normal), there, *node.placement.steps)
    return node.placement.steps


def _then(placement: Placement, steps: Iterable[Step]) -> Placement:
    for step in steps:
        placement = placement.then(step)
    return placement


def _carried(document: Document, node_id: str, new_way: tuple[Node, ...]) -> Node:
    """The node with the placement that keeps it in its place in space below `new_way`, the nodes from the root down."""
    *old_way, node = trail(document, node_id)
    shared = 0
    while shared < min(len(old_way), len(new_way)) and old_way[shared] is new_way[shared]:
        shared += 1
    homes = {(way[0] if way else None) for way in (old_way, new_way)}
    if len(homes) > 1 and any(root is home for root in document.definitions for home in homes):
        return node  # a definition has no one place in space
    out = [step for above in reversed(old_way[shared:]) for step in _steps(above)]
    back = [step for above in reversed(new_way[shared:]) for step in _steps(above)]
    placement = _then(node.placement, [*out, *(undo for step in reversed(back) for undo in step.inverse())])
    return node if placement is node.placement else node.with_(placement=placement)
