"""What a press in the picture takes hold of: from what was hit to the drag of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ....render.curves.curve_marks import TURNED
from .box_drags import ScaleDrag, TurnDrag
from .edit_drags import BendDrag, Drag, HandleDrag, MoveDrag, PullDrag, Wish

if TYPE_CHECKING:
    from ..active import Place
    from .edit_picture import EditPicture, Hit


def grip(
    picture: EditPicture, chosen: frozenset[Place], hit: Hit, pressed: tuple[float, float]
) -> tuple[Drag, tuple[float, float]] | None:
    """The drag of what was hit at a pixel, and by how much, in pixels, the pointer is beside what it holds.

    None where the plane that it would be dragged in is seen from its edge.
    """
    edited = picture.edited
    if edited is None:
        return None
    if hit.kind == "knob":
        return _knob(picture, chosen, hit, pressed)
    if hit.kind == "node":
        place = edited.places[hit.index]
    elif hit.kind == "handle":
        place = edited.handles[hit.index]
    else:
        place = picture.place_on(hit)
    plane = picture.plane_at(place)
    if picture.reached(pressed, plane, Wish(free=True), False) is None:
        return None
    drag: Drag
    if hit.kind == "node":
        drag = MoveDrag(edited, plane, chosen)
    elif hit.kind == "handle":
        handle = (int(edited.handle_rows[hit.index, 0]), int(edited.handle_rows[hit.index, 1]))
        node = int(edited.arms[np.argmax(edited.arms[:, 0] == hit.index), 1])
        drag = HandleDrag(edited, plane, handle, node)
    else:
        drag = (PullDrag if edited.by_points else BendDrag)(edited, plane, hit.index, hit.parameter)
    seen = picture.pixel_of(place)
    return drag, (pressed[0] - float(seen[0]), pressed[1] - float(seen[1]))


def _knob(
    picture: EditPicture, chosen: frozenset[Place], hit: Hit, pressed: tuple[float, float]
) -> tuple[Drag, tuple[float, float]] | None:
    assert picture.edited is not None
    step, corner = picture.knob_corner(hit.index)
    plane = picture.plane_at(corner)
    here = picture.reached(pressed, plane, Wish(free=True), False)
    if here is None:
        return None
    if hit.index == TURNED:
        turning = TurnDrag(picture.edited, plane, chosen)
        turning.begin(here.point)
        return turning, (0.0, 0.0)
    seen = picture.pixel_of(corner)
    offset = (pressed[0] - float(seen[0]), pressed[1] - float(seen[1]))
    return ScaleDrag(picture.edited, plane, chosen, step), offset
