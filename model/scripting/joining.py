"""What joins, repeats and places solids."""

# Nodes take numbers as text too, and keep them as expressions; their types tell what they keep.
# pyright: reportArgumentType=false

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from typing import Any

from ..document import placement
from ..document.errors import Refusal
from ..document.nodes import (
    Difference,
    Displace,
    Hull,
    Instance,
    Intersection,
    LinearArray,
    Minkowski,
    Mirror,
    Node,
    PolarArray,
    Union,
)
from ..document.placement import Affine, Move, Reflect, Scale, Turn
from .shapes import Value


def solids_of(nodes: Iterable[Any]) -> tuple[Node, ...]:
    """The solids among nodes and lists of nodes, in order. Raises Refusal for what is neither."""
    found: list[Node] = []
    for node in nodes if isinstance(nodes, Iterable) and not isinstance(nodes, str) else (nodes,):
        if isinstance(node, Node):
            found.append(node)
        elif isinstance(node, Iterable) and not isinstance(node, str):
            found += solids_of(node)
        else:
            raise Refusal(f"a solid is needed, not {node!r:.60}")
    return tuple(found)


def union(*solids: Node | Iterable[Node]) -> Union:
    """All that lies in any of the solids; `a + b` in short.

    >>> measure(union(box(1), box(1).at(5))).components
    2
    """
    return Union(children=solids_of(solids))


def difference(first: Node | Iterable[Node] = (), *others: Node | Iterable[Node]) -> Difference:
    """The first solid less all others; `a - b` in short.

    >>> measure(difference(box(2), box(1))).volume
    7.0
    """
    return Difference(children=solids_of((first, *others)))


def intersection(*solids: Node | Iterable[Node]) -> Intersection:
    """What lies in all of the solids; `a & b` in short.

    >>> measure(intersection(box(2), box(2).at(1, 1, 1))).volume
    1.0
    """
    return Intersection(children=solids_of(solids))


def hull(*solids: Node | Iterable[Node]) -> Hull:
    """The smallest convex solid around the solids.

    >>> measure(hull(box(1), box(1).at(4))).volume
    5.0
    """
    return Hull(children=solids_of(solids))


def minkowski(first: Node | Iterable[Node] = (), *others: Node | Iterable[Node]) -> Minkowski:
    """The first solid swept by each of the others (Minkowski sum).

    >>> measure(minkowski(box(3), box(1))).volume
    64.0
    """
    return Minkowski(children=solids_of((first, *others)))


def displace(
    solid: Node | Iterable[Node] = (),
    bitmap: str | os.PathLike[str] = "",
    height: Value = 1,
    *,
    asset: str = "",
    projection: str = "box",
    copy_width: Value = 20,
    copy_height: Value = 20,
    edge: Value = 0.5,
) -> Displace:
    """A solid with its faces raised along their normals by the lightness of a bitmap file, `height` mm for white.

    The bitmap lies on it as a texture, by a `projection` (box, planar, cylindrical or spherical) about the origin, one
    copy `copy_width` by `copy_height` mm. `edge` is the longest edge of the triangles that are moved.
    """
    if bitmap and not asset:
        from .surfaces import kept

        asset = kept(bitmap)
    return Displace(children=solids_of((solid,)), asset=asset, height=height, projection=projection,
                    copy_width=copy_width, copy_height=copy_height, edge=edge)  # fmt: skip


def linear_array(solid: Node, count: Value = 3, step: Sequence[Value] = (20, 0, 0)) -> LinearArray:
    """Copies of a solid, each one step further.

    >>> measure(linear_array(box(1), 5, (2, 0, 0))).volume
    5.0
    """
    return LinearArray(children=(solid,), count=count, step=tuple(step))


def polar_array(
    solid: Node,
    count: Value = 6,
    angle: Value = 360,
    axis: Sequence[Value] = (0, 0, 1),
    point: Sequence[Value] = (0, 0, 0),
) -> PolarArray:
    """Copies of a solid turned about an axis; a full turn spreads them evenly, a part of one goes from first to last.

    >>> measure(polar_array(box(1).at(5), 4)).components
    4
    """
    return PolarArray(children=(solid,), count=count, angle=angle, axis=tuple(axis), point=tuple(point))


def mirror(
    solid: Node, normal: Sequence[Value] = (1, 0, 0), point: Sequence[Value] = (0, 0, 0), keep: bool = True
) -> Mirror:
    """A solid and its mirror image in a plane, or with `keep=False` the image alone (as `solid.mirrored` has it).

    >>> measure(mirror(box(1).at(2))).volume
    2.0
    """
    return Mirror(children=(solid,), normal=tuple(normal), point=tuple(point), keep=keep)


def instance(definition: str = "") -> Instance:
    """The document's definition of this id, once more; it has a meaning only in that document."""
    return Instance(definition=definition)


def at(x: Value = 0, y: Value = 0, z: Value = 0) -> Move:
    """A placement step for `place`: a move by millimetres.

    >>> box(1).placed(turned(z=45), at(5)) == box(1).turned(z=45).at(5)
    True
    """
    return placement.moved(x, y, z)


def turned(x: Value = 0, y: Value = 0, z: Value = 0) -> Turn:
    """A placement step for `place`: a turn by degrees about x, then y, then z."""
    return placement.turned(x, y, z)


def scaled(x: Value = 1, y: Value | None = None, z: Value | None = None) -> Scale:
    """A placement step for `place`: a scaling by one factor, or by one for each axis."""
    return placement.scaled(x, y, z)


def mirrored(normal: Sequence[Value] = (1, 0, 0)) -> Reflect:
    """A placement step for `place`: a reflection in the plane through the origin with this normal."""
    return Reflect(tuple(normal))


def transformed(matrix: Iterable[Iterable[Value]]) -> Affine:
    """A placement step for `place`: a map by a (3, 4) matrix."""
    return placement.affine(matrix)


__all__ = [
    "at",
    "difference",
    "displace",
    "hull",
    "instance",
    "intersection",
    "linear_array",
    "minkowski",
    "mirror",
    "mirrored",
    "polar_array",
    "scaled",
    "transformed",
    "turned",
    "union",
]
