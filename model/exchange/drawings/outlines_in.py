"""Drawings as documents: each shape an outline of its own."""

from __future__ import annotations

from collections.abc import Iterator

from ...document.document import Document
from ...document.errors import Refusal
from ...document.outlines import Path
from ...document.tree import Names
from ...outline.paths import fields_of
from ...path import path as curves
from ...path.nodes import inferred
from .drawing_shapes import Drawing, Shape

LARGEST_TEXT = 20_000_000  # characters


def document_of_drawing(drawing: Drawing, name: str) -> Document:
    """A document whose profiles are the shapes of a drawing, from back to front; notes are those of the reading.

    A shape without a name gets `name`. What is filled is closed, as a drawing fills it; strokes stay open.
    """
    names = Names()
    profiles = tuple(
        outline_of(shape).with_(id=f"n{number}", name=names.take(shape.name or name))
        for number, shape in enumerate(drawing.shapes, 1)
    )
    return Document(profiles=profiles, notes="\n".join(drawing.notes))


def outline_of(shape: Shape) -> Path:
    """The shape as a node, unnamed. Nodes where the curve goes on straight are smooth, or symmetric."""
    path = curves.Path.of_commands(_closed(shape) if shape.filled else shape.commands, shape.rule)
    path = curves.Path(tuple(inferred(contour) for contour in path.contours), path.rule)
    return Path(**fields_of(path), colour=shape.colour)


def _closed(shape: Shape) -> Iterator[curves.Command]:
    for contour in shape.contours:
        yield from contour
        if contour[-1][0] != "close":
            yield ("close",)


def document_of_text(text: str, name: str = "Path") -> Document:
    """The outlines in text that was copied elsewhere: an SVG document, or the data of an SVG path.

    Both run y downwards, so they are turned over. Raises Refusal where the text is neither.
    """
    if len(text) > LARGEST_TEXT:
        raise Refusal("the text on the clipboard is too long to be an outline")
    from .drawings_in import format_of, read_data

    data = text.strip().encode("utf-8", "replace")
    if format_of(data, "") == "svg":
        return document_of_drawing(read_data(data, "svg", None), name)
    from .svg_path import path_commands

    path = curves.Path.of_commands(path_commands(text.strip())).transformed([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])
    path = curves.Path(tuple(inferred(contour) for contour in path.contours), path.rule)
    return Document(profiles=(Path(id="n1", name=name, **fields_of(path)),))
