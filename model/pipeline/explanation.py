"""The pipeline in words: what each entry of a matrix does, and a vertex's way with its numbers put in."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..document.errors import Refusal
from .clipping import NAMES as PLANE_NAMES
from .clipping import PLANES
from .matrices import Lens, Matrices, eye_of, lens_of
from .stages import Floats

AXES = ("x", "y", "z", "w")
EYE_AXES = ("right", "up", "backward")
MINUS = "\u2212"


@dataclass(frozen=True, slots=True)
class Stage:
    """Coordinates of a vertex at one stage, how each came about as a formula with its numbers, and what they mean."""

    name: str
    coordinates: tuple[float, ...]
    formulas: tuple[str, ...]
    words: str


def number(value: float, digits: int = 5) -> str:
    """In `digits` significant ones, with a proper minus."""
    text = f"{value:.{digits}g}" if abs(value) > 1e-12 else "0"
    return text.replace("-", MINUS)


def outside(clip: Floats) -> tuple[str, ...]:
    """The planes beyond which clip coordinates (4,) lie; none for a point that is seen."""
    return tuple(name for name, height in zip(PLANE_NAMES, PLANES @ clip, strict=True) if height < 0.0)


def way_of(matrices: Matrices, point: Floats) -> tuple[Stage, ...]:
    """Of a point (3,) in its node's own axes, from there to the pixel."""
    own = np.array([*point, 1.0])
    found = matrices.stages([point])
    world, eye = np.append(found.world[0], 1.0), np.append(found.eye[0], 1.0)
    clip, device, pixel = found.clip[0], found.device[0], found.pixel[0]
    beyond = outside(clip)
    seen = "inside all six planes: it is seen" if not beyond else f"outside the {_list(beyond)}: it is clipped"
    behind = "; the eye has it behind itself: w is not above 0" if clip[3] <= 0.0 else ""
    return (
        Stage("Model", _tuple(own[:3]), (), "in the model's own axes, in mm"),
        Stage("World", _tuple(world[:3]), _rows(matrices.model, own, 3), "in the document's axes, in mm"),
        Stage("Eye", _tuple(eye[:3]), _rows(matrices.view, world, 3),
              "x to the right, y up, z backward: what is seen has z below 0"),
        Stage("Clip", _tuple(clip), _rows(matrices.projection, eye, 4),
              f"seen is where {MINUS}w \u2264 x, y, z \u2264 w; {seen}{behind}"),
        Stage("Device", _tuple(device), tuple(
            f"{axis} = {number(value)} / {_put(clip[3])} = {number(result)}"
            for axis, value, result in zip(AXES, clip, device, strict=False)),
            f"clip divided by w: the frustum has become the cube from {MINUS}1 to 1"),
        Stage("Pixel", _tuple(pixel), _rows(matrices.viewport, np.append(device, 1.0), 3),
              "x to the right, y downward from the upper left corner; z is the depth, 0 near to 1 far"),
    )  # fmt: skip


def _rows(matrix: Floats, column: Floats, count: int) -> tuple[str, ...]:
    """A row of the matrix times the column, for each row; what is multiplied by 0 is left out."""
    result = matrix @ column
    terms = (
        [f"{_put(a)}\u00b7{_put(b)}" for a, b in zip(matrix[i], column, strict=True) if a != 0.0] for i in range(count)
    )
    return tuple(
        " = ".join((axis, *([" + ".join(row)] if row else []), number(value)))
        for axis, row, value in zip(AXES, terms, result, strict=False)
    )


def _put(value: float) -> str:
    """A number as it stands within a formula."""
    text = number(value)
    return f"({text})" if text.startswith(MINUS) else text


def entry_words(name: str, matrices: Matrices, row: int, column: int) -> str:
    """What one entry does, with its number."""
    matrix = getattr(matrices, name)
    value = number(matrix[row, column])
    return f"{value}: {_MEANINGS[name](matrix, row, column)}"


def _model(matrix: Floats, row: int, column: int) -> str:
    if row == 3:
        return _last(column)
    if column == 3:
        return f"moves by so many mm along {AXES[row]}"
    size = number(float(np.linalg.norm(matrix[:3, column])))
    return (
        f"how much of the node's {AXES[column]} goes along the world's {AXES[row]}; this column is where its "
        f"{AXES[column]} axis points, and it is scaled by {size} there"
    )


