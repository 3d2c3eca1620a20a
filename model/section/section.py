"""Cuts a closed surface with a plane: the exact outline in the plane, with what made each of its sides."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..document.errors import Refusal

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

ROUNDINGS = 16
"""A vertex nearer to the plane than so many roundings of the largest coordinate lies in it."""
STRAIGHT = 1e-12
"""A corner that lies nearer than this to the chord of its neighbours is none; of the outline's largest coordinate."""


@dataclass(frozen=True, slots=True)
class Plane:
    """A plane with axes of its own, looked at against its normal, which points to the viewer.

    `u` goes to the right and `v` up: v lies towards the world's z, so that the plane z = c has u = x and v = y, and
    walls are drawn upright (seen from the front u = x, v = z; from the right u = y, v = z). The origin is the point of
    the plane nearest to the world's, so that for standard planes u and v are the world's own coordinates.
    """

    normal: tuple[float, float, float]
    offset: float
    """Of the plane from the world's origin, along the normal, in millimetres."""
    u: tuple[float, float, float]
    v: tuple[float, float, float]

    @property
    def axes(self) -> Floats:
        """(3, 3): u, v and the normal as rows; right-handed."""
        return np.array([self.u, self.v, self.normal])

    def heights(self, points: NDArray[np.floating]) -> Floats:
        """(n,) millimetres of points (n, 3) above the plane; equal points have equal heights, to the last bit."""
        x, y, z = np.asarray(points, np.float64).T  # no matrix product: its rounding depends on the place in the array
        return x * self.normal[0] + y * self.normal[1] + z * self.normal[2] - self.offset

    def flat(self, points: ArrayLike) -> Floats:
        """(n, 2) the plane's coordinates of points (n, 3), seen along the normal."""
        return np.asarray(points, float).reshape(-1, 3) @ self.axes[:2].T

    def world(self, flat: ArrayLike) -> Floats:
        """(n, 3) the points of the plane with these coordinates (n, 2)."""
        return np.asarray(flat, float).reshape(-1, 2) @ self.axes[:2] + self.offset * np.asarray(self.normal)


def plane_through(point: Sequence[float], normal: Sequence[float]) -> Plane:
    """The plane through a point (mm) that faces where the normal points. Raises Refusal where that is no direction."""
    x, y, z = (float(number) for number in normal)
    size = math.hypot(x, y, z)
    if not (1e-150 < size < 1e150 and all(math.isfinite(float(number)) for number in point)):
        raise Refusal(f"a plane needs a point and a direction, not {tuple(point)} and {tuple(normal)}")
    n = np.array([x, y, z]) / size + 0.0
    right = np.array([-n[1], n[0], 0.0])  # up × n
    sloped = float(np.linalg.norm(right))
    u = np.array([1.0, 0.0, 0.0]) if sloped < 1e-9 else right / sloped + 0.0
    if sloped < 1e-9:
        n = np.array([0.0, 0.0, math.copysign(1.0, n[2])])
    v = np.cross(n, u) + 0.0
    return Plane(_three(n), float(n @ np.asarray(point, float)), _three(u), _three(v))


