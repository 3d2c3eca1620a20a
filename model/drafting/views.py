"""One view on a page: a drawing's areas and lines at a scale, as groups of its layers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ..document.colours import rgb
from ..drawing.drawing import Drawing
from ..drawing.lines import polylines
from .dashes import dashed
from .page import HIDDEN, VISIBLE, Fill, Group, Item, Strokes, Text

Floats = NDArray[np.float64]

GROUND = "#c8d2dd"
"""Of faces whose solid has no colour, as in the outlines of sections."""
CORNER = float(np.cos(np.radians(40.0)))
"""Of the angle by which a line turns at a corner, at least."""
DARKEST = 0.45
"""How much of its colour a face keeps that the light only grazes."""


@dataclass(frozen=True, slots=True, eq=False)
class View:
    """A drawing with its name; lines and areas that the plan leaves out are not in it."""

    name: str
    drawing: Drawing

    @property
    def size(self) -> tuple[float, float]:
        """Width and height in mm of the model."""
        low, high = self.drawing.bounds
        return float(high[0] - low[0]), float(high[1] - low[1])

    def group(self, scale: float, at: tuple[float, float], extra: Sequence[Item] = ()) -> Group:
        """The view on the page, its drawing's origin at a point; `extra` in mm of paper from there, painted last.

        All faces are painted before all lines, or the next face would cover half the width of a line at its edge.
        """
        shift = np.asarray(at, float)
        groups = tuple(
            Group(role.capitalize(), role, (), tuple(layers))
            for role, layers in (
                ("faces", self._faces(scale, shift)),
                ("hidden edges", self._edges(True, scale, shift)),
                ("edges", self._edges(False, scale, shift)),
            )
            if layers
        )
        if extra:
            groups = (*groups, Group("Dimensions", "dimensions", tuple(moved(item, shift) for item in extra)))
        return Group(self.name, "view", (), groups)

    def _faces(self, scale: float, shift: Floats) -> list[Group]:
        of_layer: dict[int, list[Fill]] = {}
        for area in self.drawing.areas:
            colour = shaded(self.drawing.layers[area.layer].colour, area.shade)
            contours = tuple(contour * scale + shift for contour in area.contours)
            of_layer.setdefault(area.layer, []).append(Fill("face", colour, contours))
        return [self._layer("faces", number, of_layer[number]) for number in sorted(of_layer)]

    def _edges(self, hidden: bool, scale: float, shift: Floats) -> list[Group]:
        chosen = self.drawing.lines.chosen(self.drawing.lines.hidden == hidden)
        alike = replace(chosen, kind=np.zeros_like(chosen.kind))
        role, what, pen = ("hidden edges", "hidden", HIDDEN) if hidden else ("edges", "visible", VISIBLE)
        of_layer: dict[int, list[Floats]] = {}
        for line in polylines(alike):
            pieces = cornered(line.points) if hidden else [line.points]
            of_layer.setdefault(line.layer, []).extend(piece * scale + shift for piece in pieces)
        return [
            self._layer(role, number, dashed(what, pen, lines) if hidden else [Strokes(what, pen, tuple(lines))])
            for number, lines in sorted(of_layer.items(), key=lambda item: item[0])
        ]

    def _layer(self, role: str, number: int, items: Sequence[Item]) -> Group:
        layer = self.drawing.layers[number]
        return Group(layer.name, role, tuple(items), (), layer.path)


def cornered(points: Floats) -> list[Floats]:
    """A polyline (k, 2) cut at its corners, so that dashes begin anew there and meet in them."""
    along = np.diff(points, axis=0)
    along = along / np.maximum(np.linalg.norm(along, axis=1), 1e-300)[:, None]
    bends = np.flatnonzero(np.einsum("ij,ij->i", along[:-1], along[1:]) < CORNER) + 1
    if not len(bends):
        return [points]
    if (points[0] == points[-1]).all() and along[-1] @ along[0] >= CORNER:  # begin a closed one at a corner
        points = np.concatenate([points[bends[0] :], points[1 : bends[0] + 1]])
        bends = bends[1:] - bends[0]
    ends = [0, *bends.tolist(), len(points) - 1]
    return [points[begin : end + 1] for begin, end in pairwise(ends)]


def shaded(colour: tuple[int, int, int] | None, shade: float) -> str:
    """A colour as it looks on a face that is so bright, 0 to 1; #rrggbb."""
    light = DARKEST + (1.0 - DARKEST) * min(max(shade, 0.0), 1.0)
    return "#" + "".join(f"{round(value * light):02x}" for value in (rgb(GROUND) if colour is None else colour))


def moved(item: Item, shift: Floats) -> Item:
    """The item at another place."""
    if isinstance(item, Text):
        return replace(item, at=(item.at[0] + float(shift[0]), item.at[1] + float(shift[1])))
    if isinstance(item, Strokes):
        return replace(item, lines=tuple(line + shift for line in item.lines))
    return replace(item, contours=tuple(contour + shift for contour in item.contours))
