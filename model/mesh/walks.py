"""Walks over a whole winged edge at once: all stars of vertices, borders, smooth chains."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .lists import Floats, Numbers
from .winged import END, LEFT, LEFT_BEFORE, RIGHT, START, WingedEdge


def stars(mesh: WingedEdge) -> tuple[Numbers, NDArray[np.int32], Numbers]:
    """The edges at each vertex in their order, counter-clockwise: (n + 1,) where each vertex begins, the edges, and
    (k,) the places at which a new fan begins, as it does where surfaces meet in one vertex only.

    All vertices take a step together, so that the number of steps is that of the largest star.
    """
    table, count = mesh.table, len(mesh.vertices)
    flat = table.reshape(-1)  # START is the first column
    degree = np.bincount(table[:, START], minlength=count) + np.bincount(table[:, END], minlength=count)
    starts = np.concatenate(([0], np.cumsum(degree))).astype(np.int64)
    found = np.empty(int(starts[-1]), table.dtype)
    fans = []
    free = starts[:-1].copy()  # where the next fan of each vertex goes
    heads = np.flatnonzero(mesh.vertex_edge >= 0)
    edges = mesh.vertex_edge[heads].astype(np.int64)
    while len(heads):
        fans.append(free[heads])
        at, hub, first, place = edges, heads, edges, free[heads]
        while len(at):
            found[place] = at
            row = 8 * at
            onward = flat.take(row + (LEFT_BEFORE + 2 * (flat.take(row) != hub)))
            goes = (onward >= 0) & (onward != first)
            place = place + 1
            if not goes.all():
                free[hub[~goes]] = place[~goes]
                onward, hub, first, place = onward[goes], hub[goes], first[goes], place[goes]
            at = onward.astype(np.int64)
        short = np.flatnonzero(free < starts[1:])
        heads, edges = short, _fan_heads(mesh, short, starts, free, found)
    return starts, found, np.sort(np.concatenate(fans)) if fans else np.zeros(0, np.int64)


def _fan_heads(mesh: WingedEdge, hubs: Numbers, starts: Numbers, free: Numbers, found: NDArray[np.int32]) -> Numbers:
    """An edge of another fan of each of these vertices: the first at a border where there is one."""
    if not len(hubs):
        return hubs
    table = mesh.table
    heads = []
    ends = table[:, [START, END]]
    mine = np.flatnonzero(np.isin(ends, hubs).any(axis=1))
    for hub in hubs.tolist():
        known = set(found[starts[hub] : free[hub]].tolist())
        left = [edge for edge in mine[(ends[mine] == hub).any(axis=1)].tolist() if edge not in known]
        bare = (edge for edge in left if mesh.turned_back(edge, hub) < 0)
        heads.append(next(bare, left[0]))
    return np.array(heads, np.int64)


def borders(mesh: WingedEdge) -> list[list[int]]:
    """The loops of edges that have no face on one side, each as `WingedEdge.border` walks it."""
    open_ = np.flatnonzero((mesh.table[:, LEFT] < 0) | (mesh.table[:, RIGHT] < 0))
    left = dict.fromkeys(open_.tolist())
    found = []
    while left:
        walked = mesh.border(next(iter(left)))
        for edge in walked:
            left.pop(edge, None)
        found.append(walked)
    return found


def directions(mesh: WingedEdge) -> Floats:
    """(e, 3) unit vectors from start to end; of edges without a length 0."""
    along = mesh.vertices[mesh.table[:, END]] - mesh.vertices[mesh.table[:, START]]
    size = np.linalg.norm(along, axis=1, keepdims=True)
    return along / np.where(size > 0.0, size, 1.0)


def bends(mesh: WingedEdge, face_normals: Floats) -> Floats:
    """(e,) degrees by which the surface turns at each edge: 0 where it is flat, positive where it is convex, NaN where
    there is no face on a side. `face_normals` (f, 3) are unit."""
    left, right = mesh.table[:, LEFT], mesh.table[:, RIGHT]
    a, b = face_normals[left], face_normals[right]
    along = directions(mesh)
    sine = np.einsum("ij,ij->i", np.cross(a, b), along)
    angle = np.degrees(np.arctan2(sine, np.einsum("ij,ij->i", a, b)))
    return np.where((left >= 0) & (right >= 0), angle, np.nan)


def chain(mesh: WingedEdge, edge: int, wanted: np.ndarray | None = None, bend: float = 30.0) -> list[int]:
    """The edges that go on smoothly from one, both ways: at each vertex the straightest among `wanted` (e,) flags (all
    by default) that turns by `bend` degrees at most. A ring ends where it began."""
    along = directions(mesh)
    least = np.cos(np.radians(bend))
    allowed = np.ones(len(mesh), bool) if wanted is None else wanted
    found, known = [edge], {edge}
    for forward in (True, False):
        at, vertex = edge, int(mesh.table[edge, END if forward else START])
        way = along[edge] if forward else -along[edge]
        while True:
            best, straight = -1, least
            for other in _all_edges(mesh, vertex, at):
                if other == at or not allowed[other]:
                    continue
                leaves = along[other] if mesh.table[other, START] == vertex else -along[other]
                cosine = float(leaves @ way)
                if cosine >= straight:
                    best, straight = other, cosine
            if best < 0 or best in known:
                break
            known.add(best)
            found = [*found, best] if forward else [best, *found]
            way = along[best] if mesh.table[best, START] == vertex else -along[best]
            vertex = int(mesh.table[best, END] if mesh.table[best, START] == vertex else mesh.table[best, START])
            at = best
    return found


def _all_edges(mesh: WingedEdge, vertex: int, edge: int) -> list[int]:
    """The edges about a vertex in the fan of an edge, from it both ways round."""
    found, at = [edge], edge
    while True:
        at = mesh.turned(at, vertex)
        if at < 0 or at == edge:
            break
        found.append(at)
    if at < 0:  # at a border: the other way round as well
        at = edge
        while True:
            at = mesh.turned_back(at, vertex)
            if at < 0:
                break
            found.append(at)
    return found
