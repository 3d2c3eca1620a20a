"""Edits of a glyph's outline at chosen nodes: an outline comes in, another goes out."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from ...model.path import editing, nodes
from ...model.path.flatten import chords
from ...model.path.path import Contour, Kind, Node, Path
from .glyph_desk import Place


def moved(outline: Path, chosen: Iterable[Place], by: ArrayLike) -> Path:
    """Nodes, with their handles, moved by (2,) units."""
    return _each(outline, chosen, lambda contour, rows: nodes.move(contour, rows, by))


def placed(outline: Path, chosen: Iterable[Place], axis: int, value: float) -> Path:
    """Nodes brought to one coordinate."""

    def put(contour: Contour, rows: list[int]) -> Contour:
        by = np.zeros((len(rows), 2))
        by[:, axis] = value - contour.points[contour.starts[rows], axis]
        return nodes.move(contour, rows, by)

    return _each(outline, chosen, put)


def of_kind(outline: Path, chosen: Iterable[Place], kind: Node) -> Path:
    return _each(outline, chosen, lambda contour, rows: nodes.set_kind(contour, rows, kind))


def deleted(outline: Path, chosen: Iterable[Place]) -> Path:
    """Without nodes, the curve staying as near as may be; a contour without two nodes goes."""
    return _each(outline, chosen, lambda contour, rows: editing.delete(contour, rows))


def converted(outline: Path, chosen: Iterable[Place], kind: Kind) -> Path:
    """Segments of which both nodes are chosen, as another kind."""

    def convert(contour: Contour, rows: list[int]) -> Contour:
        between = nodes.between(contour, rows)
        return editing.convert(contour, between, kind)[0] if len(between) else contour

    return _each(outline, chosen, convert)


def divided(outline: Path, chosen: Iterable[Place]) -> Path:
    """A node in the middle of each segment of which both nodes are chosen."""

    def divide(contour: Contour, rows: list[int]) -> Contour:
        for segment in nodes.between(contour, rows).tolist()[::-1]:
            contour = editing.insert(contour, segment, 0.5)
        return contour

    return _each(outline, chosen, divide)


def inserted(outline: Path, contour: int, segment: int, parameter: float) -> Path:
    contours = list(outline.contours)
    contours[contour] = editing.insert(contours[contour], segment, parameter)
    return replace(outline, contours=tuple(contours))


def turned_round(outline: Path, chosen: Iterable[Place]) -> Path:
    """The contours of chosen nodes, or all, run through the other way: ink and hole change places."""
    wanted = {contour for contour, _ in chosen} or set(range(len(outline.contours)))
    contours = [one.reversed() if number in wanted else one for number, one in enumerate(outline.contours)]
    return replace(outline, contours=tuple(contours))


def place_on(outline: Path, point: tuple[float, float], reach: float) -> tuple[int, int, float] | None:
    """Contour, segment and parameter of the place on the outline that is nearest, no farther than `reach` units."""
    if not outline.contours:
        return None
    found = chords(outline, max(reach / 20.0, 1e-3))
    inner = np.ones(len(found.points), bool)
    inner[found.starts[:-1]] = False
    last = np.flatnonzero(inner)
    begin, way = found.points[last - 1], found.points[last] - found.points[last - 1]
    share = np.clip(((point - begin) * way).sum(axis=1) / np.maximum((way * way).sum(axis=1), 1e-300), 0.0, 1.0)
    off = np.linalg.norm(begin + share[:, None] * way - point, axis=1)
    best = int(np.argmin(off))
    if off[best] > reach:
        return None
    end, segment = int(last[best]), int(found.segment[last[best]])
    same = inner[end - 1] and int(found.segment[end - 1]) == segment
    first = float(found.parameter[end - 1]) if same else 0.0
    parameter = first + float(share[best]) * (float(found.parameter[end]) - first)
    counts = np.cumsum([len(contour) for contour in outline.contours])
    contour = int(np.searchsorted(counts, segment, side="right"))
    return contour, segment - (int(counts[contour - 1]) if contour else 0), min(max(parameter, 1e-3), 1.0 - 1e-3)


def _each(outline: Path, chosen: Iterable[Place], edit: Callable[[Contour, list[int]], Contour | None]) -> Path:
    """The contours that have chosen nodes, edited with those."""
    rows: dict[int, list[int]] = {}
    for contour, node in sorted(chosen):
        rows.setdefault(contour, []).append(node)
    contours = [edit(one, rows[number]) if number in rows else one for number, one in enumerate(outline.contours)]
    return replace(outline, contours=tuple(one for one in contours if one is not None))
