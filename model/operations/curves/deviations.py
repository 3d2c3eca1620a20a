"""How far an outline has moved from what it was: what is told of operations that change the shape."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...curve.bezier import evaluated
from ...curve.nearest import nearest
from ...document.nodes import Node
from ...document.placement import Placement
from ...outline.paths import path_of
from ...path.path import Path
from ...path.pieces import pieces_of

Floats = NDArray[np.float64]
Piece = tuple[Floats, Floats | None]
"""Control points (n + 1, d) of a Bezier curve, and weights (n + 1,) where it is rational."""

SAMPLES, MOST = 33, 50_000
"""Points of each piece that are looked at, and of all pieces together."""


def deviation(before_node: Node, after_node: Node) -> float:
    """The greatest distance, in mm, of the curves of one outline from those of the other, either way.

    Both are resolved; placements are left out. Evenly spaced parameters of the pieces that differ are looked at, and
    the true nearest points to them. Infinite where one of both is empty. Raises Refusal for what has no path.
    """
    before, after = (path_of(node.with_(placement=Placement())) for node in (before_node, after_node))
    return deviation_of_paths(before, after)


def deviation_of_paths(before: Path, after: Path) -> float:
    """`deviation` of paths in the same axes."""
    if not (before.contours and after.contours):
        return float("inf") if before.contours or after.contours else 0.0
    if before.contours[0].dimension != after.contours[0].dimension:
        lift = np.eye(3, 4)
        before, after = (
            path if path.contours[0].dimension == 3 else path.transformed(lift) for path in (before, after)
        )
    one, other = _pieces(before), _pieces(after)
    return max(_off(one, other), _off(other, one))


def _off(moved: dict[bytes, Piece], still: dict[bytes, Piece]) -> float:
    """How far points of pieces lie from other ones; those that are in both lie on them."""
    changed = [piece for key, piece in moved.items() if key not in still]
    if not changed:
        return 0.0
    t = np.linspace(0.0, 1.0, int(np.clip(MOST // len(changed), 3, SAMPLES)))
    points = np.concatenate([evaluated(controls, t, weights) for controls, weights in changed])
    # What is new is nearest to what it replaces; what stands in both only where nothing else does.
    beside = [piece for key, piece in still.items() if key not in moved]
    least = np.full(len(points), np.inf)
    for controls, _ in beside + list(still.values()):
        least = np.minimum(least, np.linalg.norm(points - controls[0], axis=1))
        least = np.minimum(least, np.linalg.norm(points - controls[-1], axis=1))
    for controls, weights in [*beside, *(piece for key, piece in still.items() if key in moved)]:
        low, high = controls.min(axis=0), controls.max(axis=0)
        away = np.linalg.norm(np.maximum(np.maximum(low - points, points - high), 0.0), axis=1)
        rows = np.flatnonzero(away < least)
        if len(rows):
            least[rows] = np.minimum(least[rows], nearest(controls, points[rows], weights)[1])
    return float(least.max())


def _pieces(path: Path) -> dict[bytes, Piece]:
    """The Bezier pieces of a path, by what they are, run through either way."""
    found: dict[bytes, Piece] = {}
    for group in pieces_of(path.contours):
        for row, controls in enumerate(group.controls):
            weights = None if group.weights is None else group.weights[row]
            turn = 1 if controls[0].tolist() <= controls[-1].tolist() else -1
            key = controls[::turn].tobytes() + (b"" if weights is None else weights[::turn].tobytes())
            found[key] = controls, weights
    return found
