"""What a finding looks like: the edges and the faces that it is about."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .report import Finding
from .sides import Floats

FACES = ("crossing", "duplicate", "degenerate", "sliver")
"""The kinds of findings whose vertices are corners of triangles, three each; the other ones are about edges."""


def drawn(vertices: Floats, triangles: NDArray[np.integer], finding: Finding) -> tuple[Floats, Floats]:
    """Lines (k, 2, 3) and triangles (m, 3, 3) of a finding in the mesh of triangles (t, 3) over vertices (n, 3).

    None of either where the mesh is another one, whose vertices with these numbers lie elsewhere.
    """
    numbers = finding.vertices
    nothing = np.zeros((0, 2, 3)), np.zeros((0, 3, 3))
    if not len(numbers) or int(numbers.max()) >= len(vertices):
        return nothing
    low, high = vertices[numbers].min(axis=0), vertices[numbers].max(axis=0)
    room = 1e-6 * float(np.ptp(vertices, axis=0).max()) + finding.gap
    if ((finding.place < low - room) | (finding.place > high + room)).any():
        return nothing
    if finding.kind in FACES:
        return nothing[0], vertices[numbers.reshape(-1, 3)]
    if finding.kind == "border":
        return vertices[_open_within(numbers, triangles, len(vertices))], nothing[1]
    if finding.kind == "near vertex-edge":  # the vertex, and the ends of the edge
        return np.stack((vertices[numbers[1:]], [vertices[numbers[0]], finding.place])), nothing[1]
    return vertices[numbers.reshape(-1, 2)], nothing[1]


def _open_within(numbers: NDArray[np.int64], triangles: NDArray[np.integer], count: int) -> NDArray[np.int64]:
    """The edges (k, 2) between some of the vertices that have one triangle."""
    member = np.zeros(count, bool)
    member[numbers] = True
    near = triangles[member[triangles].sum(axis=1) > 1].astype(np.int64)
    ends = np.sort(np.stack((near, np.roll(near, -1, axis=1)), axis=2).reshape(-1, 2), axis=1)
    ends = ends[member[ends].all(axis=1) & (ends[:, 0] != ends[:, 1])]
    edges, uses = np.unique(ends, axis=0, return_counts=True)
    return edges[uses == 1]
