"""The copies that arrays and mirrors make of their operand, as maps."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..document.nodes import LinearArray, Mirror, Node, PolarArray
from ..document.placement import IDENTITY, turn_about, unit
from .failure import NoSolid

MOST_COPIES = 100_000
MOST_OCCURRENCES = 1_000_000


def copies(node: Node) -> list[NDArray[np.float64]]:
    """(3, 4) maps of the copies that `node` makes of its operands, the first one first. Raises NoSolid."""
    if isinstance(node, LinearArray):
        step = np.array(node.step, dtype=np.float64)
        return [IDENTITY if i == 0 else np.column_stack((np.eye(3), i * step)) for i in range(_count(node))]
    if isinstance(node, PolarArray):
        count, angle = _count(node), float(node.angle)  # type: ignore[arg-type]
        full = abs(angle) % 360 == 0 and angle != 0
        step = angle / count if full else angle / max(count - 1, 1)
        axis, point = tuple(map(float, node.axis)), tuple(map(float, node.point))  # type: ignore[arg-type]
        return [IDENTITY if i == 0 else turn_about(axis, i * step, point) for i in range(count)]
    if isinstance(node, Mirror):
        normal = unit(node.normal, "Mirror: the normal")
        point = np.array(node.point, dtype=np.float64)
        image = np.column_stack((np.eye(3) - 2 * np.outer(normal, normal), 2 * normal * (normal @ point)))
        return [IDENTITY, image] if node.keep else [image]
    return [IDENTITY]


def occurrence_count(root: Node) -> int:
    """How many leaves a resolved tree has with all copies written out; shared operands are counted once and multiplied.

    Nothing is written out here: arrays of arrays and definitions of definitions can unfold to any number.
    """
    counts: dict[int, int] = {}
    stack = [root]
    while stack:
        node = stack[-1]
        missing = [child for child in node.children if id(child) not in counts]
        if missing and id(node) not in counts:
            stack += missing
            continue
        stack.pop()
        try:
            times = _count(node) if isinstance(node, LinearArray | PolarArray) else 2 if isinstance(node, Mirror) else 1
        except NoSolid:
            times = 1
        counts[id(node)] = times * max(1, sum(counts[id(child)] for child in node.children))
    return counts[id(root)]


def _count(node: LinearArray | PolarArray) -> int:
    count = float(node.count)  # type: ignore[arg-type]
    if count != round(count):
        raise NoSolid(f"{node.title}: copies must be a whole number, not {count:g}")
    if count > MOST_COPIES:
        raise NoSolid(f"{node.title}: at most {MOST_COPIES:,} copies are made, not {count:g}")
    return int(count)
