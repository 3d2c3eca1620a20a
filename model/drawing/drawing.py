"""A drawing as a value: lines and areas in the picture's plane, each on the layer of the node that made it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..solid.provenance import Path
from .lines import BORDER, FEATURE, INTERSECTION, KINDS, NO_LINES, OUTLINE, Lines, Polyline, polylines
from .projection import Projection

if TYPE_CHECKING:
    from .scene import Scene
    from .surfaces import Surfaces

__all__ = ["BORDER", "FEATURE", "INTERSECTION", "KINDS", "OUTLINE", "Area", "Drawing", "Layer", "Lines",
           "Polyline", "Progress", "draw", "measured", "polylines"]  # fmt: skip

Floats = NDArray[np.float64]
LIGHTS = (((-0.45, 0.45, 1.0), 0.65), ((0.9, 0.0, 0.5), 0.22), ((-0.1, -1.0, 0.35), 0.16))
"""Directions to the lights in the eye's axes and their strengths, like those of the window."""
AMBIENT = 0.22
Progress = Callable[[str, float], None]
"""Told what is being done and which share of all is done, 0 to 1; may raise to stop."""


@dataclass(frozen=True, slots=True)
class Layer:
    """What one leaf of a solid left in a drawing: `path` are the ids from the root down, `name` is "solid / node"."""

    path: Path
    name: str
    colour: tuple[int, int, int] | None
    """Bytes; None where neither the nodes nor the solid have a colour."""


@dataclass(frozen=True, slots=True, eq=False)
class Area:
    """What is seen of one flat face. Areas of a drawing do not overlap."""

    layer: int
    contours: tuple[Floats, ...]  # (k, 2) each, mm; outer ones counter-clockwise, holes clockwise, first point once
    normal: tuple[float, float, float]
    """Unit, in the world's axes; towards the eye."""
    shade: float
    """How bright the face is, 0 to 1, in a light that comes over the viewer's left shoulder."""

    @property
    def size(self) -> float:
        """mm², holes left out."""
        return float(sum(_signed(contour) for contour in self.contours))


@dataclass(frozen=True, slots=True, eq=False)
class Drawing:
    lines: Lines
    areas: tuple[Area, ...]
    layers: tuple[Layer, ...]
    bounds: Floats  # (2, 2) mm, around all lines and areas; zeros where there are none
    extent: Floats  # (2, 3) mm, around the solids in the world; zeros where there are none
    projection: Projection

    @property
    def empty(self) -> bool:
        return not self.areas and not self.lines.count


def draw(
    scene: Scene, projection: Projection, hidden: bool = True, faces: bool = True, progress: Progress | None = None
) -> Drawing:
    """What is seen of a scene: the areas of its faces, and its edges, the hidden ones as well if they are wanted.

    Lines and areas are right to about a millionth of the picture's size.
    """
    from .coincident import drawn_once
    from .edges import drawable_edges
    from .hidden_lines import hidden_intervals, parted
    from .surfaces import surfaces_of
    from .visible_areas import visible_areas

    told = progress or (lambda label, share: None)
    told("faces and planes", 0.0)
    areas: tuple[Area, ...] = ()
    if faces:
        tree = scene.tree(lambda done, total: told("BSP tree", 0.3 * done / max(total, 1)))
        surfaces = surfaces_of(scene, projection)
        seen = visible_areas(tree, surfaces, lambda share: told("visible faces", 0.3 + 0.3 * share))
        areas = _areas(surfaces, seen)
    else:
        surfaces = surfaces_of(scene, projection)
    told("edges", 0.6)
    edges = drawable_edges(scene, surfaces)
    item, intervals = hidden_intervals(edges, surfaces, lambda share: told("hidden lines", 0.62 + 0.3 * share))
    told("lines that coincide", 0.92)
    ends, edge, is_hidden = parted(edges, item, intervals)
    wanted = ~is_hidden if not hidden else np.ones(len(edge), bool)
    edge = edge[wanted]
    lines = drawn_once(Lines(ends[wanted], edges.kind[edge], is_hidden[wanted], edges.layer[edge].astype(np.int32)))
    points = [lines.ends.reshape(-1, 2), *(contour for area in areas for contour in area.contours)]
    points = np.concatenate(points)
    bounds = np.array([points.min(axis=0), points.max(axis=0)]) if len(points) else np.zeros((2, 2))
    told("done", 1.0)
    return Drawing(lines, areas, scene.layers, bounds, scene.extent, projection)


def measured(scene: Scene, projection: Projection) -> Drawing:
    """A drawing with the bounds that `draw` would give it, and nothing on it: that takes no hidden lines."""
    from .edges import drawable_edges
    from .surfaces import surfaces_of

    points = drawable_edges(scene, surfaces_of(scene, projection)).ends[..., :2].reshape(-1, 2)
    bounds = np.array([points.min(axis=0), points.max(axis=0)]) if len(points) else np.zeros((2, 2))
    return Drawing(NO_LINES, (), scene.layers, bounds, scene.extent, projection)


def _areas(surfaces: Surfaces, seen: list[tuple[int, list[Floats]]]) -> tuple[Area, ...]:
    triangle = np.array([number for number, _ in seen], np.int64)
    plane = surfaces.faces.plane_of[triangle]
    normals = surfaces.faces.planes[plane, :3] * surfaces.facing[plane, None]
    shades = brightness(normals @ surfaces.projection.axes.T).tolist()
    layers = surfaces.layer[triangle].tolist()
    return tuple(
        Area(layer, tuple(contours), tuple(normal), shade)
        for layer, (_, contours), normal, shade in zip(layers, seen, (normals + 0.0).tolist(), shades, strict=True)
    )


def brightness(normals: Floats) -> Floats:
    """(n,) of faces with these normals (n, 3) in the eye's axes, 0 to 1."""
    lit = [part * np.maximum(normals @ np.array(way) / math.hypot(*way), 0.0) for way, part in LIGHTS]
    return np.minimum(AMBIENT + np.sum(lit, axis=0), 1.0)


def _signed(contour: Floats) -> float:
    following = np.roll(contour, -1, axis=0)
    return float((contour[:, 0] * following[:, 1] - contour[:, 1] * following[:, 0]).sum()) / 2.0
