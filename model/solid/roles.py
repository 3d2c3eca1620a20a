"""What becomes of a node in the result that it stands in."""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum

from ..document.nodes import SURFACES, Difference, Intersection, Node
from .provenance import Path


class Role(StrEnum):
    """The values are the words that users read; SHOWN needs none."""

    SHOWN = ""
    SUBTRACTED = "subtracted"
    INTERSECTED = "intersected"
    ENCLOSED = "enclosed"
    """An operand of a hull or a Minkowski sum, whose surface is not the operands'."""


def roles_along(roots: Sequence[Node], path: Path) -> tuple[Role, ...]:
    """The role, in the solid, of each part of an occurrence's path; as far as the path is found in the resolved trees.

    What is enclosed stays so; below that, a subtracted part counts for more than an intersected one. The number of a
    copy has the role of the array it belongs to.
    """
    node = next((root for root in roots if path and root.id == path[0]), None)
    role, roles = Role.SHOWN, []
    for below in (*path[1:], None):
        roles.append(role)
        if node is None or below is None:
            break
        if isinstance(below, int):
            continue
        place = next((i for i, child in enumerate(node.children) if child.id == below), None)
        if place is None:
            break
        if role is not Role.ENCLOSED:
            if isinstance(node, SURFACES):
                role = Role.ENCLOSED
            elif isinstance(node, Difference) and place > 0:
                role = Role.SUBTRACTED
            elif isinstance(node, Intersection) and role is Role.SHOWN and len(node.children) > 1:
                role = Role.INTERSECTED
        node = node.children[place]
    return tuple(roles)


def role_of(roots: Sequence[Node], path: Path) -> Role:
    """The role of what a path leads to. `roots` are resolved."""
    return roles_along(roots, path)[-1] if path else Role.SHOWN
