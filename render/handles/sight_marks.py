"""Lines of sight over the picture: green as far as one sees, then red and dashed; walls and gaps of a ray."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkProp

from ..camera import Camera
from ..look import LIGHT, Colour, Look, mixed, rgb
from ..shading import unlit
from .pen import Labels, LabelText, Pen, ink_of

Floats = NDArray[np.float64]
Kind = Literal["clear", "blocked", "wall", "unknown"]

WIDTH, OUTLINE, DOT = 2.4, 2.6, 4.2  # logical pixels
INKS: dict[str, tuple[str, str]] = {"clear": ("#14803c", "#5fd38d"), "blocked": ("#c62f25", "#ff8479")}
"""On light ground and on dark."""


@dataclass(frozen=True, slots=True, eq=False)
class SightLine:
    """A part of a line, from `start` (3,) to `end` (3,), with words at its middle."""

    start: Floats
    end: Floats
    kind: Kind
    text: str = ""


class SightMarks:
    """A `Mark` of lines, the dots between them and the outline (n, 2, 3) of what stands in the way."""

    def __init__(self) -> None:
        self._look = LIGHT
        self._data = vtkPolyData()
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(self._data)
        self._strokes = vtkActor()
        self._strokes.SetMapper(mapper)
        self._strokes.PickableOff()
        unlit(self._strokes)
        self._labels = Labels(4)
        self.lines: tuple[SightLine, ...] = ()
        self._dots: tuple[Floats, ...] = ()
        self._outline: Floats = np.zeros((0, 2, 3))
        self.show(())

    @property
    def props(self) -> Sequence[vtkProp]:
        return (self._strokes, *self._labels.props)

    def show(self, lines: Sequence[SightLine], dots: Sequence[Floats] = (), outline: Floats | None = None) -> None:
        """Nothing where neither lines nor dots are given."""
        self.lines, self._dots = tuple(lines), tuple(dots)
        self._outline = np.zeros((0, 2, 3)) if outline is None else outline
        self._strokes.SetVisibility(bool(lines or dots))
        self._labels.hide()

    def set_look(self, look: Look) -> None:
        self._look = look

    def before_render(self, camera: Camera, size: tuple[float, float], scale: float) -> None:
        if not (self.lines or self._dots):
            return
        pen = Pen(camera, size)
        ground = rgb(self._look.plain_background)
        for a, b in self._outline:
            pen.stroke(a, b, OUTLINE, rgb(self._look.selection), ground)
        labels: list[LabelText] = []
        for line in self.lines:
            ink = self._ink(line.kind)
            draw = pen.stroke if line.kind in ("clear", "wall") else pen.dashes
            pixels = draw(line.start, line.end, WIDTH, ink, ground)
            if pixels is None:
                continue
            if line.text:
                labels.append((pixels.mean(axis=0), line.text, ink))
        for point in self._dots:
            pen.dot(point, DOT, ink_of(self._look), ground)
        pen.fill(self._data)
        self._labels.show(labels, ground, size, scale)

    def _ink(self, kind: Kind) -> Colour:
        inks = INKS.get(kind)
        if inks is None:
            return ink_of(self._look) if kind == "wall" else mixed(ink_of(self._look), rgb(self._look.solid), 0.5)
        return rgb(inks[0] if self._look.background_top > "#8" else inks[1])
