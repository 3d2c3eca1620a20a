"""Views by name, and the way from one camera to another."""

import math
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from .camera import (
    NEAREST,
    Camera,
    Vector,
    Vectors,
    fit,
    frame,
    turntable_angles,
    turntable_frame,
    vector_of,
    with_projection,
)

STANDARD_VIEWS = {
    "iso": (1, -1, 1),
    "front": (0, -1, 0),
    "back": (0, 1, 0),
    "left": (-1, 0, 0),
    "right": (1, 0, 0),
    "top": (0, 0, 1),
    "bottom": (0, 0, -1),
}


def standard_view(camera: Camera, name: str) -> Camera:
    """The camera turned to a view by name, z up, at the same distance from the same target.

    `name` is one of STANDARD_VIEWS or joins up to three sides of the view cube, as in "front-right-top". At the poles
    the picture's right is +x. Raises ValueError for a name that means no direction.
    """
    direction = view_direction(name)
    level = direction[0] == 0 and direction[1] == 0
    azimuth = -math.pi / 2 if level else math.atan2(direction[1], direction[0])
    elevation = math.atan2(direction[2], math.hypot(direction[0], direction[1]))
    axes = turntable_frame(azimuth, elevation)
    position = np.asarray(camera.target) + axes[2] * camera.distance
    return replace(camera, position=vector_of(position), up=vector_of(axes[1]))


def view_direction(name: str) -> Vector:
    """From the target to the eye of a view by name, components -1, 0 or 1; raises ValueError."""
    parts = name.split("-")
    if any(part not in STANDARD_VIEWS for part in parts):
        raise ValueError(f"no view is called {name!r}: take one of {', '.join(STANDARD_VIEWS)}")
    x, y, z = (float(sum(STANDARD_VIEWS[part][axis] for part in parts)) for axis in range(3))
    if max(abs(x), abs(y), abs(z)) != 1.0:
        raise ValueError(f"the view {name!r} names opposite sides or one side twice")
    return x, y, z


def camera_of(
    bounds: ArrayLike | None,
    aspect: float,
    view: str = "iso",
    *,
    eye: ArrayLike | None = None,
    target: ArrayLike | None = None,
    up: ArrayLike | None = None,
    perspective: float | None = 30.0,
) -> Camera:
    """The camera that a picture is asked for with: a view by name, fitted to `bounds` (2, 3), or an eye.

    With an eye the target is by default the middle of the bounds, or the origin, and `up` is z. `perspective` is the
    full vertical angle in degrees, None for parallel projection, which then shows the bounds' whole height and width.
    Raises ValueError for an unknown view, an angle not between 0 and 180, or an eye in the target.
    """
    if perspective is not None and not 0.0 < perspective < 180.0:
        raise ValueError(f"a perspective angle lies between 0 and 180 degrees, not at {perspective}")
    angle = 30.0 if perspective is None else perspective
    if eye is None:
        camera = Camera(view_angle=angle, parallel=perspective is None)
        return fit(standard_view(camera, view), bounds, aspect)
    if target is None:
        target = (0.0, 0.0, 0.0) if bounds is None else np.asarray(bounds, float).reshape(2, 3).mean(axis=0)
    upward = vector_of((0.0, 0.0, 1.0) if up is None else up)
    camera = Camera(vector_of(eye), vector_of(target), upward, angle, perspective is None)
    if camera.distance == 0.0:
        raise ValueError("the eye and the target are the same point")
    if perspective is not None:
        return camera
    middle = np.asarray(camera.target)
    box = middle + np.array([[-50.0], [50.0]]) if bounds is None else np.asarray(bounds, float).reshape(2, 3)
    mirrored = 2.0 * middle - box[::-1]  # the picture stays centred on the target
    around = np.array([np.minimum(box[0], mirrored[0]), np.maximum(box[1], mirrored[1])])
    return replace(camera, parallel_scale=fit(camera, around, aspect).parallel_scale)


def interpolate(a: Camera, b: Camera, t: float) -> Camera:
    """A camera between `a` (t = 0) and `b` (t = 1) for a smooth move; both ends are returned as they are.

    Two upright cameras stay upright on the way; others take the shortest turn. Between the ends the projection is b's.
    """
    if t <= 0.0:
        return a
    if t >= 1.0:
        return b
    a = with_projection(a, b.parallel)
    start, end = frame(a), frame(b)
    axes = _between_turntable(start, end, t)
    if axes is None:
        axes = _between_any(start, end, t)
    distance = max(a.distance, NEAREST) ** (1.0 - t) * max(b.distance, NEAREST) ** t
    target = (1.0 - t) * np.asarray(a.target) + t * np.asarray(b.target)
    return Camera(
        position=vector_of(target + axes[2] * distance),
        target=vector_of(target),
        up=vector_of(axes[1]),
        view_angle=(1.0 - t) * a.view_angle + t * b.view_angle,
        parallel=b.parallel,
        parallel_scale=a.parallel_scale ** (1.0 - t) * b.parallel_scale**t,
    )


def _between_turntable(start: Vectors, end: Vectors, t: float) -> Vectors | None:
    """Axes (3, 3) between two upright ones, None where one of them is rolled."""
    if abs(start[0, 2]) > 1e-6 or abs(end[0, 2]) > 1e-6 or start[1, 2] < -1e-6 or end[1, 2] < -1e-6:
        return None
    (a0, e0), (a1, e1) = turntable_angles(start), turntable_angles(end)
    turn = (a1 - a0 + math.pi) % (2.0 * math.pi) - math.pi
    return turntable_frame(a0 + t * turn, e0 + t * (e1 - e0))


def _between_any(start: Vectors, end: Vectors, t: float) -> Vectors:
    """Axes (3, 3) on the shortest turn, by Rodrigues' formula."""
    turn = end.T @ start
    angle = math.acos(min(max((np.trace(turn) - 1.0) / 2.0, -1.0), 1.0))
    if angle < 1e-9:
        return end
    values, vectors = np.linalg.eigh((turn + turn.T) / 2.0)
    axis = vectors[:, int(np.argmax(values))]
    skew = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
    axis = axis if axis @ skew >= 0.0 else -axis
    cross = np.array([[0.0, -axis[2], axis[1]], [axis[2], 0.0, -axis[0]], [-axis[1], axis[0], 0.0]])
    partial = np.eye(3) + math.sin(t * angle) * cross + (1.0 - math.cos(t * angle)) * cross @ cross
    return start @ partial.T