@dataclass(frozen=True, eq=False)
class SectionOutline:
    """Closed contours in a plane; outer ones go counter-clockwise as seen against the normal, holes clockwise.

    The points of contour c are `points[starts[c] : starts[c + 1]]`, and `owners` tells for the side that begins at
    each point which owner of the surface was cut there.
    """

    plane: Plane
    points: Floats = field(default_factory=lambda: np.zeros((0, 2)))  # (p, 2) mm
    starts: Indices = field(default_factory=lambda: np.zeros(1, np.int64))  # (c + 1,)
    owners: NDArray[np.int32] = field(default_factory=lambda: np.zeros(0, np.int32))  # (p,)

    @property
    def contours(self) -> tuple[Floats, ...]:
        """Each contour's corners (k, 2) in plane coordinates; the last joins the first."""
        return tuple(np.split(self.points, self.starts[1:-1])) if len(self.starts) > 1 else ()

    @property
    def contours_3d(self) -> tuple[Floats, ...]:
        """Each contour's corners (k, 3) in the world's axes."""
        return tuple(self.plane.world(contour) for contour in self.contours)

    @cached_property
    def following(self) -> Indices:
        """(p,) for each point the index of the next one on its contour."""
        following = np.arange(1, len(self.points) + 1)
        following[self.starts[1:] - 1] = self.starts[:-1]
        return following

    @cached_property
    def areas(self) -> Floats:
        """(c,) the signed area of each contour in mm²; holes have negative ones."""
        if not len(self.points):
            return np.zeros(0)
        middle = self.points.mean(axis=0)  # keeps the products small
        a = self.points - middle
        b = a[self.following]
        return np.add.reduceat(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], self.starts[:-1]) / 2.0

    @property
    def area(self) -> float:
        """mm², holes left out."""
        return float(self.areas.sum())

    @property
    def perimeter(self) -> float:
        """mm, the rims of holes included."""
        return float(np.linalg.norm(self.points[self.following] - self.points, axis=1).sum())

    @property
    def centroid(self) -> tuple[float, float] | None:
        """Of the area, in plane coordinates; None where there is none."""
        if not len(self.points) or self.area == 0.0:
            return None
        middle = self.points.mean(axis=0)
        a = self.points - middle
        b = a[self.following]
        twice = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
        u, v = (a + b).T @ twice / (6.0 * self.area) + middle
        return float(u), float(v)

    @property
    def bounds(self) -> Floats | None:
        """(2, 2) in plane coordinates; None where the plane misses."""
        return np.array([self.points.min(axis=0), self.points.max(axis=0)]) if len(self.points) else None

    @cached_property
    def parents(self) -> Indices:
        """(c,) the contour right around each contour, -1 for the outermost; outer and holes take turns."""
        contours, areas = self.contours, np.abs(self.areas)
        parents = np.full(len(contours), -1, np.int64)
        if len(contours) < 2:
            return parents
        low = np.minimum.reduceat(self.points, self.starts[:-1])
        high = np.maximum.reduceat(self.points, self.starts[:-1])
        order = np.argsort(areas, kind="stable")
        for place, inner in enumerate(order):
            probe = _on_longest_side(contours[inner])
            larger = order[place + 1 :]
            around = larger[((low[larger] <= probe) & (probe <= high[larger])).all(axis=1)]
            # Contours turn about when one goes inward, so a hole's parent is outer and the other way round.
            around = around[self.areas[around] * self.areas[inner] < 0.0]
            parents[inner] = next((o for o in around if _holds(contours[o], probe[None])[0]), -1)
        return parents

    @property
    def regions(self) -> list[tuple[int, list[int]]]:
        """Each outer contour with the holes in it, as indices."""
        holes: dict[int, list[int]] = {int(i): [] for i in np.flatnonzero(self.areas > 0.0)}
        for hole in np.flatnonzero(self.areas <= 0.0):
            holes.get(int(self.parents[hole]), []).append(int(hole))
        return list(holes.items())

    def holds(self, flat: ArrayLike) -> NDArray[np.bool_]:
        """(n,) whether points (n, 2) lie inside, by the even-odd rule."""
        wanted = np.asarray(flat, float).reshape(-1, 2)
        return _crossings(self.points, self.points[self.following], wanted) % 2 == 1

    @cached_property
    def triangles(self) -> NDArray[np.int32]:
        """(t, 3) the area as triangles, counter-clockwise, indices into `points`; by manifold3d's ear clipping."""
        from manifold3d import triangulate

        if not len(self.points):
            return np.zeros((0, 3), np.int32)
        return np.asarray(triangulate(list(self.contours)), np.int32).reshape(-1, 3)

    def save(self, path: str | Path, name: str = "Section") -> None:
        """Write the outline as .svg or .dxf, in millimetres. Raises Refusal."""
        from ..exchange.outlines_out import NamedOutline, write_outlines

        write_outlines(Path(path), [NamedOutline(name, None, self)])


