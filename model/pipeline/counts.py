"""How many vertices, polygons and pixels there are at each stage of the pipeline."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .clipping import PLANES, Drawn, drawn
from .matrices import Matrices
from .raster import Raster, raster
from .stages import Floats


@dataclass(frozen=True, slots=True)
class Counts:
    """Of one picture. Triangles are told apart by what becomes of them; `polygons` with `corners` are those that go
    on to be drawn, `cut` of them by a side of the frustum, and `pieces` the triangles that they are drawn as.
    `fragments` are pixels of all polygons, `pixels` those of the picture that are covered."""

    vertices: int
    triangles: int
    outside: int
    away: int
    cut: int
    polygons: int
    corners: int
    pieces: int
    fragments: int
    pixels: int
    size: tuple[int, int]

    @property
    def hidden(self) -> int:
        """Fragments that the depth test leaves unseen."""
        return self.fragments - self.pixels

    @property
    def overdraw(self) -> float:
        """Fragments for each covered pixel."""
        return self.fragments / self.pixels if self.pixels else 0.0

    def json(self) -> dict[str, Any]:
        """For the command line, in the order of the stages."""
        return {
            "vertices": self.vertices,
            "triangles": self.triangles,
            "outside": self.outside,
            "facing_away": self.away,
            "polygons": self.polygons,
            "cut": self.cut,
            "corners": self.corners,
            "pieces": self.pieces,
            "fragments": self.fragments,
            "hidden": self.hidden,
            "pixels": self.pixels,
            "overdraw": round(self.overdraw, 4),
            "picture": list(self.size),
        }


@dataclass(frozen=True, slots=True, eq=False)
class Result:
    """A picture worked out: what was drawn, its pixels, and the counts."""

    drawn: Drawn
    raster: Raster
    counts: Counts


def counted(
    points: Floats,
    triangles: NDArray[np.integer],
    matrices: Matrices,
    size: tuple[int, int],
    cull: bool = True,
    planes: Floats = PLANES,
    stopped: Callable[[], bool] = lambda: False,
) -> Result | None:
    """The picture of triangles (t, 3) over points (n, 3) of the world, `size` = (width, height) pixels; None where it
    was stopped. The model matrix has been applied to the points already."""
    left = drawn(matrices.clip(points), triangles, cull, planes)
    if stopped():
        return None
    pixels = raster(left.polygons, matrices.viewport, size, stopped)
    if pixels is None:
        return None
    counts = Counts(
        len(points),
        len(triangles),
        int(left.outside.sum()),
        int(left.away.sum()) if cull else 0,
        int(left.cut.sum()),
        len(left.source),
        int(left.polygons.counts.sum()),
        pixels.triangles,
        pixels.fragments,
        pixels.pixels,
        size,
    )
    return Result(left, pixels, counts)


def joined(meshes: list[tuple[Floats, NDArray[np.integer]]]) -> tuple[Floats, NDArray[np.int64]]:
    """Several meshes of vertices (v, 3) and triangles (t, 3) as one."""
    starts = np.cumsum([0, *(len(vertices) for vertices, _ in meshes)])
    points = np.concatenate([np.zeros((0, 3)), *(vertices for vertices, _ in meshes)])
    rows = [np.asarray(corners, np.int64) + start for (_, corners), start in zip(meshes, starts, strict=False)]
    return points, np.concatenate([np.zeros((0, 3), np.int64), *rows])
