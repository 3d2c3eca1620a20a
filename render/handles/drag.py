"""What the pointer means while a handle is dragged: distances along axes, points of planes, angles, steps. Pure."""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..camera import Camera, frame, project, ray

Floats = NDArray[np.float64]
Size = tuple[float, float]

PARALLEL = 1e-3  # sine below which a ray and an axis count as parallel
GRAZING = 0.12  # cosine below which a ring is seen from its edge, and the pointer is followed along its tangent


def pixel_length(camera: Camera, point: ArrayLike, size: Size) -> float:
    """Millimetres of one pixel at the depth of `point` (3,); at the target's depth where that is behind the eye."""
    half = camera.half_height
    if not camera.parallel:
        depth = float(frame(camera)[2] @ np.subtract(camera.position, np.asarray(point, float)))
        if depth > 0.0:
            half *= depth / camera.distance
    return 2.0 * half / size[1]


def view_direction(camera: Camera, point: ArrayLike) -> Floats:
    """The unit vector (3,) from `point` towards the eye."""
    if camera.parallel:
        return frame(camera)[2]
    towards = np.subtract(camera.position, np.asarray(point, float))
    length = float(np.linalg.norm(towards))
    return towards / length if length > 0.0 else frame(camera)[2]


def along_axis(origin: ArrayLike, direction: ArrayLike, point: ArrayLike, axis: ArrayLike) -> float | None:
    """How far along a line, from `point` in units of the unit `axis`, it comes nearest to a ray.

    None where the two are parallel, or where that is behind the ray's origin.
    """
    along, towards = np.asarray(axis, float), np.asarray(direction, float)
    between = np.subtract(point, origin)
    cosine = float(along @ towards)
    sine = 1.0 - cosine * cosine
    if sine < PARALLEL * PARALLEL:
        return None
    distance = float(cosine * (towards @ between) - along @ between) / sine
    reach = float(towards @ between) + distance * cosine
    return distance if reach > 0.0 else None


def on_plane(origin: ArrayLike, direction: ArrayLike, point: ArrayLike, normal: ArrayLike) -> Floats | None:
    """Where (3,) a ray meets a plane; None where it runs along it or away from it."""
    across, towards = np.asarray(normal, float), np.asarray(direction, float)
    slope = float(across @ towards)
    if abs(slope) < PARALLEL:
        return None
    distance = float(across @ np.subtract(point, origin)) / slope
    return np.asarray(origin, float) + distance * towards if distance > 0.0 else None


def ring_angle(
    camera: Camera, size: Size, pixel: Size, centre: ArrayLike, axis: ArrayLike, grabbed: ArrayLike
) -> float | None:
    """Degrees from the point `grabbed` (3,) of a ring about the unit `axis` to the pointer at `pixel`.

    Where the ring is seen from its edge the pointer is followed along the tangent at `grabbed`; else the angle lies
    between -180 and 180. None where the pointer says nothing.
    """
    about, middle = np.asarray(axis, float), np.asarray(centre, float)
    arm = np.subtract(grabbed, middle)
    arm = arm - about * (about @ arm)
    length = float(np.linalg.norm(arm))
    if length == 0.0:
        return None
    first = arm / length
    second = np.cross(about, first)
    if abs(float(about @ view_direction(camera, middle))) >= GRAZING:
        hit = on_plane(*ray(camera, *pixel, size), middle, about)
        if hit is None:
            return None
        place = hit - middle
        return math.degrees(math.atan2(float(place @ second), float(place @ first)))
    start, ahead = project(camera, [middle + arm, middle + arm + length * 1e-3 * second], size)[:, :2]
    tangent = (ahead - start) / 1e-3  # pixels a radian
    square = float(tangent @ tangent)
    if not square > 0.0:
        return None
    return math.degrees(float((np.asarray(pixel) - start) @ tangent) / square)


def grabbed_on_ring(
    camera: Camera, origin: ArrayLike, direction: ArrayLike, centre: ArrayLike, axis: ArrayLike
) -> Floats | None:
    """The point (3,) of a ring about the unit `axis` that a ray takes hold of, for `ring_angle`; None where there is
    none. Where the ring is seen from its edge that is the side of it that is nearest to the eye."""
    about, middle = np.asarray(axis, float), np.asarray(centre, float)
    towards = view_direction(camera, middle)
    if abs(float(about @ towards)) >= GRAZING:
        return on_plane(origin, direction, middle, about)
    hit = on_plane(origin, direction, middle, towards)
    if hit is None:
        return None
    arm = towards - about * float(about @ towards)
    return middle + arm * max(float(np.linalg.norm(hit - middle)), 1e-6)


def unwrapped(angle: float, last: float) -> float:
    """The angle, full turns added, that is nearest to `last`: a ring can be turned round several times."""
    return angle + 360.0 * round((last - angle) / 360.0)


def step_for(length: float, pixels: float = 8.0) -> float:
    """The step of the series 1, 2, 5, 10, ... nearest to `pixels` pixels of `length` millimetres each."""
    wanted = max(length * pixels, 1e-9)
    decade = 10.0 ** math.floor(math.log10(wanted))
    return min((decade * factor for factor in (1.0, 2.0, 5.0, 10.0)), key=lambda s: abs(math.log(s / wanted)))


def stepped(value: float, step: float) -> float:
    """The nearest multiple of a step, without the last bits that the multiplication leaves."""
    if step <= 0.0:
        return value
    digits = max(0, 2 - math.floor(math.log10(step)))
    return round(round(value / step) * step, digits) + 0.0


def stepped_angle(angle: float, fine: bool) -> float:
    """Whole degrees, and multiples of 15 where one is within 3; tenths of degrees when `fine`."""
    if fine:
        return stepped(angle, 0.1)
    near = stepped(angle, 15.0)
    return near if abs(angle - near) <= 3.0 else stepped(angle, 1.0)


def distance_to_path(path: ArrayLike, x: float, y: float) -> float:
    """Pixels from (x, y) to the nearest point of a polyline (n, 2); infinite where all of it is behind the eye."""
    points = np.asarray(path, float)
    if len(points) == 1:
        points = np.repeat(points, 2, axis=0)
    start, along = points[:-1], np.diff(points, axis=0)
    offset = np.array([x, y]) - start
    square = np.einsum("ij,ij->i", along, along)
    with np.errstate(divide="ignore", invalid="ignore"):
        part = np.where(square > 0.0, np.einsum("ij,ij->i", offset, along) / square, 0.0)
    nearest = start + np.clip(part, 0.0, 1.0)[:, None] * along
    distance = np.hypot(*(nearest - (x, y)).T)
    distance = distance[np.isfinite(distance)]
    return float(distance.min()) if len(distance) else math.inf


def inside(polygon: ArrayLike, x: float, y: float) -> bool:
    """Whether (x, y) lies in a closed polygon (n, 2), by the even-odd rule."""
    a = np.asarray(polygon, float)
    b = np.roll(a, -1, axis=0)
    if not np.isfinite(a).all():
        return False
    crosses = (a[:, 1] > y) != (b[:, 1] > y)
    with np.errstate(divide="ignore", invalid="ignore"):
        at = a[:, 0] + (y - a[:, 1]) / (b[:, 1] - a[:, 1]) * (b[:, 0] - a[:, 0])
    return bool(np.count_nonzero(crosses & (x < at)) % 2)
