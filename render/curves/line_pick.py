"""Which outline's curve lies under the pointer: by distance in pixels, as a line has no face for a ray to hit."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..camera import Camera, project
from ..pick import Pick

if TYPE_CHECKING:
    from ...model.solid.display import DisplayMesh

REACH = 6.0  # logical pixels


class LinePicker:
    """Keeps the curves' places in the picture until the camera, its size or a mesh is another."""

    def __init__(self) -> None:
        self._seen: tuple[object, ...] = ()
        self._projected: dict[int, tuple[DisplayMesh, NDArray[np.float64]]] = {}

    def pick(
        self, meshes: Mapping[str, DisplayMesh], camera: Camera, size: tuple[float, float], x: float, y: float
    ) -> Pick | None:
        """The curve of a sheet nearest to pixel (x, y) within reach, as a Pick of its place on the curve."""
        if self._seen != (camera, size):
            self._seen = (camera, size)
            self._projected = {}
        sheets = {key: mesh for key, mesh in meshes.items() if mesh.sheet and len(mesh.edges)}
        self._projected = {
            id(mesh): self._projected.get(id(mesh), (mesh, project(camera, mesh.edge_points, size)))
            for mesh in sheets.values()
        }
        best: Pick | None = None
        nearest = REACH
        for key, mesh in sheets.items():
            places = self._projected[id(mesh)][1][:, :2]
            with np.errstate(invalid="ignore", divide="ignore"):
                inside = (places.min(axis=0) - nearest <= (x, y)) & ((x, y) <= places.max(axis=0) + nearest)
                if not inside.all():
                    continue
                begin, along = places[mesh.edges[:, 0]], places[mesh.edges[:, 1]] - places[mesh.edges[:, 0]]
                share = np.clip(((np.array((x, y)) - begin) * along).sum(axis=1) / (along**2).sum(axis=1), 0.0, 1.0)
                share = np.nan_to_num(share)
                off = np.linalg.norm(begin + share[:, None] * along - (x, y), axis=1)
            number = int(np.nanargmin(np.where(np.isnan(off), np.inf, off)))
            if off[number] < nearest:
                nearest = float(off[number])
                a, b = mesh.edge_points[mesh.edges[number]].astype(float)
                best = _pick(key, mesh, a + share[number] * (b - a), camera)
        return best


def _pick(key: str, mesh: DisplayMesh, point: NDArray[np.float64], camera: Camera) -> Pick:
    away = float(np.linalg.norm(point - np.asarray(camera.position)))
    x, y, z = (float(n) for n in point)
    normal = tuple(float(n) for n in mesh.normals[0])
    return Pick(key, len(mesh.triangles) - 1, (x, y, z), normal, away, mesh.owners[0], 0, False)  # type: ignore[arg-type]
