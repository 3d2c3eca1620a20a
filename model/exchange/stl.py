"""STL, binary and text: triangles without units, names or colours. Coordinates are taken for millimetres."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from ..document.errors import Refusal
from .parts import Part, check_total, make_part, words_of
from .solids import OutSolid

_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_HEADER = b"binary STL written by Solidtree, millimetres"  # must not begin with “solid”, which marks text
_ANY_VERTEX = re.compile(rb"^[ \t]*vertex\b.*$", re.I | re.M)
_VERTEX = re.compile(rb"^[ \t]*vertex[ \t]+([^\s]+[ \t]+[^\s]+[ \t]+[^\s]+)[ \t\r]*$", re.I | re.M)
_PIECE = 1 << 24


def read_stl(data: bytes) -> list[Part]:
    """The file's one part; its name is that of a text file's only solid. Raises Refusal."""
    if is_binary(data):
        rows = np.frombuffer(data, _TRIANGLE, int.from_bytes(data[80:84], "little"), 84)
        check_total(len(rows))
        return [make_part("", None, rows["corners"].reshape(-1, 3), None)]
    head = data[:1024].lstrip(b"\xef\xbb\xbf \t\r\n")
    if head[:5].lower() == b"solid" and b"\0" not in data[:84]:
        return [_from_text(data)]
    if len(re.findall(rb"[\t\r\n -~]", head)) > 0.9 * len(head):
        raise Refusal(f"is text, not STL: it begins with {words_of(head.splitlines()[0] if head else b'')}")
    if len(data) < 84:
        raise Refusal(f"is cut short: a binary STL has at least 84 bytes, this file has {len(data)}")
    count = int.from_bytes(data[80:84], "little")
    raise Refusal(f"is cut short or damaged: its header tells of {count:,} triangles, which take {84 + 50 * count:,} "
                  f"bytes; the file has {len(data):,}")  # fmt: skip


def is_binary(data: bytes) -> bool:
    """Whether the size is what the triangle count at byte 80 makes it; a few bytes of padding may follow."""
    count = int.from_bytes(data[80:84], "little")
    return len(data) >= 84 and 0 <= len(data) - 84 - 50 * count < 50 and (count > 0 or len(data) == 84)


def _from_text(data: bytes) -> Part:
    names = re.findall(rb"^[ \t]*solid\b[ \t]*(.*?)[ \t\r]*$", data, re.I | re.M)
    vertices = np.concatenate([np.zeros((0, 3)), *_vertices(data)])
    check_total(len(vertices) // 3)
    if len(vertices) % 3:
        raise Refusal(f"is damaged: it has {len(vertices):,} vertices, which is no multiple of three")
    if not re.search(rb"^[ \t]*endsolid\b", data[-4096:], re.I | re.M):
        raise Refusal(f"is cut short: “endsolid” is missing after line {data.count(bytes([10])) + 1:,}")
    return make_part(names[0].decode("utf-8", "replace") if len(names) == 1 else "", None, vertices, None)


def _vertices(data: bytes) -> Iterator[NDArray[np.float64]]:
    start = 0
    while start < len(data):
        # A piece ends with a line, so that memory stays in proportion.
        end = data.find(b"\n", start + _PIECE) + 1 or len(data)
        piece = data[start:end]
        found = _VERTEX.findall(piece)
        try:
            values = np.fromstring(b" ".join(found), sep=" ")  # type: ignore[call-overload]
        except (ValueError, DeprecationWarning):
            values = np.zeros(0)
        if len(values) != 3 * len(found) or len(found) != len(_ANY_VERTEX.findall(piece)):
            _refuse(data, start, piece)
        yield values.reshape(-1, 3)
        start = end


def _refuse(data: bytes, start: int, piece: bytes) -> None:
    for row in _ANY_VERTEX.finditer(piece):
        try:
            if len([float(word) for word in row[0].split()[1:]]) == 3:
                continue
        except ValueError:
            pass
        line = data.count(b"\n", 0, start + row.start()) + 1
        raise Refusal(f"line {line:,}: {words_of(row[0])} is no vertex of three numbers")
    raise Refusal(f"holds a vertex that cannot be read after line {data.count(bytes([10]), 0, start) + 1:,}")


def write_stl(stream: BinaryIO, solids: Sequence[OutSolid]) -> None:
    """All solids as one binary STL. STL knows single precision only. Raises Refusal."""
    total = sum(len(solid.triangles) for solid in solids)
    if total >= 1 << 32:
        raise Refusal("STL holds at most 4,294,967,295 triangles; write a 3MF")
    stream.write(_HEADER.ljust(80, b" ") + total.to_bytes(4, "little"))
    for solid in solids:
        with np.errstate(over="ignore"):
            corners = solid.vertices.astype(np.float32)[solid.triangles]
        if not np.isfinite(corners).all():
            raise Refusal(f"“{solid.name}” is too large for STL, which holds numbers up to 3.4e38")
        rows = np.zeros(len(corners), dtype=_TRIANGLE)
        wide = corners.astype(np.float64)
        normals = np.cross(wide[:, 1] - wide[:, 0], wide[:, 2] - wide[:, 0])
        lengths = np.linalg.norm(normals, axis=1, keepdims=True)
        rows["normal"] = np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0) + 0.0
        rows["corners"] = corners + np.float32(0)
        stream.write(rows.tobytes())
