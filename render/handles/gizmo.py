"""The handles that move, turn, scale and size: what each looks like and where it is caught."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .handle import Handle, Piece, Role
from .shapes import circle, cone, cube, disc, joined, quad, square, tube

Floats = NDArray[np.float64]

AXES: tuple[Role, Role, Role] = ("x", "y", "z")
REACH = 90.0  # logical pixels from the middle to the tips
HEAD, FOOT = 20.0, 16.0
RING = 80.0
CORNER = (24.0, 42.0)  # where the squares of the planes begin and end
LINE = 1.3  # half the width of lines
KNOB, RIM = 5.0, 1.7
LEADER = 13.0  # from a surface to the knob that sizes it


def move_handles(origin: ArrayLike, axes: ArrayLike) -> tuple[Handle, ...]:
    """Arrows "move x" .., squares "move xy" .., and "move" in the plane of the picture. `axes` are unit rows (3, 3)."""
    middle, rows = np.asarray(origin, float), np.asarray(axes, float)
    handles = [_knob("move", "free", middle, rows, np.zeros(3), order=2)]
    for i in range(3):
        pieces, path = _arrow(i, FOOT)
        handles.append(Handle(f"move {AXES[i]}", AXES[i], middle, rows, pieces, path, axis=rows[i]))
    for i in range(3):
        pieces, corners = _corner(i)
        name = "move " + "".join(sorted(AXES[(i + 1) % 3] + AXES[(i + 2) % 3]))
        handles.append(Handle(name, AXES[i], middle, rows, pieces, corners, area=True, normal=rows[i]))
    return tuple(handles)


def turn_handles(origin: ArrayLike, axes: ArrayLike) -> tuple[Handle, ...]:
    """Rings "turn x" .."""
    middle, rows = np.asarray(origin, float), np.asarray(axes, float)
    handles = []
    for i in range(3):
        pieces, path = _ring(i)
        handles.append(Handle(f"turn {AXES[i]}", AXES[i], middle, rows, pieces, path, front=True))
    return tuple(handles)


def scale_handles(origin: ArrayLike, axes: ArrayLike) -> tuple[Handle, ...]:
    """Boxes "scale x" .., and "scale" in the middle for all three."""
    middle, rows = np.asarray(origin, float), np.asarray(axes, float)
    pieces = (Piece(cube(np.zeros(3), 7.0)),)
    handles = [Handle("scale", "free", middle, rows, pieces, np.zeros((1, 3)), order=0)]
    for i in range(3):
        pieces, path = _box(i)
        handles.append(Handle(f"scale {AXES[i]}", AXES[i], middle, rows, pieces, path, axis=rows[i]))
    return tuple(handles)


def size_handle(name: str, point: ArrayLike, direction: ArrayLike, locked: bool = False) -> Handle:
    """A knob on a short line off a surface at `point` (3,), along the unit `direction` (3,)."""
    rows = _frame_along(np.asarray(direction, float))
    return _knob(name, "locked" if locked else "size", np.asarray(point, float), rows, LEADER * np.eye(3)[2],
                 order=0, axis=rows[2])  # fmt: skip


def plane_handles(
    name: str, centre: ArrayLike, normal: ArrayLike, side: float | None, locked: tuple[bool, bool] = (False, False)
) -> tuple[Handle, ...]:
    """A plane as a square with `side` millimetres (None: without it), and what changes it.

    "`name`" is an arrow along the unit `normal` that shifts it, "`name` tilt u" and "... v" are arcs that tilt it about
    two lines in it (see `plane_axes`). `locked` tells whether shifting and tilting are refused.
    """
    middle, rows = np.asarray(centre, float), plane_axes(normal)
    shift_role: Role = "locked" if locked[0] else "plane"
    tilt_role: Role = "locked" if locked[1] else "plane"
    arrow, path = _arrow(2, 0.0)
    handles = [Handle(name, shift_role, middle, rows, (*arrow, Piece(disc(4.0), flat=True)), path, axis=rows[2])]
    if side is not None:
        nowhere = np.full((1, 3), np.nan)
        handles.append(Handle(f"{name} square", "plane", middle, rows, _grid(), nowhere, order=9, unit=side))
    for axis, word in enumerate("uv"):
        pieces, arc = _arc(axis)
        handles.append(Handle(f"{name} tilt {word}", tilt_role, middle, rows, pieces, arc))
    return tuple(handles)


def border_handle(name: str, centre: ArrayLike, normal: ArrayLike, side: float) -> Handle:
    """The border alone of a plane's square with `side` millimetres, which keeps what lies in the plane in sight."""
    corners = 0.5 * np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], float)
    rim = Piece(tube(corners, 0.0025, closed=True), opacity=0.85)
    middle, rows = np.asarray(centre, float), plane_axes(normal)
    return Handle(name, "plane", middle, rows, (rim,), np.full((1, 3), np.nan), order=9, unit=side)


