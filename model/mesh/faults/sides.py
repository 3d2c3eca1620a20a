"""The edges of triangles: which sides lie on each, borders, and what hangs together."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..pieces import pieces

Floats = NDArray[np.float64]
Numbers = NDArray[np.int64]
Flags = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, eq=False)
class Sides:
    """Of m triangles: side 3 t + k runs from corner k of triangle t to the next one.

    `start`, `end` (3m,) are the vertices of each side, `edge` (3m,) the edge that it lies on; `ends` (e, 2) the
    vertices of each edge, the lower one first; `uses` (e,) how many sides each has, `forward` (e,) how many of those
    begin at the lower vertex; `first` (e,) one side of each.
    """

    start: Numbers
    end: Numbers
    edge: Numbers
    ends: Numbers
    uses: Numbers
    forward: Numbers
    first: Numbers

    def only(self, edges: Numbers) -> Sides:
        """These edges alone, numbered anew; sides of others lie on the edge -1."""
        place = np.full(len(self.uses), -1)
        place[edges] = np.arange(len(edges))
        ends, uses, forward, first = self.ends[edges], self.uses[edges], self.forward[edges], self.first[edges]
        return Sides(self.start, self.end, place[self.edge], ends, uses, forward, first)

    @property
    def open(self) -> Flags:
        """(e,) edges of one triangle only."""
        return self.uses == 1

    @property
    def overused(self) -> Flags:
        """(e,) edges of more than two triangles."""
        return self.uses > 2

    @property
    def turned(self) -> Flags:
        """(e,) edges whose two triangles disagree about the outside."""
        return (self.uses == 2) & (self.forward != 1)

    @property
    def closed(self) -> bool:
        """Whether every edge runs as often forth as back, so that the surface bounds a solid."""
        return bool(len(self.uses)) and bool((2 * self.forward == self.uses).all())


def sides_of(triangles: NDArray[np.integer], count: int) -> Sides:
    """The sides of triangles (m, 3) over `count` vertices; corners of a triangle must differ."""
    corners = np.asarray(triangles, np.int64).reshape(-1, 3)
    start, end = corners.reshape(-1), corners[:, [1, 2, 0]].reshape(-1)
    key = np.minimum(start, end) * count + np.maximum(start, end)
    known, first, edge = np.unique(key, return_index=True, return_inverse=True)
    ends = np.column_stack((known // max(count, 1), known % max(count, 1)))
    uses = np.bincount(edge, minlength=len(known))
    forward = np.bincount(edge, start < end, len(known)).astype(np.int64)
    return Sides(start, end, edge, ends, uses, forward, first)


def twins(sides: Sides) -> Numbers:
    """(3m,) the side that runs the other way on an edge of two sides; -1 where an edge has none or others."""
    paired = (sides.uses == 2) & (sides.forward == 1)
    mine = np.flatnonzero(paired[sides.edge])
    rows = mine[np.argsort(sides.edge[mine], kind="stable")].reshape(-1, 2)
    found = np.full(len(sides.edge), -1)
    found[rows[:, 0]], found[rows[:, 1]] = rows[:, 1], rows[:, 0]
    return found


def neighbours(sides: Sides) -> tuple[Numbers, Numbers]:
    """Pairs of sides on the same edge, enough to hang all sides of an edge together."""
    order = np.argsort(sides.edge, kind="stable")
    same = np.diff(sides.edge[order]) == 0
    return order[:-1][same], order[1:][same]


def distinct_places(vertices: Floats) -> Numbers:
    """(n,) a number for each vertex, the same for those at exactly one place."""
    order = np.lexsort(vertices.T)
    fresh = np.concatenate(([0], (np.diff(vertices[order], axis=0) != 0.0).any(axis=1))) if len(vertices) else order
    found = np.empty(len(vertices), np.int64)
    found[order] = np.cumsum(fresh)
    return found


def shells(sides: Sides) -> Numbers:
    """(m,) which triangles hang together by edges, numbered by their first triangle."""
    one, two = neighbours(sides)
    return pieces(one // 3, two // 3, len(sides.edge) // 3)


def signed_volume(vertices: Floats, triangles: NDArray[np.integer]) -> Floats:
    """(m,) what each triangle adds to the volume that it bounds with the others, mm³, about the middle of all."""
    if not len(triangles):
        return np.zeros(0)
    middle = (vertices.min(axis=0) + vertices.max(axis=0)) / 2.0
    a, b, c = (vertices[triangles[:, k]] - middle for k in range(3))
    return np.einsum("ij,ij->i", a, np.cross(b, c)) / 6.0


def normals_of(vertices: Floats, triangles: NDArray[np.integer]) -> Floats:
    """(m, 3) vectors along the normals, as long as twice the areas."""
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    return np.cross(b - a, c - a)


def heights_of(vertices: Floats, triangles: NDArray[np.integer]) -> tuple[Floats, Floats]:
    """(m,) the least height of each triangle, mm, and (m, 3) the lengths of its sides."""
    corners = vertices[triangles]
    lengths = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
    longest = lengths.max(axis=1, initial=0.0)
    double = np.linalg.norm(normals_of(vertices, triangles), axis=1)
    return double / np.where(longest > 0.0, longest, 1.0), lengths
