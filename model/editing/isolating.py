"""Showing some nodes alone: a view of the document, which itself stays as it is."""

from __future__ import annotations

from collections.abc import Sequence

from ..document.document import Document
from ..document.errors import Refusal
from ..document.nodes import Node
from ..document.placement import Placement
from ..document.tree import outermost, put, trails, walk
from ..operations.fitting import steps_above, then


def isolation_fault(document: Document, ids: Sequence[str]) -> str | None:
    """Why these nodes cannot be shown alone, or None."""
    inside = {node.id for node in walk(*document.definitions)}
    for node_id in ids:
        if node_id in inside:
            return "a definition has no place of its own: isolate one of its instances"
    return None


def isolated(document: Document, ids: Sequence[str]) -> Document:
    """The document with these nodes as its only solids and profiles, each at its place in space (under an array: the
    first copy).

    A whole solid stays the very node that it is, unless it is hidden. Raises Refusal.
    """
    fault = isolation_fault(document, ids)
    if fault:
        raise Refusal(fault)
    roots: list[Node] = []
    for *way, node in trails(document, outermost(document, ids)).values():
        colour = node.colour or next((above.colour for above in reversed(way) if above.colour), None)
        if way:
            placement = then(Placement(), [*node.placement.steps, *steps_above(way)])
            node = node.with_(placement=placement, colour=colour, name=node.label, visible=True)
        elif not node.visible:
            node = node.with_(visible=True)
        roots.append(node)
    return put(document.with_(solids=(), profiles=()), roots)
