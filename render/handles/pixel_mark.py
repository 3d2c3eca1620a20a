"""A small cross at the pixel that the pipeline finds for a point, with the pixel's numbers beside it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkProp

from ..camera import Camera, on_target_plane
from ..look import LIGHT, Look, rgb
from ..pipeline import matrices_of
from ..shading import unlit
from .label import Label
from .pen import Pen

ARM, GAP, WIDTH = 13.0, 3.0, 1.8  # logical pixels: how long the cross's arms are, where they begin, how wide
COLOUR = ("#c2185b", "#ff7aa8")  # on light ground and on dark


class PixelMark:
    """A `Mark`. It stands where the matrices of the camera say, not where the renderer draws the point."""

    def __init__(self) -> None:
        self._look = LIGHT
        self._data = vtkPolyData()
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(self._data)
        self._strokes = vtkActor()
        self._strokes.SetMapper(mapper)
        self._strokes.PickableOff()
        unlit(self._strokes)
        self._label = Label()
        self.point: NDArray[np.float64] | None = None
        self.pixel: tuple[float, float] | None = None
        """Where it stands, None where it cannot be seen."""
        self.show(None)

    @property
    def props(self) -> Sequence[vtkProp]:
        return (self._strokes, *self._label.props)

    def show(self, point: NDArray[np.float64] | None) -> None:
        """Mark a point (3,) of the world, or nothing."""
        self.point = point
        if point is None:
            self._hide()

    def set_look(self, look: Look) -> None:
        self._look = look
        self._label.set_look(look)

    def before_render(self, camera: Camera, size: tuple[float, float], scale: float) -> None:
        if self.point is None:
            return
        found = matrices_of(camera, size, (0.1 * camera.distance, camera.distance)).stages([self.point])
        x, y = (float(value) for value in found.pixel[0, :2])
        if found.clip[0, 3] <= 0.0 or not (0.0 <= x <= size[0] and 0.0 <= y <= size[1]):
            self._hide()
            return
        self.pixel = x, y
        self._strokes.SetVisibility(True)
        pen, ground = Pen(camera, size), rgb(self._look.plain_background)
        ink = rgb(COLOUR[self._look.background_top < "#8"])
        for dx, dy in ((1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)):
            inner, outer = (on_target_plane(camera, x + dx * r, y + dy * r, size) for r in (GAP, ARM))
            pen.stroke(inner, outer, WIDTH, ink, ground)
        pen.fill(self._data)
        self._label.show(f"{x:.1f}, {y:.1f}", x - 6.0, y - 6.0)
        self._label.before_render(camera, size, scale)

    def _hide(self) -> None:
        self.pixel = None
        self._strokes.SetVisibility(False)
        self._label.show("")
