"""Operators that change a winged edge and keep it valid: split an edge or a face, collapse and flip an edge.

Euler operators after Baumgart (1975) and Mäntylä (1988, "An Introduction to Solid Modeling"): each changes the numbers
of vertices, edges and faces together, so that V - E + F stays. The condition of the link for collapsing is that of Dey,
Edelsbrunner, Guha and Nekhayev (1999). Every operator takes the time of the stars and loops that it touches.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..document.errors import Refusal
from .winged import END, LEFT, LEFT_AFTER, LEFT_BEFORE, RIGHT, START, WingedEdge

Half = tuple[int, int]
"""An edge and a side of it: 0 from start to end, 1 back."""


class EditedMesh:
    """A winged edge that is changed in place. What an operator takes out keeps its number unused until `result`.

    Every operator raises Refusal, and then changes nothing, where its result would not be a surface any more.
    """

    def __init__(self, mesh: WingedEdge) -> None:
        self._table = mesh.table.copy()
        self._points = mesh.vertices.copy()
        self._edges, self._vertices = len(mesh), len(mesh.vertices)
        self._vertex_edge = mesh.vertex_edge.copy()
        halves = list(zip(mesh.loop_edge.tolist(), mesh.loop_side.tolist(), strict=True))
        bounds = mesh.face_loops.tolist()
        self._loops: list[list[Half]] = [halves[a:b] for a, b in pairwise(bounds)]
        self._copy_of = mesh.copy_of.tolist()
        self._repeated = set(np.flatnonzero(np.bincount(mesh.copy_of, minlength=1) > 1).tolist())

    # Looks.

    def origin(self, half: Half) -> int:
        """The vertex that a side begins at."""
        return int(self._table[half[0], START + half[1]])

    def face(self, half: Half) -> int:
        """-1 where there is none."""
        return int(self._table[half[0], LEFT + half[1]])

    def after(self, half: Half) -> Half:
        """The next side on its face's loop."""
        vertex = self.origin(_twin(half))
        edge = int(self._table[half[0], LEFT_AFTER + 2 * half[1]])
        return edge, int(self._table[edge, START] != vertex)

    def before(self, half: Half) -> Half:
        vertex = self.origin(half)
        edge = int(self._table[half[0], LEFT_BEFORE + 2 * half[1]])
        return edge, int(self._table[edge, END] != vertex)

    def loop(self, half: Half) -> list[Half]:
        """The sides of the loop that one is on, from it on."""
        found, at = [half], self.after(half)
        while at != half:
            found.append(at)
            at = self.after(at)
        return found

    def star(self, vertex: int) -> list[Half]:
        """The sides that leave a vertex, whether or not they have a face, counter-clockwise."""
        edge = int(self._vertex_edge[vertex])
        if edge < 0:
            return []
        first = half = (edge, int(self._table[edge, START] != vertex))
        found = []
        while True:
            found.append(half)
            if self.face(half) < 0:
                return found
            half = _twin(self.before(half))
            if half == first:
                return found

    def half(self, start: int, end: int) -> Half | None:
        """The side from one vertex to another, where there is an edge."""
        return next((half for half in self.star(start) if self.origin(_twin(half)) == end), None)

    # Operators.

    def split_edge(self, edge: int, point: ArrayLike) -> tuple[int, int]:
        """A new vertex (3,) on an edge: the edge ends there, a new one goes on. Their numbers: vertex, new edge."""
        self._alive(edge)
        row = self._table[edge].copy()
        befores = [self.before((edge, side)) if row[LEFT + side] >= 0 else None for side in (0, 1)]
        afters = [self.after((edge, side)) if row[LEFT + side] >= 0 else None for side in (0, 1)]
        far = int(row[END])
        vertex, new = self._new_vertex(point), self._new_edge()
        table = self._table
        table[new, [START, END, LEFT, RIGHT]] = vertex, far, row[LEFT], row[RIGHT]
        table[edge, END] = vertex
        if row[LEFT] >= 0:
            onward = afters[0]
            assert onward is not None
            self._link((edge, 0), (new, 0))
            self._link((new, 0), (edge, 0) if onward == (edge, 0) else (new, 1) if onward == (edge, 1) else onward)
        if row[RIGHT] >= 0:
            back = befores[1]
            assert back is not None
            self._link((new, 1), (edge, 1))
            self._link((edge, 1) if back == (edge, 1) else (new, 0) if back == (edge, 0) else back, (new, 1))
        self._vertex_edge[vertex] = new if row[RIGHT] < 0 else edge
        if self._vertex_edge[far] == edge:
            self._vertex_edge[far] = new
        return vertex, new

    def split_face(self, one: Half, other: Half) -> tuple[int, int]:
        """A new edge between the vertices that two sides of one loop begin at: what runs from `other` to before `one`
        becomes a new face. Their numbers: edge, face."""
        face = self.face(one)
        if face < 0 or len(self._loops[face]) != 1:
            raise Refusal(f"face {face} has holes: the edge could be on either side of them")
        loop = self.loop(one)
        if other not in loop:
            raise Refusal(f"edges {one[0]} and {other[0]} are not on one loop")
        if other in (loop[0], loop[1], loop[-1]):
            raise Refusal("an edge between neighbours would leave a face without a surface")
        start, end = self.origin(one), self.origin(other)
        if start == end or self.half(start, end) is not None:
            raise Refusal(f"vertices {start} and {end} are joined already")
        place = loop.index(other)
        cut = loop[place:]
        before_one, before_other = loop[-1], loop[place - 1]
        edge = self._new_edge()
        fresh = len(self._loops)
        self._table[edge, [START, END, LEFT, RIGHT]] = start, end, fresh, face
        self._link(before_one, (edge, 0))
        self._link((edge, 0), other)
        self._link(before_other, (edge, 1))
        self._link((edge, 1), one)
        for half in cut:
            self._table[half[0], LEFT + half[1]] = fresh
        self._loops[face] = [one]
        self._loops.append([other])
        return edge, fresh

    def flip(self, edge: int) -> None:
        """Turn an edge between two triangles to join their other two corners."""
        self._alive(edge)
        zero, one = (edge, 0), (edge, 1)
        left, right = self.face(zero), self.face(one)
        if min(left, right) < 0:
            raise Refusal(f"edge {edge} is at the border")
        if left == right or any(len(self.loop(half)) != 3 or len(self._loops[self.face(half)]) != 1
                                for half in (zero, one)):  # fmt: skip
            raise Refusal(f"the faces beside edge {edge} are not two triangles")
        next_left, last_left = self.after(zero), self.before(zero)
        next_right, last_right = self.after(one), self.before(one)
        c, d = self.origin(last_left), self.origin(last_right)
        if c == d or self.half(c, d) is not None:
            raise Refusal(f"vertices {c} and {d} are joined already")
        ends = self.origin(zero), self.origin(one)
        if any(len(self.star(vertex)) <= 3 and not self._at_border(vertex) for vertex in ends):
            raise Refusal(f"a corner of edge {edge} would be left with two edges")
        a, b = ends
        self._table[edge, [START, END]] = d, c
        for half, face in ((next_right, left), (next_left, right)):
            self._table[half[0], LEFT + half[1]] = face
        for ring in ((zero, last_left, next_right), (one, last_right, next_left)):
            for this, following in zip(ring, ring[1:] + ring[:1], strict=True):
                self._link(this, following)
        self._loops[left], self._loops[right] = [zero], [one]
        for vertex, instead in ((a, last_left[0]), (b, last_right[0])):
            if self._vertex_edge[vertex] == edge:
                self._vertex_edge[vertex] = instead

    def collapse(self, edge: int, point: ArrayLike | None = None) -> int:
        """Put the end of an edge into its start, which comes to `point` (the middle by default); triangles beside it
        vanish. The number of the vertex that stays."""
        self._alive(edge)
        zero, one = (edge, 0), (edge, 1)
        a, b = self.origin(zero), self.origin(one)
        self._check_collapse(edge, a, b)
        spokes = [half for half in self.star(b) if half[0] != edge]
        loops = [self.loop(half) for half in (zero, one) if self.face(half) >= 0]
        for half in spokes:  # first of all: sides are told apart by where they begin and end
            self._table[half[0], START + half[1]] = a
        dead = [edge]
        for number in range(len(loops)):
            loop = loops[number]
            half, face = loop[0], self.face(loop[0])
            if len(loop) > 3:
                self._link(loop[-1], loop[1])
                self._loops[face] = [loop[1] if known == half else known for known in self._loops[face]]
                continue
            # Of the two other sides the one that was at b gives its place to the one at a.
            gone, kept = (loop[1], loop[2]) if half == zero else (loop[2], loop[1])
            outer = _twin(gone)
            beyond = self.face(outer)
            if beyond >= 0:
                first, last = self.before(outer), self.after(outer)
                self._loops[beyond] = [kept if known == outer else known for known in self._loops[beyond]]
                self._table[kept[0], LEFT + kept[1]] = beyond
                self._link(first, kept)
                self._link(kept, last)
            else:
                columns = [LEFT + kept[1], LEFT_BEFORE + 2 * kept[1], LEFT_AFTER + 2 * kept[1]]
                self._table[kept[0], columns] = -1
            self._loops[face] = []
            loops[-1] = [kept if known == outer else known for known in loops[-1]]  # where both faces share `gone`
            dead.append(gone[0])
            corner = self.origin(loop[2])
            if self._vertex_edge[corner] == gone[0]:
                self._vertex_edge[corner] = kept[0]
        self._points[a] = 0.5 * (self._points[a] + self._points[b]) if point is None else point
        self._table[dead] = -1
        self._vertex_edge[b] = -1
        mine = self._vertex_edge[a]
        if mine in dead:
            near = [half for half in spokes if half[0] not in dead] or self._touching(a)
            self._vertex_edge[a] = near[0][0]
        self._begin_at_border(a)
        for half in self.star(a):
            self._begin_at_border(self.origin(_twin(half)))
        return a

    def result(self) -> WingedEdge:
        """What there is now, numbered without gaps."""
        used = np.flatnonzero(self._table[: self._edges, START] >= 0)
        edge_of = np.full(self._edges + 1, -1)  # the last one for -1
        edge_of[used] = np.arange(len(used))
        held = np.flatnonzero(self._vertex_edge[: self._vertices] >= 0)
        vertex_of = np.full(self._vertices, -1)
        vertex_of[held] = np.arange(len(held))
        faces = [face for face, loops in enumerate(self._loops) if loops]
        face_of = np.full(len(self._loops) + 1, -1)
        face_of[faces] = np.arange(len(faces))
        table = self._table[used].astype(np.int64)
        table[:, [START, END]] = vertex_of[table[:, [START, END]]]
        table[:, [LEFT, RIGHT]] = face_of[table[:, [LEFT, RIGHT]]]
        table[:, LEFT_BEFORE:] = edge_of[table[:, LEFT_BEFORE:]]
        halves = np.array([half for face in faces for half in self._loops[face]], np.int64).reshape(-1, 2)
        counts = [len(self._loops[face]) for face in faces]
        firsts: dict[int, int] = {}
        copies = [firsts.setdefault(self._copy_of[edge], number) for number, edge in enumerate(used.tolist())]
        return WingedEdge(
            self._points[held],
            table.astype(np.int32),
            edge_of[halves[:, 0]],
            halves[:, 1],
            np.concatenate(([0], np.cumsum(counts))).astype(np.int64),
            edge_of[self._vertex_edge[held]],
            np.array(copies, np.int64),
        )

    def live_edges(self) -> NDArray[np.int64]:
        """The numbers of the edges that there are."""
        return np.flatnonzero(self._table[: self._edges, START] >= 0)

    def live_faces(self) -> list[int]:
        return [face for face, loops in enumerate(self._loops) if loops]

    def sides(self, face: int) -> list[Half]:
        """The sides of a face's outer loop."""
        return self.loop(self._loops[face][0])

    # Inside.

    def _check_collapse(self, edge: int, a: int, b: int) -> None:
        if a == b:
            raise Refusal(f"edge {edge} has one vertex only")
        halves = [half for half in ((edge, 0), (edge, 1)) if self.face(half) >= 0]
        if self._at_border(a) and self._at_border(b) and len(halves) == 2:
            raise Refusal(f"edge {edge} joins two borders: they would touch")
        around = [{self.origin(_twin(half)) for half in self.star(vertex)} for vertex in (a, b)]
        faces = [set(self._faces_at(vertex)) for vertex in (a, b)]
        beside = {self.face(half) for half in halves}
        if len(beside) < len(halves) or faces[0] & faces[1] != beside:
            raise Refusal(f"another face has both ends of edge {edge}")
        thirds: set[int] = set()
        for half in halves:
            loop = self.loop(half)
            if len(loop) == 3:
                third = self.origin(loop[2])
                least = 2 if self._at_border(third) else 3
                if len(self.star(third)) <= least or len(self._loops[self.face(half)]) != 1:
                    raise Refusal(f"vertex {third} would be left with too few edges")
                if self.face(_twin(loop[1])) < 0 and self.face(_twin(loop[2])) < 0:
                    raise Refusal(f"the face beside edge {edge} hangs on it alone")
                if third in thirds:
                    raise Refusal(f"both faces beside edge {edge} have the same corners")
                thirds.add(third)
        if around[0] & around[1] != thirds:
            raise Refusal(f"the ends of edge {edge} have another neighbour in common: the surface would be pinched")

    def _faces_at(self, vertex: int) -> Iterator[int]:
        for half in self.star(vertex):
            if self.face(half) >= 0:
                yield self.face(half)

    def _at_border(self, vertex: int) -> bool:
        return any(self.face(half) < 0 or self.face(_twin(half)) < 0 for half in self.star(vertex))

    def _touching(self, vertex: int) -> list[Half]:
        ends = self._table[: self._edges, [START, END]]
        return [(int(edge), int(side)) for edge, side in np.argwhere(ends == vertex)]

    def _begin_at_border(self, vertex: int) -> None:
        """Let a vertex know the edge at which its star begins."""
        edge = int(self._vertex_edge[vertex])
        first = half = (edge, int(self._table[edge, START] != vertex))
        while self.face(_twin(half)) >= 0:
            half = self.after(_twin(half))
            if half == first:
                return
        self._vertex_edge[vertex] = half[0]

    def _alive(self, edge: int) -> None:
        if not 0 <= edge < self._edges or self._table[edge, START] < 0:
            raise Refusal(f"there is no edge {edge}")
        if self._copy_of[edge] in self._repeated:
            raise Refusal(f"more than two faces meet at edge {edge}")

    def _link(self, half: Half, following: Half) -> None:
        self._table[half[0], LEFT_AFTER + 2 * half[1]] = following[0]
        self._table[following[0], LEFT_BEFORE + 2 * following[1]] = half[0]

    def _new_edge(self) -> int:
        if self._edges == len(self._table):
            grown = np.full((max(2 * self._edges, 16), 8), -1, self._table.dtype)
            grown[: self._edges] = self._table
            self._table = grown
        self._copy_of.append(self._edges)
        self._edges += 1
        return self._edges - 1

    def _new_vertex(self, point: ArrayLike) -> int:
        if self._vertices == len(self._points):
            room = max(2 * self._vertices, 16)
            points, edges = np.zeros((room, 3)), np.full(room, -1)
            points[: self._vertices], edges[: self._vertices] = self._points, self._vertex_edge
            self._points, self._vertex_edge = points, edges
        self._points[self._vertices] = point
        self._vertices += 1
        return self._vertices - 1


def _twin(half: Half) -> Half:
    return half[0], 1 - half[1]
