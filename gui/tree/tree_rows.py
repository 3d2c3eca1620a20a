"""The rows behind the tree's model, and how to change a list of them by few removals and insertions."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable

from PySide6.QtCore import QModelIndex

from ...model.document.nodes import Node


class Row:
    """One node on the screen. `children` mirrors the node's operands."""

    __slots__ = ("_place", "children", "key", "node", "parent")

    def __init__(self, node: Node | None, parent: Row | None, key: int) -> None:
        self.node: Node = node  # type: ignore[assignment]  # None in the invisible root alone
        self.parent = parent
        self.key = key
        self.children: list[Row] = []
        self._place = 0

    def place(self) -> int:
        """Its place among its siblings, whose places are found anew only after they have changed."""
        assert self.parent is not None
        family = self.parent.children
        if self._place >= len(family) or family[self._place] is not self:
            for place, sibling in enumerate(family):
                sibling._place = place
        return self._place


def runs(places: Iterable[int]) -> Iterable[tuple[int, int]]:
    """Rising numbers as (first, last) of each part without a gap."""
    found: list[tuple[int, int]] = []
    for place in places:
        if found and found[-1][1] == place - 1:
            found[-1] = (found[-1][0], place)
        else:
            found.append((place, place))
    return found


def adjacent(indexes: Iterable[QModelIndex]) -> list[tuple[QModelIndex, QModelIndex]]:
    """Indexes of a model as (first, last) of each part of siblings without a gap."""
    parts: list[tuple[QModelIndex, QModelIndex]] = []
    families: dict[int, list[QModelIndex]] = {}
    for index in indexes:
        families.setdefault(index.parent().internalId() if index.parent().isValid() else 0, []).append(index)
    for family in families.values():
        by_row = {index.row(): index for index in family}
        parts += [(by_row[first], by_row[last]) for first, last in runs(sorted(by_row))]
    return parts


def longest_rising(values: list[int]) -> list[int]:
    """Places of a longest strictly rising part of `values`, negative ones left out (Fredman 1975)."""
    ends: list[int] = []
    places: list[int] = []
    before: list[int] = []
    for place, value in enumerate(values):
        before.append(-1)
        if value < 0:
            continue
        at = bisect_left(ends, value)
        before[place] = places[at - 1] if at else -1
        ends[at : at + 1] = [value]
        places[at : at + 1] = [place]
    chain: list[int] = []
    place = places[-1] if places else -1
    while place >= 0:
        chain.append(place)
        place = before[place]
    return chain
