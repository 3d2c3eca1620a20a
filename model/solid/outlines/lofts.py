"""Solids stretched over outlines that stand in space."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from manifold3d import Manifold, triangulate
from numpy.typing import NDArray

from ...document.from_outlines import Loft
from ...document.nodes import Node
from ...document.placement import Placement
from ..failure import NoSolid
from ..maps import placed_tolerance
from .drawn import drawn_solid
from .rings import MOST_POINTS, Floats, Numbers, edges_of, stretched
from .sections import section_of

SAMPLES = 1024
"""Even places around a loop at which it is laid against another."""
SHARP = 30.0
"""Degrees of a corner that is to meet a corner."""
MOST_PAIRS = 4_000_000
SAME = 1e-9
"""Share of a loop's length within which two places on it are one."""
THIN = 1e-9
"""Share of the room that a loft takes below which it encloses nothing."""


@dataclass(frozen=True, slots=True, eq=False)
class _Loop:
    """A border of an outline in space, run through as all of the loft are, from a start of its own."""

    flat: Floats  # (k, 2) in the outline's own axes
    points: Floats  # (k, 3)
    area: float  # mm², of the flat one; below 0 for a hole
    begin: float = 0.0  # share of the length at which it begins

    @property
    def places(self) -> Floats:
        """(k,) from 0 to 1: where its points lie along it."""
        return self._lengths()[:-1] / self._lengths()[-1]

    @property
    def sharp(self) -> NDArray[np.bool_]:
        """(k,) where it turns by more than SHARP degrees."""
        side = np.roll(self.points, -1, axis=0) - self.points
        side /= np.linalg.norm(side, axis=1)[:, None]
        return (side * np.roll(side, 1, axis=0)).sum(axis=1) < np.cos(np.radians(SHARP))

    def _lengths(self) -> Floats:
        sides = np.linalg.norm(np.roll(self.points, -1, axis=0) - self.points, axis=1)
        return np.concatenate([[0.0], np.cumsum(sides)])

    def at(self, places: Floats) -> tuple[Floats, Floats]:
        """(m, 2) and (m, 3) points at shares of the length after its start."""
        share = self._lengths() / self._lengths()[-1]
        where = np.mod(places + self.begin, 1.0)
        first = np.clip(np.searchsorted(share, where, "right") - 1, 0, len(self.points) - 1)
        part = ((where - share[first]) / (share[first + 1] - share[first]))[:, None]
        second = (first + 1) % len(self.points)
        flat, points = ((1.0 - part) * ring[first] + part * ring[second] for ring in (self.flat, self.points))
        return flat, points


@drawn_solid.register
def solid_of_loft(node: Loft, tolerance: float) -> Manifold:
    tolerance = tolerance if node.tolerance is None else float(node.tolerance)  # type: ignore[arg-type]
    count = len(node.children)
    if node.closed and count < 3:
        raise NoSolid(f"Loft: a closed one needs three outlines or more; there are {count}")
    outlines = _facing(node, [_loops(child, number, tolerance / 2) for number, child in enumerate(node.children, 1)])
    outlines = _aligned(_paired(outlines))
    flats, rings = [], []
    sizes = []
    for loops in zip(*outlines, strict=True):
        places = _common(loops)
        sizes.append(len(places))
        flat, ring = zip(*(loop.at(places) for loop in loops), strict=True)
        flats.append(flat)
        rings.append(np.stack(ring))
    stand = np.concatenate(rings, axis=1)
    _refuse_crossings(stand, node.closed)
    edges = edges_of(sizes)
    stand = _between(stand, edges, node, tolerance / 2)
    try:
        if node.closed:
            solid = stretched(stand, edges, None, np.arange(stand.shape[1]))
        else:
            caps = [_cap([flat[end] for flat in flats]) for end in (0, -1)]
            solid = stretched(stand, edges, (caps[0], caps[1]))
    except NoSolid as fault:
        raise NoSolid(f"Loft: {fault}") from None
    low, high = stand.min(axis=(0, 1)), stand.max(axis=(0, 1))
    if solid.volume() <= THIN * float(np.linalg.norm(high - low)) ** 3:
        raise NoSolid("Loft: nothing lies between the outlines; move them apart, or give them another order")
    return solid.as_original()


def _loops(outline: Node, number: int, tolerance: float) -> list[_Loop]:
    matrix = outline.placement.matrix()
    section = section_of(outline.with_(placement=Placement()), placed_tolerance(tolerance, outline.placement))
    if section.is_empty():
        raise NoSolid(f"Loft: outline {number} encloses nothing")
    found = []
    for flat in section.to_polygons():
        x, y = flat.T
        area = 0.5 * float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum())
        found.append(_Loop(flat, flat @ matrix[:, :2].T + matrix[:, 3], area))
    return sorted(found, key=lambda loop: -loop.area)


