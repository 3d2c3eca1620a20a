"""What the form of an outline says of it in words, because its points are edited in the picture."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from ...model.document.errors import Refusal
from ...model.document.fields import FieldSpec
from ...model.document.nodes import Node, resolve_fields
from ...model.document.project_font import ProjectFont, set_in
from ..status import figure

MOST_POINTS = 2000
"""More are measured too slowly for a form that follows every step."""


def field_words(node: Node, spec: FieldSpec) -> str:
    """A field that holds no single number, in short."""
    value = getattr(node, spec.name)
    match spec.type, spec.name:
        case "points", _:
            contours = getattr(node, "segments", "").count("M")
            return f"{len(value)}" + (f" in {contours} contour{'s' * (contours != 1)}" if contours else "")
        case "faces", _:
            return f"{len(value)}"
        case "numbers", "weights":
            return _numbers(value) if value else "all 1"
        case "numbers", _:
            return _numbers(value) if value else "uniform"
    text = str(value)
    return text if len(text) <= 24 else text[:12] + "…"


def _numbers(values: tuple[Any, ...]) -> str:
    plain = [value for value in values if isinstance(value, float)]
    reach = f", {figure(min(plain))} to {figure(max(plain))}" if len(plain) == len(values) else ""
    return f"{len(values)}{reach}"


def measured_words(node: Node, values: dict[str, float], fonts: Iterable[ProjectFont]) -> tuple[str, str]:
    """Length and area of an outline in its own axes; a dash for what it has none of, or takes long to measure."""
    none = figure(None)
    if len(getattr(node, "points", ())) > MOST_POINTS:
        return none, none
    from ...model.solid.outlines.profiles import figures_of, profile_of

    try:
        path, _ = profile_of(set_in(resolve_fields(node, values, ()), fonts).placed())
    except Refusal:
        path = None
    if path is None:
        return none, none
    figures = figures_of(path)
    return f"{figure(figures.length)} mm", none if figures.area is None else f"{figure(figures.area)} mm²"