def _view(matrix: Floats, row: int, column: int) -> str:
    if row == 3:
        return _last(column)
    try:
        position, _ = eye_of(matrix)
    except Refusal:
        return f"how much of the world's {AXES[column]} goes into the eye's {AXES[row]}"
    if column == 3:
        place = ", ".join(number(float(value)) for value in position)
        return f"takes the eye, at ({place}), to the origin: minus its place along its {EYE_AXES[row]} axis"
    return f"the {AXES[column]} component of the eye's {EYE_AXES[row]} axis, a unit vector of the world"


def _projection(matrix: Floats, row: int, column: int) -> str:
    try:
        lens = lens_of(matrix)
    except Refusal:
        return (
            f"added to clip {AXES[row]}"
            if column == 3
            else f"how much of the eye's {AXES[column]} goes into clip {AXES[row]}"
        )
    if matrix[row, column] == 0.0:
        return (
            f"nothing is added to clip {AXES[row]}"
            if column == 3
            else f"the eye's {AXES[column]} does not go into clip {AXES[row]}"
        )
    return (_perspective if lens.angle is not None else _parallel)(lens, row, column)


def _perspective(lens: Lens, row: int, column: int) -> str:
    assert lens.angle is not None
    half, near, far = number(lens.angle / 2.0), number(lens.near), number(lens.far)
    return {
        (0, 0): f"cot {half}\u00b0 / {number(lens.aspect)}: brings the frustum's left and right sides to x = \u00b1w; "
        "the cotangent of half the angle by width over height",
        (1, 1): f"cot {half}\u00b0: brings its lower and upper sides to y = \u00b1w; the cotangent of half the angle",
        (2, 2): f"{MINUS}(f + n) / (f {MINUS} n) with n = {near} and f = {far}: with the entry beside it, brings the "
        f"near plane to z = {MINUS}w and the far one to z = w",
        (2, 3): f"{MINUS}2fn / (f {MINUS} n) with n = {near} and f = {far}: makes depths after the division run as "
        "1 / z, finely near and coarsely far",
        (3, 2): f"w becomes {MINUS}z, the distance before the eye: dividing by it makes what is far small",
    }[row, column]


def _parallel(lens: Lens, row: int, column: int) -> str:
    height, near, far = number(lens.half_height), number(lens.near), number(lens.far)
    return {
        (0, 0): f"1 / ({height} \u00b7 {number(lens.aspect)}): brings half the picture's width, in mm, to 1",
        (1, 1): f"1 / {height}: brings half the picture's height, in mm, to 1",
        (2, 2): f"{MINUS}2 / (f {MINUS} n) with n = {near} and f = {far}: depths stay linear",
        (2, 3): f"{MINUS}(f + n) / (f {MINUS} n) with n = {near} and f = {far}: brings the middle of the depths to 0",
        (3, 3): "w stays 1: nothing gets smaller with distance",
    }[row, column]


def _viewport(matrix: Floats, row: int, column: int) -> str:
    if row == 3:
        return _last(column)
    if row == column and row < 2:
        side = ("width", "height")[row]
        down = "; minus, because pixels are counted downward" if matrix[row, column] < 0.0 else ""
        return f"half the picture's {side} in pixels, for device {AXES[row]} from {MINUS}1 to 1{down}"
    if column == 3 and row < 2:
        return f"the middle of the picture: device {AXES[row]} = 0 comes to this pixel"
    if row == 2 and column in (2, 3):
        return f"depths from {MINUS}1 to 1 become 0 to 1"
    return f"how much of device {AXES[column]} goes into {'the depth' if row == 2 else 'pixel ' + AXES[row]}"


def _last(column: int) -> str:
    return "w stays 1" if column == 3 else "nothing goes into w: this map is affine"


_MEANINGS = {"model": _model, "view": _view, "projection": _projection, "viewport": _viewport}


def _list(names: tuple[str, ...]) -> str:
    planes = " and the ".join(names) if len(names) < 3 else ", ".join(names[:-1]) + f" and {names[-1]}"
    return f"{planes} plane{'s' if len(names) > 1 else ''}"


def _tuple(values: Floats) -> tuple[float, ...]:
    return tuple(float(value) for value in values)
