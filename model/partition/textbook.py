"""The textbook's builder: the first face is the root, each further one is put in and cut where it crosses a plane.

Fuchs, Kedem and Naylor (1980), without any choice of planes. It stands beside the good one for teaching and for
comparison: its order can be checked by hand, its trees are as deep and as cut up as the faces happen to come.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..document.errors import Refusal
from .faces import Faces, Floats
from .tree import EPSILON, INNER, Tree, empty_tree

MOST_CUTS = 50_000
"""Some seconds of work; faces that cross at random are cut millions of times."""


def build_in_order(faces: Faces, order: Sequence[int] | None = None) -> Tree:
    """The tree of the faces, put in one after the other in `order` (default: as they come).

    Raises Refusal where that takes more than MOST_CUTS cuts.
    """
    if not faces.count:
        return empty_tree(faces)
    epsilon = EPSILON * faces.size
    points = [np.array(point) for point in faces.points]
    planes: list[Floats] = []
    plane_of: list[int] = []  # the number of each among the faces' planes
    children: list[list[int]] = []  # [back, front]
    owned: list[list[tuple[int, list[int]]]] = []
    cuts = 0
    for face in range(faces.count) if order is None else order:
        ring = faces.corners[faces.starts[face] : faces.starts[face + 1]].tolist()
        waiting: list[tuple[int, int, list[int]]] = [(0 if planes else -1, -1, ring)]  # node, way to it, polygon
        parents = [-1]
        while waiting:
            node, way, ring = waiting.pop()
            parent = parents.pop()
            if node < 0:
                planes.append(faces.planes[faces.plane_of[face]])
                plane_of.append(int(faces.plane_of[face]))
                children.append([-1, -1])
                owned.append([(face, ring)])
                if parent >= 0:
                    children[parent][way] = len(planes) - 1
                continue
            plane = planes[node]
            heights = np.array([points[i] @ plane[:3] - plane[3] for i in ring])
            if plane_of[node] == faces.plane_of[face] or (np.abs(heights) <= epsilon).all():
                owned[node].append((face, ring))
                continue
            pieces = cut(ring, heights, epsilon, points)
            cuts += all(len(piece) >= 3 for piece in pieces)
            if cuts > MOST_CUTS:
                raise Refusal(
                    f"the textbook's builder cuts these {faces.count:,} faces more than {MOST_CUTS:,} times; take the "
                    "good one"
                )
            for side, piece in enumerate(pieces):
                if len(piece) >= 3:
                    waiting.append((children[node][side], side, piece))
                    parents.append(node)
    return _tree(faces, epsilon, points, planes, children, owned)


def cut(ring: list[int], heights: Floats, epsilon: float, points: list[Floats]) -> tuple[list[int], list[int]]:
    """The parts of a convex polygon behind and before a plane; new corners are added to `points`.

    `ring` are indices into points, `heights` (k,) how far each lies before the plane; what is within `epsilon` of it
    belongs to both sides. A new corner is always reckoned from the end behind the plane, so that neighbours agree.
    """
    if heights.max() <= epsilon:
        return ring, []
    if heights.min() >= -epsilon:
        return [], ring
    back: list[int] = []
    front: list[int] = []
    for i, corner in enumerate(ring):
        j = (i + 1) % len(ring)
        here, there = float(heights[i]), float(heights[j])
        if here <= epsilon:
            back.append(corner)
        if here >= -epsilon:
            front.append(corner)
        if (here < -epsilon and there > epsilon) or (here > epsilon and there < -epsilon):
            low, high = (corner, ring[j]) if here < 0 else (ring[j], corner)
            share = min(here, there) / (min(here, there) - max(here, there))
            points.append(points[low] + share * (points[high] - points[low]))
            back.append(len(points) - 1)
            front.append(len(points) - 1)
    return back, front


def _tree(
    faces: Faces,
    epsilon: float,
    points: list[Floats],
    planes: list[Floats],
    children: list[list[int]],
    owned: list[list[tuple[int, list[int]]]],
) -> Tree:
    rings = [ring for pieces in owned for _, ring in sorted(pieces, key=lambda piece: piece[0])]
    source = [face for pieces in owned for face in sorted(face for face, _ in pieces)]
    counts = np.array([len(pieces) for pieces in owned], np.int32)
    links = np.array(children, np.int32)
    return Tree(
        faces=faces,
        epsilon=epsilon,
        points=np.array(points),
        corners=np.concatenate([np.array(ring, np.int32) for ring in rings]),
        starts=np.concatenate(([0], np.cumsum([len(ring) for ring in rings]))).astype(np.int32),
        source=np.array(source, np.int32),
        plane=np.array(planes),
        front=links[:, 1].copy(),
        back=links[:, 0].copy(),
        first=(np.cumsum(counts) - counts).astype(np.int32),
        count=counts,
        kind=np.full(len(planes), INNER, np.int8),
        root=0,
    )
