"""Outlines drawn along paths: sweeps, and round bars and tubes."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from manifold3d import Manifold
from numpy.typing import NDArray

from ...document.errors import Refusal
from ...document.from_outlines import Pipe, Sweep
from ...outline.paths import path_of
from ...outline.sweeping import Frames, path_frames
from ...path.path import Path
from ..failure import NoSolid
from ..leaves import fineness_of
from ..tessellation import MAX_SURFACE_SEGMENTS, circle_segments
from .drawn import drawn_solid
from .rings import Floats, Numbers, Ring, bar, check_size, crossings, united
from .sections import section_of

STEEP = 30.0
"""Degrees of a corner; where rings cross beside a smaller one, what lies between them is filled."""
ALIKE = 1e-9
"""Share of its reach within which an outline must come back to itself in a closed sweep."""
OVERSHOOT = 0.01
"""Share of its radius by which a bore begins before the end of its pipe, and leaves after it."""


@drawn_solid.register
def solid_of_sweep(node: Sweep, tolerance: float) -> Manifold:
    segments, tolerance = fineness_of(node, tolerance)
    twist, scale = math.radians(float(node.twist)), float(node.end_scale)  # type: ignore[arg-type]
    section = section_of(node.children[0], tolerance / 2)
    if section.is_empty():
        raise NoSolid("Sweep: the outline encloses nothing")
    ring = Ring.of_section(section)
    reach = ring.reach * max(scale, 1.0)
    path = path_of(node.children[1])
    step = np.inf
    if twist:
        walls = np.linalg.norm(ring.points[ring.edges[:, 1]] - ring.points[ring.edges[:, 0]], axis=1)
        longest = float(walls.max()) * max(scale, 1.0)
        step = path.length() * _twist_step(segments, tolerance / 2, reach, longest) / abs(twist)
    frames = _frames(node, path, tolerance / 2, reach, segments=segments, step=step)
    _check_size(node, frames, len(ring.points))
    share = frames.lengths / frames.length
    spin, size = twist * share, 1.0 + (scale - 1.0) * share
    cosine, sine = (size * np.cos(spin))[:, None], (size * np.sin(spin))[:, None]
    x, y = ring.points.T
    rings = _placed(frames, np.stack((cosine * x - sine * y, sine * x + cosine * y), axis=2))
    wrap = None
    if frames.closed:
        if scale != 1.0:
            raise NoSolid(f"Sweep: the path is closed, so the outline must end as it began: an end scale of 1, not "
                          f"{scale:g}")  # fmt: skip
        wrap = _wrapped(ring, twist)
        rings[-1] = rings[0][wrap]
    try:
        return bar(rings, frames.axes[:, 2], ring, frames.lengths, frames.turns > STEEP, wrap).as_original()
    except NoSolid as fault:
        raise NoSolid(f"Sweep: {fault}") from None


@drawn_solid.register
def solid_of_pipe(node: Pipe, tolerance: float) -> Manifold:
    segments, tolerance = fineness_of(node, tolerance)
    radius, bore = float(node.radius), float(node.bore)  # type: ignore[arg-type]
    if bore >= radius:
        raise NoSolid(f"Pipe: the bore ({bore:g} mm) must be smaller than the radius ({radius:g} mm)")
    around = segments or min(circle_segments(radius, tolerance / 2), MAX_SURFACE_SEGMENTS)
    path = path_of(node.children[0])
    frames = _frames(node, path, tolerance / 2, radius, segments=segments, mitred=False)
    _check_size(node, frames, around)
    angle = 2.0 * np.pi * np.arange(around) / around
    circle = np.column_stack((np.cos(angle), np.sin(angle)))
    ends = _dome(around) if node.rounded else np.zeros((0, 2))
    try:
        if bore and not len(ends) and not frames.corners.any():
            ring = Ring.of_loops([radius * circle, bore * circle[::-1]])
            rings = _placed(frames, ring.points[None])
            if not crossings(rings, frames.axes[:, 2]).any():
                return _along(frames, rings, ring).as_original()
        solid = _round_bar(frames, radius * circle, radius * ends)
        if bore:
            over = np.array([[radius * (OVERSHOOT + bool(len(ends))), bore]])
            solid = solid - _round_bar(frames, bore * circle, over)
    except NoSolid as fault:
        raise NoSolid(f"Pipe: {fault}") from None
    return solid.as_original()


def _frames(node: Sweep | Pipe, path: Path, tolerance: float, reach: float, **more: Any) -> Frames:
    try:
        return path_frames(path, tolerance, reach, **more)
    except Refusal as fault:
        raise NoSolid(f"{node.title}: {fault}") from None


def _check_size(node: Sweep | Pipe, frames: Frames, points: int) -> None:
    try:
        check_size(len(frames.origins), points)
    except NoSolid as fault:
        raise NoSolid(f"{node.title}: {fault}") from None


def _twist_step(segments: int | None, tolerance: float, reach: float, wall: float) -> float:
    """The greatest angle between two rings of a twisted sweep, in radians.

    A point at the distance r that turns by a is r a² / 8 away from its chord, and a wall of length L is L a / 4 away
    from its two triangles.
    """
    if segments is not None:
        return 2.0 * math.pi / segments
    a, b = reach / 8.0, wall / 4.0
    return 2.0 * tolerance / (b + math.sqrt(b * b + 4.0 * a * tolerance))


def _placed(frames: Frames, flat: Floats) -> Floats:
    """(n, m, 3) outlines (n, m, 2), or one (1, m, 2), in the frames."""
    return frames.origins[:, None] + flat @ frames.axes[:, :2]


def _wrapped(ring: Ring, twist: float) -> Numbers:
    """(m,) the points on which those of an outline come to lie that is turned by `twist` radians. Raises NoSolid."""
    from scipy.spatial import KDTree

    cosine, sine = math.cos(twist), math.sin(twist)
    turned = ring.points @ np.array([[cosine, sine], [-sine, cosine]])
    distance, found = KDTree(ring.points).query(turned)
    place = np.asarray(found, np.int64)
    if np.max(distance) > ALIKE * ring.reach or len(np.unique(place)) < len(place):
        raise NoSolid(f"Sweep: the path is closed, but turned by {math.degrees(twist):g}° the outline is not what it "
                      "was at the start; take a twist that brings it back to itself")  # fmt: skip
    return place


def _dome(around: int) -> Floats:
    """(k, 2) how far before its end a half ball of radius 1 has a ring, and of what radius; the tip first."""
    count = max(around // 4, 2)
    angle = 0.5 * np.pi * np.arange(count, 0, -1) / count
    rows = np.column_stack((np.sin(angle), np.cos(angle)))
    rows[0, 1] = 0.0
    return rows


def _along(frames: Frames, rings: Floats, ring: Ring) -> Manifold:
    wrap = None
    if frames.closed:
        wrap = np.arange(len(ring.points))
        rings[-1] = rings[0]
    return bar(rings, frames.axes[:, 2], ring, frames.lengths, np.zeros(len(rings), bool), wrap)


def _round_bar(frames: Frames, circle: Floats, ends: Floats) -> Manifold:
    """A bar of a circle (m, 2) along frames that are not mitred, balls at its corners.

    `ends` (k, 2) are how far beyond the ends of the path more rings stand, and their radii, the outermost first.
    """
    ring = Ring.of_loops([circle])
    rings = _placed(frames, circle[None])
    joints = np.flatnonzero(frames.corners[:-1] & frames.corners[1:] & (np.diff(frames.lengths) == 0.0)) + 1
    seam = frames.closed and bool(frames.corners[0])
    if frames.closed and not seam and not len(joints):
        return _along(frames, rings, ring)
    radius = float(np.hypot(*circle[0]))
    parts = []
    spans = np.split(np.arange(len(rings)), joints)
    for number, span in enumerate(spans):
        made, normals, lengths = rings[span], frames.axes[span, 2], frames.lengths[span]
        for last in (False, True):
            if frames.closed or not len(ends) or number != (len(spans) - 1 if last else 0):
                continue
            end = -1 if last else 0
            centre, along = frames.origins[span[end]], normals[end]
            spokes = (made[end] - centre) / radius
            far = ends[:, :1] * (along if last else -along)
            more = centre + far[:, None] + ends[:, 1, None, None] * spokes
            repeated = np.repeat(normals[end][None], len(more), axis=0), np.repeat(lengths[end], len(more))
            if last:
                made, normals = np.concatenate((made, more[::-1])), np.concatenate((normals, repeated[0]))
                lengths = np.concatenate((lengths, repeated[1]))
            else:
                made, normals = np.concatenate((more, made)), np.concatenate((repeated[0], normals))
                lengths = np.concatenate((repeated[1], lengths))
        parts.append(bar(made, normals, ring, lengths, np.zeros(len(made), bool)))
    for after in [*joints.tolist(), *([0] if seam else [])]:
        parts.append(_elbow(rings[after - 1], frames.axes[[after - 1, after], 2], frames.origins[after]))
    return united(parts)


def _elbow(ring: Floats, normals: NDArray[np.float64], centre: Floats) -> Manifold:
    """What a ring (m, 3) about the corner of a bar covers as it turns from one direction to the other, and a bit more
    of the ball about the corner, which the bar covers."""
    before, after = normals
    spokes = ring - centre
    axis = np.cross(before, after)
    size = float(np.linalg.norm(axis))
    angle = math.atan2(size, float(before @ after))
    axis = axis / size if size > ALIKE else spokes[0] / np.linalg.norm(spokes[0])
    steps = max(math.ceil(angle * len(ring) / (2.0 * math.pi) - 1e-6), 1)
    turn = angle * np.arange(steps + 1)[:, None, None] / steps
    across = np.cross(axis, spokes)
    along = (spokes @ axis)[:, None] * axis
    turned = along + np.cos(turn) * (spokes - along) + np.sin(turn) * across
    return Manifold.hull_points(np.concatenate(centre + turned))
