"""Operations on the tree: what stands where."""

from __future__ import annotations

from collections.abc import Sequence

from ..document.document import Document
from ..document.errors import Refusal
from ..document.from_outlines import Extrude, Revolve, Sweep
from ..document.kind_names import function_name
from ..document.nodes import (
    KINDS,
    SURFACES,
    Broken,
    Difference,
    Instance,
    Intersection,
    LinearArray,
    Mirror,
    Node,
    PolarArray,
    Union,
    field_specs,
)
from ..document.outlines import Outlines
from ..document.placement import Placement, Step, affine
from ..document.tree import (
    FAMILIES,
    Names,
    change,
    change_each,
    family_of,
    find,
    listed,
    next_number,
    numbered,
    outermost,
    parent,
    put,
    trail,
    trails,
    walk,
)
from .checks import with_successors
from .fitting import (
    carried,
    carried_into,
    check_fit,
    check_free,
    check_left,
    check_tree,
    lies_flat,
    root_name,
    steps_of,
    then,
)
from .linking import check_definitions
from .parameters import declaring
from .surfaces import with_materials_of

OF_SOLIDS: tuple[type[Node], ...] = (
    Union, Difference, Intersection, *SURFACES, LinearArray, PolarArray, Mirror,
)  # fmt: skip
"""The operations that take solids; all but those of SURFACES take outlines instead, too."""


def insert(document: Document, node: Node, parent_id: str | None = None, index: int | None = None) -> Document:
    """Add a solid or an outline, or an operand of `parent_id` at `index` (None: last), and the parameters declared in
    it."""
    document, fresh = _coming(document, node, parent_id)
    above = None if parent_id is None else find(document, parent_id)
    if above is None:
        fresh = fresh.with_(name=root_name(document, fresh.label))
    after = put(document, (fresh,), parent_id, index)
    check_fit(above, fresh, Outlines(document.definitions))
    return after


def replace(document: Document, node_id: str, node: Node) -> Document:
    """Put a new node in the place of another one, which goes; an unnamed one takes over the name."""
    old, above = find(document, node_id), parent(document, node_id)
    check_free(document, [node_id])
    document, fresh = _coming(document, node, None if above is None else above.id)
    check_fit(above, fresh, Outlines(document.definitions))
    name = fresh.name or old.name
    if above is None:
        name = root_name(document, name, [node_id])
    return with_successors(change(document, node_id, lambda old: fresh.with_(name=name)), {node_id: fresh.id})


def _coming(document: Document, node: Node, parent_id: str | None) -> tuple[Document, Node]:
    """The node with ids of this document, and the document with the parameters that it declares. Raises Refusal."""
    if not isinstance(node, Node):
        raise Refusal(f"a solid is needed, not {node!r:.60}")
    (fresh,) = numbered([node], next_number(document))
    for part in walk(fresh):
        if isinstance(part, Broken) or (isinstance(part, Instance) and part.children):
            raise Refusal(f"“{part.label}” stands in resolved trees only, not in a document")
    check_definitions(document, [fresh], parent_id)
    check_tree(fresh, Outlines(document.definitions))
    document, (fresh,) = with_materials_of(document, [fresh])
    return declaring(document, [part.expressions() for part in walk(fresh)]), fresh


def delete(document: Document, ids: Sequence[str]) -> Document:
    """Take nodes out of the document."""
    ids = outermost(document, ids)
    check_left(trails(document, ids).values(), Outlines(document.definitions))
    after = change_each(document, ids, lambda node: None)
    gone = {root.id for root in document.definitions} - {root.id for root in after.definitions}
    for node in walk(*after.roots) if gone else ():
        if isinstance(node, Instance) and node.definition in gone:
            label = find(document, node.definition).label
            raise Refusal(f"“{label}” is still used by “{node.label}”; delete or unlink that first")
    return after


