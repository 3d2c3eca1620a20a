"""The winged edge: for each edge its two ends, the faces on both sides, and the edges before and after it on each.

After Baumgart (1975), "A polyhedron representation for computer vision". Eight columns of one integer array; what is
not there is -1. A face knows one edge of each of its loops, a vertex one edge of its star, and from there every walk
takes one look at the table a step.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .lists import MeshLists, Numbers, of_loops

START, END, LEFT, RIGHT, LEFT_BEFORE, LEFT_AFTER, RIGHT_BEFORE, RIGHT_AFTER = range(8)
COLUMNS = ("start", "end", "left face", "right face", "left before", "left after", "right before", "right after")


@dataclass(frozen=True, slots=True, eq=False)
class WingedEdge:
    """`table` (e, 8) by COLUMNS: an edge runs from start to end along its left face, against the way of its right one;
    `before` and `after` are the edges next to it on a face's loop.

    `vertices` (n, 3); `loop_edge` and `loop_side` (l,) are one edge of each loop and whether the loop has it on its
    left (0) or its right (1); `face_loops` (f + 1,) which loops each face has, the first the outer one; `vertex_edge`
    (n,) one edge of each vertex, at the border of the surface where it is on it. `copy_of` (e,) is the first of the
    edges that stand for one pair of vertices, where more than two faces meet or two run the same way; else the edge
    itself.
    """

    vertices: NDArray[np.float64]
    table: NDArray[np.int32]
    loop_edge: Numbers
    loop_side: Numbers
    face_loops: Numbers
    vertex_edge: Numbers
    copy_of: Numbers

    def __len__(self) -> int:
        return len(self.table)

    @property
    def face_count(self) -> int:
        return len(self.face_loops) - 1

    @property
    def nbytes(self) -> int:
        """Of all arrays but the vertices."""
        arrays = (self.table, self.loop_edge, self.loop_side, self.face_loops, self.vertex_edge, self.copy_of)
        return sum(array.nbytes for array in arrays)

    # Walks: each step is one look at the table.

    def loop(self, loop: int) -> list[tuple[int, int]]:
        """(edge, side) of a loop in its order; side 0: the loop runs from the edge's start to its end."""
        table = self.table
        edge, side = int(self.loop_edge[loop]), int(self.loop_side[loop])
        first, found = (edge, side), [(edge, side)]
        while True:
            vertex = int(table[edge, END - side])
            edge = int(table[edge, LEFT_AFTER + 2 * side])
            side = self._side_from(edge, vertex)
            if (edge, side) == first:
                return found
            found.append((edge, side))

    def loop_vertices(self, loop: int) -> list[int]:
        return [int(self.table[edge, START + side]) for edge, side in self.loop(loop)]

    def star(self, vertex: int) -> list[int]:
        """The edges at a vertex, counter-clockwise seen from outside; of several fans that meet there, one."""
        first = edge = int(self.vertex_edge[vertex])
        found: list[int] = []
        while edge >= 0:
            found.append(edge)
            edge = self.turned(edge, vertex)
            if edge == first:
                break
        return found

    def turned(self, edge: int, vertex: int) -> int:
        """The next edge counter-clockwise about one of an edge's ends; -1 past the border."""
        row = self.table[edge]
        return int(row[LEFT_BEFORE] if row[START] == vertex else row[RIGHT_BEFORE])

    def turned_back(self, edge: int, vertex: int) -> int:
        """The next edge clockwise about one of an edge's ends; -1 past the border."""
        row = self.table[edge]
        return int(row[RIGHT_AFTER] if row[START] == vertex else row[LEFT_AFTER])

    def border(self, edge: int) -> list[int]:
        """The edges of the border that an edge without a face on one side is on, as a face that closed the hole would
        run along them."""
        found = [edge]
        while True:
            at = found[-1]
            vertex = int(self.table[at, START] if self.table[at, RIGHT] < 0 else self.table[at, END])
            # Turn about that end through the faces, until an edge has nothing beyond it.
            while True:
                onward = self.turned(at, vertex)
                if onward < 0:
                    break
                at = onward
            if at == edge:
                return found
            found.append(at)

    def _side_from(self, edge: int, vertex: int) -> int:
        """On which side a loop has an edge that it enters at this vertex."""
        return 0 if self.table[edge, START] == vertex else 1

    # Back to lists.

    def lists(self) -> MeshLists:
        """The same faces, each loop from the edge that it knows on."""
        count = len(self.loop_edge)
        if not count:
            return of_loops(self.vertices, np.zeros(0, np.int64), np.zeros(1, np.int64), self.face_loops)
        edge, side = self.loop_edge.copy(), self.loop_side.copy()
        loops, rounds, corners = [], [], []
        active, step = np.arange(count), 0
        while len(active):
            corners.append(self.table[edge[active], START + side[active]].astype(np.int64))
            loops.append(active)
            rounds.append(np.full(len(active), step))
            vertex = self.table[edge[active], END - side[active]]
            edge[active] = self.table[edge[active], LEFT_AFTER + 2 * side[active]]
            side[active] = (self.table[edge[active], START] != vertex).astype(np.int64)
            done = (edge[active] == self.loop_edge[active]) & (side[active] == self.loop_side[active])
            active, step = active[~done], step + 1
        loop = np.concatenate(loops)
        order = np.lexsort((np.concatenate(rounds), loop))
        starts = np.concatenate(([0], np.cumsum(np.bincount(loop, minlength=count)))).astype(np.int64)
        return of_loops(self.vertices, np.concatenate(corners)[order], starts, self.face_loops)