def _facing(node: Loft, outlines: list[list[_Loop]]) -> list[list[_Loop]]:
    """The outlines, those turned round that face against the way the loft goes there."""
    middles = np.array([loops[0].points.mean(axis=0) for loops in outlines])
    if node.closed:
        ways = np.roll(middles, -1, axis=0) - np.roll(middles, 1, axis=0)
    else:
        steps = np.diff(middles, axis=0)
        ways = np.concatenate([steps[:1], steps[:-1] + steps[1:], steps[-1:]])
    found: list[list[_Loop]] = []
    before = None
    for loops, way in zip(outlines, ways, strict=True):
        points = loops[0].points - loops[0].points.mean(axis=0)
        facing = 0.5 * np.cross(points, np.roll(points, -1, axis=0)).sum(axis=0)
        onwards = float(facing @ way)
        if abs(onwards) <= SAME * np.linalg.norm(facing) * np.linalg.norm(way) and before is not None:
            onwards = float(facing @ before)
        if onwards < 0.0:
            loops = [_Loop(loop.flat[::-1] * (-1.0, 1.0), loop.points[::-1], loop.area) for loop in loops]
        before = facing if onwards >= 0.0 else -facing
        found.append(loops)
    return found


def _paired(outlines: list[list[_Loop]]) -> list[list[_Loop]]:
    """The loops of each outline in the order of those of the first: borders with borders, holes with holes, those of
    like place and size together."""
    found = [outlines[0]]
    for number, loops in enumerate(outlines[1:], 2):
        before = found[-1]
        holes = [[loop.area < 0.0 for loop in each] for each in (before, loops)]
        if holes[0] != holes[1]:
            told = [f"{_counted(len(each) - sum(each), 'border')} and {_counted(sum(each), 'hole')}" for each in holes]
            raise NoSolid(f"Loft: outline {number} has {told[1]}, but outline {number - 1} has {told[0]}; they must "
                          "have as many")  # fmt: skip
        if max(sum(holes[0]), len(loops) - sum(holes[0])) == 1:
            found.append(loops)
            continue
        from scipy.optimize import linear_sum_assignment

        middle = [np.array([loop.points.mean(axis=0) for loop in each]) for each in (before, loops)]
        middle = [each - each.mean(axis=0) for each in middle]
        size = [np.sqrt(np.abs([loop.area for loop in each])) for each in (before, loops)]
        cost = np.linalg.norm(middle[0][:, None] - middle[1], axis=2) + np.abs(size[0][:, None] - size[1])
        cost[np.not_equal.outer(holes[0], holes[1])] = 1e3 * (cost.max() + 1.0) * len(loops)
        found.append([loops[place] for place in linear_sum_assignment(cost)[1].tolist()])
    return found


def _counted(count: int, word: str) -> str:
    return f"{count} {word}{'' if count == 1 else 's'}"


def _aligned(outlines: list[list[_Loop]]) -> list[list[_Loop]]:
    """Each loop with the start that brings it nearest to the one before it."""
    found = [outlines[0]]
    for loops in outlines[1:]:
        found.append([
            _Loop(loop.flat, loop.points, loop.area, _start(before, loop))
            for before, loop in zip(found[-1], loops, strict=True)
        ])  # fmt: skip
    return found


def _start(before: _Loop, loop: _Loop) -> float:
    """Where a loop begins so that the squares of its distances from another are least, about their middles.

    Where both have sharp corners, of the shifts that bring one of these to another; else of all, and as near to it as
    brings a point to a point.
    """
    even = np.arange(SAMPLES) / SAMPLES
    first, second = (each.at(even)[1] for each in (before, loop))
    first, second = first - first.mean(axis=0), second - second.mean(axis=0)
    spectrum = np.conj(np.fft.rfft(first, axis=0)) * np.fft.rfft(second, axis=0)
    likeness = np.fft.irfft(spectrum.sum(axis=1), SAMPLES)  # of all shifts by whole samples
    sharp = before.sharp, loop.sharp
    both = bool(sharp[0].any() and sharp[1].any())
    here, there = (each.places[corner] if both else each.places
                   for each, corner in zip((before, loop), sharp, strict=True))  # fmt: skip
    coarse = int(np.argmax(likeness)) / SAMPLES
    if len(here) * len(there) > MOST_PAIRS:
        return coarse
    shifts = np.mod(there[:, None] - np.mod(here - before.begin, 1.0), 1.0).ravel()
    if not both:
        shifts = shifts[np.abs(np.mod(shifts - coarse + 0.5, 1.0) - 0.5) <= 1.0 / SAMPLES]
        if not len(shifts):
            return coarse
    return float(shifts[np.argmax(np.interp(shifts, even, likeness, period=1.0))])


