"""Outlines drawn up with leaning walls: the roof over the straight skeleton, cut off at the height.

Each side of the outline makes one flat wall, whatever the corners beside it do on the way up; and an upright one below
it, where the roof stands on walls.
"""

from __future__ import annotations

import numpy as np
from manifold3d import CrossSection, Error, FillRule, Manifold, Mesh64, triangulate
from numpy.typing import NDArray

from ..failure import NoSolid
from .wavefront import Wavefront

Floats = NDArray[np.float64]

SAME = 1e-9
"""Corners nearer to each other than this share of the outline's size are one."""
SOUND = 1e-6
"""Share of the outline's area by which walls or the lid may overlap."""
MOVED = (0.0, 1e-7, 1e-6, 1e-6, 1e-5, 1e-5)
"""Shares of the outline's size by which its corners are moved, one attempt after the other: so what happens at once, as
in a ring whose walls meet all around, happens in some order."""


def tapered(section: CrossSection, height: float, slope: float, upright: float = 0.0) -> Manifold:
    """The solid over a section whose walls move inwards by `slope` mm for each mm of the height; outwards below 0.

    `upright` is how high the walls stand straight before they lean, which comes to the height. It ends below that
    where the walls have met everywhere. All in mm; the section lies at z = 0. Raises NoSolid.
    """
    size = float(np.ptp(np.reshape(section.bounds(), (2, 2)), axis=0).max())
    rings = _rings(section, size)
    if not rings:
        raise NoSolid("Extrusion: the outline encloses nothing")
    random = np.random.default_rng(0)
    for moved in MOVED:
        shaken = [ring + random.uniform(-moved, moved, ring.shape) * size for ring in rings]
        solid = _roof(shaken, height, slope, upright)
        if solid is not None:
            return solid
    raise NoSolid("Extrusion: the outline is too intricate for leaning walls: give it a coarser tolerance")


def _roof(rings: list[Floats], height: float, slope: float, upright: float) -> Manifold | None:
    """The solid, or None where so much happens at once that rounding has taken it in the wrong order."""
    side, end = np.sign(slope) or 1.0, abs(slope) * height
    wave = Wavefront(rings, side)
    if not wave.run(end):
        return None
    nodes = np.array(wave.nodes)
    slack = SOUND * sum(map(_area, rings))
    if wave.lid:
        left = CrossSection([np.ascontiguousarray(nodes[ring, :2]) for ring in wave.lid], FillRule.Positive).area()
        if abs(left - sum(_area(nodes[ring]) for ring in wave.lid)) > slack:
            return None
    nodes[:, 2] *= height / end
    walls = np.concatenate(_walls(wave, nodes))
    a, b, c = np.moveaxis(nodes[walls, :2], 1, 0)
    covered = side * ((b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0]))
    # From above, walls over a simple outline cover each place once exactly where none of them is upside down.
    if covered[covered < 0.0].sum() < -slack:
        return None
    floor = np.asarray(triangulate(rings, 0.0), np.int64)[:, ::-1]
    faces = [walls, *_lid(wave, nodes)]
    if upright:
        foot = np.arange(len(wave.along))  # the corners of the rings are the first nodes
        floor_nodes = nodes[foot]
        nodes[:, 2] += upright
        nodes = np.concatenate([nodes, floor_nodes])
        low, after = foot + len(nodes) - len(foot), _followers(rings)
        faces += [np.column_stack((low, low[after], after)), np.column_stack((low, after, foot)), floor + low[0]]
    else:
        faces.append(floor)
    solid = Manifold(Mesh64(nodes, np.concatenate(faces).astype(np.uint64)))
    return solid if solid.status() == Error.NoError and solid.volume() > 0.0 else None


def _rings(section: CrossSection, size: float) -> list[Floats]:
    """Its contours without corners that are one with the next, or that lie on a straight side."""
    found = []
    for polygon in section.simplify(SAME * size).to_polygons():
        ring = np.asarray(polygon, float)
        ring = ring[np.linalg.norm(ring - np.roll(ring, 1, axis=0), axis=1) > SAME * size]
        if len(ring) >= 3:
            found.append(ring)
    return found


def _followers(rings: list[Floats]) -> NDArray[np.int64]:
    """(k,) the number of the corner after each, of all the rings' in a row."""
    ends = np.cumsum([len(ring) for ring in rings])
    after = np.arange(1, ends[-1] + 1)
    after[ends - 1] = np.append(0, ends[:-1])
    return after


def _area(ring: Floats) -> float:
    x, y = ring[:, 0], ring[:, 1]
    return 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))


def _walls(wave: Wavefront, nodes: Floats) -> list[NDArray[np.int64]]:
    """The triangles of each wall, (k, 3) numbers of nodes."""
    onwards: list[dict[int, list[int]]] = [{} for _ in wave.along]
    for face, begin, end in wave.arcs:
        onwards[face].setdefault(begin, []).append(end)
    return [
        _filled([np.column_stack((nodes[loop, :2] @ along, nodes[loop, 2])) for loop in loops], loops)
        for along, arcs in zip(wave.along, onwards, strict=True)
        if (loops := _loops(arcs))
    ]


def _lid(wave: Wavefront, nodes: Floats) -> list[NDArray[np.int64]]:
    return [_filled([nodes[ring, :2] for ring in wave.lid], wave.lid)] if wave.lid else []


def _loops(onwards: dict[int, list[int]]) -> list[list[int]]:
    """Rings of nodes, from each node's followers; every arc is in one of them."""
    loops = []
    while onwards:
        first = here = next(iter(onwards))
        loop = []
        while True:
            loop.append(here)
            followers = onwards[here]
            there = followers.pop()
            if not followers:
                del onwards[here]
            here = there
            if here == first:
                break
        loops.append(loop)
    return loops


def _filled(flat: list[Floats], loops: list[list[int]]) -> NDArray[np.int64]:
    """Triangles (k, 3), as numbers of nodes, of loops given in the plane as well."""
    numbers = np.concatenate(loops)
    corners = np.asarray(triangulate([np.ascontiguousarray(points) for points in flat], 0.0), np.int64)
    return numbers[corners.reshape(-1, 3)]
