"""Pages as SVG 1.1 (W3C 2011): one user unit is a millimetre, text stays text, a group for each layer.

Groups of nodes carry the ids on the way to their node in `data-path`, and Inkscape shows every group as a layer.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TextIO
from xml.sax.saxutils import escape, quoteattr

from ..project.disk import one_line
from .page import EM, Fill, Floats, Group, Item, Page, Pen, Text
from .paper import scale_words

SEAM = 0.15
"""mm of a face's own colour around it, so that no ground shines through between neighbours."""
DECIMALS = 3
"""Micrometres on paper."""
FONT = "Helvetica, Arial, 'DejaVu Sans', sans-serif"


def write_svg(stream: TextIO, page: Page) -> None:
    """Write the page; the upper left corner is SVG's origin, so y is turned over here."""
    width, height = _number(page.width), _number(page.height)
    stream.write(
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"\n'
        f'     width="{width}mm" height="{height}mm" viewBox="0 0 {width} {height}"\n'
        f'     data-scale="{scale_words(page.scale)}" font-family="{FONT}"\n'
        '     fill="none" stroke-linecap="round" stroke-linejoin="round">\n'
    )
    stream.write(f"  <title>{_words(page.title)}</title>\n")
    stream.write(f'  <rect class="paper" width="{width}" height="{height}" fill="#ffffff"/>\n')
    ids = _Ids()
    open_groups: list[tuple[Group | None, int]] = [(group, 1) for group in reversed(page.groups)]
    while open_groups:
        group, depth = open_groups.pop()
        if group is None:
            stream.write("  " * depth + "</g>\n")
            continue
        stream.write("  " * depth + _opening(group, ids) + "\n")
        for item in group.items:
            stream.write("  " * (depth + 1) + _element(item, page.height) + "\n")
        open_groups.append((None, depth))
        open_groups += [(inner, depth + 1) for inner in reversed(group.groups)]
    stream.write("</svg>\n")


class _Ids:
    """Names for XML's ids, each once."""

    def __init__(self) -> None:
        self._taken: dict[str, int] = {}

    def of(self, words: Sequence[str]) -> str:
        plain = "-".join("".join(c if c.isascii() and c.isalnum() else "-" for c in word.lower()) for word in words)
        plain = plain if plain[:1].isalpha() else f"g{plain}"
        count = self._taken[plain] = self._taken.get(plain, 0) + 1
        return plain if count == 1 else f"{plain}--{count}"


def _opening(group: Group, ids: _Ids) -> str:
    path = [str(step) for step in group.path]
    words = [group.role, *path] if path else [group.name]
    parts = [f'<g id="{ids.of(words)}" class={quoteattr(group.role)}', f"inkscape:label={_quoted(group.name)}"]
    if path:
        parts.append(f"data-path={_quoted('/'.join(path))}")
    return " ".join([*parts, 'inkscape:groupmode="layer">'])


def _element(item: Item, height: float) -> str:
    if isinstance(item, Text):
        return _text(item, height)
    if isinstance(item, Fill):
        data = "".join(_path(contour, height) + "Z" for contour in item.contours)
        seam = f' stroke="{item.colour}" stroke-width="{SEAM}"' if item.role == "face" else ""
        return f'<path class="{item.role}" fill="{item.colour}" fill-rule="evenodd"{seam} d="{data}"/>'
    data = "".join(_line(line, height) for line in item.lines)
    return f'<path class="{item.role}"{_pen(item.pen)} d="{data}"/>'


def _pen(pen: Pen) -> str:
    dash = f' stroke-dasharray="{" ".join(_number(length) for length in pen.dash)}" stroke-linecap="butt"'
    return f' stroke="{pen.colour}" stroke-width="{_number(pen.weight)}"{dash if pen.dash else ""}'


def _text(text: Text, height: float) -> str:
    x, y = _number(text.at[0]), _number(height - text.at[1])
    turned = f' transform="rotate({_number(-text.angle)} {x} {y})"' if text.angle else ""
    anchor = f' text-anchor="{text.anchor}"' if text.anchor != "start" else ""
    return (
        f'<text class="{text.role}" x="{x}" y="{y}"{turned}{anchor} fill="{text.colour}" '
        f'font-size="{_number(text.height * EM)}">{_words(text.words)}</text>'
    )


def _line(points: Floats, height: float) -> str:
    closed = len(points) > 3 and bool((points[0] == points[-1]).all())
    return _path(points[:-1], height) + "Z" if closed else _path(points, height)


def _path(points: Floats, height: float) -> str:
    return "M" + "L".join(f"{_number(x)},{_number(height - y)}" for x, y in points.tolist())


def _number(value: float) -> str:
    text = f"{value:.{DECIMALS}f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def _words(text: str) -> str:
    return escape(one_line(text))


def _quoted(text: str) -> str:
    return quoteattr(one_line(text))
