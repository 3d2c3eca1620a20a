"""Operations on definitions, the sub-trees that instances share, and on whole documents put into others."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from ..document.document import Document
from ..document.errors import Refusal
from ..document.nodes import Instance, Node
from ..document.placement import Placement
from ..document.tree import (
    FAMILIES,
    Names,
    change,
    change_each,
    find,
    listed,
    next_number,
    numbered,
    trail,
    unique_name,
    walk,
)
from .checks import copied_pairs, with_successors
from .fonts import with_fonts_of
from .parameters import declaring
from .surfaces import joined_lights, with_like_materials


def link(document: Document, ids: Iterable[str] | str) -> Document:
    """Make nodes definitions, with an instance in the place of each, so that they can be used more than once.

    Those that are the same solid, name and placement apart, share one definition: that of the first.
    """
    made: dict[tuple[Any, ...], str] = {}
    for node_id in listed(ids):
        node = find(document, node_id)
        if isinstance(node, Instance):
            raise Refusal(f"“{node.label}” is an instance already; duplicate it to use it once more")
        if any(root is node for root in document.definitions):
            raise Refusal(f"“{node.label}” is a definition already; duplicate one of its instances to use it once more")
        kept = {name: getattr(node, name) for name in ("name", "placement", "colour", "visible")}
        looks = tuple((below.colour, below.visible) for below in walk(*node.children))
        shared = made.setdefault((type(node), node.shape_digest, looks), node_id)
        instance = Instance(id=f"n{next_number(document)}", definition=shared, **kept)
        if shared == node_id:  # first, because it tells what its instance is
            definition = node.with_(placement=Placement(), colour=None, visible=True, name=node.label)
            document = document.with_(definitions=(*document.definitions, definition))
        document = change(document, node_id, lambda node, instance=instance: instance)
        document = with_successors(document, {node_id: instance.id})
    return document


def unlink(document: Document, ids: Iterable[str] | str) -> Document:
    """Replace instances by copies of their definition; a definition that nobody uses any more goes."""
    for node_id in listed(ids):
        document = _unlinked(document, node_id)
    return document


def _unlinked(document: Document, node_id: str) -> Document:
    node = find(document, node_id)
    if not isinstance(node, Instance):
        raise Refusal(f"“{node.label}” is not an instance")
    definition = next((root for root in document.definitions if root.id == node.definition), None)
    if definition is None:
        raise Refusal(f"the definition {node.definition or '?'} of “{node.label}” is not in the document")
    (copy,) = numbered([definition], next_number(document))
    copy = copy.with_(
        id=node.id,
        name=node.name,
        visible=node.visible,
        colour=node.colour or definition.colour,
        note=node.note or definition.note,
        crease=node.crease if definition.crease is None else definition.crease,
        placement=Placement(copy.placement.steps + node.placement.steps),
    )
    document = change(document, node_id, lambda node: copy)
    if definition.id not in used_definitions(*document.roots):
        document = document.with_(definitions=tuple(d for d in document.definitions if d is not definition))
    return document


def insert_document(document: Document, other: Document) -> Document:
    """Add all that another document holds; like-named parameters must agree, and sections come closed; the
    clearance asked of all stays."""
    if not isinstance(other, Document):
        raise Refusal(f"a document is needed, not {other!r:.60}")
    known = {parameter.name: parameter for parameter in document.parameters}
    for parameter in other.parameters:
        if known.setdefault(parameter.name, parameter) != parameter:
            raise Refusal(f"both documents have a parameter {parameter.name}, with different values; rename one")
    document = document.with_(parameters=tuple(known.values()))
    sets, sections = [*document.sets], [*document.sections]
    for one in other.sets:
        sets.append(replace(one, name=unique_name(one.name, [two.name for two in sets])))
    for one in other.sections:
        sections.append(one.with_(name=unique_name(one.name, [two.name for two in sections]), active=False))
    document, other = with_fonts_of(document.with_(sets=tuple(sets), sections=tuple(sections)), other)
    document, other = with_like_materials(document, other)
    document = document.with_(lights=tuple(joined_lights(document.lights, other.lights)))
    declaring(document, [node.expressions() for node in walk(*other.roots)])
    roots = numbered(other.roots, next_number(document))
    renamed = {old.id: new.id for old, new in zip(other.roots, roots, strict=True)}
    names = Names(root.name for root in document.standing)
    named = []
    for root in roots[: len(other.standing)]:
        name = names.take(root.label)
        named.append(root if root.name == name else root.with_(name=name))
    coming = iter((*named, *roots[len(named) :]))
    changes = {family: (*getattr(document, family), *(next(coming) for _ in getattr(other, family)))
               for family in FAMILIES}  # fmt: skip
    known_pairs = (*document.checks.pairs, *copied_pairs(other.checks.pairs, renamed))
    motions = [*document.motions]
    for motion in other.motions:
        motions.append(motion.with_(name=unique_name(motion.name, [one.name for one in motions])))
    changes |= {"checks": document.checks.with_(pairs=known_pairs), "motions": tuple(motions)}
    instances = [node.id for node in walk(*roots) if isinstance(node, Instance)]
    # One whose definition was missing must not come upon a node of this document by chance.
    return change_each(document.with_(**changes), instances, lambda node: node.with_(
        definition=renamed.get(node.definition, "")))  # type: ignore[attr-defined]  # fmt: skip


def used_definitions(*roots: Node) -> set[str]:
    """The ids that the instances in these trees refer to."""
    return {node.definition for node in walk(*roots) if isinstance(node, Instance)}


def check_definitions(document: Document, nodes: Iterable[Node], parent_id: str | None, known: bool = True) -> None:
    """Refuse nodes in which an instance has no definition (if `known`), or that would make a definition hold itself."""
    used = used_definitions(*nodes)
    if not used:
        return
    definitions = {root.id: root for root in document.definitions}
    missing = sorted(used - definitions.keys())
    if missing and known:
        raise Refusal(f"there is no definition {missing[0] or '?'} in the document")
    home = "" if parent_id is None else trail(document, parent_id)[0].id
    if home not in definitions:
        return
    seen: set[str] = set()
    while used:
        one = used.pop()
        if one == home:
            raise Refusal(f"the definition “{definitions[home].label}” would hold itself")
        if one in definitions and one not in seen:
            seen.add(one)
            used |= used_definitions(definitions[one])
