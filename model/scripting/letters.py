"""Lettering as values: text as an outline, set along curves, held by bridges."""

# Nodes take numbers as text too, and keep them as expressions; their types tell what they keep.
# pyright: reportArgumentType=false

from __future__ import annotations

import os
from pathlib import PurePath

from ..document.nodes import Node
from ..document.outlines import Lettering, Stencil, TextOnPath
from .shapes import Value


def lettering(
    text: str = "Text",
    size: Value = 10,
    font: str | os.PathLike[str] = "DejaVu Sans",
    *,
    face: int = 0,
    asset: str = "",
    alignment: str = "left",
    anchor: str = "baseline",
    direction: str = "auto",
    line_spacing: Value = 1,
    letter_spacing: Value = 0,
    width: Value | None = None,
    slant: Value = 0,
    weight: Value = 0,
    axes: str = "",
    features: str = "",
    language: str = "",
) -> Lettering:
    """Text as an outline, in a font by its name, or by the path of a font file, which then goes with the project.

    >>> letters = lettering("AVTo", 12, "GFS Didot", slant=12)
    >>> measure(extrude(letters, 2)).closed
    True
    """
    from ..lettering.fonts.library import ENDINGS, find, keep

    name = os.fspath(font)
    if not asset and PurePath(name).suffix.lower() in ENDINGS and find(name) is None:
        name, asset = keep(name, face)
    return Lettering(
        text=text, font=name, asset=asset, face=face, size=size, alignment=alignment, anchor=anchor,
        direction=direction, line_spacing=line_spacing, letter_spacing=letter_spacing, width=width, slant=slant,
        weight=weight, axes=axes, features=features, language=language,
    )  # fmt: skip


def text_on_path(lettering: Node, path: Node, start: Value = 0, shift: Value = 0, flip: bool = False) -> TextOnPath:
    """A lettering set along a curve, from its beginning, middle or end as the lettering is aligned.

    `start` is how much farther along the curve it stands, `shift` how far off it; `flip` runs it the other way, on the
    other side.

    >>> text_on_path(lettering("SOLIDTREE", 8), circle(20), flip=True)
    <TextOnPath ...>
    """
    return TextOnPath(children=(lettering, path), start=start, shift=shift, flip=flip)


def stencil(outline: Node, width: Value = 1, angle: Value = 90, bridges: int = 1) -> Stencil:
    """An outline whose holes are held by bridges, one or two each, along an angle in degrees.

    >>> measure(extrude(stencil(lettering("8&@", 12)), 1)).genus
    0
    """
    return Stencil(children=(outline,), width=width, angle=angle, bridges=bridges)


__all__ = ["lettering", "stencil", "text_on_path"]
