"""Pages into files: SVG, PDF and DXF by the path's ending."""

from __future__ import annotations

import io
import os
from collections.abc import Callable
from pathlib import Path
from typing import BinaryIO

from ..document.errors import Refusal
from ..project.disk import replace_file
from .page import Page


def _svg(stream: BinaryIO, page: Page) -> None:
    from .svg import write_svg

    text = io.TextIOWrapper(stream, "utf-8", newline="\n", write_through=False)
    write_svg(text, page)
    text.detach()  # flushed; the file is the caller's


def _pdf(stream: BinaryIO, page: Page) -> None:
    from .pdf import write_pdf

    write_pdf(stream, page)


def _dxf(stream: BinaryIO, page: Page) -> None:
    from .dxf import write_dxf

    text = io.TextIOWrapper(stream, "utf-8", newline="\n")
    write_dxf(text, page)
    text.detach()


WRITERS: dict[str, Callable[[BinaryIO, Page], None]] = {"svg": _svg, "pdf": _pdf, "dxf": _dxf}
"""By ending."""


def check_drawing_ending(path: str | os.PathLike[str]) -> str:
    """The ending of the path, small and without its dot. Raises Refusal where no drawings are written so."""
    ending = Path(path).suffix.lower().removeprefix(".")
    if ending not in WRITERS:
        given = f".{ending}" if ending else "no ending"
        raise Refusal(f"cannot be written: {given} is no drawing; drawings become .svg, .pdf or .dxf")
    return ending


def write_page(path: str | os.PathLike[str], page: Page) -> None:
    """Write the page in the format of the path's ending, wholly or not at all. Raises Refusal."""
    writer = WRITERS[check_drawing_ending(path)]
    replace_file(path, lambda stream: writer(stream, page))
