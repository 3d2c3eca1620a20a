"""The corners of a tree's fragments as points of a picture: none is shared, so that an order is a list of indices."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from ...model.partition.tree import Tree
    from ...model.solid.display import DisplayMesh

Numbers = NDArray[np.int64]
Singles = NDArray[np.float32]


@dataclass(frozen=True, slots=True, eq=False)
class Corners:
    """What no eye changes. Row i belongs to place i of `tree.corners`."""

    tree: Tree
    meshes: tuple[DisplayMesh, ...]
    points: Singles  # (c, 3)
    normals: Singles  # (c, 3) between those of the triangle's corners, as shaders reckon them: not of unit length
    weights: Singles  # (c, 3) how much of each corner of the triangle
    face: NDArray[np.int32]  # (c,) the face that the fragment is a piece of
    triangle_normals: tuple[Singles, ...]  # (t, 3, 3) of each mesh

    def corner_normals(self) -> tuple[Singles, Singles, Singles]:
        """The normals (c, 3) at the three corners of each one's triangle."""
        a, b, c = np.moveaxis(_joined(self.triangle_normals)[self.face], 1, 0)
        return np.ascontiguousarray(a), np.ascontiguousarray(b), np.ascontiguousarray(c)

    def corner_points(self) -> tuple[Singles, Singles, Singles]:
        """The places (c, 3) of the three corners of each one's triangle."""
        a, b, c = np.moveaxis(_joined([mesh.points[mesh.triangles] for mesh in self.meshes])[self.face], 1, 0)
        return np.ascontiguousarray(a), np.ascontiguousarray(b), np.ascontiguousarray(c)


def corners_of(tree: Tree, meshes: Sequence[DisplayMesh], before: Corners | None = None) -> Corners:
    """The corners of a tree over the triangles of the meshes, one mesh after the other.

    What the tree has in common with the beginning of the one `before` is taken from there. Raises ValueError where the
    tree has not as many faces as the meshes have triangles.
    """
    total = sum(len(mesh.triangles) for mesh in meshes)
    if tree.faces.count != total or len(tree.faces.corners) != 3 * total:
        raise ValueError(f"the tree has {tree.faces.count} faces, the meshes {total} triangles")
    kept = 0 if before is None else _in_common(before, tree, meshes)
    sizes = np.diff(tree.starts)
    fragment = np.searchsorted(tree.starts, kept, side="right") - 1 if kept else 0
    face = np.repeat(tree.source[fragment:], sizes[fragment:])
    points = tree.points[tree.corners[kept:]]
    weights, which = _weights(tree, face, tree.corners[kept:], points)
    known = {} if before is None else dict(zip(before.meshes, before.triangle_normals, strict=True))
    triangle_normals = tuple(known[mesh] if mesh in known else mesh.normals[mesh.triangles] for mesh in meshes)
    own = _joined(triangle_normals)
    normals = own[face, which]
    cut = np.flatnonzero(which < 0)
    normals[cut] = np.einsum("ij,ijk->ik", weights[cut], own[face[cut]])
    points = points.astype(np.float32)
    if before is not None and kept:
        points = np.concatenate([before.points[:kept], points])
        normals = np.concatenate([before.normals[:kept], normals])
        weights = np.concatenate([before.weights[:kept], weights])
        face = np.concatenate([before.face[:kept], face])
    return Corners(tree, tuple(meshes), points, normals, weights, face, triangle_normals)


def _in_common(before: Corners, tree: Tree, meshes: Sequence[DisplayMesh]) -> int:
    """How many corners, of whole fragments, are the same at the beginning of both trees."""
    old = before.tree
    faces = 0
    for a, b in zip(before.meshes, meshes, strict=False):
        if a is not b:
            break
        faces += len(a.triangles)
    fragments = _agreeing(old.source, tree.source)
    fragments = min(fragments, _agreeing(old.starts[1:], tree.starts[1:]))
    later = np.flatnonzero(tree.source[:fragments] >= faces)
    fragments = int(later[0]) if len(later) else fragments
    corners = int(tree.starts[fragments])
    corners = _agreeing(old.corners[:corners], tree.corners[:corners])
    points = _agreeing(old.points, tree.points)
    moved = np.flatnonzero(tree.corners[:corners] >= points)
    corners = int(moved[0]) if len(moved) else corners
    return int(tree.starts[np.searchsorted(tree.starts, corners, side="right") - 1])


def _agreeing(a: NDArray, b: NDArray) -> int:
    """How many rows at the beginning of two arrays are equal."""
    count = min(len(a), len(b))
    differs = (a[:count] != b[:count]).reshape(-1)
    first = int(np.argmax(differs)) if len(differs) else 0
    return first * count // len(differs) if len(differs) and differs[first] else count


def _weights(
    tree: Tree, face: NDArray[np.int32], corners: NDArray[np.int32], places: NDArray[np.float64]
) -> tuple[Singles, NDArray[np.int8]]:
    """(n, 3) the barycentric coordinates of places (n, 3) in the triangles `face` (n,), and (n,) which of the
    triangle's corners each is, -1 for those that a cut has made."""
    faces = tree.faces
    ends = faces.corners.reshape(-1, 3)[face]
    which = np.full(len(face), -1, np.int8)
    first = tree.points[: len(faces.points)]
    numbered = first.shape == faces.points.shape and np.array_equal(first, faces.points)
    for corner in (2, 1, 0):
        # With further faces put in, those of the static ones and of their cuts come first: then places tell.
        there = ends[:, corner] == corners
        which[there if numbered else (faces.points[ends[:, corner]] == places).all(axis=1)] = corner
    weights = np.eye(3, dtype=np.float32)[which]
    cut = np.flatnonzero(which < 0)
    a, b, c = (faces.points[ends[cut, corner]] for corner in range(3))
    normal = np.cross(b - a, c - a)
    size = np.einsum("ij,ij->i", normal, normal)
    share = 1.0 / np.where(size > 0.0, size, np.inf)
    place = places[cut] - a
    second = np.einsum("ij,ij->i", np.cross(place, c - a), normal) * share
    third = np.einsum("ij,ij->i", np.cross(b - a, place), normal) * share
    inner = np.clip(np.column_stack([1.0 - second - third, second, third]), 0.0, None)
    weights[cut] = inner / inner.sum(axis=1, keepdims=True)
    return weights, which


def _joined(parts: Sequence[Singles]) -> Singles:
    return np.concatenate([*parts, np.zeros((0, 3, 3), np.float32)])
