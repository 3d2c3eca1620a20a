"""Styles of SVG: attributes, style="" and <style> sheets with simple selectors, and what of them is inherited."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from ...document.colours import hex_colour
from ...document.errors import Refusal
from .drawing_shapes import Notes
from .svg_units import length
from .svg_xml import Element

INHERITED = {
    "visibility": "visible",
    "fill": "black",
    "fill-rule": "nonzero",
    "stroke": "none",
    "stroke-width": "1",
    "color": "black",
    "font-size": "medium",
}
"""With their initial values."""
OWN = ("display", "overflow", "clip-path", "mask")
"""What an element does not take from its parent."""
MOST_CHECKS = 3_000_000
"""Of selectors against elements and their ancestors."""
_KEYWORDS = {
    "visibility": {"visible", "hidden", "collapse"},
    "fill-rule": {"nonzero", "evenodd"},
}
_SIZES = {
    "xx-small": 9.0, "x-small": 10.0, "small": 13.0, "medium": 16.0, "large": 18.0, "x-large": 24.0, "xx-large": 32.0,
}  # fmt: skip
_COMMENT = re.compile(r"/\*.*?(?:\*/|\Z)|<!--|-->", re.DOTALL)
_STOP = re.compile(r"[{};]")
_COMPOUND = re.compile(r"(\*|[A-Za-z_][\w-]*)?((?:[.#][\w-]+)*)")
_MARK = re.compile(r"[.#][\w-]+")
_RGB = re.compile(r"rgba?\(\s*([\d.]+)(%?)\s*[,\s]\s*([\d.]+)(%?)\s*[,\s]\s*([\d.]+)(%?)\s*(?:[,/]\s*[\d.]+%?\s*)?\)")

Declarations = dict[str, tuple[str, bool]]
"""Value and whether it is important, by property."""


@dataclass(frozen=True, slots=True)
class Compound:
    """What one element must be: its type (empty: any), id and classes."""

    tag: str
    ids: frozenset[str]
    classes: frozenset[str]

    def fits(self, element: Element) -> bool:
        if (self.tag and element.tag != self.tag) or (self.ids and self.ids != {element.get("id")}):
            return False
        return not self.classes or self.classes.issubset(element.get("class").split())


@dataclass(frozen=True, slots=True)
class Rule:
    """One selector: compounds from the outermost to the element itself, and what it declares."""

    compounds: tuple[Compound, ...]
    children: tuple[bool, ...]
    """of all compounds but the first: whether it must be a child of the one before, not any descendant"""
    order: tuple[int, int, int, int]
    """specificity, and place in the file"""
    declarations: Declarations

    def fits(self, element: Element) -> bool:
        last = len(self.compounds) - 1
        if not self.compounds[last].fits(element):
            return False
        if not any(self.children):  # the nearest ancestor that fits leaves the most for the others
            above = element.parent
            while last and above is not None:
                last -= self.compounds[last - 1].fits(above)
                above = above.parent
            return not last
        chain = []
        above = element.parent
        while above is not None:
            chain.append(above)
            above = above.parent
        # How many compounds are found so far: down to any ancestor, and down to the one just above.
        anywhere, here = {0}, set()
        for ancestor in reversed(chain):
            here = {
                count + 1
                for count in anywhere
                if count < last
                and (not count or not self.children[count - 1] or count in here)
                and self.compounds[count].fits(ancestor)
            }
            anywhere |= here
        return last in (here if self.children[last - 1] else anywhere)

    def cost(self, element: Element) -> int:
        """About how many checks `fits` may take."""
        if len(self.compounds) == 1:
            return 1
        return element.depth * (len(self.compounds) if any(self.children) else 1)


@dataclass(slots=True)
class Sheet:
    """All rules of the <style> elements, by what their last compound asks for."""

    notes: Notes
    ids: dict[str, list[Rule]] = field(default_factory=dict)
    classes: dict[str, list[Rule]] = field(default_factory=dict)
    types: dict[str, list[Rule]] = field(default_factory=dict)
    count: int = 0
    checks: int = 0
    _kept: dict[int, dict[str, str]] = field(default_factory=dict)

    def read(self, text: str) -> None:
        """Adds the rules of one <style>; what is no simple selector is left out with a note."""
        text = _COMMENT.sub(" ", text)
        at = 0
        while stop := _STOP.search(text, at):
            prelude = text[at : stop.start()].strip()
            at = stop.end()
            if stop[0] != "{":
                if prelude.lower().startswith("@import"):
                    self.notes.add("a style sheet imports another file, which is not read")
            elif prelude.startswith("@"):
                at = _after_block(text, at)
                self.notes.add(f"the rules of “{prelude.split()[0]:.40}” in a style sheet are left out")
            else:
                end = text.find("}", at)
                end = len(text) if end < 0 else end
                self._add(prelude, declarations(text[at:end]))
                at = end + 1

    def _add(self, selectors: str, found: Declarations) -> None:
        for selector in selectors.split(","):
            self.count += 1
            parsed = _selector(selector)
            if parsed is None:
                self.notes.add(f"the style selector “{' '.join(selector.split()):.60}” is not simple and is left out")
                continue
            compounds, children = parsed
            ids, classes = sum(len(c.ids) for c in compounds), sum(len(c.classes) for c in compounds)
            rule = Rule(compounds, children, (ids, classes, sum(bool(c.tag) for c in compounds), self.count), found)
            last = compounds[-1]
            if last.ids:
                self.ids.setdefault(min(last.ids), []).append(rule)
            elif last.classes:
                self.classes.setdefault(min(last.classes), []).append(rule)
            else:
                self.types.setdefault(last.tag, []).append(rule)

    def declared(self, element: Element) -> dict[str, str]:
        """What stands for an element itself, by the cascade: attributes, sheets by specificity, style="", !important.

        Remembered, for what `use` shows again: selectors see an element where it stands in the file.
        """
        kept = self._kept.get(id(element))
        if kept is not None:
            return kept
        attributes = element.attributes
        found = {
            name: value for name in (*INHERITED, *OWN) if accepted(name, value := attributes.get(name, "").strip())
        }
        rules: list[Rule] = []
        if self.count:
            nearest = [self.types.get("", []), self.types.get(element.tag, []), self.ids.get(element.get("id"), [])]
            nearest += [self.classes.get(name, []) for name in dict.fromkeys(element.get("class").split())]
            self.checks += sum(rule.cost(element) for group in nearest for rule in group)
            if self.checks > MOST_CHECKS:
                raise Refusal("has too many style rules for its many elements; save it with styles as attributes")
            rules = sorted((rule for group in nearest for rule in group if rule.fits(element)), key=lambda r: r.order)
        layers = [rule.declarations for rule in rules]
        layers.append(declarations(attributes["style"]) if "style" in attributes else {})
        for wanted in (False, True):
            for layer in layers:
                found.update({name: value for name, (value, important) in layer.items() if important == wanted})
        self._kept[id(element)] = found
        return found


def _after_block(text: str, at: int) -> int:
    """Where the block ends that began before `at`; blocks may hold blocks."""
    depth = 1
    while depth and (stop := _STOP.search(text, at)):
        depth += {"{": 1, "}": -1, ";": 0}[stop[0]]
        at = stop.end()
    return len(text) if depth else at


def _selector(text: str) -> tuple[tuple[Compound, ...], tuple[bool, ...]] | None:
    compounds: list[Compound] = []
    children: list[bool] = []
    child = False
    for word in text.replace(">", " > ").split():
        if word == ">":
            if child or not compounds:
                return None
            child = True
            continue
        match = _COMPOUND.fullmatch(word)
        if not match:
            return None
        marks = _MARK.findall(match[2])
        ids = frozenset(mark[1:] for mark in marks if mark[0] == "#")
        classes = frozenset(mark[1:] for mark in marks if mark[0] == ".")
        if compounds:
            children.append(child)
        compounds.append(Compound((match[1] or "").replace("*", ""), ids, classes))
        child = False
    return None if child or not compounds or len(compounds) > 50 else (tuple(compounds), tuple(children))


def declarations(text: str) -> Declarations:
    """The properties that mean something here, of a style attribute or a rule's block; wrong values are left out."""
    found: Declarations = {}
    for part in _COMMENT.sub(" ", text).split(";"):
        name, _, value = part.partition(":")
        name, value = name.strip().lower(), value.strip()
        important = value.lower().replace(" ", "").endswith("!important")
        if important:
            value = value[: value.rindex("!")].strip()
        if (name in INHERITED or name in OWN) and accepted(name, value):
            if not important and found.get(name, ("", False))[1]:
                continue
            found[name] = (value, important)
    return found


