"""The mark on a face that the pointer means: tinted, with its border; solids before it hide it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

from ..look import rgb
from ..polydata import cells_of, lines_of, points_of
from ..shading import unlit

if TYPE_CHECKING:
    from ...model.measuring.landmarks import Face
    from ...model.solid.display import DisplayMesh
    from ..viewer import Viewer

TINT, WIDTH = 0.4, 2.5  # opacity of the face, logical pixels of its border


class FaceMark:
    """Shows one flat face of a mesh, among the solids of a viewer's picture."""

    def __init__(self, viewer: Viewer) -> None:
        self._viewer = viewer
        self._fill, self._rim = vtkActor(), vtkActor()
        for actor in (self._fill, self._rim):
            mapper = vtkPolyDataMapper()
            mapper.SetResolveCoincidentTopologyToPolygonOffset()
            mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(0.0, -1.0)
            mapper.SetRelativeCoincidentTopologyLineOffsetParameters(0.0, -3.0)
            actor.SetMapper(mapper)
            actor.PickableOff()
            actor.VisibilityOff()
            unlit(actor)
            viewer.renderer.AddActor(actor)
        self._fill.GetProperty().SetOpacity(TINT)
        self._face: Face | None = None

    def show(self, mesh: DisplayMesh | None = None, face: Face | None = None) -> None:
        """Mark this face of the mesh, or none."""
        if face is self._face:
            return
        self._face = face
        self._viewer.needs_render = True
        for actor in (self._fill, self._rim):
            actor.SetVisibility(face is not None)
            actor.GetProperty().SetColor(*rgb(self._viewer.scene.look.hover))
        self._rim.GetProperty().SetLineWidth(WIDTH * self._viewer.scale)
        if mesh is not None and face is not None:
            surface = vtkPolyData()
            surface.SetPoints(points_of(mesh.points))
            surface.SetPolys(cells_of(mesh.triangles[face.triangles]))
            self._fill.GetMapper().SetInputDataObject(surface)
            ends = np.arange(2 * len(face.rim), dtype=np.int32).reshape(-1, 2)
            self._rim.GetMapper().SetInputDataObject(lines_of(face.rim.reshape(-1, 3), ends))
