"""Drawings in: the shapes of an SVG or DXF file, told apart by their content first."""

from __future__ import annotations

import os
import re
from pathlib import Path

from ...document.errors import Refusal
from ...project.disk import one_line, read_whole
from .drawing_shapes import Drawing

MAX_BYTES = 100_000_000
UNFORESEEN = "is damaged in a way that this program did not foresee; save it again with the program that made it"
_HEAD = 4096


def read_drawing(path: str | os.PathLike[str], tolerance: float | None = None) -> Drawing:
    """The shapes of an SVG or DXF file in millimetres with y up; `tolerance` mm as for `read_svg` and `read_dxf`.

    Raises Refusal, with the file's name at its beginning.
    """
    path = Path(path)
    try:
        data = read_whole(path, MAX_BYTES)
        drawing_format = format_of(data, path.suffix)
        if drawing_format is None:
            raise Refusal("is of no kind that can be read; drawings are .svg or .dxf" if data else "is empty")
        return read_data(data, drawing_format, tolerance)
    except Refusal as refusal:
        raise Refusal(one_line(f"{path.name}: {refusal}")) from None


def read_data(data: bytes, drawing_format: str, tolerance: float | None) -> Drawing:
    """The shapes of the bytes of a file that is "svg" or "dxf". Raises Refusal."""
    try:
        if drawing_format == "svg":
            from .svg_in import read_svg

            drawing = read_svg(data, tolerance)
        else:
            from .dxf_in import read_dxf

            drawing = read_dxf(data, **({} if tolerance is None else {"tolerance": tolerance}))
    except MemoryError:
        raise Refusal("needs more memory to be read than there is") from None
    except (ValueError, LookupError, TypeError, AttributeError, ArithmeticError, RecursionError):
        raise Refusal(UNFORESEEN) from None
    if not drawing.shapes:
        because = f": {drawing.notes[0]}" if drawing.notes else ""
        raise Refusal(f"holds no outlines{because}")
    return drawing


def format_of(data: bytes, ending: str) -> str | None:
    """ "svg" or "dxf" by content, else by ending (with or without a dot, any case); None: unknown."""
    head = data[:_HEAD].lstrip(b"\xef\xbb\xbf \t\r\n")
    if head.startswith(b"AutoCAD Binary DXF") or re.match(rb"0\s*\r?\n\s*SECTION\b|999\s*\r?\n", head):
        return "dxf"
    if head[:1] == b"<" and re.search(rb"<(?:\w+:)?svg\b", head):
        return "svg"
    ending = ending.lower().removeprefix(".")
    return {"svg": "svg", "svgz": "svg", "dxf": "dxf"}.get(ending) if data.strip(b"\0 \t\r\n") else None
