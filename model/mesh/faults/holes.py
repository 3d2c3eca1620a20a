"""Holes closed: borders of a mesh filled with triangles."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..pieces import pieces
from .report import arrays_of
from .sides import Flags, Floats, Numbers, Sides, shells, sides_of, twins
from .welding import proper
from .words import many

FLAT = 1e-6
"""A border is flat where no vertex is farther from its plane than this share of its size."""
LARGE = 300
"""Bent borders with more vertices are closed towards their middle."""
SAMPLE = 50
"""Triangles of a piece that are looked at first."""
KEY = 1 << 31


def close_holes(
    vertices: ArrayLike, triangles: ArrayLike, longest: float | None = None, at: ArrayLike | None = None
) -> tuple[Floats, Numbers, str]:
    """Borders filled with triangles that face as their neighbours do: with `longest` only those up to that length, mm,
    with `at` those that pass one of these vertices.

    Flat borders become flat faces, those within others holes of them. Of bent ones the least area is sought (Barequet
    and Sharir 1995); those of very many vertices are closed towards a new vertex in their middle. Left are borders that
    run into an edge of more than two triangles or past triangles that disagree about the outside, and those of flat
    sheets, which would be laid on themselves. Returns vertices (n, 3), triangles (m, 3) and words about what changed.
    Raises Refusal as `find_faults` does.
    """
    points, faces = arrays_of(vertices, triangles)
    faces = proper(faces)
    sides = sides_of(faces, len(points))
    loops, tangled = _loops(sides)
    if at is not None:
        loops, tangled = [loop for loop in loops if np.isin(loop, at).any()], 0
    lengths = [float(np.linalg.norm(points[loop] - np.roll(points[loop], 1, axis=0), axis=1).sum()) for loop in loops]
    short = [loop for loop, length in zip(loops, lengths, strict=True) if longest is None or length <= longest]
    sheets = _sheets(points, faces, shells(sides), short)
    chosen = [loop for loop, sheet in zip(short, sheets, strict=True) if not sheet]
    known = _Known(sides)
    added: list[Numbers] = []
    closed = 0
    for group in _coplanar(points, chosen, [_plane(points[loop]) for loop in chosen]):
        rings = [chosen[k] for k in group]
        points, filling = _filled(points, rings, known)
        if len(filling):
            added.append(filling)
            closed += len(rings)
            known.add(filling)
    result = np.vstack((faces, *added)) if added else faces
    words = [f"{many(closed, 'hole')} closed with {many(len(result) - len(faces), 'triangle')}"] if closed else []
    if len(loops) > len(short):
        words.append(f"{many(len(loops) - len(short), 'longer border')} left open")
    if len(short) > closed:
        words.append(
            f"{many(len(short) - closed, 'border')} left open, where a filling would lie on the faces there are"
        )
    if tangled:
        words.append(f"{many(tangled, 'open edge')} left, on borders that branch or run past turned triangles")
    return points, result, ", ".join(words)


class _Known:
    """The edges that there are, by a number for each pair of vertices; those of the fillings come one by one."""

    def __init__(self, sides: Sides) -> None:
        self._given = sides.ends @ (KEY, 1)  # rising, as the edges are
        self._added: set[int] = set()

    def add(self, triangles: Numbers) -> None:
        self._added.update(_keys(triangles).tolist())

    def among(self, keys: Numbers) -> Flags:
        """Which of these edges there are."""
        place = np.minimum(np.searchsorted(self._given, keys), max(len(self._given) - 1, 0))
        there = self._given[place] == keys if len(self._given) else np.zeros(keys.shape, bool)
        if self._added:
            there |= np.isin(keys, list(self._added))
        return there


def _filled(points: Floats, rings: list[Numbers], known: _Known) -> tuple[Floats, Numbers]:
    """The vertices, with one more where it takes that, and triangles (m, 3) that close a border and those within it.

    None where new edges would be `known` ones: such an edge would have more than two faces.
    """
    normal, flat = _plane(points[rings[0]])
    if flat:
        found = _filled_flat(points, rings, normal)
        if not _again(found, rings, known):
            return points, found
    if len(rings) > 1:
        return points, np.zeros((0, 3), np.int64)
    ring = rings[0]
    if len(ring) > LARGE:
        hub = np.full(len(ring), len(points))
        return np.vstack((points, points[ring].mean(axis=0))), np.column_stack((ring, np.roll(ring, -1), hub))
    found = ring[least_area(points[ring], known.among(_pair_keys(ring[:, None], ring[None])))]
    return points, np.zeros((0, 3), np.int64) if _again(found, rings, known) else found


def _pair_keys(one: Numbers, two: Numbers) -> Numbers:
    return np.minimum(one, two) * KEY + np.maximum(one, two)


def _keys(triangles: Numbers) -> Numbers:
    """(3m,) a number for each side, whichever way it runs."""
    return _pair_keys(triangles, triangles[:, [1, 2, 0]]).reshape(-1)


def _again(triangles: Numbers, rings: list[Numbers], known: _Known) -> bool:
    """Whether triangles that fill rings have sides that are known and are none of the rings'."""
    own = np.concatenate([_pair_keys(ring, np.roll(ring, -1)) for ring in rings])
    inner = np.setdiff1d(_keys(triangles), own)
    return bool(known.among(inner).any())