def accepted(name: str, value: str) -> bool:
    """Whether a value may stand for a property; others are as if they were not there."""
    if not value:
        return False
    if value in ("inherit", "initial", "unset") or name in OWN:
        return True
    if name in _KEYWORDS:
        return value in _KEYWORDS[name]
    if name == "stroke-width":
        size = length(value, 1.0, 1.0)
        return size is not None and size >= 0.0
    if name == "font-size":
        size = length(value, 1.0, 1.0)
        return value in _SIZES or (size is not None and size >= 0.0)
    return True


def computed(declared: dict[str, str], parent: dict[str, str]) -> dict[str, str]:
    """All inherited properties of an element; those of the parent where nothing is declared. Font sizes become px."""
    found = dict(parent)
    for name, value in declared.items():
        if name in INHERITED and value not in ("inherit", "unset"):
            found[name] = INHERITED[name] if value == "initial" else value
    size = found["font-size"]
    if size != parent.get("font-size"):
        outer = float(parent.get("font-size", "16"))
        found["font-size"] = repr(_SIZES[size] if size in _SIZES else length(size, outer, outer) or 0.0)
    if found["color"].lower() == "currentcolor":
        found["color"] = parent.get("color", "black")
    return found


def root_style() -> dict[str, str]:
    return {**INHERITED, "font-size": "16.0"}


def colour_of(paint: str, current: str) -> tuple[bool, str | None]:
    """Whether a fill or stroke paints at all, and its colour where it is a plain one that is known."""
    if len(paint) > 200:
        return True, None
    if paint.startswith("url("):
        rest = paint.partition(")")[2].strip()
        return True, colour_of(rest, current)[1] if rest else None
    if paint.lower() in ("none", "transparent"):
        return False, None
    if paint.lower() == "currentcolor":
        return (True, None) if current.lower() == "currentcolor" else colour_of(current, "black")
    if match := _RGB.fullmatch(paint.lower()):
        parts = []
        for value, percent in zip(match.groups()[::2], match.groups()[1::2], strict=True):
            try:
                parts.append(min(round(float(value) * 255.0 / 100.0 if percent else float(value)), 255))
            except (ValueError, OverflowError):
                return True, None
        return True, "#" + "".join(f"{part:02x}" for part in parts)
    try:
        return True, hex_colour(paint)
    except Refusal:
        return True, None
