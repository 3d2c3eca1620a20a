"""Coordinates at each stage of the pipeline, and the matrices between them.

A point is a column (x, y, z, 1): clip coordinates are projection @ view @ model @ point. The eye looks along its
negative z axis; what is visible has -w <= x, y, z <= w in clip coordinates (OpenGL's convention; Foley, van Dam, Feiner
and Hughes 1990, chapter 6, has the way of working). Pixels are Qt's: x to the right, y downward from the upper left
corner, the centre of the first pixel at 0.5.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import tan

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Stages:
    """Of n points: `world` and `eye` (n, 3) in mm, `clip` (n, 4), `device` (n, 3) after the division by w, and `pixel`
    (n, 3), whose third coordinate is the depth, 0 at the near plane and 1 at the far one. Behind the eye the division
    turns points round: `clip` tells them by w <= 0."""

    world: Floats
    eye: Floats
    clip: Floats
    device: Floats
    pixel: Floats


def view_matrix(position: ArrayLike, axes: ArrayLike) -> Floats:
    """(4, 4) from the world to the eye: `axes` (3, 3) are the eye's x, y and z in the world, as rows."""
    rotation = np.asarray(axes, float)
    matrix = np.eye(4)
    matrix[:3, :3] = rotation
    matrix[:3, 3] = -rotation @ np.asarray(position, float)
    return matrix


def perspective_matrix(angle: float, aspect: float, near: float, far: float) -> Floats:
    """(4, 4) from the eye to clip coordinates: `angle` is the full vertical one in radians, `aspect` width by
    height."""
    cot = 1.0 / tan(angle / 2.0)
    matrix = np.zeros((4, 4))
    matrix[0, 0], matrix[1, 1] = cot / aspect, cot
    matrix[2, 2], matrix[2, 3] = (far + near) / (near - far), 2.0 * far * near / (near - far)
    matrix[3, 2] = -1.0
    return matrix


def parallel_matrix(half_height: float, aspect: float, near: float, far: float) -> Floats:
    """(4, 4) in parallel projection: `half_height` is half of what the picture shows, in mm."""
    return np.array([
        [1.0 / (half_height * aspect), 0.0, 0.0, 0.0],
        [0.0, 1.0 / half_height, 0.0, 0.0],
        [0.0, 0.0, 2.0 / (near - far), (far + near) / (near - far)],
        [0.0, 0.0, 0.0, 1.0],
    ])  # fmt: skip


def viewport_matrix(width: float, height: float) -> Floats:
    """(4, 4) from device coordinates, -1 to 1, to pixels and depth."""
    return np.array([
        [width / 2.0, 0.0, 0.0, width / 2.0],
        [0.0, -height / 2.0, 0.0, height / 2.0],
        [0.0, 0.0, 0.5, 0.5],
        [0.0, 0.0, 0.0, 1.0],
    ])  # fmt: skip


def stages(points: ArrayLike, model: ArrayLike, view: ArrayLike, projection: ArrayLike, viewport: ArrayLike) -> Stages:
    """Of points (n, 3) in a model's own axes; the matrices are (4, 4), that of the model may be (3, 4)."""
    own = homogeneous(np.asarray(points, float))
    world = own @ square(model).T
    eye = world @ np.asarray(view, float).T
    clip = eye @ np.asarray(projection, float).T
    device = divided(clip)
    pixel = homogeneous(device) @ np.asarray(viewport, float).T
    return Stages(world[:, :3], eye[:, :3], clip, device, pixel[:, :3])


def unprojected(pixels: ArrayLike, view: ArrayLike, projection: ArrayLike, viewport: ArrayLike) -> Floats:
    """(n, 3) the points of the world at pixels (n, 3), whose third coordinate is the depth from 0 to 1: the pipeline
    backwards. Raises numpy's LinAlgError for matrices that flatten."""
    whole = np.asarray(viewport, float) @ np.asarray(projection, float) @ np.asarray(view, float)
    return divided(homogeneous(np.asarray(pixels, float)) @ np.linalg.inv(whole).T)


def square(matrix: ArrayLike) -> Floats:
    """(4, 4) of a (3, 4) map, or as it is."""
    rows = np.asarray(matrix, float)
    return rows if len(rows) == 4 else np.vstack((rows, (0.0, 0.0, 0.0, 1.0)))


def homogeneous(points: Floats) -> Floats:
    """(n, 4) with w = 1."""
    return np.column_stack((points, np.ones(len(points))))


def divided(clip: Floats) -> Floats:
    """(..., 3) device coordinates of clip coordinates (..., 4); infinite where w is 0."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return clip[..., :3] / clip[..., 3:]
