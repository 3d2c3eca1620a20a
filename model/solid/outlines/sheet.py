"""Outlines that stand by themselves as pictures need them: their curves as lines, what they fill as a thin sheet."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from manifold3d import triangulate
from numpy.typing import NDArray

from ...document.nodes import Node
from ...document.placement import Placement
from ...outline.paths import path_of
from ...path.flatten import chords
from ..display import DisplayMesh
from ..failure import NoSolid
from ..maps import placed_tolerance
from ..provenance import occurrences
from .sections import area_of

Floats = NDArray[np.float64]


def sheet_of(root: Node, tolerance: float) -> DisplayMesh:
    """The picture of a resolved outline, placed. Raises Refusal.

    Its edges are the curves; its triangles cover what it fills, the last one a mere point that the edges have at their
    sides where there is nothing else. All belong to the first of its occurrences.
    """
    fine = placed_tolerance(tolerance, root.placement)
    path = path_of(root.with_(placement=Placement()))
    owners = tuple(occurrence.path for occurrence in occurrences(root)) or ((root.id,),)
    lines = chords(path, fine) if path.contours else None
    edge_points = np.zeros((0, 3)) if lines is None else _spatial(lines.points)
    starts = [0] if lines is None else lines.starts.tolist()
    edges = np.vstack([np.zeros((0, 2), np.int64), *(_along(a, b) for a, b in pairwise(starts))])
    try:
        rings = [np.asarray(ring, float) for ring in area_of(path, fine).to_polygons()]
    except NoSolid:  # it is open, or leaves its plane: it has no inside
        rings = []
    corners = np.asarray(triangulate(rings, 0.0), np.int64).reshape(-1, 3) if rings else np.zeros((0, 3), np.int64)
    flat = _spatial(np.vstack(rings)) if rings else np.zeros((0, 3))
    matrix = root.placement.matrix()
    edge_points, vertices = _placed(edge_points, matrix), _placed(flat, matrix)
    anchor = edge_points[:1] if len(edge_points) else matrix[None, :, 3]
    vertices = np.vstack((vertices, anchor))
    triangles = np.vstack((corners, np.full((1, 3), len(vertices) - 1)))
    if np.linalg.det(matrix[:, :3]) < 0.0:
        triangles = triangles[:, ::-1]
    normal = np.cross(matrix[:, 0], matrix[:, 1])
    normal /= max(float(np.linalg.norm(normal)), 1e-300)
    count = len(triangles)
    around = np.vstack((edge_points, vertices))
    return DisplayMesh(
        points=vertices.astype(np.float32),
        normals=np.broadcast_to(normal, vertices.shape).astype(np.float32),
        triangles=triangles.astype(np.int32),
        owner=np.zeros(count, np.int32),
        owners=owners,
        subtracted=np.zeros(count, bool),
        facet=np.zeros(count, np.int32),
        edge_points=edge_points.astype(np.float32),
        edges=edges.astype(np.int32),
        edge_sides=np.full((len(edges), 2), count - 1, np.int32),
        bounds=np.array([around.min(axis=0), around.max(axis=0)]),
        vertices=vertices,
        corners=triangles.astype(np.int32),
        convex=np.zeros(len(owners), bool),
        sheet=True,
    )


def _along(begin: int, end: int) -> NDArray[np.int64]:
    """(n, 2) the sides of a polyline over the points from `begin` to before `end`."""
    numbers = np.arange(begin, end - 1)
    return np.column_stack((numbers, numbers + 1))


def _spatial(points: Floats) -> Floats:
    """(n, 3) with a z of 0 where there is none."""
    return points if points.shape[1] == 3 else np.column_stack((points, np.zeros(len(points))))


def _placed(points: Floats, matrix: Floats) -> Floats:
    return points @ matrix[:, :3].T + matrix[:, 3]
