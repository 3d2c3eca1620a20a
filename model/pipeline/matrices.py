"""The four matrices of a pipeline as one value, how they are made for an eye, and what an edited one still is."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from ..document.errors import Refusal
from ..drawing.projection import looking
from .stages import (
    Floats,
    Stages,
    homogeneous,
    parallel_matrix,
    perspective_matrix,
    square,
    stages,
    unprojected,
    view_matrix,
    viewport_matrix,
)

NAMES = ("model", "view", "projection", "viewport")
"""In the order in which they are applied."""
CLOSE = 1e-6
"""By how much an edited matrix may differ from what it is taken for."""


@dataclass(frozen=True, slots=True, eq=False)
class Matrices:
    """(4, 4) each: from the node's own axes to the world, to the eye, to clip coordinates; from device coordinates to
    pixels and depth."""

    model: Floats
    view: Floats
    projection: Floats
    viewport: Floats

    def stages(self, points: ArrayLike) -> Stages:
        """Of points (n, 3) in the node's own axes."""
        return stages(points, self.model, self.view, self.projection, self.viewport)

    def clip(self, points: ArrayLike) -> Floats:
        """(n, 4) clip coordinates of points (n, 3) of the world."""
        return homogeneous(np.asarray(points, float)) @ (self.projection @ self.view).T

    def unprojected(self, pixels: ArrayLike) -> Floats:
        """(n, 3) the points of the world at pixels (n, 3), the third the depth."""
        return unprojected(pixels, self.view, self.projection, self.viewport)

    def with_(self, name: str, matrix: ArrayLike) -> Matrices:
        """With another matrix by the name. Raises Refusal where it is none."""
        return replace(self, **{name: checked(matrix, name)})


@dataclass(frozen=True, slots=True)
class Lens:
    """What a projection matrix is made of: `angle` is the full vertical one in degrees, or None for a parallel
    projection, of which `half_height` mm are half the picture; `near` and `far` in mm before the eye."""

    angle: float | None
    half_height: float
    aspect: float
    near: float
    far: float

    def matrix(self) -> Floats:
        """(4, 4). Raises Refusal for a frustum that has no inside."""
        if not (math.isfinite(self.near) and math.isfinite(self.far) and self.far > self.near):
            raise Refusal("the far plane must lie behind the near one")
        if self.angle is None:
            return parallel_matrix(self.half_height, self.aspect, self.near, self.far)
        if self.near <= 0.0:
            raise Refusal("in perspective the near plane must lie before the eye: write a number above 0")
        if not 0.0 < self.angle < 180.0:
            raise Refusal("the angle of a perspective lies between 0 and 180 degrees")
        return perspective_matrix(math.radians(self.angle), self.aspect, self.near, self.far)


def checked(matrix: ArrayLike, name: str) -> Floats:
    """(4, 4) as it is. Raises Refusal for numbers that are none, for a matrix that flattens, and for one but the
    projection's whose last row is not 0, 0, 0, 1."""
    found = square(matrix)
    if found.shape != (4, 4) or not np.isfinite(found).all():
        raise Refusal(f"the {name} matrix needs 4 rows of 4 numbers, none of them infinite")
    if name != "projection" and not np.array_equal(found[3], (0.0, 0.0, 0.0, 1.0)):
        raise Refusal(f"the last row of the {name} matrix is 0, 0, 0, 1: only the projection changes w")
    size = np.linalg.norm(found, axis=0)
    if (size == 0.0).any() or abs(np.linalg.det(found / size)) < 1e-12:
        raise Refusal(f"the {name} matrix would flatten space: its rows must not be multiples or sums of each other")
    return found


def eye_of(view: Floats) -> tuple[Floats, Floats]:
    """The eye's position (3,) and its axes (3, 3) as rows. Raises Refusal for a view that does more than turn and
    move."""
    axes = view[:3, :3]
    if np.abs(axes @ axes.T - np.eye(3)).max() > CLOSE or np.linalg.det(axes) < 0.0:
        raise Refusal("a camera only turns and moves: this view also scales, leans or mirrors, so it cannot be applied")
    return -axes.T @ view[:3, 3], axes


def lens_of(projection: Floats) -> Lens:
    """What it is made of. Raises Refusal for a matrix that neither a perspective nor a parallel projection about the
    middle of the picture has."""
    m = projection
    lens = None
    with np.errstate(all="ignore"):
        if m[1, 1] > 0.0 and m[0, 0] > 0.0:
            aspect = float(m[1, 1] / m[0, 0])
            if m[3, 2] == -1.0:
                near, far = float(m[2, 3] / (m[2, 2] - 1.0)), float(m[2, 3] / (m[2, 2] + 1.0))
                lens = Lens(math.degrees(2.0 * math.atan(1.0 / m[1, 1])), 0.0, aspect, near, far)
            elif m[3, 2] == 0.0:
                near, far = float((m[2, 3] + 1.0) / m[2, 2]), float((m[2, 3] - 1.0) / m[2, 2])
                lens = Lens(None, float(1.0 / m[1, 1]), aspect, near, far)
    try:
        fits = lens is not None and np.allclose(lens.matrix(), m, rtol=CLOSE, atol=CLOSE)
    except Refusal:
        fits = False
    if lens is None or not fits:
        raise Refusal("this is the projection of no camera: its entries do not belong to one angle, near and far plane")
    return lens


def matrices_for(
    eye: ArrayLike,
    target: ArrayLike = (0.0, 0.0, 0.0),
    up: ArrayLike = (0.0, 0.0, 1.0),
    *,
    perspective: float | None = 30.0,
    half_height: float = 50.0,
    size: tuple[float, float] = (1200, 800),
    near: float | None = None,
    far: float | None = None,
    model: ArrayLike | None = None,
) -> Matrices:
    """Those of an eye that looks at a target, in a picture of `size` pixels.

    `perspective` is the full vertical angle in degrees, None for a parallel projection that shows `half_height` mm to
    either side. Near and far are by default a tenth of the distance to the target and ten times it. Raises Refusal.
    """
    seen = looking(eye, target, up, perspective)
    position = np.asarray(eye, float)
    distance = float(np.linalg.norm(position - np.asarray(target, float)))
    near, far = 0.1 * distance if near is None else near, 10.0 * distance if far is None else far
    width, height = size
    if not (width > 0 and height > 0):
        raise Refusal("a picture has a width and a height above 0 pixels")
    own = np.eye(4) if model is None else checked(model, "model")
    lens = Lens(perspective, half_height, width / height, near, far)
    return Matrices(own, view_matrix(position, seen.axes), lens.matrix(), viewport_matrix(width, height))
