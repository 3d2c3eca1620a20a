"""Some nodes of a contour under an affine map, with all that hangs on them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from ..document.errors import Refusal
from .nodes import between, handles, settled, splines_moved
from .path import Contour, Kind


def transform(contour: Contour, nodes: ArrayLike, matrix: ArrayLike) -> Contour:
    """Nodes (k,) with their handles, and what lies between two of them, under a matrix (2, 3), or (3, 4) in space.

    A plane matrix leaves the third coordinate of a curve in space. Automatic nodes beside them follow; nodes that a
    shear or a scale makes uneven become smooth. Raises Refusal for nodes that are not there.
    """
    chosen = np.atleast_1d(np.asarray(nodes, np.intp))
    count = len(contour.nodes)
    if ((chosen < 0) | (chosen >= count)).any():
        raise Refusal(f"there is no such node; the curve has {count}, counted from 0")
    mapped = contour.transformed(lifted(matrix) if contour.dimension == 3 else matrix)
    found, both = handles(contour), between(contour, chosen)
    moving = np.zeros(len(contour.points), bool)
    for rows in (found.node[chosen], found.before[chosen], found.after[chosen]):
        moving[rows[rows >= 0]] = True
    moving[contour.starts[both[contour.kinds[both] == Kind.QUADRATIC]] + 1] = True
    points = np.where(moving[:, None], mapped.points, contour.points)
    if contour.closed:
        points[-1] = points[0]
    kinds = contour.nodes.copy()
    kinds[chosen] = mapped.nodes[chosen]
    shift = np.zeros((count, contour.dimension))
    shift[chosen] = (mapped.points - contour.points)[found.node[chosen]]
    at = np.flatnonzero(contour.kinds == Kind.SPLINE)
    splines = tuple(
        whole if segment in both else ended
        for segment, whole, ended in zip(at.tolist(), mapped.splines, splines_moved(contour, shift), strict=True)
    )
    return settled(replace(contour, points=points, nodes=kinds, splines=splines), chosen)


def lifted(matrix: ArrayLike) -> np.ndarray:
    """(3, 4) of a plane matrix (2, 3), which leaves z as it is."""
    affine = np.asarray(matrix, float)
    if affine.shape != (2, 3):
        return affine
    made = np.eye(3, 4)
    made[:2, :2], made[:2, 3] = affine[:, :2], affine[:, 2]
    return made
