"""The CSG diagram of the textbooks: the result at the top, operations in circles, primitives as pictures below.

Operands stand in their order, what a difference is cut from at the left. Nothing here draws: a Diagram says what
stands where, in pixels at a scale of 1, with y downwards.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import accumulate
from pathlib import Path

from ...model.document.document import Document
from ...model.document.kind_names import function_name
from ...model.document.nodes import Instance, Node
from ...model.document.tree import chosen_solids
from ...model.editing.echo import number_text
from .kind_pictures import HEIGHT, RADIUS, SYMBOLS, WIDTH
from .tidy_tree import TidyTree

LEVEL = 98.0  # from one level to the next
TRUNK = 60.0  # below the top of its level a parent's lines part, where no name stands any more
GAP = 14.0  # between neighbours
BETWEEN = 36.0  # between the trees of two solids
TEXT = 11.0  # the size of the letters
CARTOUCHE, FOLD = 26.0, 24.0  # heights of a result's name, and of what stands for operands left out
LABEL = 18  # letters; longer names are cut
SHEET = (297.0, 210.0)  # the shape of what is written to a file
MOST_ROWS = 50  # ways to break the solids into rows that are tried
WIDE, FIRST = 12, 6  # more operands than WIDE are folded behind the FIRST


@dataclass(frozen=True, slots=True)
class Item:
    """One thing in the diagram. `x` is its middle, `y` its top; it reaches from x - left to x + right."""

    role: str
    """`result`, `operation`, `leaf`, or `fold`, which stands for operands of `node_id` that are left out."""
    node_id: str
    kind: str
    """As scripts call it; of an instance, the kind of its definition."""
    label: str
    """All of the name; `text` is what there is room for."""
    text: str
    left: float
    right: float
    height: float
    parent: int = -1
    """Its place in the list of items, -1 for a result."""
    colour: str | None = None
    visible: bool = True
    instance: bool = False
    x: float = 0.0
    y: float = 0.0


@dataclass(frozen=True, slots=True)
class Diagram:
    """Parents stand before their children. `width` and `height` hold all, from 0, 0."""

    items: tuple[Item, ...]
    width: float
    height: float
    contour_steps: int = 0

    def edge(self, item: Item) -> tuple[tuple[float, float], ...]:
        """The points of the line to an item from the foot of its parent, the first of them left out."""
        above = self.items[item.parent]
        return (above.x, above.y + TRUNK), (item.x, item.y)


def text_width(text: str) -> float:
    """About how wide a text is in a sans-serif font of size TEXT; on the safe side for Latin letters."""
    return sum(TEXT * (0.62 if ord(letter) < 0x2E80 else 1.05) for letter in text)


def diagram_of(
    root: Node,
    definitions: Mapping[str, Node] | None = None,
    opened: Collection[str] = (),
    measure: Callable[[str], float] = text_width,
    result: str = "",
) -> Diagram:
    """The diagram of one solid. Wide operations are folded unless their id is in `opened`.

    `measure` tells how wide a text is; `result` is what stands at the top, the solid's name by default.
    """
    known = definitions or {}
    text = _short(result or root.label)
    half = measure(text) / 2 + 12
    items = [Item("result", root.id, "", result or root.label, text, half, half, CARTOUCHE, visible=root.visible)]
    children: list[list[int]] = [[]]
    stack: list[tuple[Node | int, int, bool, str | None]] = [(root, 0, True, None)]
    while stack:
        node, parent, visible, colour = stack.pop()
        children[parent].append(len(items))
        children.append([])
        if isinstance(node, int):
            words = f"… {node} more"
            half = measure(words) / 2 + 8
            above = items[parent]
            items.append(Item("fold", above.node_id, "", f"{node} more operands of “{above.label}”", words, half, half,
                              FOLD, parent, visible=visible))  # fmt: skip
            continue
        visible, colour = visible and node.visible, node.colour or colour
        shown: Sequence[Node | int] = node.children
        if len(shown) > WIDE and node.id not in opened:
            shown = (*shown[:FIRST], len(shown) - FIRST)
        place = len(items)
        items.append(replace(_item(node, known, measure, node is root), parent=parent, visible=visible, colour=colour))
        stack += [(child, place, visible, colour) for child in reversed(shown)]
    tidy = TidyTree(children, [item.left for item in items], [item.right for item in items], GAP)
    lowest = min(x - item.left for x, item in zip(tidy.x, items, strict=True))
    placed = tuple(
        replace(item, x=x - lowest, y=depth * LEVEL) for item, x, depth in zip(items, tidy.x, tidy.depth, strict=True)
    )
    width = max(item.x + item.right for item in placed)
    return Diagram(placed, width, max(item.y + item.height for item in placed), tidy.contour_steps)


def _item(node: Node, definitions: Mapping[str, Node], measure: Callable[[str], float], top: bool) -> Item:
    if isinstance(node, Instance):
        shared = definitions.get(node.definition)
        kind = function_name(type(shared or node))
        label = node.name or (f"Instance of {shared.label}" if shared else node.label)
    else:
        kind, label = function_name(type(node)), node.label
    if kind in SYMBOLS and not isinstance(node, Instance):
        named = "" if top or not node.name else _short(node.name)
        count = getattr(node, "count", None)
        words = "  ".join(part for part in (f"× {number_text(count)}" if count is not None else "", named) if part)
        right = RADIUS + (measure(words) + 6 if words else 0)
        return Item("operation", node.id, kind, label, words, RADIUS, right, 2 * RADIUS)
    text = _short(label)
    half = max(WIDTH, measure(text)) / 2
    return Item("leaf", node.id, kind, label, text, half, half, HEIGHT + TEXT + 6, instance=isinstance(node, Instance))


def _short(name: str) -> str:
    name = " ".join(name.split())
    return name if len(name) <= LABEL else name[: LABEL - 1].rstrip() + "…"


def roots_of(document: Document, solid: str | None = None) -> list[tuple[Node, str]]:
    """What a document's diagram shows, with titles: its solids, profiles and definitions, or the one solid of this
    name.

    Raises Refusal.
    """
    if solid is not None:
        return [(root, root.label) for root in chosen_solids(document, solid)]
    return [
        *((root, root.label) for root in document.standing),
        *((root, f"{root.label} (definition)") for root in document.definitions),
    ]


def packed(diagrams: Sequence[Diagram], width: float, height: float) -> Diagram:
    """Several diagrams as one, in rows so that all of it is as large as can be in a frame of this shape."""
    ends = list(accumulate(diagram.width + BETWEEN for diagram in diagrams))
    widths = {*ends[:MOST_ROWS], *ends[-1:], *(diagram.width + BETWEEN for diagram in diagrams[:MOST_ROWS])}
    best: tuple[float, list[tuple[float, float]], float, float] = (0.0, [], 0.0, 0.0)
    for limit in sorted(widths):
        places, wide, high = _rows(diagrams, limit)
        scale = min(width / max(wide, 1.0), height / max(high, 1.0))
        if scale > best[0]:
            best = (scale, places, wide, high)
    items: list[Item] = []
    for diagram, (x, y) in zip(diagrams, best[1], strict=True):
        first = len(items)
        items += [
            replace(item, x=item.x + x, y=item.y + y, parent=item.parent + first if item.parent >= 0 else -1)
            for item in diagram.items
        ]
    return Diagram(tuple(items), best[2], best[3], sum(d.contour_steps for d in diagrams))


def _rows(diagrams: Sequence[Diagram], limit: float) -> tuple[list[tuple[float, float]], float, float]:
    """The corners of the diagrams in rows no wider than `limit` where they need not be, and the size of all."""
    places: list[tuple[float, float]] = []
    x = y = wide = high = 0.0
    for diagram in diagrams:
        if x and x + diagram.width > limit:
            x, y, high = 0.0, y + high + BETWEEN, 0.0
        places.append((x, y))
        x += diagram.width + BETWEEN
        wide, high = max(wide, x - BETWEEN), max(high, diagram.height)
    return places, wide, y + high


def diagram(what: Node | Document, path: str | Path, solid: str | None = None) -> None:
    """Write the diagram of a solid or of a document as SVG. Raises Refusal, OSError."""
    from .diagram_svg import svg_of

    document = what if isinstance(what, Document) else Document(solids=(what,))
    definitions = {root.id: root for root in document.definitions}
    parts = [diagram_of(root, definitions, result=title) for root, title in roots_of(document, solid)]
    Path(path).write_text(svg_of(packed(parts, *SHEET)), encoding="utf-8")
