"""What an evaluation asks for and what it answers with."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

import numpy as np
from manifold3d import Manifold
from numpy.typing import NDArray

from ..document.nodes import Node

Bounds = NDArray[np.float64]  # (2, 3)
Key = tuple[bytes, float, bytes]
"""A node's digest without its placement, the tolerance, and the box that something endless is cut to."""


@dataclass(frozen=True, slots=True)
class Problem:
    """Something to tell about a node; `place` is the way down to it, the index of an operand at each level."""

    place: tuple[int, ...]
    message: str
    error: bool = True


@dataclass(frozen=True, slots=True)
class Entry:
    """What the memo keeps for a value: the solid in its own axes, or None where it failed, and what there is to say.

    `rest` is for the eye only: what a failed operation is without the operands that failed.
    """

    key: Key
    solid: Manifold | None
    problems: tuple[Problem, ...] = ()
    rest: Manifold | None = None

    @property
    def seen(self) -> Manifold | None:
        """The solid, or the rest of it."""
        return self.rest if self.solid is None else self.solid

    @property
    def bytes(self) -> int:
        """About how much memory the solid takes."""
        return 400 if self.seen is None else 400 + 150 * self.seen.num_tri()


@dataclass(frozen=True, slots=True)
class Wanted:
    """A node asked for in its own axes: at a tolerance, and cut to a box if it has no end."""

    node: Node
    tolerance: float
    box: Bounds | None

    @property
    def key(self) -> Key:
        return self.node.shape_digest, self.tolerance, b"" if self.box is None else self.box.tobytes()


Steps = Generator[Wanted, Entry, Entry]
"""How an operation runs: it yields what it asks for, is sent the entries, and returns its own."""


class Superseded(Exception):
    """The result is no longer wanted."""


def distinct(problems: list[Problem]) -> tuple[Problem, ...]:
    return tuple(dict.fromkeys(problems))
