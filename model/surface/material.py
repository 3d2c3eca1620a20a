"""Materials: how a surface takes light, and the bitmaps that lie on it."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from typing import Any, Self

from ..document.colours import hex_colour
from ..document.errors import Refusal
from ..document.expression import Expression, number

SHADINGS = ("flat", "gouraud", "gouraud-diffuse", "phong")
"""One intensity a face; at the vertices and interpolated; the same without highlights, as the textbook has it first; at
every pixel."""
BITMAPS = ("texture", "bump", "reflection", "light_map")
BUMPS = ("heights", "normals")
WRAPS = ("repeat", "mirror", "clamp")
LARGEST = 1e6
MOST_BITMAPS = 12
"""That one picture shows at once: graphics cards let a shader read 16 textures at least."""
_SHA = re.compile(r"[0-9a-f]{64}")

# The least and the most of each number.
RANGES = {
    "ambient": (0.0, 1.0),
    "diffuse": (0.0, 1.0),
    "specular": (0.0, 1.0),
    "shininess": (0.0, 1000.0),
    "opacity": (0.0, 1.0),
    "bump_height": (-1000.0, 1000.0),
    "reflectivity": (0.0, 1.0),
}


@dataclass(frozen=True, slots=True)
class Material:
    """`ambient` and `diffuse` are shares of the surface's colour that it gives back, `specular` one of white;
    `shininess` is the exponent of the highlight. `colour` None: the node's own.

    Bitmaps are the SHA-256 of assets. `texture` takes the place of the colour; with `colour` they are multiplied. Its
    alpha, and texels of the colour `key`, make faces translucent. `bump` holds heights, `bump_height` mm from black to
    white, or the normals of a normal map, stretched by `bump_height` as a factor. `reflection` is a panorama (360 by
    180 degrees) of which `reflectivity` is mirrored; `light_map` scales the light that arrives.
    """

    name: str
    colour: str | None = None
    ambient: float = 0.22
    diffuse: float = 0.9
    specular: float = 0.16
    shininess: float = 24.0
    opacity: float = 1.0
    shading: str = ""
    """One of SHADINGS; "": that of the document or of the picture."""
    texture: str = ""
    key: str | None = None
    wrap: str = "repeat"
    bump: str = ""
    bump_kind: str = "heights"
    bump_height: float = 1.0
    reflection: str = ""
    reflectivity: float = 0.3
    light_map: str = ""

    def __post_init__(self) -> None:
        what = f"the material {named(self.name, 'a material')}"
        for field, (least, most) in RANGES.items():
            object.__setattr__(self, field, plain(getattr(self, field), f"{what}: {words(field)}", least, most))
        for field in ("colour", "key"):
            if getattr(self, field) is not None:
                object.__setattr__(self, field, hex_colour(getattr(self, field)))
        for field, options in (("shading", ("", *SHADINGS)), ("wrap", WRAPS), ("bump_kind", BUMPS)):
            one_of(getattr(self, field), options, f"{what}: {words(field)}")
        for field in BITMAPS:
            sha = getattr(self, field)
            if sha != "" and (not isinstance(sha, str) or _SHA.fullmatch(sha) is None):
                raise Refusal(f"{what}: the {words(field)} is told by 64 hexadecimal digits, not {sha!r:.60}")

    def with_(self, **changes: Any) -> Self:
        return replace(self, **changes)

    @property
    def bitmaps(self) -> tuple[str, ...]:
        """The assets that it refers to."""
        return tuple(sha for sha in (getattr(self, field) for field in BITMAPS) if sha)


def named(name: object, what: str) -> str:
    """A name in quotation marks for messages. Raises Refusal where there is none."""
    if not isinstance(name, str) or not name.strip() or len(name) > 200:
        raise Refusal(f"{what} needs a name of 1 to 200 characters, not {name!r:.60}")
    return f"“{name}”"


def words(field: str) -> str:
    return field.replace("_", " ")


def plain(value: object, what: str, least: float = -LARGEST, most: float = LARGEST) -> float:
    """A number within bounds; expressions are refused. Raises Refusal."""
    found = number(value, what)
    if isinstance(found, Expression):
        raise Refusal(f"{what} must be a plain number")
    if not least <= found <= most:
        raise Refusal(f"{what} is from {least:g} to {most:g}, not {found:g}")
    return found


def one_of(value: object, options: tuple[str, ...], what: str) -> None:
    """Raises Refusal for what is none of the options."""
    if value not in options:
        raise Refusal(f"{what} is one of {', '.join(option for option in options if option)}, not {value!r:.60}")


PRESETS: dict[str, dict[str, Any]] = {
    "Matt": {"ambient": 0.25, "diffuse": 0.9, "specular": 0.0, "shininess": 1.0},
    "Plastic": {"ambient": 0.2, "diffuse": 0.8, "specular": 0.4, "shininess": 40.0},
    "Rubber": {"colour": "#3b3f45", "ambient": 0.25, "diffuse": 0.75, "specular": 0.08, "shininess": 6.0},
    "Ceramic": {"colour": "#f2efe8", "ambient": 0.2, "diffuse": 0.78, "specular": 0.5, "shininess": 90.0},
    "Brushed steel": {"colour": "#b4bac2", "ambient": 0.2, "diffuse": 0.55, "specular": 0.5, "shininess": 18.0},
    "Brass": {"colour": "#c9a544", "ambient": 0.25, "diffuse": 0.6, "specular": 0.5, "shininess": 28.0},
    "Copper": {"colour": "#c87e5a", "ambient": 0.25, "diffuse": 0.6, "specular": 0.45, "shininess": 24.0},
    "Oak": {"colour": "#c19a6b", "ambient": 0.25, "diffuse": 0.85, "specular": 0.06, "shininess": 8.0},
    "Glass": {"colour": "#cfe3ea", "ambient": 0.1, "diffuse": 0.5, "specular": 0.8, "shininess": 150.0,
              "opacity": 0.35},
}  # fmt: skip
"""Fields of materials by the names that menus show."""
