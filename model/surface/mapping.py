"""How a bitmap lies on the faces of a node: projections, their frame, and what is done to the coordinates.

Texture coordinates (u, v) are 0 to 1 across one copy of the bitmap, u to the right and v upwards from its lower left
corner. They are a function of the place on the node's surface *before* booleans, in the node's own axes, so that what a
boolean leaves of a face keeps them exactly.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from ..document.errors import Refusal
from ..document.expression import vector
from .material import one_of, plain, words

PROJECTIONS = ("natural", "planar", "box", "cylindrical", "spherical")
KINDS = ("planar", "box", "cylindrical", "spherical", "faces", "cylinder", "torus")
"""What is done to points: the projections, and what primitives have by nature."""
CAP = 0.9999
"""Cylinders and cones have caps where the normal is nearer to their axis than this cosine."""
TIE = 2e-3
"""Faces that look at two axes alike, as bevels do, belong to z, then to y, in spite of rounding."""
VECTORS = {"origin": 3, "turned": 3, "size": 2, "offset": 2, "scale": 2}

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class TextureMapping:
    """`origin` (mm) and `turned` (degrees about x, then y, then z) place the projection's frame in the node's axes.

    planar: along the frame's z, one copy `size` mm wide and high.
    box: along whichever axis the face looks at most, one copy `size` mm.
    cylindrical: once around the frame's z axis from its x axis on, one copy `size[1]` mm high.
    spherical: longitude from the frame's x axis, latitude from pole to pole, both once.
    natural: as the primitive that made the face has it, in its own axes: once over each face of a box, around
    cylinders, cones, spheres and tori, and over caps; solids of other kinds as by box.

    The bitmap is mirrored along u or v, shifted by `offset` copies, made `scale` times as large and turned by `turn`
    degrees about the projection's origin.
    """

    projection: str = "natural"
    origin: tuple[float, ...] = (0.0, 0.0, 0.0)
    turned: tuple[float, ...] = (0.0, 0.0, 0.0)
    size: tuple[float, ...] = (20.0, 20.0)
    offset: tuple[float, ...] = (0.0, 0.0)
    scale: tuple[float, ...] = (1.0, 1.0)
    turn: float = 0.0
    mirror: tuple[bool, ...] = (False, False)

    def __post_init__(self) -> None:
        one_of(self.projection, PROJECTIONS, "the projection of a texture")
        for field, count in VECTORS.items():
            what = f"the texture's {words(field)}"
            numbers = vector(getattr(self, field), what, count)
            object.__setattr__(self, field, tuple(plain(n, what) for n in numbers))
        for field in ("size", "scale"):
            if min(abs(n) for n in getattr(self, field)) < 1e-6:
                raise Refusal(f"the texture's {field} must not be 0")
        object.__setattr__(self, "turn", plain(self.turn, "the texture's turn"))
        mirror = self.mirror
        if not isinstance(mirror, tuple | list) or len(mirror) != 2 or not all(isinstance(m, bool) for m in mirror):
            raise Refusal(f"the texture's mirror is a pair of true or false, not {mirror!r:.60}")
        object.__setattr__(self, "mirror", tuple(mirror))

    def with_(self, **changes: Any) -> Self:
        return replace(self, **changes)

    def frame(self) -> Floats:
        """(3, 4) from the node's axes to the projection's."""
        rotation = rotation_of(self.turned)
        return np.column_stack((rotation.T, -rotation.T @ np.array(self.origin)))

    def affine(self) -> Floats:
        """(2, 3): texture coordinates are affine @ (s, t, 1) of the projection's coordinates."""
        angle = np.radians(self.turn)
        cosine, sine = np.cos(angle), np.sin(angle)
        turn = np.array([[cosine, sine], [-sine, cosine]])
        linear = np.diag(1.0 / np.array(self.scale)) @ turn
        flip = np.where(self.mirror, -1.0, 1.0)
        shift = np.where(self.mirror, 1.0, 0.0) - flip * np.array(self.offset)
        return np.column_stack((flip[:, None] * linear, shift))

    def finished(self, st: Floats) -> Floats:
        """(n, 2) texture coordinates of the projection's coordinates (n, 2)."""
        affine = self.affine()
        return st @ affine[:, :2].T + affine[:, 2]


