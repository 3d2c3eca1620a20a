"""Slivers taken out of a mesh: short sides drawn together, long ones laid across."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from .report import arrays_of
from .sides import Flags, Floats, Numbers, Sides, heights_of, normals_of, sides_of, twins
from .welding import proper, without_unused
from .words import many

ROUNDS = 200
"""Each takes all slivers that do not touch one another; what is left after these is left."""


@dataclass(frozen=True, slots=True, eq=False)
class _Thin:
    """The slivers `rows` (k,), the number 0 to 2 of their `long` and `short` sides, and all heights (m,)."""

    rows: Numbers
    long: Numbers
    short: Numbers
    tiny: Flags
    heights: Floats


def drop_slivers(vertices: ArrayLike, triangles: ArrayLike, tolerance: float) -> tuple[Floats, Numbers, str]:
    """Triangles with a height within `tolerance` mm taken out, so that the surface moves no farther than about that.

    Where a side is that short its ends become one, if the surface stays a surface and no neighbour turns round.
    Elsewhere the longest side gives way to one from the sliver's far corner to its neighbour's; on a border the sliver
    is dropped. What allows neither is left. Returns vertices (n, 3), triangles (m, 3) and words about what changed.
    Raises Refusal as `find_faults` does.
    """
    points, faces = arrays_of(vertices, triangles, tolerance)
    faces = proper(faces)
    before = len(_thin(points, faces, tolerance).rows)
    for _ in range(ROUNDS):
        thin = _thin(points, faces, tolerance)
        if not len(thin.rows):
            break
        found = _collapsed(points, faces, thin)
        if found is None:
            found = _flipped(points, faces, thin, tolerance)
        if found is None:
            break
        faces = found
    left = len(_thin(points, faces, tolerance).rows)
    gone = before - left
    points, faces = without_unused(points, faces)
    words = [f"{many(gone, 'sliver')} taken out"] if gone else []
    if left:
        words.append(f"{many(left, 'sliver')} left")
    return points, faces, ", ".join(words)


def _thin(points: Floats, faces: Numbers, tolerance: float) -> _Thin:
    heights, lengths = heights_of(points, faces)
    rows = np.flatnonzero(heights <= tolerance)
    mine = lengths[rows]
    if not len(rows):
        return _Thin(rows, rows, rows, rows > 0, heights)
    return _Thin(rows, mine.argmax(axis=1), mine.argmin(axis=1), mine.min(axis=1) <= tolerance, heights)


def _collapsed(points: Floats, faces: Numbers, thin: _Thin) -> Numbers | None:
    """With short sides drawn together to the end with the lower number; None where none can be."""
    sides = sides_of(faces, len(points))
    edges = np.unique(sides.edge[(3 * thin.rows + thin.short)[thin.tiny]])
    if not len(edges):
        return None
    kept, gone = sides.ends[edges].T
    starts, around = _stars(faces, len(points))
    on_rim = np.zeros(len(points), bool)
    on_rim[sides.ends[sides.uses != 2]] = True
    # A surface stays one where the two ends have no neighbours in common but those of the edge's own triangles.
    row, triangle = _spread(starts, around, gone)
    at = np.concatenate((row, _spread(starts, around, kept)[0]))
    touched = np.concatenate((triangle, _spread(starts, around, kept)[1]))
    ring = np.column_stack((np.repeat(at, 3), faces[touched].reshape(-1)))
    other = np.repeat(np.arange(len(at)) < len(row), 3)
    by_gone, by_kept = (np.unique(ring[chosen], axis=0) for chosen in (other, ~other))
    common, times = np.unique(np.vstack((by_gone, by_kept)), axis=0, return_counts=True)
    shared = np.bincount(common[times == 2, 0], minlength=len(edges)) - 2
    right = (shared == sides.uses[edges]) & (sides.uses[edges] <= 2)
    right &= ~(on_rim[kept] & on_rim[gone]) | (sides.uses[edges] == 1)
    # No triangle may turn round, but for slivers, which have no direction of their own.
    moved = np.where(faces[triangle] == gone[row, None], kept[row, None], faces[triangle])
    stays = (faces[triangle] != kept[row, None]).all(axis=1) & ~np.isin(triangle, thin.rows)
    turned = np.einsum("ij,ij->i", normals_of(points, faces[triangle]), normals_of(points, moved)) <= 0.0
    right[row[turned & stays]] = False
    length = np.linalg.norm(points[kept] - points[gone], axis=1)
    taken = _apart(ring[:, 0], ring[:, 1], length, right, len(points))
    if not taken.any():
        return None
    target = np.arange(len(points))
    target[gone[taken]] = kept[taken]
    return proper(target[faces])


def _flipped(points: Floats, faces: Numbers, thin: _Thin, tolerance: float) -> Numbers | None:
    """With the longest sides of slivers laid across, and slivers on borders dropped; None where none can be."""
    sides = sides_of(faces, len(points))
    side = 3 * thin.rows + thin.long
    rim = sides.open[sides.edge[side]]
    if rim.any():
        kept = np.ones(len(faces), bool)
        kept[thin.rows[rim]] = False
        return faces[kept]
    beyond = twins(sides)[side]
    row, side, beyond = (part[beyond >= 0] for part in (thin.rows, side, beyond))
    neighbour = beyond // 3
    a, b = sides.start[side], sides.end[side]
    c, d = _facing(faces, side), _facing(faces, beyond)
    one, two = np.column_stack((a, d, c)), np.column_stack((d, b, c))
    height = np.minimum(heights_of(points, one)[0], heights_of(points, two)[0])
    ahead = normals_of(points, faces[neighbour])
    thick = ~np.isin(neighbour, thin.rows)
    agree = np.minimum(*(np.einsum("ij,ij->i", normals_of(points, part), ahead) for part in (one, two))) > 0.0
    right = (height > np.minimum(thin.heights[row], thin.heights[neighbour])) & (agree | ~thick)
    right &= (height > tolerance) | ~thick  # else there would be two slivers for one
    right &= (c != d) & ~_known(sides, c, d, len(points))
    corners = np.column_stack((a, b, c, d))
    number = np.repeat(np.arange(len(row)), 4)
    taken = _apart(number, corners.reshape(-1), -height, right, len(points))
    if not taken.any():
        return None
    result = faces.copy()
    result[row[taken]], result[neighbour[taken]] = one[taken], two[taken]
    return result


def _facing(faces: Numbers, side: Numbers) -> Numbers:
    """The corners opposite to sides."""
    return faces[side // 3, (side + 2) % 3]


def _known(sides: Sides, one: Numbers, two: Numbers, count: int) -> Flags:
    """Which pairs of vertices have an edge."""
    return np.isin(np.minimum(one, two) * count + np.maximum(one, two), sides.ends @ (count, 1))


def _stars(faces: Numbers, count: int) -> tuple[Numbers, Numbers]:
    """The triangles at each vertex: (count + 1,) where each begins, and the triangles."""
    corners = faces.reshape(-1)
    starts = np.concatenate(([0], np.cumsum(np.bincount(corners, minlength=count))))
    return starts, np.argsort(corners, kind="stable") // 3


def _spread(starts: Numbers, around: Numbers, vertices: Numbers) -> tuple[Numbers, Numbers]:
    """The triangles at vertices (k,): rows of these, and triangles."""
    number = starts[vertices + 1] - starts[vertices]
    row = np.repeat(np.arange(len(vertices)), number)
    within = np.arange(len(row)) - np.repeat(np.cumsum(number) - number, number)
    return row, around[starts[vertices][row] + within]


def _apart(row: Numbers, vertex: Numbers, cost: Floats, right: Flags, count: int) -> Flags:
    """(k,) some of the changes that are right, the cheaper first, no two of which have a vertex in common.

    Row i of `row` and `vertex` says that a change touches a vertex.
    """
    rank = np.empty(len(right), np.int64)
    rank[np.lexsort((cost, ~right))] = np.arange(len(right))
    usable = right[row]
    best = np.full(count, len(right))
    np.minimum.at(best, vertex[usable], rank[row[usable]])
    taken = right.copy()
    taken[row[usable & (best[vertex] != rank[row])]] = False
    return taken
