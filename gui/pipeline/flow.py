"""One state of the pipeline that the panel's pictures and tables show: matrices, geometry, what is clipped."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ...model.pipeline.clipping import Drawn, clipped_lines, drawn
from ...model.pipeline.matrices import NAMES
from ...model.pipeline.stages import divided

if TYPE_CHECKING:
    from ...model.pipeline.counts import Result
    from ...model.pipeline.matrices import Matrices
    from .geometry import Geometry

Floats = NDArray[np.float64]
AT_ONCE = 30_000
"""Triangles that are clipped for every picture; more only when the camera rests."""
CUBE = np.array([(x, y, z) for z in (-1.0, 1.0) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))])
"""(8, 3) the corners of what is visible in device coordinates: the near side and the far one."""
BEFORE_EYE = np.array([(0.0, 0.0, 0.0, 1.0)])


@dataclass(eq=False)
class Flow:
    """`size` is the picture's in pixels; `point` (3,) of the world is followed, None for none; `result` is what came of
    the whole when it was counted, None before."""

    matrices: Matrices
    geometry: Geometry
    size: tuple[int, int]
    planes: Floats
    cull: bool
    point: Floats | None = None
    result: Result | None = None

    def draws_as(self, other: Flow) -> bool:
        """Whether another state draws the same picture, whatever point it follows."""
        names = NAMES[1:]  # the model matrix is in the geometry
        same = all(np.array_equal(getattr(self.matrices, name), getattr(other.matrices, name)) for name in names)
        return (
            same
            and self.geometry is other.geometry
            and (self.size, self.cull) == (other.size, other.cull)
            and np.array_equal(self.planes, other.planes)
        )

    @cached_property
    def drawn(self) -> Drawn | None:
        """The polygons that are drawn; None where there are too many to be clipped now."""
        if self.result is not None:
            return self.result.drawn
        if len(self.geometry.triangles) > AT_ONCE:
            return None
        clip = self.matrices.clip(self.geometry.points)
        return drawn(clip, self.geometry.triangles, self.cull, self.planes)

    @cached_property
    def back(self) -> Floats:
        """(4, 4) from clip coordinates to the world."""
        return np.asarray(np.linalg.inv(self.matrices.projection @ self.matrices.view), float)

    @cached_property
    def lines(self) -> Floats:
        """(e, 2, 4) the wire-frame in clip coordinates."""
        ends = self.geometry.lines
        return self.matrices.clip(ends.reshape(-1, 3)).reshape(-1, 2, 4)

    @cached_property
    def inside(self) -> Floats:
        """(i, 2, 4) what of it is inside the planes."""
        found, visible = clipped_lines(self.lines, self.planes)
        return found[visible]

    def world(self, clip: Floats) -> Floats:
        """(..., 3) of the world, of clip coordinates (..., 4)."""
        return divided(clip @ self.back.T)

    @property
    def frustum(self) -> Floats:
        """(8, 3) its corners in the world, as CUBE has them."""
        return self.world(np.column_stack((CUBE, np.ones(8))))

    @property
    def eye(self) -> Floats | None:
        """(3,) where the view rays meet; None in a parallel projection."""
        column = self.back @ np.array((0.0, 0.0, 1.0, 0.0))  # what is at infinity in device space, along z
        return column[:3] / column[3] if abs(column[3]) > 1e-12 * float(np.abs(column).max()) else None

    @property
    def clip_point(self) -> Floats | None:
        """(4,) the followed point in clip coordinates."""
        return None if self.point is None else self.matrices.clip(self.point[None])[0]

    @property
    def cut(self) -> list[Floats]:
        """Polygons (k, 4) in clip coordinates that a plane has cut."""
        found = self.drawn
        return [] if found is None else [found.polygons.polygon(i) for i in np.flatnonzero(found.cut).tolist()]
