"""Nodes lined up and spread evenly, and outlines mirrored where they are."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from ...document.document import Document
from ...document.errors import Refusal
from ...document.expression import symbolic
from ...document.nodes import Node
from ...document.outlines import CURVES, Circle, Rectangle, is_outline
from ...document.placement import Placement, Reflect, moved
from ...document.tree import change, find, listed
from .addressing import Floats, Place, drawn, pairs
from .control_points import controls, has_control_points, place_points
from .nodes import place_nodes, transform_nodes
from .outline_areas import own_axes_path

AXES = "xyz"
SIDES = ("min", "middle", "max")


def align_nodes(document: Document, node_id: str, nodes: Iterable[Place], axis: str, to: str = "middle") -> Document:
    """Give nodes, or control points, told by (0, number), one x, y or z: the least, the greatest, or that between."""
    if to not in SIDES:
        raise Refusal(f"nodes are lined up at {', '.join(SIDES)}, not “{to!s:.40}”")
    wanted, places, column = _places(document, node_id, nodes, axis, 2)
    low, high = float(places[:, column].min()), float(places[:, column].max())
    places[:, column] = {"min": low, "middle": 0.5 * (low + high), "max": high}[to]
    return _placed(document, node_id, wanted, places)


def distribute_nodes(document: Document, node_id: str, nodes: Iterable[Place], axis: str) -> Document:
    """Spread nodes, or control points, evenly along x, y or z, from the outermost to the outermost, in their order."""
    wanted, places, column = _places(document, node_id, nodes, axis, 3)
    order = np.argsort(places[:, column], kind="stable")
    low, high = places[order[[0, -1]], column]
    places[order, column] = np.linspace(low, high, len(order))
    return _placed(document, node_id, wanted, places)


def mirror_outline(document: Document, ids: Sequence[str] | str, axis: str) -> Document:
    """Mirror outlines where they are: along "x" left and right change places, along "y" top and bottom.

    The points of curves change; other outlines, and points that follow expressions, are mirrored by the placement.
    """
    if axis not in ("x", "y"):
        raise Refusal(f"an outline is mirrored along x or y, not “{axis!s:.40}”")
    wanted = listed(ids)
    if not wanted:
        raise Refusal("select an outline first")
    for node_id in wanted:
        document = _mirrored(document, node_id, axis)
    return document


def _mirrored(document: Document, node_id: str, axis: str) -> Document:
    node = find(document, node_id)
    if not is_outline(node, document.definitions):
        raise Refusal(f"“{node.label}” is no outline")
    if isinstance(node, Rectangle) or (isinstance(node, Circle) and node.segments is None):
        return document  # is its own mirror image
    path = own_axes_path(document, node_id)
    if not path.contours:
        return document
    column = AXES.index(axis)
    both = float(path.bounds()[:, column].sum())
    if isinstance(node, CURVES) and not symbolic(node.points):  # type: ignore[attr-defined]
        matrix = np.eye(2, 3)
        matrix[column] *= -1.0
        matrix[column, 2] = both
        return transform_nodes(document, node_id, _all(document, node), matrix.tolist())
    normal: Any = [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0)][column]
    steps = (Reflect(normal), moved(*(both * np.array(normal)).tolist()), *node.placement.steps)
    return change(document, node_id, lambda node: node.with_(placement=Placement(steps)))


def _all(document: Document, node: Node) -> list[Place]:
    if has_control_points(document, node.id):
        return [(0, number) for number in range(len(node.points))]  # type: ignore[attr-defined]
    contours = drawn(document, node.id).path.contours
    return [(number, row) for number, contour in enumerate(contours) for row in range(len(contour.nodes))]


def _places(
    document: Document, node_id: str, nodes: Iterable[Place], axis: str, least: int
) -> tuple[list[Place], Floats, int]:
    """The nodes, without doubles, where they are (k, d), and the column of the axis. Raises Refusal."""
    wanted = list(dict.fromkeys(pairs(nodes)))
    if has_control_points(document, node_id):
        points = controls(document, node_id).points
        known = {(0, number): point for number, point in enumerate(points)}
    else:
        contours = drawn(document, node_id).path.contours
        known = {(n, row): point for n, contour in enumerate(contours) for row, point in enumerate(contour.places)}
    label = find(document, node_id).label
    for place in wanted:
        if place not in known:
            raise Refusal(f"“{label}” has no node {place[1]} in contour {place[0]}")
    if len(wanted) < least:
        raise Refusal(f"select {'two' if least == 2 else 'three'} nodes of “{label}” or more")
    places = np.array([known[place] for place in wanted])
    if axis not in tuple(AXES[: places.shape[1]]):
        raise Refusal(f"the nodes of “{label}” have {' and '.join(AXES[: places.shape[1]])}, not “{axis!s:.40}”")
    return wanted, places, AXES.index(axis)


def _placed(document: Document, node_id: str, nodes: list[Place], places: Floats) -> Document:
    if has_control_points(document, node_id):
        return place_points(document, node_id, [number for _, number in nodes], places.tolist())
    return place_nodes(document, node_id, nodes, places.tolist())
