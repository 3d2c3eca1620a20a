"""Maps of solids: placing them, and what a map does to a tolerance."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from manifold3d import Manifold
from numpy.typing import NDArray

from ..document.nodes import Node
from ..document.placement import IDENTITY, Placement, product
from .failure import NoSolid

Matrix = NDArray[np.float64]  # (3, 4)


def matrix_of(node: Node) -> Matrix:
    """The node's placement; the very IDENTITY where it has none."""
    return node.placement.matrix() if node.placement.steps else IDENTITY


def chained(outer: Matrix, inner: Matrix) -> Matrix:
    """`inner`, then `outer`."""
    if outer is IDENTITY:
        return inner
    return outer if inner is IDENTITY else product(outer, inner)


def moved(solid: Manifold, matrix: Matrix) -> Manifold:
    """The solid under a map. Raises NoSolid for one that flattens."""
    if abs(float(np.linalg.det(matrix[:, :3]))) < 1e-300:
        raise NoSolid("a scale factor is 0: the solid would be flat")
    return solid.transform(matrix)


def tolerance_before(tolerance: float, matrix: Matrix) -> float:
    """The tolerance that becomes `tolerance` under the map, in steps of the square root of two, never a coarser one."""
    scale = 1.0 if matrix is IDENTITY else _stretch(matrix[:, :3].tobytes())
    if abs(scale - 1) < 1e-9 or scale <= 0:
        return tolerance
    return float(tolerance / 2.0 ** (np.ceil(2 * np.log2(scale) - 1e-9) / 2))


@lru_cache(maxsize=1 << 12)
def _stretch(linear: bytes) -> float:
    """By how much a map stretches what it stretches most."""
    return float(np.linalg.norm(np.frombuffer(linear).reshape(3, 3), 2))


def placed_tolerance(tolerance: float, placement: Placement) -> float:
    """The tolerance before a placement."""
    return tolerance_before(tolerance, placement.matrix()) if placement.steps else tolerance
