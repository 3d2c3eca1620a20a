"""Whether a surface encloses a body, so that nobody outside sees the inside of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from ...model.solid.display import DisplayMesh


def is_closed(mesh: DisplayMesh) -> bool:
    """Whether every side of a triangle is also run the other way, and the volume that each shell encloses is positive.

    A cavity's shell is not told from one that is inside out: both are seen from the inside, or may be.

    Sides add up to zero when each stands for a number of its own, negative one way: a sum of mixed bits (splitmix64,
    Steele, Lea and Flood 2014) instead of sorting them all.
    """
    if not len(mesh.corners):
        return False
    begin = mesh.corners.astype(np.uint64)
    end = begin[:, [1, 2, 0]]
    low, high = np.minimum(begin, end), np.maximum(begin, end)
    bits = low * np.uint64(len(mesh.vertices)) + high + np.uint64(0x9E3779B97F4A7C15)
    for shift, factor in ((30, 0xBF58476D1CE4E5B9), (27, 0x94D049BB133111EB)):
        bits = (bits ^ (bits >> np.uint64(shift))) * np.uint64(factor)
    bits ^= bits >> np.uint64(31)
    if int(np.where(begin < end, bits, ~bits + np.uint64(1)).sum(dtype=np.uint64)):
        return False
    a, b, c = (mesh.vertices[mesh.corners[:, corner]] - mesh.vertices[0] for corner in range(3))
    volumes = np.einsum("ij,ij->i", np.cross(a, b), c)
    return bool((np.bincount(np.unique(_shells(mesh), return_inverse=True)[1], volumes) > 0.0).all())


def _shells(mesh: DisplayMesh) -> NDArray[np.int64]:
    """(t,) the least vertex of all triangles that hang together by their vertices.

    Vertices are hooked to smaller ones, and ways shortened, until no side joins two trees (Shiloach and Vishkin 1982).
    """
    corners = mesh.corners.astype(np.int64)
    above = np.arange(len(mesh.vertices))
    one, other = corners[:, [0, 0]].ravel(), corners[:, [1, 2]].ravel()
    while len(one):
        np.minimum.at(above, np.maximum(one, other), np.minimum(one, other))
        while not np.array_equal(above, shorter := above[above]):
            above = shorter
        one, other = above[one], above[other]
        apart = one != other
        one, other = one[apart], other[apart]
    return above[corners[:, 0]]
