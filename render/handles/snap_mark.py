"""The mark that says where the pointer has snapped to, and to what kind of thing."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkProp

from ..camera import Camera, frame, project
from ..look import Look, rgb
from ..polydata import cells_of, points_of, set_cell_colours
from ..shading import unlit
from .snap import Snap, millimetres_per_pixel

if TYPE_CHECKING:
    Floats = NDArray[np.float64]
    Line = tuple[Floats, bool]  # (n, 2) pixels from the point, and whether it is closed

CORE, RIM = "#ffd93b", "#1b1f26"  # bright within dark: seen on every ground
THICK, HALO = 2.2, 1.5  # logical pixels: of the line, and of what surrounds it on both sides
HALF = 6.5  # of the signs
PATCH, ARROW = 13.0, 30.0  # half the side of a face's patch, and the length of its normal
HEAD = 8.0

_round = np.linspace(0.0, 2.0 * np.pi, 32, endpoint=False)
_turn = HALF * np.array([[-1.0, -1.0], [1.0, 1.0]]), HALF * np.array([[-1.0, 1.0], [1.0, -1.0]])
SIGNS: dict[str, tuple[tuple[NDArray[np.float64], bool], ...]] = {
    "vertex": ((HALF * np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]), True),),
    "midpoint": ((1.25 * HALF * np.array([[-1.0, 0.75], [0.0, -1.0], [1.0, 0.75]]), True),),
    "centre": ((1.1 * HALF * np.column_stack([np.cos(_round), np.sin(_round)]), True),),
    "edge": ((_turn[0], False), (_turn[1], False)),
    "grid": ((HALF * np.array([[-1.0, 0.0], [1.0, 0.0]]), False), (HALF * np.array([[0.0, -1.0], [0.0, 1.0]]), False)),
}


class SnapMark:
    """A square for a corner, a triangle for a middle, a circle for a centre, a cross for an edge, an upright cross for
    the grid; for a face a patch of its plane and its normal. As large on the screen at every distance."""

    def __init__(self) -> None:
        self._data = vtkPolyData()
        self._actor = vtkActor()
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(self._data)
        self._actor.SetMapper(mapper)
        self._actor.PickableOff()
        self._actor.VisibilityOff()
        unlit(self._actor)
        self.snap: Snap | None = None

    @property
    def props(self) -> Sequence[vtkProp]:
        return (self._actor,)

    def set_look(self, look: Look) -> None:
        """Its colours suit every theme."""

    def show(self, snap: Snap | None) -> bool:
        """Mark this one, or nothing; whether that changes the picture."""
        changed = snap != self.snap
        self.snap = snap
        self._actor.SetVisibility(snap is not None)
        return changed

    def before_render(self, camera: Camera, size: tuple[float, float], scale: float) -> None:
        snap = self.snap
        if snap is None:
            return
        pixel = project(camera, [snap.point], size)[0]
        self._actor.SetVisibility(bool(np.isfinite(pixel).all()))
        if not np.isfinite(pixel).all():
            return
        step = millimetres_per_pixel(camera, float(pixel[2]), size)
        lines = SIGNS.get(snap.kind) or _plane(camera, size, snap, pixel[:2], step)
        points, quads, bright = _strips(lines)
        right, up, backward = frame(camera)
        around = points[:, :1] * right - points[:, 1:2] * up + points[:, 2:] * backward
        self._data.SetPoints(points_of(np.asarray(snap.point) + step * around))
        self._data.SetPolys(cells_of(quads))
        colours = np.where(bright[:, None], rgb(CORE), rgb(RIM))
        set_cell_colours(self._data, np.round(255.0 * colours).astype(np.uint8))


def _plane(camera: Camera, size: tuple[float, float], snap: Snap, at: Floats, step: float) -> tuple[Line, ...]:
    """A patch of the face's plane and an arrow along its normal, in pixels from the point."""
    normal = np.asarray(snap.direction if snap.direction is not None else frame(camera)[2])
    u = np.cross(normal, np.eye(3)[int(np.argmin(np.abs(normal)))])
    u /= np.linalg.norm(u)
    v = np.cross(normal, u)
    corners = PATCH * np.array([u + v, v - u, -u - v, u - v])
    tip = ARROW * normal
    shown = project(camera, np.asarray(snap.point) + step * np.array([*corners, tip]), size)[:, :2] - at
    if not np.isfinite(shown).all():
        return SIGNS["edge"]
    length = float(np.linalg.norm(shown[4]))
    lines: list[Line] = [(shown[:4], True), (np.array([[0.0, 0.0], shown[4]]), False)]
    if length > HEAD:
        along = shown[4] / length
        across = np.array([-along[1], along[0]])
        back = shown[4] - HEAD * along
        lines.append((np.array([back + 0.5 * HEAD * across, shown[4], back - 0.5 * HEAD * across]), False))
    return tuple(lines)


def _strips(lines: Sequence[Line]) -> tuple[Floats, NDArray[np.int32], NDArray[np.bool_]]:
    """Lines as bands: points (p, 3), the third coordinate towards the eye, quads (q, 4), and which are bright (q,)."""
    points: list[Floats] = []
    quads: list[NDArray[np.int32]] = []
    bright: list[NDArray[np.bool_]] = []
    count = 0
    for half, near, light in ((THICK / 2.0 + HALO, 0.0, False), (THICK / 2.0, 0.5, True)):
        for line, closed in lines:
            band = _band(line, closed, half)
            n = len(line)
            points.append(np.column_stack([band.reshape(-1, 2), np.full(2 * n, near)]))
            i = np.arange(n if closed else n - 1)
            j = (i + 1) % n
            quads.append((count + np.column_stack([2 * i, 2 * i + 1, 2 * j + 1, 2 * j])).astype(np.int32))
            bright.append(np.full(len(i), light))
            count += 2 * n
    return np.concatenate(points), np.concatenate(quads), np.concatenate(bright)


def _band(line: Floats, closed: bool, half: float) -> Floats:
    """(n, 2, 2) the two sides of a line (n, 2) that is 2 `half` wide, its corners mitred, its ends longer by `half`."""
    if not closed:
        first, last = _unit(line[0] - line[1]), _unit(line[-1] - line[-2])
        line = np.concatenate([[line[0] + half * first], line[1:-1], [line[-1] + half * last]])
    ahead = np.roll(line, -1, axis=0) - line
    if not closed:
        ahead[-1] = ahead[-2]
    ahead /= np.maximum(np.linalg.norm(ahead, axis=1, keepdims=True), 1e-9)
    before = np.roll(ahead, 1, axis=0)
    if not closed:
        before[0] = ahead[0]
    left, left_before = ahead @ [[0.0, 1.0], [-1.0, 0.0]], before @ [[0.0, 1.0], [-1.0, 0.0]]
    middle = left + left_before
    square = np.einsum("ij,ij->i", middle, middle)
    mitre = middle * (2.0 / np.maximum(square, 0.4))[:, None]
    return np.stack([line + half * mitre, line - half * mitre], axis=1)


def _unit(vector: Floats) -> Floats:
    return vector / max(float(np.linalg.norm(vector)), 1e-9)
