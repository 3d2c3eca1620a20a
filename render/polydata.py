"""A DisplayMesh as VTK data: surface and feature edges, sharing the arrays' memory wherever VTK allows it."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

if TYPE_CHECKING:
    from ..model.solid.display import DisplayMesh

Colours = NDArray[np.uint8]


def surface_of(mesh: "DisplayMesh") -> vtkPolyData:
    """The triangles with point normals. VTK reads the mesh's own arrays and keeps them alive."""
    surface = vtkPolyData()
    surface.SetPoints(points_of(mesh.points))
    surface.SetPolys(cells_of(mesh.triangles))
    surface.GetPointData().SetNormals(vtk_array(mesh.normals, np.float32, "normals"))
    return surface


def lines_of(points: NDArray[Any], edges: NDArray[Any]) -> vtkPolyData:
    """Line segments: `edges` (e, 2) are indices into `points` (q, 3)."""
    lines = vtkPolyData()
    lines.SetPoints(points_of(points))
    lines.SetLines(cells_of(edges))
    return lines


def set_cell_colours(data: vtkPolyData, colours: Colours) -> None:
    """Colour each cell; `colours` is (cells, 3 or 4). The array is shared, so hand over one that nobody writes to."""
    data.GetCellData().SetScalars(vtk_array(colours, np.uint8, "colours"))


def set_point_colours(data: vtkPolyData, colours: Colours) -> None:
    """Colour each point; `colours` is (points, 3 or 4), shared."""
    data.GetPointData().SetScalars(vtk_array(colours, np.uint8, "colours"))


def points_of(points: NDArray[Any]) -> vtkPoints:
    result = vtkPoints()
    result.SetData(vtk_array(np.reshape(points, (-1, 3)), np.float32, "points"))
    return result


def cells_of(cells: NDArray[Any]) -> vtkCellArray:
    """Cells of one size: (n, size) int32 indices. The offsets are implicit where VTK can (since 9.6)."""
    result = vtkCellArray()
    if len(cells):
        result.SetData(cells.shape[1], vtk_array(np.reshape(cells, -1), np.int32, "connectivity"))
    return result


def vtk_array(values: NDArray[Any], dtype: Any, name: str) -> Any:
    """A VTK array over the memory of `values`; copied only where type or layout force it."""
    array = numpy_to_vtk(np.ascontiguousarray(values, dtype=dtype), deep=False)
    array.SetName(name)
    return array


def places_in(
    points: NDArray[Any], number: NDArray[np.float32], frames: Sequence[NDArray[np.float64]]
) -> NDArray[np.float32]:
    """(p, 3) points (p, 3), each in the frame (3, 4) of its number (p,)."""
    places = np.zeros((len(points), 3), np.float32)
    for i in np.unique(number).astype(int).tolist():
        rows = number == i
        matrix = frames[i]
        places[rows] = points[rows] @ matrix[:, :3].T + matrix[:, 3]
    return places
