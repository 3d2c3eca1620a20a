"""The colours of the Pipeline panel's pictures, beside those of the theme."""

from __future__ import annotations

from dataclasses import dataclass

from ..theme import LIGHT, colours_now


@dataclass(frozen=True, slots=True)
class Inks:
    """As #rrggbb; on the theme's ground lines have a contrast of at least 3 to 1, words one of 4.5 to 1."""

    inside: str  # what is seen
    outside: str  # what is clipped
    frustum: str
    near: str
    far: str
    ray: str  # the followed vertex, its ray and its pixel
    cut: str  # polygons that a plane has cut
    changed: str  # words on what is tried


ON_LIGHT = Inks(inside="#36424f", outside="#9aa4af", frustum="#2563c4", near="#0b756b", far="#7a4fb5", ray="#c2185b",
                cut="#d07800", changed="#a85600")  # fmt: skip
ON_DARK = Inks(inside="#d3dae2", outside="#69727d", frustum="#7fb2f2", near="#4cc9b8", far="#c3a2f0", ray="#ff7aa8",
               cut="#ffb454", changed="#ffb454")  # fmt: skip


def inks_now() -> Inks:
    return ON_LIGHT if colours_now() is LIGHT else ON_DARK
