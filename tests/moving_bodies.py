"""Bodies and poses for tests of solids on their way."""

import numpy as np
from manifold3d import Manifold

from solidtree.model.proximity.bodies import Body
from solidtree.model.solid.results import arrays_of


def body(solid: Manifold, name: str = "body") -> Body:
    return Body(name, *arrays_of(solid.to_mesh64()), solid)


def block(x: float, y: float, z: float, at: tuple[float, float, float] = (0, 0, 0)) -> Manifold:
    return Manifold.cube((x, y, z)).translate(at)


def pose(x: float = 0, y: float = 0, z: float = 0, turn: float = 0) -> np.ndarray:
    """(4, 4), turned by degrees about the z axis, then moved."""
    matrix = np.eye(4)
    cos, sin = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    matrix[:2, :2] = [[cos, -sin], [sin, cos]]
    matrix[:3, 3] = x, y, z
    return matrix
