"""Lists of vertices, normals and faces; faces are polygons of one loop or more, the first the outer one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .pieces import pieces

Floats = NDArray[np.float64]
Numbers = NDArray[np.int64]

SAME_PLANE = 1e-5
"""Triangles side by side are one flat face up to this angle, in radians: that of coordinates in single precision."""
SAME_NORMAL = 1e-9
"""Normals of faces are one row of the list where no coordinate differs by more."""


@dataclass(frozen=True, slots=True, eq=False)
class MeshLists:
    """`vertices` (n, 3) in mm; `normals` (m, 3) unit, each different one once.

    `corners` (c,) are vertices by index, loop after loop; `loop_starts` (l + 1,) where each loop begins in them;
    `face_loops` (f + 1,) which loops each face has, and `face_normal` (f,) which normal. Seen from outside the outer
    loop runs counter-clockwise, those of holes clockwise.
    """

    vertices: Floats
    normals: Floats
    corners: Numbers
    loop_starts: Numbers
    face_loops: Numbers
    face_normal: Numbers

    @property
    def face_count(self) -> int:
        return len(self.face_loops) - 1

    @property
    def loop_count(self) -> int:
        return len(self.loop_starts) - 1

    def loop_faces(self) -> Numbers:
        """(l,) the face of each loop."""
        return np.repeat(np.arange(self.face_count), np.diff(self.face_loops))

    def corner_loops(self) -> Numbers:
        """(c,) the loop of each corner."""
        return np.repeat(np.arange(self.loop_count), np.diff(self.loop_starts))

    def loop(self, loop: int) -> Numbers:
        """The vertices of a loop."""
        return self.corners[self.loop_starts[loop] : self.loop_starts[loop + 1]]

    def face(self, face: int) -> list[Numbers]:
        """The loops of a face, the outer one first."""
        return [self.loop(loop) for loop in range(self.face_loops[face], self.face_loops[face + 1])]

    def loop_areas(self) -> Floats:
        """(l, 3) vectors along the loops' normals, as long as their areas (Newell's sum)."""
        after = _after(self.loop_starts)
        crosses = np.cross(self.vertices[self.corners], self.vertices[self.corners[after]]) / 2.0
        return _sums(crosses, self.loop_starts)


def of_polygons(vertices: ArrayLike, faces: Sequence[Sequence[int] | Sequence[Sequence[int]]]) -> MeshLists:
    """Lists of polygons (vertex indices), or of lists of loops where a face has holes."""
    loops: list[Sequence[int]] = []
    counts = []
    for face in faces:
        mine = [face] if len(face) and np.isscalar(face[0]) else list(face)  # type: ignore[list-item]
        loops += mine  # type: ignore[arg-type]
        counts.append(len(mine))
    corners = np.array([vertex for loop in loops for vertex in loop], np.int64)
    starts = np.concatenate(([0], np.cumsum([len(loop) for loop in loops]))).astype(np.int64)
    face_loops = np.concatenate(([0], np.cumsum(counts))).astype(np.int64)
    return of_loops(np.asarray(vertices, float), corners, starts, face_loops)


def of_triangles(vertices: ArrayLike, triangles: ArrayLike) -> MeshLists:
    """Lists of triangles (t, 3)."""
    found = np.asarray(triangles, np.int64)
    count = len(found)
    steps = np.arange(count + 1)
    return of_loops(np.asarray(vertices, float), found.reshape(-1), 3 * steps, steps)


def of_facets(vertices: ArrayLike, triangles: ArrayLike, facet: ArrayLike) -> MeshLists:
    """The lists that `faces_of_facets` finds."""
    return faces_of_facets(vertices, triangles, facet)[0]


def faces_of_facets(vertices: ArrayLike, triangles: ArrayLike, facet: ArrayLike) -> tuple[MeshLists, Numbers]:
    """Lists of the polygons that connected triangles (t, 3) of the same flat face, `facet` (t,), make together, and
    (t,) which face each triangle is of.

    Their loops are the sides between triangles of different groups, chained around each corner through the group's own
    triangles, so that loops which touch in a vertex stay apart. The outer loop is the one with the largest area.
    """
    points, found, group = np.asarray(vertices, float), np.asarray(triangles, np.int64), np.asarray(facet)
    count = len(found)
    if not count:
        return of_triangles(points, found.reshape(0, 3)), np.zeros(0, np.int64)
    starts = found.reshape(-1)
    ends = found[:, [1, 2, 0]].reshape(-1)
    twin = _twins(starts, ends, np.repeat(group, 3))
    piece = _pieces(count, twin)
    sides = np.flatnonzero(twin < 0)
    place = np.empty(3 * count, np.int64)
    place[sides] = np.arange(len(sides))
    order, loop_starts = _chains(place[_around(sides, twin)])
    sides = sides[order]
    corners, loop_piece = starts[sides], piece[sides[loop_starts[:-1]] // 3]
    lists = MeshLists(points, np.zeros((0, 3)), corners, loop_starts, np.zeros(1, np.int64), np.zeros(0, np.int64))
    areas = lists.loop_areas()
    # The whole area of a face has the direction of its outer loop, which is the longest of its vectors.
    whole = np.zeros((int(piece.max()) + 1, 3))
    np.add.at(whole, loop_piece, areas)
    along = np.einsum("ij,ij->i", areas, whole[loop_piece])
    by_face = np.lexsort((-along, loop_piece))
    corners, loop_starts = _reordered(corners, loop_starts, by_face)
    face_loops = np.concatenate(([0], np.cumsum(np.bincount(loop_piece)))).astype(np.int64)
    return of_loops(points, corners, loop_starts, face_loops), piece


def flat_facets(vertices: ArrayLike, triangles: ArrayLike) -> Numbers:
    """(t,) which triangles (t, 3) hang together by sides at which the surface is flat, for `faces_of_facets`, where
    nothing else tells which of them are one face."""
    points, found = np.asarray(vertices, float), np.asarray(triangles, np.int64)
    starts, ends = found.reshape(-1), found[:, [1, 2, 0]].reshape(-1)
    twin = _twins(starts, ends, np.zeros(len(starts), np.int64))
    a, b, c = (points[found[:, corner]] for corner in range(3))
    normal = np.cross(b - a, c - a)
    size = np.linalg.norm(normal, axis=1, keepdims=True)
    normal /= np.where(size > 0.0, size, 1.0)
    side = np.flatnonzero(twin >= 0)
    one, other = normal[side // 3], normal[twin[side] // 3]
    flat = np.einsum("ij,ij->i", one, other) > 0.5
    flat &= np.linalg.norm(np.cross(one, other), axis=1) < SAME_PLANE
    twin[side[~flat]] = -1
    return _pieces(len(found), twin)


def of_loops(vertices: Floats, corners: Numbers, loop_starts: Numbers, face_loops: Numbers) -> MeshLists:
    """With the normals of the faces, which follow from their loops."""
    bare = MeshLists(vertices, np.zeros((0, 3)), corners, loop_starts, face_loops, np.zeros(0, np.int64))
    areas = _sums(bare.loop_areas(), face_loops)
    size = np.linalg.norm(areas, axis=1, keepdims=True)
    unit = areas / np.where(size > 0.0, size, 1.0)
    keys = np.round(unit / SAME_NORMAL).astype(np.int64)
    order = np.lexsort(keys.T)
    fresh = np.concatenate(([True], (np.diff(keys[order], axis=0) != 0).any(axis=1)))[: len(order)]
    which = np.empty(len(order), np.int64)
    which[order] = np.cumsum(fresh) - 1
    first = order[fresh]  # the first face of each, since the sort is stable
    rank = np.empty(len(first), np.int64)  # in the order of the faces
    rank[np.argsort(first)] = np.arange(len(first))
    normals = unit[np.sort(first)]
    return MeshLists(vertices, normals, corners, loop_starts, face_loops, rank[which])


def _after(starts: Numbers) -> Numbers:
    """(c,) the corner after each in its loop."""
    count = int(starts[-1])
    after = np.arange(1, count + 1)
    filled = starts[1:] > starts[:-1]
    after[starts[1:][filled] - 1] = starts[:-1][filled]
    return after


def _sums(rows: Floats, starts: Numbers) -> Floats:
    """Sums of runs of rows; of empty runs 0."""
    run = np.repeat(np.arange(len(starts) - 1), np.diff(starts))
    sums = [np.bincount(run, rows[:, k], len(starts) - 1) for k in range(rows.shape[1])]
    return np.stack(sums, axis=1).astype(np.float64)


def _twins(starts: Numbers, ends: Numbers, group: NDArray) -> Numbers:
    """(h,) the side that runs the other way within the same group, -1 where there is none or more than one pair."""
    low, high = np.minimum(starts, ends), np.maximum(starts, ends)
    order = np.lexsort((starts > ends, high, low, group))
    same = (np.diff(group[order]) == 0) & (np.diff(low[order]) == 0) & (np.diff(high[order]) == 0)
    begins = np.concatenate(([True], ~same))
    size = np.diff(np.append(np.flatnonzero(begins), len(order)))
    first = np.flatnonzero(begins)[size == 2]
    one, other = order[first], order[first + 1]
    opposite = starts[one] == ends[other]
    twin = np.full(len(starts), -1)
    twin[one[opposite]], twin[other[opposite]] = other[opposite], one[opposite]
    return twin


def _pieces(count: int, twin: Numbers) -> Numbers:
    """(t,) which triangles hang together by twins, numbered by their first triangle."""
    sides = np.flatnonzero(twin >= 0)
    return pieces(sides // 3, twin[sides] // 3, count)


def _around(sides: Numbers, twin: Numbers) -> Numbers:
    """For sides of triangles that have no twin, the next such side: the one that leaves where they end."""
    found = 3 * (sides // 3) + (sides + 1) % 3
    inner = np.flatnonzero(twin[found] >= 0)
    while len(inner):
        across = twin[found[inner]]
        found[inner] = 3 * (across // 3) + (across + 1) % 3
        inner = inner[twin[found[inner]] >= 0]
    return found


def _chains(following: Numbers) -> tuple[Numbers, Numbers]:
    """The cycles of a permutation one after another, and where each begins; by their least members."""
    count = len(following)
    if not count:
        return np.zeros(0, np.int64), np.zeros(1, np.int64)
    label = pieces(np.arange(count), following, count)
    first = np.unique(label, return_index=True)[1]
    # How far each is from the first of its cycle, by doubling: what is nearer than `step` is known.
    jump = np.empty(count, np.int64)
    jump[following] = np.arange(count)
    distance, known, step = np.zeros(count, np.int64), np.zeros(count, bool), 1
    known[first] = True
    while not known.all():
        fresh = ~known & known[jump]
        distance[fresh] = distance[jump[fresh]] + step
        known |= fresh
        jump, step = jump[jump], 2 * step
    order = np.lexsort((distance, label))
    sizes = np.bincount(label, minlength=len(first))
    return order, np.concatenate(([0], np.cumsum(sizes))).astype(np.int64)


def _reordered(corners: Numbers, starts: Numbers, order: Numbers) -> tuple[Numbers, Numbers]:
    """Loops in another order."""
    sizes = np.diff(starts)[order]
    new_starts = np.concatenate(([0], np.cumsum(sizes))).astype(np.int64)
    index = np.repeat(starts[:-1][order] - new_starts[:-1], sizes) + np.arange(int(new_starts[-1]))
    return corners[index], new_starts