def combine(document: Document, kind: str, ids: Sequence[str], name: str = "") -> Document:
    """Put nodes under a new operation, which takes the place of the first; `kind` as in scripts, such as `union`.

    The nodes keep their place in space.
    """
    wanted = _kind(kind)
    if wanted not in OF_SOLIDS:
        raise Refusal(f"a {wanted.title.lower()} does not join solids")
    ids = outermost(document, ids)
    if not ids:
        raise Refusal(f"select what the {wanted.title.lower()} should take")
    ways = trails(document, ids)
    flat = Outlines(document.definitions)
    flats = sum(way[-1] in flat for way in ways.values())
    if flats and wanted in SURFACES:
        raise Refusal(f"an outline is flat; a {wanted.title.lower()} takes solids")
    if 0 < flats < len(ways):
        raise Refusal("outlines are flat, and some of these are solids: extrude the outlines first")
    check_free(document, ids)
    *home, _ = ways[ids[0]]
    above = home[-1] if home else None
    check_left(list(ways.values())[1:], flat, above)
    nodes = [carried(document, way, tuple(home)) for way in ways.values()]
    check_definitions(document, nodes, ids[0], known=False)
    number = next_number(document)
    plane = Placement()
    if flats and above is None and not lies_flat(nodes[0].placement):  # joined in the work plane of the first
        plane = nodes[0].placement
        nodes = [carried_into(node, plane.steps) for node in nodes]
    most = wanted.operands[1]
    if most is not None and len(nodes) > most:
        nodes = [Union(id=f"n{number + 1}", children=tuple(nodes))]
    new = wanted(id=f"n{number}", name=" ".join(str(name).split()), children=tuple(nodes), placement=plane)
    if above is None:
        new = new.with_(name=root_name(document, new.label, ids))
    check_fit(above, new, flat)
    document = change_each(document, ids, lambda node: new if node.id == ids[0] else None)
    return with_successors(document, {ids[0]: new.id})


def dissolve(document: Document, ids: Sequence[str] | str) -> Document:
    """Replace operations by their operands, which keep their place in space, and the colour that it gave them."""
    wanted = listed(ids)
    for node_id in sorted(wanted, key=lambda node_id: -len(trail(document, node_id))):  # inner ones first
        document = _dissolved(document, node_id)
    return document


def _dissolved(document: Document, node_id: str) -> Document:
    node, above = find(document, node_id), parent(document, node_id)
    if not node.children:
        raise Refusal(f"“{node.label}” has no operands to set free")
    check_free(document, [node_id])
    flat = Outlines(document.definitions)
    for child in node.children:
        check_fit(above, child, flat)
    most = None if above is None else type(above).operands[1]
    if above is not None and most is not None and len(above.children) - 1 + len(node.children) > most:
        raise Refusal(f"“{above.label}” takes only {most} operand{'' if most == 1 else 's'}")
    steps = steps_of(node)
    section = node.children[0] if isinstance(node, Sweep) else None
    freed = [
        child.with_(
            placement=_across(document, child, steps) if child is section else then(child.placement, steps),
            colour=child.colour or node.colour,
            visible=child.visible and node.visible,
        )
        for child in node.children
    ]
    if above is not None:
        place = next(i for i, child in enumerate(above.children) if child is node)
        new = (*above.children[:place], *freed, *above.children[place + 1 :])
        return change(document, above.id, lambda above: above.with_(children=new))
    names = Names(root.name for root in document.standing if root is not node)
    freed = [child.with_(name=names.take(child.label)) for child in freed]
    home = next(family for family in FAMILIES if any(root is node for root in getattr(document, family)))
    place = next(i for i, root in enumerate(getattr(document, home)) if root is node)
    without = with_successors(change(document, node_id, lambda node: None), {node_id: freed[0].id})
    return put(without, freed, None, place if home == family_of(freed[0], flat) else None)


def _across(document: Document, section: Node, steps: Sequence[Step]) -> Placement:
    """Where the section of a sweep stands in space; beside the path's own axes where that has no place."""
    from ..outline.frames import frame_of

    try:
        return Placement((affine(frame_of(document, section.id)),))
    except Refusal:
        return then(section.placement, steps)


def change_kind(document: Document, ids: Sequence[str] | str, kind: str) -> Document:
    """Turn operations into others with the same operands, and the same values where both have a field."""
    wanted = _kind(kind)
    for node_id in listed(ids):
        document = _changed_kind(document, node_id, wanted)
    return document


def _changed_kind(document: Document, node_id: str, wanted: type[Node]) -> Document:
    node = find(document, node_id)
    if type(node) is wanted:
        return document
    joining = isinstance(node, OF_SOLIDS) and wanted in OF_SOLIDS
    if not joining and not (isinstance(node, Extrude | Revolve) and wanted in (Extrude, Revolve)):
        raise Refusal(f"“{node.label}” cannot become a {wanted.title.lower()}")
    if joining and wanted in SURFACES and node in Outlines(document.definitions):
        raise Refusal(f"“{node.label}” joins outlines, which are flat; a {wanted.title.lower()} takes solids")
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
        name = root_name(document, wanted.title)
    return change(document, node_id, lambda node: wanted(name=name, **kept))


def _kind(word: str | type[Node]) -> type[Node]:
    for kind in KINDS.values():
        if kind is not Broken and word in (kind, kind.__name__, function_name(kind)):
            return kind
    raise Refusal(f"there is no operation called {word!r:.60}")
