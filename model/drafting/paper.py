"""Pages and scales by name: ISO 216 and North American sheets, scales after ISO 5455 (1979)."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass

from ..document.errors import Refusal

INCH = 25.4
SIZES: dict[str, tuple[float, float]] = {
    "A4": (210.0, 297.0),
    "A3": (297.0, 420.0),
    "A2": (420.0, 594.0),
    "A1": (594.0, 841.0),
    "A0": (841.0, 1189.0),
    "Letter": (8.5 * INCH, 11 * INCH),
    "Legal": (8.5 * INCH, 14 * INCH),
    "Tabloid": (11 * INCH, 17 * INCH),
}
"""Width and height in mm, upright."""
SMALLEST, LARGEST = 40.0, 5000.0
"""Sides of a page in mm."""
FINEST, COARSEST = 1e-6, 1e6
"""Scales that can be asked for."""


@dataclass(frozen=True, slots=True)
class Paper:
    """A page by name, with its sides in mm as it is used."""

    name: str
    width: float
    height: float

    @property
    def words(self) -> str:
        return self.name if self.name[0].isdigit() else f"{self.name} {self.orientation}"

    @property
    def orientation(self) -> str:
        return "landscape" if self.width >= self.height else "portrait"


def papers(words: str) -> tuple[Paper, ...]:
    """The pages that a text such as `A4`, `a3 portrait`, `Letter-landscape` or `300x200` can mean, landscape first.

    Raises Refusal.
    """
    plain = words.strip()
    found = re.fullmatch(r"(\d+(?:\.\d+)?)\s*[x×*]\s*(\d+(?:\.\d+)?)\s*(?:mm)?", plain, re.IGNORECASE)
    if found:
        width, height = float(found[1]), float(found[2])
        if not all(SMALLEST <= side <= LARGEST for side in (width, height)):
            raise Refusal(f"a page of {plain} mm: its sides may be from {SMALLEST:g} to {LARGEST:g} mm")
        return (Paper(f"{width:g} × {height:g} mm", width, height),)
    name, _, turned = plain.replace("-", " ").partition(" ")
    known = next((one for one in SIZES if one.lower() == name.lower()), None)
    turned = turned.strip().lower()
    if known is None or turned not in ("", "portrait", "landscape"):
        names = ", ".join(SIZES)
        raise Refusal(f"“{words}” is no page: take {names}, with -portrait or -landscape if you like, or 300x200 in mm")
    short, long = SIZES[known]
    ways = (Paper(known, long, short), Paper(known, short, long))
    return tuple(way for way in ways if turned in ("", way.orientation))


def scale_from(words: str) -> float | None:
    """Paper by model, from `1:2`, `5:1`, a number, or `fit`, which gives None. Raises Refusal."""
    plain = words.strip().lower()
    if plain == "fit":
        return None
    parts = [part.strip() for part in plain.split(":")]
    try:
        numbers = [float(part) for part in parts]
        value = numbers[0] if len(numbers) == 1 else numbers[0] / numbers[1] if len(numbers) == 2 else math.nan
    except (ValueError, ZeroDivisionError):
        value = math.nan
    if not FINEST <= value <= COARSEST:
        raise Refusal(f"“{words}” is no scale: write 1:2, 5:1, a number above 0, or fit")
    return value


def scale_words(scale: float) -> str:
    """`1:2`, `5:1`, `1:1.5`: the scale as drawings tell it."""
    return f"{_figure(scale)}:1" if scale > 1.0 else f"1:{_figure(1.0 / scale)}"


def _figure(value: float) -> str:
    return f"{value:.6g}" if value < 1e6 else f"{value:.0f}"


def standard_scales() -> Iterator[float]:
    """The scales of ISO 5455 and its continuation by tens, from the largest to the smallest that can be asked for."""
    for power in range(round(math.log10(COARSEST)), -1, -1):
        for step in (5.0, 2.0, 1.0) if power < 6 else (1.0,):
            yield step * 10.0**power
    for power in range(round(-math.log10(FINEST))):
        for step in (2.0, 5.0, 10.0):
            yield 1.0 / (step * 10.0**power)
