"""Outlines of sections into drawings: SVG and DXF, in millimetres."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO, Literal

from ..document.errors import Refusal
from ..project.disk import replace_file
from ..section.section import SectionOutline

Fill = Literal["none", "colour", "hatch"]
"""What an SVG shows in the cut areas."""


@dataclass(frozen=True, slots=True)
class NamedOutline:
    """The outline of one solid, with the solid's name and colour (#rrggbb or None)."""

    name: str
    colour: str | None
    outline: SectionOutline


def _svg(stream: BinaryIO, outlines: Sequence[NamedOutline], fill: Fill) -> None:
    from .outline_svg import svg_of

    stream.write(svg_of(outlines, fill).encode())


def _dxf(stream: BinaryIO, outlines: Sequence[NamedOutline], fill: Fill) -> None:
    from .outline_dxf import dxf_of

    stream.write(dxf_of(outlines).encode())


WRITERS: dict[str, Callable[[BinaryIO, Sequence[NamedOutline], Fill], None]] = {"svg": _svg, "dxf": _dxf}
"""By ending."""


def check_outline_ending(path: str | os.PathLike[str]) -> str:
    """The ending of the path, small and without its dot. Raises Refusal where no outlines are written so."""
    ending = Path(path).suffix.lower().removeprefix(".")
    if ending not in WRITERS:
        raise Refusal(
            f"cannot be written: {f'.{ending}' if ending else 'no ending'} is no drawing; outlines become .svg or .dxf"
        )
    return ending


def write_outlines(path: str | os.PathLike[str], outlines: Sequence[NamedOutline], fill: Fill = "none") -> None:
    """Write the outlines in the format of the path's ending, wholly or not at all; DXF knows no `fill`.

    Raises Refusal.
    """
    writer = WRITERS[check_outline_ending(path)]
    full = [named for named in outlines if len(named.outline.points)]
    if not full:
        raise Refusal("cannot be written: the plane meets no solid")
    replace_file(path, lambda stream: writer(stream, full, fill))