def _loops(sides: Sides) -> tuple[list[Numbers], int]:
    """The borders, each as vertices in the order in which a filling runs round, and how many open edges are in none."""
    rim = np.flatnonzero(sides.open[sides.edge])
    if not len(rim):
        return [], 0
    twin = twins(sides)
    # From each side without a twin to the next one of the same fan: round their vertex through the triangles.
    lone = np.flatnonzero(twin < 0)
    onward = _after(lone)
    inner = np.flatnonzero(twin[onward] >= 0)
    while len(inner):
        onward[inner] = _after(twin[onward[inner]])
        inner = inner[twin[onward[inner]] >= 0]
    place = np.empty(len(twin), np.int64)
    place[lone] = np.arange(len(lone))
    following = place[onward]
    label = pieces(np.arange(len(lone)), following, len(lone))
    whole = np.ones(len(lone), bool)
    whole[label[~sides.open[sides.edge[lone]]]] = False
    loops = []
    left = int((~whole[label] & sides.open[sides.edge[lone]]).sum())
    for first in np.unique(label, return_index=True)[1].tolist():
        if not whole[label[first]]:
            continue
        chain, at = [first], int(following[first])
        while at != first:
            chain.append(at)
            at = int(following[at])
        loop = sides.start[lone[chain]][::-1]
        for part in _simple(loop):
            if len(part) > 2:
                loops.append(part)
            else:
                left += len(part)
    return loops, left


