"""What is seen of a surface, painted on it texel by texel, with a legend of the shares."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkProp

from ...model.measuring.visibility import HIDDEN, SEEN, TURNED
from ..camera import Camera
from ..look import LIGHT, Colour, Look, mixed, rgb
from ..polydata import cells_of, points_of
from ..shading import unlit
from .pen import Labels, LabelText, ink_of
from .sight_marks import INKS

if TYPE_CHECKING:
    from ...model.measuring.visibility import Visibility
    from ..viewer import Viewer

PAINT, THROUGH = 0.6, 0.45  # opacity on the surface, and of what is hidden, seen through what hides it
LEFT, BOTTOM, LINE = 14.0, 22.0, 22.0  # logical pixels of the legend
NAMES = {SEEN: "Seen", HIDDEN: "Hidden", TURNED: "Turned away"}


class VisibilityMark:
    """A `Mark` for the legend and what is seen through; the rest is painted among the viewer's solids."""

    def __init__(self, viewer: Viewer) -> None:
        self._viewer = viewer
        self._look = LIGHT
        self._painted = {state: _actor(PAINT) for state in NAMES}
        self._through = _actor(THROUGH)
        for actor in self._painted.values():
            mapper = actor.GetMapper()
            mapper.SetResolveCoincidentTopologyToPolygonOffset()
            mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(0.0, -1.0)
            viewer.renderer.AddActor(actor)
        self._labels = Labels(len(NAMES))
        for label in self._labels.props:
            label.GetTextProperty().SetJustificationToLeft()
        self._legend: tuple[tuple[int, str], ...] = ()
        self.set_look(LIGHT)
        self.show(None)

    @property
    def props(self) -> Sequence[vtkProp]:
        return (self._through, *self._labels.props)

    def show(self, found: Visibility | None, through: bool = False) -> None:
        """Paint the texels, or nothing. `through`: those that are hidden are seen past what stands before them."""
        self._legend = ()
        for state, actor in self._painted.items():
            texels = np.zeros((0, 3, 3)) if found is None else found.texels[found.state == state]
            _take(self._through if through and state == HIDDEN else actor, texels)
            if found is not None and len(texels):
                facing = found.part(SEEN) + found.part(HIDDEN)
                share = "" if state == TURNED else f" {100.0 * found.part(state) / facing:.1f} %"
                self._legend = (*self._legend, (state, NAMES[state] + share))
        if not through or found is None:
            self._through.VisibilityOff()
        else:
            self._painted[HIDDEN].VisibilityOff()
        self._labels.hide()
        self._viewer.needs_render = True

    def set_look(self, look: Look) -> None:
        self._look = look
        for state, actor in self._painted.items():
            actor.GetProperty().SetColor(*self._ink(state))
        self._through.GetProperty().SetColor(*self._ink(HIDDEN))

    def before_render(self, camera: Camera, size: tuple[float, float], scale: float) -> None:
        labels: list[LabelText] = []
        for row, (state, words) in enumerate(reversed(self._legend)):
            labels.append((np.array([LEFT, size[1] - BOTTOM - row * LINE]), words, self._ink(state)))
        if labels:
            self._labels.show(labels, rgb(self._look.plain_background), size, scale)

    def _ink(self, state: int) -> Colour:
        if state == TURNED:
            return mixed(ink_of(self._look), rgb(self._look.solid), 0.4)
        inks = INKS["clear" if state == SEEN else "blocked"]
        return rgb(inks[0] if self._look.background_top > "#8" else inks[1])


def _actor(opacity: float) -> vtkActor:
    actor = vtkActor()
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(vtkPolyData())
    actor.SetMapper(mapper)
    actor.PickableOff()
    actor.VisibilityOff()
    actor.GetProperty().SetOpacity(opacity)
    unlit(actor)
    return actor


def _take(actor: vtkActor, texels: NDArray[np.float64]) -> None:
    surface = vtkPolyData()
    surface.SetPoints(points_of(texels))
    surface.SetPolys(cells_of(np.arange(3 * len(texels), dtype=np.int32).reshape(-1, 3)))
    actor.GetMapper().SetInputDataObject(surface)
    actor.SetVisibility(bool(len(texels)))
