"""What the writers of mesh files are given, and numbers as text at the speed that large meshes need."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from .dress import Dress

_ROWS = 1 << 15


@dataclass(frozen=True, eq=False)
class OutSolid:
    """One solid to be written, in millimetres and with z up."""

    name: str
    colour: str | None
    """`#rrggbb`"""
    vertices: NDArray[np.float64]
    """(n, 3)"""
    triangles: NDArray[Any]
    """(m, 3) indices into vertices, counter-clockwise seen from outside"""
    dress: Dress | None = None
    """The materials of its faces, where any has one"""


def lines(template: str, rows: NDArray[Any]) -> Iterator[bytes]:
    """The template filled with each row, in pieces; `%r` writes a float so that it reads back the same."""
    for start in range(0, len(rows), _ROWS):
        piece = rows[start : start + _ROWS]
        yield ((template * len(piece)) % tuple(piece.ravel().tolist())).encode()


def plain_name(name: str) -> str:
    """A name on one line, without what XML and text formats cannot hold."""
    return " ".join("".join(c if c.isprintable() else " " for c in name).split())