def _sheets(points: Floats, faces: Numbers, shell: Numbers, loops: list[Numbers]) -> list[bool]:
    """Which borders are flat ones of a piece of the surface that lies all in their plane."""
    order = np.argsort(shell, kind="stable")
    starts = np.searchsorted(shell[order], np.arange(int(shell.max(initial=-1)) + 2))
    of_vertex = np.zeros(len(points), np.int64)
    of_vertex[faces] = shell[:, None]
    found = []
    for loop in loops:
        normal, flat = _plane(points[loop])
        if flat:
            piece = of_vertex[loop[0]]
            mine, middle = order[starts[piece] : starts[piece + 1]], points[loop].mean(axis=0)
            for rows in (mine[:: len(mine) // SAMPLE + 1], mine):  # few are flat: a look at some tells most
                local = points[faces[rows].reshape(-1)] - middle
                flat = flat and bool(np.abs(local @ normal).max() <= FLAT * np.abs(local).max())
                if not flat:
                    break
        found.append(flat)
    return found


def _after(side: Numbers) -> Numbers:
    """The next side of the same triangle."""
    return 3 * (side // 3) + (side + 1) % 3


def _simple(loop: Numbers) -> list[Numbers]:
    """A closed chain of vertices cut into ones that pass each vertex once."""
    found, stack, seen = [], [], {}
    for vertex in loop.tolist():
        if vertex in seen:
            begin = seen[vertex]
            found.append(np.array(stack[begin:], np.int64))
            for gone in stack[begin + 1 :]:
                del seen[gone]
            del stack[begin + 1 :]
        else:
            seen[vertex] = len(stack)
            stack.append(vertex)
    found.append(np.array(stack, np.int64))
    return found


def _plane(corners: Floats) -> tuple[Floats, bool]:
    """The unit normal of a border (k, 3) by Newell's sum, and whether it is flat."""
    middle = corners.mean(axis=0)
    local = corners - middle
    normal = np.cross(local, np.roll(local, -1, axis=0)).sum(axis=0)
    size = float(np.abs(local).max(initial=0.0))
    length = float(np.linalg.norm(normal))
    if length <= 1e-9 * size * size:
        return np.zeros(3), False
    normal = normal / length
    return normal, bool(np.abs(local @ normal).max() <= FLAT * size)


def _coplanar(points: Floats, loops: list[Numbers], planes: list[tuple[Floats, bool]]) -> list[list[int]]:
    """Borders in groups: a flat one with those right within it that run the other way in its plane; others alone."""
    flat = [k for k, (_, level) in enumerate(planes) if level]
    areas = {k: float(np.linalg.norm(_area(points[loops[k]]))) for k in flat}
    groups: dict[int, list[int]] = {}
    outers: list[int] = []
    for k in sorted(flat, key=lambda row: -areas[row]):
        around = [j for j in outers if _holds(points, loops[j], loops[k], planes[j][0])]
        # The smallest that holds it is the last.
        if around and planes[around[-1]][0] @ planes[k][0] < -0.999:
            groups[around[-1]].append(k)
        else:
            groups[k] = [k]
            outers.append(k)
    return [*groups.values(), *([k] for k, (_, level) in enumerate(planes) if not level)]


def _area(corners: Floats) -> Floats:
    local = corners - corners[0]
    return np.cross(local, np.roll(local, -1, axis=0)).sum(axis=0) / 2.0


def _holds(points: Floats, outer: Numbers, inner: Numbers, normal: Floats) -> bool:
    """Whether a border lies in another one and in its plane."""
    corners, local = points[outer], points[inner] - points[outer[0]]
    size = float(np.ptp(corners, axis=0).max())
    if np.abs(local @ normal).max() > FLAT * size:
        return False
    axes = _axes(normal)
    ring, point = (corners - corners[0]) @ axes.T, local[0] @ axes.T
    x, y = (ring - point).T
    u, v = np.roll(x, -1), np.roll(y, -1)
    turns = np.arctan2(x * v - y * u, x * u + y * v).sum() / (2.0 * np.pi)
    return bool(abs(turns) > 0.5)


def _axes(normal: Floats) -> Floats:
    """(2, 3) unit vectors that make a right-handed frame with the normal."""
    other = np.eye(3)[int(np.argmin(np.abs(normal)))]
    first = np.cross(other, normal)
    first /= np.linalg.norm(first)
    return np.array([first, np.cross(normal, first)])


def _filled_flat(points: Floats, loops: list[Numbers], normal: Floats) -> Numbers:
    from manifold3d import triangulate

    axes = _axes(normal)
    origin = points[loops[0][0]]
    polygons = [(points[loop] - origin) @ axes.T for loop in loops]
    found = np.asarray(triangulate(polygons), np.int64).reshape(-1, 3)
    return np.concatenate(loops)[found]


def least_area(corners: Floats, barred: NDArray[np.bool_] | None = None) -> Numbers:
    """(k - 2, 3) triangles of least area over a closed chain of corners (k, 3), all running its way, with as few inner
    sides as can be that are `barred` (k, k).

    Of every stretch of the chain the best apex is kept, from short stretches to long ones.
    """
    count = len(corners)
    size = float(np.ptp(corners, axis=0).max())
    cost = np.where(barred, 1e3 * size * size, 0.0) if barred is not None else np.zeros((count, count))
    ring = np.arange(count)
    cost[ring[:-1], ring[1:]] = cost[0, -1] = 0.0
    apex = np.zeros((count, count), np.int64)
    for span in range(2, count):
        begin = np.arange(count - span)
        between = begin[:, None] + np.arange(1, span)  # (b, s) the apices tried
        a, c = corners[begin][:, None], corners[begin + span][:, None]
        areas = np.linalg.norm(np.cross(corners[between] - a, c - a), axis=2) / 2.0
        total = cost[begin[:, None], between] + cost[between, (begin + span)[:, None]] + areas
        best = np.argmin(total, axis=1)
        cost[begin, begin + span] += np.take_along_axis(total, best[:, None], axis=1)[:, 0]
        apex[begin, begin + span] = begin + 1 + best
    found, waiting = [], [(0, count - 1)]
    while waiting:
        low, high = waiting.pop()
        if high - low < 2:
            continue
        middle = int(apex[low, high])
        found.append((low, middle, high))
        waiting += [(low, middle), (middle, high)]
    return np.array(found, np.int64).reshape(-1, 3)
