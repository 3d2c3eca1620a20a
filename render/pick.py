"""What a ray hits first: exact nearest triangle among the shown meshes.

VTK's cell locator, built once a mesh, names the triangles whose boxes the ray passes; which of them is hit, and where,
is then decided in double precision by Möller and Trumbore's test (1997).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray
from vtkmodules.vtkCommonCore import vtkIdList
from vtkmodules.vtkCommonDataModel import vtkStaticCellLocator

from .polydata import surface_of

if TYPE_CHECKING:
    from ..model.solid.display import DisplayMesh

Floats = NDArray[np.float64]

FEW = 256  # below this many triangles all are tested and no locator is built
SLACK = 1e-9  # barycentric; a ray along a shared side must not slip between two triangles


@dataclass(frozen=True, slots=True)
class Pick:
    """The first triangle on a ray. `normal` is the triangle's own, unit and outward, whichever side was hit."""

    solid_id: str
    triangle: int
    point: tuple[float, float, float]
    normal: tuple[float, float, float]
    distance: float
    path: tuple[str | int, ...]
    facet: int
    subtracted: bool
    section: str = ""
    """The section whose cut face this is; then `triangle` and `facet` are -1 and the path is the solid's root."""


class Picker:
    """Keeps a locator for each mesh of the last call, by identity."""

    def __init__(self) -> None:
        self._locators: dict[int, tuple[DisplayMesh, vtkStaticCellLocator]] = {}
        self._candidates = vtkIdList()

    def pick(
        self,
        meshes: Mapping[str, "DisplayMesh"],
        origin: ArrayLike,
        direction: ArrayLike,
        near: float = 0.0,
        far: float = np.inf,
    ) -> Pick | None:
        """The nearest hit along `direction` (3,) from `origin` (3,), from either side; None for a miss.

        Looked at is what lies `near` to `far` millimetres away.
        """
        start = np.asarray(origin, float)
        along = np.asarray(direction, float) / np.linalg.norm(direction)
        living = {id(mesh) for mesh in meshes.values()}
        self._locators = {key: kept for key, kept in self._locators.items() if key in living}
        ids = [solid_id for solid_id, mesh in meshes.items() if len(mesh.triangles)]
        if not ids:
            return None
        boxes = np.array([np.reshape(meshes[solid_id].bounds, (2, 3)) for solid_id in ids], float)
        entry, leave = _through_boxes(boxes, start, along)
        best, nearest = None, np.inf
        for index in np.argsort(entry, kind="stable"):
            if entry[index] > min(nearest, leave[index]):
                continue
            mesh = meshes[ids[index]]
            candidates = self._along(mesh, start + entry[index] * along, start + leave[index] * along)
            triangle, distance = first_hit(mesh, candidates, start, along, near)
            if distance < nearest and distance <= far:
                best, nearest = (ids[index], mesh, triangle), distance
        if best is None:
            return None
        return _pick(*best, start, along, nearest)

    def pick_all(
        self,
        meshes: Mapping[str, "DisplayMesh"],
        origin: ArrayLike,
        direction: ArrayLike,
        near: float = 0.0,
        far: float = np.inf,
    ) -> list[Pick]:
        """Every hit along `direction` (3,) from `origin` (3,) within `near` to `far` millimetres, nearest first."""
        start = np.asarray(origin, float)
        along = np.asarray(direction, float) / np.linalg.norm(direction)
        found: list[tuple[float, str, DisplayMesh, int]] = []
        for solid_id, mesh in meshes.items():
            if not len(mesh.triangles):
                continue
            entry, leave = _through_boxes(np.reshape(mesh.bounds, (1, 2, 3)).astype(float), start, along)
            if entry[0] > leave[0]:
                continue
            candidates = self._along(mesh, start + entry[0] * along, start + leave[0] * along)
            distance = hit_distances(mesh, candidates, start, along)
            found += [
                (float(distance[i]), solid_id, mesh, int(candidates[i]))
                for i in np.flatnonzero((distance >= near) & (distance <= far) & np.isfinite(distance))
            ]
        found.sort(key=lambda hit: hit[0])
        return [_pick(solid_id, mesh, triangle, start, along, at) for at, solid_id, mesh, triangle in found]

    def _along(self, mesh: "DisplayMesh", start: Floats, end: Floats) -> NDArray[np.int64]:
        if len(mesh.triangles) <= FEW:
            return np.arange(len(mesh.triangles))
        kept = self._locators.get(id(mesh))
        if kept is None:
            locator = vtkStaticCellLocator()
            locator.SetDataSet(surface_of(mesh))
            locator.BuildLocator()
            kept = self._locators[id(mesh)] = (mesh, locator)
        found = self._candidates
        found.Reset()
        tolerance = 1e-6 * float(np.ptp(mesh.bounds, axis=0).max())
        kept[1].FindCellsAlongLine(start.tolist(), end.tolist(), tolerance, found)
        return np.fromiter((found.GetId(i) for i in range(found.GetNumberOfIds())), np.int64, found.GetNumberOfIds())


