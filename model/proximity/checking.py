"""What `solidtree check` tells of a document: which solids overlap or come too near to each other."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

from ..document.document import Document
from ..document.errors import Refusal
from ..solid.results import SolidResult, arrays_of, evaluate_document, open_surface
from ..worker.shown import Message
from .bodies import Body, Clash, clashes


def body_of(result: SolidResult) -> Body:
    """An evaluated root; a surface that is open is one that bounds no solid, and one that failed is empty."""
    surface = None if result.solid is not None else open_surface(result.root)
    vertices, triangles = surface if surface is not None else arrays_of(result.mesh())
    return Body(result.root.name, vertices, triangles, result.solid)


def checked(
    document: Document,
    clearance: float,
    tolerance: float,
    progress: Callable[[str], None] | None = None,
    told: Callable[[int, int], None] | None = None,
) -> tuple[dict[str, Any], tuple[Message, ...]]:
    """The pairs of visible solids that overlap or whose gap is below `clearance` mm, as plain JSON values, and what
    evaluation had to say. `told` hears how many of the pairs have been looked at. Raises Refusal."""
    if not 0.0 <= clearance < math.inf:
        raise Refusal(f"a clearance is 0 mm or more, and finite, not {clearance}")
    visible = [root.id for root in document.solids if root.visible]
    evaluation = evaluate_document(document, tolerance, visible, progress=progress)
    bodies = [body_of(result) for result in evaluation.solids]
    pairs = [_row(bodies, clash) for clash in clashes(bodies, clearance, told=told)]
    return {"pairs": pairs, "clearance": clearance}, evaluation.messages


def _row(bodies: Sequence[Body], clash: Clash) -> dict[str, Any]:
    found = clash.relation
    return {
        "a": bodies[clash.one].name,
        "b": bodies[clash.other].name,
        "relation": found.kind,
        "gap": found.gap,
        "overlap_volume": found.overlap,
        "points": None if found.points is None else found.points.tolist(),
    }
