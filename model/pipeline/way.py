"""A vertex's whole way as one value, for scripts and the command line."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..document.errors import Refusal
from .explanation import Stage, number, outside, way_of
from .matrices import NAMES, Matrices


@dataclass(frozen=True, slots=True)
class Way:
    """The matrices, the point at each stage, and the names of the planes beyond which it lies, none where it is seen.
    As text it is a table."""

    matrices: Matrices
    stages: tuple[Stage, ...]
    outside: tuple[str, ...]

    @property
    def pixel(self) -> tuple[float, float, float]:
        """x, y and depth."""
        x, y, depth = self.stages[-1].coordinates
        return x, y, depth

    def json(self) -> dict[str, Any]:
        """For the command line; numbers that are infinite become null."""
        return {
            "stages": [
                {
                    "name": stage.name.lower(),
                    "coordinates": [value if np.isfinite(value) else None for value in stage.coordinates],
                    "formulas": list(stage.formulas),
                    "words": stage.words,
                }
                for stage in self.stages
            ],
            "outside": list(self.outside),
            "seen": not self.outside,
        }

    def __str__(self) -> str:
        return "\n".join(
            f"{stage.name:8}" + "".join(f"{number(value):>12}" for value in stage.coordinates) for stage in self.stages
        )


def follow(matrices: Matrices, point: ArrayLike) -> Way:
    """A point (3,) in its node's own axes on its way to the screen. Raises Refusal for numbers that are none."""
    own = np.asarray(point, float)
    if own.shape != (3,) or not np.isfinite(own).all():
        raise Refusal("a point is three finite numbers such as 10, -20, 5")
    return Way(matrices, way_of(matrices, own), outside(matrices.stages([own]).clip[0]))


def rows(matrices: Matrices) -> dict[str, list[list[float]]]:
    """The numbers of the matrices by their names."""
    return {name: getattr(matrices, name).tolist() for name in NAMES}
