"""The textbook's figure: objects A to E in the plane, and the lines h1 to h3 that tell them apart.

Seen along h3, D lies right of it, A and E lie left; B lies in the negative half-space of h1 and C in the positive one
of h2, where the view cone does not reach: both are pruned. The figure is stored as a layout of numbers, and becomes a
tree like any model's.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .faces import Faces, Floats, faces_of_polygons
from .order import Sorter
from .tree import CONVEX, EPSILON, INNER, Tree

Point = tuple[float, float]

WIDTH, HEIGHT = 100.0, 80.0
EYE: Point = (52.0, 6.0)
ALONG: Point = (0.0, 1.0)
"""The direction of h3, in which the eye looks."""
ANGLE = 52.0
"""Degrees of the view cone."""

OBJECTS: dict[str, tuple[Point, ...]] = {
    "A": ((32.0, 56.0), (39.0, 52.0), (46.0, 57.0), (44.0, 68.0), (34.0, 67.0)),
    "B": ((5.0, 30.0), (13.0, 27.0), (17.0, 36.0), (9.0, 43.0)),
    "C": ((83.0, 21.0), (94.0, 24.0), (92.0, 36.0), (84.0, 32.0)),
    "D": ((60.0, 44.0), (71.0, 47.0), (68.0, 60.0), (58.0, 57.0)),
    "E": ((39.0, 32.0), (47.0, 34.0), (45.0, 44.0), (38.0, 42.0)),
}
"""Convex, counter-clockwise."""


@dataclass(frozen=True, slots=True)
class Line:
    """A line of the plane with its positive and its negative half."""

    name: str
    start: Point
    end: Point

    @property
    def plane(self) -> Floats:
        """(4,) unit normal, to the left of the way from start to end, and offset, as of a tree's node."""
        x, y = np.subtract(self.end, self.start)
        normal = np.array([-y, x, 0.0]) / np.hypot(x, y)
        return np.append(normal, normal[:2] @ self.start)

    def height(self, point: Point) -> float:
        """f(p): above 0 in front."""
        plane = self.plane
        return float(plane[0] * point[0] + plane[1] * point[1] - plane[3])


LINES: tuple[Line, ...] = (
    Line("h1", (2.0, 66.0), (46.0, 2.0)),
    Line("h2", (98.0, 66.0), (60.0, 2.0)),
    Line("h3", (52.0, 80.0), (52.0, 0.0)),
)
SPLIT = Line("a", (30.0, 48.0), (50.0, 48.0))
"""Between A and E, which share a cell of those three: what lies in one cell is told apart by one line more."""


@dataclass(frozen=True, slots=True, eq=False)
class Figure:
    """The tree of the layout, and what its numbers stand for."""

    tree: Tree
    names: tuple[str, ...]  # (k,) of the nodes: of their lines, or of the object that a leaf holds
    object_of: tuple[str, ...]  # (faces,) which object each face bounds


def figure() -> Figure:
    """The layout as a tree: h1 keeps B apart, h2 keeps C apart, h3 has D on its right and A and E on its left.

    Each object stands on the plane z = 0 as a prism of height 1 without top and bottom.
    """
    h1, h2, h3 = LINES
    #           name, plane, front, back
    nodes = (
        (h1.name, h1.plane, 1, 2),
        (h2.name, h2.plane, 3, 4),
        ("B", None, -1, -1),
        ("C", None, -1, -1),
        (h3.name, h3.plane, 5, 6),
        ("D", None, -1, -1),
        (SPLIT.name, SPLIT.plane, 7, 8),
        ("A", None, -1, -1),
        ("E", None, -1, -1),
    )
    walls: list[list[tuple[float, float, float]]] = []
    object_of: list[str] = []
    first, count = [], []
    for name, plane, _, _ in nodes:
        first.append(len(walls))
        if plane is None:
            ring = OBJECTS[name]
            for (x, y), (u, v) in zip(ring, (*ring[1:], ring[0]), strict=True):
                walls.append([(x, y, 0.0), (u, v, 0.0), (u, v, 1.0), (x, y, 1.0)])
                object_of.append(name)
        count.append(len(walls) - first[-1])
    faces = _grouped(faces_of_polygons(walls), object_of)
    tree = Tree(
        faces=faces,
        epsilon=EPSILON * faces.size,
        points=faces.points,
        corners=faces.corners,
        starts=faces.starts,
        source=np.arange(faces.count, dtype=np.int32),
        plane=np.array([np.zeros(4) if plane is None else plane for _, plane, _, _ in nodes]),
        front=np.array([node[2] for node in nodes], np.int32),
        back=np.array([node[3] for node in nodes], np.int32),
        first=np.array(first, np.int32),
        count=np.array(count, np.int32),
        kind=np.array([CONVEX if plane is None else INNER for _, plane, _, _ in nodes], np.int8),
        root=0,
    )
    return Figure(tree, tuple(node[0] for node in nodes), tuple(object_of))


def _grouped(faces: Faces, object_of: list[str]) -> Faces:
    group = np.array([list(OBJECTS).index(name) for name in object_of], np.int32)
    return replace(faces, group=group, side=np.ones(faces.count, np.int8))


def back_to_front(shown: Figure, eye: Point) -> list[str]:
    """The objects in the painter's order for an eye in the plane."""
    order = Sorter(shown.tree).fragments((*eye, 0.5))
    return list(dict.fromkeys(shown.object_of[face] for face in shown.tree.source[order]))
