"""The XML of an SVG file as a tree of elements, by expat: no entity is expanded and nothing outside is read."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import NoReturn
from xml.parsers import expat

from ...document.errors import Refusal
from ..parts import words_of

SVG = "http://www.w3.org/2000/svg"
_KEPT = {
    "http://www.w3.org/1999/xlink href": "xlink:href",
    "http://www.inkscape.org/namespaces/inkscape label": "inkscape:label",
}
"""Attributes of other namespaces that mean something here."""
MAX_DEPTH = 1_000
MAX_ELEMENTS = 1_000_000
_HEAD = 4096
_PLAIN = "save it as plain SVG"


@dataclass(slots=True, eq=False)
class Element:
    """One element; `tag` is empty for what is not of SVG's namespace."""

    tag: str
    attributes: dict[str, str]
    parent: Element | None
    line: int
    depth: int = 1
    children: list[Element] = field(default_factory=list)
    text: str = ""
    """of <style> alone"""

    def get(self, name: str, default: str = "") -> str:
        return self.attributes.get(name, default)


def read_xml(data: bytes) -> tuple[Element, dict[str, Element]]:
    """The root <svg> and the elements by id, of equal ids the first. Raises Refusal."""
    reader = _Reader()
    parser = reader.parser
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        what, line, column = expat.ErrorString(error.code), error.lineno, error.offset + 1
        if reader.root is None and not re.match(rb"\W*<(?s:.*)svg\b", data[:_HEAD]):
            raise Refusal(f"is no SVG file: it begins with {words_of(data[:60])}") from None
        raise Refusal(f"line {line:,}, column {column:,}: {what}; save it again, or {_PLAIN}") from None
    except (LookupError, ValueError):  # of the encoding that the first line names
        raise Refusal("is written in an encoding that is not read; save it as UTF-8") from None
    assert reader.root is not None
    return reader.root, reader.ids


class _Reader:
    def __init__(self) -> None:
        self.root: Element | None = None
        self.ids: dict[str, Element] = {}
        self._open: list[Element] = []
        self._count = 0
        self._text: list[str] = []
        parser = self.parser = expat.ParserCreate(namespace_separator=" ")
        parser.buffer_text = True
        parser.StartDoctypeDeclHandler = self._doctype
        parser.EntityDeclHandler = self._entity
        parser.SkippedEntityHandler = self._skipped
        parser.ExternalEntityRefHandler = self._outside
        parser.StartElementHandler, parser.EndElementHandler = self._start, self._end

    def _refuse(self, what: str) -> NoReturn:
        raise Refusal(f"line {self.parser.CurrentLineNumber:,}: {what}")

    def _doctype(self, _name: str, system: str | None, public: str | None, _subset: int) -> None:
        # W3C's own declaration stands in most older files and says nothing; it is not fetched.
        if system and not (public or "").startswith("-//W3C//DTD SVG"):
            self._refuse(f"asks for another file, “{system:.80}”, which is never read; {_PLAIN}")

    def _entity(self, name: str, *_: object) -> None:
        self._refuse(f"declares the entity “{name:.40}”; entities are never expanded; {_PLAIN}")

    def _skipped(self, name: str, _parameter: int) -> None:
        self._refuse(f"uses the entity “{name:.40}”; entities are never expanded; {_PLAIN}")

    def _outside(self, *_: object) -> NoReturn:
        self._refuse(f"asks for another file, which is never read; {_PLAIN}")

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        space, _, local = name.rpartition(" ")
        if self.root is None and (local != "svg" or space not in ("", SVG)):
            raise Refusal(f"is no SVG file: its first element is “{local:.40}”, not “svg”")
        if len(self._open) >= MAX_DEPTH:
            self._refuse(f"elements are nested more than {MAX_DEPTH:,} deep")
        self._count += 1
        if self._count > MAX_ELEMENTS:
            self._refuse(f"the file has more than {MAX_ELEMENTS:,} elements; split it")
        kept = {_KEPT.get(key, key): value for key, value in attributes.items() if " " not in key or key in _KEPT}
        parent = self._open[-1] if self._open else None
        element = Element(
            local if space in ("", SVG) else "", kept, parent, self.parser.CurrentLineNumber, len(self._open) + 1
        )
        if parent is None:
            self.root = element
        else:
            parent.children.append(element)
        if "id" in kept:
            self.ids.setdefault(kept["id"], element)
        self._open.append(element)
        if element.tag == "style":
            self.parser.CharacterDataHandler = self._text.append

    def _end(self, _name: str) -> None:
        element = self._open.pop()
        if element.tag == "style":
            element.text = "".join(self._text)
            self._text.clear()
            self.parser.CharacterDataHandler = None
