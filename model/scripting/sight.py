"""What scripts do with rays: what they meet, and whether points see each other."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from ..document.document import Document
from ..document.nodes import Node
from .documents import document_of
from .joining import solids_of

if TYPE_CHECKING:
    from ..measuring.sight import NamedView, NodeHit, Scenery

Solids = Node | Document | Iterable[Node]

MOST = 8
"""Sceneries that are kept, so that a script with a thousand rays evaluates and builds once."""
_kept: OrderedDict[tuple[int | float, ...], tuple[tuple[Node | Document, ...], Scenery]] = OrderedDict()


def first_hit(
    solids: Solids, origin: Sequence[float], direction: Sequence[float], tolerance: float = 0.05
) -> NodeHit | None:
    """The first face that a ray meets: `distance`, `point`, `normal`, `front`, and `name`, `solid` and `path` of the
    node that made it. None for a miss; a ray that begins on a face goes on from there. Raises Refusal.

    >>> first_hit([box(10), sphere(3).at(50).named("ball")], (70, 0, 0), (-1, 0, 0)).name
    'ball'
    """
    return _scenery(solids, tolerance).first_hit(origin, direction)


def ray_hits(
    solids: Solids, origin: Sequence[float], direction: Sequence[float], tolerance: float = 0.05
) -> tuple[NodeHit, ...]:
    """All faces on a ray, the nearest first, each as of `first_hit`; one that it begins on counts, too.

    >>> [hit.distance for hit in ray_hits([box(10), box(10).at(20)], (-5, 5, 5), (1, 0, 0))]
    [5.0, 15.0, 25.0, 35.0]
    """
    return _scenery(solids, tolerance).all_hits(origin, direction)


def visible_share(
    solid: Node, eye: Sequence[float], among: Iterable[Node] = (), parallel: bool = False, tolerance: float = 0.05
) -> NamedView:
    """How much of a solid an eye sees past itself and others: `share` 0 to 1 of the area that is turned to the eye,
    `error`, `hiders` by name, `words`, and the texels that were looked at. `parallel`: `eye` is the direction to an eye
    far away. Raises Refusal.

    >>> visible_share(box(10).named("lid"), (5, 5, 50), [box(20, 20, 1).at(-5, -5, 30).named("arm")]).words
    'Nothing of “lid” is seen from there; “arm” hides 100 %'
    """
    solids = (solid, *(other for other in among if other is not solid))
    return _scenery(solids, tolerance).view_of(solid.label, eye, parallel)


def visibility_map(
    solids: Solids, eye: Sequence[float], point: Sequence[float], parallel: bool = False, tolerance: float = 0.05
) -> NamedView:
    """What an eye sees of the smooth face that `point` lies on, texel by texel; see `visible_share`. Raises Refusal.

    >>> visibility_map(box(10), (5, 5, 50), (5, 5, 10)).share
    1.0
    """
    return _scenery(solids, tolerance).map_of(eye, point, parallel)


def sees(solids: Solids, a: Sequence[float], b: Sequence[float], tolerance: float = 0.05) -> bool:
    """Whether two points see each other past solids; the line between them may touch these and end on them.

    >>> sees(box(10), (5, 5, 20), (5, 5, -20)), sees(box(10), (0, 0, 10), (10, 10, 10))
    (False, True)
    """
    return obstacle(solids, a, b, tolerance) is None


def obstacle(solids: Solids, a: Sequence[float], b: Sequence[float], tolerance: float = 0.05) -> NodeHit | None:
    """What stands between two points, as seen from the first one; see `first_hit`. None where they see each other.

    >>> obstacle(box(10), (5, 5, 20), (5, 5, -20)).distance
    10.0
    """
    return _scenery(solids, tolerance).obstacle(a, b)


def _scenery(solids: Solids, tolerance: float) -> Scenery:
    from ..measuring.sight import Scenery

    held = (solids,) if isinstance(solids, Node | Document) else solids_of(solids)
    key = (*(id(one) for one in held), tolerance)  # two equal solids may have different names
    if key not in _kept:
        _kept[key] = held, Scenery(document_of(*held), tolerance)
        if len(_kept) > MOST:
            _kept.popitem(last=False)
    _kept.move_to_end(key)
    return _kept[key][1]


__all__ = ["first_hit", "obstacle", "ray_hits", "sees", "visibility_map", "visible_share"]
