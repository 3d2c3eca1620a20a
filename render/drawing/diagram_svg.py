"""A CSG diagram as SVG: paths and text alone, no rasters and no scripts."""

from __future__ import annotations

import re
from dataclasses import dataclass
from xml.sax.saxutils import escape, quoteattr

from .csg_diagram import TEXT, Diagram, Item
from .kind_pictures import FRAME, PRIMITIVES, RADIUS, SYMBOLS, UNKNOWN, WIDTH, Gradient, Path, Shape, shaded

MARGIN = 16.0
FONT = "Inter, 'Segoe UI', 'Helvetica Neue', Arial, 'DejaVu Sans', sans-serif"


@dataclass(frozen=True, slots=True)
class Ink:
    """Colours of a diagram."""

    ground: str = "#ffffff"
    text: str = "#1d242d"
    line: str = "#566170"
    outline: str = "#2b333d"
    circle: str = "#f2f4f7"
    solid: str = "#a9b8c9"


def svg_of(diagram: Diagram, ink: Ink | None = None) -> str:
    """The whole file."""
    return _Writer(diagram, ink or Ink()).text()


def _number(value: float) -> str:
    return f"{value:.2f}".rstrip("0").rstrip(".")


def path_data(path: Path) -> str:
    return " ".join(" ".join((command, *map(_number, numbers))) for command, numbers in path)


class _Writer:
    def __init__(self, diagram: Diagram, ink: Ink) -> None:
        self._diagram, self._ink = diagram, ink
        self._gradients: dict[tuple[Gradient, str], str] = {}

    def text(self) -> str:
        body = [self._edges(), *(self._item(item) for item in self._diagram.items)]
        width, height = self._diagram.width + 2 * MARGIN, self._diagram.height + 2 * MARGIN
        size = f'width="{_number(width)}" height="{_number(height)}"'
        return "\n".join(
            (
                '<?xml version="1.0" encoding="UTF-8"?>',
                f'<svg xmlns="http://www.w3.org/2000/svg" {size} '
                f'viewBox="{_number(-MARGIN)} {_number(-MARGIN)} {_number(width)} {_number(height)}">',
                f"<defs>{''.join(self._definition(*key, name) for key, name in self._gradients.items())}</defs>",
                f'<rect x="{_number(-MARGIN)}" y="{_number(-MARGIN)}" {size} fill="{self._ink.ground}"/>',
                f"<g font-family={quoteattr(FONT)} font-size={quoteattr(_number(TEXT))} "
                f'stroke-linecap="round" stroke-linejoin="round" fill="{self._ink.text}">',
                *body,
                "</g>",
                "</svg>",
                "",
            )
        )

    def _edges(self) -> str:
        items = self._diagram.items
        data = []
        for item in items:
            if item.parent >= 0:
                above = items[item.parent]
                start = ("M", (above.x, above.y + above.height))
                data.append(path_data((start, *(("L", point) for point in self._diagram.edge(item)))))
        return f'<path d="{" ".join(data)}" fill="none" stroke="{self._ink.line}" stroke-width="1.2"/>'

    def _item(self, item: Item) -> str:
        parts = [f"<title>{escape(_legible(item.label))}</title>"]
        if item.role == "operation":
            parts.append(self._operation(item))
        elif item.role == "leaf":
            parts.append(self._leaf(item))
        else:
            parts.append(self._cartouche(item))
        faded = "" if item.visible else ' opacity="0.4"'
        return f'<g transform="translate({_number(item.x)} {_number(item.y)})"{faded}>{"".join(parts)}</g>'

    def _operation(self, item: Item) -> str:
        ink, r = self._ink, _number(RADIUS)
        fill = shaded(item.colour, 0.55) if item.colour else ink.circle
        symbol = (
            f'<circle cy="{r}" r="{r}" fill="{fill}" stroke="{ink.outline}" stroke-width="1.2"/>'
            f'<path transform="translate(0 {r})" d="{path_data(SYMBOLS[item.kind])}" fill="none" '
            f'stroke="{ink.outline}" stroke-width="1.8"/>'
        )
        return symbol + (self._words(item.text, RADIUS + 6, RADIUS + 4, "start") if item.text else "")

    def _leaf(self, item: Item) -> str:
        colour = item.colour or self._ink.solid
        parts = [f'<g transform="translate({_number(-WIDTH / 2)} 0)">']
        symbol = SYMBOLS.get(item.kind)
        if symbol is None:
            parts += [self._shape(shape, colour) for shape in PRIMITIVES.get(item.kind, UNKNOWN)]
        else:
            parts.append(f'<path transform="translate({_number(WIDTH / 2)} 19)" d="{path_data(symbol)}" fill="none" '
                         f'stroke="{self._ink.outline}" stroke-width="1.8"/>')  # fmt: skip
        if item.instance:
            parts.append(f'<path d="{path_data(FRAME)}" fill="none" stroke="{self._ink.line}" stroke-dasharray="3 3"/>')
        parts.append("</g>")
        return "".join(parts) + self._words(item.text, 0, item.height - 4, "middle")

    def _shape(self, shape: Shape, colour: str) -> str:
        if shape.fill is None:
            fill = "none"
        elif isinstance(shape.fill, Gradient):
            name = self._gradients.setdefault((shape.fill, colour), f"g{len(self._gradients)}")
            fill = f"url(#{name})"
        else:
            fill = shaded(colour, shape.fill)
        line = f'stroke="{self._ink.outline}" stroke-width="0.9"' if shape.line else 'stroke="none"'
        return f'<path d="{path_data(shape.path)}" fill="{fill}" fill-rule="evenodd" {line}/>'

    def _cartouche(self, item: Item) -> str:
        ink, result = self._ink, item.role == "result"
        dashes = "" if result else ' stroke-dasharray="3 3"'
        box = (
            f'<rect x="{_number(-item.left)}" y="0" width="{_number(item.left + item.right)}" '
            f'height="{_number(item.height)}" rx="{6 if result else 12}" fill="{ink.circle}" '
            f'stroke="{ink.line}"{dashes}/>'
        )
        weight = ' font-weight="600"' if result else ""
        return box + self._words(item.text, 0, item.height / 2 + 4, "middle", weight)

    def _words(self, text: str, x: float, y: float, anchor: str, more: str = "") -> str:
        return f'<text x="{_number(x)}" y="{_number(y)}" text-anchor="{anchor}"{more}>{escape(_legible(text))}</text>'

    def _definition(self, gradient: Gradient, colour: str, name: str) -> str:
        (x1, y1), (x2, y2) = gradient.start, gradient.end
        stops = "".join(f'<stop offset="{_number(at)}" stop-color="{shaded(colour, shade)}"/>'
                        for at, shade in gradient.stops)  # fmt: skip
        if gradient.radial:
            r = ((x2 - x1) ** 2 + (y2 - y1) ** 2) ** 0.5
            place = f'cx="{_number(x1)}" cy="{_number(y1)}" r="{_number(r)}"'
        else:
            place = f'x1="{_number(x1)}" y1="{_number(y1)}" x2="{_number(x2)}" y2="{_number(y2)}"'
        kind = "radialGradient" if gradient.radial else "linearGradient"
        return f'<{kind} id="{name}" gradientUnits="userSpaceOnUse" {place}>{stops}</{kind}>'


_ILLEGIBLE = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def _legible(text: str) -> str:
    """Without the characters that XML 1.0 (section 2.2) knows no way to write."""
    return _ILLEGIBLE.sub("", text)