def _common(loops: tuple[_Loop, ...]) -> Floats:
    """(m,) shares of the lengths, from the starts, at which some of the loops has a point."""
    places = np.sort(np.concatenate([np.mod(loop.places - loop.begin, 1.0) for loop in loops]))
    places = places[np.append(True, np.diff(places) > SAME)]
    return places[:-1] if len(places) > 3 and places[0] + 1.0 - places[-1] <= SAME else places


def _cap(loops: list[Floats]) -> Numbers:
    return np.asarray(triangulate([np.ascontiguousarray(loop) for loop in loops]), np.int64)


def _refuse_crossings(stand: Floats, closed: bool) -> None:
    """Outlines (n, m, 3) of which one goes through the next make no solid: each reaches to both sides of the other's
    plane, in the same stretch of the line that the planes share."""
    following = np.roll(stand, -1, axis=0) if closed else stand[1:]
    for number, (here, there) in enumerate(zip(stand, following, strict=False), 1):
        planes = []
        for ring in (here, there):
            middle = ring.mean(axis=0)
            planes.append((np.linalg.svd(ring - middle, full_matrices=False)[2][2], middle))
        shared = np.cross(planes[0][0], planes[1][0])
        spans = []
        for ring, (normal, middle) in ((here, planes[1]), (there, planes[0])):
            height = (ring - middle) @ normal
            least = SAME * float(np.ptp(stand, axis=(0, 1)).max())
            if height.min() > -least or height.max() < least:
                break
            along = ring @ shared
            crossing = np.flatnonzero(np.sign(height) != np.sign(np.roll(height, -1)))
            after = (crossing + 1) % len(ring)
            part = height[crossing] / (height[crossing] - height[after])
            met = (1.0 - part) * along[crossing] + part * along[after]
            spans.append((met.min(), met.max()))
        if len(spans) == 2 and max(spans[0][0], spans[1][0]) < min(spans[0][1], spans[1][1]):
            raise NoSolid(f"Loft: outlines {number} and {number % len(stand) + 1} cross each other; move them apart")


def _between(stand: Floats, edges: Numbers, node: Loft, tolerance: float) -> Floats:
    """(k, m, 3) the outlines and what is between them, within a tolerance; of a closed loft the first one again.

    Two triangles leave a ruled side by a quarter of its twist, across it; a curve of second derivative c leaves a chord
    of step h by c h² / 8.
    """
    if node.closed:
        stand = np.concatenate((stand, stand[:1]))
    begin, end = stand[:, edges[:, 0]], stand[:, edges[:, 1]]
    normal = np.cross(end[1:] - begin[:-1], begin[1:] - end[:-1])
    size = np.linalg.norm(normal, axis=2)
    bend = ((begin[:-1] - end[:-1] + end[1:] - begin[1:]) * normal).sum(axis=2)
    twist = np.abs(np.divide(bend, size, out=np.zeros_like(size), where=size > 0.0)).max(axis=1)
    curve, knots = None, np.arange(len(stand), dtype=float)
    # A smooth loft shares its tolerance between the twist and the bend.
    wanted = twist / (4.0 * tolerance)
    if node.smooth and len(stand) > 2:
        from scipy.interpolate import CubicSpline

        gaps = np.sqrt((np.diff(stand, axis=0) ** 2).sum(axis=2).mean(axis=1))
        if gaps.min() <= SAME * gaps.max():
            place = int(np.argmin(gaps)) + 1
            raise NoSolid(f"Loft: outlines {place} and {place % len(node.children) + 1} lie on one another")
        knots = np.concatenate([[0.0], np.cumsum(gaps)])
        curve = CubicSpline(knots, stand, bc_type="periodic" if node.closed else "natural")
        curved = np.linalg.norm(curve(knots, 2), axis=2).max(axis=1)
        curved = np.maximum(curved[:-1], curved[1:])
        wanted = np.maximum(2.0 * wanted, gaps * np.sqrt(curved / (4.0 * tolerance)))
    steps = np.maximum(np.ceil(np.minimum(wanted, MOST_POINTS) - 1e-9), 1.0).astype(np.int64)
    if steps.sum() * stand.shape[1] > MOST_POINTS:
        raise NoSolid(f"Loft: it would have {steps.sum() * stand.shape[1]:,} points; take a coarser tolerance")
    first = np.repeat(np.arange(len(steps)), steps)
    share = (np.arange(len(first)) - np.repeat(np.cumsum(steps) - steps, steps)) / np.repeat(steps, steps)
    if curve is not None:
        found = np.append(curve(knots[first] + share * np.diff(knots)[first]), stand[-1:], axis=0)
        found[np.cumsum([0, *steps[:-1]])] = stand[:-1]
        return found
    share = share[:, None, None]
    return np.append((1.0 - share) * stand[first] + share * stand[first + 1], stand[-1:], axis=0)
