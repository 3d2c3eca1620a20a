"""The XML of 3MF: what stands in one model file, checked as the specification asks."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import NoReturn, Self
from xml.parsers import expat

import numpy as np
from numpy.typing import NDArray

from ..document.colours import hex_colour
from ..document.errors import Refusal
from ..document.placement import IDENTITY
from .parts import MAX_TRIANGLES

_BASE = "http://schemas.microsoft.com/3dmanufacturing/"
MATERIAL = _BASE + "material/2015/02"
PRODUCTION = _BASE + "production/2015/06"
BEAMS = _BASE + "beamlattice/2017/02"
# Extensions that a file may demand: read, or of no meaning to the solid (slices), or said to be left out (beams).
EXTENSIONS = {MATERIAL, PRODUCTION, BEAMS, _BASE + "slice/2015/07", _BASE + "trianglesets/2021/07"}
TYPES = ("model", "solidsupport", "support", "surface", "other")
NEEDED = {
    "texture2d": ("path", "contenttype"),
    "texture2dgroup": ("texid",),
    "compositematerials": ("matid", "matindices"),
    "multiproperties": ("pids",),
}


class XmlReader:
    """Reads XML piece by piece; names come as “namespace name”. Document types, and so entities, are refused."""

    def __init__(self, name: str) -> None:
        self.name = name
        self._parser = expat.ParserCreate(namespace_separator=" ")

    def read(self, chunks: Iterable[bytes]) -> Self:
        """Calls start, end and namespace for what the chunks hold. Raises Refusal."""
        parser = self._parser
        parser.StartDoctypeDeclHandler = lambda *_: self.refuse("a document type is not allowed here")
        parser.StartElementHandler, parser.EndElementHandler = self.start, self.end
        parser.StartNamespaceDeclHandler = self.namespace
        try:
            for chunk in chunks:
                parser.Parse(chunk)
            parser.Parse(b"", True)
        except expat.ExpatError as error:
            what = expat.ErrorString(error.code)
            raise Refusal(f"{self.name}, line {error.lineno}, column {error.offset + 1}: {what}") from None
        return self

    @property
    def line(self) -> int:
        return self._parser.CurrentLineNumber

    def start(self, tag: str, attributes: dict[str, str]) -> None: ...

    def end(self, tag: str) -> None: ...

    def namespace(self, prefix: str | None, uri: str | None) -> None: ...

    def refuse(self, what: str, line: int = 0) -> NoReturn:
        raise Refusal(f"{self.name}, line {line or self.line}: {what}")


@dataclass
class Reference:
    """An item or a component: an object, where it is, and where it goes."""

    object: int
    path: str
    matrix: NDArray[np.float64]
    line: int
    number: str = ""


@dataclass
class Thing:
    """An object: a mesh or components."""

    name: str
    line: int
    colour: str | None = None
    vertices: NDArray[np.float64] = field(default_factory=lambda: np.zeros((0, 3)))
    triangles: NDArray[np.int64] = field(default_factory=lambda: np.zeros((0, 3), dtype=np.int64))
    components: list[Reference] = field(default_factory=list)
    note: str = ""


class Model(XmlReader):
    """One model file as it is read."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.unit = "millimeter"
        self.objects: dict[int, Thing] = {}
        self.items: list[Reference] | None = None
        self.resources = False
        self._kinds: dict[int, str] = {}
        self._colours: dict[int, list[str | None]] = {}
        self._prefixes: dict[str, str] = {}
        self._core = self._vertex = self._triangle = ""
        self._open: list[str] = []
        self._group: list[str | None] = []
        self._thing: Thing | None = None
        self._paint: tuple[str, str] = ("", "")
        self._painted: set[tuple[str, str]] = set()
        self._texts: list[str] = []
        self._corners: list[str] = []

    def namespace(self, prefix: str | None, uri: str | None) -> None:
        self._prefixes[prefix or ""] = uri or ""

    def start(self, tag: str, attributes: dict[str, str]) -> None:
        if tag == self._vertex:
            try:
                self._texts += (attributes["x"], attributes["y"], attributes["z"])
            except KeyError as missing:
                self.refuse(f"a vertex has no {missing.args[0]}")
            return
        if tag == self._triangle:
            self._add_triangle(attributes)
            return
        space, _, word = tag.rpartition(" ")
        self._open.append(word)
        if not self._core:
            if word != "model" or not space.startswith(_BASE):
                self.refuse(f"its first element is <{word[:40]}>, not the <model> of 3MF")
            self._core, self._vertex, self._triangle = space, f"{space} vertex", f"{space} triangle"
            self._root(attributes)
        elif space == self._core:
            self._element(word, attributes)
        elif space == MATERIAL:
            self._material(word, attributes)
        elif space == BEAMS and word == "beamlattice" and self._thing is not None:
            self._thing.note = "The file has a beam lattice here, which is not read."

    def _root(self, attributes: dict[str, str]) -> None:
        self.unit = attributes.get("unit", "millimeter")
        for prefix in attributes.get("requiredextensions", "").split():
            uri = self._prefixes.get(prefix, prefix)
            if uri not in EXTENSIONS:
                self.refuse(f"the file needs the extension {uri[:80]}, which is not read")

    def _element(self, word: str, attributes: dict[str, str]) -> None:
        match word:
            case "resources":
                self.resources = True
            case "build":
                self.items = []
            case "metadata" if self._open[-2:-1] == ["model"] and not attributes.get("name"):
                self.refuse("a <metadata> has no name")
            case "object":
                number = self._identify(word, attributes)
                kind = attributes.get("type", "model")
                if kind not in TYPES:
                    self.refuse(f"{kind[:40]!r} is no type of an object; known are {', '.join(TYPES)}")
                self._thing = self.objects[number] = Thing(attributes.get("name", ""), self.line)
                self._paint = (attributes.get("pid", ""), attributes.get("pindex", "0"))
                self._painted = set()
            case "component" if self._thing is not None:
                self._thing.components.append(self._reference(attributes))
            case "item" if self.items is not None:
                self.items.append(self._reference(attributes))
            case "basematerials":
                self._colours[self._identify(word, attributes)] = self._group = []
            case "base":
                self._group.append(_colour(attributes.get("displaycolor", "")))

    def _material(self, word: str, attributes: dict[str, str]) -> None:
        if word in ("colorgroup", *NEEDED):
            number = self._identify(word, attributes)
            for needed in NEEDED.get(word, ()):
                if not attributes.get(needed):
                    self.refuse(f"a <{word}> has no {needed}")
            if word == "colorgroup":
                self._colours[number] = self._group = []
            for key, kind in (("texid", "texture2d"), ("matid", "basematerials"), ("pids", "")):
                for other in attributes.get(key, "").split() if key in NEEDED.get(word, ()) else ():
                    found = self._kinds.get(self._number(other))
                    if found is None or (kind and found != kind) or found == "multiproperties":
                        names = f"a {found}" if found else "no resource"
                        self.refuse(f"the {key} {other[:20]} of a <{word}> names {names} before it")
        elif word == "color":
            self._group.append(_colour(attributes.get("color", "")))

    def _add_triangle(self, attributes: dict[str, str]) -> None:
        try:
            self._corners += (attributes["v1"], attributes["v2"], attributes["v3"])
        except KeyError as missing:
            self.refuse(f"a triangle has no {missing.args[0]}")
        if len(attributes) > 3 and "p1" in attributes:
            group = attributes.get("pid", self._paint[0])
            self._painted.update((group, attributes[p]) for p in ("p1", "p2", "p3") if p in attributes)
        elif self._painted:
            self._painted.add(self._paint)
        if len(self._corners) > 3 * MAX_TRIANGLES or len(self._texts) > 9 * MAX_TRIANGLES:
            self.refuse(f"the mesh is too large; up to {MAX_TRIANGLES:,} triangles are read")

    def end(self, tag: str) -> None:
        if tag in (self._vertex, self._triangle):
            return
        self._open.pop()
        space, _, word = tag.rpartition(" ")
        thing = self._thing
        if space != self._core or thing is None:
            return
        if word == "vertices":
            thing.vertices = self._array(self._texts, float, "vertices")
            self._texts = []
        elif word == "triangles":
            thing.triangles = self._array(self._corners, np.int64, "triangles")
            self._corners = []
        elif word == "object":
            colours = {self._look(*paint) for paint in self._painted}
            thing.colour = colours.pop() if len(colours) == 1 else self._look(*self._paint)
            self._thing = None

    def _look(self, group: str, index: str) -> str | None:
        if group.isdecimal() and index.isdecimal() and len(group) < 12 and len(index) < 12:
            colours = self._colours.get(int(group), [])
            return colours[int(index)] if int(index) < len(colours) else None
        return None

    def _array(self, texts: list[str], kind: type, what: str) -> NDArray:
        try:
            values = np.fromstring(" ".join(texts), dtype=kind, sep=" ")  # type: ignore[call-overload]
        except (ValueError, DeprecationWarning):
            values = np.zeros(0)
        if len(values) != len(texts):
            bad = next((text for text in texts if not _reads(text, kind)), "")
            self.refuse(
                f"the {what} of this object hold {bad[:40]!r}, which is no number",
                self._thing.line if self._thing else 0,
            )
        return values.reshape(-1, 3)

    def _reference(self, attributes: dict[str, str]) -> Reference:
        number = self._number(attributes.get("objectid", ""))
        matrix = IDENTITY
        if "transform" in attributes:
            words = attributes["transform"].split()
            if len(words) != 12 or not all(_reads(word, float) for word in words):
                self.refuse("a transform must be 12 numbers")
            matrix = np.array([float(word) for word in words]).reshape(4, 3).T
        path = attributes.get(f"{PRODUCTION} path", "").lstrip("/")
        return Reference(number, path, matrix, self.line, attributes.get("partnumber", ""))

    def _identify(self, word: str, attributes: dict[str, str]) -> int:
        number = self._number(attributes.get("id", ""))
        if number in self._kinds:
            self.refuse(f"the id {number} stands twice, at a <{self._kinds[number]}> and at a <{word}>")
        self._kinds[number] = word
        return number

    def _number(self, text: str) -> int:
        if not text.isdecimal() or not 0 < len(text) < 12:
            self.refuse(f"{text[:40]!r} is no number of an object or another resource")
        return int(text)


def _reads(text: str, kind: type) -> bool:
    try:
        return bool(np.isfinite(kind(text)))
    except (ValueError, OverflowError):
        return False


def _colour(text: str) -> str | None:
    try:
        return hex_colour(text[:7])  # the last two digits tell how opaque it is
    except Refusal:
        return None
