"""What surface a face of a result lies on: by the leaf that made it, so that radii and axes are those that were typed.

The facets of a round thing lie inside of it; what they were cut from is known from their owner, the way to the leaf.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ..document.nodes import SURFACES, LinearArray, Mirror, Node, PolarArray
from ..document.placement import IDENTITY, inverse, product
from ..document.primitives import ImportedMesh, Relief
from ..solid.copies import copies
from ..solid.display import DisplayMesh
from ..solid.failure import NoSolid
from ..solid.provenance import Path
from .fitting import fitted_surface
from .leaf_surfaces import EVEN, Shape, evenly, shape_of
from .surface_kinds import (
    ConeSurface,
    CylinderSurface,
    Facet,
    Plane,
    SphereSurface,
    Surface,
    TorusSurface,
    Vector,
)
from .vectors import three, unit

Floats = NDArray[np.float64]


def surface_at(root: Node, mesh: DisplayMesh, triangle: int) -> Surface:
    """The surface that a triangle of a root's mesh lies on, in the world's axes.

    `root` is the resolved tree that the mesh was made from. Where the leaf knows no surface (imported meshes, hulls,
    Minkowski sums) one is fitted to the smooth patch around the triangle by least squares: `deviation` is then the
    largest distance (mm) of a vertex of the patch from it, and None otherwise.
    """
    corners = mesh.points[mesh.triangles[triangle]].astype(np.float64)
    normal = unit(np.cross(corners[1] - corners[0], corners[2] - corners[0]))
    outward = -normal if mesh.subtracted[triangle] else normal
    owner = int(mesh.owner[triangle])
    found = None if owner < 0 else leaf_at(root, mesh.owners[owner])
    if found is None:
        return Facet(three(corners.mean(axis=0)), three(normal))
    leaf, matrix = found
    # A plane's normal goes with the transposed inverse of a map: from the world to the leaf with the transposed map.
    own = inverse(matrix)
    local = corners @ own[:, :3].T + own[:, 3]
    along = unit(matrix[:, :3].T @ outward)
    if isinstance(leaf, (ImportedMesh, Relief, *SURFACES)):
        return fitted_surface(mesh, triangle) or Plane(three(corners.mean(axis=0)), three(normal))
    shape = shape_of(leaf, local, along)
    placed = None if shape is None else _placed(shape, matrix, corners, normal)
    return placed or Facet(three(corners.mean(axis=0)), three(normal))


def leaf_at(root: Node, path: Path) -> tuple[Node, Floats] | None:
    """The last node on a path of a resolved tree and the map (3, 4) from its own axes to the world's; None: no such."""
    if not path or path[0] != root.id:
        return None
    node, matrix, copy = root, product(IDENTITY, root.placement.matrix()), 0
    for step in path[1:]:
        if isinstance(step, int):
            copy = step
            continue
        child = next((child for child in node.children if child.id == step), None)
        if child is None:
            return None
        if isinstance(node, LinearArray | PolarArray | Mirror):
            try:
                maps = copies(node)
            except NoSolid:
                return None
            if copy >= len(maps):
                return None
            matrix = product(matrix, maps[copy])
        node, matrix, copy = child, product(matrix, child.placement.matrix()), 0
    return node, matrix


def planar(surface: Surface) -> bool:
    return isinstance(surface, Plane | Facet)


def _placed(shape: Shape, matrix: Floats, corners: Floats, normal: Floats) -> Surface | None:
    """A leaf's shape in the world; None where the map leaves it without a radius."""
    linear = matrix[:, :3]

    def mapped(point: Vector) -> Floats:
        return linear @ point + matrix[:, 3]

    match shape:
        case Plane():
            return Plane(three(corners.mean(axis=0)), three(normal))
        case SphereSurface(centre, radius):
            scale = evenly(linear)
            if scale is None:
                return None
            middle = mapped(centre)
            hollow = bool(normal @ (corners.mean(axis=0) - middle) < 0)
            return SphereSurface(three(middle), scale * radius, hollow)
        case TorusSurface(centre, _, radius, tube):
            scale = evenly(linear)
            if scale is None:
                return None
            middle, axis = mapped(centre), unit(linear[:, 2])
            offset = corners.mean(axis=0) - middle
            flat = offset - axis * (axis @ offset)
            hollow = bool(normal @ (offset - scale * radius * unit(flat)) < 0)
            return TorusSurface(three(middle), three(axis), scale * radius, scale * tube, hollow)
        case CylinderSurface(point, _, radius):
            scale = _round(linear)
            if scale is None:
                return None
            middle, axis = mapped(point), unit(linear[:, 2])
            return CylinderSurface(three(middle), three(axis), scale * radius, _inward(corners, normal, middle, axis))
        case ConeSurface(apex, (_, _, sign), half):
            scale = _round(linear)
            if scale is None:
                return None
            middle, axis = mapped(apex), sign * unit(linear[:, 2])
            slope = math.tan(math.radians(half)) * scale / float(np.linalg.norm(linear[:, 2]))
            hollow = _inward(corners, normal, middle, axis)
            return ConeSurface(three(middle), three(axis), math.degrees(math.atan(slope)), hollow)
    return None


def _inward(corners: Floats, normal: Floats, point: Floats, axis: Floats) -> bool:
    """Whether the normal points to the axis."""
    offset = corners.mean(axis=0) - point
    return bool(normal @ (offset - axis * (axis @ offset)) < 0)


def _round(linear: Floats) -> float | None:
    """The factor by which a map (3, 3) scales across z, where it keeps circles round and z at right angles to them."""
    square = linear.T @ linear
    size = float(square[0, 0])
    upright = abs(square[:2, 2]).max() <= EVEN * math.sqrt(size * float(square[2, 2]))
    return evenly(linear[:, :2]) if upright else None
