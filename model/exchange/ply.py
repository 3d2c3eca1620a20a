"""PLY, the Stanford polygon file, text and binary: one surface, with colours at its vertices or faces.

The format has no unit; coordinates are taken for millimetres.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from ..document.colours import rgb
from ..document.errors import Refusal
from .parts import Part, check_total, fan, make_part, only_colour, words_of
from .solids import OutSolid

_KINDS = {
    "char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4", "float": "f4",
    "double": "f8", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4",
    "int64": "i8", "uint64": "u8", "float32": "f4", "float64": "f8",
}  # fmt: skip
_CODES = {"i1": "b", "u1": "B", "i2": "h", "u2": "H", "i4": "i", "u4": "I", "i8": "q", "u8": "Q", "f4": "f", "f8": "d"}
_ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
_UNCOLOURED = (200, 200, 200)
_CUT = "is cut short or damaged: the list of “{}” leads beyond its end"

_List = tuple[NDArray[Any], NDArray[np.int64]]
"""The items of every row's list, one after the other, and how many each row has."""


@dataclass
class _Element:
    name: str
    count: int
    line: int
    properties: list[tuple[str, str, str]] = field(default_factory=list)
    """(name, kind, kind of the count, or "" where the property is one number)"""
    columns: dict[str, NDArray[Any]] = field(default_factory=dict)
    lists: dict[str, _List] = field(default_factory=dict)

    def least(self, text: bool) -> int:
        """The fewest bytes that all its rows can take."""
        return self.count * sum(2 if text else int((size or kind)[1]) for _, kind, size in self.properties)


def read_ply(data: bytes) -> list[Part]:
    """The file's one part, with its colour where all of it has the same. Raises Refusal."""
    order, elements, place = _header(data)
    values = _text_values(data, place) if not order else np.zeros(0)
    at = place if order else 0
    for element in elements:
        at = _binary(element, data, at, order) if order else _text(element, values, at)
    found = {element.name: element for element in elements}
    vertex, face = found.get("vertex"), found.get("face")
    if vertex is None or face is None or not vertex.count or not face.count:
        return []
    if not {"x", "y", "z"} <= vertex.columns.keys():
        raise Refusal(f"line {vertex.line}: the vertices of this PLY file have no x, y and z")
    name = next(
        (name for name in ("vertex_indices", "vertex_index") if name in face.lists), next(iter(face.lists), None)
    )
    if name is None:
        raise Refusal(f"line {face.line}: the faces of this PLY file have no list of vertices")
    corners, sizes = face.lists[name]
    check_total(int(np.maximum(sizes - 2, 0).sum()))
    vertices = np.column_stack([vertex.columns[axis].astype(np.float64) for axis in "xyz"])
    colour = _colour(face) or _colour(vertex)
    return [make_part("", colour, vertices, fan(corners.astype(np.int64), sizes))]


def _colour(element: _Element) -> str | None:
    if not {"red", "green", "blue"} <= element.columns.keys():
        return None
    whole = element.columns["red"].dtype == np.uint8 or any(n == "red" and k == "u1" for n, k, _ in element.properties)
    values = np.column_stack([element.columns[name] for name in ("red", "green", "blue")])
    return only_colour(values / 255.0 if whole else values)


def _header(data: bytes) -> tuple[str, list[_Element], int]:
    """The byte order (“” for text), the elements, and where their rows begin; sizes are checked against the file's."""
    if not data.startswith(b"ply"):
        raise Refusal(f"is no PLY file: it begins with {words_of(data[:60])}")
    end = data.find(b"end_header")
    if end < 0 or end > 1 << 20:
        raise Refusal("is cut short: the header of this PLY file has no “end_header”")
    order: str | None = None
    elements: list[_Element] = []
    for line, row in enumerate(data[:end].split(b"\n"), 1):
        words = row.decode("latin-1").split()
        where = f"line {line}: {words_of(row)}"
        if words[:1] == ["format"]:
            order = _ORDERS.get(words[1]) if len(words) > 1 else None
            if order is None:
                raise Refusal(f"{where} names no known format")
        elif words[:1] == ["element"]:
            if len(words) != 3 or not words[2].isdecimal() or len(words[2]) > 12:
                raise Refusal(f"{where} does not name an element and how many there are")
            elements.append(_Element(words[1], int(words[2]), line))
        elif words[:1] == ["property"]:
            size = _KINDS.get(words[2], "?") if words[1:2] == ["list"] and len(words) == 5 else ""
            kind = _KINDS.get(words[-2], "") if len(words) == (5 if size else 3) else ""
            if not kind or not elements or size[:1] in ("f", "?"):
                raise Refusal(f"{where} names no property of a known type")
            elements[-1].properties.append((words[-1], kind, size))
    if order is None:
        raise Refusal("is no PLY file: no line of its header names the format")
    place = data.find(b"\n", end) + 1 or len(data)
    least = sum(element.least(not order) for element in elements) - (not order)
    if least > len(data) - place:
        promised = " and ".join(f"{element.count:,} of “{element.name[:20]}”" for element in elements[:4])
        raise Refusal(f"is cut short: its header promises {promised}, at least {least:,} bytes; "
                      f"{len(data) - place:,} follow")  # fmt: skip
    return order, elements, place


