"""Solids stretched over rings: an outline that stands at one place after the other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from manifold3d import CrossSection, Error, Manifold, Mesh64, OpType, triangulate
from numpy.typing import NDArray

from ..failure import NoSolid, words

Floats = NDArray[np.float64]
Numbers = NDArray[np.int64]

NEAR = 90.0
"""Degrees; parts of a bar between which it turns by less are neighbours, which do not overlap unless rings cross."""
STILL = 1e-9
"""Share of its size by which every point of a ring has to go on to the next one."""
SPECK = 1e-9
"""Share of a solid's volume."""
MOST_POINTS = 2_000_000
MOST_HULLS = 20_000


@dataclass(frozen=True, slots=True, eq=False)
class Ring:
    """The borders of an outline, outer ones counter-clockwise, holes clockwise, and the triangles that fill it."""

    points: Floats  # (m, 2)
    edges: Numbers  # (m, 2) from each point to the next of its loop
    cap: Numbers  # (c, 3)
    convex: bool

    @classmethod
    def of_section(cls, section: CrossSection) -> Ring:
        return cls.of_loops(section.to_polygons())

    @classmethod
    def of_loops(cls, loops: Sequence[Floats]) -> Ring:
        """From polygons (k, 2). Raises NoSolid for none."""
        if not len(loops):
            raise NoSolid("the outline encloses nothing")
        points = np.concatenate(loops)
        cap = np.asarray(triangulate([np.ascontiguousarray(loop) for loop in loops]), np.int64)
        return cls(points, edges_of([len(loop) for loop in loops]), cap, len(loops) == 1 and _convex(points))

    @property
    def reach(self) -> float:
        """mm from the origin."""
        return float(np.hypot(*self.points.T).max())

    def pieces(self) -> list[Numbers]:
        """Convex parts, each the numbers of its points."""
        return [np.arange(len(self.points))] if self.convex else list(self.cap)


def edges_of(sizes: Sequence[int]) -> Numbers:
    """(m, 2) the edges of loops of so many points each, one after the other."""
    first = np.arange(sum(sizes))
    last = np.cumsum(sizes)
    second = first + 1
    second[last - 1] = last - np.asarray(sizes)
    return np.column_stack((first, second))


def _convex(points: Floats) -> bool:
    side = np.roll(points, -1, axis=0) - points
    after = np.roll(side, -1, axis=0)
    turn = side[:, 0] * after[:, 1] - side[:, 1] * after[:, 0]
    return bool((turn > -1e-12 * (side**2).sum(axis=1).max()).all())


def stretched(
    rings: Floats, edges: Numbers, caps: tuple[Numbers, Numbers] | None, wrap: Numbers | None = None
) -> Manifold:
    """The solid over rings (n, m, 3), closed by caps (c, 3) of the first and the last, both facing onwards.

    With `wrap` (m,) the last ring is the first one again, its point k the first one's point wrap[k]. A ring at an end
    whose points are all one is a tip. Each side is cut along its shorter diagonal. Raises NoSolid.
    """
    count, size = rings.shape[:2]
    number = np.arange(count * size).reshape(count, size)
    if wrap is not None:
        number[-1] = wrap
    else:
        for end in (0, -1):
            if np.ptp(rings[end], axis=0).max() == 0.0:
                number[end] = number[end, 0]
    a, b = number[:-1][:, edges[:, 0]], number[:-1][:, edges[:, 1]]
    c, d = number[1:][:, edges[:, 1]], number[1:][:, edges[:, 0]]
    points = rings.reshape(-1, 3)
    rising = ((points[c] - points[a]) ** 2).sum(axis=2)
    falling = ((points[d] - points[b]) ** 2).sum(axis=2)
    up = (rising <= falling * (1.0 + 1e-9))[..., None]
    sides = np.where(up, np.stack((a, b, c), axis=2), np.stack((a, b, d), axis=2))
    others = np.where(up, np.stack((a, c, d), axis=2), np.stack((b, c, d), axis=2))
    triangles = [sides.reshape(-1, 3), others.reshape(-1, 3)]
    if caps is not None:
        triangles += [number[0][caps[0][:, ::-1]], number[-1][caps[1]]]
    made = np.concatenate(triangles)
    made = made[(made[:, 0] != made[:, 1]) & (made[:, 1] != made[:, 2]) & (made[:, 2] != made[:, 0])]
    used, renumbered = np.unique(made, return_inverse=True)
    mesh = Mesh64(np.ascontiguousarray(points[used]), renumbered.reshape(-1, 3).astype(np.uint64))
    solid = Manifold(mesh)
    if solid.status() != Error.NoError:
        raise NoSolid(words(solid.status()))
    return solid


