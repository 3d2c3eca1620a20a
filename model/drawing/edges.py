"""The edges of a scene that a view draws: silhouettes, sharp edges, edges between leaves and solids, borders."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..solid.display import SEAM
from .lines import BORDER, FEATURE, INTERSECTION, OUTLINE
from .scene import Scene
from .surfaces import Surfaces

Floats = NDArray[np.float64]
Numbers = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Edges:
    ends: Floats  # (e, 2, 3) in the picture, what cannot be seen cut off
    kind: NDArray[np.int8]  # (e,)
    layer: Numbers  # (e,)
    planes: Numbers  # (e, 2) of the faces on both sides, -1: none there

    @property
    def count(self) -> int:
        return len(self.ends)


@dataclass(frozen=True, slots=True, eq=False)
class Joints:
    """All edges between triangles that are not in one flat face, whatever the view."""

    ends: Numbers  # (j, 2) into the points of the faces
    sides: Numbers  # (j, 2) triangles; -1: none there
    several: NDArray[np.bool_]  # (j,) more than two triangles meet here
    turned: NDArray[np.bool_]  # (j,) one side is inside out as the other sees it


def drawable_edges(scene: Scene, surfaces: Surfaces) -> Edges:
    """The edges to be drawn, hidden or not.

    An edge lies between a face that the eye sees from before and one that it does not (outline), or between two
    leaves that meet out of plane or two solids that meet anyhow (intersection), or two facets at an angle (feature),
    or is the border of a surface that is not closed. Joints of faceted smooth surfaces are none. Surfaces that are not
    closed have no edge where they cross others.
    """
    joints = _joints(scene, surfaces)
    faces = surfaces.faces
    one, other = joints.sides[:, 0], np.where(joints.sides[:, 1] < 0, joints.sides[:, 0], joints.sides[:, 1])
    plane_one, plane_other = faces.plane_of[one], faces.plane_of[other]
    sign = np.where(joints.turned, -1, 1)
    cosine = sign * np.einsum("ij,ij->i", faces.planes[plane_one, :3], faces.planes[plane_other, :3])
    sharp = surfaces.sharp[one]  # of both sides, where they have one owner; others have an edge between them anyway
    alone = joints.sides[:, 1] < 0
    foreign = (surfaces.solid[one] != surfaces.solid[other]) & ~alone
    between = ((surfaces.owner[one] != surfaces.owner[other]) & (cosine < SEAM)) | foreign
    smooth = ~(alone | between | joints.several | joints.turned) & (cosine >= sharp)
    facing = _without_zigzags(surfaces, joints, smooth)
    outline = (facing[one] != sign * facing[other]) & ~alone
    kind = np.full(len(one), -1, np.int8)
    kind[(cosine < sharp) | joints.several] = FEATURE
    kind[between] = INTERSECTION
    kind[outline] = OUTLINE
    kind[alone] = BORDER
    drawn = np.flatnonzero(kind >= 0)
    chosen = _named_side(surfaces, one[drawn], other[drawn])
    ends, kept = _seen(surfaces, faces.points[joints.ends[drawn]])
    planes = np.column_stack((plane_one, np.where(alone, -1, plane_other)))[drawn[kept]]
    return Edges(ends, kind[drawn[kept]], surfaces.layer[chosen[kept]], planes.astype(np.int64))


def _without_zigzags(surfaces: Surfaces, joints: Joints, smooth: NDArray[np.bool_]) -> NDArray[np.int8]:
    """(t,) the facing of triangles, as outlines go by it.

    The facets of a saddle that the eye sees nearly from the side face it and away by turns, though the true surface has
    one simple contour there (Hertzmann and Zorin 2000, section 4.1): the outline then runs to and fro, seen over convex
    joints and hidden in the concave ones between them. A facet with both counts as one that faces away, so that its
    third side is the outline. Convex surfaces and bores have none.
    """
    faces = surfaces.faces
    facing = surfaces.facing[faces.plane_of].astype(np.int8)
    one, other = joints.sides[smooth].T
    middles = faces.points[faces.corners.reshape(-1, 3)[other]].mean(axis=1)
    planes = faces.planes[faces.plane_of[one]]
    concave = np.einsum("ij,ij->i", planes[:, :3], middles) > planes[:, 3]
    count = len(facing)
    bent = np.bincount(joints.sides[joints.sides >= 0], minlength=count) == 3  # from all of its neighbours
    while True:
        outline = facing[one] != facing[other]
        hollow = np.bincount(np.concatenate((one, other))[np.tile(outline & concave, 2)], minlength=count)
        round_ = np.bincount(np.concatenate((one, other))[np.tile(outline & ~concave, 2)], minlength=count)
        turned = bent & (facing > 0) & (hollow > 0) & (round_ > 0)
        if not turned.any():
            return facing
        facing[turned] = -1


def _named_side(surfaces: Surfaces, one: Numbers, other: Numbers) -> Numbers:
    """(e,) the triangle whose layer an edge is on: of what was cut away, else what faces the eye, else the later."""

    def rank(triangle: Numbers) -> Numbers:
        facing = surfaces.facing[surfaces.faces.plane_of[triangle]] > 0
        owners = int(surfaces.owner.max(initial=0)) + 1
        return (2 * surfaces.subtracted[triangle] + facing) * owners + surfaces.owner[triangle]

    return np.where(rank(one) >= rank(other), one, other)


def _seen(surfaces: Surfaces, ends: Floats) -> tuple[Floats, Numbers]:
    """The ends (e, 2, 3) in the picture, what cannot be seen cut off, and the edges that are left."""
    projection = surfaces.projection
    viewed = projection.viewed(ends.reshape(-1, 3)).reshape(-1, 2, 3)
    low, high = np.zeros(len(ends)), np.ones(len(ends))
    for plane in projection.limits():
        heights = viewed @ plane[:3] + plane[3]
        low, high = narrowed(low, high, heights[:, 0], heights[:, 1])
    kept = np.flatnonzero(high > low)
    along = (viewed[:, 1] - viewed[:, 0])[kept]
    whole = (low[kept] <= 0.0)[:, None], (high[kept] >= 1.0)[:, None]
    begin = np.where(whole[0], viewed[kept, 0], viewed[kept, 0] + low[kept, None] * along)
    end = np.where(whole[1], viewed[kept, 1], viewed[kept, 0] + high[kept, None] * along)
    flat = projection.flattened(np.stack((begin, end), axis=1).reshape(-1, 3))
    return flat.reshape(-1, 2, 3), kept


def narrowed(low: Floats, high: Floats, begin: Floats, end: Floats) -> tuple[Floats, Floats]:
    """Intervals low .. high of a parameter 0 .. 1 (n,), less where a linear function (its values at 0 and 1) is
    negative (Liang and Barsky 1984); empty ones come out with high < low."""
    slope = end - begin
    with np.errstate(divide="ignore", invalid="ignore"):
        root = -begin / slope
    low = np.where((slope > 0.0) & (root > low), root, low)
    high = np.where((slope < 0.0) & (root < high), root, high)
    gone = (slope == 0.0) & (begin < 0.0)
    return low, np.where(gone, low - 1.0, high)


def _joints(scene: Scene, surfaces: Surfaces) -> Joints:
    """The edges of all meshes, by the meshes' own vertices; those of open surfaces by their places."""
    parts = []
    first_triangle = first_point = 0
    faces = surfaces.faces
    for mesh, closed in zip(scene.meshes, scene.closed, strict=True):
        count = len(mesh.corners)
        if not count:
            continue  # such a mesh has no points among the faces
        corners = mesh.corners.astype(np.int64)
        plane = faces.plane_of[first_triangle : first_triangle + count].astype(np.int64)
        if not closed:
            corners = _welded(mesh.vertices)[corners]
        joints = _of_mesh(corners, plane, len(mesh.vertices), closed)
        sides = np.where(joints.sides < 0, -1, joints.sides + first_triangle)
        parts.append(Joints(joints.ends + first_point, sides, joints.several, joints.turned))
        first_triangle += count
        first_point += len(mesh.vertices)
    if not parts:
        none = np.zeros((0, 2), np.int64)
        return Joints(none, none, np.zeros(0, bool), np.zeros(0, bool))
    return Joints(
        np.concatenate([part.ends for part in parts]),
        np.concatenate([part.sides for part in parts]),
        np.concatenate([part.several for part in parts]),
        np.concatenate([part.turned for part in parts]),
    )


