"""SVG in: the outlines of a drawing in millimetres (96 px per inch) with y up, curves kept as curves.

After SVG 1.1 (second edition) and SVG 2: shapes, paths, groups, nested <svg>, <symbol>, <use>, <switch>, transforms,
styles and units. Clipping, masks, text, pictures and patterns are left out and noted.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...document.errors import Refusal
from .drawing_shapes import Affine, Drawing, Notes, Outline, Shape
from .svg_path import read_path
from .svg_shapes import BASIC, basic_shape
from .svg_style import Sheet, colour_of, computed, root_style
from .svg_units import PIXEL, Viewport, length, product, scale_of, stretch_of, transform, view_box, view_matrix
from .svg_xml import Element, read_xml

MOST_USED = 200_000
"""Elements that uses show, each time counted."""
MOST_POINTS = 10_000_000
MOST_USED_POINTS = 500_000
MOST_NESTED = 100
"""Uses within uses."""
_GROUPS = ("g", "a")
_LEFT_OUT = {
    "text": "text is left out; turn it into paths in the program that made the file",
    "image": "pictures are left out",
    "foreignObject": "what is no SVG (foreignObject) is left out",
}
_CUT = {"clip-path": "clipping (clip-path) is not applied: shapes are whole", "mask": "masks are not applied"}


def read_svg(data: bytes, tolerance: float | None = None) -> Drawing:
    """The shapes of an SVG file, from back to front; hidden ones and what is only defined are left out.

    Arcs, circles and round corners become cubics: a quarter turn each at most, 2.73e-4 of the larger radius outside
    the true curve at most, or as many as keep within `tolerance` mm. The page's lower left corner is the origin;
    without a page the file's origin is. Raises Refusal.
    """
    if data[:2] == b"\x1f\x8b":
        raise Refusal("is a compressed SVG (.svgz); unpack it first, or save it uncompressed")
    root, ids = read_xml(data)
    with np.errstate(all="ignore"):  # what is too far is refused by its points
        return _Reader(ids, tolerance).drawing(root)


@dataclass(frozen=True, slots=True)
class _Frame:
    """What an element finds when it is reached."""

    matrix: Affine
    style: dict[str, str]
    viewport: Viewport
    size: tuple[str, str] = ("", "")
    """width and height that a `use` gives to a symbol or an svg"""
    nested: int = 0
    window: tuple[Affine, float, float] | None = None
    """the innermost nested svg or symbol that clips: the matrix of its corner, its width and height"""


class _Reader:
    def __init__(self, ids: dict[str, Element], tolerance: float | None) -> None:
        self.ids, self.tolerance = ids, tolerance
        self.notes = Notes()
        self.sheet = Sheet(self.notes)
        self.shapes: list[Shape] = []
        self._open: set[int] = set()
        self._stack: list[tuple[Element, _Frame | None]] = []
        self._points = self._used_points = 0

    def drawing(self, root: Element) -> Drawing:
        self._read_sheets(root)
        frame, size = self._page(root)
        used = 0
        if frame is not None:
            self._enter(root, frame)
        while self._stack:
            element, inside = self._stack.pop()
            if inside is None:
                self._open.discard(id(element))
                continue
            used += inside.nested > 0
            if used > MOST_USED:
                raise Refusal(f"its uses show more than {MOST_USED:,} elements; simplify the file")
            self._visit(element, inside)
        return Drawing(tuple(self.shapes), self.notes.lines(), size)

    def _read_sheets(self, root: Element) -> None:
        stack = [root]
        while stack:
            element = stack.pop()
            if element.tag == "style" and element.get("type", "text/css") in ("text/css", ""):
                self.sheet.read(element.text)
            stack.extend(reversed(element.children))

    def _page(self, root: Element) -> tuple[_Frame | None, tuple[float, float] | None]:
        """What the root's children find, and the page's size in mm; no frame where the page hides everything."""
        style = computed(self.sheet.declared(root), root_style())
        font = float(style["font-size"])
        box = view_box(root.get("viewBox"))
        sides = []
        for name in ("width", "height"):
            text = root.get(name)
            # A share of what stands around the page says nothing here.
            side = None if text.strip().endswith("%") else length(text, 0.0, font)
            sides.append(None if side is None or side < 0.0 else side)
        width, height = sides
        if (box and not (box[2] and box[3])) or width == 0.0 or height == 0.0:
            self.notes.add("the page has no extent, so that nothing of it shows")
            return None, None
        if box:
            if width is None and height is None:
                width, height = box[2:]
            elif width is None:
                width = (height or 0.0) * box[2] / box[3]
            elif height is None:
                height = width * box[3] / box[2]
        mm: Affine = (PIXEL, 0.0, 0.0, -PIXEL, 0.0, PIXEL * (height or 0.0))
        whole = width is not None and height is not None
        size = (PIXEL * width, PIXEL * height) if width is not None and height is not None else None
        viewport = Viewport(width or 300.0, height or 150.0)  # CSS: the size of what has none
        if box and whole:
            mm = product(mm, view_matrix(box, viewport.width, viewport.height, root.get("preserveAspectRatio")))
            viewport = Viewport(box[2], box[3])
        own = transform(root.get("transform"))
        mm = product(mm, own) if own else mm
        if self.sheet.declared(root).get("display") == "none":
            return None, size
        return _Frame(mm, style, viewport), size

    def _enter(self, element: Element, frame: _Frame, children: list[Element] | None = None) -> None:
        """Puts an element's children on the stack; while they are there, it is open."""
        if id(element) not in self._open:
            self._open.add(id(element))
            self._stack.append((element, None))
        self._stack.extend((child, frame) for child in reversed(element.children if children is None else children))

    def _visit(self, element: Element, frame: _Frame) -> None:
        tag = element.tag
        if tag in _LEFT_OUT:
            self.notes.add(_LEFT_OUT[tag])
        known = tag == "path" or tag in BASIC or tag in _GROUPS or tag in ("svg", "use", "switch")
        if not known and not (tag == "symbol" and frame.nested):
            return
        declared = self.sheet.declared(element)
        if declared.get("display") == "none":
            return
        for name, words in _CUT.items():
            if declared.get(name, "none") != "none":
                self.notes.add(words)
        matrix = frame.matrix
        if text := element.get("transform"):
            own = transform(text)
            if own is None:
                self.notes.add(f"{_called(element)}: the transform “{text.strip():.60}” cannot be read and is left out")
            else:
                matrix = product(matrix, own)
        if not scale_of(matrix):
            return
        style = computed(declared, frame.style)
        inside = _Frame(matrix, style, frame.viewport, nested=frame.nested, window=frame.window)
        if tag in _GROUPS:
            self._enter(element, inside)
        elif tag == "switch":
            self._enter(element, inside, _chosen(element))
        elif tag == "use":
            self._use(element, inside)
        elif tag in ("svg", "symbol"):
            self._nested(element, inside, frame.size)
        else:
            self._shape(element, inside)

    def _size(self, element: Element, frame: _Frame, name: str, axis: str, text: str | None = None) -> float | None:
        text = element.get(name) if text is None else text
        if not text.strip() or text.strip() == "auto":
            return None
        found = length(text, frame.viewport.whole(axis), float(frame.style["font-size"]))
        if found is None:
            self.notes.add(f"{_called(element)}: “{text.strip():.30}” is no length, so {name} is left out")
        return found

    def _nested(self, element: Element, frame: _Frame, given: tuple[str, str]) -> None:
        matrix = frame.matrix
        if element.tag == "svg":
            x, y = self._size(element, frame, "x", "x") or 0.0, self._size(element, frame, "y", "y") or 0.0
            matrix = product(matrix, (1.0, 0.0, 0.0, 1.0, x, y))
        sides = []
        for name, axis, text in zip(("width", "height"), "xy", given, strict=True):
            side = self._size(element, frame, name, axis, text or None)
            sides.append(frame.viewport.whole(axis) if side is None else side)
        width, height = sides
        box = view_box(element.get("viewBox"))
        if not (width > 0.0 and height > 0.0) or (box and not (box[2] and box[3])):
            return
        viewport = Viewport(width, height)
        clips = self.sheet.declared(element).get("overflow") not in ("visible", "auto")
        window = (matrix, width, height) if clips else frame.window
        if box:
            matrix = product(matrix, view_matrix(box, width, height, element.get("preserveAspectRatio")))
            viewport = Viewport(box[2], box[3])
        self._enter(element, _Frame(matrix, frame.style, viewport, nested=frame.nested, window=window))

    def _use(self, element: Element, frame: _Frame) -> None:
        reference = (element.get("href") or element.get("xlink:href")).strip()
        target = self.ids.get(reference[1:]) if reference.startswith("#") else None
        if target is None:
            if reference:
                what = "is not in the file" if reference.startswith("#") else "is another file, which is never read"
                self.notes.add(f"{_called(element)}: “{reference:.60}” {what}")
            return
        if id(target) in self._open or target is element:
            self.notes.add(f"{_called(element)} would show itself again within itself; it is left out")
            return
        if frame.nested >= MOST_NESTED:
            raise Refusal(f"line {element.line:,}: uses are nested more than {MOST_NESTED} deep")
        x, y = self._size(element, frame, "x", "x") or 0.0, self._size(element, frame, "y", "y") or 0.0
        matrix = product(frame.matrix, (1.0, 0.0, 0.0, 1.0, x, y))
        size = (element.get("width"), element.get("height"))
        self._enter(
            element, _Frame(matrix, frame.style, frame.viewport, size, frame.nested + 1, frame.window), [target]
        )

    def _shape(self, element: Element, frame: _Frame) -> None:
        style = frame.style
        if style["visibility"] != "visible":
            return
        tolerance = None if self.tolerance is None else self.tolerance / stretch_of(frame.matrix)
        if element.tag == "path":
            outline, fault = read_path(element.get("d"), tolerance)
        else:

            def size(name: str, axis: str) -> float | None:
                return self._size(element, frame, name, axis)

            outline, fault = basic_shape(element.tag, size, element.get("points"), tolerance)
        if fault:
            self.notes.add(f"{_called(element)}: {fault}")
        self._points += len(outline.points) // 2
        self._used_points += len(outline.points) // 2 * (frame.nested > 0)
        if self._points > MOST_POINTS or self._used_points > MOST_USED_POINTS:
            most = f"its uses show more than {MOST_USED_POINTS:,} points"
            raise Refusal(f"{most if frame.nested else f'has more than {MOST_POINTS:,} points'}; simplify the file")
        try:
            contours = outline.contours(frame.matrix)
        except Refusal as refusal:
            raise Refusal(f"{_called(element)} {refusal}") from None
        if not contours:
            return
        if frame.window is not None and _leaves(outline, frame.matrix, *frame.window):
            self.notes.add("a nested svg or symbol would cut what runs over its edge; here it is whole")
        filled, colour = colour_of(style["fill"], style["color"])
        stroked, ink = colour_of(style["stroke"], style["color"])
        width = length(style["stroke-width"], frame.viewport.whole(""), float(style["font-size"])) or 0.0
        stroked = stroked and width > 0.0
        self.shapes.append(
            Shape(
                contours,
                style["fill-rule"],
                filled,
                stroked,
                width * scale_of(frame.matrix) if stroked else 0.0,
                (element.get("inkscape:label") or element.get("id"))[:200],
                colour if filled else ink if stroked else None,
            )
        )


def _leaves(outline: Outline, matrix: Affine, corner: Affine, width: float, height: float) -> bool:
    """Whether control points lie outside the rectangle (0, 0) to (width, height) of another system."""
    a, b, c, d, e, f = matrix
    points = np.array(outline.points).reshape(-1, 2) @ [[a, b], [c, d]] + (e, f)
    p, q, r, s, t, u = corner
    own = (points - (t, u)) @ np.linalg.inv([[p, q], [r, s]])
    slack = 1e-6 * max(width, height)
    return bool((own < -slack).any() or (own > np.array((width, height)) + slack).any())


def _called(element: Element) -> str:
    name = element.get("id")
    return f"{element.tag} “{name:.40}” in line {element.line:,}" if name else f"{element.tag} in line {element.line:,}"


def _chosen(switch: Element) -> list[Element]:
    """The first child of a <switch> that asks for nothing that is not there, or for English."""
    for child in switch.children:
        languages = child.attributes.get("systemLanguage")
        spoken = languages is None or any(tag.strip().lower().split("-")[0] == "en" for tag in languages.split(","))
        if child.tag and spoken and not child.get("requiredExtensions").strip():
            return [child]
    return []
