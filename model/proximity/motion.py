"""A timed motion: a parameter goes from one value to another, and what depends on it moves."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from typing import Any, Self

from ..document.errors import Refusal
from ..document.expression import Expression, number

MOST_STEPS = 10_000
LONGEST = 3600.0
"""Seconds."""


@dataclass(frozen=True, slots=True)
class Motion:
    """The `parameter` goes evenly from `start` to `end` in `seconds`, looked at in `steps` + 1 places."""

    name: str
    parameter: str
    start: float = 0.0
    end: float = 1.0
    seconds: float = 4.0
    steps: int = 50

    def __post_init__(self) -> None:
        if not isinstance(self.name, str) or not self.name.strip() or len(self.name) > 200:
            raise Refusal(f"a motion needs a name of 1 to 200 characters, not {self.name!r:.60}")
        what = f"the motion “{self.name}”"
        if not isinstance(self.parameter, str) or not self.parameter.isidentifier():
            raise Refusal(f"{what}: {self.parameter!r:.60} is no name of a parameter")
        for field in ("start", "end", "seconds"):
            plain = number(getattr(self, field), f"{what}: the {field}")
            if isinstance(plain, Expression):
                raise Refusal(f"{what}: the {field} must be a plain number")
            object.__setattr__(self, field, plain)
        if self.start == self.end:
            raise Refusal(f"{what}: the parameter {self.parameter} starts and ends at {self.start:g}: nothing moves")
        if not math.isfinite(self.end - self.start):
            raise Refusal(f"{what}: from {self.start:g} to {self.end:g} is farther than numbers go")
        if not 0.0 < self.seconds <= LONGEST:
            raise Refusal(f"{what} takes more than 0 and at most {LONGEST:g} seconds, not {self.seconds:g}")
        if type(self.steps) is not int or not 1 <= self.steps <= MOST_STEPS:
            raise Refusal(f"{what} has 1 to {MOST_STEPS:,} steps, not {self.steps!r:.60}")

    def with_(self, **changes: Any) -> Self:
        return dataclasses.replace(self, **changes)

    def value(self, part: float) -> float:
        """The parameter at a part, from 0 to 1, of the way."""
        return self.end if part >= 1.0 else self.start + part * (self.end - self.start)
