"""Sets of elements that are chosen by what they are: by angle, length, maker, direction; and what is listed."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...model.document.errors import Refusal
from ...model.mesh import selecting
from ...model.mesh.selecting import Flags, Kind
from ..view.occurrences import maker_of

if TYPE_CHECKING:
    from ...model.mesh.inspected import InspectedMesh
    from .chosen import Chosen

ALL, CHOSEN = "all", "chosen"
SAME_WAY = 1.0
"""Degrees by which faces may differ that look the same way."""


@dataclass(frozen=True, slots=True)
class Limits:
    """From how many degrees on an edge is sharp, and up to how many millimetres it is short."""

    sharp: float = 30.0
    short: float = 1.0


@dataclass(frozen=True, slots=True)
class Asked:
    """What a choice is made from: the mesh, what is chosen, the nodes that are selected in the tree."""

    mesh: InspectedMesh
    chosen: Chosen
    limits: Limits
    nodes: tuple[str, ...]

    def faces(self, words: str) -> Flags:
        """The chosen elements as faces. Raises Refusal."""
        if not self.chosen.count:
            raise Refusal(words)
        if self.chosen.kind == "face":
            return self.chosen.members
        edges = selecting.converted(self.mesh.winged, self.chosen.members, self.chosen.kind, "edge")
        return selecting.faces_of_edges(self.mesh.winged, edges, all_of_them=False)

    def edge(self, words: str) -> int:
        """The edge that is looked at. Raises Refusal."""
        if self.chosen.kind != "edge" or self.chosen.current < 0:
            raise Refusal(words)
        return self.chosen.current


Choice = Callable[[Asked], tuple[Kind, Flags]]


def _own(change: Callable[[Asked], Flags]) -> Choice:
    return lambda asked: (asked.chosen.kind, change(asked))


def _of_makers(asked: Asked) -> tuple[Kind, Flags]:
    faces = asked.faces("choose a face first")
    makers = {maker_of(asked.mesh.owners[i]) for i in np.unique(asked.mesh.maker[faces]).tolist() if i >= 0}
    return "face", selecting.faces_of_makers(asked.mesh, makers)


def _of_nodes(asked: Asked) -> tuple[Kind, Flags]:
    found = selecting.faces_of_makers(asked.mesh, asked.nodes)
    if not found.any():
        raise Refusal("no face of this solid was made by what is selected in the tree")
    return "face", found


def _same_way(asked: Asked) -> tuple[Kind, Flags]:
    faces = np.flatnonzero(asked.faces("choose a face first"))
    found = [selecting.faces_towards(asked.mesh, asked.mesh.face_normals[face], SAME_WAY) for face in faces[:100]]
    return "face", np.any(found, axis=0)


def _no_larger(asked: Asked) -> tuple[Kind, Flags]:
    faces = asked.faces("choose a face first")
    return "face", selecting.faces_of_area(asked.mesh, most=float(asked.mesh.area[faces].max()) * (1.0 + 1e-9))


def _connected(asked: Asked, most: float) -> tuple[Kind, Flags]:
    faces = asked.faces("choose a face first")
    return "face", selecting.connected_faces(asked.mesh, faces, most)


def _border(asked: Asked) -> tuple[Kind, Flags]:
    return "edge", selecting.edges_around(asked.mesh.winged, asked.faces("choose some faces first"))


def _edges(members: Iterable[int], asked: Asked) -> tuple[Kind, Flags]:
    return "edge", selecting.flags(len(asked.mesh.winged), members)


def _loop(asked: Asked) -> tuple[Kind, Flags]:
    edge = asked.edge("choose an edge first")
    return _edges(selecting.loop_of_edge(asked.mesh, edge, int(asked.chosen.reversed)), asked)


def _chain(asked: Asked) -> tuple[Kind, Flags]:
    return _edges(selecting.chain_of_edge(asked.mesh, asked.edge("choose an edge first")), asked)


CHOICES: dict[str, Choice] = {
    "all": _own(lambda a: np.ones_like(a.chosen.members)),
    "none": _own(lambda a: np.zeros_like(a.chosen.members)),
    "invert": _own(lambda a: ~a.chosen.members),
    "grow": _own(lambda a: selecting.grown(a.mesh.winged, a.chosen.members, a.chosen.kind)),
    "shrink": _own(lambda a: selecting.shrunk(a.mesh.winged, a.chosen.members, a.chosen.kind)),
    "sharp": lambda a: ("edge", selecting.bent_edges(a.mesh, a.limits.sharp)),
    "convex": lambda a: ("edge", selecting.bent_edges(a.mesh, 0.0, "convex")),
    "concave": lambda a: ("edge", selecting.bent_edges(a.mesh, 0.0, "concave")),
    "short": lambda a: ("edge", selecting.short_edges(a.mesh, a.limits.short)),
    "naked": lambda a: ("edge", a.mesh.naked),
    "non_manifold": lambda a: ("edge", a.mesh.non_manifold),
    "loop": _loop,
    "chain": _chain,
    "border": _border,
    "of_maker": _of_makers,
    "of_nodes": _of_nodes,
    "same_way": _same_way,
    "no_larger": _no_larger,
    "smooth": lambda a: _connected(a, a.limits.sharp),
    "connected": lambda a: _connected(a, 180.0),
}
"""What is chosen, by name; each may raise Refusal."""


@dataclass(frozen=True, slots=True)
class Filter:
    name: str
    title: str
    limit: str = ""
    """The field of Limits that it depends on."""


FILTERS: dict[str, tuple[Filter, ...]] = {
    "vertices": (
        Filter(ALL, "All vertices"),
        Filter(CHOSEN, "Chosen"),
        Filter("border", "On naked edges"),
        Filter("bare", "Without edges"),
    ),
    "normals": (Filter(ALL, "All normals"),),
    "faces": (
        Filter(ALL, "All faces"),
        Filter(CHOSEN, "Chosen"),
        Filter("of_nodes", "Of selected nodes"),
        Filter("holes", "With holes"),
    ),
    "edges": (
        Filter(ALL, "All edges"),
        Filter(CHOSEN, "Chosen"),
        Filter("naked", "Naked"),
        Filter("non_manifold", "Non-manifold"),
        Filter("short", "Short", "short"),
        Filter("sharp", "Sharp", "sharp"),
        Filter("convex", "Convex"),
        Filter("concave", "Concave"),
    ),
}
KIND_OF: dict[str, Kind] = {"vertices": "vertex", "normals": "face", "faces": "face", "edges": "edge"}
TABLE_OF: dict[Kind, str] = {"vertex": "vertices", "face": "faces", "edge": "edges"}


def listed(asked: Asked, table: str, name: str) -> Flags | None:
    """Which elements a table lists under a filter; None: all."""
    mesh = asked.mesh
    if name == ALL:
        return None
    if name == CHOSEN:
        kind = KIND_OF[table]
        return selecting.converted(mesh.winged, asked.chosen.members, asked.chosen.kind, kind)
    if name == "border":
        return selecting.vertices_of_edges(mesh.winged, mesh.naked)
    if name == "bare":
        return mesh.degree == 0
    if name == "holes":
        return np.diff(mesh.lists.face_loops) > 1
    if name == "of_nodes":
        return selecting.faces_of_makers(mesh, asked.nodes)
    return CHOICES[name](asked)[1]
