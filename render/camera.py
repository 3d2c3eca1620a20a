"""The camera as a value, and pure functions that move it: orbit, pan, zoom, fit; rays through pixels.

Pixel coordinates are Qt's: continuous, x to the right and y downward from the viewport's upper left corner, so the
centre of pixel column i is at x = i + 0.5. They are measured in the same unit as `size` = (width, height), logical or
device pixels alike.
"""

import itertools
import math
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

if TYPE_CHECKING:
    from vtkmodules.vtkRenderingCore import vtkCamera

Vector = tuple[float, float, float]
Vectors = NDArray[np.float64]

NEAREST, FARTHEST = 1e-6, 1e9  # millimetres between eye and target


@dataclass(frozen=True, slots=True)
class Camera:
    """An eye at `position` that looks at `target`; `up` need not be perpendicular to the view direction.

    `view_angle` is the full vertical angle in degrees, `parallel_scale` half the height of the picture in millimetres;
    each counts only in its own projection.
    """

    position: Vector = (100.0, -100.0, 100.0)
    target: Vector = (0.0, 0.0, 0.0)
    up: Vector = (0.0, 0.0, 1.0)
    view_angle: float = 30.0
    parallel: bool = False
    parallel_scale: float = 50.0

    @property
    def distance(self) -> float:
        return math.dist(self.position, self.target)

    @property
    def half_height(self) -> float:
        """Half the height of the picture, in millimetres, at the depth of the target."""
        return self.parallel_scale if self.parallel else self.distance * _tangent(self)


@lru_cache(maxsize=32)
def frame(camera: Camera) -> Vectors:
    """The camera's axes as rows (3, 3), read-only: right, up, and backward (from the target to the eye), all unit."""
    backward = _unit(np.subtract(camera.position, camera.target), (0.0, -1.0, 0.0))
    right = np.cross(camera.up, backward)
    if np.linalg.norm(right) < 1e-9 * max(np.linalg.norm(camera.up), 1e-300):
        right = np.cross(_turntable_up(backward, np.array([0.0, 1.0, 0.0])), backward)
    right = _unit(right, (1.0, 0.0, 0.0))
    axes = np.array([right, np.cross(backward, right), backward])
    axes.flags.writeable = False
    return axes


def orbit(camera: Camera, dx_deg: float, dy_deg: float, pivot: ArrayLike | None = None) -> Camera:
    """Turn about `pivot` (the target by default) as on a turntable: `dx_deg` about the world's z axis, `dy_deg` tilts.

    Positive angles follow a pointer dragged right and down: the model's near side goes with it. The tilt stops at
    the poles, so that z never points down in the picture; a rolled camera is set upright.
    """
    old = frame(camera)
    azimuth, elevation = turntable_angles(old)
    azimuth -= math.radians(dx_deg)
    elevation = min(max(elevation + math.radians(dy_deg), -math.pi / 2), math.pi / 2)
    new = turntable_frame(azimuth, elevation)
    turn = new.T @ old
    centre = np.asarray(camera.target if pivot is None else pivot, float)
    position = centre + turn @ np.subtract(camera.position, centre)
    target = centre + turn @ np.subtract(camera.target, centre)
    return replace(camera, position=vector_of(position), target=vector_of(target), up=vector_of(new[1]))


def pan(camera: Camera, dx: float, dy: float, size: tuple[float, float], point: ArrayLike | None = None) -> Camera:
    """Shift the view so that `point` (the target by default) follows a pointer moved by (dx, dy) pixels."""
    half = camera.half_height
    axes = frame(camera)
    if point is not None and not camera.parallel:
        half = max(float(axes[2] @ np.subtract(camera.position, np.asarray(point, float))), NEAREST) * _tangent(camera)
    shift = 2.0 * half / size[1] * (-dx * axes[0] + dy * axes[1])
    return _shifted(camera, shift)


