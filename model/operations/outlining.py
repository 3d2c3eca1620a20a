"""Solids, and other outlines, made of outlines that stand in the document, which are taken in and stay in place."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from ..document.document import Document
from ..document.errors import Refusal
from ..document.from_outlines import FROM_OUTLINES, Extrude, Loft, Pipe, Revolve, Sweep, Wrap
from ..document.kind_names import function_name
from ..document.nodes import Instance, Node, field_specs
from ..document.outlines import OUTLINES, Lettering, Outlines, Stencil, TextOnPath
from ..document.placement import Move, Placement, Turn, moved
from ..document.resolve import resolve
from ..document.tree import change_each, next_number, outermost, put, trails
from .fitting import carried_into, check_free, check_left, lies_flat, named_apart, steps_above
from .parameters import declaring

MAKERS = {function_name(kind): kind for kind in FROM_OUTLINES}
LYING = Turn((-90.0, 0.0, 0.0))
"""Takes back that a revolution stands its outline up."""


def make_solid(document: Document, kind: str, ids: Sequence[str] | str, **fields: Any) -> Document:
    """Make solids of outlines: `extrude`, `revolve` and `pipe` one of each, `sweep` one of an outline and a path,
    `loft` one of all. `fields` are those of the kind, such as height=5.

    The outlines become operands and stay where they are in space; the section of a sweep comes to the path's start
    with its own origin. A sweep takes the closed one of two as the outline, the first where both are closed.
    """
    if kind not in MAKERS:
        raise Refusal(f"there is no solid of outlines called {kind!r:.60}; there are {', '.join(MAKERS)}")
    wanted = MAKERS[kind]
    checked = _checked(wanted, fields)
    ids, outlines = _taken(document, ids, wanted)
    groups = _SORTED[wanted](document, outlines)
    number = next_number(document)
    solids = [
        _placed(wanted, group, checked).with_(id=f"n{number + i}", **checked) for i, group in enumerate(groups)
    ]  # fmt: skip
    return _put_for(document, ids, solids, list(checked.values()))


def set_text_on_path(document: Document, ids: Sequence[str] | str, **fields: Any) -> Document:
    """Set a lettering along a curve: two outlines, in any order. `fields` are those of the kind, such as flip=True.

    The curve stays where it is; the lettering comes to it with its own origin.
    """
    checked = _checked(TextOnPath, fields)
    ids, outlines = _taken(document, ids, TextOnPath)
    letterings = [_is_lettering(outline, document) for outline in outlines]
    if sorted(letterings) != [False, True]:
        raise Refusal(f"a text on a path takes two: a lettering and a curve{_instead(letterings)}")
    curve, lettering = (outlines[letterings.index(what)] for what in (False, True))
    own, place = _parted(curve.placement, False)
    lettering = lettering.with_(placement=_parted(lettering.placement, False)[0])
    made = TextOnPath(id=f"n{next_number(document)}", children=(lettering, curve.with_(placement=own)), placement=place)
    return _put_for(document, ids, [made.with_(**checked)], list(checked.values()))


def make_stencils(document: Document, ids: Sequence[str] | str, **fields: Any) -> Document:
    """Hold the holes of outlines by bridges: a stencil of each. `fields` are those of the kind, such as width=2."""
    checked = _checked(Stencil, fields)
    ids, outlines = _taken(document, ids, Stencil)
    number = next_number(document)
    made = []
    for outline in _each_closed(document, outlines):
        own, place = _parted(outline[0].placement, False)
        children = (outline[0].with_(placement=own),)
        made.append(Stencil(id=f"n{number + len(made)}", children=children, placement=place).with_(**checked))
    return _put_for(document, ids, made, list(checked.values()))


def _instead(letterings: list[bool]) -> str:
    many = sum(letterings)
    if len(letterings) != 2:
        return f", not {len(letterings)}"
    return ", not two letterings: make one of them a path" if many else ", and neither of these is a lettering"


def _is_lettering(outline: Node, document: Document) -> bool:
    definitions = {root.id: root for root in document.definitions}
    while isinstance(outline, Instance) and outline.definition in definitions:
        outline = definitions[outline.definition]
    return isinstance(outline, Lettering)


def _put_for(document: Document, ids: Sequence[str], made: list[Node], declared: list[Any]) -> Document:
    document = change_each(declaring(document, declared), ids, lambda node: None)
    return put(document, named_apart(document, made))


def _taken(document: Document, ids: Sequence[str] | str, wanted: type[Node]) -> tuple[Sequence[str], list[Node]]:
    """The outlines with these ids, placed in the world, which may all be taken in."""
    ids = outermost(document, ids)
    check_free(document, ids)
    ways = trails(document, ids)
    flat = Outlines(document.definitions)
    definitions = {root.id for root in document.definitions}
    outlines: list[Node] = []
    for *way, node in ways.values():
        if node not in flat:
            raise Refusal(f"“{node.label}” is no outline; a {wanted.title.lower()} is made of outlines")
        if way and way[0].id in definitions:
            raise Refusal(f"“{node.label}” stands in a definition, which has no one place in space: unlink an instance")
        outlines.append(node.with_(placement=Placement((*node.placement.steps, *steps_above(way)))))
    check_left(ways.values(), flat)
    return ids, outlines


def _checked(kind: type[Node], fields: dict[str, Any]) -> dict[str, Any]:
    specs = {spec.name: spec for spec in field_specs(kind)}
    for name in fields:
        if name not in specs:
            raise Refusal(f"{kind.title} has no field {name!r:.60}")
    return {name: specs[name].checked(value, kind.title) for name, value in fields.items()}


def _placed(kind: type[Node], outlines: Sequence[Node], fields: Mapping[str, Any]) -> Node:
    """The solid, with the placement that keeps its outlines where they stand in space."""
    *rest, leading = outlines if kind is Sweep else outlines[::-1]
    own, place = _parted(leading.placement, kind in (Sweep, Pipe))
    leading = leading.with_(placement=own)
    if kind is Sweep:
        (section,) = rest
        section = section.with_(placement=_parted(section.placement, False)[0])
        return Sweep(children=(section, leading), placement=place)
    if kind is Revolve:
        place = Placement((LYING, *place.steps))
    if kind is Wrap:
        radius = fields.get("radius", Wrap(children=(leading,)).radius)
        place = Placement((LYING, moved(0.0, 0.0, f"-({radius})"), *place.steps))
    others = [carried_into(outline, place.steps) for outline in reversed(rest)]
    return kind(children=(leading, *others), placement=place)


def _parted(placement: Placement, anywhere: bool) -> tuple[Placement, Placement]:
    """What an outline keeps of its placement, and what the solid takes over: turns and moves alone, so that its height
    and its radius are what they are called; `anywhere`: the outline may leave its plane."""
    steps = placement.steps
    last = max((i for i, step in enumerate(steps) if not isinstance(step, Move | Turn)), default=-1)
    own = Placement(steps[: last + 1])
    return (own, Placement(steps[last + 1 :])) if anywhere or lies_flat(own) else (Placement(), placement)


# Which outlines make which solids.


def _each_closed(document: Document, outlines: list[Node]) -> list[list[Node]]:
    if not outlines:
        raise Refusal("select the outlines to make solids of")
    for outline in outlines:
        _check_closed(document, outline)
    return [[outline] for outline in outlines]


def _each(document: Document, outlines: list[Node]) -> list[list[Node]]:
    """Open ones as well: a pipe follows them, and what is turned is closed along the axis."""
    if not outlines:
        raise Refusal("select the outlines to make solids of")
    return [[outline] for outline in outlines]


def _pair(document: Document, outlines: list[Node]) -> list[list[Node]]:
    if len(outlines) != 2:
        raise Refusal(f"a sweep takes two: an outline and a path, not {len(outlines)}")
    faults = [_open(document, outline) for outline in outlines]
    if all(faults):
        raise Refusal(f"a sweep needs a closed outline to draw along the path, and neither is one: {faults[0]}")
    return [outlines[::-1] if faults[0] else outlines]


def _all_closed(document: Document, outlines: list[Node]) -> list[list[Node]]:
    if len(outlines) < 2:
        raise Refusal(f"a loft is stretched over two outlines or more, not {len(outlines)}")
    for outline in outlines:
        _check_closed(document, outline)
    return [outlines]


_SORTED: dict[type[Node], Callable[[Document, list[Node]], list[list[Node]]]] = {
    Extrude: _each_closed, Revolve: _each, Sweep: _pair, Loft: _all_closed, Pipe: _each,
    Wrap: _each_closed,
}  # fmt: skip


def _check_closed(document: Document, outline: Node) -> None:
    fault = _open(document, outline)
    if fault:
        raise Refusal(fault)


def _open(document: Document, outline: Node) -> str | None:
    """Why an outline has no inside, in words, or None. Raises Refusal where it has no value."""
    from ..outline.paths import own_path

    alone = Document(profiles=(outline,), definitions=document.definitions, parameters=document.parameters)
    below = list(resolve(alone).profiles)
    while below:
        node = below.pop()
        if not isinstance(node, OUTLINES):
            below += node.children
            continue
        path = own_path(node)
        if not path.contours:
            return f"“{node.label}” is empty: draw something first"
        for contour in path.contours:
            if not contour.closed:
                place = ", ".join(f"{number:.6g}" for number in contour.points[-1])
                return f"“{node.label}” is open, it ends at ({place}): close it first"
            if contour.dimension != 2:
                return f"“{node.label}” leaves its plane; only a flat outline has an inside"
    return None
