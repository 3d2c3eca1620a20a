"""What the pointer snaps to: corners, middles, centres, edges and faces that are seen, and the ground's grid."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from ...model.measuring.features import bits_of, features, share_features
from ...model.measuring.landmarks import curved, face_at
from ..camera import Camera, project, ray
from ..ground import step_for
from ..pick import Pick, Picker

if TYPE_CHECKING:
    from ...model.solid.display import DisplayMesh
    from ..viewer import Viewer

Floats = NDArray[np.float64]
Vector = tuple[float, float, float]
Kind = Literal["vertex", "midpoint", "centre", "edge", "face", "grid"]
POINTS: tuple[Kind, ...] = ("vertex", "midpoint", "centre")

REACH = 10.0
"""Logical pixels between the pointer and what it snaps to."""
DEEP = 1.5
"""A point that lies behind a face by no more than so many pixels is seen: it is on that face, or on its border."""
MOST_TRIED = 12
"""Candidates of one kind whose visibility is tried, nearest first."""


@dataclass(frozen=True, slots=True)
class Snap:
    """`point` in the world; `direction` is a face's outward normal, an edge's direction, a circle's axis, else None.

    `path` is the owner's whose face or edge it is, () for the grid.
    """

    kind: Kind
    point: Vector
    direction: Vector | None
    path: tuple[str | int, ...]


class Snapper:
    """Finds what lies near the pointer. Keeps what it knows of the meshes of its last call, by identity."""

    def __init__(self, viewer: Viewer) -> None:
        self._viewer = viewer
        self._picker = Picker()
        self._left_out: frozenset[str] = frozenset()
        self._known: dict[str, _Target] = {}
        self._targets: dict[str, _Target] = {}
        """Those of `_known` of which anything is left."""

    def find(
        self, x: float, y: float, leave_out: Collection[str] = (), meshes: Mapping[str, DisplayMesh] | None = None
    ) -> Snap | None:
        """The best landmark within REACH of logical pixel (x, y); a corner before a middle, a centre, an edge, the face
        itself, the grid.

        Faces that nodes in `leave_out` made do not count, and do not hide. `meshes` are those of the scene by default;
        a drag may hand over those that it began with.
        """
        self._follow(leave_out, meshes)
        camera, size = self._viewer.camera, self._viewer.size
        pick = self._first(*self._viewer.ray(x, y))
        for target in self._targets.values():
            target.look(camera, size)
        for kind in POINTS:
            found = self._nearest_point(kind, x, y, pick)
            if found is not None:
                return found
        found = self._nearest_edge(x, y)
        if found is not None:
            return found
        if pick is not None:
            return Snap("face", pick.point, pick.normal, pick.path)
        return self._on_grid(x, y)

    def pick(
        self, x: float, y: float, leave_out: Collection[str] = (), meshes: Mapping[str, DisplayMesh] | None = None
    ) -> Pick | None:
        """The first face under the pixel that no node in `leave_out` made.

        Its `triangle` counts in `mesh`'s answer, and is -1 on the cut face of a section.
        """
        self._follow(leave_out, meshes)
        return self._first(*self._viewer.ray(x, y))

    def mesh(self, solid_id: str) -> DisplayMesh:
        """The mesh of a solid as the last call saw it, without the faces left out. Raises KeyError."""
        return self._targets[solid_id].seen

    def _follow(self, leave_out: Collection[str], meshes: Mapping[str, DisplayMesh] | None) -> None:
        wanted = self._viewer.scene.meshes if meshes is None else meshes
        left_out = frozenset(leave_out)
        old = self._known if left_out == self._left_out else {}
        self._left_out, self._known = left_out, {}
        for solid_id, mesh in wanted.items():
            known = old.get(solid_id)
            self._known[solid_id] = known if known is not None and known.mesh is mesh else _Target(mesh, left_out)
        self._targets = {solid_id: target for solid_id, target in self._known.items() if len(target.seen.triangles)}

    def _first(self, origin: Floats, direction: Floats) -> Pick | None:
        """The first face on a ray; what a section takes away is not there, and its cut faces are."""
        seen = {solid_id: target.seen for solid_id, target in self._targets.items()}
        sections = self._viewer.scene.sections
        found = self._picker.pick(seen, origin, direction, *sections.span(origin, direction))
        cut = sections.pick(origin, direction)
        if cut is None or cut.solid_id not in seen or (found is not None and found.distance <= cut.distance):
            return found
        return cut

    def _nearest_point(self, kind: Kind, x: float, y: float, pick: Pick | None) -> Snap | None:
        near: list[tuple[float, float, Vector, _Target, int]] = []
        for target in self._targets.values():
            points, pixels = getattr(target, kind), target.pixels[kind]
            away = np.hypot(pixels[:, 0] - x, pixels[:, 1] - y)
            for i in np.flatnonzero(away <= REACH):
                near.append((round(float(away[i])), float(pixels[i, 2]), _three(points[i]), target, int(i)))
        near.sort(key=lambda entry: entry[:2])
        best = next((entry for entry in near[:MOST_TRIED] if self._seen(entry[2])), None)
        centre = self._face_centre(x, y, pick) if kind == "centre" else None
        if centre is not None and (best is None or centre[0] < best[0]):
            return centre[1]
        if best is None:
            return None
        _, _, point, target, i = best
        direction, path = target.about(kind, i)
        return Snap(kind, point, direction, path)

    def _face_centre(self, x: float, y: float, pick: Pick | None) -> tuple[float, Snap] | None:
        """The middle of the flat face under the pointer, and how far it is; it may lie in a hole of the face."""
        if pick is None or pick.triangle < 0:
            return None
        mesh = self._targets[pick.solid_id].seen
        pixels = self._viewer.size
        face = face_at(mesh, pick.triangle)
        px, py, _ = project(self._viewer.camera, [face.centre], pixels)[0]
        away = float(np.hypot(px - x, py - y))
        if not away <= REACH or curved(mesh, pick.triangle):
            return None
        return away, Snap("centre", _three(face.centre), pick.normal, pick.path)

    def _nearest_edge(self, x: float, y: float) -> Snap | None:
        near: list[tuple[float, float, Vector, _Target, int]] = []
        for target in self._targets.values():
            near += target.edges_near(x, y, self._viewer.camera.parallel)
        near.sort(key=lambda entry: entry[:2])
        for _, _, point, target, edge in near[:MOST_TRIED]:
            if self._seen(point):
                ends = target.points[target.edges[edge]]
                return Snap("edge", point, _unit(ends[1] - ends[0]), target.path_of(edge))
        return None

    def _seen(self, point: Vector) -> bool:
        """Whether no face hides the point; in wireframe nothing is hidden."""
        viewer = self._viewer
        if viewer.scene.style == "wireframe":
            return True
        x, y, depth = project(viewer.camera, [point], viewer.size)[0]
        origin, direction = viewer.ray(x, y)
        hit = self._first(origin, direction)
        distance = float((np.asarray(point) - origin) @ direction)
        slack = DEEP * millimetres_per_pixel(viewer.camera, depth, viewer.size)
        near, far = viewer.scene.sections.span(origin, direction)
        return near - slack <= distance <= far + slack and (hit is None or hit.distance >= distance - slack)

    def _on_grid(self, x: float, y: float) -> Snap | None:
        """The nearest crossing of the ground's lines, where the grid is shown."""
        viewer = self._viewer
        if not viewer.ground.visible:
            return None
        origin, direction = ray(viewer.camera, x, y, viewer.size)
        if abs(direction[2]) < 1e-9:
            return None
        along = -origin[2] / direction[2]
        if along <= 0.0 and not viewer.camera.parallel:
            return None
        step = step_for(2.0 * viewer.camera.half_height)
        point = np.append(step * np.round((origin + along * direction)[:2] / step), 0.0) + 0.0
        bounds = viewer.ground.bounds
        if bounds is not None and ((point[:2] < bounds[0, :2]) | (point[:2] > bounds[1, :2])).any():
            return None
        px, py, _ = project(viewer.camera, [point], viewer.size)[0]
        near = float(np.hypot(px - x, py - y)) <= REACH
        return Snap("grid", _three(point), (0.0, 0.0, 1.0), ()) if near else None


