"""Sets of vertices, edges and faces marked in the picture: one actor for each kind, however many they are."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

from ...model.mesh.winged import END, START
from ..ghosts.ghosts import BEFORE_ALL
from ..look import rgb
from ..polydata import cells_of, lines_of, points_of
from ..shading import unlit

if TYPE_CHECKING:
    from ...model.mesh.inspected import InspectedMesh
    from ..viewer import Viewer

Numbers = NDArray[np.int64]

NEARER = -6.0  # depth steps before the faces, which a mark lies on
MANY = 50_000
"""Of more elements a mark is plain: thin lines, opaque faces, nothing seen through faces. Without a graphics card thick
lines and what is translucent take many times as long."""
HIDDEN = 0.28  # opacity of edges and vertices that faces hide


class ElementMarks:
    """Marks among the solids of a viewer's picture. Edges and vertices are seen faintly through faces.

    They follow `scene.sections`: what a section takes away is not marked either.
    """

    def __init__(self, viewer: Viewer, opacity: float = 0.55) -> None:
        """`opacity` is that of faces."""
        self._viewer, self._opacity = viewer, opacity
        self._sizes: dict[vtkActor, float] = {}
        # Opacity, how much nearer than the faces, size in logical pixels.
        self._faces = self._made(opacity, NEARER)
        self._edges, self._far_edges = self._made(1.0, NEARER - 2.0, 3.0), self._made(HIDDEN, BEFORE_ALL, 2.0)
        self._vertices, self._far_vertices = self._made(1.0, NEARER - 6.0, 9.0), self._made(HIDDEN, BEFORE_ALL, 7.0)
        self._actors = (self._faces, self._edges, self._far_edges, self._vertices, self._far_vertices)
        self._planes = viewer.scene.sections.planes

    def show(
        self,
        mesh: InspectedMesh | None,
        colour: str = "#000000",
        vertices: Numbers | None = None,
        edges: Numbers | None = None,
        faces: Numbers | None = None,
    ) -> None:
        """Mark these elements of a mesh, by their numbers, and no others; `colour` as #rrggbb."""
        self._viewer.needs_render = True
        for actor in self._actors:
            actor.VisibilityOff()
        if mesh is None:
            return
        points = mesh.lists.vertices
        if faces is not None and len(faces):
            wanted = np.zeros(mesh.lists.face_count, bool)
            wanted[faces] = True
            triangles = mesh.triangles[wanted[mesh.triangle_face]]
            self._faces.GetProperty().SetOpacity(self._opacity if len(triangles) <= MANY else 1.0)
            self._put((self._faces,), _polygons(points, triangles), colour)
        if edges is not None and len(edges):
            ends = mesh.winged.table[edges][:, [START, END]]
            self._put((self._edges, self._far_edges), lines_of(*_used(points, ends)), colour, len(edges))
        if vertices is not None and len(vertices):
            data = vtkPolyData()
            data.SetPoints(points_of(points[vertices]))
            data.SetVerts(cells_of(np.arange(len(vertices), dtype=np.int32)[:, None]))
            self._put((self._vertices, self._far_vertices), data, colour, len(vertices))

    def follow_sections(self) -> None:
        """Let the sections that are open now clip what is marked."""
        planes = self._viewer.scene.sections.planes
        if planes != self._planes:
            self._planes = planes
            self._viewer.scene.sections.clip(self._actors)
            self._viewer.needs_render = True

    def _put(self, actors: tuple[vtkActor, ...], data: vtkPolyData, colour: str, count: int = 0) -> None:
        many = count > MANY
        for actor in actors[:1] if many else actors:
            actor.GetMapper().SetInputDataObject(data)
            look = actor.GetProperty()
            look.SetColor(*rgb(colour))
            look.SetLineWidth(1.0 if many else self._sizes[actor] * self._viewer.scale)
            look.SetPointSize(3.0 if many else self._sizes[actor] * self._viewer.scale)
            look.SetRenderPointsAsSpheres(actor in (self._vertices, self._far_vertices) and not many)
            actor.VisibilityOn()
        self._viewer.scene.sections.clip(actors)

    def _made(self, opacity: float, nearer: float, size: float = 1.0) -> vtkActor:
        mapper = vtkPolyDataMapper()
        mapper.ScalarVisibilityOff()
        mapper.SetResolveCoincidentTopologyToPolygonOffset()
        mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(0.0, nearer)
        mapper.SetRelativeCoincidentTopologyLineOffsetParameters(0.0, nearer)
        mapper.SetRelativeCoincidentTopologyPointOffsetParameter(nearer)
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.PickableOff()
        actor.UseBoundsOff()
        actor.VisibilityOff()
        unlit(actor)
        actor.GetProperty().SetOpacity(opacity)
        self._sizes[actor] = size
        self._viewer.renderer.AddActor(actor)
        return actor


def _used(points: NDArray[np.float64], cells: NDArray) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """The points that cells (k, j) use, and the cells by those."""
    used, places = np.unique(cells, return_inverse=True)
    return points[used], places.reshape(cells.shape).astype(np.int32)


def _polygons(points: NDArray[np.float64], triangles: NDArray) -> vtkPolyData:
    used, cells = _used(points, triangles)
    data = vtkPolyData()
    data.SetPoints(points_of(used))
    data.SetPolys(cells_of(cells))
    return data
