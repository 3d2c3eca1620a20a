"""Shapes of handles as triangles: tubes, cones, boxes, discs. All sizes in the units of their points."""

import itertools
from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

Shape = tuple[NDArray[np.float64], NDArray[np.int32]]
"""Points (n, 3) and triangles (m, 3)."""

SIDES = 10


def joined(*shapes: Shape) -> Shape:
    """Several shapes as one."""
    starts = np.cumsum([0, *(len(points) for points, _ in shapes)])
    return (
        np.concatenate([points for points, _ in shapes]),
        np.concatenate([triangles + start for (_, triangles), start in zip(shapes, starts[:-1], strict=True)]),
    )


def tube(path: ArrayLike, radius: float, closed: bool = False) -> Shape:
    """A tube around a polyline (n, 3) in one plane or along one line."""
    line = np.asarray(path, float)
    ahead = np.roll(line, -1, axis=0) - line if closed else np.gradient(line, axis=0)
    if closed:
        ahead = ahead + line - np.roll(line, 1, axis=0)
    ahead /= np.linalg.norm(ahead, axis=1, keepdims=True)
    normal = np.cross(ahead[0], ahead[len(ahead) // 3])
    if np.linalg.norm(normal) < 1e-9:
        normal = np.cross(ahead[0], np.eye(3)[np.argmin(np.abs(ahead[0]))])
    normal /= np.linalg.norm(normal)
    side = np.cross(ahead, normal)
    angles = np.arange(SIDES) * 2 * np.pi / SIDES
    ring = np.cos(angles)[None, :, None] * side[:, None] + np.sin(angles)[None, :, None] * normal
    points = (line[:, None] + radius * ring).reshape(-1, 3)
    return points, _grid(len(line), SIDES, closed)


def cone(start: ArrayLike, end: ArrayLike, radius: float) -> Shape:
    """A cone with its point at `end` and its foot, which is closed, at `start`."""
    foot, tip = np.asarray(start, float), np.asarray(end, float)
    axis = (tip - foot) / np.linalg.norm(tip - foot)
    first = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    first /= np.linalg.norm(first)
    angles = np.arange(2 * SIDES, dtype=np.float64) * np.pi / SIDES
    rim = foot + radius * (np.cos(angles)[:, None] * first + np.sin(angles)[:, None] * np.cross(axis, first))
    count = len(rim)
    here, next_ = np.arange(count), np.roll(np.arange(count), -1)
    sides = np.column_stack((here, next_, np.full(count, count)))
    base = np.column_stack((next_, here, np.full(count, count + 1)))
    return np.vstack((rim, tip, foot)).astype(np.float64), np.concatenate((sides, base)).astype(np.int32)


def cube(centre: ArrayLike, half: float) -> Shape:
    corners = np.array(list(itertools.product((-1.0, 1.0), repeat=3))) * half + np.asarray(centre, float)
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return corners, _quads(quads)


def quad(corners: ArrayLike) -> Shape:
    """A flat four-sided face (4, 3)."""
    return np.asarray(corners, float), _quads([(0, 1, 2, 3)])


def disc(radius: float, height: float = 0.0) -> Shape:
    """A round face about the z axis at z = height."""
    angles = np.arange(24) * np.pi / 12
    rim = np.column_stack((radius * np.cos(angles), radius * np.sin(angles), np.full(24, height)))
    here = np.arange(24)
    triangles = np.column_stack((here, np.roll(here, -1), np.full(24, 24)))
    return np.vstack((rim, (0.0, 0.0, height))), triangles.astype(np.int32)


def square(half: float, height: float = 0.0) -> Shape:
    """A square face about the z axis at z = height."""
    return quad([(x * half, y * half, height) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))])


def circle(axis: int, radius: float, start: float = 0.0, end: float = 360.0, count: int = 72) -> NDArray[np.float64]:
    """Points (n, 3) of an arc about a coordinate axis; a full circle is not closed by a second first point."""
    angles = np.radians(np.linspace(start, end, count, endpoint=end - start < 360.0))
    points = np.zeros((count, 3))
    points[:, (axis + 1) % 3] = radius * np.cos(angles)
    points[:, (axis + 2) % 3] = radius * np.sin(angles)
    return points


@cache
def _grid(rows: int, columns: int, closed: bool) -> NDArray[np.int32]:
    """Triangles of a grid of points, whose columns run round."""
    row = np.arange(rows if closed else rows - 1)[:, None]
    column = np.arange(columns)[None, :]
    after, beside = (row + 1) % rows, (column + 1) % columns
    a, b = row * columns + column, row * columns + beside
    c, d = after * columns + beside, after * columns + column
    return np.stack((np.stack((a, b, c), -1), np.stack((a, c, d), -1)), -2).reshape(-1, 3).astype(np.int32)


def _quads(corners: list[tuple[int, int, int, int]]) -> NDArray[np.int32]:
    a, b, c, d = np.array(corners).T
    return np.concatenate((np.column_stack((a, b, c)), np.column_stack((a, c, d)))).astype(np.int32)