def section(
    points: NDArray[np.floating],
    triangles: NDArray[np.integer],
    point: Sequence[float],
    normal: Sequence[float],
    owner: NDArray[np.integer] | None = None,
) -> SectionOutline:
    """The outline in which the plane through `point` (mm) cuts a closed surface: `points` (n, 3), `triangles` (m, 3).

    The normal points to the viewer (see Plane). A vertex in the plane counts as above it, so the outline is the limit
    from below, and exact: faces, edges and vertices in the plane need no case of their own, and every contour closes
    (simulation of simplicity, Edelsbrunner and Mücke, 1990). Sides are linked triangle by triangle over the edges
    they share, which are told by their ends' places: surfaces split at creases and triangle soup do as well.
    `owner` (m,) tells what made each triangle, and so each side. Raises Refusal where the surface is not closed or no
    plane is given.
    """
    plane = plane_through(point, normal)
    heights = plane.heights(points)
    kind = np.result_type(points, np.float32)
    largest = max(float(points.max(initial=0.0)), -float(points.min(initial=0.0)), abs(plane.offset))
    rounding = ROUNDINGS * float(np.finfo(kind).eps) * largest
    heights[np.abs(heights) <= rounding] = 0.0  # else a sloped face in the plane would be cut by its rounding
    above = heights >= 0.0
    a, b, c = (above[triangles[:, corner]] for corner in range(3))
    cut = np.flatnonzero((a != b) | (b != c))
    if not len(cut):
        return SectionOutline(plane)
    corners = np.asarray(triangles)[cut].astype(np.int64)
    sides = above[corners]
    used, places = np.unique(corners, return_inverse=True)
    weld = _welded(np.asarray(points, np.float64)[used])
    corner_places = weld[places.reshape(-1, 3)]
    rows = np.arange(len(cut))
    turned = np.roll(sides, -1, axis=1)
    down, up = np.argmax(sides & ~turned, axis=1), np.argmax(~sides & turned, axis=1)

    # The side of a triangle begins on the edge that leads down and ends on the one that leads up: inside to its left.
    ends = [(rows, down, (down + 1) % 3), (rows, (up + 1) % 3, up)]  # (row, corner above, corner below)
    keys = [corner_places[r, a] * len(weld) + corner_places[r, b] for r, a, b in ends]
    begin, end = (np.argsort(key, kind="stable") for key in keys)
    if not np.array_equal(keys[0][begin], keys[1][end]):
        raise Refusal("the surface is not closed: a section of it has no area")
    following = np.empty(len(cut), np.int64)
    following[end] = begin
    order, starts = cycles(following)

    top, bottom = corners[rows, down][order], corners[rows, (down + 1) % 3][order]
    share = heights[top] / (heights[top] - heights[bottom])
    flat = plane.flat(points[top])
    flat += share[:, None] * (plane.flat(points[bottom]) - flat)
    owners = np.zeros(len(cut), np.int32) if owner is None else np.asarray(owner)[cut].astype(np.int32)
    return SectionOutline(plane, *_simple(flat, starts, owners[order]))


def cycles(following: Indices) -> tuple[Indices, Indices]:
    """The cycles of a permutation (n,): its items cycle by cycle, in order, and where each begins (c + 1,).

    By pointer jumping (list ranking: Wyllie, 1979), in log n steps over arrays.
    """
    count = len(following)
    rounds = max(1, math.ceil(math.log2(max(count, 2))))
    first, jump = np.arange(count), following.copy()
    for _ in range(rounds):  # the least item of each cycle
        first = np.minimum(first, first[jump])
        jump = jump[jump]
    last = following == first
    left, jump = np.where(last, 0, 1), np.where(last, np.arange(count), following)
    for _ in range(rounds):  # how many steps to its last one
        left = left + left[jump]
        jump = jump[jump]
    order = np.lexsort((-left, first))
    leaders = np.flatnonzero(np.diff(first[order], prepend=-1))
    return order, np.append(leaders, count)


