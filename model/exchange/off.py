"""OFF, the Object File Format of Geomview: points and faces in text. Coordinates are taken for millimetres."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from ..document.errors import Refusal
from .parts import Part, check_total, fan, make_part, words_of
from .solids import OutSolid, lines

HEADER = re.compile(rb"(?:\s|#[^\n]*\n)*((?:ST)?C?N?4?n?(?:OFF|off))(?![A-Za-z])(\s+BINARY)?")


def read_off(data: bytes) -> list[Part]:
    """The file's one part. Raises Refusal."""
    header = HEADER.match(data[:4096].lstrip(b"\xef\xbb\xbf"))
    if not header:
        raise Refusal(f"is no OFF file: it begins with {words_of(data[:60])}")
    if header[2] or b"4" in header[1] or b"n" in header[1]:
        raise Refusal(f"is an OFF file of a kind that is not read ({words_of(header[0])}); save it as plain OFF")
    start = data.index(header[1]) + len(header[1])
    first = data.count(b"\n", 0, start) + 1
    # (line number, text) of what is neither empty nor comment
    numbered = ((i, row.split(b"#", 1)[0].strip()) for i, row in enumerate(data[start:].split(b"\n"), first))
    rows = [(i, row) for i, row in numbered if row]
    counts = _whole(rows[0][1].split()[:2]) if rows else None
    if counts is None or len(counts) < 2:
        at = f"line {rows[0][0]}: {words_of(rows[0][1])} does not tell" if rows else "it does not tell"
        raise Refusal(f"is no OFF file: {at} the numbers of vertices and faces")
    n, m = int(counts[0]), int(counts[1])
    if n + m > len(rows) - 1:
        raise Refusal(
            f"is cut short: it promises {n:,} vertices and {m:,} faces, but only {len(rows) - 1:,} lines follow"
        )
    vertices = _vertices(rows[1 : n + 1])
    corners, sizes = _faces(rows[n + 1 : n + m + 1])
    check_total(int(np.maximum(sizes - 2, 0).sum()))
    wrong = np.flatnonzero((corners < 0) | (corners >= n))
    if len(wrong):
        at = rows[n + 1 + int(np.searchsorted(np.cumsum(sizes), wrong[0], side="right"))][0]
        raise Refusal(f"line {at:,}: the face asks for vertex {corners[wrong[0]]}; there are {n:,}, counted from 0")
    return [make_part("", None, vertices, fan(corners, sizes))]


def _whole(words: list[bytes]) -> NDArray[np.int64] | None:
    good = all(re.fullmatch(rb"\d{1,10}", word) for word in words)
    return np.array([int(word) for word in words], dtype=np.int64) if good else None


def _numbers(rows: list[tuple[int, bytes]]) -> NDArray[np.float64] | None:
    """One row of numbers a line, where all lines have as many; else None."""
    if not rows or len({len(row.split()) for _, row in rows}) != 1:
        return None
    try:
        values = np.fromstring(b" ".join(row for _, row in rows), sep=" ")  # type: ignore[call-overload]
    except (ValueError, DeprecationWarning):
        return None
    return values.reshape(len(rows), -1) if len(values) % len(rows) == 0 else None


def _vertices(rows: list[tuple[int, bytes]]) -> NDArray[np.float64]:
    table = _numbers(rows)
    if table is not None and table.shape[1] >= 3:
        return table[:, :3]  # normals, colours and texture places may follow
    result = np.zeros((len(rows), 3))
    for i, (line, row) in enumerate(rows):
        try:
            result[i] = [float(word) for word in row.split()[:3]]
        except ValueError:
            raise Refusal(f"line {line:,}: {words_of(row)} is no vertex of three numbers") from None
    return result


def _faces(rows: list[tuple[int, bytes]]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    table = _numbers(rows)
    if table is not None:
        size = table[0, 0]
        if (table[:, 0] == size).all() and 0 < size < table.shape[1] and size == int(size):
            corners = table[:, 1 : int(size) + 1]
            if (corners == np.floor(corners)).all() and (np.abs(corners) < 1 << 40).all():
                return corners.astype(np.int64).ravel(), np.full(len(rows), int(size))
    flat: list[int] = []
    sizes: list[int] = []
    for line, row in rows:
        words = row.split()
        whole = _whole(words[:1])
        size = int(whole[0]) if whole is not None else -1
        corners = _whole(words[1 : size + 1]) if 0 <= size < len(words) else None
        if corners is None:
            raise Refusal(f"line {line:,}: {words_of(row)} is no face: a number of corners and as many vertices")
        flat += corners.tolist()
        sizes.append(size)
    return np.array(flat, dtype=np.int64), np.array(sizes, dtype=np.int64)


def write_off(stream: BinaryIO, solids: Sequence[OutSolid]) -> None:
    """All solids as one surface; OFF knows no names."""
    vertices = np.concatenate([solid.vertices for solid in solids])
    starts = np.cumsum([0, *(len(solid.vertices) for solid in solids)])
    triangles = np.concatenate(
        [solid.triangles.astype(np.int64) + start for solid, start in zip(solids, starts, strict=False)]
    )
    stream.write(f"OFF\n{len(vertices)} {len(triangles)} 0\n".encode())
    stream.writelines(lines("%r %r %r\n", vertices + 0.0))
    stream.writelines(lines("3 %d %d %d\n", triangles))
