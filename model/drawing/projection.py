"""Projections: from the world to the picture's plane, parallel or in perspective."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..document.errors import Refusal

Floats = NDArray[np.float64]
Vector = tuple[float, float, float]

DIRECTIONS: dict[str, Vector] = {
    "front": (0.0, -1.0, 0.0),
    "back": (0.0, 1.0, 0.0),
    "left": (-1.0, 0.0, 0.0),
    "right": (1.0, 0.0, 0.0),
    "top": (0.0, 0.0, 1.0),
    "bottom": (0.0, 0.0, -1.0),
    "iso": (1.0, -1.0, 1.0),
}
"""From the target to the eye, of the views by name; z is up, and at the poles x is to the right."""

NEAREST = 1e-4
"""What is nearer to the eye's plane than this is not drawn; as a part of the distance to the target."""
ASPECT = math.sqrt(2.0)
"""Width by height of what a perspective shows, where nobody says: a sheet of DIN A paper."""


@dataclass(frozen=True, slots=True, eq=False)
class Projection:
    """An eye that looks at `target`, or with an endless `focal` one that looks from far away along `-axes[2]`.

    `axes` has the picture's right and up and the direction from the target back to the eye as rows, unit and
    right-handed; `focal` is the distance in mm from the eye to the target. `frame` is half the width and half the
    height, in mm at the target, of what a perspective shows; None shows all that is before the eye.
    """

    target: Floats  # (3,)
    axes: Floats  # (3, 3)
    focal: float = math.inf
    frame: tuple[float, float] | None = None

    @property
    def parallel(self) -> bool:
        return math.isinf(self.focal)

    @property
    def eye(self) -> Floats:
        """(3,) the eye, or in a parallel projection the direction towards it, as `partition.order.Sorter` wants it."""
        return self.axes[2] if self.parallel else self.target + self.focal * self.axes[2]

    def viewed(self, points: ArrayLike) -> Floats:
        """(n, 3) points (n, 3) of the world in the eye's axes, the target at the origin; mm."""
        return (np.asarray(points, float).reshape(-1, 3) - self.target) @ self.axes.T

    def picture(self, points: ArrayLike) -> Floats:
        """(n, 3) where points (n, 3) of the world lie in the picture: x to the right, y up, and a depth, larger nearer.

        x and y are mm in the plane of the target. In perspective this is the projective map that keeps that plane and
        moves the eye to infinity: planes stay planes and straight lines straight, in depth as well, which near the
        target is in mm, too. Points behind the eye or too near (see `limits`) mean nothing in the picture.
        """
        return self.flattened(self.viewed(points))

    def flattened(self, viewed: Floats) -> Floats:
        """(n, 3) the picture of points (n, 3) that `viewed` gave."""
        if self.parallel:
            return viewed
        away = self.focal - viewed[:, 2:]
        return viewed * (self.focal / np.where(away == 0.0, NEAREST * self.focal, away))

    def limits(self) -> Floats:
        """(k, 4) the planes around what is seen, in the eye's axes: normal · x + offset >= 0 is kept.

        The first is the nearest plane, the others are the frame's. None in a parallel projection.
        """
        if self.parallel:
            return np.zeros((0, 4))
        planes = [(0.0, 0.0, -1.0, self.focal * (1.0 - NEAREST))]
        if self.frame is not None:
            width, height = (side / self.focal for side in self.frame)
            planes += [(s, 0.0, -width, width * self.focal) for s in (1.0, -1.0)]
            planes += [(0.0, s, -height, height * self.focal) for s in (1.0, -1.0)]
        return np.array(planes)


def standard(name: str, bounds: ArrayLike | None = None, perspective: float | None = None) -> Projection:
    """A view by name (see DIRECTIONS) of `bounds` (2, 3), whose middle becomes the target; by default the origin.

    A full vertical angle in degrees makes it a perspective, from so far that the bounds' ball fits into the angle.
    Raises Refusal for an unknown name or an angle that is none.
    """
    if name not in DIRECTIONS:
        raise Refusal(f"no view is called {name!r:.60}: take one of {', '.join(DIRECTIONS)}")
    box = np.zeros((2, 3)) if bounds is None else np.asarray(bounds, float).reshape(2, 3)
    axes = _axes(np.array(DIRECTIONS[name]), np.array([0.0, 0.0, 1.0]))
    target = box.mean(axis=0)
    if perspective is None:
        return Projection(target, axes)
    reach = float(np.linalg.norm(np.ptp(box, axis=0))) / 2.0 or 1.0
    return Projection(target, axes, reach / math.sin(_half_angle(perspective)))


def looking(
    eye: ArrayLike,
    target: ArrayLike = (0.0, 0.0, 0.0),
    up: ArrayLike = (0.0, 0.0, 1.0),
    perspective: float | None = None,
    aspect: float | None = ASPECT,
) -> Projection:
    """What an eye sees that looks at a target: in perspective with the full vertical angle in degrees, else parallel.

    A perspective shows a frame of this `aspect` (width by height), or with None all that is before the eye. `up` need
    not be perpendicular to the view. Raises Refusal where eye and target are the same, a number is none, or the angle.
    """
    position, middle, upward = (np.asarray(v, float).reshape(3) for v in (eye, target, up))
    back = position - middle
    distance = float(np.linalg.norm(back))
    if not (np.isfinite([position, middle, upward]).all() and math.isfinite(distance)):
        raise Refusal("the eye, its target and up must be finite numbers")
    if distance <= 1e-12 * float(np.abs([position, middle]).max()) or distance == 0.0:
        raise Refusal("the eye and its target are the same point; move one of them")
    axes = _axes(back, upward)
    if perspective is None:
        return Projection(middle, axes)
    height = distance * math.tan(_half_angle(perspective))
    if aspect is not None and not 0.0 < aspect < math.inf:
        raise Refusal(f"the width of a picture by its height is a number above 0, not {aspect:g}")
    return Projection(middle, axes, distance, None if aspect is None else (height * aspect, height))


def _half_angle(perspective: float) -> float:
    """Half of an angle in degrees, in radians. Raises Refusal."""
    if not 0.0 < perspective < 180.0:
        raise Refusal(f"a perspective angle lies between 0 and 180 degrees, not at {perspective:g}")
    return math.radians(perspective) / 2.0


def _axes(back: Floats, up: Floats) -> Floats:
    """(3, 3) right, up, backward. Where the view goes along `up`, the picture's up is ±y, so that right is +x."""
    backward = back / np.linalg.norm(back)
    right = np.cross(up, backward)
    if np.linalg.norm(right) < 1e-9 * max(float(np.linalg.norm(up)), 1e-300):
        for stand_in in ((0.0, float(np.copysign(1.0, backward[2])), 0.0), (0.0, 0.0, 1.0)):
            right = np.cross(stand_in, backward)
            if np.linalg.norm(right) > 1e-3:
                break
    right = right / np.linalg.norm(right)
    return np.array([right, np.cross(backward, right), backward]) + 0.0
