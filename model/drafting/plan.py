"""What a drawing is wanted to be: its views, its page, and what it shows."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, overload

from ..document.errors import Refusal
from .paper import COARSEST, FINEST, papers

Vector = tuple[float, float, float]
Angle = Literal["first", "third"]

VIEWS = ("iso", "front", "back", "left", "right", "top", "bottom")


class NothingToDraw(Refusal):
    """The drawing would be empty."""


@dataclass(frozen=True, slots=True)
class Eye:
    """A view from a point; the target is by default the middle of what is drawn, and up is z.

    In perspective it shows a frame of this `aspect`, width by height.
    """

    position: Vector
    target: Vector | None = None
    up: Vector | None = None
    aspect: float = 2.0**0.5


@overload
def point_of(values: None) -> None: ...
@overload
def point_of(values: Sequence[float]) -> Vector: ...
def point_of(values: Sequence[float] | None) -> Vector | None:
    """Three finite numbers as a point or a direction. Raises Refusal."""
    if values is None:
        return None
    found = tuple(float(value) for value in values)
    if len(found) != 3 or not all(math.isfinite(value) for value in found):
        raise Refusal(f"a point has three finite numbers, not {values!r:.60}")
    return found


@dataclass(frozen=True, slots=True)
class Plan:
    """The choices for a drawing. Raises Refusal for what is none."""

    view: str | Eye = "iso"
    """A standard view by name, or an eye. Counts where there is no sheet."""
    perspective: float | None = None
    """The full vertical angle in degrees; None draws in parallel projection."""
    sheet: Angle | None = None
    """Front, top and side view in first- or third-angle projection (ISO 5456-2)."""
    iso: bool = True
    """With a sheet: a fourth view, from a corner."""
    page: str = "A4"
    scale: float | None = None
    """Paper by model; None takes the largest standard scale that fits."""
    hidden: Literal["dashed", "omit"] = "dashed"
    faces: Literal["fill", "none"] = "none"
    dimensions: bool | None = None
    """Of the bounding box; by default on sheets alone."""
    title: str = ""

    def __post_init__(self) -> None:
        papers(self.page)
        if isinstance(self.view, str) and self.view not in VIEWS:
            raise Refusal(f"no view is called “{self.view}”: take one of {', '.join(VIEWS)}")
        for name, value, choices in (
            ("sheet", self.sheet, (None, "first", "third")),
            ("hidden", self.hidden, ("dashed", "omit")),
            ("faces", self.faces, ("fill", "none")),
        ):
            if value not in choices:
                raise Refusal(f"{name} may be {' or '.join(str(choice) for choice in choices)}, not {value!r:.40}")
        if self.scale is not None and not FINEST <= self.scale <= COARSEST:
            raise Refusal(f"a scale lies between {FINEST:g} and {COARSEST:g}, not at {self.scale:g}")
        if self.perspective is not None and not 0.0 < self.perspective < 180.0:
            raise Refusal(f"a perspective angle lies between 0 and 180 degrees, not at {self.perspective:g}")
        if self.sheet is not None and self.perspective is not None:
            raise Refusal("the views of a sheet are in parallel projection: leave the perspective out")

    @property
    def measured(self) -> bool:
        """Whether the page has dimensions."""
        wanted = self.sheet is not None if self.dimensions is None else self.dimensions
        return wanted and self.perspective is None
