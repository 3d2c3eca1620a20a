"""Wavefront OBJ: objects and groups, with colours from the vertices or from the material file beside it.

The format has no unit; coordinates are taken for millimetres.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from ..document.colours import rgb
from ..document.errors import Refusal
from .parts import Part, check_parts, check_total, fan, make_part, only_colour, words_of
from .solids import OutSolid, lines, plain_name

Fetch = Callable[[str], bytes | None]
"""Gives the bytes of a file beside the OBJ by its name, or None."""
_Triangles = NDArray[np.int64]


@dataclass
class _Rows:
    """Lines of one kind, in file order, and for each run of them the first line and the vertices before it."""

    rows: list[bytes] = field(default_factory=list)
    runs: list[tuple[int, int, int]] = field(default_factory=list)
    """(how many rows, first line, vertices so far)"""
    materials: set[str] = field(default_factory=set)

    def add(self, rows: list[bytes], line: int, before: int) -> None:
        self.rows += rows
        self.runs.append((len(rows), line, before))

    def line(self, row: int) -> int:
        for size, line, _ in self.runs:
            if row < size:
                return line + row
            row -= size
        raise IndexError(row)


_Mesh = tuple[_Rows, _Triangles, NDArray[np.int64]]
"""Lines, triangles, and the vertices that those use."""


def read_obj(data: bytes, fetch: Fetch | None = None) -> list[Part]:
    """A part for each object (`o`), in file order. Raises Refusal.

    An object whose groups (`g`) are each closed gives a part for each of them; otherwise its groups are taken for
    regions of one surface.
    """
    points, faces = _Rows(), dict[tuple[str, str], _Rows]()
    materials: dict[str, str] = {}
    place, material, line = ("", ""), "", 1
    for word, run in groupby(re.sub(rb"\\\r?\n", b" ", data).split(b"\n"), key=_word):
        found = list(run)
        if word == b"v":
            points.add(found, line, 0)
        elif word == b"f":
            rows = faces.setdefault(place, _Rows())
            rows.add(found, line, len(points.rows))
            rows.materials.add(material)
        elif word in (b"o", b"g"):
            name = _rest(found[-1])
            place = (name, "") if word == b"o" else (place[0], name)
        elif word == b"usemtl":
            material = _rest(found[-1])
        elif word == b"mtllib" and fetch is not None and not materials:
            materials = _materials(fetch(_rest(found[0])) or b"")
        line += len(found)
    check_parts(len(faces))
    vertices = _points(points)
    meshes = {place: (rows, *_corners(rows, len(vertices))) for place, rows in faces.items()}
    check_total(sum(len(triangles) for _, triangles, _ in meshes.values()))
    parts: list[Part] = []
    for name in dict.fromkeys(name for name, _ in meshes):
        groups = [(group, mesh) for (owner, group), mesh in meshes.items() if owner == name]
        single = [_part(group or name, [mesh], vertices, materials) for group, mesh in groups]
        if len(single) > 1 and not all(part.closed for part in single):
            single = [_part(name or groups[0][0], [mesh for _, mesh in groups], vertices, materials)]
        parts += single
    return parts


def _word(row: bytes) -> bytes:
    words = row.split(None, 1)
    return words[0] if words else b""


def _rest(row: bytes) -> str:
    words = row.split(None, 1)
    return words[1].strip().decode("utf-8", "replace") if len(words) > 1 else ""


def _points(points: _Rows) -> NDArray[np.float64]:
    """(n, 3), or (n, 6) with red, green and blue behind the place."""
    sizes = {len(row.split()) for row in points.rows}
    values = _numbers(b" ".join(row.strip()[1:] for row in points.rows), float)
    if (
        len(sizes) == 1
        and values is not None
        and min(sizes) >= 4
        and len(values) == (min(sizes) - 1) * len(points.rows)
    ):
        table = values.reshape(len(points.rows), -1)
        return table[:, :6] if table.shape[1] >= 6 else table[:, :3]
    table = np.zeros((len(points.rows), 3))
    for i, row in enumerate(points.rows):
        try:
            table[i] = [float(word) for word in row.split()[1:4]]
        except ValueError:
            raise Refusal(f"line {points.line(i):,}: {words_of(row)} is no vertex of three numbers") from None
    return table


def _corners(faces: _Rows, count: int) -> tuple[_Triangles, NDArray[np.int64]]:
    """The faces as triangles (m, 3), and the vertices that they use."""
    rows = [row.split(b"#", 1)[0].strip() for row in faces.rows]
    joined = b" ".join(row[1:] for row in rows)
    if b"/" in joined:
        joined = re.sub(rb"/\S*", b"", joined)  # of 5/2/7 only the vertex is of interest
    sizes = np.array([len(row.split()) - 1 for row in rows], dtype=np.int64)
    corners = _numbers(joined, np.int64)
    if corners is None or len(corners) != sizes.sum():
        for i, row in enumerate(rows):
            if not all(re.fullmatch(rb"[-+]?\d{1,10}(/\S*)?", word) for word in row.split()[1:]):
                raise Refusal(f"line {faces.line(i):,}: {words_of(row)} is no face of vertex numbers")
        raise Refusal(f"the faces from line {faces.line(0):,} on cannot be read")
    # Numbers count from 1, negative ones from the last vertex so far.
    ends = np.cumsum(sizes)
    before = np.repeat(np.repeat([run[2] for run in faces.runs], [run[0] for run in faces.runs]), sizes)
    whole = np.where(corners < 0, corners + before, corners - 1)
    wrong = np.flatnonzero((whole < 0) | (whole >= count))
    if len(wrong):
        line = faces.line(int(np.searchsorted(ends, wrong[0], side="right")))
        raise Refusal(f"line {line:,}: the face asks for vertex {corners[wrong[0]]}; there are {count:,}")
    triangles = fan(whole, sizes)
    return triangles, _used(triangles, count)


def _used(triangles: _Triangles, count: int) -> NDArray[np.int64]:
    if 8 * triangles.size < count:  # of a part that is small beside the file
        return np.unique(triangles)
    used = np.zeros(count, dtype=bool)
    used[triangles] = True
    return np.flatnonzero(used)


def _numbers(text: bytes, kind: type) -> NDArray | None:
    try:
        return np.fromstring(text, dtype=kind, sep=" ")  # type: ignore[call-overload]
    except (ValueError, DeprecationWarning):
        return None


def _part(name: str, meshes: Sequence[_Mesh], vertices: NDArray[np.float64], materials: dict[str, str]) -> Part:
    used = {material for rows, _, _ in meshes for material in rows.materials}
    colour = materials.get(used.pop()) if len(used) == 1 else None
    own = meshes[0][2] if len(meshes) == 1 else np.unique(np.concatenate([chosen for _, _, chosen in meshes]))
    if colour is None and vertices.shape[1] == 6:
        colour = only_colour(vertices[own, 3:])
    triangles = np.concatenate([triangles for _, triangles, _ in meshes])
    if len(own) < len(vertices):
        triangles = np.searchsorted(own, triangles)
    return make_part(name, colour, vertices[own, :3], triangles)


def _materials(data: bytes) -> dict[str, str]:
    """The diffuse colours (`Kd`) of a material file, by name."""
    result: dict[str, str] = {}
    name = ""
    for row in data.split(b"\n"):
        word = _word(row).lower()
        if word == b"newmtl":
            name = _rest(row)
        elif word == b"kd" and name:
            values = _numbers(b" ".join(row.split()[1:4]), float)
            colour = only_colour([values.tolist()]) if values is not None and len(values) == 3 else None
            if colour:
                result[name] = colour
    return result


def write_obj(stream: BinaryIO, solids: Sequence[OutSolid]) -> None:
    """Each solid as an object; its colour stands behind every vertex, as most programs read it."""
    stream.write(b"# written by Solidtree, millimetres\n")
    before = 1
    for number, solid in enumerate(solids, 1):
        stream.write(f"o {plain_name(solid.name) or f'solid {number}'}\n".encode())
        tail = "".join(f" {value / 255:.4f}" for value in rgb(solid.colour)) if solid.colour else ""
        stream.writelines(lines(f"v %r %r %r{tail}\n", solid.vertices + 0.0))
        stream.writelines(lines("f %d %d %d\n", solid.triangles.astype(np.int64) + before))
        before += len(solid.vertices)
