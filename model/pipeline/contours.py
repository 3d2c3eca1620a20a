"""The curves that bound a solid's curved faces and those where they turn away from the eye: as they are, not as chords.

A mesh says which parts of a surface a result has left, and where they end; its edges and the zeros of the angle to the
eye on its triangles (Hertzmann and Zorin 2000) are where the curves run, nearly. Each point is then brought onto the
surfaces themselves, which the leaves' numbers give: rims, the curves where surfaces cross, and silhouettes are exact.
Facets with edges among them, as a cylinder of six segments has them, stand for themselves.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .bending import Conditions, Eye, bent, both, on_surfaces, turning_away
from .round_surfaces import RoundSurfaces

if TYPE_CHECKING:
    from ..solid.display import DisplayMesh

Floats = NDArray[np.float64]
Numbers = NDArray[np.int64]

ALONG = 0.75
"""The cosine, at least, between a facet's normal and that of the surface that it stands for."""
AWAY = 0.15
"""Of a surface's radius: how far the corners of its facets are from it at most."""
MOST_PIECES = 64
"""Of one edge of the mesh."""
REACH = 0.6
"""Of an edge's length: what is moved farther was not meant."""


@dataclass(frozen=True, slots=True, eq=False)
class Curves:
    """`points` (n, 3) and `lines` (m, 2), pairs of them; `source` (m,) is the edge of the mesh, or for silhouettes the
    triangle, that each stands for."""

    points: Floats
    lines: Numbers
    source: Numbers


