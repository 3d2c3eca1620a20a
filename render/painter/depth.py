"""A depth test that every pixel passes, for one actor alone."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any
from weakref import ref

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

from ..polydata import cells_of, points_of
from ..shading import unlit

if TYPE_CHECKING:
    from vtkmodules.vtkRenderingCore import vtkRenderer

GL_LEQUAL, GL_ALWAYS = 0x0203, 0x0207


class DepthAlways:
    """Lets an actor of a renderer win over all that was drawn before it, and be compared as usual with what follows.

    The depths that it leaves are those of what it draws last. VTK has no such setting, and tells nobody when an actor
    has been drawn. So a second actor follows it at once, of one triangle without an area: the mappers' events, which
    come just before each is drawn, change the test for the one and restore it for the other. It has the bounds of the
    first, so that the renderer leaves out both or none.
    """

    def __init__(self, renderer: vtkRenderer, actor: vtkActor) -> None:
        self.on = True
        self._renderer = renderer
        self._mapper: Any = vtkPolyDataMapper()
        self.restorer = vtkActor()
        self.restorer.SetMapper(self._mapper)
        self.restorer.PickableOff()
        unlit(self.restorer)
        self.set_bounds(np.zeros((2, 3)))

        # What observers hold, Python never lets go of: it would be the renderer that holds the mapper.
        held = ref(self)
        mapper: Any = actor.GetMapper()
        mapper.AddObserver("EndEvent", lambda *_: (own := held()) and own._set_test(own.on))
        self._mapper.AddObserver("EndEvent", lambda *_: (own := held()) and own._set_test(False))
        renderer.AddActor(actor)
        renderer.AddActor(self.restorer)

    def _set_test(self, always: bool) -> None:
        window: Any = self._renderer.GetRenderWindow()
        if window is not None:
            window.GetState().vtkglDepthFunc(GL_ALWAYS if always else GL_LEQUAL)

    def set_bounds(self, bounds: NDArray[np.float64]) -> None:
        """The box (2, 3) of what the actor draws."""
        data = vtkPolyData()
        data.SetPoints(points_of(bounds))
        data.SetPolys(cells_of(np.array([[0, 1, 1]], np.int32)))
        self._mapper.SetInputData(data)
