"""From nodes to what they look like in a picture: paths of their occurrences, their colours, the box around them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ...model.document.document import Document
from ...model.document.nodes import Node
from ...model.document.tree import walk
from ...model.surface.appearance import appearances, is_dressed

if TYPE_CHECKING:
    from ...model.solid.display import DisplayMesh
    from ...render.look import Paint

Path = tuple[str | int, ...]


def maker_of(path: Path) -> str:
    """The id of the node that an owner's path ends at."""
    return next(str(part) for part in reversed(path) if isinstance(part, str))


def paths_through(ids: Iterable[str], owners: Iterable[Iterable[Path]]) -> set[Path]:
    """The parts of the owners' paths that end at one of the nodes."""
    wanted = set(ids)
    if not wanted:
        return set()
    return {path[: i + 1] for paths in owners for path in paths for i, part in enumerate(path) if part in wanted}


def selected_bounds(ids: Iterable[str], meshes: Iterable[DisplayMesh]) -> NDArray[np.float64] | None:
    """The box (2, 3) around the faces that these nodes made, None where there are none."""
    wanted = set(ids)
    boxes = []
    for mesh in meshes:
        mine = np.array([bool(wanted.intersection(path)) for path in mesh.owners], bool)
        faces = mesh.triangles[mine[mesh.owner]] if len(mine) else mesh.triangles[:0]
        if mesh.sheet and mine.any():
            boxes.append(tuple(mesh.bounds))  # an open curve has no faces
        elif len(faces):
            points = mesh.points[np.unique(faces)]
            boxes.append((points.min(axis=0), points.max(axis=0)))
    if not boxes:
        return None
    lower, upper = zip(*boxes, strict=True)
    return np.array([np.min(lower, axis=0), np.max(upper, axis=0)], float)


def paint_of(
    document: Document, root: Node, mesh: DisplayMesh, by_node: bool = False, resolved: Node | None = None
) -> Paint:
    """Each owner's colour: that of the lowest coloured node on its path below the root, the root's by default; or one
    for each node that made faces, whatever its colour. And what it wears, where the `resolved` root is given."""
    from ...render.look import Paint

    if by_node:
        from ...model.document.distinct_colours import distinct_colour

        return Paint(None, tuple(distinct_colour(maker_of(path)) for path in mesh.owners))
    if resolved is not None and is_dressed(document, root):
        looks = appearances(document, resolved, mesh.owners)
        return Paint(root.colour, tuple(look.colour for look in looks), looks)
    nodes = (node for node in walk(root, *document.definitions) if node is not root)
    colours = {node.id: node.colour for node in nodes if node.colour is not None}
    if not colours:
        return Paint(root.colour)
    owners = tuple(
        next((colours[part] for part in reversed(path) if isinstance(part, str) and part in colours), None)
        for path in mesh.owners
    )
    return Paint(root.colour, owners)