class _Target:
    """What of one mesh can be snapped to: its landmarks but for those that the left out nodes made."""

    def __init__(self, mesh: DisplayMesh, left_out: frozenset[str]) -> None:
        self.mesh = mesh
        out = np.array([not left_out.isdisjoint(path) for path in mesh.owners], bool)
        gone = out[mesh.owner] if out.any() else np.zeros(len(mesh.triangles), bool)
        lines = features(mesh)
        self._lines = lines
        self.points, self.edges = lines.points, lines.edges
        self._camera: tuple[Camera, tuple[float, float]] | None = None
        self.pixels: dict[Kind, Floats] = {}
        if not gone.any():
            self.seen = mesh
            self._corners, self._straight = lines.corners, np.arange(len(lines.straight))
            self._circles = np.arange(len(lines.circles.centres))
            self._edges = np.arange(len(lines.edges))
            return
        kept = ~gone
        self.seen = replace(
            mesh,
            triangles=mesh.triangles[kept],
            owner=mesh.owner[kept],
            subtracted=mesh.subtracted[kept],
            facet=mesh.facet[kept],
        )
        share_features(mesh, self.seen)
        # Where a point touches a face left out, that has made it.
        touched = np.isin(bits_of(mesh.edge_points), bits_of(mesh.points[np.unique(mesh.triangles[gone])]))
        self._corners = lines.corners[~touched[lines.corners]]
        self._straight = np.flatnonzero(~touched[lines.straight].any(axis=1))
        own = touched[lines.edges].all(axis=1)
        self._edges = np.flatnonzero(~own)
        share = np.bincount(lines.chain, own, int(lines.chain.max(initial=-1)) + 1) / np.bincount(lines.chain)
        self._circles = np.flatnonzero(share[lines.circles.chains] < 0.5)

    @cached_property
    def vertex(self) -> Floats:
        return self.points[self._corners]

    @cached_property
    def midpoint(self) -> Floats:
        return self._lines.midpoints[self._straight]

    @cached_property
    def centre(self) -> Floats:
        return self._lines.circles.centres[self._circles]

    def look(self, camera: Camera, size: tuple[float, float]) -> None:
        """Project everything, unless that has been done for this camera."""
        if self._camera == (camera, size):
            return
        self._camera = (camera, size)
        for kind, points in zip(POINTS, (self.vertex, self.midpoint, self.centre), strict=True):
            self.pixels[kind] = project(camera, points, size)
        self._ends = project(camera, self.points, size)[self.edges[self._edges]]  # (e, 2, 3)
        (x0, y0), (x1, y1) = self._ends[:, 0, :2].T, self._ends[:, 1, :2].T
        self._boxes = np.minimum(x0, x1), np.maximum(x0, x1), np.minimum(y0, y1), np.maximum(y0, y1)

    def edges_near(self, x: float, y: float, parallel: bool) -> list[tuple[float, float, Vector, _Target, int]]:
        """Edges within REACH: distance in pixels, depth, nearest point, self, and the edge's number."""
        left, right, top, bottom = self._boxes
        near = (left <= x + REACH) & (right >= x - REACH) & (top <= y + REACH) & (bottom >= y - REACH)
        close = np.flatnonzero(near)
        if not len(close):
            return []
        pointer = np.array([x, y])
        start, end = self._ends[close, 0], self._ends[close, 1]
        along = (end - start)[:, :2]
        length = np.maximum(np.einsum("ij,ij->i", along, along), 1e-12)
        share = np.clip(np.einsum("ij,ij->i", pointer - start[:, :2], along) / length, 0.0, 1.0)
        away = np.linalg.norm(start[:, :2] + share[:, None] * along - pointer, axis=1)
        if not parallel:  # a share of the picture's line is another one of the edge: the far part is shorter
            share = share * start[:, 2] / (end[:, 2] + share * (start[:, 2] - end[:, 2]))
        depth = start[:, 2] + share * (end[:, 2] - start[:, 2])
        ends = self.points[self.edges[self._edges[close]]]
        nearest = ends[:, 0] + share[:, None] * (ends[:, 1] - ends[:, 0])
        return [
            (round(float(away[i])), float(depth[i]), _three(nearest[i]), self, int(self._edges[close[i]]))
            for i in np.flatnonzero(away <= REACH)
        ]

    def about(self, kind: Kind, index: int) -> tuple[Vector | None, tuple[str | int, ...]]:
        """Direction and owner's path of a landmark."""
        lines = self._lines
        if kind == "vertex":
            node = self._corners[index]
            return None, self.path_of(int(np.flatnonzero((self.edges == node).any(axis=1))[0]), int(node))
        if kind == "midpoint":
            number = self._straight[index]
            a, b = self.points[lines.straight[number]]
            return _unit(b - a), self.path_of(int(np.flatnonzero(lines.chain == lines.straight_chains[number])[0]))
        number = self._circles[index]
        chain = lines.circles.chains[number]
        return _three(lines.circles.normals[number]), self.path_of(int(np.flatnonzero(lines.chain == chain)[0]))

    def path_of(self, edge: int, node: int | None = None) -> tuple[str | int, ...]:
        """The path of an owner of a face at an edge, or at a point."""
        mesh = self.seen
        wanted = self.mesh.edge_points[self.edges[edge] if node is None else [node]]
        x, y, z = mesh.points.T  # one coordinate after the other is far quicker than rows are
        at = np.zeros(len(x), bool)
        for point in wanted:
            at |= (x == point[0]) & (y == point[1]) & (z == point[2])
        a, b, c = (at[mesh.triangles[:, i]].astype(np.int8) for i in range(3))
        triangles = np.flatnonzero(a + b + c >= len(wanted))
        return tuple(mesh.owners[int(mesh.owner[triangles[0]])]) if len(triangles) else ()


def millimetres_per_pixel(camera: Camera, depth: float, size: tuple[float, float]) -> float:
    """The length in the world of one pixel at a depth before the eye."""
    half = camera.half_height if camera.parallel else camera.half_height * depth / camera.distance
    return 2.0 * half / size[1]


def _three(values: Floats) -> Vector:
    return float(values[0]), float(values[1]), float(values[2])


def _unit(vector: Floats) -> Vector:
    return _three(vector / max(float(np.linalg.norm(vector)), 1e-300))
