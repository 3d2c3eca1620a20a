"""What is drawn: the surfaces of a document's visible solids, those that meet joined into one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from manifold3d import Manifold, OpType
from numpy.typing import NDArray

from ..document.colours import rgb
from ..document.nodes import Node
from ..document.tree import unique_name
from ..partition.build import build
from ..partition.faces import Faces, faces_of_meshes
from ..partition.tree import Tree
from ..solid.display import DisplayMesh, display_mesh
from ..solid.provenance import Occurrence, occurrences, owners_of_runs
from ..solid.results import CONVEX, Evaluation, SolidResult, creases_of
from .drawing import Layer

Numbers = NDArray[np.int32]
SLACK = 1e-9
"""How near boxes of solids have to come for them to meet; as a part of the scene's size."""


@dataclass(frozen=True, slots=True, eq=False)
class Scene:
    """Surfaces in the world's axes; those that are closed do not cross one another.

    For owner k of mesh i, `layer_of[i][k]` is its layer and `solid_of[i][k]` the number of its solid; the last item of
    both stands for faces of an unknown owner (-1).
    """

    meshes: tuple[DisplayMesh, ...]
    closed: tuple[bool, ...]
    layer_of: tuple[Numbers, ...]
    solid_of: tuple[Numbers, ...]
    layers: tuple[Layer, ...]
    _kept: dict[str, Tree] = field(default_factory=dict)

    @property
    def extent(self) -> NDArray[np.float64]:
        """(2, 3) mm, around everything; zeros where there is nothing."""
        boxes = [mesh.bounds for mesh in self.meshes if len(mesh.corners)]
        return np.array([np.min(boxes, axis=0)[0], np.max(boxes, axis=0)[1]]) if boxes else np.zeros((2, 3))

    @property
    def triangles(self) -> int:
        """How many there are in all meshes."""
        return sum(len(mesh.corners) for mesh in self.meshes)

    def faces(self) -> Faces:
        """The triangles of all meshes, one mesh after the other, with their planes."""
        return self._kept["tree"].faces if "tree" in self._kept else faces_of_meshes(self.meshes)

    def tree(self, progress: Callable[[int, int], None] | None = None) -> Tree:
        """The BSP tree of `faces()`; built once, whatever the view."""
        if "tree" not in self._kept:
            self._kept["tree"] = build(self.faces(), progress=progress)
        return self._kept["tree"]


def scene_of(evaluation: Evaluation, progress: Callable[[str], None] | None = None) -> Scene:
    """The visible solids of an evaluated document.

    Solids that meet are joined exactly, so that they have edges where they cross: an eye inside one of them does not
    see the walls of the others there. What failed shows what is left of it, as on the screen. Imported surfaces that
    are not closed are taken as they are.
    """
    layers: list[Layer] = []
    numbers: dict[tuple[str, ...], int] = {}
    taken: set[str] = set()
    parts: list[tuple[DisplayMesh, bool, Numbers, Numbers]] = []

    def numbered(found: tuple[Occurrence, ...], root: Node) -> list[int]:
        return [_layer(occurrence, root, layers, numbers, taken) for occurrence in found]

    shown = [(number, result, _solid(result)) for number, result in enumerate(evaluation.visible)]
    solids = [(number, result.root, solid) for number, result, solid in shown if solid is not None]
    for number, result, solid in shown:
        mesh = None if solid is not None else evaluation.display(result)
        if mesh is not None and len(mesh.corners):
            found = occurrences(result.root)
            of = np.array([*numbered(found, result.root), 0], np.int32)
            of[-1] = of[0]
            parts.append((mesh, False, of, np.full(len(of), number, np.int32)))
    for group in _meeting([solid for _, _, solid in solids]):
        members = [solids[place] for place in group]
        if progress:
            progress(members[0][1].label)
        whole = members[0][2] if len(members) == 1 else Manifold.batch_boolean([s for _, _, s in members], OpType.Add)
        by_root = [occurrences(root) for _, root, _ in members]
        found = tuple(occurrence for each in by_root for occurrence in each)
        kernel_mesh = whole.to_mesh64()
        owner = owners_of_runs(kernel_mesh, members[0][1], evaluation.evaluator.originals, found)
        convex = np.array([isinstance(occurrence.leaf, CONVEX) for occurrence in found], dtype=bool)
        paths = tuple(occurrence.path for occurrence in found)
        mesh = display_mesh(kernel_mesh, owner, paths, convex, creases_of(found))
        of = [n for (_, root, _), each in zip(members, by_root, strict=True) for n in numbered(each, root)]
        solid_of = np.repeat([number for number, _, _ in members], [len(each) for each in by_root])
        parts.append((mesh, True, np.array([*of, of[0]], np.int32), np.append(solid_of, -1).astype(np.int32)))
    meshes, closed, layer_of, solids_of = zip(*parts, strict=True) if parts else ((), (), (), ())
    return Scene(meshes, closed, layer_of, solids_of, tuple(layers))


def _solid(result: SolidResult) -> Manifold | None:
    solid = result.rest if result.solid is None else result.solid
    return None if solid is None or solid.is_empty() else solid


def _meeting(solids: list[Manifold]) -> list[list[int]]:
    """The solids in groups; boxes of different groups do not meet."""
    count = len(solids)
    if not count:
        return []
    boxes = np.array([solid.bounding_box() for solid in solids]).reshape(count, 2, 3)
    slack = SLACK * float(np.linalg.norm(boxes[:, 1].max(axis=0) - boxes[:, 0].min(axis=0)))
    low, high = boxes[:, 0] - slack, boxes[:, 1] + slack
    waiting = list(range(count))
    group = np.full(count, -1)
    while waiting:
        place = waiting.pop()
        if group[place] < 0:
            group[place] = place
        meets = (low <= high[place]).all(axis=1) & (high >= low[place]).all(axis=1) & (group < 0)
        group[meets] = group[place]
        waiting += np.flatnonzero(meets).tolist()
    return [np.flatnonzero(group == number).tolist() for number in dict.fromkeys(group.tolist())]


def _layer(
    occurrence: Occurrence, root: Node, layers: list[Layer], numbers: dict[tuple[str, ...], int], taken: set[str]
) -> int:
    """The number of an occurrence's layer; copies in an array share one."""
    path = tuple(step for step in occurrence.path if isinstance(step, str))
    if path not in numbers:
        leaf = occurrence.leaf
        name = unique_name(root.label if len(path) == 1 else f"{root.label} / {leaf.label}", taken)
        taken.add(name)
        colour = occurrence.colour or root.colour
        numbers[path] = len(layers)
        layers.append(Layer(path, name, None if colour is None else rgb(colour)))
    return numbers[path]
