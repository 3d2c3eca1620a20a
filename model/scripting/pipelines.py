"""What scripts do with the pipeline: a point on its way to its pixel, and counts at each stage."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ..document.document import Document
from ..document.errors import Refusal
from ..document.nodes import Node
from .documents import evaluate

if TYPE_CHECKING:
    from ..pipeline.counts import Counts
    from ..pipeline.way import Way


def pipeline(point: Sequence[float], eye: Sequence[float], target: Sequence[float] = (0, 0, 0), **view: Any) -> Way:
    """A point on its way through the matrices to its pixel, for an eye that looks at a target.

    `view` may give `up`, `perspective` (the full vertical angle in degrees, None for a parallel projection of
    `half_height` mm to either side), `size` of the picture in pixels, `near` and `far` in mm before the eye, and
    `model`, a matrix from the point's own axes to the world. The result has `pixel` (x, y, depth), `stages` with
    coordinates, formulas and words, `outside` and `matrices`; print it for a table. Raises Refusal.

    >>> [round(value, 3) for value in pipeline((1, 0, 2), eye=(0, -10, 0), perspective=90, size=(200, 200)).pixel]
    [110.0, 80.0, 0.909]
    """
    from ..pipeline.matrices import matrices_for
    from ..pipeline.way import follow

    return follow(matrices_for(eye, target, **view), point)


def pipeline_counts(
    *solids: Node | Document,
    eye: Sequence[float],
    target: Sequence[float] = (0, 0, 0),
    cull: bool = False,
    tolerance: float = 0.05,
    **view: Any,
) -> Counts:
    """How many vertices, triangles, polygons, fragments and pixels there are at each stage; `view` as in `pipeline`.
    With `cull` faces that are turned away are left out. Raises Refusal.

    >>> counts = pipeline_counts(box(2, centred=True), eye=(0, -10, 0), perspective=None, half_height=2, size=(40, 40))
    >>> counts.triangles, counts.pixels, counts.overdraw
    (12, 400, 2.0)
    """
    from ..pipeline.counts import counted, joined
    from ..pipeline.matrices import matrices_for

    size = view.setdefault("size", (1200, 800))
    matrices = matrices_for(eye, target, **view)
    evaluation = evaluate(*solids, tolerance=tolerance)
    meshes = [(result, evaluation.display(result)) for result in evaluation.visible]
    for result, mesh in meshes:
        if mesh is None:
            raise Refusal(next(message.message for message in result.messages if message.error))
    result = counted(*joined([(m.vertices, m.corners) for _, m in meshes if m is not None]), matrices, size, cull)
    assert result is not None
    return result.counts


__all__ = ["pipeline", "pipeline_counts"]
