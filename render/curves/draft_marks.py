"""What an outline looks like while it is drawn, over the picture; and the plane that it is drawn on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkProp, vtkRenderer

from ...model.document.placement import inverse
from ..camera import Camera, vector_of
from ..ground import Ground
from ..handles.pen import Pen, ink_of
from ..look import LIGHT, Look, mixed, rgb
from ..shading import unlit

Floats = NDArray[np.float64]

CURVE, COMING, GUIDE, ARM = 2.2, 1.6, 1.0, 1.2  # logical pixels, the widths of lines
NODE, RIM, HANDLE = 7.0, 1.4, 6.0  # the side of a node's square, its border, the breadth of a handle's disc


@dataclass(frozen=True, slots=True, eq=False)
class DraftPicture:
    """In the world: lines (n, 3) that are settled, that would come, and that guide; nodes (k, 3), and arms (m, 2, 3)
    from them to their handles."""

    settled: Sequence[Floats] = ()
    coming: Sequence[Floats] = ()
    guides: Sequence[Floats] = ()
    nodes: Floats = field(default_factory=lambda: np.zeros((0, 3)))
    arms: Floats = field(default_factory=lambda: np.zeros((0, 2, 3)))


class DraftMarks:
    """A `Mark` of one outline; the first of its nodes is filled, for a click on it closes."""

    def __init__(self) -> None:
        self._look = LIGHT
        self._data = vtkPolyData()
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(self._data)
        self._actor = vtkActor()
        self._actor.SetMapper(mapper)
        self._actor.PickableOff()
        self._actor.VisibilityOff()
        unlit(self._actor)
        self.picture: DraftPicture | None = None

    @property
    def props(self) -> Sequence[vtkProp]:
        return (self._actor,)

    def show(self, picture: DraftPicture | None) -> None:
        self.picture = picture
        self._actor.SetVisibility(picture is not None)

    def set_look(self, look: Look) -> None:
        self._look = look

    def before_render(self, camera: Camera, size: tuple[float, float], scale: float) -> None:
        picture = self.picture
        if picture is None:
            return
        ground, accent = rgb(self._look.plain_background), rgb(self._look.selection)
        blue = rgb(self._look.hover)
        line = mixed(blue, (0.0, 0.0, 0.0), 0.45) if self._look.name == "light" else mixed(blue, (1.0, 1.0, 1.0), 0.3)
        pen = Pen(camera, size)
        for points in picture.guides:
            pen.dashes(points[0], points[1], GUIDE, accent, None)
        for points in picture.coming:
            pen.polyline(points, COMING, mixed(line, ground, 0.3), None)
        for points in picture.settled:
            pen.polyline(points, CURVE, line, ground)
        for node, handle in picture.arms:
            pen.stroke(node, handle, ARM, ink_of(self._look), None)
        for _, handle in picture.arms:
            pen.dot(handle, HANDLE / 2.0, ink_of(self._look), ground)
        for number, node in enumerate(picture.nodes):
            pen.square(node, NODE, accent, ground)
            if number:
                pen.square(node, NODE - 2.0 * RIM, ground, None)
        pen.fill(self._data)


class PlaneMark:
    """A `Mark`: the grid and the axes of a plane, as the ground has them, over the solids."""

    def __init__(self, renderer: vtkRenderer) -> None:
        self._ground = Ground(renderer)
        self._ground.set_visible(False)
        self._ground.actor.UseBoundsOn()  # what is seen here decides on the depths of its layer
        self._frame = np.eye(3, 4)

    @property
    def props(self) -> Sequence[vtkProp]:
        return (self._ground.actor,)

    def show(self, frame: Floats | None) -> None:
        """The plane z = 0 of these axes (3, 4), rigid to the world; None hides it."""
        self._ground.set_visible(frame is not None)
        if frame is not None:
            self._frame = np.asarray(frame, float)
            matrix = vtkMatrix4x4()
            matrix.DeepCopy(np.vstack((self._frame, [0.0, 0.0, 0.0, 1.0])).ravel().tolist())
            self._ground.actor.SetUserMatrix(matrix)

    def set_look(self, look: Look) -> None:
        self._ground.set_look(look)

    def before_render(self, camera: Camera, size: tuple[float, float], scale: float) -> None:
        if not self._ground.visible:
            return
        into = inverse(self._frame)
        turn = into[:, :3]
        moved = replace(
            camera,
            position=vector_of(turn @ camera.position + into[:, 3]),
            target=vector_of(turn @ camera.target + into[:, 3]),
            up=vector_of(turn @ camera.up),
        )
        self._ground.set_line_scale(scale)
        self._ground.update(moved)
