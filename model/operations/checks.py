"""Operations on what is asked of the solids: their clearance, pairs with one of their own or meant to touch."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from ..document.document import Document
from ..document.errors import Refusal
from ..document.tree import find
from ..proximity.checks import PairCheck

TOLD = 12
"""How many names a refusal tells."""


def set_clearance(document: Document, clearance: float) -> Document:
    """Ask all pairs of solids to keep this clearance, in mm; 0: not to overlap."""
    checks = document.checks.with_(clearance=clearance)
    return document if checks == document.checks else document.with_(checks=checks)


def check_pair(
    document: Document, one: str, other: str, clearance: float | None = None, touching: bool = False
) -> Document:
    """Ask two solids, by their ids, for a clearance of their own, in mm, or to touch; neither: for what all are asked.

    The clearance 0 lets them touch, but not overlap.
    """
    solids = {root.id for root in document.solids}
    for node_id in (one, other):
        if node_id not in solids:
            raise Refusal(f"“{find(document, node_id).label}” is no solid that stands by itself")
    asked = PairCheck(one, other, clearance, touching)
    pairs = [pair for pair in document.checks.pairs if pair.ends != asked.ends]
    if asked.touching or asked.clearance is not None:
        pairs.append(asked)
    checks = document.checks.with_(pairs=tuple(pairs))
    return document if checks == document.checks else document.with_(checks=checks)


def solid_called(document: Document, name: str) -> str:
    """The id of the solid with this name. Raises Refusal."""
    for root in document.solids:
        if root.name == name:
            return root.id
    names = [f"“{root.name}”" for root in document.solids]
    told = ", ".join(names if len(names) <= TOLD else [*names[:TOLD], f"{len(names) - TOLD} more"])
    raise Refusal(f"there is no solid called “{name}”; there is {told or 'none at all'}")


def with_successors(document: Document, successors: Mapping[str, str]) -> Document:
    """The document where what was asked of the solids with these ids is asked of those that took their places."""
    pairs: dict[tuple[str, str], PairCheck] = {}
    for pair in document.checks.pairs:
        one, other = (successors.get(end, end) for end in pair.ends)
        if one != other:
            asked = pair if (one, other) == pair.ends else PairCheck(one, other, pair.clearance, pair.touching)
            pairs.setdefault(asked.ends, asked)
    checks = document.checks.with_(pairs=tuple(pairs.values()))
    return document if checks == document.checks else document.with_(checks=checks)


def copied_pairs(pairs: Iterable[PairCheck], copies: Mapping[str, str]) -> tuple[PairCheck, ...]:
    """What is asked of two solids that are both copied, asked of their copies; `copies` are ids by those copied."""
    return tuple(
        PairCheck(copies[pair.one], copies[pair.other], pair.clearance, pair.touching)
        for pair in pairs
        if pair.one in copies and pair.other in copies
    )
