"""Outlines joined, cut, grown, shrunk and stroked, with a path that stays a curve as the result."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from ...document.document import Document
from ...document.errors import Refusal
from ...document.nodes import Node
from ...document.outlines import Path, is_outline
from ...document.placement import Placement
from ...document.resolve import resolve
from ...document.tree import change_each, listed, outermost, trail, walk
from ..fitting import check_free

if TYPE_CHECKING:
    from ...path.path import Path as Curves

TOLERANCE = 0.01
Made = TypeVar("Made")


def combine_outlines(document: Document, kind: str, ids: Sequence[str] | str) -> Document:
    """Join outlines by "union", "difference" (the first less the others), "intersection" or "exclusion".

    The result is one path of the curves that were there. It takes the place of the first; the others go. All lie in
    one plane.
    """
    from ...path.areas.booleans import KINDS, check_filled, combined

    if kind not in KINDS:
        raise Refusal(f"outlines are combined as {', '.join(KINDS)}, not “{kind!s:.40}”")
    wanted = _outlines(document, outermost(document, ids))
    paths = _in_one_plane(document, wanted)
    for node, path in zip(wanted, paths, strict=True):
        _named(node, lambda path=path: check_filled(path))
    result = combined(kind, paths)
    if not result.contours:
        raise Refusal(f"nothing is left of “{wanted[0].label}”: the {kind} of these outlines is empty")
    new = _path_instead(wanted[0], result)
    gone = {node.id for node in wanted[1:]}
    return change_each(document, [node.id for node in wanted], lambda node: None if node.id in gone else new)


def offset_outline(
    document: Document, ids: Sequence[str] | str, distance: float, join: str = "round", tolerance: float = TOLERANCE
) -> Document:
    """Make outlines larger by `distance` mm all around, or smaller where it is below 0, each by itself.

    `join` tells what stands at corners: "round", "miter" or "bevel". The curves are true within `tolerance` mm.
    """
    from ...path.areas.offsetting import offset

    def larger(path: Curves) -> Curves:
        return offset(path, float(distance), float(tolerance), join) if float(distance) else path

    return _each(document, ids, larger, "a smaller distance")


def stroke_outline(
    document: Document,
    ids: Sequence[str] | str,
    width: float,
    join: str = "round",
    ends: str = "round",
    tolerance: float = TOLERANCE,
) -> Document:
    """Turn curves, open or closed, into the outlines of a stroke `width` mm wide along them, each by itself.

    `join` as for `offset_outline`; open curves end "round", "butt" or "square".
    """
    from ...path.areas.offsetting import outline

    return _each(
        document, ids, lambda path: outline(path, float(width), float(tolerance), join, ends), "a greater width"
    )


def _each(document: Document, ids: Sequence[str] | str, changed: Callable[[Curves], Curves], cure: str) -> Document:
    new: dict[str, Node] = {}
    for node in _outlines(document, listed(ids)):
        path = own_axes_path(document, node.id)
        flat = _named(node, lambda path=path: _flat(path))
        result = _named(node, lambda flat=flat: changed(flat))
        if result is flat:
            continue
        if not result.contours:
            raise Refusal(f"nothing is left of “{node.label}”: take {cure}")
        new[node.id] = _path_instead(node, result)
    return change_each(document, list(new), lambda node: new[node.id])


def own_axes_path(document: Document, node_id: str) -> Curves:
    """The path of an outline in its own axes, expressions resolved. Raises Refusal."""
    from ...outline.paths import path_of

    way = trail(document, node_id)
    root = resolve(document.with_(solids=(way[0],), profiles=())).solids[0]
    node = next(node for node in walk(root) if node.id == node_id)
    return path_of(node.with_(placement=Placement()))


def _outlines(document: Document, ids: Sequence[str]) -> list[Node]:
    if not ids:
        raise Refusal("select an outline first")
    check_free(document, ids)
    nodes = [trail(document, node_id)[-1] for node_id in ids]
    for node in nodes:
        if not is_outline(node, document.definitions):
            raise Refusal(f"“{node.label}” is no outline: only flat things and curves are combined here")
    return nodes


def _in_one_plane(document: Document, nodes: list[Node]) -> list[Curves]:
    """The paths of outlines in the own axes of the first one."""
    paths = [own_axes_path(document, node.id) for node in nodes]
    if len(nodes) == 1:
        return paths
    from ...outline.frames import frame_of
    from ...outline.paths import moved

    first = frame_of(document, nodes[0].id)
    back = np.linalg.inv(np.vstack((first, (0.0, 0.0, 0.0, 1.0))))[:3]
    found = paths[:1]
    for node, path in zip(nodes[1:], paths[1:], strict=True):
        frame = frame_of(document, node.id)
        matrix = np.column_stack((back[:, :3] @ frame[:, :3], back[:, :3] @ frame[:, 3] + back[:, 3]))
        moved_path = moved(path, matrix)
        if any(contour.dimension == 3 for contour in moved_path.contours):
            raise Refusal(
                f"“{node.label}” does not lie in the plane of “{nodes[0].label}”: only outlines in one plane are "
                "combined"
            )
        found.append(moved_path)
    return found


def _flat(path: Curves) -> Curves:
    if any(contour.dimension == 3 for contour in path.contours):
        raise Refusal("it leaves its plane; only a flat curve has parallels")
    return path


def _named(node: Node, make: Callable[[], Made]) -> Made:
    try:
        return make()
    except Refusal as refusal:
        raise Refusal(f"“{node.label}”: {refusal}") from None


def _path_instead(node: Node, path: Curves) -> Node:
    from ...outline.paths import fields_of

    return Path(
        id=node.id,
        name=node.name,
        colour=node.colour,
        visible=node.visible,
        note=node.note,
        placement=node.placement,
        **fields_of(path),
    )
