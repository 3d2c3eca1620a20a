"""Leaves as manifold3d solids, in their own axes: one small function a kind.

Each result is an original of manifold3d, so that every triangle of a later result names the leaf value it came from.
"""

from __future__ import annotations

from functools import singledispatch

import numpy as np
from manifold3d import CrossSection, Error, Manifold, Mesh64, triangulate
from numpy.typing import NDArray

from ..document.nodes import Node
from ..document.primitives import Box, Cone, Cylinder, ImportedMesh, Polyhedron, Relief, Sphere, Torus
from .failure import NoSolid, words
from .tessellation import MAX_SEGMENTS, MAX_SURFACE_SEGMENTS, circle_segments, sphere_segments


def fineness_of(node: Node, tolerance: float) -> tuple[int | None, float]:
    """The node's own segments, if it has them, and its tolerance: its own one wins unless a coarser is asked for."""
    segments, own = node.segments, node.tolerance  # type: ignore[attr-defined]
    if segments is not None:
        if segments > MAX_SEGMENTS:
            raise NoSolid(f"{node.title}: segments must be at most {MAX_SEGMENTS}, not {segments:g}")
        return int(segments), tolerance
    return None, tolerance if own is None else float(own)


def segments_of(node: Node, radius: float, tolerance: float, count=circle_segments) -> int:
    segments, tolerance = fineness_of(node, tolerance)
    return segments or count(radius, tolerance)


@singledispatch
def solid_of(node: Node, tolerance: float) -> Manifold:
    """The leaf's solid. Raises NoSolid."""
    raise NoSolid(f"{node.title} is no solid by itself")


@solid_of.register
def solid_of_box(node: Box, tolerance: float) -> Manifold:
    x, y, z = (float(side) for side in node.size)
    return Manifold.cube((x, y, z), node.centred)


@solid_of.register
def solid_of_sphere(node: Sphere, tolerance: float) -> Manifold:
    return Manifold.sphere(float(node.radius), segments_of(node, float(node.radius), tolerance, sphere_segments))


@solid_of.register
def solid_of_cylinder(node: Cylinder, tolerance: float) -> Manifold:
    radius = float(node.radius)
    segments = segments_of(node, radius, tolerance)
    return Manifold.cylinder(float(node.height), radius, radius, segments, node.centred)


@solid_of.register
def solid_of_cone(node: Cone, tolerance: float) -> Manifold:
    low, high = float(node.radius), float(node.top_radius)
    if low == high == 0:
        raise NoSolid("Cone: radius and top radius are both 0")
    return Manifold.cylinder(float(node.height), low, high, segments_of(node, max(low, high), tolerance), node.centred)


@solid_of.register
def solid_of_torus(node: Torus, tolerance: float) -> Manifold:
    radius, tube = float(node.radius), float(node.tube_radius)
    segments, tolerance = fineness_of(node, tolerance)
    # Around the axis and around the tube each may use half of the tolerance.
    around = segments or min(circle_segments(radius + tube, tolerance / 2), MAX_SURFACE_SEGMENTS)
    tubular = segments or min(circle_segments(tube, tolerance / 2), MAX_SURFACE_SEGMENTS)
    section = CrossSection.circle(tube, tubular).translate((radius, 0))
    return section.revolve(around)


@solid_of.register
def solid_of_polyhedron(node: Polyhedron, tolerance: float) -> Manifold:
    points = np.array(node.points, dtype=np.float64).reshape(-1, 3)
    if len(points) < 4 or len(node.faces) < 4:
        raise NoSolid(f"Polyhedron: {len(points)} points and {len(node.faces)} faces enclose nothing")
    for number, face in enumerate(node.faces):
        if len(face) < 3 or min(face) < 0 or max(face) >= len(points):
            raise NoSolid(f"Polyhedron: face {number} must name three or more of the points 0 to {len(points) - 1}")
    triangles, polygons = triangles_of_faces(points, node.faces)
    return closed_solid(points, triangles, polygons, "Polyhedron")


