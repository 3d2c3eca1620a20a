"""Dimension lines: from one point to another with arrows and a label, and the ways along the axes that add up to it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkProp

from ..camera import Camera
from ..look import LIGHT, Look, mixed, rgb
from ..shading import unlit
from .pen import SHORTEST, Labels, LabelText, Pen, ink_of

if TYPE_CHECKING:
    from ...model.measuring.elements import Line

Floats = NDArray[np.float64]

WIDTH, LEG, OUTLINE = 1.8, 1.6, 3.0  # logical pixels
LABELS = 24
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
        self._labels = Labels(LABELS)
        self.show(())

    @property
    def props(self) -> Sequence[vtkProp]:
        return (self._strokes, *self._labels.props)

    def show(self, dimensions: Sequence[Dimension]) -> None:
        """The last ones are drawn over the others."""
        self._dimensions = tuple(dimensions)
        self._strokes.SetVisibility(bool(dimensions))
        self._labels.hide()

    def set_look(self, look: Look) -> None:
        self._look = look

    def before_render(self, camera: Camera, size: tuple[float, float], scale: float) -> None:
        if not self._dimensions:
            return
        pen = Pen(camera, size)
        labels: list[LabelText] = []
        for dimension in self._dimensions:
            self._draw(pen, dimension, labels)
        pen.fill(self._data)
        self._labels.show(labels, rgb(self._look.plain_background), size, scale)

    def _draw(self, pen: Pen, dimension: Dimension, labels: list[LabelText]) -> None:
        look = self._look
        ground = rgb(look.plain_background)
        ink = ink_of(look)
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


def _signed(value: float) -> str:
    from ...model.measuring.elements import short

    return short(value).replace("-", "\u2212")
