"""What is told of B-splines and Bezier curves in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ....model.document.outlines import Bezier, BSpline

if TYPE_CHECKING:
    from ....model.document.document import Document
    from ....model.outline.basis import Basis

DEGREES = {1: "linear", 2: "quadratic", 3: "cubic", 4: "quartic", 5: "quintic"}
SAME = 1e-9
"""Millimetres; what moves by less has not moved but for rounding."""


def curve_words(node: Bezier | BSpline, basis: Basis | None) -> str:
    """Of a resolved curve; `basis` is that of a B-spline."""
    count = len(node.points)
    degree = count - 1 if isinstance(node, Bezier) else int(node.degree)  # type: ignore[arg-type]
    words = [DEGREES.get(degree, f"degree {degree}"), f"{count} control points"]
    if basis is not None:
        ends = "clamped" if basis.clamped else "unclamped"
        words += [f"{len(basis.knots)} knots", "closed" if basis.closed else ends]
    if node.weights:
        words.append("rational")
    told = ", ".join(words)
    return f"Bezier curve, {told}" if isinstance(node, Bezier) else told[0].upper() + told[1:]


def changes_by(before: Document, after: Document, node_id: str) -> str | None:
    """How far the curve of a node has moved, in words; None where it is the same. Raises Refusal."""
    from ....model.document.tree import find
    from ....model.operations.curves.addressing import plain_values
    from ....model.operations.curves.deviations import deviation

    off = deviation(*(plain_values(document, find(document, node_id)) for document in (before, after)))
    return None if off <= SAME else f"{off:.3g} mm at most"
