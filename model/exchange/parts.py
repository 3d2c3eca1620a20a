"""The solids of a mesh file as arrays: checked, welded, and what keeps them from being closed."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..document.errors import Refusal

MAX_TRIANGLES = 20_000_000
"""In all parts of a file; some 2 GB of memory while they are made."""

MAX_PARTS = 10_000

Vertices = NDArray[np.float64]
Triangles = NDArray[np.int32]


@dataclass(frozen=True, eq=False)
class EdgeFaults:
    """How many edges of a mesh keep it from enclosing a solid."""

    open: int
    """Edges of one triangle only."""
    nonmanifold: int
    """Edges of more than two triangles."""
    turned: int
    """Edges whose two triangles disagree about the outside."""
    closed: bool
    """Whether every edge runs as often forth as back, so that the surface bounds a solid."""

    def __str__(self) -> str:
        kinds = ((self.open, "open"), (self.nonmanifold, "overused"), (self.turned, "inconsistent"))
        return ", ".join(f"{count:,} {word} edge{'' if count == 1 else 's'}" for count, word in kinds if count)


@dataclass(frozen=True, eq=False)
class Part:
    """One solid of a mesh file, in millimetres and with z up."""

    name: str
    colour: str | None
    vertices: Vertices
    """(n, 3), read-only"""
    triangles: Triangles
    """(m, 3) indices into vertices, counter-clockwise seen from outside, read-only"""
    unit: float = 1.0
    """How many millimetres the file's unit has; the vertices are multiplied by it already."""
    note: str = ""
    """What of the file is not in the part, for the user."""

    @cached_property
    def edge_faults(self) -> EdgeFaults:
        return edge_faults(self.triangles, len(self.vertices))

    @property
    def closed(self) -> bool:
        return self.edge_faults.closed

    @property
    def fault(self) -> str | None:
        """Why the part is no solid, such as “is not closed: 12 open edges”, or None."""
        return None if self.closed else f"is not closed: {self.edge_faults}"


def edge_faults(triangles: NDArray[Any], count: int) -> EdgeFaults:
    """What is wrong with the edges of triangles (m, 3) over `count` vertices."""
    corners = triangles.astype(np.int64)
    start, end = corners.ravel(), corners[:, [1, 2, 0]].ravel()
    # One number an edge, the lowest bit telling its direction; sorting brings the edges' halves together.
    halves = np.sort((np.minimum(start, end) * count + np.maximum(start, end)) * 2 + (start > end))
    edges, back = halves >> 1, halves & 1
    first = np.flatnonzero(np.concatenate(([True], edges[1:] != edges[:-1])) if len(edges) else np.zeros(0, dtype=bool))
    uses = np.diff(first, append=len(edges))
    backward = np.add.reduceat(back, first) if len(first) else first
    even = 2 * backward == uses
    return EdgeFaults(
        open=int(np.count_nonzero(uses == 1)),
        nonmanifold=int(np.count_nonzero(uses > 2)),
        turned=int(np.count_nonzero((uses == 2) & ~even)),
        closed=bool(len(first)) and bool(even.all()),
    )


def make_part(
    name: str,
    colour: str | None,
    vertices: NDArray[Any],
    triangles: NDArray[Any] | None,
    *,
    unit: float = 1.0,
    note: str = "",
) -> Part:
    """A part of checked and welded arrays; `triangles` None takes each three vertices for a triangle.

    Vertices at exactly the same place become one, unless the triangles as they are indexed bound a solid already:
    then the file says which of them belong together. Triangles with two equal corners are dropped. Raises Refusal.
    """
    where = f" of “{name}”" if name else ""
    with np.errstate(all="ignore"):  # what overflows becomes infinite and is refused just below
        scaled = vertices * unit if unit != 1.0 else vertices
        finite = np.isfinite(scaled).all()
    if not finite:
        bad = int(np.flatnonzero(~np.isfinite(scaled).all(axis=1))[0])
        raise Refusal(f"vertex {bad + 1:,}{where} has a coordinate that is no finite number")
    if triangles is None:
        corners = np.arange(len(scaled), dtype=np.int32).reshape(-1, 3)
        faults = None
    else:
        if len(triangles) and (triangles.min() < 0 or triangles.max() >= len(scaled)):
            bad = int(np.flatnonzero(((triangles < 0) | (triangles >= len(scaled))).any(axis=1))[0])
            wrong = int(next(i for i in triangles[bad] if not 0 <= i < len(scaled)))
            raise Refusal(f"triangle {bad + 1:,}{where} asks for vertex {wrong} of {len(scaled):,}, counted from 0")
        corners = _proper(triangles.astype(np.int32))
        faults = edge_faults(corners, len(scaled))
    if faults is None or not faults.closed:
        faults = None
        chosen, place = _distinct(scaled)
        scaled, corners = scaled[chosen], _proper(place[corners])
    used = np.zeros(len(scaled), dtype=bool)
    used[corners] = True
    if not used.all():
        corners = (np.cumsum(used, dtype=np.int32) - 1)[corners]
        scaled = scaled[used]
    result = np.ascontiguousarray(scaled, dtype=np.float64) + 0.0
    corners = np.ascontiguousarray(corners, dtype=np.int32)
    result.flags.writeable = corners.flags.writeable = False
    part = Part(name, colour, result, corners, unit, note)
    if faults is not None:
        vars(part)["edge_faults"] = faults  # known already
    return part