class Contours:
    """The curves of one closed mesh that knows its round surfaces."""

    def __init__(self, mesh: DisplayMesh, surfaces: RoundSurfaces) -> None:
        self.mesh, self.surfaces = mesh, surfaces
        self.size = max(float(np.linalg.norm(mesh.bounds[1] - mesh.bounds[0])), 1e-300)
        corners = mesh.vertices[mesh.corners]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        self._normals = normal
        self.surface_of = surfaces_of_triangles(mesh, surfaces, corners, normal)
        sides = self.surface_of[mesh.edge_sides]
        angular = np.unique(sides[(sides[:, 0] == sides[:, 1]), 0])  # with edges among its facets, which are meant then
        self.surface_of[np.isin(self.surface_of, angular)] = -1
        self._planes = _planes(mesh.facet, corners, normal)
        # Of each triangle: the curved surface, or behind these the plane of its facet.
        self._number = np.where(self.surface_of >= 0, self.surface_of, surfaces.count + mesh.facet)
        self._beside = beside(mesh.corners.astype(np.int64), len(mesh.vertices))
        self._round: tuple[Numbers, Numbers, Floats, Floats] | None = None
        self._joints: tuple[Numbers, Numbers] | None = None

    def edges(self, fine: float) -> Curves:
        """The feature edges of the mesh: curves within `fine` mm where a curved surface ends, else chords."""
        mesh = self.mesh
        ends = mesh.edges.astype(np.int64)
        sides = self._number[mesh.edge_sides]
        places = mesh.edge_points.astype(np.float64)
        length = np.linalg.norm(places[ends[:, 1]] - places[ends[:, 0]], axis=1)
        curved = (sides.min(axis=1) < self.surfaces.count) & (sides[:, 0] != sides[:, 1])
        longest = np.zeros(len(places))
        np.maximum.at(longest, ends.reshape(-1), np.repeat(length, 2))
        which = _around(ends, sides, len(places))
        moved = np.flatnonzero((which >= 0).any(axis=1) & ((which < self.surfaces.count) & (which >= 0)).any(axis=1))
        places[moved], _ = self._bent(places[moved], REACH * longest[moved], which[moved])
        rows = np.flatnonzero(curved)
        between = places[ends[rows]]
        conditions = on_surfaces(self.surfaces, self._planes, sides[rows])
        inner, pieces = self._pieces(between, conditions, fine)
        count = np.ones(len(ends), np.int64)
        count[rows] = pieces
        return _joined(places, ends, inner, count)

    def silhouette(self, eye: ArrayLike, parallel: bool, fine: float) -> Curves:
        """Where curved faces turn away from the eye, within `fine` mm, and smooth joints of other faces that are seen
        edge-on; no feature edges. `eye` is a point, or with `parallel` the direction towards the eye."""
        at = Eye(np.asarray(eye, np.float64), parallel)
        triangles, corners, places, slope = self._round_points()
        towards = np.einsum("ni,ni->n", slope, at.rays(places))
        seen = (towards > 0.0)[corners]
        change = seen != np.roll(seen, -1, axis=1)
        rows = np.flatnonzero(change.any(axis=1))
        side = np.argsort(~change[rows], axis=1, kind="stable")[:, :2]  # the two that the curve crosses
        first = corners[rows[:, None], side]
        second = corners[rows[:, None], (side + 1) % 3]
        share = towards[first] / (towards[first] - towards[second])
        ends = (places[first] + share[:, :, None] * (places[second] - places[first])).reshape(-1, 3)
        of = np.repeat(self.surface_of[triangles[rows]], 2)
        other = self._beside[triangles[rows][:, None], side].reshape(-1)
        other = np.where(other >= 0, self._number[other], -1)
        which = np.column_stack((of, np.where(other == of, -1, other)))
        reach = np.linalg.norm(places[second] - places[first], axis=2).reshape(-1)
        conditions = both(on_surfaces(self.surfaces, self._planes, which),
                          turning_away(self.surfaces, of, at, self.size))  # fmt: skip
        ends, _ = bent(ends, REACH * reach, self.size, conditions)
        between = ends.reshape(-1, 2, 3)
        own = self.surface_of[triangles[rows]]
        conditions = both(on_surfaces(self.surfaces, self._planes, own[:, None]),
                          turning_away(self.surfaces, own, at, self.size))  # fmt: skip
        inner, pieces = self._pieces(between, conditions, fine)
        curves = _joined(ends, np.arange(len(ends)).reshape(-1, 2), inner, pieces)
        joints = self._flat_silhouette(at)
        return Curves(
            np.concatenate((curves.points, self.mesh.vertices[joints].reshape(-1, 3))),
            np.concatenate((curves.lines, len(curves.points) + np.arange(2 * len(joints)).reshape(-1, 2))),
            np.concatenate((triangles[rows][curves.source], np.full(len(joints), -1))),
        )

    def _bent(self, places: Floats, reach: Floats, which: Numbers) -> tuple[Floats, NDArray[np.bool_]]:
        return bent(places, reach, self.size, on_surfaces(self.surfaces, self._planes, which))

    def _pieces(self, between: Floats, conditions: Conditions, fine: float) -> tuple[Floats, Numbers]:
        """Of chords (c, 2, 3): the places between their ends that stand for the curve, one chord after the other, and
        into how many pieces (c,) they cut each."""
        begin, along = between[:, 0], between[:, 1] - between[:, 0]
        reach = REACH * np.linalg.norm(along, axis=1)
        middle = begin + 0.5 * along
        top, there = bent(middle, reach, self.size, conditions)
        rise = np.where(there[:, None], top - middle, 0.0)
        pieces = np.ceil(np.sqrt(np.linalg.norm(rise, axis=1) / fine))
        pieces = np.clip(pieces, 1, MOST_PIECES).astype(np.int64)
        chord = np.repeat(np.arange(len(between)), pieces - 1)
        step = np.arange(len(chord)) - np.repeat(np.cumsum(pieces - 1) - (pieces - 1), pieces - 1)
        share = ((step + 1) / pieces[chord])[:, None]
        guess = begin[chord] + share * along[chord] + 4.0 * share * (1.0 - share) * rise[chord]
        inner, _ = bent(guess, reach[chord], self.size, lambda places, rows: conditions(places, chord[rows]))
        return inner, pieces

    def _round_points(self) -> tuple[Numbers, Numbers, Floats, Floats]:
        """The triangles (c,) of curved faces, their corners (c, 3) among pairs of a vertex and a surface, and of these
        the place (k, 3) and the unit normal (k, 3)."""
        if self._round is None:
            triangles = np.flatnonzero(self.surface_of >= 0)
            count = max(self.surfaces.count, 1)
            keys = self.mesh.corners[triangles].astype(np.int64) * count + self.surface_of[triangles][:, None]
            pairs, corner = np.unique(keys, return_inverse=True)
            vertex, surface = np.divmod(pairs, count)
            places = self.mesh.vertices[vertex]
            _, slope = self.surfaces.gradients(places, surface)
            slope /= np.maximum(np.linalg.norm(slope, axis=1, keepdims=True), 1e-300)
            self._round = triangles, corner.reshape(-1, 3), places, slope
        return self._round

    def _flat_silhouette(self, eye: Eye) -> Numbers:
        """(s, 2) the vertices of edges between a triangle that faces the eye and one that does not, where no curved
        surface goes on and no feature edge runs."""
        if self._joints is None:
            corners, number = self.mesh.corners.astype(np.int64), self._number
            here = np.repeat(np.arange(len(corners)), 3)
            there = self._beside.reshape(-1)
            rows = np.flatnonzero((there > here) & (number[here] != number[there]))
            pairs = np.sort(np.column_stack((here[rows], there[rows])), axis=1)
            taken = np.sort(self.mesh.edge_sides.astype(np.int64), axis=1)
            free = ~np.isin(pairs @ (len(corners), 1), taken @ (len(corners), 1))
            ends = np.column_stack((corners.reshape(-1)[rows], np.roll(corners, -1, axis=1).reshape(-1)[rows]))
            self._joints = ends[free], pairs[free]
        ends, pairs = self._joints
        rays = eye.rays(self.mesh.vertices[ends[:, 0]])
        one, other = (np.einsum("ni,ni->n", self._normals[pairs[:, side]], rays) > 0.0 for side in (0, 1))
        return ends[one != other]


