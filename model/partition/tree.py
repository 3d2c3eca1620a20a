"""The tree as arrays. Builders make it, `order`, rays and pictures read it; nothing changes it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .faces import Faces, Floats, Indices

INNER, CONVEX, CONCAVE = 0, 1, 2
"""A node with a plane; a leaf whose fragments lie behind one another's planes; one whose lie in front of them."""

EPSILON = 1e-8
"""How near to a plane counts as in it, as a part of the diagonal of the box around all points."""


@dataclass(frozen=True, slots=True, eq=False)
class Tree:
    """Nodes, and the fragments that the faces were cut into: convex polygons; none crosses a plane on its way down.

    A node owns the fragments first .. first + count: an inner node those that lie in its plane, a leaf all that reach
    it. The front child holds what lies where the normal points to. Fragments that no reachable node owns do not count.
    """

    faces: Faces
    epsilon: float  # millimetres
    points: Floats  # (n, 3) those of the faces, then those of the cuts
    corners: Indices  # (c,) into points, fragment after fragment
    starts: Indices  # (f + 1,) into corners
    source: Indices  # (f,) the face that each fragment is a piece of; those of a node ascending
    plane: Floats  # (k, 4) of inner nodes, else zeros
    front: Indices  # (k,) -1: nothing there
    back: Indices  # (k,)
    first: Indices  # (k,)
    count: Indices  # (k,)
    kind: NDArray[np.int8]  # (k,)
    root: int  # -1: no face, no node

    @property
    def nodes(self) -> int:
        """How many nodes can be reached."""
        return sum(len(level) for level in self.levels())

    @property
    def depth(self) -> int:
        """Nodes on the longest way down."""
        return len(self.levels())

    @property
    def fragments(self) -> int:
        """How many fragments the reachable nodes own."""
        return int(sum(int(self.count[level].sum()) for level in self.levels()))

    def levels(self) -> list[NDArray[np.int64]]:
        """The reachable nodes, level by level from the root."""
        found: list[NDArray[np.int64]] = []
        level = np.array([self.root] if self.root >= 0 else [], dtype=np.int64)
        while len(level):
            found.append(level)
            below = np.concatenate((self.front[level], self.back[level])).astype(np.int64)
            level = below[below >= 0]
        return found


def empty_tree(faces: Faces) -> Tree:
    """The tree of no faces."""
    none = np.zeros(0, np.int32)
    return Tree(
        faces, EPSILON * faces.size, faces.points, none, np.zeros(1, np.int32), none,
        np.zeros((0, 4)), none, none, none, none, np.zeros(0, np.int8), -1,
    )  # fmt: skip