def _proper(triangles: Triangles) -> Triangles:
    a, b, c = triangles.T
    proper = (a != b) & (b != c) & (c != a)
    return triangles if proper.all() else triangles[proper]


def _distinct(vertices: NDArray[Any]) -> tuple[NDArray[np.int64], Triangles]:
    """The first vertex at each place, in their order, and for every vertex which of those it is."""
    kind = np.uint32 if vertices.dtype == np.float32 else np.uint64
    bits = np.ascontiguousarray(vertices + 0.0).view(kind)  # + 0.0 makes -0.0 and 0.0 the same place
    mixed = np.zeros(len(bits), dtype=np.uint64)
    for column, factor in zip(bits.T, (0x9E3779B97F4A7C15, 0xBF58476D1CE4E5B9, 0x94D049BB133111EB), strict=True):
        mixed = (mixed + column) * np.uint64(factor)
        mixed ^= mixed >> np.uint64(32)
    order = np.argsort(mixed, kind="stable")
    fresh = _steps(mixed[order][:, None])
    if (_steps(bits[order]) != fresh).any():  # two places with the same mixture: sort by the places themselves
        order = np.lexsort(bits.T)
        fresh = _steps(bits[order])
    group = np.cumsum(fresh) - 1
    chosen = order[fresh]
    ranks = np.argsort(chosen)
    place = np.empty(len(chosen), dtype=np.int32)
    place[ranks] = np.arange(len(chosen), dtype=np.int32)
    result = np.empty(len(bits), dtype=np.int32)
    result[order] = place[group]
    return chosen[ranks], result


def _steps(rows: NDArray[Any]) -> NDArray[np.bool_]:
    """Which rows differ from the one before."""
    steps = np.ones(len(rows), dtype=bool)
    steps[1:] = (rows[1:] != rows[:-1]).any(axis=1)
    return steps


def fan(corners: NDArray[np.int64], sizes: NDArray[np.int64]) -> NDArray[np.int64]:
    """Faces of `sizes` (f,) corners, one after the other in `corners`, cut into triangles (m, 3) from their first."""
    cut = np.maximum(sizes - 2, 0)
    start = np.repeat(np.cumsum(sizes) - sizes, cut)
    step = np.arange(cut.sum()) - np.repeat(np.cumsum(cut) - cut, cut)
    return np.column_stack((corners[start], corners[start + step + 1], corners[start + step + 2]))


def placed(vertices: NDArray[Any], matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    """vertices (n, 3) mapped by a (3, 4) matrix."""
    with np.errstate(all="ignore"):
        return vertices @ matrix[:, :3].T + matrix[:, 3]


def check_total(triangles: int) -> None:
    """Raises Refusal for more triangles than are read."""
    if triangles > MAX_TRIANGLES:
        raise Refusal(f"has {triangles:,} triangles; up to {MAX_TRIANGLES:,} are read")


def check_parts(count: int) -> None:
    """Raises Refusal for more parts than are read."""
    if count > MAX_PARTS:
        raise Refusal(f"has {count:,} solids; up to {MAX_PARTS:,} are read")


def only_colour(colours: Iterable[Sequence[float]]) -> str | None:
    """`#rrggbb` of rows of red, green and blue from 0 to 1, where all are alike; else None."""
    rows = np.asarray(colours, dtype=np.float64)
    if not len(rows) or not np.isfinite(rows).all() or (rows != rows[0]).any():
        return None
    return "#" + "".join(f"{round(255 * float(value)):02x}" for value in np.clip(rows[0, :3], 0, 1))


def words_of(line: bytes) -> str:
    """The beginning of a line of a file, fit to be shown."""
    text = line.strip().split(b"\n")[0].decode("utf-8", "replace").rstrip()
    shown = "".join(character if character.isprintable() else "·" for character in text[:40])
    return f"“{shown}{'…' if len(text) > 40 else ''}”"
