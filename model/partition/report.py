"""A tree built and measured: what `solidtree bsp` and the window's panel tell of it."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from .build import build
from .descent import Counts, counts
from .faces import Faces
from .native import available
from .order import Sorter
from .textbook import build_in_order
from .tree import Tree

BUILDERS = ("good", "textbook")
MOST_IN_ORDER = 1500
"""Faces that the textbook's builder is given: its time grows with their square, and so may its pieces."""
EYES = ((3, 2, 4), (-3, 4, 2), (2, -4, 3), (-2, -3, -4), (0.1, 0.2, 0.1))  # halves of the scene's size, from its middle


@dataclass(frozen=True, slots=True)
class Report:
    """Seconds are of this machine and this run."""

    builder: str  # "compiled", "numpy" or "textbook"
    counts: Counts
    build_seconds: float
    order_seconds: float

    def json(self) -> dict[str, Any]:
        """The values that `solidtree bsp` prints."""
        found = self.counts
        return {
            "faces": found.faces,
            "fragments": found.fragments,
            "fragments_per_face": found.fragments_per_face,
            "splits": found.splits,
            "nodes": found.nodes,
            "depth": found.depth,
            "leaves": found.leaves,
            "build_seconds": self.build_seconds,
            "order_seconds": self.order_seconds,
            "builder": self.builder,
        }


def builder_fault(builder: str, faces: int) -> str | None:
    """Why this builder is not the one for so many faces, or None."""
    if builder == "textbook" and faces > MOST_IN_ORDER:
        return f"the textbook's builder takes up to {MOST_IN_ORDER:,} faces, and these are {faces:,}; take the good one"
    return None


def built(
    faces: Faces, builder: str = "good", progress: Callable[[int, int], None] | None = None
) -> tuple[Tree, Report]:
    """The tree by one of BUILDERS, and its report. Raises ValueError where `builder_fault` has something to say."""
    fault = builder_fault(builder, faces.count)
    if fault:
        raise ValueError(fault)
    begin = time.perf_counter()
    tree = build_in_order(faces) if builder == "textbook" else build(faces, progress=progress)
    seconds = time.perf_counter() - begin
    name = "textbook" if builder == "textbook" else "compiled" if available() else "numpy"
    return tree, report(tree, name, seconds)


def report(tree: Tree, builder: str, build_seconds: float) -> Report:
    """Count a tree's parts, and time its painter's order: the middle one of several eyes, one of them inside."""
    sorter = Sorter(tree)
    points = tree.faces.points
    low, high = (points.min(axis=0), points.max(axis=0)) if len(points) else (np.zeros(3), np.ones(3))
    times = []
    for eye in EYES:
        begin = time.perf_counter()
        sorter.triangles((low + high + np.array(eye) * tree.faces.size) / 2.0)
        times.append(time.perf_counter() - begin)
    return Report(builder, counts(tree), build_seconds, float(np.median(times)))