def plane_axes(normal: ArrayLike) -> Floats:
    """Rows (3, 3): two lines in a plane, the first as level as can be, and its unit normal."""
    return _frame_along(np.asarray(normal, float))


# Shapes do not depend on where they stand: each is made once.


@cache
def _arrow(axis: int, start: float) -> tuple[tuple[Piece, ...], Floats]:
    """Along an axis from `start` to REACH, and its path."""
    along = np.eye(3)[axis]
    foot, tip = (REACH - HEAD) * along, REACH * along
    shape = joined(tube(np.array([start * along, foot]), LINE), cone(foot, tip, 6.0))
    return (Piece(shape),), np.array([start * along, tip])


@cache
def _corner(axis: int) -> tuple[tuple[Piece, ...], Floats]:
    """A square between the two other axes, and its corners (4, 3)."""
    u, v = np.eye(3)[(axis + 1) % 3], np.eye(3)[(axis + 2) % 3]
    a, b = CORNER
    corners = np.array([a * u + a * v, b * u + a * v, b * u + b * v, a * u + b * v])
    return (Piece(tube(corners, 0.8, closed=True)), Piece(quad(corners), opacity=0.35)), corners


@cache
def _ring(axis: int) -> tuple[tuple[Piece, ...], Floats]:
    ring = circle(axis, RING)
    return (Piece(tube(ring, LINE, closed=True)),), np.vstack((ring, ring[:1]))


@cache
def _box(axis: int) -> tuple[tuple[Piece, ...], Floats]:
    """A box at the end of an axis, and the path to it."""
    along = np.eye(3)[axis]
    end = (REACH - 6.0) * along
    shape = joined(tube(np.array([FOOT * along, end]), LINE), cube(end, 5.5))
    return (Piece(shape),), np.array([FOOT * along, REACH * along])


@cache
def _arc(axis: int) -> tuple[tuple[Piece, ...], Floats]:
    """About x or y, on both sides of z, which is at 90 degrees of the one and at 0 of the other."""
    start = 35.0 if axis == 0 else -55.0
    arc = circle(axis, 62.0, start, start + 110.0, 25)
    return (Piece(joined(tube(arc, LINE), cube(arc[0], 3.0), cube(arc[-1], 3.0))),), arc


@cache
def _grid() -> tuple[Piece, ...]:
    """A square of side 1 about the middle, its border, and three lines across it each way."""
    corners = 0.5 * np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], float)
    lines = []
    for at in (-0.25, 0.0, 0.25):
        lines.append(tube(np.array([(at, -0.5, 0.0), (at, 0.5, 0.0)]), 0.002))
        lines.append(tube(np.array([(-0.5, at, 0.0), (0.5, at, 0.0)]), 0.002))
    border = tube(corners, 0.0035, closed=True)
    return Piece(quad(corners), opacity=0.12), Piece(border, opacity=0.85), Piece(joined(*lines), opacity=0.45)


@cache
def _knob_pieces(free: bool, at: tuple[float, float, float]) -> tuple[Piece, ...]:
    face = square if free else disc
    pieces = [Piece(face(KNOB + RIM), "rim", flat=True, at=at), Piece(face(KNOB, 1.0), "main", flat=True, at=at)]
    if any(at):
        pieces.append(Piece(tube(np.array([(0.0, 0.0, 0.0), at]), 1.0), "rim"))
    return tuple(pieces)


def _knob(
    name: str, role: Role, origin: Floats, axes: Floats, at: Floats, order: int, axis: Floats | None = None
) -> Handle:
    pieces = _knob_pieces(role == "free", (float(at[0]), float(at[1]), float(at[2])))
    return Handle(name, role, origin, axes, pieces, at.reshape(1, 3), order=order, axis=axis)


def _frame_along(direction: Floats) -> Floats:
    """Rows (3, 3) of a right-handed frame whose third axis is `direction`."""
    third = direction / np.linalg.norm(direction)
    first = np.cross((0.0, 0.0, 1.0), third)
    if np.linalg.norm(first) < 1e-6:
        first = np.array([1.0, 0.0, 0.0])
        first = first - third * (third @ first)
    first /= np.linalg.norm(first)
    return np.array([first, np.cross(third, first), third])