def zoom(
    camera: Camera,
    factor: float,
    pixel: tuple[float, float] | None = None,
    size: tuple[float, float] | None = None,
    point: ArrayLike | None = None,
) -> Camera:
    """Magnify by `factor` (> 1 goes nearer) about what lies under `pixel`, which stays where it is in the picture.

    `point` is the world point under the pointer; without it the point under `pixel` at the target's depth is kept, and
    without both the target. Raises ValueError for a factor that is not positive, or a pixel without a size.
    """
    if not factor > 0.0 or not math.isfinite(factor):
        raise ValueError(f"a zoom factor must be positive, not {factor}")
    extent = camera.half_height
    factor = min(max(factor, extent / FARTHEST), extent / NEAREST)
    if point is not None:
        centre = np.asarray(point, float)
    elif pixel is not None:
        if size is None:
            raise ValueError("zooming about a pixel needs the viewport's size")
        centre = on_target_plane(camera, pixel[0], pixel[1], size)
    else:
        centre = np.asarray(camera.target, float)
    if camera.parallel:
        backward = frame(camera)[2]
        offset = centre - camera.target
        offset = offset - backward * (backward @ offset)
        moved = _shifted(camera, (1.0 - 1.0 / factor) * offset)
        return replace(moved, parallel_scale=camera.parallel_scale / factor)
    position = centre + np.subtract(camera.position, centre) / factor
    target = centre + np.subtract(camera.target, centre) / factor
    return replace(camera, position=vector_of(position), target=vector_of(target))


def fit(camera: Camera, bounds: ArrayLike | None, aspect: float, margin: float = 1.08) -> Camera:
    """Keep the direction and move so that `bounds` (2, 3) just fits a picture of `aspect` = width / height.

    Both projections are prepared, so that switching between them afterwards keeps the size. None and empty or infinite
    bounds are taken as a cube of 100 mm about the origin, a single point as one of 1 mm.
    """
    box = np.array([[-50.0] * 3, [50.0] * 3]) if bounds is None else np.asarray(bounds, float).reshape(2, 3)
    if not np.isfinite(box).all() or (box[1] < box[0]).any():
        box = np.array([[-50.0] * 3, [50.0] * 3])
    centre = box.mean(axis=0)
    if (np.ptp(box, axis=0) <= 1e-9 * max(1.0, float(np.abs(box).max()))).all():
        box = np.array([centre - 0.5, centre + 0.5])
    x, y, z = (frame(camera) @ (_corners(box) - centre).T) * margin
    reach = np.maximum(np.abs(x) / aspect, np.abs(y))
    tangent = _tangent(camera)
    scale = float(reach.max())
    distance = scale / tangent if camera.parallel else float((z + reach / tangent).max())
    position = centre + frame(camera)[2] * distance
    return replace(
        camera,
        position=vector_of(position),
        target=vector_of(centre),
        parallel_scale=scale if camera.parallel else distance * tangent,
    )


def with_projection(camera: Camera, parallel: bool) -> Camera:
    """The camera in the other projection, showing what lies at the target's depth in the same size."""
    if parallel == camera.parallel:
        return camera
    if parallel:
        return replace(camera, parallel=True, parallel_scale=camera.half_height)
    position = np.asarray(camera.target) + frame(camera)[2] * (camera.parallel_scale / _tangent(camera))
    return replace(camera, parallel=False, position=vector_of(position))


def ray(camera: Camera, x: float, y: float, size: tuple[float, float]) -> tuple[Vectors, Vectors]:
    """The ray that pixel (x, y) looks along: origin (3,) and unit direction (3,).

    In perspective the origin is the eye; in parallel projection it lies in the plane through the eye, and what is
    behind that plane is seen too, so that callers there must not stop at the origin.
    """
    right, up, backward = frame(camera)
    half = camera.half_height
    across = (2.0 * x - size[0]) / size[1] * half * right + (1.0 - 2.0 * y / size[1]) * half * up
    position = np.asarray(camera.position, float)
    if camera.parallel:
        return position + across, -backward
    return position, _unit(across - backward * camera.distance, tuple(-backward))


