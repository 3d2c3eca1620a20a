"""What scripts do with hidden surfaces: the BSP tree, and drawings with hidden faces and lines removed."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from ..document.document import Document
from ..document.errors import Refusal
from ..document.nodes import Node
from .documents import document_of, evaluate


def bsp_tree(*solids: Node | Document, builder: str = "good", tolerance: float = 0.05):
    """The BSP tree of the visible solids' triangles, as hidden surfaces are sorted by; `builder` is "good" or
    "textbook" (the faces as they come). It has `nodes`, `depth` and `fragments`, and the arrays of
    solidtree.model.partition.tree.Tree. Raises Refusal.

    >>> bsp_tree(box(10)).depth
    1
    """
    from ..partition.faces import faces_of_meshes
    from ..partition.report import BUILDERS, builder_fault, built

    if builder not in BUILDERS:
        raise Refusal(f"no builder is called {builder!r}; take {' or '.join(BUILDERS)}")
    evaluation = evaluate(*solids, tolerance=tolerance)
    meshes = [(result, evaluation.display(result)) for result in evaluation.visible]
    for result, mesh in meshes:
        if mesh is None:
            raise Refusal(next(message.message for message in result.messages if message.error))
    faces = faces_of_meshes([mesh for _, mesh in meshes if mesh is not None])
    fault = builder_fault(builder, faces.count)
    if fault:
        raise Refusal(fault)
    return built(faces, builder)[0]


def draw(
    path: str | os.PathLike[str],
    *solids: Node | Document,
    view: str = "iso",
    eye: Sequence[float] | None = None,
    target: Sequence[float] | None = None,
    up: Sequence[float] | None = None,
    perspective: float | None = None,
    sheet: str | None = None,
    page: str = "A4",
    scale: str | float = "fit",
    hidden: str = "dashed",
    faces: str = "none",
    dimensions: bool | None = None,
    tolerance: float | None = None,
    **named: Node,
):
    """Write a drawing, faces and lines that are hidden removed, as .svg, .pdf or .dxf; a keyword is a solid's name.

    `view` is iso, front, back, left, right, top or bottom, or `eye` a point to look from; `perspective` an angle in
    degrees. `sheet="first"` or "third" draws front, top and side view and one from a corner, with the dimensions of the
    bounding box. `hidden` lines are "dashed" or "omit", `faces` "fill" or "none". Without a `tolerance` in mm round
    things are so fine that no corners show on paper. The result is the page, see
    solidtree.model.drafting.page.Page. Raises Refusal.

    >>> draw("plate.pdf", box(80, 50, 5), sheet="first").scale  # doctest: +SKIP
    1.0
    """
    from ..drafting.drawing_file import check_drawing_ending, write_page
    from ..drafting.drawn import Draughts
    from ..drafting.paper import scale_from
    from ..drafting.plan import Eye, Plan, point_of

    check_drawing_ending(path)
    plan = Plan(
        view if eye is None else Eye(point_of(eye), point_of(target), point_of(up)),
        perspective=perspective,
        sheet=sheet,  # type: ignore[arg-type]
        page=page,
        scale=scale_from(str(scale)),
        hidden=hidden,  # type: ignore[arg-type]
        faces=faces,  # type: ignore[arg-type]
        dimensions=dimensions,
        title=Path(path).stem,
    )
    drawn = Draughts(document_of(*solids, **named), tolerance).page(plan)
    write_page(path, drawn.page)
    return drawn.page


__all__ = ["bsp_tree", "draw"]
