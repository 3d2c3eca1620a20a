"""The solid of a node that is made from outlines: one function a kind, which registers itself here."""

from __future__ import annotations

from functools import singledispatch

from manifold3d import Manifold

from ...document.nodes import Node
from ..failure import NoSolid


@singledispatch
def drawn_solid(node: Node, tolerance: float) -> Manifold:
    """The solid of a node that is made from outlines, in its own axes. Raises NoSolid, and Refusal from its curves."""
    raise NoSolid(f"{node.title} is not made from outlines")
