"""The colours in which half-spaces, fragments and the painter's step are drawn, beside those of the theme."""

from __future__ import annotations

from dataclasses import dataclass

from ..theme import LIGHT, colours_now


@dataclass(frozen=True, slots=True)
class Inks:
    """As #rrggbb; on the theme's ground each has a contrast of at least 4.5 to 1."""

    front: str
    back: str
    own: str  # what lies in a plane, or in a chosen leaf
    step: str  # the fragment that is drawn last


ON_LIGHT = Inks(front="#0b756b", back="#96369f", own="#a85600", step="#c2185b")
ON_DARK = Inks(front="#4cc9b8", back="#d891e6", own="#ffb454", step="#ff7aa8")


def inks_now() -> Inks:
    return ON_LIGHT if colours_now() is LIGHT else ON_DARK
