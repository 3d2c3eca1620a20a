"""Shadow maps (Williams 1978, "Casting curved shadows on curved surfaces"): depths of the faces as lights see them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkFloatArray
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer

from ...model.surface.light import Light
from ..camera import Camera, frame
from ..window import close, offscreen_window
from .bitmaps import image_of, texture_of

if TYPE_CHECKING:
    from vtkmodules.vtkRenderingCore import vtkTexture

MOST = 3
"""Lights that cast shadows at once: graphics cards let a shader read 16 textures at least."""
SIDE = 1024
"""Texels along a map."""


def casting(lights: Sequence[Light]) -> tuple[int, ...]:
    """The places of the lights that cast shadows among those that are active and not ambient."""
    shining = [light for light in lights if light.active and light.kind != "ambient"]
    return tuple(place for place, light in enumerate(shining) if light.shadows)[:MOST]


class Shadows:
    """The maps of one picture. `textures`, `matrices` (4, 4) from the world to clip coordinates, and `offsets` (mm, by
    which a place stands before its face when it is compared) are in the order of `casting`."""

    def __init__(self) -> None:
        self.textures: list[vtkTexture] = [texture_of(np.ones((1, 1, 1), np.float32)) for _ in range(MOST)]
        self.matrices: list[NDArray[np.float64]] = [np.eye(4)] * MOST
        self.offsets = [0.0] * MOST
        self._made_of: tuple[object, ...] | None = None

    def update(
        self, lights: Sequence[Light], faces: Sequence[vtkActor], bounds: NDArray[np.float64] | None, eye: Camera
    ) -> None:
        """Make the maps anew where lights or faces are others. `bounds` (2, 3) is the box around the faces."""
        shining = [light for light in lights if light.active and light.kind != "ambient"]
        wanted = [shining[place] for place in casting(lights)]
        if not wanted or bounds is None:
            self._made_of = None
            return
        data: list[Any] = [actor.GetMapper().GetInput() for actor in faces]
        clips = [_clipping(actor) for actor in faces]
        follows = eye if any(light.with_camera for light in wanted) else None
        made_of = (tuple(wanted), tuple(map(id, data)), tuple(clips), bounds.tobytes(), follows)
        if made_of == self._made_of:
            return
        self._made_of = made_of
        window = offscreen_window((SIDE, SIDE))
        try:
            renderer = vtkRenderer()
            window.AddRenderer(renderer)
            for actor, surface in zip(faces, data, strict=True):
                mapper = vtkPolyDataMapper()
                mapper.SetInputData(surface)
                mapper.ScalarVisibilityOff()
                planes = actor.GetMapper().GetClippingPlanes()
                if planes is not None:
                    mapper.SetClippingPlanes(planes)
                caster = vtkActor()
                caster.SetMapper(mapper)
                caster.GetProperty().LightingOff()
                renderer.AddActor(caster)
            for number, light in enumerate(wanted):
                self._make(number, light, window, renderer, bounds, eye)
        finally:
            close(window)

    def _make(
        self, number: int, light: Light, window: Any, renderer: vtkRenderer, bounds: NDArray[np.float64], eye: Camera
    ) -> None:
        middle, radius = bounds.mean(axis=0), max(float(np.linalg.norm(np.ptp(bounds, axis=0))) / 2.0, 1e-6)
        axes = frame(eye)
        camera = renderer.GetActiveCamera()
        if light.kind == "point":
            place = np.array(light.position)
            if light.with_camera:
                place = np.asarray(eye.position) + place @ axes
            away = float(np.linalg.norm(place - middle))
            if away < 1.02 * radius:  # a lamp among the solids sees on all sides: one map cannot hold that
                self.textures[number].SetInputData(image_of(np.ones((1, 1, 1), np.float32)))
                self.matrices[number] = np.eye(4)
                return
            camera.ParallelProjectionOff()
            camera.SetViewAngle(2.0 * np.degrees(np.arcsin(radius / away)))
            near, far = away - radius, away + radius
        else:
            direction = np.array(light.direction)
            if light.with_camera:
                direction = direction @ axes
            place = middle - 2.0 * radius * direction
            camera.ParallelProjectionOn()
            camera.SetParallelScale(radius)
            near, far = radius, 3.0 * radius
        towards = (middle - place) / np.linalg.norm(middle - place)
        camera.SetPosition(*place)
        camera.SetFocalPoint(*middle)
        camera.SetViewUp(*((0.0, 1.0, 0.0) if abs(towards[2]) > 0.9 else (0.0, 0.0, 1.0)))
        camera.SetClippingRange(max(0.99 * near, 1e-3 * far), 1.01 * far)
        window.Render()
        depths = vtkFloatArray()
        window.GetZbufferData(0, 0, SIDE - 1, SIDE - 1, depths)
        image = image_of(vtk_to_numpy(depths).reshape(SIDE, SIDE, 1))
        self.textures[number].SetInputData(image)
        matrix = camera.GetCompositeProjectionTransformMatrix(1.0, -1.0, 1.0)
        self.matrices[number] = np.array([[matrix.GetElement(i, j) for j in range(4)] for i in range(4)])
        self.offsets[number] = 6.0 * radius / SIDE


def _clipping(actor: vtkActor) -> tuple[object, ...]:
    planes = actor.GetMapper().GetClippingPlanes()
    if planes is None:
        return ()
    items = [planes.GetItem(i) for i in range(planes.GetNumberOfItems())]
    return tuple((plane.GetOrigin(), plane.GetNormal()) for plane in items)
