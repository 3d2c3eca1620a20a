"""Outlines that stand by themselves: their curves, their figures, and what is wrong with them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...document.errors import Refusal
from ...document.nodes import Broken, Node, range_fault
from ...document.outlines import OUTLINES
from ...document.placement import Placement
from ...outline.paths import in_plane, own_path, path_of
from ...path.path import Path
from ..entry import Problem
from ..failure import NoSolid
from .sections import area_of

LARGEST = 1e12
OVERFLOW = "the numbers are too large or too small to make a curve of"
FINE = 1e-6
"""Share of its size within which an outline is flattened to find its area where contours overlap."""


@dataclass(frozen=True, slots=True)
class Figures:
    """Of an outline, in mm: in its plane z = 0 with its placement where it lies there, else in its own axes.

    `bounds` is (2, d), three coordinates where the curve leaves its plane, None for an empty one. `area` is None for
    what has no inside: an open curve, or one that leaves its plane.
    """

    area: float | None
    bounds: tuple[tuple[float, ...], tuple[float, ...]] | None
    contours: int
    length: float

    def as_json(self) -> dict[str, Any]:
        bounds = None if self.bounds is None else [list(corner) for corner in self.bounds]
        return {"area": self.area, "bounds": bounds, "contours": self.contours, "length": self.length}


def profile_path(root: Node) -> Path:
    """The curves of a resolved outline as `Figures` have them. Raises Refusal."""
    steps = root.placement.steps
    flat = not steps or in_plane(root.placement.matrix()) is not None
    path = path_of(root if flat else root.with_(placement=Placement()))
    if any(np.abs(part.points).max() > LARGEST for contour in path.contours for part in (contour, *contour.splines)):
        raise Refusal(f"{root.title}: a curve reaches more than {LARGEST:g} mm from the origin, too far to measure it")
    return path


def figures_of(path: Path) -> Figures:
    """The figures of a path as `profile_path` makes it; the area honours its winding rule."""
    if not path.contours:
        return Figures(0.0, None, 0, 0.0)
    with np.errstate(all="ignore"):  # weights may be extreme
        low, high = path.bounds().tolist()
        return Figures(_area(path), (tuple(low), tuple(high)), len(path.contours), path.length())


def _area(path: Path) -> float | None:
    """By Green's theorem where no contours overlap, else flattened."""
    size = float(np.ptp(path.bounds(), axis=0).max())
    try:
        filled = area_of(path, max(FINE * size, 1e-9))
    except (NoSolid, Refusal):
        return None
    exact = np.array([abs(Path((contour,)).area()) for contour in path.contours])
    borders = [_shoelace(ring) for ring in filled.to_polygons()]
    # Contours that nothing crosses are the borders of what is filled, or lie within it and border nothing.
    total, left = 0.0, list(range(len(exact)))
    for border in borders:
        near = [i for i in left if abs(exact[i] - abs(border)) <= 8 * FINE * size * path.contours[i].length()]
        if not near:
            return float(filled.area())
        closest = min(near, key=lambda i: abs(exact[i] - abs(border)))
        left.remove(closest)
        total += np.copysign(exact[closest], border)
    return float(total)


def _shoelace(ring: np.ndarray) -> float:
    """Signed area of a polygon (n, 2)."""
    x, y = (ring - ring.mean(axis=0)).T
    return 0.5 * float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum())


def outline_problems(root: Node) -> tuple[Problem, ...]:
    """What is wrong with the nodes of a resolved outline, each told on the node that it is about."""
    found: list[Problem] = []
    stack: list[tuple[Node, tuple[int, ...]]] = [(root, ())]
    while stack:
        node, place = stack.pop()
        fault = node.message if isinstance(node, Broken) else range_fault(node)
        if fault is None and isinstance(node, OUTLINES):
            fault = _fault(node)
        if fault is not None:
            found.append(Problem(place, fault))
        stack += [(child, (*place, i)) for i, child in reversed(list(enumerate(node.children)))]
    return tuple(found)


def _fault(outline: Node) -> str | None:
    try:
        with np.errstate(all="ignore"):
            own_path(outline)
    except Refusal as refusal:
        return str(refusal)
    except (ArithmeticError, ValueError):
        return OVERFLOW
    return None


def profile_of(root: Node) -> tuple[Path | None, tuple[Problem, ...]]:
    """The curves of a resolved outline, None where it failed, and what is wrong with it."""
    try:
        with np.errstate(all="ignore"):
            return profile_path(root), ()
    except Refusal as refusal:
        return None, outline_problems(root) or (Problem((), str(refusal)),)
    except (ArithmeticError, ValueError):
        return None, outline_problems(root) or (Problem((), OVERFLOW),)
