"""Which occurrence made each face of a result.

manifold3d keeps, for every run of triangles, the original solid it came from and the map that placed it. One original
is made per leaf value, so original and map together tell the occurrence: the way from the root to the leaf.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..document.from_outlines import FROM_OUTLINES
from ..document.nodes import SURFACES, LinearArray, Mirror, Node, PolarArray
from ..document.placement import IDENTITY, product
from .copies import copies
from .failure import NoSolid

if TYPE_CHECKING:
    from manifold3d import Mesh64

Path = tuple[str | int, ...]


@dataclass(frozen=True, slots=True)
class Occurrence:
    """A leaf in its place: the ids from the root down, with the number of the copy behind an array or a mirror."""

    path: Path
    nodes: tuple[Node, ...]
    matrix: NDArray[np.float64]
    """(3, 4), from the leaf's own axes to the world's."""

    @property
    def leaf(self) -> Node:
        return self.nodes[-1]

    @property
    def colour(self) -> str | None:
        """The colour nearest to the leaf on its way up, the root's left out: that is the solid's own."""
        return next((node.colour for node in reversed(self.nodes[1:]) if node.colour), None)


def begins_faces(node: Node) -> bool:
    """Whether faces of a result are told to be this node's: a leaf, or what makes a surface of its own."""
    return not node.children or isinstance(node, (*FROM_OUTLINES, *SURFACES))


def occurrences(root: Node) -> tuple[Occurrence, ...]:
    """Every leaf occurrence of a resolved tree, in reading order."""
    found: list[Occurrence] = []
    stack: list[tuple[Path, tuple[Node, ...], NDArray[np.float64]]] = [((root.id,), (root,), _placed(IDENTITY, root))]
    while stack:
        path, nodes, matrix = stack.pop()
        node = nodes[-1]
        if begins_faces(node):
            found.append(Occurrence(path, nodes, matrix))
            continue
        try:
            maps = copies(node)
        except NoSolid:
            continue
        several = isinstance(node, LinearArray | PolarArray | Mirror)
        level = []
        for number, copy in enumerate(maps):
            outer = matrix if copy is IDENTITY else product(matrix, copy)
            step = (number,) if several else ()
            level += [((*path, *step, c.id), (*nodes, c), _placed(outer, c)) for c in node.children]
        stack += reversed(level)
    return tuple(found)


def _placed(matrix: NDArray[np.float64], node: Node) -> NDArray[np.float64]:
    return product(matrix, node.placement.matrix()) if node.placement.steps else matrix


def owners_of_runs(
    mesh: Mesh64, root: Node, originals: Mapping[int, bytes], found: tuple[Occurrence, ...] | None = None
) -> NDArray[np.int32]:
    """(r,) for each run of a mesh the number of its occurrence in `occurrences(root)`; -1 where none fits.

    `originals` maps manifold3d's original ids to the leaves' digests.
    """
    found = occurrences(root) if found is None else found
    ids = np.asarray(mesh.run_original_id, dtype=np.int64)
    by_leaf: dict[bytes, list[int]] = {}
    for number, occurrence in enumerate(found):
        by_leaf.setdefault(occurrence.leaf.shape_digest, []).append(number)
    owner = np.full(len(ids), -1, dtype=np.int32)
    # The kernel gives each map as (4, 3): the columns of ours.
    maps = np.asarray(mesh.run_transform, dtype=np.float64)
    maps = maps.reshape(-1, 4, 3).transpose(0, 2, 1) if maps.size else np.tile(IDENTITY, (len(ids), 1, 1))
    for original in np.unique(ids):
        candidates = by_leaf.get(originals.get(int(original), b""), [])
        runs = np.flatnonzero(ids == original)
        if len(candidates) == 1:
            owner[runs] = candidates[0]
        elif candidates:
            places = np.array([found[i].matrix for i in candidates]).reshape(len(candidates), 12)
            owner[runs] = np.array(candidates)[_nearest(maps[runs].reshape(len(runs), 12), places)]
    return owner


def _nearest(rows: NDArray[np.float64], places: NDArray[np.float64]) -> NDArray[np.int64]:
    """(r,) for each of `rows` (r, 12) the index of the nearest of `places` (p, 12).

    The kernel multiplies in another order than we do, so the last digits differ. Rows are looked up by their rounded
    numbers first, and compared with all places where that finds none.
    """
    size = float(np.abs(places).max(initial=1.0))
    step = size * 2.0**-30
    known = {row.tobytes(): i for i, row in reversed(list(enumerate(np.round(places / step) + 0.0)))}
    rounded = np.round(rows / step) + 0.0
    result = np.array([known.get(row.tobytes(), -1) for row in rounded], dtype=np.int64)
    for i in np.flatnonzero(result < 0):
        result[i] = int(np.argmin(np.abs(places - rows[i]).max(axis=1)))
    return result
