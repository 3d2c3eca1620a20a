"""Which measures the selection has: its own, and those of the solid that it stands in."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from ...model.document.document import Document
from ...model.document.errors import Refusal
from ...model.document.outlines import is_outline
from ...model.document.tree import find, homes, outermost

if TYPE_CHECKING:
    from ...model.measuring.measure import Measures
    from ...model.worker.shown import Part, Shown

NODE, NODES, SOLID = "Measures of the node", "Measures of all together", "Measures of the solid"

Measured = dict[str, "tuple[Measures | None, str]"]
"""By heading: measures, None while they are not there, and the name of what they are of."""


def measured(
    document: Document, selection: tuple[str, ...], shown: Shown | None, parts: Mapping[str, Part]
) -> Measured:
    try:
        ids = outermost(document, selection)
        roots = homes(document, ids)
    except Refusal:
        return {}
    solids = {} if shown is None else shown.solids

    def of(node_id: str) -> Measures | None:
        if node_id in solids:
            return solids[node_id].measures
        return parts[node_id].measures if node_id in parts else None

    answer: Measured = {}
    if len(ids) > 1:
        each = [of(node_id) for node_id in ids]
        known = [measures for measures in each if measures is not None]
        together = None
        if known and len(known) == len(each):
            from ...model.measuring.measure import summed

            together = summed(known)
        answer[NODES] = together, "selection"
    elif ids and ids[0] not in roots:
        node = find(document, ids[0])
        if not is_outline(node, document.definitions):  # whose form tells what there is to measure
            answer[NODE] = of(ids[0]), node.label
    if len(roots) == 1:
        (root,) = roots.values()
        if root.id in {solid.id for solid in document.solids}:
            answer[SOLID] = of(root.id), root.label
    return answer
