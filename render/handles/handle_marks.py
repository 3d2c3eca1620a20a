"""Handles in the picture: as large at every distance, the one under the pointer bright, the others faint in a drag."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkRenderingCore import vtkActor, vtkProp

from ..camera import Camera, frame
from ..curves.ink import ink_actor
from ..look import LIGHT, Colour, Look, mixed, rgb
from ..polydata import cells_of, points_of, set_cell_colours
from .handle import Handle, Role, Tone, caught

WHITE, BLACK = (1.0, 1.0, 1.0), (0.0, 0.0, 0.0)
FAINT = 0.18  # opacity of the handles that are not dragged while another one is


class HandleMarks:
    """A `Mark` of all handles. `hover` and `active` are names of handles; both are drawn bright."""

    def __init__(self) -> None:
        self.handles: tuple[Handle, ...] = ()
        self.hover: str | None = None
        self.active: str | None = None
        self._look = LIGHT
        self._solid, self._veil = ink_actor(), ink_actor()

    @property
    def props(self) -> Sequence[vtkProp]:
        return (self._solid, self._veil)

    def show(self, handles: tuple[Handle, ...]) -> None:
        self.handles = handles

    def caught(self, camera: Camera, size: tuple[float, float], x: float, y: float) -> Handle | None:
        """The handle under pixel (x, y)."""
        return caught(self.handles, camera, size, x, y)

    def set_look(self, look: Look) -> None:
        self._look = look

    def before_render(self, camera: Camera, size: tuple[float, float], scale: float) -> None:
        screen = frame(camera)
        parts: tuple[list, list] = ([], [])  # solid, translucent: (points, triangles, colour)
        for handle in self.handles:
            if not handle.seen(camera):
                continue
            length = handle.length(camera, size)
            for piece in handle.pieces:
                points, triangles = piece.shape
                if piece.flat:
                    world = handle.world(np.array([piece.at]), length) + length * points @ screen
                else:
                    world = handle.world(points, length)
                    if handle.front:
                        triangles = triangles[handle.before(world, camera)[triangles[:, 0]]]
                colour, opacity = self._paint(handle, piece.tone)
                opacity *= piece.opacity
                parts[opacity < 1.0].append((world, triangles, (*colour, opacity)))
        for actor, found in zip((self._solid, self._veil), parts, strict=True):
            _fill(actor, found)

    def _paint(self, handle: Handle, tone: Tone) -> tuple[Colour, float]:
        bright = handle.name in (self.hover, self.active) and handle.role != "locked"
        opacity = FAINT if self.active is not None and handle.name != self.active else 1.0
        if handle.role == "plane" and handle.name.endswith(" square"):
            opacity = 1.0
        if tone == "rim":
            return rgb(self._look.edge if self._look is LIGHT else "#0c0e11"), opacity
        colour = colour_of(handle.role, self._look)
        return (mixed(rgb(self._look.selection), (1.0, 0.85, 0.2), 0.6) if bright else colour), opacity


def colour_of(role: Role, look: Look) -> Colour:
    """The colour of a role at rest: axes as the ground's, a little stronger."""
    match role:
        case "x" | "y" | "z":
            colour = rgb({"x": look.axis_x, "y": look.axis_y, "z": look.axis_z}[role])
            mean = sum(colour) / 3.0
            red, green, blue = (min(max(mean + 1.6 * (c - mean), 0.0), 1.0) for c in colour)
            return mixed((red, green, blue), WHITE, 0.15) if look.name == "dark" else (red, green, blue)
        case "plane":
            return mixed(rgb(look.hover), BLACK if look.name == "light" else WHITE, 0.25)
        case "locked":
            return mixed(rgb(look.grid_major), WHITE, 0.1)
    return mixed(WHITE, BLACK, 0.02 if look.name == "light" else 0.1)


def _fill(actor: vtkActor, parts: list[tuple[NDArray[np.float64], NDArray[np.int32], tuple[float, ...]]]) -> None:
    actor.SetVisibility(bool(parts))
    if not parts:
        return
    data = actor.GetMapper().GetInput()
    place = parts[0][0][0]  # single precision is enough about a place near by
    starts = np.cumsum([0, *(len(points) for points, _, _ in parts)])
    actor.SetPosition(*place)
    data.SetPoints(points_of(np.concatenate([points for points, _, _ in parts]) - place))
    triangles = [triangles + start for (_, triangles, _), start in zip(parts, starts[:-1], strict=True)]
    data.SetPolys(cells_of(np.concatenate(triangles).astype(np.int32)))
    counts = [len(triangles) for _, triangles, _ in parts]
    colours = np.repeat(np.array([colour for _, _, colour in parts]), counts, axis=0)
    set_cell_colours(data, np.round(255.0 * colours).astype(np.uint8))
