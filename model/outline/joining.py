"""Operations on outlines as paths: unions, differences, intersections, copies."""

from __future__ import annotations

import numpy as np

from ..document.errors import Refusal
from ..document.nodes import Difference, Intersection, LinearArray, Mirror, Node, PolarArray, Union
from ..document.outlines import Stencil
from ..path.areas.booleans import combined
from ..path.path import Path
from ..solid.copies import copies
from ..solid.failure import NoSolid
from .paths import moved
from .stencil import stencilled_path

KINDS: dict[type[Node], str] = {Union: "union", Difference: "difference", Intersection: "intersection"}


def joined_path(node: Node, paths: list[Path]) -> Path:
    """What an operation makes of the paths of its operands, before its own placement.

    Areas are joined where they overlap; open curves, and curves in space, of a union or of copies stand side by side.
    Raises Refusal.
    """
    if isinstance(node, Stencil):
        return stencilled_path(paths[0], node)
    kind = KINDS.get(type(node))
    if isinstance(node, LinearArray | PolarArray | Mirror):
        kind = "union"
        try:
            maps = copies(node)
        except NoSolid as fault:
            raise Refusal(str(fault)) from None
        paths = [moved(path, matrix) for matrix in maps for path in paths]
    if kind is None:
        raise Refusal(f"“{node.label}” makes solids, not outlines")
    contours = [contour for path in paths for contour in path.contours]
    flat = all(contour.closed and contour.dimension == 2 for contour in contours)
    try:
        if flat or kind != "union":
            return combined(kind, paths)
    except Refusal as refusal:
        raise Refusal(f"{node.label}: {refusal}") from None
    if any(contour.dimension == 3 for contour in contours):
        lift = np.eye(3, 4)
        contours = [c if c.dimension == 3 else c.transformed(lift) for c in contours]
    return Path(tuple(contours))
