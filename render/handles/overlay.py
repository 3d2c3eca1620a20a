"""What is drawn over the solids and hidden by none of them: handles, marks, dimension lines."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

import numpy as np
from vtkmodules.vtkRenderingCore import vtkProp, vtkRenderer

from .. import camera as camera_value
from ..camera import Camera
from ..look import Look, light_up

if TYPE_CHECKING:
    from collections.abc import Sequence

    from vtkmodules.vtkRenderingCore import vtkRenderWindow


class Mark(Protocol):
    """Something in the overlay."""

    @property
    def props(self) -> Sequence[vtkProp]:
        """Its actors; always the same ones, shown and hidden by their visibility."""
        ...

    def set_look(self, look: Look) -> None:
        """Take the colours of a theme."""
        ...

    def before_render(self, camera: Camera, size: tuple[float, float], scale: float) -> None:
        """Follow the camera; `size` in logical pixels, `scale` device pixels in one of them."""
        ...


class Overlay:
    """A renderer in a layer of its own, between the picture and the view cube, seen with the picture's camera."""

    def __init__(self, window: vtkRenderWindow, look: Look, layer: int = 1) -> None:
        self.renderer = vtkRenderer()
        self.renderer.SetLayer(layer)
        self.renderer.InteractiveOff()
        self.renderer.SetUseOIT(False)  # it would draw what is translucent to buffers of its own: 10 ms on a processor
        window.SetNumberOfLayers(max(window.GetNumberOfLayers(), layer + 1))
        window.AddRenderer(self.renderer)
        light_up(self.renderer)
        self._look = look
        self.marks: list[Mark] = []

    def add(self, mark: Mark) -> None:
        self.marks.append(mark)
        mark.set_look(self._look)
        for prop in mark.props:
            self.renderer.AddViewProp(prop)

    def remove(self, mark: Mark) -> None:
        """Does nothing where it is not there."""
        if mark in self.marks:
            self.marks.remove(mark)
            for prop in mark.props:
                self.renderer.RemoveViewProp(prop)

    def set_look(self, look: Look) -> None:
        self._look = look
        for mark in self.marks:
            mark.set_look(look)

    def before_render(self, camera: Camera, size: tuple[float, float], scale: float) -> None:
        for mark in self.marks:
            mark.before_render(camera, size, scale)
        visible = any(prop.GetVisibility() for mark in self.marks for prop in mark.props)
        self.renderer.SetDraw(visible)
        if visible:
            bounds = np.array(self.renderer.ComputeVisiblePropBounds()).reshape(3, 2).T
            proper = bool((bounds[0] <= bounds[1]).all())
            camera_value.apply(camera, self.renderer.GetActiveCamera(), bounds if proper else None)
