"""A measured figure: what it is called, its numbers and their unit."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from ..document.arithmetic import RESERVED

EXACT = 15
"""Decimal digits that a double holds for certain."""
SEEN = 9
"""Those of what is measured on the picture's mesh, whose coordinates are of single precision."""


@dataclass(frozen=True, slots=True)
class Figure:
    """One number, or several that belong together, such as coordinates. `unit` as it is shown: mm, mm², °."""

    name: str
    values: tuple[float, ...]
    unit: str = "mm"
    digits: int = EXACT
    """How many significant ones are known: a copy has all of them."""
    parts: tuple[str, ...] = ()
    """What each of several values is called."""

    def text(self, index: int) -> str:
        """One value with all of its known digits, as a number field takes it."""
        return f"{self.values[index] + 0.0:.{self.digits}g}"

    def name_of(self, index: int) -> str:
        part = self.parts[index] if self.parts else ""
        return f"{self.name} {part}".strip()

    def line(self) -> str:
        """As a line of text: name, values and unit, with tabulators between, as tables take it."""
        return "\t".join((self.name, *(self.text(i) for i in range(len(self.values))), self.unit))


def vector(name: str, values: Iterable[float], unit: str = "mm", digits: int = EXACT) -> Figure:
    """A figure of three numbers along x, y and z."""
    return Figure(name, tuple(values), unit, digits, ("x", "y", "z"))


def parameter_name(words: str, taken: Iterable[str]) -> str:
    """A parameter's name from what a figure is called: `sphere_volume`, `sphere_volume_2` where that is taken."""
    known = {*taken, *RESERVED}
    plain = re.sub(r"\W+", "_", words.replace("Δ", "d")).strip("_").lower() or "measure"
    plain = plain if plain[0].isalpha() else f"m_{plain}"
    name, number = plain, 1
    while name in known:
        number += 1
        name = f"{plain}_{number}"
    return name