def bar(rings: Floats, normals: Floats, ring: Ring, lengths: Floats, steep: NDArray[np.bool_],
        wrap: Numbers | None = None) -> Manifold:  # fmt: skip
    """As `stretched`, of rings that may cross each other or come back to where the bar has been: that is joined.

    `normals` (n, 3) are the directions in which the bar goes on, `lengths` (n,) where along the path the rings are,
    `steep` (n,) the mitres, where no ring may cross the next. Raises NoSolid, with the length, where that is so.
    """
    check_size(rings.shape[0], rings.shape[1])
    crossing = crossings(rings, normals)
    fault = crossing & (steep[:-1] | steep[1:])
    pieces = ring.pieces()
    if fault.any() or crossing.sum() * len(pieces) > MOST_HULLS:
        place = int(np.argmax(fault if fault.any() else crossing))
        place += bool(fault.any() and not steep[place])
        raise NoSolid(f"at {lengths[place]:.4g} mm of its length the path bends too tightly for an outline that "
                      f"reaches {ring.reach:.4g} mm from it; make that smaller, or the bend wider")  # fmt: skip
    spans = _apart(rings, normals, crossing, wrap is not None)
    if wrap is not None and spans == [(0, len(rings) - 1)]:
        return stretched(rings, ring.edges, None, wrap)
    parts = [stretched(rings[begin : end + 1], ring.edges, (ring.cap, ring.cap)) for begin, end in spans]
    for place in np.flatnonzero(crossing).tolist():
        onwards = (rings[place + 1] - rings[place]) @ (normals[place] + normals[place + 1])
        for piece in pieces:
            parts += _wedges(rings[place, piece], rings[place + 1, piece], onwards[piece])
    return united(parts)


def check_size(rings: int, points: int) -> None:
    """Raises NoSolid where so many rings of so many points would fill the memory; before they are made."""
    if rings * points > MOST_POINTS:
        raise NoSolid(f"it would have {rings * points:,} points; take a coarser tolerance")


def united(parts: list[Manifold]) -> Manifold:
    """The union of solids that meet in faces and edges, without the specks that rounding leaves there."""
    if len(parts) == 1:
        return parts[0]
    solid = Manifold.batch_boolean(parts, OpType.Add)
    pieces = solid.decompose()
    kept = [piece for piece in pieces if abs(piece.volume()) > SPECK * solid.volume()]
    return solid if len(kept) == len(pieces) else Manifold.compose(kept)


def _wedges(here: Floats, there: Floats, onwards: Floats) -> list[Manifold]:
    """What a convex part of a ring covers on its way to the next, (k, 3) each, on either side of where they cross.

    `onwards` (k,) is how far its points go on, below 0 where they go back: linear over the part.
    """
    after = np.roll(onwards, -1)
    parts = np.flatnonzero(onwards * after < 0.0)
    share = (onwards[parts] / (onwards[parts] - after[parts]))[:, None]
    borders = [(1.0 - share) * ring[parts] + share * np.roll(ring, -1, axis=0)[parts] for ring in (here, there)]
    sides = (onwards >= 0.0, onwards <= 0.0)
    return [
        Manifold.hull_points(np.concatenate((here[side], there[side], *borders)))
        for side in sides if (onwards[side] != 0.0).any()
    ]  # fmt: skip


def crossings(rings: Floats, normals: Floats) -> NDArray[np.bool_]:
    """(n - 1,) whether each ring crosses, or touches, the next: some point of it does not go on."""
    step = np.diff(rings, axis=0)
    least = STILL * np.abs(step).max(axis=(1, 2))
    onwards = np.minimum(np.einsum("nmj,nj->nm", step, normals[:-1]), np.einsum("nmj,nj->nm", step, normals[1:]))
    return onwards.min(axis=1) <= least


def _apart(rings: Floats, normals: Floats, crossing: NDArray[np.bool_], closed: bool) -> list[tuple[int, int]]:
    """First and last rings of parts that overlap nothing within themselves; crossing rings are left out.

    By balls around what is between two rings; those that are near along the bar, within a turn of 90 degrees, do not
    count.
    """
    middles = 0.5 * (rings[:-1] + rings[1:]).mean(axis=1)
    radii = np.sqrt(((np.stack((rings[:-1], rings[1:])) - middles[:, None]) ** 2).sum(axis=3).max(axis=(0, 2)))
    bend = np.linalg.norm(np.diff(normals, axis=0), axis=1)
    turned = np.cumsum(np.degrees(2.0 * np.arcsin(np.minimum(0.5 * bend, 1.0))))
    total = turned[-1] if closed else np.inf
    spans: list[tuple[int, int]] = []
    begin = 0
    for here in range(len(middles)):
        if crossing[here]:
            if here > begin:
                spans.append((begin, here))
            begin = here + 1
            continue
        between = turned[here] - turned[begin:here]
        far = np.minimum(between, total - between) > NEAR
        distance = np.sqrt(((middles[begin:here] - middles[here]) ** 2).sum(axis=1))
        if (far & (distance < radii[begin:here] + radii[here])).any():
            spans.append((begin, here))
            begin = here
    if begin < len(middles):
        spans.append((begin, len(middles)))
    return spans
