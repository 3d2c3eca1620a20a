"""The rows behind the tree's model, and how to change a list of them by few removals and insertions."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable

from ...model.document.nodes import Node


class Row:
    """One node on the screen. `children` mirrors the node's operands."""

    __slots__ = ("children", "key", "node", "parent")

    def __init__(self, node: Node | None, parent: Row | None, key: int) -> None:
        self.node: Node = node  # type: ignore[assignment]  # None in the invisible root alone
        self.parent = parent
        self.key = key
        self.children: list[Row] = []


def runs(places: Iterable[int]) -> Iterable[tuple[int, int]]:
    """Rising numbers as (first, last) of each part without a gap."""
    found: list[tuple[int, int]] = []
    for place in places:
        if found and found[-1][1] == place - 1:
            found[-1] = (found[-1][0], place)
        else:
            found.append((place, place))
    return found


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