def rotation_of(degrees: tuple[float, ...]) -> Floats:
    """(3, 3) about x, then y, then z."""
    matrix = np.eye(3)
    for axis, angle in enumerate(np.radians(degrees)):
        c, s = np.cos(angle), np.sin(angle)
        a, b = (axis + 1) % 3, (axis + 2) % 3
        turn = np.eye(3)
        turn[a, a], turn[a, b], turn[b, a], turn[b, b] = c, -s, s, c
        matrix = turn @ matrix
    return matrix


def projected(kind: str, extent: tuple[float, ...], points: Floats, normals: Floats) -> Floats:
    """(n, 2) coordinates of `points` (n, 3) of faces with `normals` (n, 3), all in the projection's frame.

    `kind` is one of KINDS; `extent` holds what it measures by: width and height of one copy (mm), or sizes of the
    primitive. Around an axis the coordinates jump from 1 to 0 where the angle does: see `seamless`.
    """
    x, y, z = points.T
    a, b, c = (*extent, 1.0, 1.0, 1.0)[:3]
    match kind:
        case "planar":
            return np.column_stack((x / a, y / b))
        case "box":
            return box_coordinates(points, normals) / (a, b)
        case "cylindrical":
            return np.column_stack((turns(x, y), z / b))
        case "spherical":
            return np.column_stack((turns(x, y), np.arctan2(z, np.hypot(x, y)) / np.pi + 0.5))
        case "faces":  # of a box from the origin to its size
            side = sides(normals)
            mirrored = np.column_stack((np.isin(side, (1, 2, 5)), np.zeros(len(points), bool)))
            spans = np.array([(b, c), (b, c), (a, c), (a, c), (a, b), (a, b)])[side]
            return box_coordinates(points, normals) / spans + mirrored
        case "cylinder":  # of height a and radius b, from z = 0 upwards
            cap = np.abs(normals[:, 2]) > CAP
            across = np.column_stack((np.where(normals[:, 2] < 0.0, -x, x), y)) / (2.0 * b) + 0.5
            return np.where(cap[:, None], across, np.column_stack((turns(x, y), z / a)))
        case "torus":  # of radius a
            return np.column_stack((turns(x, y), turns(np.hypot(x, y) - a, z)))
    raise ValueError(kind)


def turns(x: Floats, y: Floats) -> Floats:
    """(n,) the angle from the x axis, 0 to 1 for once around."""
    return np.arctan2(y, x) / (2 * np.pi) % 1.0


def sides(normals: Floats) -> NDArray[np.intp]:
    """(n,) which side of a box each normal looks out of: 0 to 5 for +x, -x, +y, -y, +z, -z."""
    size = np.abs(normals)
    axis = np.where(size[:, 2] >= size[:, :2].max(axis=1) - TIE, 2, np.where(size[:, 1] >= size[:, 0] - TIE, 1, 0))
    return 2 * axis + (np.take_along_axis(normals, axis[:, None], 1)[:, 0] < 0)


def box_coordinates(points: Floats, normals: Floats) -> Floats:
    """(n, 2) mm to the right and upwards as seen from outside: z is up on the walls, y on top and below."""
    x, y, z = points.T
    right = np.stack((y, -y, -x, x, x, -x))
    up = np.stack((z, z, z, z, y, y))
    side, row = sides(normals), np.arange(len(points))
    return np.column_stack((right[side, row], up[side, row]))


def seamless(coordinates: Floats) -> Floats:
    """Coordinates (t, 3, 2) of triangles' corners, where those that the angle's jump runs through go on beyond 1."""
    u = coordinates[..., 0]
    jumps = np.ptp(u, axis=1) > 0.5
    coordinates = coordinates.copy()
    coordinates[..., 0] = np.where(jumps[:, None] & (u < 0.5), u + 1.0, u)
    return coordinates