def first_hit(
    mesh: "DisplayMesh", candidates: NDArray[np.int64], origin: Floats, direction: Floats, near: float = 0.0
) -> tuple[int, float]:
    """The nearest of the `candidates` (indices of triangles) on the ray, from `near` on, and its distance.

    (-1, inf) for a miss.
    """
    distance = hit_distances(mesh, candidates, origin, direction)
    distance[distance < near] = np.inf
    if not np.isfinite(distance).any():
        return -1, np.inf
    nearest = int(np.argmin(distance))
    return int(candidates[nearest]), float(distance[nearest])


def hit_distances(mesh: "DisplayMesh", candidates: NDArray[np.int64], origin: Floats, direction: Floats) -> Floats:
    """(k,) how far along the line each of the `candidates` (k,) is hit, negative behind the origin; inf for a miss."""
    a, b, c = (mesh.points[mesh.triangles[candidates, corner]].astype(float) for corner in range(3))
    first, second, offset = b - a, c - a, origin - a
    across = np.cross(direction, second)
    determinant = np.einsum("ij,ij->i", first, across)
    size = np.linalg.norm(first, axis=1) * np.linalg.norm(second, axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        u = np.einsum("ij,ij->i", offset, across) / determinant
        turned = np.cross(offset, first)
        v = turned @ direction / determinant
        distance = np.einsum("ij,ij->i", second, turned) / determinant
        hit = (np.abs(determinant) > 1e-12 * size) & (u >= -SLACK) & (v >= -SLACK) & (u + v <= 1.0 + SLACK)
    return np.where(hit, distance, np.inf)


def _pick(solid_id: str, mesh: "DisplayMesh", triangle: int, start: Floats, along: Floats, distance: float) -> Pick:
    a, b, c = mesh.points[mesh.triangles[triangle]].astype(float)
    normal = np.cross(b - a, c - a)
    return Pick(
        solid_id=solid_id,
        triangle=triangle,
        point=_three(start + distance * along),
        normal=_three(normal / max(float(np.linalg.norm(normal)), 1e-300)),
        distance=float(distance),
        path=tuple(mesh.owners[int(mesh.owner[triangle])]),
        facet=int(mesh.facet[triangle]),
        subtracted=bool(mesh.subtracted[triangle]),
    )


def _through_boxes(boxes: Floats, origin: Floats, direction: Floats) -> tuple[Floats, Floats]:
    """Where a ray enters and leaves boxes (n, 2, 3), widened a little; entry > leave for a miss."""
    slack = 1e-6 * (1e-3 + np.ptp(boxes, axis=1).max(axis=1))[:, None]
    lower, upper = boxes[:, 0] - slack - origin, boxes[:, 1] + slack - origin
    with np.errstate(divide="ignore", invalid="ignore"):
        one, two = lower / direction, upper / direction
    parallel = direction == 0.0
    outside = ((lower > 0.0) | (upper < 0.0)) & parallel
    entry = np.where(parallel, -np.inf, np.minimum(one, two)).max(axis=1)
    leave = np.where(parallel, np.inf, np.maximum(one, two)).min(axis=1)
    entry = np.where(outside.any(axis=1), np.inf, np.maximum(entry, 0.0))
    return entry, np.where(outside.any(axis=1), -np.inf, leave)


def _three(values: Floats) -> tuple[float, float, float]:
    return float(values[0]), float(values[1]), float(values[2])