def triangles_of_faces(
    points: NDArray[np.float64], faces: tuple[tuple[int, ...], ...]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """(m, 3) triangles of flat faces over `points` (n, 3), and (m,) the number of the face that each comes from.

    Convex faces become fans, all of one size at once; the others are left to manifold3d.
    """
    sizes = np.array([len(face) for face in faces])
    triangles: list[NDArray[np.int64]] = []
    numbers: list[NDArray[np.int64]] = []
    for size in np.unique(sizes):
        members = np.flatnonzero(sizes == size)
        corners = np.array([faces[i] for i in members], dtype=np.int64)  # (f, size)
        ring = points[corners]
        side = np.roll(ring, -1, axis=1) - ring
        # Newell's normal: that of a polygon whose corners may be slightly out of plane.
        normal = np.cross(ring, np.roll(ring, -1, axis=1)).sum(axis=1)
        turns = np.einsum("fij,fj->fi", np.cross(np.roll(side, 1, axis=1), side), normal)
        fan = np.column_stack((np.zeros(size - 2, dtype=int), np.arange(1, size - 1), np.arange(2, size)))
        convex = (turns >= -1e-9 * np.abs(turns).max(axis=1, keepdims=True)).all(axis=1) | (size == 3)
        triangles.append(corners[convex][:, fan].reshape(-1, 3))
        numbers.append(np.repeat(members[convex], size - 2))
        for i in np.flatnonzero(~convex):
            pieces = _triangulated(ring[i], normal[i])
            triangles.append(corners[i][pieces])
            numbers.append(np.full(len(pieces), members[i]))
    return np.concatenate(triangles), np.concatenate(numbers)


def _triangulated(ring: NDArray[np.float64], normal: NDArray[np.float64]) -> NDArray[np.int64]:
    """(m, 3) triangles over the corners of one flat face, which need not be convex."""
    drop = int(np.argmax(np.abs(normal)))
    flat = ring[:, [i for i in range(3) if i != drop]]
    if (normal[drop] > 0) == (drop != 1):
        return np.asarray(triangulate([flat], 0.0), dtype=np.int64)
    backwards = np.asarray(triangulate([flat[::-1]], 0.0), dtype=np.int64)
    return len(ring) - 1 - backwards[:, ::-1]


def closed_solid(
    points: NDArray[np.float64], triangles: NDArray[np.int64], polygons: NDArray[np.int64] | None, what: str
) -> Manifold:
    """A solid from points (n, 3) and triangles (m, 3); `polygons` (m,) numbers the flat face each belongs to.

    Doubled points are merged, an inside-out surface is turned. Raises NoSolid for what is not closed.
    """
    faces = None if polygons is None else polygons.astype(np.uint64)
    mesh = Mesh64(np.ascontiguousarray(points), triangles.astype(np.uint64), face_id=faces)
    solid = Manifold(mesh)
    if solid.status() == Error.NotManifold:
        mesh.merge()
        solid = Manifold(mesh)
    if solid.status() == Error.NotManifold:
        raise NoSolid(f"{what}: {_openness(points, triangles)}")
    if solid.status() != Error.NoError:
        raise NoSolid(f"{what}: {words(solid.status())}")
    if solid.volume() < 0:
        turned = Mesh64(
            np.ascontiguousarray(points),
            np.ascontiguousarray(triangles[:, ::-1]).astype(np.uint64),
            face_id=faces,
        )
        turned.merge()
        solid = Manifold(turned)
    return solid.as_original()


def _openness(points: NDArray[np.float64], triangles: NDArray[np.int64]) -> str:
    """Which edges keep a mesh from enclosing anything."""
    _, same = np.unique(points, axis=0, return_inverse=True)
    corners = same.reshape(-1)[triangles]
    edges = corners[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    edges = edges[edges[:, 0] != edges[:, 1]]
    pairs, count = np.unique(np.sort(edges, axis=1), axis=0, return_counts=True)
    open_, many = int((count == 1).sum()), int((count > 2).sum())
    if open_:
        return f"the surface is not closed: {open_} open edge{'' if open_ == 1 else 's'}"
    if many:
        return f"{many} edge{' has' if many == 1 else 's have'} more than two faces"
    return f"neighbouring faces point to opposite sides ({len(pairs)} edges)"


@solid_of.register
def _(node: Relief, tolerance: float) -> Manifold:
    from .relief import solid_of_relief

    return solid_of_relief(node)


@solid_of.register
def solid_of_imported_mesh(node: ImportedMesh, tolerance: float) -> Manifold:
    from ..exchange.meshes_in import parts_of_asset

    parts = parts_of_asset(node.asset, node.file_format)
    index = int(node.part)  # type: ignore[arg-type]
    if index >= len(parts):
        raise NoSolid(f"Imported mesh: the file holds {len(parts)} solid{'s' * (len(parts) != 1)}, not number {index}")
    part = parts[index]
    return closed_solid(part.vertices * float(node.unit), part.triangles.astype(np.int64), None, "Imported mesh")
