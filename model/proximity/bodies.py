"""How two solids stand to each other: apart, touching, overlapping, one inside the other; with gap and overlap."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from manifold3d import Manifold, OpType
from numpy.typing import NDArray

from ..mesh.pieces import pieces
from . import native
from .boxes import BoxTree, Floats

APART, TOUCHING, OVERLAPPING, INSIDE, AROUND = "apart", "touching", "overlapping", "inside", "around"
"""What the first of two bodies is to the second: the last two tell that one holds all of the other."""

MEETING = 1e-12
"""The share of two bodies' coordinates within which their surfaces meet."""
OVERLAP = 1e-9
"""The part of the smaller one's volume from which an overlap is more than rounding."""
FEW = 8
"""Points for which no tree is made."""
TOGETHER = 256
"""Pairs whose gaps are found between two words to whoever waits."""


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
        if self.solid is not None:
            return np.array(self.solid.bounding_box()).reshape(2, 3)
        used = self.vertices[self.triangles.reshape(-1)]
        return np.array([used.min(axis=0), used.max(axis=0)])

    @cached_property
    def volume(self) -> float:
        """In mm³; 0 of what is not closed."""
        return 0.0 if self.solid is None else abs(self.solid.volume())

    @cached_property
    def tree(self) -> BoxTree:
        return BoxTree(self.vertices[self.triangles])

    @cached_property
    def surface(self) -> native.Surface:
        return native.Surface(self.vertices, self.triangles)

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
        asked = np.ascontiguousarray(points, np.float64).reshape(-1, 3)
        held = np.zeros(len(asked), bool)
        if self.solid is None or self.empty:
            return held
        low, high = self.bounds
        boxed = np.flatnonzero(((asked >= low) & (asked <= high)).all(axis=1))
        if 0 < len(boxed) <= FEW and native.available() and "tree" not in self.__dict__:
            held[boxed] = native.windings_of(self.surface, asked[boxed]) > 0
        elif len(boxed):
            held[boxed] = self.tree.windings(asked[boxed]) > 0
        return held


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
    near = _meeting(one, other)
    gap = one.tree.gap(other.tree, max(limit, 2.0 * near))
    return judged(one, other, gap.length, np.array([gap.a, gap.b]), limit, near)


def _meeting(one: Body, other: Body) -> float:
    """Millimetres within which two surfaces meet: rounding grows with the way from the origin, too."""
    return MEETING * 2.0 * max(float(np.abs(one.bounds).max()), float(np.abs(other.bounds).max()))


def judged(one: Body, other: Body, gap: float, ends: Floats, limit: float, near: float) -> Relation | None:
    """See `relation`; of the gap between the two surfaces, where it is below the limit, with its ends (2, 3). They meet
    where it is at most `near`."""
    meets = gap <= near
    solid = one.closed and other.closed
    if solid and (meets or _around(one, other)):
        volume = float(overlap_of(one, other).volume())
        if volume > OVERLAP * min(one.volume, other.volume):
            kind = OVERLAPPING
            if not meets and other.holds(one.landmarks).all():
                kind = INSIDE
            elif not meets and one.holds(other.landmarks).all():
                kind = AROUND
            return Relation(kind, 0.0, None, volume)
    if not meets and not gap < limit - near:
        return None
    return Relation(TOUCHING if meets else APART, 0.0 if meets else gap, ends, 0.0 if solid else None)


def _around(one: Body, other: Body) -> bool:
    """Whether a piece of one, whose surfaces do not meet, lies inside the other."""
    (low, high), (lowest, highest) = one.bounds, other.bounds
    if (low > highest).any() or (lowest > high).any():
        return False
    return bool(other.holds(one.landmarks).any() or one.holds(other.landmarks).any())


def relations(
    bodies: Sequence[Body],
    pairs: Sequence[tuple[int, int]],
    limits: Sequence[float],
    told: Callable[[int, int], None] | None = None,
) -> list[Relation | None]:
    """`relation` of pairs of bodies, none of which is empty, each below a finite limit of its own.

    Only what one has near the box of the other counts, so that no trees are made. `told` hears how many pairs are done,
    and may raise to stop.
    """
    if not native.available():
        found = []
        for number, ((one, other), limit) in enumerate(zip(pairs, limits, strict=True)):
            if told is not None:
                told(number, len(pairs))
            found.append(relation(bodies[one], bodies[other], limit))
        return found
    known: list[Relation | None] = []
    for start in range(0, len(pairs), TOGETHER):
        if told is not None:
            told(start, len(pairs))
        rows = np.array(pairs[start : start + TOGETHER], np.int64)
        some, place = np.unique(rows, return_inverse=True)
        asked = [bodies[k] for k in some.tolist()]
        boxes = np.array([body.bounds for body in asked])
        ends = boxes[place.reshape(rows.shape)]  # (k, 2, 2, 3)
        most = np.array(limits[start : start + TOGETHER], np.float64)
        near = 2.0 * MEETING * np.abs(ends).max(axis=(1, 2, 3))
        gaps, points, _ = native.near(
            [body.surface for body in asked], boxes, place.reshape(rows.shape), np.maximum(most, 2.0 * near)
        )
        boxed = (ends[:, 0, 0] <= ends[:, 1, 1]).all(axis=1) & (ends[:, 1, 0] <= ends[:, 0, 1]).all(axis=1)
        some = boxed | (gaps <= near) | (gaps < most - near)
        for (one, other), asked_for, *rest in zip(
            rows.tolist(), some.tolist(), gaps.tolist(), points, most.tolist(), near.tolist(), strict=True
        ):
            known.append(judged(bodies[one], bodies[other], *rest) if asked_for else None)
    return known


def overlap_of(one: Body, other: Body) -> Manifold:
    """What two closed bodies share."""
    assert one.solid is not None and other.solid is not None
    return Manifold.batch_boolean([one.solid, other.solid], OpType.Intersect)
