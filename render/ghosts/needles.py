"""Normals as needles on the faces, in one actor of the scene's own renderer, so that faces hide them."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

from ...model.document.colours import rgb
from ..look import Look
from ..polydata import lines_of, set_point_colours
from ..shading import unlit

if TYPE_CHECKING:
    from vtkmodules.vtkRenderingCore import vtkRenderer

    from ..sections import Sections

COLOURS = {"face": ("#1763c6", "#79b4ff"), "vertex": ("#a8278b", "#f39adf")}
"""Of each kind in the light and in the dark theme."""
WIDTH = 1.5  # logical pixels
NEARER = -3.0  # in steps of depth, as the edges are


class NormalNeedles:
    def __init__(self, renderer: "vtkRenderer", look: Look) -> None:
        self._renderer = renderer
        self._look = look
        self._kinds: NDArray[np.int64] = np.zeros(0, np.int64)
        self._actor: vtkActor | None = None
        self._scale = 1.0

    @property
    def count(self) -> int:
        return len(self._kinds) // 2

    def show(self, lines: Mapping[str, NDArray[np.float64]], sections: "Sections") -> None:
        """Show exactly these (n, 2, 3), by kind, from foot to tip."""
        ends = np.concatenate([np.zeros((0, 2, 3)), *lines.values()]).reshape(-1, 3)
        places = [np.full(2 * len(one), list(COLOURS).index(kind)) for kind, one in lines.items()]
        self._kinds = np.concatenate([np.zeros(0, np.int64), *places])
        if self._actor is not None:
            self._actor.SetVisibility(bool(len(ends)))
        if not len(ends):
            return
        data = lines_of(ends, np.arange(len(ends), dtype=np.int32).reshape(-1, 2))
        actor = self._made()
        actor.GetMapper().SetInputDataObject(data)
        self._paint()
        sections.clip((actor,))

    def _made(self) -> vtkActor:
        if self._actor is None:
            mapper = vtkPolyDataMapper()
            mapper.SetResolveCoincidentTopologyToPolygonOffset()
            mapper.SetRelativeCoincidentTopologyLineOffsetParameters(0.0, NEARER)
            self._actor = actor = vtkActor()
            actor.SetMapper(mapper)
            actor.PickableOff()
            actor.UseBoundsOff()
            unlit(actor)
            actor.GetProperty().SetLineWidth(WIDTH * self._scale)
            self._renderer.AddActor(actor)
        return self._actor

    def clip(self, sections: "Sections") -> None:
        """Cut them where the sections that are open now cut the solids."""
        if self._actor is not None:
            sections.clip((self._actor,))

    def set_look(self, look: Look) -> None:
        self._look = look
        self._paint()

    def set_line_scale(self, scale: float) -> None:
        """Device pixels per logical pixel."""
        self._scale = scale
        if self._actor is not None:
            self._actor.GetProperty().SetLineWidth(WIDTH * scale)

    def _paint(self) -> None:
        if self._actor is not None:
            inks = np.array([rgb(pair[self._look.name == "dark"]) for pair in COLOURS.values()], np.uint8)
            set_point_colours(self._actor.GetMapper().GetInput(), inks[self._kinds])
