"""A pair of solids over the picture: the way between them with its length, or the body that they share."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkProp

from ..camera import Camera, on_target_plane, project
from ..look import LIGHT, Colour, Look, rgb
from ..polydata import cells_of, points_of
from ..shading import unlit
from .pen import Labels, Pen, ink_of

Floats = NDArray[np.float64]

INKS = ("#b3470a", "#ffb066")
"""On light ground and on dark."""
FILLS = ("#e07b1f", "#ff9a3d")
LINE, DOT, LEADER = 2.4, 4.6, 1.6  # logical pixels
SHORT = 18.0
"""Pixels: the words of a shorter way stand beside it, with a leader."""
AWAY = (34.0, 30.0)  # pixels from there to the words, across and up
LETTER = 6.4  # pixels that a letter is wide, nearly


@dataclass(frozen=True, slots=True, eq=False)
class MarkedPair:
    """`ends` (2, 3) of the way between two solids, None where they overlap; the body that they share by `vertices`
    (n, 3) and `triangles` (m, 3), empty where it is not known; a `place` (3,) and `words` about it."""

    place: Floats
    words: str
    ends: Floats | None
    vertices: Floats
    triangles: NDArray[np.integer]


class ClearanceMarks:
    """A `Mark`. It is seen through the solids, whose gap or overlap lies between or within them."""

    def __init__(self) -> None:
        self._look = LIGHT
        self._body, self._sign = vtkActor(), vtkActor()
        for actor in (self._body, self._sign):
            mapper = vtkPolyDataMapper()
            mapper.SetInputData(vtkPolyData())
            actor.SetMapper(mapper)
            actor.PickableOff()
            actor.VisibilityOff()
        unlit(self._sign)
        self._body.GetProperty().BackfaceCullingOn()
        self._body.GetProperty().SetInterpolationToFlat()
        self._body.GetProperty().SetAmbient(0.35)
        self._drawn = vtkPolyData()
        self._sign.GetMapper().SetInputDataObject(self._drawn)
        self._labels = Labels(1)
        self.pair: MarkedPair | None = None
        self._colour()

    @property
    def props(self) -> Sequence[vtkProp]:
        return (self._body, self._sign, *self._labels.props)

    def set_look(self, look: Look) -> None:
        self._look = look
        self._colour()

    def show(self, pair: MarkedPair | None) -> None:
        self.pair = pair
        self._labels.hide()
        self._sign.SetVisibility(pair is not None)
        self._body.SetVisibility(pair is not None and bool(len(pair.triangles)))
        if pair is not None and len(pair.triangles):
            body = vtkPolyData()
            body.SetPoints(points_of(pair.vertices))
            body.SetPolys(cells_of(np.ascontiguousarray(pair.triangles, np.int32)))
            self._body.GetMapper().SetInputDataObject(body)

    def before_render(self, camera: Camera, size: tuple[float, float], scale: float) -> None:
        pair = self.pair
        if pair is None:
            return
        pixel = project(camera, [pair.place], size)[0]
        seen = bool(np.isfinite(pixel).all())
        self._sign.SetVisibility(seen)
        if not seen:
            self._labels.hide()
            return
        pen = Pen(camera, size)
        ink, ground = self._ink(INKS), rgb(self._look.plain_background)
        length = 0.0
        if pair.ends is not None:
            drawn = pen.stroke(pair.ends[0], pair.ends[1], LINE, ink, ground)
            length = 0.0 if drawn is None else float(np.linalg.norm(drawn[1] - drawn[0]))
            for end in pair.ends:
                pen.dot(end, DOT, ink, ground)
        middle, half = pixel[:2], LETTER * len(pair.words) / 2.0
        if length < SHORT:
            right = -1.0 if middle[0] > 0.6 * size[0] else 1.0
            up = 1.0 if middle[1] < 0.2 * size[1] else -1.0
            end = middle + np.array([right * AWAY[0], up * AWAY[1]])
            pen.stroke(_at(camera, middle, size), _at(camera, end, size), LEADER, ink, ground)
            words = np.array([max(min(end[0] + right * half, size[0] - half), half), end[1]])
        else:
            words = middle
        pen.fill(self._drawn)
        self._labels.show([(words, pair.words, ink_of(self._look))], ground, size, scale)

    def _ink(self, inks: tuple[str, str]) -> Colour:
        return rgb(inks[0] if self._look.background_top > "#8" else inks[1])

    def _colour(self) -> None:
        self._body.GetProperty().SetColor(*self._ink(FILLS))


def _at(camera: Camera, pixel: Floats, size: tuple[float, float]) -> Floats:
    return on_target_plane(camera, float(pixel[0]), float(pixel[1]), size)
