"""The curved surfaces that faces of a solid lie on, as implicit functions of a place in the world.

Each surface is one of revolution about the z axis of axes of its own, to which an affine map leads: placed by any map,
an uneven one too, it stays exact. Near it the function is the distance from it, in its own axes.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..measuring.leaf_surfaces import RoundShape, round_shapes
from ..measuring.surface_kinds import CylinderSurface, SphereSurface, TorusSurface

if TYPE_CHECKING:
    from ..solid.provenance import Occurrence

Floats = NDArray[np.float64]
Numbers = NDArray[np.int64]

SPHERE, CYLINDER, CONE, TORUS = range(4)
TINY = 1e-12
"""Of a radius: nearer to its axis a surface of revolution has no direction."""


@dataclass(frozen=True, slots=True, eq=False)
class RoundSurfaces:
    """Of s surfaces: `numbers` are the radius, of a cone the sine and cosine of half its angle, of a torus both radii;
    `maps` lead from the world to the axes of each, a cone's with its apex at the origin and its inside along z."""

    kind: Numbers  # (s,)
    owner: Numbers  # (s,) place among the occurrences of the solid
    numbers: Floats  # (s, 2)
    maps: Floats  # (s, 3, 4)

    @property
    def count(self) -> int:
        return len(self.kind)

    def values(self, places: Floats, which: Numbers) -> Floats:
        """(n,) the functions of the surfaces `which` (n,) at places (n, 3)."""
        return self._evaluated(places, which, False)[0]

    def gradients(self, places: Floats, which: Numbers) -> tuple[Floats, Floats]:
        """(n,) the functions, and (n, 3) how they change in the world; outwards from the axis or the middle."""
        return self._evaluated(places, which, True)

    def radii(self, places: Floats, which: Numbers) -> Floats:
        """(n,) how strongly the surfaces bend: the radius of a cone at places (n, 3), of a torus that of its tube."""
        maps = self.maps[which]
        own = np.einsum("nij,nj->ni", maps[:, :2, :3], places) + maps[:, :2, 3]
        first, second = self.numbers[which].T
        kind = self.kind[which]
        radius = np.where(kind == CONE, np.hypot(own[:, 0], own[:, 1]), np.where(kind == TORUS, second, first))
        return np.maximum(radius, TINY)

    def _evaluated(self, places: Floats, which: Numbers, wanted: bool) -> tuple[Floats, Floats]:
        maps = self.maps[which]
        own = np.einsum("nij,nj->ni", maps[:, :, :3], places) + maps[:, :, 3]
        around = np.hypot(own[:, 0], own[:, 1])
        height = own[:, 2]
        first, second = self.numbers[which].T
        kind = self.kind[which]
        # The direction, in the half-plane (distance from the axis, height), that the value grows in, and the value.
        out, up, value = np.ones(len(which)), np.zeros(len(which)), around - first
        ball = kind == SPHERE
        far = np.hypot(around, height)
        value = np.where(ball, far - first, value)
        cone = kind == CONE
        value = np.where(cone, around * second - height * first, value)
        ring = kind == TORUS
        beside = around - first
        tube = np.hypot(beside, height)
        value = np.where(ring, tube - second, value)
        if not wanted:
            return value, own[:0]
        far, tube = np.maximum(far, TINY), np.maximum(tube, TINY)
        out = np.where(ball, around / far, np.where(cone, second, np.where(ring, beside / tube, out)))
        up = np.where(ball, height / far, np.where(cone, -first, np.where(ring, height / tube, up)))
        turn = own[:, :2] / np.maximum(around, TINY)[:, None]
        slope = np.column_stack((turn * out[:, None], up))
        return value, np.einsum("nij,ni->nj", maps[:, :, :3], slope)


def round_surfaces(found: Sequence[Occurrence]) -> RoundSurfaces:
    """Those of the occurrences of a solid's leaves; leaves that the model has no such surface of have none."""
    known: dict[bytes, list[tuple[int, float, float, Floats]]] = {}
    owner: list[int] = []
    rows: list[tuple[int, float, float, Floats]] = []
    for number, occurrence in enumerate(found):
        leaf = occurrence.leaf
        own = known.get(leaf.shape_digest)
        if own is None:
            own = known[leaf.shape_digest] = [_row(shape) for shape in round_shapes(leaf)]
        rows += own
        owner += [number] * len(own)
    placed = np.array([found[number].matrix for number in owner]).reshape(-1, 3, 4)
    local = np.array([row[3] for row in rows]).reshape(-1, 3, 4)
    with np.errstate(all="ignore"):
        whole = np.abs(np.linalg.det(placed[:, :, :3])) > 0.0
    back = np.zeros((len(rows), 3, 3))
    back[whole] = np.linalg.inv(placed[whole][:, :, :3])
    linear = local[:, :, :3] @ back
    moved = local[:, :, 3] - np.einsum("sij,sj->si", linear, placed[:, :, 3])
    return RoundSurfaces(
        np.array([row[0] for row in rows], np.int64)[whole],
        np.array(owner, np.int64)[whole],
        np.array([row[1:3] for row in rows], np.float64).reshape(-1, 2)[whole],
        np.concatenate((linear, moved[:, :, None]), axis=2)[whole],
    )


def _row(shape: RoundShape) -> tuple[int, float, float, Floats]:
    """Kind, numbers, and the map (3, 4) from a leaf's axes to the surface's, whose axis lies along the leaf's z."""
    match shape:
        case SphereSurface():
            return SPHERE, shape.radius, 0.0, _moved(shape.centre)
        case CylinderSurface():
            return CYLINDER, shape.radius, 0.0, _moved(shape.point)
        case TorusSurface():
            return TORUS, shape.radius, shape.tube_radius, _moved(shape.centre)
        case _:
            half = math.radians(shape.half_angle)
            matrix = _moved(shape.apex)
            matrix[2] *= shape.axis[2]
            return CONE, math.sin(half), math.cos(half), matrix


def _moved(to: tuple[float, float, float]) -> Floats:
    """(3, 4) the map that brings a point to the origin."""
    return np.column_stack((np.eye(3), np.negative(to)))
