"""What every font face tells, whatever its format: metrics, characters, glyph outlines, and how it shapes a run."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from ...path.path import Path

Location = Mapping[str, float]
"""Values of variable axes, by tag; axes that are left out have their default."""
DEFAULT: Location = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class Axis:
    """A variable axis of design, in its own units."""

    tag: str
    name: str
    low: float
    default: float
    high: float


@dataclass(frozen=True, slots=True)
class Metrics:
    """Heights above the baseline and distances, in font units; `slant` in degrees to the right."""

    ascender: float
    descender: float
    line_gap: float
    x_height: float
    cap_height: float
    slant: float


@dataclass(frozen=True, slots=True)
class Run:
    """Characters of one font, script and direction, and how they are to be shaped.

    `direction` is "ltr", "rtl", "ttb" or "btt"; `script` an ISO 15924 code, `language` a BCP 47 tag or "" for none;
    `features` are (OpenType tag, value): 0 turns one off.
    """

    text: str
    direction: str = "ltr"
    script: str = "Latn"
    language: str = ""
    features: tuple[tuple[str, int], ...] = ()


@dataclass(frozen=True, slots=True)
class Shaped:
    """A glyph, in the order in which it stands on the page; font units. `character` is the place in the run's text of
    the first character that it stands for; `offset` moves it without moving the pen; `advance` (x, y) moves the pen."""

    glyph: str
    character: int
    offset: tuple[float, float]
    advance: tuple[float, float]


PLAIN = ("", "regular", "book", "roman", "normal")
"""Styles that need not be named."""


def name_of(family: str, style: str) -> str:
    """What a face is called: by its family alone where its style is the plain one."""
    return family if style.casefold() in PLAIN else f"{family} {style}"


class Face(ABC):
    """One face of a font file. Outlines have closed contours, y up, in font units."""

    kind: str
    """"TrueType", "CFF", "CFF2" or "Type 1"."""
    family: str
    style: str
    units_per_em: float
    metrics: Metrics
    glyph_names: tuple[str, ...]
    characters: Mapping[int, str]
    """The glyph of each character that has one, by code point."""
    axes: tuple[Axis, ...] = ()
    features: tuple[str, ...] = ()
    """Tags of the OpenType features, in their order."""
    missing: str = ".notdef"
    """The glyph that stands for characters without one."""

    @property
    def name(self) -> str:
        """Family and style, as in "DejaVu Sans Bold"."""
        return name_of(self.family, self.style)

    @abstractmethod
    def outline(self, glyph: str, location: Location = DEFAULT, instead: Mapping[str, Path] | None = None) -> Path:
        """`instead` has outlines that take the place of those of parts that the glyph is put together from.

        Raises Refusal for a glyph that the font lacks, or that is broken.
        """

    @abstractmethod
    def advance(self, glyph: str, location: Location = DEFAULT) -> float:
        """Raises Refusal."""

    @abstractmethod
    def shape(self, run: Run, location: Location = DEFAULT) -> list[Shaped]:
        """The glyphs of a run. Raises Refusal."""

    def parts(self, glyph: str) -> frozenset[str]:
        """The other glyphs that this one is put together from, and theirs."""
        return frozenset()

    def source(self, glyph: str) -> Face:
        """The face that draws the glyph: itself, but for an edited font whose file has the glyph as it is."""
        return self
