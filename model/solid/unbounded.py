"""Half-spaces, and what has no end: where it ends, or that it does not.

A half-space is cut by a box with one face on the plane. What bounds it elsewhere in the tree decides how large the box
must be, so that none of its other faces is left in a result.
"""

from __future__ import annotations

import math
from itertools import combinations

import numpy as np
from manifold3d import Manifold
from numpy.typing import NDArray

from ..document.nodes import Difference, Intersection, Node
from ..document.placement import inverse, product, unit
from ..document.primitives import Halfspace
from .failure import NoSolid

MOST_PLANES = 120


class Ends:
    """Tells, and remembers by digest, whether a node may go on without end."""

    def __init__(self) -> None:
        self._known: dict[bytes, bool] = {}

    def endless(self, root: Node) -> bool:
        stack = [root]
        while stack:
            node = stack[-1]
            if node.shape_digest in self._known:
                stack.pop()
                continue
            missing = [child for child in node.children if child.shape_digest not in self._known]
            if missing:
                stack += missing
                continue
            self._known[node.shape_digest] = self._of(node)
            stack.pop()
        return self._known[root.shape_digest]

    def _of(self, node: Node) -> bool:
        below = [self._known[child.shape_digest] for child in node.children]
        if isinstance(node, Halfspace):
            return True
        if isinstance(node, Intersection):
            return bool(below) and all(below)
        if isinstance(node, Difference):
            return bool(below) and below[0]
        return any(below)


def halfspace_box(node: Halfspace, box: NDArray[np.float64]) -> Manifold:
    """A box with one face on the node's plane that covers all of `box` (2, 3) on the kept side, in the node's axes."""
    normal = unit(node.normal, "Half-space: the normal")
    point = np.array(node.point, dtype=np.float64)
    middle = box.mean(axis=0)
    reach = float(np.linalg.norm(box[1] - box[0])) / 2
    size = 2.0 ** math.ceil(math.log2(4 * reach + 2 * abs(float(normal @ (middle - point))) + 1e-9))
    # The frame's third axis is the normal; along a coordinate axis all of its numbers are exact.
    first = np.zeros(3)
    first[int(np.argmin(np.abs(normal)))] = 1
    across = np.cross(normal, first)
    across /= np.linalg.norm(across)
    frame = np.column_stack((np.cross(across, normal), across, normal))
    foot = middle - normal * float(normal @ (middle - point))
    # Along the plane the box is anchored on a coarse grid, so that small moves of what it cuts leave it as it is.
    if np.count_nonzero(normal) == 1:
        axis = int(np.flatnonzero(normal)[0])
        foot = np.where(np.arange(3) == axis, point, np.round(foot / size) * size)
    solid = Manifold.cube((2 * size, 2 * size, size)).translate((-size, -size, 0))
    return solid.transform(np.column_stack((frame, foot))).as_original()


def coarse(box: NDArray[np.float64]) -> NDArray[np.float64]:
    """`box` (2, 3) grown to a grid of an eighth of its size, so that nearly equal boxes are one key."""
    size = float(np.max(box[1] - box[0]))
    step = 2.0 ** (math.ceil(math.log2(size)) - 3) if size > 0 else 1.0
    return np.array([np.floor(box[0] / step - 0.5) * step, np.ceil(box[1] / step + 0.5) * step])


def box_within(box: NDArray[np.float64], matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    """The box, in the axes before `matrix` (3, 4), that holds all of `box` (2, 3)."""
    back = inverse(matrix)
    return mapped(box, back)


def mapped(box: NDArray[np.float64], matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    """The bounds (2, 3) of a box's corners under a (3, 4) map."""
    corners = np.array([[box[i, 0], box[j, 1], box[k, 2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    points = corners @ matrix[:, :3].T + matrix[:, 3]
    return np.array([points.min(axis=0), points.max(axis=0)])


def planes_of(root: Node, copies) -> NDArray[np.float64]:
    """(n, 4) unit normal and offset of every half-space's plane below `root`, in its axes.

    `copies(node)` yields the (3, 4) maps of the copies that a node makes of its operands. Raises NoSolid.
    """
    planes: list[NDArray[np.float64]] = []
    stack: list[tuple[Node, NDArray[np.float64]]] = [(root, np.eye(3, 4))]
    while stack:
        node, matrix = stack.pop()
        if isinstance(node, Halfspace):
            normal = inverse(matrix)[:, :3].T @ unit(node.normal, "Half-space: the normal")
            normal /= np.linalg.norm(normal)
            point = matrix[:, :3] @ np.array(node.point, dtype=np.float64) + matrix[:, 3]
            planes.append(np.append(normal, normal @ point))
            if len(planes) > MOST_PLANES:
                raise NoSolid(f"more than {MOST_PLANES} half-spaces bound nothing else; intersect them with a box")
            continue
        for copy in copies(node):
            for child in node.children:
                stack.append((child, product(product(matrix, copy), child.placement.matrix())))
    return np.array(planes).reshape(-1, 4)


def bounding_reach(planes: NDArray[np.float64], extent: float) -> float:
    """Half the side of a cube about the origin that holds every point where three of the planes (n, 4) meet.

    `extent` is the reach of all that is bounded; the result is at least twice as large.
    """
    reach = max(extent, float(np.abs(planes[:, 3]).max(initial=0.0)), 1.0)
    triples = np.array(list(combinations(range(len(planes)), 3)), dtype=np.int64).reshape(-1, 3)
    if len(triples):
        normals, offsets = planes[triples][:, :, :3], planes[triples][:, :, 3]
        proper = np.abs(np.linalg.det(normals)) > 1e-9
        if proper.any():
            meets = np.linalg.solve(normals[proper], offsets[proper][:, :, None])
            reach = max(reach, float(np.abs(meets).max()))
    return 2 * reach
