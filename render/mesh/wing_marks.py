"""An edge with its wings, as Baumgart (1975) draws it: arrows for its direction and for the loops that run past it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkProp

from ...model.mesh.inspected import InspectedMesh
from ...model.mesh.winged import (
    COLUMNS,
    END,
    LEFT,
    LEFT_AFTER,
    LEFT_BEFORE,
    RIGHT,
    RIGHT_AFTER,
    RIGHT_BEFORE,
    START,
)
from ..camera import Camera
from ..handles.pen import Labels, LabelText, Pen, ink_of
from ..look import LIGHT, Colour, Look, rgb
from ..shading import unlit

Floats = NDArray[np.float64]

WIDTH, WING, DOT = 4.0, 2.6, 4.2  # logical pixels: the edge, its wings, its ends
INWARD = 0.05  # of its length: how far a wing's arrow is drawn from the edge, inside its face
LABELS = 9
LEFT_INK, RIGHT_INK, EDGE_INK = ("#0b756b", "#4cc9b8"), ("#96369f", "#d891e6"), ("#b34700", "#ffb454")
"""Of what belongs to the left face, to the right one, and of the edge; on light ground and on dark."""


@dataclass(frozen=True, slots=True, eq=False)
class Wing:
    """A line from `start` (3,) to `end` (3,) in the direction of the loop, and what is written at it."""

    start: Floats
    end: Floats
    text: str
    ink: tuple[str, str]


def wings_of(mesh: InspectedMesh, edge: int, first: int = 0) -> list[Wing]:
    """The wings of an edge as they are drawn; `first` is what numbers count from. One edge may be two wings, as at the
    tip of a face with two edges."""
    table, points = mesh.winged.table, mesh.lists.vertices
    row = table[edge]
    found = []
    for column, ink in (
        (LEFT_BEFORE, LEFT_INK), (LEFT_AFTER, LEFT_INK), (RIGHT_BEFORE, RIGHT_INK), (RIGHT_AFTER, RIGHT_INK),
    ):  # fmt: skip
        wing = int(row[column])
        if wing < 0:
            continue
        # The left loop runs from the edge's start to its end, the right one back.
        tail, head = (START, END) if column in (LEFT_BEFORE, LEFT_AFTER) else (END, START)
        joint = int(row[tail] if column in (LEFT_BEFORE, RIGHT_BEFORE) else row[head])
        far = int(table[wing, END] if table[wing, START] == joint else table[wing, START])
        ends = (far, joint) if column in (LEFT_BEFORE, RIGHT_BEFORE) else (joint, far)
        face = int(row[LEFT if ink is LEFT_INK else RIGHT])
        shift = _inward(mesh, face, points[ends[0]], points[ends[1]])
        found.append(Wing(points[ends[0]] + shift, points[ends[1]] + shift, f"{COLUMNS[column]} {wing + first}", ink))
    return found


def _inward(mesh: InspectedMesh, face: int, start: Floats, end: Floats) -> Floats:
    """A little way from a side of a face into it."""
    if face < 0:
        return np.zeros(3)
    return INWARD * np.cross(mesh.lists.normals[mesh.lists.face_normal[face]], end - start)


class WingMarks:
    """A `Mark` of one edge: itself, its ends, its wings, with their names and numbers."""

    def __init__(self) -> None:
        self._look = LIGHT
        self._data = vtkPolyData()
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(self._data)
        self._strokes = vtkActor()
        self._strokes.SetMapper(mapper)
        self._strokes.PickableOff()
        unlit(self._strokes)
        self._labels = Labels(LABELS)
        self._ends: Floats | None = None
        self._words: tuple[str, str, str] = ("", "", "")
        self.wings: list[Wing] = []
        self.show(None, -1)

    @property
    def props(self) -> Sequence[vtkProp]:
        return (self._strokes, *self._labels.props)

    def show(self, mesh: InspectedMesh | None, edge: int, first: int = 0) -> None:
        """Show an edge of a mesh; none for -1."""
        there = mesh is not None and edge >= 0
        self._strokes.SetVisibility(there)
        self._labels.hide()
        self.wings, self._ends = [], None
        if mesh is None or not there:
            return
        start, end = mesh.winged.table[edge, [START, END]].tolist()
        self._ends = mesh.lists.vertices[[start, end]]
        self._words = f"edge {edge + first}", f"start {start + first}", f"end {end + first}"
        self.wings = wings_of(mesh, edge, first)

    def set_look(self, look: Look) -> None:
        self._look = look

    def before_render(self, camera: Camera, size: tuple[float, float], scale: float) -> None:
        if self._ends is None:
            return
        pen, ground = Pen(camera, size), rgb(self._look.plain_background)
        dark = self._look.background_top < "#8"
        labels: list[LabelText] = []
        for wing in self.wings:
            self._arrow(pen, wing.start, wing.end, WING, rgb(wing.ink[dark]), wing.text, labels)
        self._arrow(pen, self._ends[0], self._ends[1], WIDTH, rgb(EDGE_INK[dark]), self._words[0], labels)
        for end, text in zip(self._ends, self._words[1:], strict=True):
            pixel = pen.dot(end, DOT, ink_of(self._look), ground)
            if pixel is not None:
                labels.append((pixel + np.array([0.0, 15.0]), text, ink_of(self._look)))
        pen.fill(self._data)
        self._labels.show(labels, ground, size, scale)

    def _arrow(
        self, pen: Pen, start: Floats, end: Floats, width: float, ink: Colour, text: str, labels: list[LabelText]
    ) -> None:
        ends = pen.stroke(start, end, width, ink, rgb(self._look.plain_background))
        if ends is None:
            return
        pen.head(ends, 0.62, ink)
        labels.append((ends.mean(axis=0), text, ink))
