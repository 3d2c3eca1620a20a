"""Triangles or lines that stand in many places, made one: drawing one actor is cheaper than drawing hundreds."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonDataModel import vtkPolyData

from ..polydata import cells_of, lines_of, points_of, vtk_array

Matrix = NDArray[np.float64]  # (3, 4)
IDENTITY = np.eye(3, 4)


@dataclass(frozen=True, slots=True, eq=False)
class Cells:
    """`points` (p, 3), `cells` (c, 3) triangles or (c, 2) lines, and for triangles unit `normals` (p, 3) or None."""

    points: NDArray[Any]
    cells: NDArray[np.int32]
    normals: NDArray[Any] | None = None

    def at(self, matrices: Sequence[Matrix]) -> "Cells":
        """All of it under each of the maps; triangles that a map turns inside out are turned back."""
        maps = np.array(matrices)
        linear = maps[:, :, :3]
        points = self.points @ linear.transpose(0, 2, 1) + maps[:, None, :, 3]
        count = len(self.points)
        mirrored = np.linalg.det(linear) < 0.0
        cells = np.where(mirrored[:, None, None], self.cells[:, ::-1], self.cells)
        cells = cells + count * np.arange(len(maps))[:, None, None]
        normals = None
        if self.normals is not None:
            # Normals go by the inverse's transpose; the cofactors are that up to the determinant's size.
            normals = self.normals @ (np.linalg.inv(linear) * np.abs(np.linalg.det(linear))[:, None, None])
            normals = (normals / np.maximum(np.linalg.norm(normals, axis=2, keepdims=True), 1e-300)).reshape(-1, 3)
        size = self.cells.shape[1]
        return Cells(points.reshape(-1, 3).astype(np.float32), cells.reshape(-1, size).astype(np.int32), normals)

    def polys(self) -> vtkPolyData:
        surface = vtkPolyData()
        surface.SetPoints(points_of(self.points))
        surface.SetPolys(cells_of(self.cells))
        if self.normals is not None:
            surface.GetPointData().SetNormals(vtk_array(self.normals, np.float32, "normals"))
        return surface

    def lines(self) -> vtkPolyData:
        return lines_of(self.points, self.cells)
