"""Vertices within a tolerance made one, and the edges that run past a vertex cut there."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .nearness import close_pairs, near_edges
from .report import arrays_of
from .sides import Floats, Numbers, distinct_places, sides_of
from .words import many

ROUNDS = 20
"""How often edges are cut again, since a cut edge may run past another vertex."""


def weld(vertices: ArrayLike, triangles: ArrayLike, tolerance: float) -> tuple[Floats, Numbers, str]:
    """Vertices within `tolerance` mm of each other as one; triangles that lose their area by it are dropped.

    What is left stays where it was: of near vertices the first one is taken, so that nothing moves farther than the
    tolerance. With 0 only vertices at the very same place become one. Vertices that no triangle has are dropped too.
    Returns vertices (n, 3), triangles (m, 3) and words about what changed. Raises Refusal as `find_faults` does.
    """
    points, faces = arrays_of(vertices, triangles, tolerance)
    used = np.unique(faces)
    target = np.arange(len(points))
    target[used] = used[joined(points[used], tolerance)]
    moved = int((target[used] != used).sum())
    points, kept = without_unused(points, proper(target[faces]))
    words = [f"{many(moved, 'vertex', 'vertices')} welded"] if moved else []
    if len(kept) < len(faces):
        words.append(f"{many(len(faces) - len(kept), 'triangle')} without area dropped")
    return points, kept, ", ".join(words)


def split_edges(vertices: ArrayLike, triangles: ArrayLike, tolerance: float) -> tuple[Floats, Numbers, str]:
    """Open edges cut where a vertex of an open edge lies within `tolerance` mm of them, so that welding joins the two.

    The triangle at the edge is cut with it, from its far corner. Returns as `weld` does, and raises as it does.
    """
    points, faces = arrays_of(vertices, triangles, tolerance)
    faces = proper(faces)
    before = len(faces)
    for _ in range(ROUNDS):
        cut = _cut_once(points, faces, tolerance)
        if len(cut) == len(faces):
            break
        faces = cut
    cuts = len(faces) - before
    return (
        points,
        faces,
        f"{many(cuts, 'open edge')} cut at a vertex beside {'it' if cuts == 1 else 'them'}" if cuts else "",
    )


def _cut_once(points: Floats, faces: Numbers, tolerance: float) -> Numbers:
    """Of each triangle one open edge at one vertex: the one that lies nearest to the middle."""
    sides = sides_of(faces, len(points))
    rim = np.flatnonzero(sides.open)
    if not len(rim):
        return faces
    on_edges, _ = near_edges(points, faces, sides.only(rim), tolerance)
    if not len(on_edges):
        return faces
    count = len(points)
    edge = rim[np.searchsorted(sides.ends[rim] @ (count, 1), on_edges.vertices[:, 1:] @ (count, 1))]
    side = sides.first[edge]
    free = (faces[side // 3] != on_edges.vertices[:, :1]).all(axis=1)
    side, vertex = side[free], on_edges.vertices[free, 0]
    middle = (points[sides.start[side]] + points[sides.end[side]]) / 2.0
    order = np.lexsort((np.linalg.norm(points[vertex] - middle, axis=1), side // 3))
    side, vertex = side[order], vertex[order]
    first = np.unique(side // 3, return_index=True)[1]
    side, vertex = side[first], vertex[first]
    row, corner = side // 3, side % 3
    a, b, c = (faces[row, (corner + k) % 3] for k in range(3))
    result = faces.copy()
    result[row] = np.column_stack((a, vertex, c))
    return np.vstack((result, np.column_stack((vertex, b, c))))


def joined(points: Floats, tolerance: float) -> Numbers:
    """(n,) which point each becomes: one within the tolerance that becomes itself."""
    place = distinct_places(points)
    _, first = np.unique(place, return_index=True)
    target = first[place]
    if tolerance <= 0.0:
        return target
    order = np.sort(first)
    pairs = order[close_pairs(points[order], tolerance)]
    # In rounds: a free point with no free one before it in its neighbourhood stays, and takes its neighbours.
    pairs = np.concatenate((pairs, pairs[:, ::-1]))
    free = np.zeros(len(points), bool)
    free[order] = True
    while len(pairs):
        led = np.zeros(len(points), bool)
        led[pairs[pairs[:, 0] < pairs[:, 1], 1]] = True
        stays = free & ~led
        leads = pairs[stays[pairs[:, 0]]]
        leader = np.full(len(points), len(points))
        np.minimum.at(leader, leads[:, 1], leads[:, 0])
        taken = np.flatnonzero(leader < len(points))
        own = np.arange(len(points))
        own[taken] = leader[taken]
        target = own[target]
        free &= ~stays
        free[taken] = False
        pairs = pairs[free[pairs].all(axis=1)]
    return target


def proper(triangles: Numbers) -> Numbers:
    """Those whose corners differ."""
    return triangles[(triangles != np.roll(triangles, 1, axis=1)).all(axis=1)]


def without_unused(vertices: Floats, triangles: Numbers) -> tuple[Floats, Numbers]:
    """Without the vertices that no triangle has."""
    used = np.zeros(len(vertices), bool)
    used[triangles] = True
    return vertices[used], (np.cumsum(used) - 1)[triangles]
