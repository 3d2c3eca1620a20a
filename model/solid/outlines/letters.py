"""Letters drawn up one by one: what is in a text twice, or was there before it was edited, is made once."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from manifold3d import CrossSection, FillRule, Manifold, OpType
from numpy.typing import NDArray

from ...document.errors import Refusal
from ...document.nodes import range_fault
from ...document.outlines import Lettering
from ...lettering.lettering import Drawn, drawn_glyphs, rings_of_glyph
from ..maps import placed_tolerance
from .sections import FARTHEST, MOST_POINTS

FEWEST = 8
"""Letters below which all are drawn up as one."""
NEAR = 1e-6
"""Of the size of the em: letters whose boxes are nearer than this are drawn up together."""
DIGITS = 9
KEPT = 6
"""Letters that touch, as in joined scripts, of which more are not kept: they would fill the memory."""
Placed = tuple[Drawn, tuple[float, float]]


def extruded_letters(node: Lettering, tolerance: float, height: float) -> Manifold | None:
    """A resolved lettering drawn up straight from z = 0, placed by its own placement.

    None where it has few letters, or anything is the matter with it: then it is an outline like any other.
    """
    if range_fault(node) is not None:
        return None
    fine = placed_tolerance(tolerance, node.placement)
    try:
        glyphs = [(drawn, one.matrix[:, 2]) for one, drawn in drawn_glyphs(node)]
        if len(glyphs) < FEWEST:
            return None
        rings = [rings_of_glyph(*drawn, fine) for drawn, _ in glyphs]
    except Refusal:
        return None
    kept = [i for i, flat in enumerate(rings) if flat]
    if not kept or sum(len(ring) for flat in rings for ring in flat) > MOST_POINTS:
        return None
    glyphs, rings = [glyphs[i] for i in kept], [rings[i] for i in kept]
    places = np.array([place for _, place in glyphs])
    corners = {id(flat): _corners(flat) for flat in rings}
    boxes = np.array([corners[id(flat)] for flat in rings]) + np.hstack((places, places))
    if not (np.abs(boxes) <= FARTHEST).all():
        return None
    solids = []
    for group in _near(boxes, NEAR * float(node.size)):  # type: ignore[arg-type]
        first = places[group[0]]
        key = tuple((glyphs[i][0], tuple(np.round(places[i] - first, DIGITS).tolist())) for i in group)
        risen = _kept if len(group) <= KEPT else _risen
        solids.append(risen(key, fine, height).translate((*first.tolist(), 0.0)))
    solid = Manifold.batch_boolean(solids, OpType.Add)
    if not node.placement.steps:
        return solid
    matrix = node.placement.matrix()
    if np.abs(matrix[2, :2]).max() > 1e-12 or matrix[2, 3] or np.abs(matrix).max() > FARTHEST:
        return None
    (a, b, _, x), (c, d, _, y) = matrix[:2].tolist()
    return solid.transform(np.array(((a, b, 0.0, x), (c, d, 0.0, y), (0.0, 0.0, 1.0, 0.0))))


def _risen(letters: tuple[Placed, ...], tolerance: float, height: float) -> Manifold:
    """Letters that overlap, or may, about the origin of the first."""
    rings = [
        np.ascontiguousarray(ring + place) for drawn, place in letters for ring in rings_of_glyph(*drawn, tolerance)
    ]
    return Manifold.extrude(CrossSection(rings, FillRule.NonZero), height)


_kept = lru_cache(maxsize=1024)(_risen)


def _corners(flat: list[NDArray[np.float64]]) -> tuple[float, ...]:
    points = np.concatenate(flat)
    return (*points.min(axis=0).tolist(), *points.max(axis=0).tolist())


def _near(boxes: NDArray[np.float64], margin: float) -> list[list[int]]:
    """Numbers of boxes (n, 4), lowest and highest coordinates, grouped where they touch; a sweep along x."""
    root = list(range(len(boxes)))

    def top(i: int) -> int:
        while root[i] != i:
            root[i] = root[root[i]]
            i = root[i]
        return i

    open_: list[int] = []
    for i in np.argsort(boxes[:, 0], kind="stable").tolist():
        open_ = [j for j in open_ if boxes[j, 2] + margin >= boxes[i, 0]]
        for j in open_:
            if boxes[j, 1] - margin <= boxes[i, 3] and boxes[i, 1] - margin <= boxes[j, 3]:
                root[max(top(i), top(j))] = min(top(i), top(j))
        open_.append(i)
    groups: dict[int, list[int]] = {}
    for i in range(len(boxes)):
        groups.setdefault(top(i), []).append(i)
    return list(groups.values())
