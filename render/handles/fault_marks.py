"""Faults of meshes and drawings over the picture: a spot for each; the chosen one has a ring, a leader and words."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkProp

from ..camera import Camera, on_target_plane, project
from ..look import LIGHT, Colour, Look, rgb
from ..polydata import cells_of, lines_of, points_of
from ..shading import unlit
from .pen import Labels, Pen, ink_of

Floats = NDArray[np.float64]

INKS = ("#cc1464", "#ff6ba6")
"""On light ground and on dark: unlike what is selected, pointed at or an axis."""
SPOT, LINE, RING, LEADER = 5.0, 3.0, 2.2, 1.6  # logical pixels: breadths
ROOM, LARGEST = 9.0, 16.0  # pixels from what is ringed to the ring; half of the largest thing that is
AWAY = (34.0, 30.0)  # pixels from the ring to the words, across and up
LETTER = 6.4  # pixels that a letter is wide, nearly
FILL = 0.35  # opacity of faces


@dataclass(frozen=True, slots=True, eq=False)
class MarkedFault:
    """In the world: a `place` (3,), the `size` in mm of what is there, its lines (k, 2, 3) and faces (m, 3, 3); and
    `words` about it."""

    place: Floats
    size: float
    words: str
    lines: Floats
    faces: Floats


class FaultMarks:
    """A `Mark`. What lies behind a solid is seen as well, so that nothing tiny is missed."""

    def __init__(self) -> None:
        self._look = LIGHT
        self._spots, self._lines, self._faces, self._sign = (vtkActor() for _ in range(4))
        for actor in (self._spots, self._lines, self._faces, self._sign):
            mapper = vtkPolyDataMapper()
            mapper.SetInputData(vtkPolyData())
            actor.SetMapper(mapper)
            actor.PickableOff()
            actor.VisibilityOff()
            unlit(actor)
        self._faces.GetProperty().SetOpacity(FILL)
        self._drawn = vtkPolyData()
        self._sign.GetMapper().SetInputDataObject(self._drawn)
        self._labels = Labels(1)
        self.places: Floats = np.zeros((0, 3))
        self.chosen: MarkedFault | None = None
        self._colour()

    @property
    def props(self) -> Sequence[vtkProp]:
        return (self._faces, self._lines, self._spots, self._sign, *self._labels.props)

    def set_look(self, look: Look) -> None:
        self._look = look
        self._colour()

    def show(self, places: Floats, chosen: MarkedFault | None = None) -> None:
        """Spots at places (n, 3), and the chosen fault; nothing where there are neither."""
        if places is not self.places:
            self.places = places
            spots = vtkPolyData()
            spots.SetPoints(points_of(places))
            spots.SetVerts(cells_of(np.arange(len(places), dtype=np.int32).reshape(-1, 1)))
            self._spots.GetMapper().SetInputDataObject(spots)
        self.chosen = chosen
        self._spots.SetVisibility(bool(len(places)))
        self._sign.SetVisibility(chosen is not None)
        self._labels.hide()
        for actor in (self._lines, self._faces):
            actor.SetVisibility(False)
        if chosen is None:
            return
        rims = np.stack((chosen.faces, np.roll(chosen.faces, -1, axis=1)), axis=2).reshape(-1, 2, 3)
        lines = np.concatenate((chosen.lines.reshape(-1, 2, 3), rims))
        if len(lines):
            ends = np.arange(2 * len(lines), dtype=np.int32).reshape(-1, 2)
            self._lines.GetMapper().SetInputDataObject(lines_of(lines.reshape(-1, 3), ends))
            self._lines.SetVisibility(True)
        if len(chosen.faces):
            faces = vtkPolyData()
            faces.SetPoints(points_of(chosen.faces))
            faces.SetPolys(cells_of(np.arange(3 * len(chosen.faces), dtype=np.int32).reshape(-1, 3)))
            self._faces.GetMapper().SetInputDataObject(faces)
            self._faces.SetVisibility(True)

    def before_render(self, camera: Camera, size: tuple[float, float], scale: float) -> None:
        self._spots.GetProperty().SetPointSize(SPOT * scale)
        self._lines.GetProperty().SetLineWidth(LINE * scale)
        chosen = self.chosen
        if chosen is None:
            return
        pixel = project(camera, [chosen.place], size)[0]
        seen = bool(np.isfinite(pixel).all())
        self._sign.SetVisibility(seen)
        if not seen:
            self._labels.hide()
            return
        pen = Pen(camera, size)

        def at(pixel: Floats) -> Floats:
            return on_target_plane(camera, float(pixel[0]), float(pixel[1]), size)

        ink, ground = self._ink, rgb(self._look.plain_background)
        depth = 1.0 if camera.parallel else float(pixel[2]) / camera.distance
        reach = 0.25 * chosen.size / (camera.half_height * max(depth, 1e-12)) * size[1]
        middle = pixel[:2]
        radius = 0.0
        if reach <= LARGEST:
            radius = reach + ROOM
            turn = np.linspace(0.0, 2.0 * np.pi, 41)
            rim = middle + radius * np.column_stack((np.cos(turn), np.sin(turn)))
            pen.polyline(np.array([at(pixel) for pixel in rim]), RING, ink, ground)
        right = -1.0 if middle[0] > 0.6 * size[0] else 1.0
        up = 1.0 if middle[1] < 0.2 * size[1] else -1.0
        way = np.array([right, up]) / np.sqrt(2.0)
        begin = middle + radius * way
        end = begin + np.array([right * AWAY[0], up * AWAY[1]])
        pen.stroke(at(begin), at(end), LEADER, ink, ground)
        if not radius:
            pen.dot(at(middle), 1.5 * RING, ink, ground)
        pen.fill(self._drawn)
        half = LETTER * len(chosen.words) / 2.0
        words = np.array([max(min(end[0] + right * half, size[0] - half), half), end[1]])
        self._labels.show([(words, chosen.words, ink_of(self._look))], ground, size, scale)

    @property
    def _ink(self) -> Colour:
        return rgb(INKS[0] if self._look.background_top > "#8" else INKS[1])

    def _colour(self) -> None:
        for actor in (self._spots, self._lines, self._faces):
            actor.GetProperty().SetColor(*self._ink)
