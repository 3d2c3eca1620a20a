"""Colours as users write them: `#rrggbb`, `#rgb` or a CSS colour's name."""

from __future__ import annotations

import re

from .errors import Refusal

# CSS Color Module Level 4, section 6.1: the basic names and those that designers ask for most.
NAMES = {
    "black": "000000", "silver": "c0c0c0", "gray": "808080", "grey": "808080", "white": "ffffff", "maroon": "800000",
    "red": "ff0000", "purple": "800080", "fuchsia": "ff00ff", "magenta": "ff00ff", "green": "008000", "lime": "00ff00",
    "olive": "808000", "yellow": "ffff00", "navy": "000080", "blue": "0000ff", "teal": "008080", "aqua": "00ffff",
    "cyan": "00ffff", "orange": "ffa500", "brown": "a52a2a", "pink": "ffc0cb", "gold": "ffd700", "coral": "ff7f50",
    "crimson": "dc143c", "indigo": "4b0082", "ivory": "fffff0", "khaki": "f0e68c", "salmon": "fa8072",
    "skyblue": "87ceeb", "steelblue": "4682b4", "slategray": "708090", "slategrey": "708090", "tan": "d2b48c",
    "tomato": "ff6347", "turquoise": "40e0d0", "violet": "ee82ee", "wheat": "f5deb3", "darkgreen": "006400",
    "darkblue": "00008b", "darkred": "8b0000", "darkgray": "a9a9a9", "darkgrey": "a9a9a9", "lightgray": "d3d3d3",
    "lightgrey": "d3d3d3", "lightblue": "add8e6", "royalblue": "4169e1", "chocolate": "d2691e", "beige": "f5f5dc",
}  # fmt: skip


def hex_colour(text: str) -> str:
    """`text` as `#rrggbb`. Raises Refusal."""
    if isinstance(text, str):
        plain = text.strip().lower()
        if plain in NAMES:
            return "#" + NAMES[plain]
        if re.fullmatch(r"#[0-9a-f]{6}", plain):
            return plain
        if re.fullmatch(r"#[0-9a-f]{3}", plain):
            return "#" + "".join(2 * digit for digit in plain[1:])
    raise Refusal(f"{text!r:.60} is no colour; write #rrggbb or a name such as steelblue")


def rgb(colour: str) -> tuple[int, int, int]:
    """The three bytes of a colour. Raises Refusal."""
    plain = hex_colour(colour)
    return int(plain[1:3], 16), int(plain[3:5], 16), int(plain[5:7], 16)
