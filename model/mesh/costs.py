"""What representations of a mesh cost: bytes, and the time of the questions that are asked of them, measured.

The trade of memory for time that textbooks draw up (Weiler 1985, "Edge-based data structures for solid modeling in
curved-surface environments"): what a structure does not hold has to be searched for.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .inspected import InspectedMesh
from .lists import Floats, Numbers
from .winged import END, LEFT, RIGHT, START

QUESTIONS = ("corners of a face", "edges at a vertex", "neighbours of a face", "faces of an edge")
REPRESENTATIONS = ("triangle soup", "face lists", "face lists and edge list", "winged edge")
LONGEST = 0.15  # seconds that one question is measured for
MOST = 400  # elements that it is asked of
SEED = 7


@dataclass(frozen=True, slots=True)
class Cost:
    """`nbytes` of all arrays; `seconds` for one answer, by QUESTIONS; `searches` whether all rows are looked at."""

    name: str
    holds: str
    nbytes: int
    seconds: tuple[float, ...]
    searches: tuple[bool, ...]


class Answers:
    """The QUESTIONS put to one representation: `corners(face)` vertices, `star(vertex)` neighbouring vertices,
    `neighbours(face)` faces, `sides(edge)` faces; the order of what is found does not count."""

    name: str
    holds: str
    nbytes: int
    searches: tuple[bool, ...]

    def corners(self, face: int) -> Sequence[int] | NDArray:
        raise AssertionError(type(self).__name__)

    def star(self, vertex: int) -> Sequence[int] | NDArray:
        raise AssertionError(type(self).__name__)

    def neighbours(self, face: int) -> Sequence[int] | NDArray:
        raise AssertionError(type(self).__name__)

    def sides(self, edge: int) -> Sequence[int] | NDArray:
        raise AssertionError(type(self).__name__)


class Soup(Answers):
    """Three points for each triangle and nothing else; what belongs together has equal coordinates. Its faces are the
    triangles, its answers points (k, 3) where others give vertices."""

    name, holds = REPRESENTATIONS[0], "3 points a triangle"
    searches = (False, True, True, True)

    def __init__(self, mesh: InspectedMesh) -> None:
        self._mesh = mesh
        self.points: Floats = mesh.lists.vertices[mesh.triangles]  # (t, 3, 3)
        self.nbytes = self.points.nbytes

    def corners(self, face: int) -> NDArray:
        return self.points[face]

    def star(self, vertex: int) -> NDArray:
        point = self._mesh.lists.vertices[vertex]
        at = self._at(point)
        around = self.points[at.any(axis=1)].reshape(-1, 3)
        return np.unique(around[(around != point).any(axis=1)], axis=0)

    def neighbours(self, face: int) -> NDArray:
        shared = sum((self._at(point).any(axis=1).astype(np.int8) for point in self.points[face]), np.int8(0))
        return np.setdiff1d(np.flatnonzero(shared == 2), face)

    def sides(self, edge: int) -> NDArray:
        start, end = self._mesh.lists.vertices[self._mesh.winged.table[edge, [START, END]]]
        return np.flatnonzero(self._at(start).any(axis=1) & self._at(end).any(axis=1))

    def _at(self, point: Floats) -> NDArray[np.bool_]:
        """(t, 3) which corners stand at a point."""
        points = self.points
        return (points[..., 0] == point[0]) & (points[..., 1] == point[1]) & (points[..., 2] == point[2])


class FaceLists(Answers):
    """Vertices, normals, and faces as loops of indices; edges are sides of faces that have to be found."""

    name, holds = REPRESENTATIONS[1], "vertices, normals, loops of indices"
    searches = (False, True, True, True)

    def __init__(self, mesh: InspectedMesh) -> None:
        self._mesh, lists = mesh, mesh.lists
        self._lists = lists
        self._loop_faces, self._corner_loops = lists.loop_faces(), lists.corner_loops()
        after = np.arange(1, len(lists.corners) + 1)
        after[lists.loop_starts[1:] - 1] = lists.loop_starts[:-1]
        self._after = after
        arrays = (lists.vertices, lists.normals, lists.corners, lists.loop_starts, lists.face_loops, lists.face_normal)
        self.nbytes = sum(array.nbytes for array in arrays)

    def corners(self, face: int) -> NDArray:
        lists = self._lists
        return lists.corners[lists.loop_starts[lists.face_loops[face]] : lists.loop_starts[lists.face_loops[face + 1]]]

    def star(self, vertex: int) -> NDArray:
        corners = self._lists.corners
        here = np.flatnonzero(corners == vertex)
        before = np.flatnonzero(corners[self._after] == vertex)
        return np.unique(np.concatenate((corners[self._after[here]], corners[before])))

    def neighbours(self, face: int) -> NDArray:
        lists = self._lists
        corners, ends = lists.corners, lists.corners[self._after]
        begin, end = lists.loop_starts[lists.face_loops[face]], lists.loop_starts[lists.face_loops[face + 1]]
        count = len(lists.vertices)
        mine = ends[begin:end] * count + corners[begin:end]  # as the other face runs along them
        found = np.flatnonzero(np.isin(corners * count + ends, mine))
        return np.setdiff1d(self._face_of(found), face)

    def sides(self, edge: int) -> NDArray:
        start, end = self._mesh.winged.table[edge, [START, END]]
        corners, ends = self._lists.corners, self._lists.corners[self._after]
        found = np.flatnonzero(((corners == start) & (ends == end)) | ((corners == end) & (ends == start)))
        return self._face_of(found)

    def _face_of(self, corners: Numbers) -> Numbers:
        return self._loop_faces[self._corner_loops[corners]]


class EdgeList(FaceLists):
    """Face lists, and for each edge its two vertices and its two faces: what lies beside a face is still searched."""

    name, holds = REPRESENTATIONS[2], "and of each edge 2 vertices, 2 faces"
    searches = (False, True, True, False)

    def __init__(self, mesh: InspectedMesh) -> None:
        super().__init__(mesh)
        self._ends = np.ascontiguousarray(mesh.winged.table[:, [START, END]])
        self._sides = np.ascontiguousarray(mesh.winged.table[:, [LEFT, RIGHT]])
        self.nbytes += self._ends.nbytes + self._sides.nbytes

    def star(self, vertex: int) -> NDArray:
        start, end = self._ends[:, 0], self._ends[:, 1]
        return np.unique(np.concatenate((end[start == vertex], start[end == vertex])))

    def neighbours(self, face: int) -> NDArray:
        left, right = self._sides[:, 0], self._sides[:, 1]
        found = np.concatenate((right[left == face], left[right == face]))
        return np.setdiff1d(found[found >= 0], face)

    def sides(self, edge: int) -> NDArray:
        found = self._sides[edge]
        return found[found >= 0]


class Wings(Answers):
    """The winged edge, which has an edge of each vertex and of each loop and walks on from there."""

    name, holds = REPRESENTATIONS[3], "vertices, 8 columns an edge, 1 edge a loop"
    searches = (False, False, False, False)

    def __init__(self, mesh: InspectedMesh) -> None:
        self._winged = mesh.winged
        self.nbytes = mesh.winged.nbytes + mesh.winged.vertices.nbytes

    def corners(self, face: int) -> list[int]:
        return [vertex for loop in self._loops(face) for vertex in self._winged.loop_vertices(loop)]

    def star(self, vertex: int) -> list[int]:
        table = self._winged.table
        return [int(table[edge, END if table[edge, START] == vertex else START]) for edge in self._winged.star(vertex)]

    def neighbours(self, face: int) -> list[int]:
        table = self._winged.table
        found = {int(table[edge, RIGHT - side]) for loop in self._loops(face) for edge, side in self._winged.loop(loop)}
        return list(found - {-1, face})

    def sides(self, edge: int) -> list[int]:
        row = self._winged.table[edge]
        return [int(face) for face in row[[LEFT, RIGHT]] if face >= 0]

    def _loops(self, face: int) -> range:
        return range(int(self._winged.face_loops[face]), int(self._winged.face_loops[face + 1]))


KINDS = (Soup, FaceLists, EdgeList, Wings)


def sizes(mesh: InspectedMesh) -> dict[str, int]:
    """The bytes of each of REPRESENTATIONS."""
    return {kind.name: kind(mesh).nbytes for kind in KINDS}


def costs(mesh: InspectedMesh, longest: float = LONGEST) -> list[Cost]:
    """By REPRESENTATIONS, what each holds and how long an answer takes on average; `longest` seconds a question."""
    found = []
    for kind in KINDS:
        answers: Answers = kind(mesh)
        faces = len(mesh.triangles) if kind is Soup else mesh.lists.face_count
        asked = (
            (answers.corners, np.arange(faces)),
            (answers.star, np.flatnonzero(mesh.degree)),
            (answers.neighbours, np.arange(faces)),
            (answers.sides, np.arange(len(mesh.winged))),
        )
        seconds = tuple(_seconds(question, members, longest) for question, members in asked)
        found.append(Cost(kind.name, kind.holds, answers.nbytes, seconds, kind.searches))
    return found


def _seconds(question: Callable[[int], object], members: Numbers, longest: float) -> float:
    """The mean time of an answer, over elements drawn evenly."""
    if not len(members):
        return float("nan")
    drawn = np.random.default_rng(SEED).choice(members, min(MOST, len(members)), replace=False).tolist()
    question(drawn[0])  # what the first call has to get ready does not count
    begin = time.perf_counter()
    done = 0
    for member in drawn:
        question(member)
        done += 1
        if time.perf_counter() - begin > longest:
            break
    return (time.perf_counter() - begin) / done
