"""What a check of pairs found: overlaps, gaps below what is asked, parts that were meant to touch; plain values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..worker.shown import Message
from .bodies import AROUND, INSIDE, TOUCHING, Body
from .bodies import OVERLAP as LEAST_OVERLAP
from .boxes import Floats

OVERLAP, NEAR, PARTED = "overlap", "near", "parted"
"""The faults of a pair: they share a volume, their gap is below what is asked, or they do not touch as they are meant
to."""
SAME = "same"
"""The same body in the same place; see `nesting`."""
OPEN, EMPTY, UNBOUNDED, FAILED = "open", "empty", "unbounded", "failed"
"""Why less is known of a solid than of others."""

ALL = 1.0 - 1e-9
"""The share of a volume from which it is all of it."""


@dataclass(frozen=True, slots=True, eq=False)
class Triangles:
    """A surface to be shown: `vertices` (n, 3) in mm and `triangles` (m, 3)."""

    vertices: Floats
    triangles: NDArray[np.integer]


@dataclass(frozen=True, slots=True, eq=False)
class Finding:
    """A pair of solids, by the ids and names of their roots, that is not as asked.

    `kind` is what the first is to the second, as in a Relation; `gap` is in mm, 0 where they meet, `points` (2, 3) its
    ends, None of an overlap. `asked` is the clearance asked of the pair, 0 where `touching`: they are meant to touch.
    `overlap` is the volume that they share in mm³, None where one is no solid, and `shares` which part of each that
    is. `bounds` (2, 3) hold the place; `body` is the surface of the overlap, None where it is too large to be kept.
    """

    one: str
    other: str
    names: tuple[str, str]
    fault: str
    kind: str
    gap: float
    asked: float
    touching: bool
    points: Floats | None
    overlap: float | None
    shares: tuple[float, float] | None
    bounds: Floats
    body: Triangles | None = field(default=None, repr=False)

    @property
    def ids(self) -> tuple[str, str]:
        return self.one, self.other

    @property
    def missing(self) -> float:
        """Millimetres of the clearance that are not there; of parts meant to touch, what is too much."""
        return abs(self.asked - self.gap)

    @property
    def coincident(self) -> bool:
        """Whether both are the same body in the same place."""
        return self.shares is not None and nesting(self.kind, self.shares) == SAME

    @property
    def nested(self) -> str:
        """INSIDE or AROUND where one holds all of the other, though their surfaces may meet; else ""."""
        return "" if self.shares is None or self.coincident else nesting(self.kind, self.shares)

    @property
    def badness(self) -> tuple[float, float]:
        return badness(self.overlap, self.missing)


@dataclass(frozen=True, slots=True)
class Remark:
    """A solid of which less is known than of others: `kind` is "open", "empty", "unbounded" or "failed".

    `message` is what evaluation said of it; `meets` names the solids that an open surface meets.
    """

    id: str
    name: str
    kind: str
    message: str = ""
    meets: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Report:
    """A check of a document: `findings`, the worst first, and `remarks` on solids that could not be checked wholly.

    `faults` counts the findings by their fault, also those that are left out, since only so many were wanted.
    `clearance` is the one asked of all, in mm; `solids` is how many visible ones there are, `pairs` how many pairs of
    them, and `near` how many of these were looked at, since their boxes are near. `messages` are the evaluation's.
    """

    findings: tuple[Finding, ...]
    remarks: tuple[Remark, ...]
    clearance: float
    solids: int
    pairs: int
    near: int
    faults: Mapping[str, int] = field(default_factory=dict)
    messages: tuple[Message, ...] = ()

    @property
    def in_order(self) -> bool:
        return not self.findings

    @property
    def left_out(self) -> int:
        return sum(self.faults.values()) - len(self.findings)


def badness(overlap: float | None, missing: float) -> tuple[float, float]:
    """Sorts the worst first: overlaps by volume, then by what is missing; what differs by rounding is the same."""
    return -float(f"{overlap or 0.0:.9g}"), -float(f"{missing:.9g}")


def shares_of(one: Body, other: Body, overlap: float) -> tuple[float, float]:
    """Which parts of two bodies' volumes an overlap in mm³ is."""
    least = LEAST_OVERLAP * overlap
    return min(overlap / max(one.volume, least), 1.0), min(overlap / max(other.volume, least), 1.0)


def nesting(kind: str, shares: tuple[float, float]) -> str:
    """What the first of two bodies that share something is to the second: SAME, INSIDE, AROUND, or "" for neither.

    `kind` is that of their Relation, where surfaces that meet make an overlap of any of these.
    """
    if min(shares) >= ALL:
        return SAME
    if kind in (INSIDE, AROUND):
        return kind
    return INSIDE if shares[0] >= ALL else AROUND if shares[1] >= ALL else ""


def meets_only(kind: str, overlap: float | None) -> bool:
    """Whether surfaces meet of which one bounds no solid, so that nothing is known of an overlap."""
    return kind == TOUCHING and overlap is None
