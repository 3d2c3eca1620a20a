"""What scripts ask of two solids: how far they are apart, what they share, how they stand to each other."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from ..document.document import Document
from ..document.errors import Refusal
from ..document.nodes import Node
from ..document.resolve import Resolver
from .documents import document_of, evaluate
from .joining import solids_of

if TYPE_CHECKING:
    from ..proximity.bodies import Body, Relation


def distance(one: Node, other: Node, tolerance: float = 0.05) -> float:
    """Millimetres between two solids, 0 where they touch or share something. Raises Refusal where one has no surface.

    >>> distance(box(10), box(10).at(13))
    3.0
    """
    return relation(one, other, tolerance).gap


def overlap(one: Node, other: Node, tolerance: float = 0.05) -> float:
    """The volume in mm³ that two solids share; `one & other` is that body. Raises Refusal where one is no solid.

    >>> overlap(box(10), box(10).at(8, 8))
    40.0
    """
    bodies = bodies_of(one, other, tolerance=tolerance)
    for body in bodies:
        if not body.closed:
            raise Refusal(f"“{body.name}” is not closed: it has no inside to share")
    from ..proximity.bodies import overlap_of

    return float(overlap_of(bodies[0], bodies[1]).volume())


def relation(one: Node, other: Node, tolerance: float = 0.05) -> Relation:
    """What a solid is to another: `kind` is "apart", "touching", "overlapping", "inside" or "around"; with `gap`, its
    two ends `points` and the volume `overlap`. Raises Refusal where one has no surface.

    >>> relation(sphere(2), box(10, centred=True)).kind
    'inside'
    """
    from ..proximity.bodies import relation as relation_of

    first, second = bodies_of(one, other, tolerance=tolerance)
    found = relation_of(first, second)
    assert found is not None
    return found


def clearances(
    solids: Document | Iterable[Node], clearance: float = 0.0, tolerance: float = 0.05
) -> list[dict[str, Any]]:
    """The pairs of visible solids that overlap or whose gap is below the clearance, as `solidtree check` has them.
    Raises Refusal where a solid failed, since nothing is known of its pairs.

    >>> [(pair["a"], pair["gap"]) for pair in clearances([box(10).named("lid"), box(10).at(10.5)], 1)]
    [('lid', 0.5)]
    """
    from ..proximity.checking import checked
    from ..solid.results import open_surface

    document = solids if isinstance(solids, Document) else document_of(*solids_of(solids))
    answer, messages = checked(document, clearance, tolerance)
    surfaces = {root.id for root in Resolver().resolve(document).solids if open_surface(root) is not None}
    for message in messages:
        if message.error and message.node_id not in surfaces:
            raise Refusal(f"“{message.name}”: {message.message}")
    return answer["pairs"]


def bodies_of(*solids: Node, tolerance: float = 0.05) -> list[Body]:
    """Evaluated solids. Raises Refusal where one has no surface."""
    from ..proximity.checking import body_of

    results = evaluate(*solids, tolerance=tolerance).solids
    if len(results) != len(solids):
        raise Refusal("this is asked of solids, and an outline is none: extrude or revolve it first")
    bodies = [body_of(result) for result in results]
    for body, result in zip(bodies, results, strict=True):
        if body.empty:
            reason = next((f": {message.message}" for message in result.messages if message.error), "")
            raise Refusal(f"“{body.name}” has no surface to measure from{reason}")
    return bodies


__all__ = ["clearances", "distance", "overlap", "relation"]
