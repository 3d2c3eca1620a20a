"""A mesh's lists as tables to read: vertices, normals, faces with both index lists, edges with their wings."""

from __future__ import annotations

import csv
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import TextIO

import numpy as np
from numpy.typing import NDArray

from .inspected import InspectedMesh
from .lists import Numbers
from .winged import COLUMNS

BETWEEN_LOOPS = " | "
TABLES = ("vertices", "normals", "faces", "edges")
DIGITS = 7
"""Significant ones of a figure that is read, not computed with."""


@dataclass(frozen=True, slots=True, eq=False)
class Column:
    """`key` (n,) is what rows are sorted by; `text` writes a row's cell: its number, what numbers count from, and
    whether figures are wanted exactly."""

    title: str
    tip: str
    key: NDArray
    text: Callable[[int, int, bool], str]
    right: bool = True
    """Whether it reads best at the right, as figures do."""


@dataclass(frozen=True, slots=True, eq=False)
class Table:
    """Rows are numbered as the elements are; `columns` begin with that number."""

    name: str
    columns: tuple[Column, ...]
    count: int

    @property
    def titles(self) -> list[str]:
        return [column.title for column in self.columns]

    def row(self, number: int, first: int = 0, exact: bool = False) -> list[str]:
        """The cells of a row, `first` being what numbers count from."""
        return [column.text(number, first, exact) for column in self.columns]

    def rows(self, numbers: Iterable[int] | None = None, first: int = 0, exact: bool = True) -> Iterator[list[str]]:
        """Those of the rows with these numbers, all by default."""
        for number in range(self.count) if numbers is None else numbers:
            yield self.row(int(number), first, exact)

    def write_csv(self, file: TextIO, numbers: Iterable[int] | None = None, first: int = 0) -> None:
        """Titles, then rows, figures as exact as they are."""
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(self.titles)
        writer.writerows(self.rows(numbers, first))

    def tabbed(self, numbers: Iterable[int] | None = None, first: int = 0) -> str:
        """Titles and rows as spreadsheets paste them."""
        lines = (self.titles, *self.rows(numbers, first))
        return "\n".join("\t".join(line) for line in lines)


@dataclass(frozen=True, slots=True, eq=False)
class Tables:
    """The tables of one mesh; `labels` are the names of its owners."""

    mesh: InspectedMesh
    labels: Sequence[str] = field(default=())

    def of(self, name: str) -> Table:
        """One of TABLES. Raises KeyError."""
        return {
            "vertices": self.vertices,
            "normals": self.normals,
            "faces": self.faces,
            "edges": self.edges,
        }[name]()

    def vertices(self) -> Table:
        mesh = self.mesh
        points = mesh.lists.vertices
        return Table(
            "vertices",
            (
                _number(len(points), "Vertex"),
                *(_figures(axis, f"{axis} in mm", points[:, i]) for i, axis in enumerate("xyz")),
                _numbers("Edges", "How many edges end here", mesh.degree, counted=True),
            ),
            len(points),
        )

    def normals(self) -> Table:
        lists = self.mesh.lists
        normals = lists.normals
        faces = np.bincount(lists.face_normal, minlength=len(normals))
        return Table(
            "normals",
            (
                _number(len(normals), "Normal"),
                *(_figures(axis, f"{axis} of the unit vector", normals[:, i]) for i, axis in enumerate("xyz")),
                _numbers("Faces", "How many faces have this normal", faces, counted=True),
            ),
            len(normals),
        )

    def faces(self) -> Table:
        mesh, lists = self.mesh, self.mesh.lists
        loops = np.diff(lists.face_loops)
        corners = np.diff(lists.loop_starts[lists.face_loops])

        def vertex_list(face: int, first: int, exact: bool) -> str:
            return BETWEEN_LOOPS.join(" ".join(map(str, (loop + first).tolist())) for loop in lists.face(face))

        def normal_list(face: int, first: int, exact: bool) -> str:
            normal = str(int(lists.face_normal[face]) + first)
            return BETWEEN_LOOPS.join(" ".join([normal] * len(loop)) for loop in lists.face(face))

        return Table(
            "faces",
            (
                _number(lists.face_count, "Face"),
                Column("Vertices", "Indices into the list of vertices, counter-clockwise seen from outside; | before a "
                       "hole, which runs clockwise", corners, vertex_list, False),
                Column("Normals", "Indices into the list of normals, one for each vertex", lists.face_normal,
                       normal_list, False),
                _numbers("Corners", "How many vertices the loops have together", corners, counted=True),
                _numbers("Loops", "The outer one and the holes", loops, counted=True),
                _figures("Area", "In mm², without the holes", mesh.area),
                self._makers(),
            ),
            lists.face_count,
        )  # fmt: skip

    def edges(self) -> Table:
        mesh, table = self.mesh, self.mesh.winged.table
        kind = mesh.edge_kind
        return Table(
            "edges",
            (
                _number(len(table), "Edge"),
                *(_numbers(name.capitalize(), WINGS[name], table[:, i]) for i, name in enumerate(COLUMNS)),
                _figures("Length", "In mm", mesh.length),
                _figures("Angle", "By how many degrees the surface turns: positive where it is convex", mesh.bend),
                Column("Kind", "Convex, concave, flat; naked: a face on one side only; non-manifold: more than two",
                       kind, lambda edge, first, exact: str(kind[edge]), False),
            ),
            len(table),
        )  # fmt: skip

    def _makers(self) -> Column:
        maker, labels = self.mesh.maker, [*self.labels, ""]
        names = np.array(labels)

        def label(face: int, first: int, exact: bool) -> str:
            return labels[int(maker[face])]

        return Column("Made by", "The node that made the face", names[maker] if len(maker) else names[:0], label, False)


WINGS = {
    "start": "The vertex that the edge begins at",
    "end": "The vertex that it runs to",
    "left face": "The face on its left, seen from outside; -1: none",
    "right face": "The face on its right; -1: none",
    "left before": "The edge before it on the left face's loop",
    "left after": "The edge after it on the left face's loop",
    "right before": "The edge before it on the right face's loop, which runs from its end to its start",
    "right after": "The edge after it on the right face's loop",
}


def _number(count: int, of: str) -> Column:
    return _numbers(of, "Its number, which the other tables refer to by", np.arange(count))


def _numbers(title: str, tip: str, values: Numbers | NDArray[np.int32], counted: bool = False) -> Column:
    """Of indices, -1 for none, which does not depend on what they count from; or of counts."""

    def text(row: int, first: int, exact: bool) -> str:
        value = int(values[row])
        return str(value if counted or value < 0 else value + first)

    return Column(title, tip, values, text)


def _figures(title: str, tip: str, values: NDArray[np.float64]) -> Column:
    def text(row: int, first: int, exact: bool) -> str:
        value = float(values[row]) + 0.0
        if np.isnan(value):
            return ""
        if exact:
            return repr(value)
        return f"{round(value, 9) + 0.0:.{DIGITS}g}"

    return Column(title, tip, values, text)
