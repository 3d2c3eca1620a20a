"""Whether a surface encloses a body, so that nobody outside sees the inside of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from ...model.solid.display import DisplayMesh


def is_closed(mesh: DisplayMesh) -> bool:
    """Whether every side of a triangle is also run the other way, and the enclosed volume is positive.

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
    return bool(np.einsum("ij,ij->", np.cross(a, b), c) > 0.0)
