"""What a dragged part meets, over the picture: the parts lit up, the places where they touch, the shortest ways."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkAppendPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkProp

from ..camera import Camera
from ..look import LIGHT, Colour, Look, rgb
from ..polydata import lines_of, surface_of
from ..shading import unlit
from .pen import Labels, LabelText, Pen, ink_of

if TYPE_CHECKING:
    from ...model.solid.display import DisplayMesh
    from ..viewer import Viewer

Floats = NDArray[np.float64]
Kind = Literal["overlaps", "touches", "close", "near"]

INKS: dict[Kind, tuple[str, str]] = {
    "overlaps": ("#c62f25", "#ff8479"), "touches": ("#14803c", "#5fd38d"), "close": ("#b06000", "#ffb454"),
}  # fmt: skip
"""On light ground and on dark; those that are only near are not lit up."""
FILL, THROUGH = 0.45, 0.6  # opacity of faces, and of edges, which are seen through solids
RIM, WIDTH, DOT = 1.8, 2.0, 4.4  # logical pixels

ABOVE = np.array([0.0, -14.0])
"""Pixels from the middle of a line to the words about it."""


@dataclass(frozen=True, slots=True, eq=False)
class MarkedContact:
    """A part by its mesh where it stands, the ends (2, 3) of the shortest way to it or None, and words about that."""

    mesh: DisplayMesh
    kind: Kind
    ends: Floats | None
    text: str = ""


class ContactMarks:
    """A `Mark` but for the faces that are lit up, which stand among the solids of a viewer's picture, so that what is
    before them hides them. Edges and contacts are seen through everything: most contacts lie hidden."""

    def __init__(self, viewer: Viewer) -> None:
        self._look = LIGHT
        self._lit: dict[Kind, tuple[vtkActor, vtkActor]] = {kind: (_actor(), _actor()) for kind in INKS}
        self._meshes: dict[Kind, tuple[DisplayMesh, ...]] = {}
        for fill, rim in self._lit.values():
            fill.GetProperty().SetOpacity(FILL)
            rim.GetProperty().SetOpacity(THROUGH)
            mapper = fill.GetMapper()
            mapper.SetResolveCoincidentTopologyToPolygonOffset()
            mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(0.0, -1.0)
            viewer.renderer.AddActor(fill)
        self._strokes = _actor()
        self._data = vtkPolyData()
        self._strokes.GetMapper().SetInputDataObject(self._data)
        self._labels = Labels(3)
        self._contacts: tuple[MarkedContact, ...] = ()

    @property
    def props(self) -> Sequence[vtkProp]:
        return (*(rim for _, rim in self._lit.values()), self._strokes, *self._labels.props)

    @property
    def lit(self) -> dict[Kind, int]:
        """How many parts are lit up, by kind."""
        return {kind: len(meshes) for kind, meshes in self._meshes.items() if meshes}

    def show(self, contacts: Sequence[MarkedContact] = ()) -> None:
        self._contacts = tuple(contacts)
        self._labels.hide()
        self._strokes.SetVisibility(any(contact.ends is not None for contact in contacts))
        for kind, actors in self._lit.items():
            meshes = tuple(contact.mesh for contact in contacts if contact.kind == kind)
            before = self._meshes.get(kind, ())
            if len(meshes) != len(before) or any(a is not b for a, b in zip(meshes, before, strict=True)):
                self._meshes[kind] = meshes
                _fill(actors[0], [surface_of(mesh) for mesh in meshes])
                _fill(actors[1], [lines_of(mesh.edge_points, mesh.edges) for mesh in meshes if len(mesh.edges)])

    def set_look(self, look: Look) -> None:
        self._look = look
        for kind, actors in self._lit.items():
            for actor in actors:
                actor.GetProperty().SetColor(*self._ink(kind))

    def before_render(self, camera: Camera, size: tuple[float, float], scale: float) -> None:
        for _, rim in self._lit.values():
            rim.GetProperty().SetLineWidth(RIM * scale)
        if not self._contacts:
            return
        pen, ground = Pen(camera, size), rgb(self._look.plain_background)
        labels: list[LabelText] = []
        for contact in self._contacts:
            if contact.ends is None:
                continue
            ink = self._ink(contact.kind)
            if contact.text:
                pixels = pen.stroke(contact.ends[0], contact.ends[1], WIDTH, ink, ground)
                if pixels is not None:
                    labels.append((pixels.mean(axis=0) + ABOVE, contact.text, ink))
            for end in contact.ends if contact.text else contact.ends[:1]:
                pen.dot(end, DOT, ink, ground)
        pen.fill(self._data)
        self._labels.show(labels, ground, size, scale)

    def _ink(self, kind: Kind) -> Colour:
        inks = INKS.get(kind)
        if inks is None:
            return ink_of(self._look)
        return rgb(inks[0] if self._look.background_top > "#8" else inks[1])


def _actor() -> vtkActor:
    actor, mapper = vtkActor(), vtkPolyDataMapper()
    mapper.SetInputData(vtkPolyData())
    actor.SetMapper(mapper)
    actor.PickableOff()
    actor.VisibilityOff()
    unlit(actor)
    return actor


def _fill(actor: vtkActor, parts: Sequence[vtkPolyData]) -> None:
    """Show these together, or nothing."""
    actor.SetVisibility(bool(parts))
    if parts:
        together = vtkAppendPolyData()
        for part in parts:
            together.AddInputData(part)
        together.Update()
        actor.GetMapper().SetInputDataObject(together.GetOutput())
