"""Heights to normals: bump maps as normal maps."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def normals_of(heights: Floats, *, strength: float = 1.0, texel: float = 1.0, wrap: bool = False) -> Floats:
    """Unit normals (height, width, 3) of heights (height, width), both in rows from the top down.

    The slope is taken by central differences over `texel`, the distance of two texels in the unit of the heights, and
    multiplied by `strength`; at the border from the opposite side with `wrap`, else by one-sided differences, so a
    tilted plane has its own normal everywhere. x points right, y up (the rows run down), z out of the surface.
    """
    heights = np.asarray(heights, np.float64)
    if heights.ndim != 2 or not heights.size:
        raise ValueError(f"heights must be (height, width), not {heights.shape}")
    if not texel > 0.0:
        raise ValueError("a texel must have a positive size")
    across, down = (_slope(heights, axis, wrap) * (strength / texel) for axis in (1, 0))
    normals = np.stack([-across, down, np.ones_like(heights)], axis=2)
    return normals / np.linalg.norm(normals, axis=2, keepdims=True)


def colours_of_normals(normals: Floats) -> NDArray[np.uint8]:
    """(height, width, 3): -1 to 1 as 0 to 255, as normal maps are stored."""
    return np.clip(np.rint((normals + 1.0) * 127.5), 0, 255).astype(np.uint8)


def _slope(heights: Floats, axis: int, wrap: bool) -> Floats:
    if wrap:
        return (np.roll(heights, -1, axis) - np.roll(heights, 1, axis)) / 2.0
    if heights.shape[axis] == 1:
        return np.zeros_like(heights)
    return np.gradient(heights, axis=axis)
