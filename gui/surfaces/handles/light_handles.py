"""Handles of lights in the picture: a point light's place, a directional light's arrow about the model's middle."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....model.surface.light import Light
from ....render.camera import Camera, frame
from ....render.handles.drag import along_axis, on_plane, pixel_length, view_direction
from ....render.handles.gizmo import move_handles, plane_axes
from ....render.handles.handle import Handle, Piece
from ....render.handles.handle_marks import HandleMarks
from ....render.handles.shapes import circle, cone, disc, joined, tube

Floats = NDArray[np.float64]
Ray = tuple[Floats, Floats]
Size = tuple[float, float]

TURN = "light turn"
OTHER = "light of "
REACH, NEAR = 120.0, 46.0  # logical pixels from the middle to the arrow's knob, and to its tip
RAYS = 8


class FollowingMarks(HandleMarks):
    """Marks that are made anew for each picture by `made`, unless that is None."""

    def __init__(self, made: Callable[[], tuple[Handle, ...] | None]) -> None:
        super().__init__()
        self._made = made

    def before_render(self, camera: Camera, size: tuple[float, float], scale: float) -> None:
        handles = self._made()
        if handles is not None:
            self.show(handles)
        super().before_render(camera, size, scale)


def place_of(light: Light, camera: Camera) -> Floats:
    """(3,) where a point light stands in the world."""
    place = np.array(light.position)
    return np.array(camera.position) + place @ frame(camera) if light.with_camera else place


def towards(light: Light, camera: Camera) -> Floats:
    """(3,) the unit vector in the world to where a directional light comes from."""
    direction = -np.array(light.direction)
    return direction @ frame(camera) if light.with_camera else direction


def carried(light: Light, camera: Camera, with_camera: bool) -> dict[str, Any]:
    """The fields of a light that shines as it does now, going with the camera or not."""
    values: dict[str, Any] = {"with_camera": with_camera}
    if light.kind == "directional":
        way = -towards(light, camera)
        values["direction"] = rounded(frame(camera) @ way if with_camera else way, 4)
    elif light.kind == "point":
        place = place_of(light, camera)
        values["position"] = rounded(frame(camera) @ (place - camera.position) if with_camera else place, 3)
    return values


def rounded(values: Any, digits: int) -> tuple[float, ...]:
    """Without the digits that say nothing and would stand in the script."""
    return tuple(round(float(value), digits) + 0.0 for value in values)


def light_handles(light: Light, others: tuple[Light, ...], camera: Camera, middle: Floats) -> tuple[Handle, ...]:
    """Those of the chosen light, and the markers of the other point lights, a click on which chooses them."""
    found = [
        Handle(OTHER + other.name, "size", place_of(other, camera), np.eye(3), _sun(), np.zeros((1, 3)), order=3)
        for other in others
        if other.kind == "point" and other.active
    ]
    if light.kind == "point":
        middle_knob, *arrows = move_handles(place_of(light, camera), np.eye(3))
        found += [replace(middle_knob, pieces=_sun()), *arrows]
    elif light.kind == "directional":
        path = np.array([(0.0, 0.0, NEAR), (0.0, 0.0, REACH)])
        found.append(Handle(TURN, "plane", middle, plane_axes(towards(light, camera)), _arrow(), path, order=0))
    return tuple(found)


def moved_place(handle: Handle, camera: Camera, ray: Ray, place: Floats) -> Floats | None:
    """(3,) where the pointer's ray meets what a handle of `move_handles` moves along; None where it does not."""
    axes = [axis for axis in range(3) if "xyz"[axis] in handle.name.removeprefix("move")]
    if len(axes) == 1:
        along = handle.axes[axes[0]]
        reached = along_axis(*ray, place, along)
        return None if reached is None else place + reached * along
    normal = view_direction(camera, place) if not axes else handle.axes[3 - sum(axes)]
    return on_plane(*ray, place, normal)


def on_sphere(middle: Floats, camera: Camera, size: Size, ray: Ray, far: bool) -> Floats:
    """(3,) the unit vector from the middle to where the pointer's ray meets the sphere that the arrow's knob runs on,
    its `far` side or its near one; at its rim where the ray misses it."""
    radius = REACH * pixel_length(camera, middle, size)
    start, along = ray
    foot = start + along * float(along @ (middle - start))
    off = foot - middle
    beside = float(np.linalg.norm(off))
    if beside >= radius:
        return off / beside
    depth = np.sqrt(radius * radius - beside * beside)
    point = off + (depth if far else -depth) * along
    return point / np.linalg.norm(point)


@cache
def _arrow() -> tuple[Piece, ...]:
    """From a knob at REACH towards the middle, along the z axis."""
    shape = joined(
        tube(np.array([(0.0, 0.0, REACH), (0.0, 0.0, NEAR + 18.0)]), 1.6),
        cone((0.0, 0.0, NEAR + 20.0), (0.0, 0.0, NEAR), 6.5),
    )
    return Piece(shape), *_sun((0.0, 0.0, REACH))


@cache
def _sun(at: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> tuple[Piece, ...]:
    """A disc with rays in the plane of the picture."""
    angles = np.arange(RAYS) * 2 * np.pi / RAYS
    spokes = [tube(np.outer((9.5, 13.0), (np.cos(angle), np.sin(angle), 0.0)), 1.0) for angle in angles.tolist()]
    rim = tube(circle(2, 6.5), 0.9, closed=True)
    return Piece(disc(6.5), "rim", flat=True, at=at), Piece(disc(5.0, 1.0), flat=True, at=at), \
        Piece(joined(rim, *spokes), flat=True, at=at)  # fmt: skip
