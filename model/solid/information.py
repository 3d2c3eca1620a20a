"""What `solidtree info` tells about a document."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ..document.document import Document
from .measure import Measures
from .results import SolidResult, evaluate_document, measures_of


def information(
    document: Document, tolerance: float, progress: Callable[[str], None] | None = None
) -> tuple[dict[str, Any], bool]:
    """The measurements as plain JSON values, and whether every visible solid is in order."""
    evaluation = evaluate_document(document, tolerance, progress=progress)
    measured = [(result, result.measures()) for result in evaluation.solids]
    visible = [(result, measures) for result, measures in measured if result.root.visible]
    if len(visible) == 1:
        total = _row(visible[0][1])
    elif all(result.solid is not None for result, _ in visible):
        total = _row(measures_of(evaluation.total().to_mesh64()))
    else:
        total = _row(None)
    answer = {
        "solids": [{"name": result.root.name, **_row(measures)} for result, measures in measured],
        "total": total,
        "profiles": [],
        "warnings": [{"node": message.name, "message": message.message} for message in evaluation.messages],
    }
    return answer, bool(visible) and all(_in_order(result) for result, _ in visible)


def _in_order(result: SolidResult) -> bool:
    return result.solid is not None and not result.solid.is_empty()


def _row(measures: Measures | None) -> dict[str, Any]:
    if measures is not None:
        return measures.as_json()
    return {
        **dict.fromkeys(("volume", "area", "bounds", "centroid", "triangles", "components", "genus")),
        "closed": False,
    }
