"""What `solidtree info` tells about a document."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from ..document.document import Document
from ..document.nodes import Node
from ..document.outlines import Outlines
from ..document.placement import Placement
from ..document.tree import walk
from ..measuring.measure import Measures
from .evaluate import Evaluator
from .maps import moved
from .outlines.profiles import figures_of
from .places import places_of
from .results import ProfileResult, SolidResult, evaluate_document, measures_of


def information(
    document: Document,
    tolerance: float,
    progress: Callable[[str], None] | None = None,
    nodes: bool = False,
    walls: bool = False,
) -> tuple[dict[str, Any], bool]:
    """The measurements as plain JSON values, and whether all that is visible is in order.

    `nodes` adds those of every node by itself, as it stands in the world; of several copies the first one's.
    `walls` adds an estimate of each solid's least wall (see measuring/thickness.py).
    """
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
        "profiles": [_profile_row(result) for result in evaluation.profiles],
        "warnings": [{"node": message.name, "message": message.message} for message in evaluation.messages],
    }
    if walls:
        for row, result in zip(answer["solids"], evaluation.solids, strict=True):
            row["thinnest_wall"] = _wall(result)
    if nodes:
        answer["nodes"] = _nodes([result.root for result in evaluation.solids], evaluation.evaluator, tolerance)
    profiles = [result for result in evaluation.profiles if result.root.visible]
    in_order = all(_in_order(result) for result, _ in visible) and all(result.path is not None for result in profiles)
    return answer, bool(visible or profiles) and in_order


def _profile_row(result: ProfileResult) -> dict[str, Any]:
    if result.path is None:
        return {"name": result.root.name, **dict.fromkeys(("area", "bounds", "contours", "length"))}
    return {"name": result.root.name, **figures_of(result.path).as_json()}


def _in_order(result: SolidResult) -> bool:
    return result.solid is not None and not result.solid.is_empty()


def _wall(result: SolidResult) -> dict[str, Any] | None:
    from ..measuring.thickness import RAYS, thinnest

    found = None if result.solid is None else thinnest(result.solid)
    if found is None:
        return None
    return {"length": found.length, "point": list(found.point), "exit": list(found.exit), "rays": RAYS}


def _nodes(solids: Sequence[Node], evaluator: Evaluator, tolerance: float) -> list[dict[str, Any]]:
    """In reading order. Outlines have no measures, nor has what failed or has no end."""
    named = {node.id: node.label for node in walk(*solids)}
    rows = []
    flat = Outlines()
    for places in places_of(solids, named).values():
        node, path = places[0].node, places[0].path
        bare = node.with_(placement=Placement())
        solid = None
        if node not in flat and not evaluator.ends.endless(bare):
            solid = evaluator.within(bare, tolerance, None).solid
        row = _row(None if solid is None else measures_of(moved(solid, places[0].matrix).to_mesh64()))
        rows.append(
            {
                "name": node.label,
                "path": [part if isinstance(part, int) else named[part] for part in path],
                **{key: row[key] for key in ("volume", "area", "bounds", "centroid")},
            }
        )
    return rows


def _row(measures: Measures | None) -> dict[str, Any]:
    if measures is not None:
        return measures.as_json()
    return {
        **dict.fromkeys(("volume", "area", "bounds", "centroid", "triangles", "components", "genus")),
        "closed": False,
        "inertia": None,
        "principal_moments": None,
    }
