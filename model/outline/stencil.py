"""Bridges that hold the counters of an outline, so that nothing falls out where it is cut through."""

from __future__ import annotations

import math

import numpy as np
from manifold3d import CrossSection, FillRule
from numpy.typing import NDArray

from ..document.errors import Refusal
from ..document.outlines import Stencil
from ..path.areas.booleans import combined
from ..path.path import Contour, Kind, Path
from ..solid.failure import NoSolid

Floats = NDArray[np.float64]

OVER = 0.05
"""Share of its width by which a bridge reaches into what it joins."""
FINE = 0.02
"""Share of a bridge's width within which curves are flattened to find its place."""


def bridges(section: CrossSection, node: Stencil) -> list[Floats]:
    """(4, 2) corners of a bar for each bridge, counter-clockwise: what is to be taken out of a section.

    Each hole is joined through its middle along the angle of the node, to the outside or to a hole that is joined, by
    the shortest bridges there are: least spanning tree after Prim 1957. Two for each: the other way as well. Raises
    Refusal.
    """
    width, count = float(node.width), float(node.bridges)  # type: ignore[arg-type]
    if count not in (1.0, 2.0):
        raise Refusal(f"Stencil: each hole has 1 bridge or 2, not {count:g}")
    angle = math.radians(float(node.angle))  # type: ignore[arg-type]
    along = np.array((math.cos(angle), math.sin(angle)))
    turned = np.column_stack((along, (-along[1], along[0])))  # (x, y) @ turned: along the bridges, across them
    rings = [np.asarray(ring, float) @ turned for ring in section.to_polygons()]
    holes = [number for number, ring in enumerate(rings) if _area(ring) < 0.0]
    if not holes:
        return []
    solid = CrossSection([np.ascontiguousarray(ring) for ring in rings], FillRule.Positive)
    ways = [way for hole in holes for way in _ways(rings, holes, hole, solid, width)]
    joined, chosen = {-1}, []
    while len(joined) <= len(holes):
        open_ = [way for way in ways if way[0] not in joined and way[1] in joined]
        if not open_:
            raise Refusal("Stencil: no straight bridge joins every hole to the outside; take another angle")
        best = min(open_, key=lambda way: way[2])
        joined.add(best[0])
        chosen.append(best)
    if count == 2.0:
        chosen += [way for way in ways if not any(way is one for one in chosen)]
    return [bar @ turned.T for *_, bar in chosen]


def stencilled_path(path: Path, node: Stencil) -> Path:
    """The path without the bridges. Raises Refusal."""
    from ..solid.outlines.sections import area_of

    try:
        section = area_of(path, FINE * float(node.width))  # type: ignore[arg-type]
    except NoSolid as fault:
        raise Refusal(f"Stencil: {fault}") from None
    bars = [Contour(np.vstack((bar, bar[:1])), np.full(4, Kind.LINE, np.uint8), True) for bar in bridges(section, node)]
    return combined("difference", [path, Path(tuple(bars))]) if bars else path


def stencilled(section: CrossSection, node: Stencil) -> CrossSection:
    """The section without the bridges. Raises Refusal."""
    bars = bridges(section, node)
    return section - CrossSection([np.ascontiguousarray(bar) for bar in bars], FillRule.NonZero) if bars else section


def _ways(
    rings: list[Floats], holes: list[int], hole: int, solid: CrossSection, width: float
) -> list[tuple[int, int, float, Floats]]:
    """From a hole, what it reaches (a hole, or -1 outside), how long the bridge is, and its bar: one each way."""
    middle = float(rings[hole][:, 1].min() + rings[hole][:, 1].max()) / 2.0
    found = []
    for side in (1.0, -1.0):
        cuts = [np.sort(side * _cut(ring, middle)) for ring in rings]
        begin = float(cuts[hole][-1])
        beyond = min(float(cut[cut > begin][0]) for cut in cuts if (cut > begin).any())
        # The smallest hole around the place behind the wall.
        around = [n for n in holes if np.count_nonzero(cuts[n] > beyond) % 2]
        reached = min(around, key=lambda n: abs(_area(rings[n])), default=-1)
        low, high = sorted((side * begin, side * beyond))
        far = max(float(np.abs(ring).max()) for ring in rings) + width
        strip = CrossSection.square((2.0 * far, width)).translate((-far, middle - width / 2.0)) ^ solid
        for part in strip.decompose():
            first, _, last, _ = part.bounds()
            if first < (low + high) / 2.0 < last:
                low, high = min(low, first), max(high, last)
        low, high = low - OVER * width, high + OVER * width
        x, y = np.array([low, high, high, low]), middle + width / 2.0 * np.array([-1.0, -1.0, 1.0, 1.0])
        found.append((hole, reached, high - low, np.column_stack((x, y))))
    return found


def _cut(ring: Floats, across: float) -> Floats:
    """Where a ring crosses a line along x."""
    begin, end = ring, np.roll(ring, -1, axis=0)
    crossing = (begin[:, 1] > across) != (end[:, 1] > across)
    begin, end = begin[crossing], end[crossing]
    return begin[:, 0] + (across - begin[:, 1]) / (end[:, 1] - begin[:, 1]) * (end[:, 0] - begin[:, 0])


def _area(ring: Floats) -> float:
    x, y = ring[:, 0], ring[:, 1]
    return 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))
