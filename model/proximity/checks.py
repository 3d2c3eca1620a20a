"""What is asked of the solids of a document: the clearance between them, and pairs with one of their own."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Self

from ..document.errors import Refusal
from ..document.expression import Expression, number


@dataclass(frozen=True, slots=True)
class PairCheck:
    """Two roots by their ids, and what is asked of them in place of what the document asks.

    `clearance` in mm, None: the document's. `touching`: they are meant to touch, so that a gap is a fault, and an
    overlap still is one.
    """

    one: str
    other: str
    clearance: float | None = None
    touching: bool = False

    def __post_init__(self) -> None:
        for end in (self.one, self.other):
            if not isinstance(end, str) or not end or len(end) > 100:
                raise Refusal(f"a pair is checked by the ids of two solids, not {end!r:.60}")
        if self.one == self.other:
            raise Refusal("a solid is not checked against itself")
        one, other = sorted((self.one, self.other))
        object.__setattr__(self, "one", one)
        object.__setattr__(self, "other", other)
        if self.clearance is not None:
            object.__setattr__(self, "clearance", clearance_of(self.clearance))
        if not isinstance(self.touching, bool):
            raise Refusal(f"whether two solids are meant to touch is true or false, not {self.touching!r:.60}")
        if self.touching and self.clearance is not None:
            raise Refusal("two solids that are meant to touch have no clearance")

    @property
    def ends(self) -> tuple[str, str]:
        return self.one, self.other


@dataclass(frozen=True, slots=True)
class Checks:
    """The `clearance` in mm that all pairs of visible solids keep (0: they do not overlap), but for some `pairs`."""

    clearance: float = 0.0
    pairs: tuple[PairCheck, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "clearance", clearance_of(self.clearance))
        if isinstance(self.pairs, str) or not isinstance(self.pairs, Iterable):
            raise Refusal(f"the pairs of a check are a list, not {self.pairs!r:.60}")
        pairs = tuple(sorted(self.pairs, key=lambda pair: pair.ends))
        if len({pair.ends for pair in pairs}) < len(pairs):
            raise Refusal("a pair of solids is checked in two ways")
        object.__setattr__(self, "pairs", pairs)

    def with_(self, **changes: Any) -> Self:
        return dataclasses.replace(self, **changes)

    def pair(self, one: str, other: str) -> PairCheck | None:
        """What is asked of these two, where that is something of their own."""
        ends = (min(one, other), max(one, other))
        return next((pair for pair in self.pairs if pair.ends == ends), None)


def clearance_of(value: object) -> float:
    """A clearance as a number. Raises Refusal."""
    plain = number(value, "a clearance")
    if isinstance(plain, Expression):
        raise Refusal("a clearance must be a plain number")
    if plain < 0.0:
        raise Refusal(f"a clearance is 0 mm or more, not {plain:g}")
    return plain