def _binary(element: _Element, data: bytes, place: int, order: str) -> int:
    """Reads the element's rows from `place` on and returns where they end."""
    if not element.count or not element.properties:
        return place
    # As if every row had lists as long as the first row's, which is mostly so.
    fields: list[tuple[Any, ...]] = []
    at = place
    sizes: list[int] = []
    for i, (_, kind, size) in enumerate(element.properties):
        if size:
            count = _count(element, data, at, order + _CODES[size])
            fields.append((f"size {i}", order + size))
            sizes.append(count)
            at += int(size[1]) + count * int(kind[1])
        else:
            at += int(kind[1])
        fields.append((f"{i}", order + kind, (sizes[-1],)) if size else (f"{i}", order + kind))
    width = at - place
    end = place + element.count * width
    table = np.frombuffer(data, np.dtype(fields), element.count, place) if end <= len(data) else None
    if table is None or not all((table[name] == table[name][0]).all() for name, *_ in fields if name[0] == "s"):
        return _binary_rows(element, data, place, order)
    for i, (name, _, size) in enumerate(element.properties):
        if size:
            rows = table[f"{i}"]
            element.lists[name] = (rows.ravel(), np.full(element.count, rows.shape[1], dtype=np.int64))
        else:
            element.columns[name] = table[f"{i}"]
    return end


def _count(element: _Element, data: bytes, place: int, code: str) -> int:
    if place + struct.calcsize(code) > len(data):
        raise Refusal(_CUT.format(element.name))
    count = struct.unpack_from(code, data, place)[0]
    if not 0 <= count <= len(data) - place:
        raise Refusal(_CUT.format(element.name))
    return count


def _binary_rows(element: _Element, data: bytes, place: int, order: str) -> int:
    """Rows with lists of differing lengths, one by one; only the lists are kept."""
    found: dict[str, tuple[list[bytes], list[int], np.dtype]] = {
        name: ([], [], np.dtype(order + kind)) for name, kind, size in element.properties if size
    }
    for _ in range(element.count):
        for name, kind, size in element.properties:
            if not size:
                place += int(kind[1])
                continue
            count = _count(element, data, place, order + _CODES[size])
            place += int(size[1])
            pieces, sizes, _kind = found[name]
            pieces.append(data[place : place + count * int(kind[1])])
            sizes.append(count)
            place += count * int(kind[1])
    if place > len(data):
        raise Refusal(_CUT.format(element.name))
    for name, (pieces, sizes, kind) in found.items():
        element.lists[name] = (np.frombuffer(b"".join(pieces), kind), np.array(sizes, dtype=np.int64))
    return place


def _text_values(data: bytes, place: int) -> NDArray[np.float64]:
    try:
        return np.fromstring(data[place:], sep=" ")  # type: ignore[call-overload]
    except (ValueError, DeprecationWarning):
        for line, row in enumerate(data[place:].split(b"\n"), data.count(b"\n", 0, place) + 1):
            try:
                [float(word) for word in row.split()]
            except ValueError:
                raise Refusal(f"line {line:,}: {words_of(row)} is no row of numbers") from None
        raise Refusal("is damaged: the numbers behind its header cannot be read") from None


def _text(element: _Element, values: NDArray[np.float64], place: int) -> int:
    """Takes the element's rows out of all numbers of the file, from number `place` on, and returns where they end."""
    if not element.count or not element.properties:
        return place
    if not any(size for *_, size in element.properties):
        end = place + element.count * len(element.properties)
        if end > len(values):
            raise Refusal(
                f"is cut short: fewer than the {element.count:,} of “{element.name}” that its header promises"
            )
        table = values[place:end].reshape(element.count, -1)
        element.columns |= {name: table[:, i] for i, (name, *_) in enumerate(element.properties)}
        return end
    if len(element.properties) == 1 and place < len(values):
        count = values[place]
        width = int(count) + 1 if 0 <= count < len(values) else 0
        table = values[place : place + element.count * width]
        if width and len(table) == element.count * width and (table[::width] == count).all():
            rows = table.reshape(-1, width)[:, 1:]
            element.lists[element.properties[0][0]] = (rows.ravel(), np.full(len(rows), width - 1, dtype=np.int64))
            return place + len(table)
    found: dict[str, tuple[list[NDArray[np.float64]], list[int]]] = {
        n: ([], []) for n, _, size in element.properties if size
    }
    for _ in range(element.count):
        for name, _, size in element.properties:
            count = values[place] if size and place < len(values) else 0
            if place >= len(values) or not 0 <= count < len(values) - place:
                raise Refusal(_CUT.format(element.name))
            if size:
                found[name][0].append(values[place + 1 : place + 1 + int(count)])
                found[name][1].append(int(count))
            place += 1 + int(count)
    for name, (pieces, sizes) in found.items():
        element.lists[name] = (np.concatenate(pieces), np.array(sizes, dtype=np.int64))
    return place


def write_ply(stream: BinaryIO, solids: Sequence[OutSolid]) -> None:
    """All solids as one binary surface in double precision; the colours, where there are any, stand at the faces."""
    coloured = any(solid.colour for solid in solids)
    kind = [("size", "u1"), ("corners", "<i4", 3)] + ([("colour", "u1", 3)] if coloured else [])
    colours = "".join(f"property uchar {name}\n" for name in ("red", "green", "blue")) if coloured else ""
    stream.write(
        "ply\nformat binary_little_endian 1.0\ncomment written by Solidtree, millimetres\n"
        f"element vertex {sum(len(solid.vertices) for solid in solids)}\n"
        "property double x\nproperty double y\nproperty double z\n"
        f"element face {sum(len(solid.triangles) for solid in solids)}\n"
        f"property list uchar int vertex_indices\n{colours}end_header\n".encode()
    )
    for solid in solids:
        stream.write((solid.vertices + 0.0).astype("<f8").tobytes())
    before = 0
    for solid in solids:
        rows = np.zeros(len(solid.triangles), dtype=np.dtype(kind))
        rows["size"], rows["corners"] = 3, solid.triangles.astype(np.int64) + before
        if coloured:
            rows["colour"] = rgb(solid.colour) if solid.colour else _UNCOLOURED
        stream.write(rows.tobytes())
        before += len(solid.vertices)
