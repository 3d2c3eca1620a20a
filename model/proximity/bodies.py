"""How two solids stand to each other: apart, touching, overlapping, one inside the other; with gap and overlap."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from manifold3d import Manifold, OpType
from numpy.typing import NDArray

from ..mesh.faults.box_pairs import meeting
from ..mesh.pieces import pieces
from . import native
from .boxes import BoxTree, Floats

APART, TOUCHING, OVERLAPPING, INSIDE, AROUND = "apart", "touching", "overlapping", "inside", "around"
"""What the first of two bodies is to the second: the last two tell that one holds all of the other."""

MEETING = 1e-12
"""The share of two bodies' coordinates within which their surfaces meet."""
OVERLAP = 1e-9
"""The part of the smaller one's volume from which an overlap is more than rounding."""


class Body:
    """A solid, or a surface that bounds none. Trees and pieces are made when they are first asked for.

    `vertices` (n, 3) in mm and `triangles` (m, 3); `solid` is None for what is not closed.
    """

    def __init__(
        self, name: str, vertices: Floats, triangles: NDArray[np.integer], solid: Manifold | None = None
    ) -> None:
        self.name, self.solid = name, solid
        self.vertices, self.triangles = vertices, triangles

    @property
    def empty(self) -> bool:
        return not len(self.triangles)

    @property
    def closed(self) -> bool:
        return self.solid is not None

    @cached_property
    def bounds(self) -> Floats:
        """(2, 3) the lowest and highest corner."""
        used = self.vertices[self.triangles.reshape(-1)]
        return np.array([used.min(axis=0), used.max(axis=0)])

    @cached_property
    def tree(self) -> BoxTree:
        return BoxTree(self.vertices[self.triangles])

    @cached_property
    def landmarks(self) -> Floats:
        """(k, 3) a vertex of each connected surface."""
        if native.available():
            labels = native.pieces(self.triangles, len(self.vertices))
            return self.vertices[labels == np.arange(len(labels))]
        one, other = self.triangles[:, [0, 1]].reshape(-1), self.triangles[:, [1, 2]].reshape(-1)
        used = np.unique(self.triangles)
        label = pieces(one, other, len(self.vertices))[used]
        return self.vertices[used[np.unique(label, return_index=True)[1]]]

    def holds(self, points: Floats) -> NDArray[np.bool_]:
        """(n,) which points (n, 3) lie inside; those on the surface either way. A surface that is open holds none."""
        if self.solid is None or self.empty:
            return np.zeros(len(np.reshape(points, (-1, 3))), bool)
        return self.tree.windings(points) > 0


@dataclass(frozen=True, slots=True, eq=False)
class Relation:
    """What the first of two bodies is to the second (`kind`); see `relation`.

    `gap` in mm, 0 where they meet; `points` (2, 3) its two ends, None where the bodies overlap; `overlap` the volume
    that they share in mm³, None where one is no solid.
    """

    kind: str
    gap: float
    points: Floats | None
    overlap: float | None


def relation(one: Body, other: Body, limit: float = np.inf) -> Relation | None:
    """How two bodies stand to each other; None where they are apart by `limit` mm or more, or one is empty.

    Exact booleans decide whether surfaces that meet do more than touch. A body in a cavity of another is not inside it.
    """
    if one.empty or other.empty:
        return None
    size = 2.0 * float(np.abs((one.bounds, other.bounds)).max())  # rounding grows with the way from the origin, too
    boxed = bool((one.bounds[0] <= other.bounds[1]).all() and (other.bounds[0] <= one.bounds[1]).all())
    found = one.tree.gap(other.tree, max(limit, 2.0 * MEETING * size))
    meets = found.length <= MEETING * size
    solid = one.closed and other.closed
    if boxed and solid and (meets or other.holds(one.landmarks).any() or one.holds(other.landmarks).any()):
        volume = float(overlap_of(one, other).volume())
        least = min(abs(body.solid.volume()) for body in (one, other) if body.solid is not None)
        if volume > OVERLAP * least:
            kind = OVERLAPPING
            if not meets and other.holds(one.landmarks).all():
                kind = INSIDE
            elif not meets and one.holds(other.landmarks).all():
                kind = AROUND
            return Relation(kind, 0.0, None, volume)
    if not meets and not found.length < limit - MEETING * size:
        return None
    points, nothing = np.array([found.a, found.b]), 0.0 if solid else None
    return Relation(TOUCHING if meets else APART, 0.0 if meets else found.length, points, nothing)


def overlap_of(one: Body, other: Body) -> Manifold:
    """What two closed bodies share."""
    assert one.solid is not None and other.solid is not None
    return Manifold.batch_boolean([one.solid, other.solid], OpType.Intersect)


@dataclass(frozen=True, slots=True, eq=False)
class Clash:
    """Two bodies by their places in the list that was looked at, and how they stand to each other."""

    one: int
    other: int
    relation: Relation


def clashes(
    bodies: Sequence[Body],
    clearance: float = 0.0,
    apart: Iterable[tuple[int, int]] = (),
    told: Callable[[int, int], None] | None = None,
) -> list[Clash]:
    """The pairs that overlap or whose gap is below the clearance, in mm: overlaps first, the largest foremost, then by
    gap. Where the clearance is 0 those that only touch are none.

    Pairs in `apart` are left out. `told` hears how many of the pairs whose boxes are near have been looked at, and may
    raise to stop.
    """
    some = [k for k, body in enumerate(bodies) if not body.empty]
    if len(some) < 2:
        return []
    boxes = np.array([bodies[k].bounds for k in some])
    reach = clearance / 2.0 * (1.0 + 1e-9)
    skipped = {(min(pair), max(pair)) for pair in apart}
    near: list[tuple[int, int]] = []
    for left, right in meeting(boxes[:, 0] - reach, boxes[:, 1] + reach):
        pairs = np.sort(np.array(some)[np.column_stack((left, right))], axis=1)
        near += [pair for pair in map(tuple, pairs.tolist()) if pair not in skipped]
    near.sort()
    found = []
    for number, (one, other) in enumerate(near):
        if told is not None:
            told(number, len(near))
        known = relation(bodies[one], bodies[other], clearance)
        if known is not None and (known.kind != TOUCHING or clearance > 0.0):
            found.append(Clash(one, other, known))
    found.sort(key=lambda clash: (clash.relation.gap, -(clash.relation.overlap or 0.0), clash.one, clash.other))
    return found
