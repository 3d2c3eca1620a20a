"""Dimension lines: from one point to another with arrows and a label, and the ways along the axes that add up to it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkProp, vtkTextActor

from ..camera import Camera, frame, project
from ..look import LIGHT, Colour, Look, mixed, rgb
from ..polydata import cells_of, points_of, set_cell_colours
from ..shading import unlit

if TYPE_CHECKING:
    from ...model.measuring.elements import Line

Floats = NDArray[np.float64]

WIDTH, LEG, OUTLINE, HALO = 1.8, 1.6, 3.0, 1.2  # logical pixels; the halo is added on both sides
ARROW, SPREAD = 11.0, 3.6  # length and half the width of an arrow's head
SHORTEST = 30.0  # pixels that a line with arrows has at least
LABELS = 24
LETTERS = 9  # points
NEAREST = 1e-3  # of the camera's distance: lines are cut so far before the eye
LEAST_LEG = 1e-9  # millimetres


@dataclass(frozen=True, slots=True, eq=False)
class Dimension:
    """`outline` (n, 2, 3) shows what was measured. `strong`: the one the user looks at; `stale`: the solid is another
    one now."""

    line: Line | None
    legs: bool
    outline: Floats
    strong: bool = True
    stale: bool = False


class DimensionMarks:
    """A `Mark` of all dimensions; drawn in pixels, so that lines and letters are as wide at every distance."""

    def __init__(self) -> None:
        self._look = LIGHT
        self._dimensions: tuple[Dimension, ...] = ()
        self._data = vtkPolyData()
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(self._data)
        self._strokes = vtkActor()
        self._strokes.SetMapper(mapper)
        self._strokes.PickableOff()
        unlit(self._strokes)
        self._labels = [vtkTextActor() for _ in range(LABELS)]
        for label in self._labels:
            letters = label.GetTextProperty()
            letters.SetFontFamilyToArial()
            letters.SetFontSize(LETTERS)
            letters.SetJustificationToCentered()
            letters.SetVerticalJustificationToCentered()
            letters.SetBackgroundOpacity(0.92)
            label.PickableOff()
        self.show(())

    @property
    def props(self) -> Sequence[vtkProp]:
        return (self._strokes, *self._labels)

    def show(self, dimensions: Sequence[Dimension]) -> None:
        """The last ones are drawn over the others."""
        self._dimensions = tuple(dimensions)
        self._strokes.SetVisibility(bool(dimensions))
        for label in self._labels:
            label.SetVisibility(False)

    def set_look(self, look: Look) -> None:
        self._look = look

    def before_render(self, camera: Camera, size: tuple[float, float], scale: float) -> None:
        if not self._dimensions:
            return
        pen = _Pen(camera, size)
        labels: list[tuple[Floats, str, Colour]] = []
        for dimension in self._dimensions:
            self._draw(pen, dimension, labels)
        pen.fill(self._data)
        ground = rgb(self._look.plain_background)
        free = iter(self._labels)
        for place, text, colour in reversed(labels):
            label = next(free, None)
            if label is None:
                break
            letters = label.GetTextProperty()
            letters.SetColor(*colour)
            letters.SetBackgroundColor(*ground)
            label.SetInput(f" {text} ")
            label.SetPosition(round(place[0] * scale), round((size[1] - place[1]) * scale))
            label.SetVisibility(True)
        for label in free:
            label.SetVisibility(False)

    def _draw(self, pen: _Pen, dimension: Dimension, labels: list[tuple[Floats, str, Colour]]) -> None:
        look = self._look
        ground = rgb(look.plain_background)
        ink = rgb("#1f2a38" if look.background_top > "#8" else "#f2f5f8")
        share = 0.55 if dimension.stale else 0.0 if dimension.strong else 0.3
        ink = mixed(ink, ground, share)
        bright = dimension.strong and not dimension.stale
        if bright:
            for a, b in dimension.outline:
                pen.stroke(a, b, OUTLINE, rgb(look.selection), ground)
        line = dimension.line
        if line is None:
            return
        a, b = np.array(line.start), np.array(line.end)
        if dimension.legs and bright:
            axes = [rgb(colour) for colour in (look.axis_x, look.axis_y, look.axis_z)]
            turns = [a, np.array([b[0], a[1], a[2]]), np.array([b[0], b[1], a[2]]), b]
            for axis, (start, end) in enumerate(pairwise(turns)):
                length = float(np.abs(end - start).max())
                if LEAST_LEG < length < float(np.linalg.norm(b - a)) * (1 - 1e-9):
                    pixels = pen.stroke(start, end, LEG, axes[axis], ground)
                    if pixels is not None and np.linalg.norm(pixels[1] - pixels[0]) > SHORTEST:
                        words = f"Δ{'xyz'[axis]} {_signed((end - start)[axis])}"
                        labels.append((pixels.mean(axis=0), words, mixed(axes[axis], ink, 0.35)))
        pixels = pen.stroke(a, b, WIDTH if bright else LEG, ink, ground if bright else None)
        if pixels is None:
            return
        pen.arrows(pixels, ink)
        labels.append((pixels.mean(axis=0), line.text, ink))


class _Pen:
    """Draws in pixels, on the plane through the camera's target, as triangles that the window smooths."""

    def __init__(self, camera: Camera, size: tuple[float, float]) -> None:
        self._camera, self._size = camera, size
        self._halo: list[Floats] = []
        self._core: list[Floats] = []
        self._colours: tuple[list[Colour], list[Colour]] = ([], [])

    def stroke(self, a: Floats, b: Floats, width: float, colour: Colour, halo: Colour | None) -> Floats | None:
        """A line between points of the world; its ends (2, 2) in pixels, None where it cannot be seen."""
        seen = self._before_the_eye(a, b)
        if seen is None:
            return None
        ends = project(self._camera, seen, self._size)[:, :2]
        along = ends[1] - ends[0]
        length = float(np.linalg.norm(along))
        if length < 1e-6:
            return ends
        across = np.array([-along[1], along[0]]) / length
        for half, found, colours, tone in (
            (width / 2 + HALO, self._halo, self._colours[0], halo),
            (width / 2, self._core, self._colours[1], colour),
        ):
            if tone is None:
                continue
            one, other = across * half, -across * half
            found.append(np.array([ends[0] + one, ends[0] + other, ends[1] + other]))
            found.append(np.array([ends[0] + one, ends[1] + other, ends[1] + one]))
            colours += [tone, tone]
        return ends

    def _before_the_eye(self, a: Floats, b: Floats) -> Floats | None:
        """The part (2, 3) of a line that can be projected."""
        ends = np.array([a, b])
        if self._camera.parallel:
            return ends
        depth = (np.asarray(self._camera.position) - ends) @ frame(self._camera)[2] - NEAREST * self._camera.distance
        if (depth < 0).all():
            return None
        for i in np.flatnonzero(depth < 0):
            ends[i] += (ends[1 - i] - ends[i]) * depth[i] / (depth[i] - depth[1 - i])
        return ends

    def arrows(self, ends: Floats, colour: Colour) -> None:
        along = ends[1] - ends[0]
        length = float(np.linalg.norm(along))
        if length < SHORTEST:
            return
        way = along / length
        across = np.array([-way[1], way[0]])
        for tip, back in ((ends[0], way), (ends[1], -way)):
            foot = tip + ARROW * back
            self._core.append(np.array([tip, foot + SPREAD * across, foot - SPREAD * across]))
            self._colours[1].append(colour)

    def fill(self, data: vtkPolyData) -> None:
        """All of it as triangles of the world; the halos a little behind the lines."""
        pixels = np.array([*self._halo, *self._core]).reshape(-1, 2)
        right, up, backward = frame(self._camera)
        half = self._camera.half_height
        width, height = self._size
        x = (2 * pixels[:, :1] - width) / height * half
        y = (1 - 2 * pixels[:, 1:] / height) * half
        points = np.asarray(self._camera.target) + x * right + y * up
        points[: 3 * len(self._halo)] -= 1e-4 * self._camera.distance * backward
        data.SetPoints(points_of(points))
        data.SetPolys(cells_of(np.arange(len(points), dtype=np.int32).reshape(-1, 3)))
        colours = np.array([*self._colours[0], *self._colours[1]]).reshape(-1, 3)
        set_cell_colours(data, np.round(255 * colours).astype(np.uint8))
        data.Modified()


def _signed(value: float) -> str:
    from ...model.measuring.elements import short

    return short(value).replace("-", "\u2212")
