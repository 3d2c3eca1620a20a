"""Vectors of three numbers, as arrays and as tuples."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def unit(vector: NDArray[np.float64]) -> NDArray[np.float64]:
    """The vector (3,) at length 1; a zero vector as it is."""
    size = float(np.linalg.norm(vector))
    return vector / size if size else vector


def three(values: NDArray[np.floating]) -> tuple[float, float, float]:
    """An array (3,) as plain numbers."""
    x, y, z = (float(value) for value in values)
    return x, y, z
