"""A colour of its own for every node, by its id: the same one in every session, and unlike those of its neighbours."""

from __future__ import annotations

import math
from functools import lru_cache
from hashlib import blake2b

GOLDEN = (math.sqrt(5) - 1) / 2
LIGHTNESS = (0.74, 0.64, 0.82, 0.69)
"""In turn, so that hues that come close again, after 21 nodes for one, differ in lightness."""
CHROMA = 0.125


@lru_cache(maxsize=1 << 16)
def distinct_colour(node_id: str) -> str:
    """`#rrggbb` for the node: the golden ratio's walk around the hues of OKLCH (Ottosson 2020), by the id's number.

    Any few consecutive numbers have hues far apart. Ids without a number take one from their hash.
    """
    digits = node_id.removeprefix("n")
    if digits.isdecimal() and len(digits) < 10:
        number = int(digits)
    else:
        number = int.from_bytes(blake2b(node_id.encode(), digest_size=4).digest())
    return oklch(LIGHTNESS[number % len(LIGHTNESS)], CHROMA, 360.0 * (number * GOLDEN % 1.0))


def oklch(lightness: float, chroma: float, hue: float) -> str:
    """`#rrggbb` of a colour in OKLCH, the hue in degrees; with less chroma where the screen has no such colour."""
    while True:
        linear = _linear(lightness, chroma, math.radians(hue))
        if all(-1e-4 <= value <= 1.0001 for value in linear) or chroma < 1e-3:
            break
        chroma *= 0.95
    return "#" + "".join(f"{round(255 * _encoded(min(max(value, 0.0), 1.0))):02x}" for value in linear)


def _linear(lightness: float, chroma: float, hue: float) -> tuple[float, float, float]:
    """Linear sRGB by the matrices of Ottosson, "A perceptual color space for image processing" (2020)."""
    a, b = chroma * math.cos(hue), chroma * math.sin(hue)
    long = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3
    medium = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3
    short = (lightness - 0.0894841775 * a - 1.2914855480 * b) ** 3
    return (
        4.0767416621 * long - 3.3077115913 * medium + 0.2309699292 * short,
        -1.2684380046 * long + 2.6097574011 * medium - 0.3413193965 * short,
        -0.0041960863 * long - 0.7034186147 * medium + 1.7076147010 * short,
    )


def _encoded(value: float) -> float:
    return 12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055
