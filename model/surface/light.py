"""Lights of a document: ambient, directional and point lights."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, Self

from ..document.colours import hex_colour
from ..document.errors import Refusal
from ..document.expression import vector
from .material import named, one_of, plain

KINDS = ("ambient", "directional", "point")
MOST = 8
"""Active lights at once."""


@dataclass(frozen=True, slots=True)
class Light:
    """An ambient light comes from everywhere; a directional one from far away along `direction`, which it shines
    towards (a unit vector); a point light from `position` (mm), the same at every distance.

    `with_camera`: position and direction are in the eye's axes (x right, y up, z towards the eye).
    """

    name: str
    kind: str = "directional"
    colour: str = "#ffffff"
    intensity: float = 1.0
    position: tuple[float, ...] = (0.0, 0.0, 100.0)
    direction: tuple[float, ...] = (0.0, 0.0, -1.0)
    with_camera: bool = False
    shadows: bool = False
    active: bool = True

    def __post_init__(self) -> None:
        what = f"the light {named(self.name, 'a light')}"
        one_of(self.kind, KINDS, f"{what}: the kind")
        object.__setattr__(self, "colour", hex_colour(self.colour))
        object.__setattr__(self, "intensity", plain(self.intensity, f"{what}: the intensity", 0.0, 100.0))
        for field in ("position", "direction"):
            numbers = vector(getattr(self, field), f"{what}: the {field}", 3)
            object.__setattr__(self, field, tuple(plain(n, f"{what}: the {field}") for n in numbers))
        size = math.hypot(*self.direction)
        if size < 1e-9:
            raise Refusal(f"{what}: the direction must not be 0, 0, 0")
        if abs(size - 1.0) > 1e-15:
            object.__setattr__(self, "direction", tuple(n / size for n in self.direction))
        for field in ("with_camera", "shadows", "active"):
            if not isinstance(getattr(self, field), bool):
                raise Refusal(f"{what}: {field} must be true or false, not {getattr(self, field)!r:.60}")

    def with_(self, **changes: Any) -> Self:
        return replace(self, **changes)


def _of_the_program(name: str, towards: tuple[float, float, float], intensity: float) -> Light:
    x, y, z = towards
    return Light(name, "directional", intensity=intensity, direction=(-x, -y, -z), with_camera=True)


PROGRAM: tuple[Light, ...] = (
    Light("Ambient", "ambient"),
    _of_the_program("Key", (-0.45, 0.45, 1.0), 0.72),
    _of_the_program("Fill", (0.9, 0.0, 0.5), 0.25),
    _of_the_program("Glow", (-0.1, -1.0, 0.35), 0.18),
)
"""Of a document that has none: nearly a headlight from the upper left, a fill from the right that keeps the sides of a
box apart, a glow from below. They follow the eye."""


def lights_of(lights: tuple[Light, ...]) -> tuple[Light, ...]:
    """The lights of a document that has these: the program's own where there are none."""
    return tuple(light for light in lights if light.active) if lights else PROGRAM
