"""What a view cone prunes: sub-trees on the far side of a plane that the cone does not reach over.

Before a plane's sub-tree is walked, the cone is compared with the plane: where it lies wholly on one side, nothing of
the other side can be seen (Fuchs, Kedem and Naylor 1980 do so with the planes of the picture's sides).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .faces import Floats
from .tree import INNER, Tree


@dataclass(frozen=True, slots=True, eq=False)
class Cone:
    """All points that are a mean of `points` plus any sum of `rays` with factors of at least 0.

    A perspective view is its eye and the rays through the picture's corners; a parallel one the corners themselves and
    the view's direction; a view in the plane an eye and two rays.
    """

    points: Floats  # (p, 3) at least one
    rays: Floats  # (r, 3) of any length

    def sides(self, planes: Floats) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Whether something of the cone lies before, and whether something lies behind each plane (k, 4)."""
        heights = planes[:, :3] @ self.points.T - planes[:, 3:]
        slopes = planes[:, :3] @ self.rays.T
        before = np.any(heights > 0.0, axis=1) | np.any(slopes > 0.0, axis=1)
        behind = np.any(heights < 0.0, axis=1) | np.any(slopes < 0.0, axis=1)
        return before, behind


def view_cone(eye: ArrayLike, corners: ArrayLike) -> Cone:
    """The cone from an eye (3,) through the points (n, 3), which lie around the picture."""
    apex = np.asarray(eye, float).reshape(1, 3)
    return Cone(apex, np.asarray(corners, float).reshape(-1, 3) - apex)


def flat_cone(eye: ArrayLike, direction: ArrayLike, angle: float) -> Cone:
    """The cone in the plane z = 0 from `eye` (2,) about `direction` (2,), `angle` degrees wide (less than 180)."""
    towards = np.arctan2(*np.asarray(direction, float)[::-1])
    ends = towards + np.radians([-0.5 * angle, 0.5 * angle])
    rays = np.column_stack((np.cos(ends), np.sin(ends), np.zeros(2)))
    return Cone(np.append(np.asarray(eye, float), 0.0).reshape(1, 3), rays)


@dataclass(frozen=True, slots=True, eq=False)
class Pruning:
    """What is left of a tree in a view."""

    seen: NDArray[np.bool_]  # (k,) nodes that are walked
    cut: NDArray[np.int64]  # the topmost nodes of what is pruned, ascending
    nodes: int  # walked
    fragments: int  # owned by them


def prune(tree: Tree, cone: Cone) -> Pruning:
    """The nodes that a walk for the view has to visit. No fragment of the others reaches into the cone."""
    seen = np.zeros(len(tree.kind), bool)
    before, behind = cone.sides(tree.plane)
    inner = tree.kind == INNER
    level = np.array([tree.root] if tree.root >= 0 else [], np.int64)
    cut: list[NDArray[np.int64]] = []
    while len(level):
        seen[level] = True
        level = level[inner[level]]
        below = np.concatenate((tree.front[level], tree.back[level])).astype(np.int64)
        reached = np.concatenate((before[level], behind[level]))
        cut.append(below[~reached & (below >= 0)])
        level = below[reached & (below >= 0)]
    pruned = np.sort(np.concatenate(cut)) if cut else np.zeros(0, np.int64)
    return Pruning(seen, pruned, int(seen.sum()), int(tree.count[seen].sum()))
