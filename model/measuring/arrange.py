"""Where solids go that are lined up, spread or laid on a face: bounds in, moves out, in millimetres of the world."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..document.errors import Refusal

Floats = NDArray[np.float64]
Axis = Literal["x", "y", "z"]
Side = Literal["min", "middle", "max"]
By = Literal["gaps", "centres"]

AXES: tuple[Axis, ...] = ("x", "y", "z")
SIDES: tuple[Side, ...] = ("min", "middle", "max")


def aligned(bounds: ArrayLike, axis: str, side: str = "min", to: float | None = None) -> Floats:
    """Moves (n, 3) that bring one side of each of the boxes (n, 2, 3) to the first one's, or to the coordinate `to`.

    Raises Refusal for an unknown axis or side.
    """
    boxes, number = _boxes(bounds), _axis(axis)
    if side not in SIDES:
        raise Refusal(f"a side is min, middle or max, not {side!r:.60}")
    low, high = boxes[:, 0, number], boxes[:, 1, number]
    place = {"min": low, "middle": (low + high) / 2, "max": high}[side]
    return _along(number, (place[0] if to is None else to) - place)


def spread(bounds: ArrayLike, axis: str, by: str = "gaps") -> Floats:
    """Moves (n, 3) that make the gaps between the boxes (n, 2, 3), or the steps from middle to middle, equal.

    The outermost two stay, as does the order along the axis; gaps are negative where there is no room. Raises Refusal
    for fewer than three boxes.
    """
    boxes, number = _boxes(bounds), _axis(axis)
    if by not in ("gaps", "centres"):
        raise Refusal(f"what is made equal are gaps or centres, not {by!r:.60}")
    if len(boxes) < 3:
        raise Refusal("three solids or more can be spread evenly")
    low, high = boxes[:, 0, number], boxes[:, 1, number]
    middle = (low + high) / 2
    order = np.argsort(middle, kind="stable")
    if by == "centres":
        wanted = np.linspace(middle[order[0]], middle[order[-1]], len(boxes)) - middle[order]
    else:
        size = (high - low)[order]
        gap = (high[order[-1]] - low[order[0]] - size.sum()) / (len(boxes) - 1)
        starts = low[order[0]] + np.cumsum(np.r_[0.0, size[:-1] + gap])
        wanted = starts - low[order]
    wanted[[0, -1]] = 0.0
    moves = np.empty(len(boxes))
    moves[order] = wanted
    return _along(number, moves)


def grounded(bounds: ArrayLike, height: float = 0.0) -> Floats:
    """Moves (n, 3) that put the lowest point of each of the boxes (n, 2, 3) at z = `height`."""
    return _along(2, height - _boxes(bounds)[:, 0, 2])


def centred(bounds: ArrayLike) -> Floats:
    """One move for all, as (n, 3), that puts the middle of the boxes (n, 2, 3) together on the origin, their lowest
    point on z = 0."""
    boxes = _boxes(bounds)
    low, high = boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)
    to = np.array([*(low + high)[:2] / 2, low[2]])
    return np.array([np.round(-to, 9) + 0.0] * len(boxes), np.float64)


def laid(point: ArrayLike, normal: ArrayLike, on: ArrayLike, facing: ArrayLike) -> Floats:
    """The least turn and move, (3, 4), that brings a face to another one: `point` (3,) comes to `on`, and the outward
    `normal` against the outward normal `facing`. Raises Refusal for a normal of length 0."""
    start, end = _unit(normal), -_unit(facing)
    cosine = float(start @ end)
    if cosine < -1.0 + 1e-12:  # half a turn, about any axis across
        across = np.cross(start, np.eye(3)[int(np.argmin(np.abs(start)))])
        across /= np.linalg.norm(across)
        turn = 2.0 * np.outer(across, across) - np.eye(3)
    else:  # Rodrigues' formula, with the sine in the axis
        axis = np.cross(start, end)
        skew = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
        turn = np.eye(3) + skew + skew @ skew / (1.0 + cosine)
    move = np.asarray(on, np.float64) - turn @ np.asarray(point, np.float64)
    return np.column_stack([turn, move]).astype(np.float64)


def _boxes(bounds: ArrayLike) -> Floats:
    boxes = np.asarray(bounds, np.float64)
    if boxes.ndim != 3 or boxes.shape[1:] != (2, 3) or not len(boxes):
        raise Refusal("there is nothing to arrange")
    return boxes


def _axis(axis: str) -> int:
    if axis not in AXES:
        raise Refusal(f"an axis is x, y or z, not {axis!r:.60}")
    return AXES.index(axis)


def _along(axis: int, lengths: Floats) -> Floats:
    moves = np.zeros((len(lengths), 3))
    moves[:, axis] = np.round(lengths, 9) + 0.0
    return moves


def _unit(vector: ArrayLike) -> Floats:
    values = np.asarray(vector, np.float64)
    length = float(np.linalg.norm(values))
    if not length > 0:
        raise Refusal("a face without a normal cannot be laid on another one")
    return np.asarray(values / length, np.float64)
