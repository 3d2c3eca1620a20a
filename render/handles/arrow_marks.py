"""Arrows with letters from a point of the picture, such as normals and ways to lights."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkProp

from ..camera import Camera
from ..look import LIGHT, Look, rgb
from ..shading import unlit
from .pen import Labels, LabelText, Pen, ink_of

WIDTH, DOT = 2.6, 4.2  # logical pixels
HEAD = 0.14  # of an arrow's length
MOST = 20


@dataclass(frozen=True, slots=True, eq=False)
class Arrow:
    """From `start` (3,) to `end` (3,), with a letter at its end; `colour` on light ground and on dark."""

    start: NDArray[np.float64]
    end: NDArray[np.float64]
    text: str
    colour: tuple[str, str]
    dashed: bool = False


class ArrowMarks:
    """A `Mark` of arrows and the points they begin at."""

    def __init__(self) -> None:
        self._look = LIGHT
        self._data = vtkPolyData()
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(self._data)
        self._strokes = vtkActor()
        self._strokes.SetMapper(mapper)
        self._strokes.PickableOff()
        unlit(self._strokes)
        self._labels = Labels(MOST)
        self.arrows: tuple[Arrow, ...] = ()
        self.show(())

    @property
    def props(self) -> Sequence[vtkProp]:
        return (self._strokes, *self._labels.props)

    def show(self, arrows: Sequence[Arrow]) -> None:
        """Up to MOST of them."""
        self.arrows = tuple(arrows)[:MOST]
        self._strokes.SetVisibility(bool(self.arrows))
        self._labels.hide()

    def set_look(self, look: Look) -> None:
        self._look = look

    def before_render(self, camera: Camera, size: tuple[float, float], scale: float) -> None:
        if not self.arrows:
            return
        pen, ground = Pen(camera, size), rgb(self._look.plain_background)
        dark = self._look.background_top < "#8"
        labels: list[LabelText] = []
        for arrow in self.arrows:
            ink = rgb(arrow.colour[dark])
            draw = pen.dashes if arrow.dashed else pen.stroke
            ends = draw(arrow.start, arrow.end, WIDTH, ink, ground)
            if ends is None:
                continue
            self._head(pen, camera, arrow, ink)
            way = ends[1] - ends[0]
            length = max(float(np.linalg.norm(way)), 1.0)
            labels.append((ends[1] + way / length * 12.0, arrow.text, ink))
        for start in {tuple(arrow.start.tolist()) for arrow in self.arrows}:
            pen.dot(np.array(start), DOT, ink_of(self._look), ground)
        pen.fill(self._data)
        self._labels.show(labels, ground, size, scale)

    @staticmethod
    def _head(pen: Pen, camera: Camera, arrow: Arrow, ink: tuple[float, float, float]) -> None:
        way = arrow.end - arrow.start
        across = np.cross(way, np.asarray(camera.position) - arrow.end)
        size = float(np.linalg.norm(across))
        if size < 1e-12:
            return
        across *= 0.5 * np.linalg.norm(way) / size
        for side in (across, -across):
            pen.stroke(arrow.end, arrow.end + HEAD * (side - way), WIDTH, ink, None)
