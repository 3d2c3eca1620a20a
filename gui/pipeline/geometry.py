"""All that is shown as one mesh, and its wire-frame: what the Pipeline panel sends through its own pipeline."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ...model.pipeline.counts import joined
from ..view.occurrences import Path

if TYPE_CHECKING:
    from ...model.solid.display import DisplayMesh

Floats = NDArray[np.float64]
MOST_LINES = 4000
"""Of a wire-frame; of more a sample is drawn."""
MOST_SEARCHED = 50_000
"""Triangles between which edges are looked for; of more the sides of some are drawn."""


@dataclass(frozen=True, slots=True, eq=False)
class Geometry:
    """`points` (n, 3) of the world, `triangles` (t, 3); `lines` (e, 2, 3) between flat faces, `line_triangles` (e,)
    each with one of its triangles; a sample of them where there are many."""

    meshes: tuple[DisplayMesh, ...]
    points: Floats
    triangles: NDArray[np.int64]
    lines: Floats
    line_triangles: NDArray[np.int64]

    @property
    def bounds(self) -> Floats | None:
        """(2, 3), None where there is nothing."""
        return np.array([self.points.min(axis=0), self.points.max(axis=0)]) if len(self.points) else None

    def moved(self, path: Path, by: Floats) -> Geometry:
        """With the faces of the occurrence at `path` moved by a (4, 4) map; what it shares with others is torn off."""
        own = np.concatenate([np.zeros(0, bool), *(_made_by(mesh, path) for mesh in self.meshes)])
        moved = self.points @ by[:3, :3].T + by[:3, 3]
        triangles = self.triangles + len(self.points) * own[:, None]
        lines = np.where(own[self.line_triangles][:, None, None], self.lines @ by[:3, :3].T + by[:3, 3], self.lines)
        return replace(self, points=np.concatenate((self.points, moved)), triangles=triangles, lines=lines)


def geometry_of(meshes: Sequence[DisplayMesh]) -> Geometry:
    """Of the meshes of solids, in their order."""
    points, triangles = joined([(mesh.vertices, mesh.corners) for mesh in meshes])
    starts = np.cumsum([0, *(int(mesh.facet.max(initial=-1)) + 1 for mesh in meshes)])
    facets = [mesh.facet + start for mesh, start in zip(meshes, starts, strict=False)]
    facet = np.concatenate([np.zeros(0, np.int64), *facets])
    if len(triangles) > MOST_SEARCHED:
        some = _sample(len(triangles), MOST_LINES // 3)
        ends = np.stack((triangles[some], np.roll(triangles[some], -1, axis=1)), axis=2).reshape(-1, 2)
        return Geometry(tuple(meshes), points, triangles, points[ends], np.repeat(some, 3))
    ends, triangle = _between_facets(triangles, facet, len(points))
    some = _sample(len(ends), MOST_LINES)
    return Geometry(tuple(meshes), points, triangles, points[ends[some]], triangle[some])


def _sample(count: int, most: int) -> NDArray[np.int64]:
    """All of so many numbers, or `most` of them, evenly."""
    return np.linspace(0, count - 1, min(count, most)).astype(np.int64)


def _between_facets(
    triangles: NDArray[np.int64], facet: NDArray[np.int64], count: int
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The edges (e, 2) on whose sides the facets differ, and a triangle of each (e,)."""
    sides = np.sort(np.stack((triangles, np.roll(triangles, -1, axis=1)), axis=2).reshape(-1, 2), axis=1)
    key = sides[:, 0] * max(count, 1) + sides[:, 1]
    order = np.argsort(key, kind="stable")
    key, owner = key[order], order // 3
    first = np.diff(key, prepend=-1) != 0
    begins = np.flatnonzero(first)
    if not len(begins):
        return np.zeros((0, 2), np.int64), np.zeros(0, np.int64)
    least, most = (ufunc.reduceat(facet[owner], begins) for ufunc in (np.minimum, np.maximum))
    alone = np.diff(begins, append=len(key)) == 1
    kept = begins[(least != most) | alone]
    return sides[order[kept]], owner[kept]


def _made_by(mesh: DisplayMesh, path: Path) -> NDArray[np.bool_]:
    """(t,) the triangles that the occurrence made, or what stands below it."""
    own = np.array([owner[: len(path)] == path for owner in mesh.owners], bool)
    return own[mesh.owner] if len(own) else np.zeros(len(mesh.triangles), bool)