def project(camera: Camera, points: ArrayLike, size: tuple[float, float]) -> Vectors:
    """Pixels (n, 3) of world points (n, 3): x, y, and the depth before the eye in millimetres.

    In perspective points not before the eye give nan for x and y.
    """
    local = (np.asarray(points, float).reshape(-1, 3) - camera.position) @ frame(camera).T
    depth = -local[:, 2]
    if camera.parallel:
        half = np.full(len(local), camera.half_height)
    else:
        half = np.where(depth > 0.0, depth, np.nan) * _tangent(camera)
    x = 0.5 * size[0] + local[:, 0] / half * 0.5 * size[1]
    y = 0.5 * size[1] * (1.0 - local[:, 1] / half)
    return np.column_stack([x, y, depth])


def on_target_plane(camera: Camera, x: float, y: float, size: tuple[float, float]) -> Vectors:
    """The world point (3,) under pixel (x, y) at the depth of the target."""
    origin, direction = ray(camera, x, y, size)
    backward = frame(camera)[2]
    return origin + direction * (camera.distance / -(direction @ backward))


def apply(camera: Camera, vtk_camera: "vtkCamera", bounds: ArrayLike | None = None) -> None:
    """Set a vtkCamera, with near and far planes about `bounds` (2, 3); None keeps what is within 100 distances.

    In parallel projection VTK's eye is put far enough back to have all of the bounds before it.
    """
    axes = frame(camera)
    distance = camera.distance
    if bounds is None:
        near, far = distance * 0.01, distance * 100.0
    else:
        depth = distance - (_corners(np.asarray(bounds, float).reshape(2, 3)) - camera.target) @ axes[2]
        slack = 0.01 * max(float(np.ptp(depth)), 1e-3 * distance)
        near, far = float(depth.min()) - slack, float(depth.max()) + slack
    if camera.parallel:
        back = max(0.0, far - near - near)  # leaves near >= the thickness, which keeps VTK's arithmetic tame
        distance, near, far = distance + back, near + back, far + back
    else:
        far = max(far, 0.1 * distance)
        near = max(near, 0.02 * distance, 5e-4 * far)  # depths stay apart also where the eye is inside the bounds
    vtk_camera.SetFocalPoint(*camera.target)
    vtk_camera.SetPosition(*(np.asarray(camera.target) + axes[2] * distance))
    vtk_camera.SetViewUp(*axes[1])
    vtk_camera.SetViewAngle(camera.view_angle)
    vtk_camera.SetParallelProjection(camera.parallel)
    vtk_camera.SetParallelScale(camera.parallel_scale)
    vtk_camera.SetClippingRange(near, far)


def turntable_angles(axes: Vectors) -> tuple[float, float]:
    """Azimuth and elevation in radians of the eye as seen from the target; at the poles `up` tells the azimuth."""
    _, up, backward = axes
    flat = math.hypot(backward[0], backward[1])
    elevation = math.atan2(backward[2], flat)
    if flat > 1e-9:
        return math.atan2(backward[1], backward[0]), elevation
    sign = math.copysign(1.0, backward[2])
    return math.atan2(-sign * up[1], -sign * up[0]), elevation


def turntable_frame(azimuth: float, elevation: float) -> Vectors:
    ca, sa, ce, se = math.cos(azimuth), math.sin(azimuth), math.cos(elevation), math.sin(elevation)
    return np.array([[-sa, ca, 0.0], [-se * ca, -se * sa, ce], [ce * ca, ce * sa, se]])


def _tangent(camera: Camera) -> float:
    return math.tan(math.radians(camera.view_angle) / 2.0)


def _corners(box: Vectors) -> Vectors:
    return np.array(list(itertools.product(*box.T)))


def vector_of(values: Any) -> Vector:
    x, y, z = (float(value) for value in values)
    return x, y, z


def _unit(vector: ArrayLike, otherwise: Any) -> Vectors:
    length = float(np.linalg.norm(vector))
    return np.asarray(vector, float) / length if length > 1e-300 else np.array(otherwise, float)


def _shifted(camera: Camera, shift: Vectors) -> Camera:
    return replace(camera, position=vector_of(camera.position + shift), target=vector_of(camera.target + shift))


def _turntable_up(backward: Vectors, up: Vectors) -> Vectors:
    return turntable_frame(*turntable_angles(np.array([np.zeros(3), up, backward])))[1]