def _of_mesh(corners: Numbers, plane: Numbers, points: int, closed: bool) -> Joints:
    """The joints of triangles (t, 3) in planes (t,)."""
    which = np.arange(len(corners)) if closed else _proper(corners, points)
    begin, end = corners[which].reshape(-1), corners[which][:, [1, 2, 0]].reshape(-1)
    key = np.minimum(begin, end) * points + np.maximum(begin, end)
    order = np.argsort(key, kind="stable")
    ordered = key[order]
    first = np.flatnonzero(np.diff(ordered, prepend=-1))
    count = np.diff(first, append=len(ordered))
    one = order[first]
    other = order[np.minimum(first + 1, max(len(order) - 1, 0))]
    sides = np.column_stack((which[one // 3], np.where(count > 1, which[other // 3], -1)))
    several = count > 2
    turned = (count > 1) & (begin[one] == begin[other])
    flat = (count == 2) & (plane[sides[:, 0]] == plane[sides[:, 1]]) & ~turned
    kept = ~flat
    ends = np.column_stack(np.divmod(ordered[first], points))
    return Joints(ends[kept], sides[kept], several[kept], turned[kept])


def _proper(corners: Numbers, points: int) -> Numbers:
    """The triangles (t, 3) with three different corners, each once, whichever way round."""
    sorted_corners = np.sort(corners, axis=1)
    whole = np.flatnonzero((np.diff(sorted_corners, axis=1) > 0).all(axis=1))
    rows = sorted_corners[whole]
    order = np.lexsort(rows.T)
    new = np.append(True, (np.diff(rows[order], axis=0) != 0).any(axis=1))[: len(order)]
    return np.sort(whole[order[new]])


def _welded(points: Floats) -> Numbers:
    """(n,) for each of `points` (n, 3) the first one in the same place."""
    _, first, number = np.unique(points + 0.0, axis=0, return_index=True, return_inverse=True)
    return first[number.reshape(-1)]
