"""Reports on the nodes of a document as the panel reads them: their kinds of findings, and counts over all of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from ...model.mesh.faults.words import DRAWING_KINDS, MESH_KINDS, KindWords

if TYPE_CHECKING:
    from ...model.checking.document_faults import NodeFaults

Kind = tuple[bool, str]
"""Whether it is in an outline, and the kind's name."""

SEVERE = frozenset({"border", "overused edge", "turned edge", "crossing", "duplicate", "open end"})
"""The kinds that keep a mesh from bounding a solid, or an outline from enclosing an area."""
HARMLESS = frozenset({"sliver", "near edge-edge", "short"})
"""The kinds that good files have too: nobody has to be told of them who did not ask."""


def kinds_of(report: NodeFaults) -> Mapping[str, KindWords]:
    """The kinds of findings that it may have, the worst first."""
    return DRAWING_KINDS if report.kind == "outline" else MESH_KINDS


def is_sound(report: NodeFaults) -> bool:
    return report.faults is not None and report.faults.sound


def is_mendable(report: NodeFaults) -> bool:
    """Whether it is a mesh or an outline with faults; other solids have to be made a mesh first."""
    return report.kind != "solid" and report.faults is not None and not report.faults.sound


def counts_by_kind(reports: Sequence[NodeFaults]) -> dict[Kind, tuple[KindWords, int]]:
    """How many findings there are of each kind, the worst first; those that have no place in a report are counted."""
    found: dict[Kind, tuple[KindWords, int]] = {}
    for flat, kinds in ((False, MESH_KINDS), (True, DRAWING_KINDS)):
        of_these = [report.faults for report in reports if report.faults and (report.kind == "outline") == flat]
        for kind, words in kinds.items():
            count = sum(int(getattr(faults, words.count)) for faults in of_these)
            if count:
                found[flat, kind] = words, count
    return found


def worth_telling(reports: Sequence[NodeFaults]) -> list[NodeFaults]:
    """Those with faults that whoever brings in a file has to know of."""
    return [report for report in reports if any(kind not in HARMLESS for _, kind in counts_by_kind([report]))]
