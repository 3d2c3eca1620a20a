"""What a drawing holds once it is read: outlines in millimetres with y up, as commands of paths."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from ...document.errors import Refusal
from ...path.shapes import arc_pieces, unit_arc

if TYPE_CHECKING:
    from ...path.path import Command, Floats, Path

Affine: TypeAlias = tuple[float, float, float, float, float, float]
"""(a, b, c, d, e, f) takes (x, y) to (a x + c y + e, b x + d y + f), as SVG writes it."""

FARTHEST = 1e9
"""mm; what lies beyond was mistyped, and would leave no digits for the rest."""
MOST_NOTES = 50
STEPS = {"move": 1, "line": 1, "quad": 2, "cubic": 3, "close": 0}
"""How many points a command has."""


@dataclass(frozen=True, slots=True, eq=False)
class Shape:
    """One thing of a drawing: its contours as commands of paths, and how it was painted."""

    contours: tuple[tuple[Command, ...], ...]
    """each begins with ("move", p) and has at least one segment; points are (2,) and read-only"""
    rule: str = "nonzero"
    """"nonzero" or "evenodd" """
    filled: bool = True
    stroked: bool = False
    stroke_width: float = 0.0
    """mm, 0 where there is no stroke; of an uneven scale its geometric mean"""
    name: str = ""
    """its label or id, or the layer"""
    colour: str | None = None
    """#rrggbb of the fill, or of the stroke where nothing is filled; None: unknown or a pattern"""

    @property
    def commands(self) -> list[Command]:
        return [command for contour in self.contours for command in contour]

    def path(self) -> Path:
        from ...path.path import Path

        return Path.of_commands(self.commands, self.rule)


@dataclass(frozen=True, slots=True, eq=False)
class Drawing:
    """The shapes of a file, from back to front."""

    shapes: tuple[Shape, ...]
    notes: tuple[str, ...] = ()
    """what of the file is not in the shapes, or was mended, for the user"""
    size: tuple[float, float] | None = None
    """mm, width and height of the page that begins at (0, 0), where the file has one"""


@dataclass(slots=True)
class Notes:
    """Gathers what was left out; what is said again is counted."""

    counts: Counter[str] = field(default_factory=Counter)
    more: int = 0

    def add(self, text: str) -> None:
        if text in self.counts or len(self.counts) < MOST_NOTES:
            self.counts[text] += 1
        else:
            self.more += 1

    def lines(self) -> tuple[str, ...]:
        lines = [f"{text} ({count:,} times)" if count > 1 else text for text, count in self.counts.items()]
        return (*lines, f"and {self.more:,} more notes of this kind") if self.more else tuple(lines)


class Outline:
    """Contours while they are read, in the file's units: the words of commands, and all their points in order."""

    __slots__ = ("points", "words")

    def __init__(self) -> None:
        self.words: list[str] = []
        self.points: list[float] = []

    def add(self, word: str, *coordinates: float) -> None:
        self.words.append(word)
        self.points.extend(coordinates)

    def cubics(self, curves: Floats) -> None:
        """Curves (k, 4, 2) that go on from where the outline is."""
        self.words.extend(["cubic"] * len(curves))
        self.points.extend(curves[:, 1:].ravel().tolist())

    def contours(self, matrix: Affine) -> tuple[tuple[Command, ...], ...]:
        """The commands of each contour that has a segment, through `matrix`. Raises Refusal for what is too far."""
        a, b, c, d, e, f = matrix
        with np.errstate(over="ignore", invalid="ignore"):
            points = np.array(self.points, float).reshape(-1, 2) @ [[a, b], [c, d]] + (e, f)
        check_near(points)
        points.setflags(write=False)
        rows = iter(points)
        found: list[list[Command]] = []
        for word in self.words:
            command = (word, *(next(rows) for _ in range(STEPS[word])))
            if word == "move":
                found.append([])
            found[-1].append(command)
        return tuple(tuple(contour) for contour in found if any(word not in ("move", "close") for word, *_ in contour))


def check_near(points: Floats) -> None:
    """Raises Refusal for points that are no finite numbers or more than FARTHEST mm away."""
    if len(points) and not np.abs(points).max() <= FARTHEST:  # nan is not below either
        raise Refusal(f"has points more than {FARTHEST:g} mm from the origin; check its units and transforms")


def ellipse_arc(
    centre: Sequence[float], radii: tuple[float, float], start: float, sweep: float, tolerance: float | None
) -> Floats:
    """(k, 4, 2) cubics of an arc along the axes, degrees; see `path.shapes.arc` for how far they leave it."""
    curves = unit_arc(start, sweep, arc_pieces(max(radii), sweep, tolerance))
    return curves * radii + np.asarray(centre, float)
