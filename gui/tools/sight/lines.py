"""The lines that answer about two points, or about a face, put into the picture and into words."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from ....model.measuring.elements import short
from ....render.handles.sight_marks import SightLine, SightMarks

if TYPE_CHECKING:
    from ....model.measuring.sight import SolidRays
    from ....model.partition.rays import Hit
    from ....model.partition.sight import Sight

    Vector = tuple[float, float, float]
    Name = Callable[[SolidRays, Hit], str]

FAR = 0.15  # of the scene's size: how far a ray is drawn that meets nothing


def show_unknown(marks: SightMarks, a: Vector, b: Vector) -> None:
    """The line between two points about which nothing is known yet."""
    start, end = np.array(a), np.array(b)
    marks.show([SightLine(start, end, "unknown")], [start, end])


def show_sight(marks: SightMarks, rays: SolidRays, sight: Sight, name_of: Name) -> str:
    """The line between two points as far as one sees, and what is in the way."""
    start, end = np.array(sight.a), np.array(sight.b)
    length, hit = short(sight.length), sight.obstacle
    if hit is None:
        marks.show([SightLine(start, end, "clear", length)], [start, end])
        return f"Clear: {length} mm"
    name, middle, reach = name_of(rays, hit), np.array(hit.point), short(hit.distance)
    lines = [SightLine(middle, end, "blocked", f"“{name}”")]
    if hit.distance > 0.0:
        lines.append(SightLine(start, middle, "clear", reach))
    marks.show(lines, [start, middle, end], rays.outline(hit))
    return f"“{name}” is in the way: {reach} of {length} mm are clear"


def show_about(
    marks: SightMarks, rays: SolidRays, place: Vector, along: Vector, gap: Hit | None, wall: Hit | None, name_of: Name
) -> str:
    """What stands before a face at a place, `along` its normal, and how thick the wall below it is."""
    point, normal = np.array(place), np.array(along)
    dots, lines = [point], []
    if gap is None:
        lines.append(SightLine(point, point + FAR * rays.rays.size * normal, "clear"))
        words = "Nothing stands before this face"
    else:
        dots.append(np.array(gap.point))
        lines.append(SightLine(point, dots[-1], "clear", short(gap.distance)))
        words = f"“{name_of(rays, gap)}” is {short(gap.distance)} mm before this face"
    if wall is not None:
        dots.append(np.array(wall.point))
        lines.append(SightLine(point, dots[-1], "wall", short(wall.distance)))
        words += f"; the wall is {short(wall.distance)} mm thick"
    marks.show(lines, dots, None if gap is None else rays.outline(gap))
    return words