def winged_edge(lists: MeshLists) -> WingedEdge:
    """Of lists of faces whose loops have two corners at least. Sides that run both ways between two vertices are put
    together in their order; where that leaves one over, its edge has no right face."""
    corners, starts = lists.corners, lists.loop_starts
    count = len(corners)
    after, before = _neighbours(starts)
    ends = corners[after]
    twin, group = _paired(corners, ends, len(lists.vertices))
    # An edge belongs to the first of its sides; that one has it on the left.
    side = np.arange(count)
    leads = (twin < 0) | (side < twin)
    edge = np.empty(count, np.int64)
    edge[leads] = np.arange(int(leads.sum()))
    follows = np.flatnonzero(~leads)
    edge[follows] = edge[twin[follows]]
    left = np.flatnonzero(leads)
    right = twin[left]
    face = np.repeat(lists.loop_faces(), np.diff(starts))
    table = np.empty((len(left), 8), np.int32)
    table[:, START], table[:, END] = corners[left], ends[left]
    table[:, LEFT], table[:, LEFT_BEFORE], table[:, LEFT_AFTER] = face[left], edge[before[left]], edge[after[left]]
    has = right >= 0
    for column, values in ((RIGHT, face), (RIGHT_BEFORE, edge[before]), (RIGHT_AFTER, edge[after])):
        table[:, column] = np.where(has, values[right], -1)
    vertex_edge = np.full(len(lists.vertices), -1)
    vertex_edge[corners[::-1]] = edge[::-1]
    border = np.flatnonzero(twin < 0)  # with nothing on its right, where a star begins
    vertex_edge[corners[border]] = edge[border]
    first = starts[:-1]
    loop_side = (~leads[first]).astype(np.int64)
    return WingedEdge(
        lists.vertices, table, edge[first], loop_side, lists.face_loops, vertex_edge, _copies(group[left])
    )


def reversed_edges(mesh: WingedEdge, edges: NDArray[np.integer]) -> WingedEdge:
    """With these edges the other way round: their ends, faces and wings change places."""
    table = mesh.table.copy()
    swapped = [END, START, RIGHT, LEFT, RIGHT_BEFORE, RIGHT_AFTER, LEFT_BEFORE, LEFT_AFTER]
    table[edges] = table[edges][:, swapped]
    side = mesh.loop_side.copy()
    turned = np.zeros(len(table), bool)
    turned[edges] = True
    side[turned[mesh.loop_edge]] ^= 1
    return WingedEdge(mesh.vertices, table, mesh.loop_edge, side, mesh.face_loops, mesh.vertex_edge, mesh.copy_of)


def _neighbours(starts: Numbers) -> tuple[Numbers, Numbers]:
    """(c,) the corners after and before each in its loop."""
    count = int(starts[-1])
    after, before = np.arange(1, count + 1), np.arange(-1, count - 1)
    filled = starts[1:] > starts[:-1]
    first, last = starts[:-1][filled], starts[1:][filled] - 1
    after[last], before[first] = first, last
    return after, before


def _paired(starts: Numbers, ends: Numbers, count: int) -> tuple[Numbers, Numbers]:
    """(h,) the side against each side, -1 for none; and (h,) a number for each pair of vertices.

    Sides of one pair of vertices lie together when they are sorted, those from the lesser to the greater first: in each
    run the k-th of the ones is put to the k-th of the others.
    """
    low, high = np.minimum(starts, ends), np.maximum(starts, ends)
    key = (low * count + high) * 2 + (starts > ends)
    order = np.argsort(key, kind="stable")
    ordered = key[order]
    pair = ordered >> 1
    fresh = np.concatenate(([True], pair[1:] != pair[:-1])) if len(pair) else np.zeros(0, bool)
    run = np.cumsum(fresh) - 1
    begin = np.flatnonzero(fresh)
    backward = (ordered & 1).astype(bool)
    size = np.diff(np.append(begin, len(order)))
    turns = np.add.reduceat(backward.astype(np.int64), begin) if len(begin) else np.zeros(0, np.int64)
    forward = size - turns
    place = np.arange(len(order)) - begin[run]  # in the run
    rank = np.where(backward, place - forward[run], place)
    has = rank < np.where(backward, forward[run], turns[run])
    other = begin[run] + np.where(backward, rank, rank + forward[run])
    twin = np.full(len(starts), -1)
    twin[order[has]] = order[other[has]]
    group = np.empty(len(starts), np.int64)
    group[order] = run
    return twin, group


def _copies(group: Numbers) -> Numbers:
    """(e,) the first edge of each one's group."""
    first = np.full(int(group.max(initial=-1)) + 1, len(group))
    np.minimum.at(first, group, np.arange(len(group)))
    return first[group]
