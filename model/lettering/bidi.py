"""Which way characters run, by the Unicode bidirectional algorithm (UAX #9), of the Rust crate unicode-bidi."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence

from bidi import get_display

_LEVEL = re.compile(r"Level\(\s*(\d+)")
RIGHT_TO_LEFT = ("R", "AL", "AN", "RLE", "RLO", "RLI")


def levels_of(text: str, direction: str = "auto") -> list[int]:
    """The embedding level of each character of one paragraph, odd where it runs from right to left.

    `direction` of the paragraph is "auto" (that of the first letter), "ltr" or "rtl".
    """
    if direction != "rtl" and not any(unicodedata.bidirectional(one) in RIGHT_TO_LEFT for one in text):
        return [0] * len(text)
    base = {"ltr": "L", "rtl": "R"}.get(direction)
    told = str(get_display(text, base_dir=base, debug=True))  # the only way in which the levels come out
    of_bytes = [
        int(level) for level in _LEVEL.findall(told[told.rindex("    levels: [") : told.rindex("    paragraphs: [")])
    ]
    levels, place = [], 0
    for character in text:
        levels.append(of_bytes[place])
        place += len(character.encode())
    return levels


def visual_order(levels: Sequence[int]) -> list[int]:
    """In which order, from the left, pieces of one line stand that have these levels (rule L2)."""
    order = list(range(len(levels)))
    lowest_odd = min((level for level in levels if level % 2), default=1)
    for level in range(max(levels, default=0), lowest_odd - 1, -1):
        begin = 0
        while begin < len(order):
            if levels[order[begin]] < level:
                begin += 1
                continue
            end = begin
            while end < len(order) and levels[order[end]] >= level:
                end += 1
            order[begin:end] = order[begin:end][::-1]
            begin = end
    return order
