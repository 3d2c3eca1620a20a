"""One handle as a value: what it looks like, where it stands, and where it can be caught."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ..camera import Camera, frame, project
from .drag import distance_to_path, inside, pixel_length, view_direction
from .shapes import Shape

Floats = NDArray[np.float64]
Role = Literal["x", "y", "z", "free", "size", "locked", "plane"]
Tone = Literal["main", "rim", "core"]

REACH = 7.0  # logical pixels between the pointer and a line that it catches
END_ON = 0.985  # cosine between an axis and the view above which its handles are not shown
EDGE_ON = 0.15  # the same between the view and a plane's normal, below which


@dataclass(frozen=True, slots=True, eq=False)
class Piece:
    """A part of a handle's picture, in the units of the handle.

    A `flat` one lies in the plane of the picture (x right, y up, z towards the eye), about the place `at` (3,) in the
    handle's own axes.
    """

    shape: Shape
    tone: Tone = "main"
    opacity: float = 1.0
    flat: bool = False
    at: tuple[float, float, float] = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True, eq=False)
class Handle:
    """`origin` (3,) and the unit `axes` (rows, (3, 3)) place it in the world; its unit is `unit` millimetres, or one
    logical pixel at the origin's depth where that is None.

    It is caught by its `path` (n, 3), a polyline or a point, in its units; an `area` also inside of it. Smaller `order`
    is caught first.
    """

    name: str
    role: Role
    origin: Floats
    axes: Floats
    pieces: tuple[Piece, ...]
    path: Floats
    area: bool = False
    order: int = 1
    unit: float | None = None
    axis: Floats | None = None
    """(3,) in the world: not shown where that is seen from its end."""
    normal: Floats | None = None
    """(3,) in the world: not shown where that plane is seen from its edge."""
    front: bool = False
    """Whether only the half towards the eye is shown."""

    def length(self, camera: Camera, size: tuple[float, float]) -> float:
        """Millimetres of one unit."""
        return self.unit if self.unit is not None else pixel_length(camera, self.origin, size)

    def seen(self, camera: Camera) -> bool:
        """Whether the view shows it, and it can be dragged there."""
        towards = view_direction(camera, self.origin)
        if not camera.parallel and float(np.subtract(camera.position, self.origin) @ frame(camera)[2]) <= 0.0:
            return False  # behind the eye
        if self.axis is not None and abs(float(self.axis @ towards)) > END_ON:
            return False
        return self.normal is None or abs(float(self.normal @ towards)) > EDGE_ON

    def world(self, points: Floats, length: float) -> Floats:
        """World points (n, 3) of points in the handle's units."""
        return self.origin + length * points @ self.axes

    def before(self, points: Floats, camera: Camera) -> NDArray[np.bool_]:
        """Which world points (n, 3) lie on the half towards the eye."""
        towards = view_direction(camera, self.origin)
        return (points - self.origin) @ towards >= -1e-6 * np.linalg.norm(points - self.origin, axis=1).max()

    def distance(self, camera: Camera, size: tuple[float, float], x: float, y: float) -> float:
        """Pixels from (x, y), 0 inside an area; infinite where it is not seen."""
        if not self.seen(camera):
            return math.inf
        path = self.world(self.path, self.length(camera, size))
        pixels = project(camera, path, size)[:, :2]
        if self.front:
            pixels = np.where(self.before(path, camera)[:, None], pixels, np.nan)
        if self.area and inside(pixels, x, y):
            return 0.0
        return distance_to_path(np.vstack((pixels, pixels[:1])) if self.area else pixels, x, y)


def caught(handles: tuple[Handle, ...], camera: Camera, size: tuple[float, float], x: float, y: float) -> Handle | None:
    """The handle under pixel (x, y): of those within reach the first in order, then the nearest."""
    near = [(handle.order, handle.distance(camera, size, x, y), i) for i, handle in enumerate(handles)]
    near = [entry for entry in near if entry[1] <= REACH]
    return handles[min(near)[2]] if near else None
