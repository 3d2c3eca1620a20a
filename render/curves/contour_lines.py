"""Edges and silhouettes of a solid as the curves that they stand for, in as many pieces as the picture needs."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonDataModel import vtkPolyData

from ..polydata import cells_of, points_of

if TYPE_CHECKING:
    from ...model.pipeline.contours import Curves
    from ...model.solid.display import DisplayMesh

MOST_TRIANGLES = 50_000
"""Of a mesh: the facets of a larger one are hardly to be told from the curves, and finding these takes its time."""
FINE = 0.025
"""Pixels that edges may be away from their curve; found anew where that has become ROUGH by coming nearer."""
ROUGH = 0.2


def has_curves(mesh: "DisplayMesh") -> bool:
    """Whether a mesh knows curved surfaces that its facets stand for."""
    return mesh.round is not None and mesh.round.count > 0 and not mesh.sheet and len(mesh.corners) <= MOST_TRIANGLES


class CurveLines:
    """`edges` and `silhouette` of a mesh that has curves, as VTK data."""

    def __init__(self, mesh: "DisplayMesh") -> None:
        from ...model.pipeline.contours import Contours

        assert mesh.round is not None
        self._contours = Contours(mesh, mesh.round)
        self.edges, self.silhouette = vtkPolyData(), vtkPolyData()
        self._fine = np.inf

    def turn(self, towards: NDArray[np.float64], parallel: bool, pixel: float) -> None:
        """For an eye at a place, or in a direction, and a pixel of so many mm."""
        least = 1e-7 * self._contours.size
        if max(ROUGH * pixel, least) < self._fine:
            self._fine = max(FINE * pixel, least)
            _put(self.edges, self._contours.edges(self._fine))
        _put(self.silhouette, self._contours.silhouette(towards, parallel, max(ROUGH / 2.0 * pixel, least)))


def _put(data: vtkPolyData, curves: "Curves") -> None:
    data.SetPoints(points_of(curves.points))
    data.SetLines(cells_of(curves.lines))
