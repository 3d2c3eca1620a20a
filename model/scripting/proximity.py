"""What scripts ask of solids: gaps, overlaps, how they stand to each other and to points; what is to hold of them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..document.document import Document
from ..document.errors import Refusal
from ..document.nodes import Node
from ..document.resolve import Resolver
from ..operations.checks import check_pair, set_clearance, solid_called
from .documents import document_of, evaluate
from .joining import solids_of

if TYPE_CHECKING:
    from ..proximity.bodies import Body, Relation
    from ..proximity.boxes import Nearest

NO_SOLID = "this is asked of solids, and an outline is none: extrude or revolve it first"
FARTHEST = 1e10
"""Millimetres from the origin, as of outlines."""


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
    first, second = bodies_of(one, other, tolerance=tolerance)
    for body in (first, second):
        if not body.closed:
            raise Refusal(f"“{body.name}” is not closed: it has no inside to share")
    from ..proximity.bodies import overlap_of

    return float(overlap_of(first, second).volume())


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


def in_words(one: Node, other: Node, tolerance: float = 0.05) -> str:
    """How a solid stands to another, as a sentence; of what is empty or has failed, that it is so.

    >>> in_words(box(10).named("case"), box(10).at(0, 0, 10).named("lid"))
    '“case” and “lid” touch, and share no volume.'
    """
    from ..proximity.bodies import relation as relation_of
    from ..proximity.findings import shares_of
    from ..proximity.memo import PairMemo
    from ..proximity.words import relation_words, remark_words

    document = document_of(one, other)
    check_tolerance(tolerance)
    shown = document.with_(solids=tuple(root.with_(visible=True) for root in document.solids))
    solids = PairMemo().standing(shown, tolerance)
    if len(solids) != 2:
        raise Refusal(NO_SOLID)
    unknown = [remark_words(solid.remark()) for solid in solids if solid.body.empty]
    if unknown:
        return " ".join(unknown)
    first, second = solids
    found = relation_of(first.body, second.body)
    assert found is not None
    shares = shares_of(first.body, second.body, found.overlap) if found.overlap else (0.0, 0.0)
    return relation_words((first.root.name, second.root.name), found, shares)


def clearances(
    solids: Document | Iterable[Node], clearance: float | None = None, tolerance: float = 0.05
) -> list[dict[str, Any]]:
    """The pairs of visible solids that overlap, whose gap is below the clearance, or that are apart and meant to touch,
    as `solidtree check` has them. Without a clearance it is the document's own, else 0; what is asked of single
    pairs holds in any case.
    Raises Refusal where a solid failed, since nothing is known of its pairs.

    >>> [(pair["a"], pair["gap"]) for pair in clearances([box(10).named("lid"), box(10).at(10.5)], 1)]
    [('lid', 0.5)]
    """
    from ..proximity.checking import checked
    from ..solid.results import open_surface

    document = solids if isinstance(solids, Document) else document_of(*solids_of(solids))
    check_tolerance(tolerance)
    answer, messages = checked(document, clearance, tolerance)
    surfaces = {root.id for root in Resolver().resolve(document).solids if open_surface(root) is not None}
    for message in messages:
        if message.error and message.node_id not in surfaces:
            raise Refusal(f"“{message.name}”: {message.message}")
    return answer["pairs"] + answer["parted"]


def with_clearance(document: Document, clearance: float, one: str | None = None, other: str | None = None) -> Document:
    """A document that asks this clearance in mm of all pairs of solids, or of the two with these names.

    >>> [pair["gap"] for pair in clearances(with_clearance(document_of(box(10), box(10).at(10.5)), 1))]
    [0.5]
    """
    check_document_given(document)
    if one is None and other is None:
        return set_clearance(document, clearance)
    if one is None or other is None:
        raise Refusal("a clearance is that of all pairs or of two solids: name both")
    return check_pair(document, solid_called(document, one), solid_called(document, other), clearance)


def meant_to_touch(document: Document, one: str, other: str) -> Document:
    """A document where the two solids with these names are meant to touch: to be apart is a fault, as is an overlap.

    >>> case = meant_to_touch(document_of(box=box(10), lid=box(10).at(0, 0, 12)), "lid", "box")
    >>> [pair["words"] for pair in clearances(case)]
    ['“box” and “lid” are meant to touch, and are 2 mm apart.']
    """
    check_document_given(document)
    return check_pair(document, solid_called(document, one), solid_called(document, other), touching=True)


def nearest(solid: Node, points: ArrayLike, tolerance: float = 0.05) -> Nearest:
    """The places of a solid's surface that are nearest to points (n, 3): `distances` (n,) in mm, `places` (n, 3), and
    `faces` (n,), the triangles they are on. Raises Refusal where it has no surface.

    >>> nearest(box(10), [(5, 5, 14)]).places.tolist()
    [[5.0, 5.0, 10.0]]
    """
    return _body(solid, tolerance).tree.nearest(_points(points))


def inside(solid: Node, points: ArrayLike, tolerance: float = 0.05) -> NDArray[np.bool_]:
    """Which of points (n, 3) lie inside a solid, as (n,); those on its surface either way. Raises Refusal where it is
    not closed, or has no surface.

    >>> inside(box(10), [(5, 5, 5), (5, 5, 14)]).tolist()
    [True, False]
    """
    body = _body(solid, tolerance)
    if not body.closed:
        raise Refusal(f"“{body.name}” is not closed: it has no inside")
    return body.holds(_points(points))


def check_tolerance(tolerance: object) -> None:
    """Refuse what is no tolerance."""
    if isinstance(tolerance, bool) or not isinstance(tolerance, float | int) or not 0.0 < tolerance < np.inf:
        raise Refusal(f"a tolerance is a number above 0 mm, not {tolerance!r:.40}")


def check_document_given(document: object) -> None:
    """Refuse what is no document."""
    if not isinstance(document, Document):
        raise Refusal(f"a document is needed, such as document_of makes of solids, not {document!r:.60}")


def _points(points: ArrayLike) -> NDArray[np.float64]:
    try:
        found = np.asarray(points, np.float64)
    except (TypeError, ValueError):
        found = np.zeros(0)
    if found.size == 0 and found.ndim == 1 and not np.size(points):
        return found.reshape(0, 3)
    if found.ndim not in (1, 2) or found.shape[-1] != 3 or not np.isfinite(found).all():
        raise Refusal("points are rows of three finite numbers: x, y and z")
    if len(found) and np.abs(found).max() > FARTHEST:
        raise Refusal(f"a point is farther than {FARTHEST:g} mm from the origin; no solid is")
    return found.reshape(-1, 3)


def _body(solid: Node, tolerance: float) -> Body:
    return bodies_of(solid, tolerance=tolerance)[0]


def bodies_of(*solids: Node, tolerance: float) -> list[Body]:
    """Raises Refusal where one has no surface."""
    from ..proximity.memo import body_of

    check_tolerance(tolerance)
    results = evaluate(*solids, tolerance=tolerance).solids
    if len(results) != len(solids):
        raise Refusal(NO_SOLID)
    bodies = [body_of(result) for result in results]
    for body, result in zip(bodies, results, strict=True):
        if body.empty:
            reason = next((f": {message.message}" for message in result.messages if message.error), "")
            raise Refusal(f"“{body.name}” has no surface to measure from{reason}")
    return bodies


__all__ = [
    "clearances",
    "distance",
    "in_words",
    "inside",
    "meant_to_touch",
    "nearest",
    "overlap",
    "relation",
    "with_clearance",
]