def surfaces_of_triangles(mesh: DisplayMesh, surfaces: RoundSurfaces, corners: Floats, normal: Floats) -> Numbers:
    """(t,) the curved surface that each triangle is a facet of, the nearest of those of its owner; -1: of none.
    `corners` (t, 3, 3) and `normal` (t, 3), not unit, are those of the triangles."""
    found = np.full(len(corners), -1)
    nearest = np.full(len(corners), AWAY)
    middles = corners.mean(axis=1)
    owners = np.append(np.bincount(surfaces.owner, minlength=len(mesh.owners)), 0)  # the last one: of nobody
    first = np.cumsum(owners) - owners
    for slot in range(int(owners.max(initial=0))):
        rows = np.flatnonzero(owners[mesh.owner] > slot)
        which = first[mesh.owner[rows]] + slot
        _, slope = surfaces.gradients(middles[rows], which)
        cosine = np.abs(np.einsum("ni,ni->n", slope, normal[rows]))
        along = cosine > ALONG * np.linalg.norm(slope, axis=1) * np.linalg.norm(normal[rows], axis=1)
        away = np.max([np.abs(surfaces.values(corners[rows, i], which)) for i in range(3)], axis=0)
        away = away / surfaces.radii(middles[rows], which)
        better = along & (away < nearest[rows])
        found[rows[better]], nearest[rows[better]] = which[better], away[better]
    return found


def beside(corners: Numbers, vertices: int) -> Numbers:
    """(t, 3) the triangle on the other side of each side, from a corner to the next, of triangles (t, 3); -1: none."""
    begin, end = corners.reshape(-1), np.roll(corners, -1, axis=1).reshape(-1)
    order = np.argsort(np.minimum(begin, end) * vertices + np.maximum(begin, end), kind="stable")
    low, high = np.minimum(begin, end)[order], np.maximum(begin, end)[order]
    pair = np.flatnonzero((low[1:] == low[:-1]) & (high[1:] == high[:-1]))
    result = np.full(len(begin), -1)
    result[order[pair]] = order[pair + 1] // 3
    result[order[pair + 1]] = order[pair] // 3
    return result.reshape(-1, 3)


def _planes(facet: NDArray[np.int32], corners: Floats, normal: Floats) -> Floats:
    """(f, 4) the mean planes of facets: unit normal and offset."""
    count = int(facet.max(initial=-1)) + 1
    total = np.column_stack([np.bincount(facet, normal[:, i], count) for i in range(3)]).reshape(-1, 3)
    size = np.maximum(np.linalg.norm(total, axis=1), 1e-300)
    unit = total / size[:, None]
    height = np.einsum("ti,ti->t", unit[facet], corners.mean(axis=1))
    area = np.linalg.norm(normal, axis=1)
    offset = np.bincount(facet, area * height, count) / np.maximum(np.bincount(facet, area, count), 1e-300)
    return np.column_stack((unit, offset))


def _around(ends: Numbers, sides: Numbers, points: int) -> Numbers:
    """(p, 3) the surfaces that meet in each point, those on both sides (e, 2) of the edges (e, 2) that end there; all
    -1 where there are more than three."""
    keys = np.repeat(ends.reshape(-1), 2), np.repeat(sides, 2, axis=0).reshape(-1)
    top = int(sides.max(initial=0)) + 1
    point, surface = np.divmod(np.unique(keys[0] * top + keys[1]), top)
    first = np.flatnonzero(np.diff(point, prepend=-1))
    count = np.diff(first, append=len(point))
    place = np.arange(len(point)) - np.repeat(first, count)
    kept = np.repeat(count <= 3, count)
    result = np.full((points, 3), -1)
    result[point[kept], place[kept]] = surface[kept]
    return result


def _joined(places: Floats, ends: Numbers, inner: Floats, pieces: Numbers) -> Curves:
    """Chords `ends` (c, 2) between places (p, 3) cut into pieces (c,) by inner places, one chord after the other."""
    chord = np.repeat(np.arange(len(ends)), pieces)
    step = np.arange(len(chord)) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    within = len(places) + np.repeat(np.cumsum(pieces - 1) - (pieces - 1), pieces) + step
    begin = np.where(step == 0, ends[chord, 0], within - 1)
    end = np.where(step == pieces[chord] - 1, ends[chord, 1], within)
    return Curves(np.concatenate((places, inner)), np.column_stack((begin, end)), chord)
