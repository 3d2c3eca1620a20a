"""Fonts of a project: which file a name stands for, and whether the project carries it, or has edited it."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Self

from .errors import Refusal
from .nodes import Node
from .outlines import Lettering

_SHA = re.compile(r"[0-9a-f]{64}")


@dataclass(frozen=True, slots=True)
class ProjectFont:
    """What lettering in the font `name` is set in.

    `base` is the SHA-256 of the font file, and `face` its face. `asset` is the SHA-256 of what the project carries:
    the file itself, or its edited glyphs (lettering/fonts/edited_face.py); where it is empty the name is that of an
    installed font, and `base` tells which version of it the project was made with.
    """

    name: str
    base: str
    face: int = 0
    asset: str = ""

    def __post_init__(self) -> None:
        if not isinstance(self.name, str) or not self.name.strip() or len(self.name) > 200:
            raise Refusal(f"a font needs a name of 1 to 200 characters, not {self.name!r:.60}")
        for what, sha in (("file", self.base), ("asset", self.asset or self.base)):
            if not isinstance(sha, str) or _SHA.fullmatch(sha) is None:
                raise Refusal(f"the {what} of the font “{self.name}” is told by 64 hexadecimal digits, not {sha!r:.60}")
        if type(self.face) is not int or not 0 <= self.face < 65536:
            raise Refusal(f"the face of the font “{self.name}” is a whole number from 0, not {self.face!r:.60}")

    @property
    def edited(self) -> bool:
        return self.asset not in ("", self.base)

    def with_(self, **changes: Any) -> Self:
        from dataclasses import replace

        return replace(self, **changes)


def font_key(name: str) -> str:
    """Names that differ in spaces, or in upper and lower case alone, are the same."""
    return " ".join(str(name).split()).casefold()


def font_named(fonts: Iterable[ProjectFont], name: str) -> ProjectFont | None:
    wanted = font_key(name)
    return next((font for font in fonts if font_key(font.name) == wanted), None)


def set_in(node: Node, fonts: Iterable[ProjectFont]) -> Node:
    """Lettering with the file that its font's name stands for in this project; other nodes as they are.

    Lettering that refers to a file itself keeps it, unless the project has edited that very file.
    """
    if not isinstance(node, Lettering):
        return node
    font = font_named(fonts, node.font)
    if font is None or node.asset not in ("", font.base):
        return node
    return node.with_(asset=font.asset or font.base, face=float(font.face))