def _simple(flat: Floats, starts: Indices, owners: NDArray[np.int32]) -> tuple[Floats, Indices, NDArray[np.int32]]:
    """Without sides of no length, corners that are none, and contours with fewer than three corners.

    A corner between sides of two owners stays.
    """
    scale = float(np.abs(flat).max(initial=0.0))
    contour = np.repeat(np.arange(len(starts) - 1), np.diff(starts))
    for _ in range(16):
        flat, contour, owners, changed = _thinned(flat, contour, owners, STRAIGHT * scale)
        if not changed:
            break
    size = np.bincount(contour, minlength=len(starts) - 1)
    kept = size >= 3
    inside = kept[contour]
    return flat[inside], np.append(0, np.cumsum(size[kept])), owners[inside]


def _thinned(
    flat: Floats, contour: Indices, owners: NDArray[np.int32], slack: float
) -> tuple[Floats, Indices, NDArray[np.int32], bool]:
    if not len(flat):
        return flat, contour, owners, False
    first = np.flatnonzero(np.diff(contour, prepend=-1))
    size = np.diff(first, append=len(flat))
    ahead = np.arange(1, len(flat) + 1)
    ahead[first + size - 1] = first
    behind = np.empty(len(flat), np.int64)
    behind[ahead] = np.arange(len(flat))
    leaving = flat[ahead] - flat
    length = np.hypot(*leaving.T)
    empty = length <= slack  # the corner ahead takes this one's place
    coming, chord = leaving[behind], flat[ahead] - flat[behind]
    cross = np.abs(coming[:, 0] * leaving[:, 1] - coming[:, 1] * leaving[:, 0])
    straight = (cross <= slack * np.hypot(*chord.T)) & ((coming * leaving).sum(axis=1) > 0.0)
    straight &= owners[behind] == owners
    gone = empty | (straight & ~empty[behind])
    return flat[~gone], contour[~gone], owners[~gone], bool(gone.any())


def _welded(points: Floats) -> Indices:
    """(n,) for each of `points` (n, 3) a number that those in the same place share, below n."""
    x, y, z = (points + 0.0).T  # -0.0 becomes 0.0
    order = np.lexsort((z, y, x))
    ordered = points[order]
    new = np.append(False, (ordered[1:] != ordered[:-1]).any(axis=1))
    weld = np.empty(len(points), np.int64)
    weld[order] = np.cumsum(new)
    return weld


def _on_longest_side(contour: Floats) -> Floats:
    ends = np.roll(contour, -1, axis=0)
    place = int(np.argmax(np.hypot(*(ends - contour).T)))
    return (contour[place] + ends[place]) / 2.0


def _holds(contour: Floats, points: Floats) -> NDArray[np.bool_]:
    return _crossings(contour, np.roll(contour, -1, axis=0), points) % 2 == 1


def _crossings(starts: Floats, ends: Floats, points: Floats) -> Indices:
    """(n,) how many sides a ray from each point towards +u crosses."""
    counts = np.zeros(len(points), np.int64)
    for place, (u, v) in enumerate(points):
        span = (starts[:, 1] > v) != (ends[:, 1] > v)
        a, b = starts[span], ends[span]
        counts[place] = np.count_nonzero(a[:, 0] + (v - a[:, 1]) / (b[:, 1] - a[:, 1]) * (b[:, 0] - a[:, 0]) > u)
    return counts


def _three(values: Floats) -> tuple[float, float, float]:
    return float(values[0]), float(values[1]), float(values[2])
