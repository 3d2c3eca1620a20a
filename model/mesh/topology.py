"""What kind of surface a winged edge is: pieces, borders, Euler's number, genus, what keeps it from being a solid."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .lists import Numbers
from .pieces import pieces
from .walks import borders, stars
from .winged import END, LEFT, LEFT_AFTER, LEFT_BEFORE, RIGHT, START, WingedEdge


@dataclass(frozen=True, slots=True)
class Topology:
    """Counts. `loops` are those of faces; `components` hang together by edges, `fans` are the places where surfaces
    meet in a vertex only (the fans there, less one each). `repeated` are edges that stand for a pair of vertices which
    has another one too. `genus` is that of all components together, None where borders or repeated edges leave it
    open."""

    vertices: int
    edges: int
    faces: int
    loops: int
    components: int
    borders: int
    border_edges: int
    repeated: int
    fans: int
    genus: int | None

    @property
    def euler(self) -> int:
        """V - E + F - (L - F), where V counts a vertex once for each fan (Euler and Poincaré; Mäntylä 1988)."""
        return self.vertices + self.fans - self.edges + self.faces - (self.loops - self.faces)

    @property
    def closed(self) -> bool:
        """Whether every edge has a face on both sides, and no pair of vertices two edges."""
        return not self.border_edges and not self.repeated


def topology(mesh: WingedEdge) -> Topology:
    """Of a mesh; vertices that no edge has do not count."""
    starts, _, begins = stars(mesh)
    used = int((np.diff(starts) > 0).sum())
    fans = len(begins) - used
    border = int(((mesh.table[:, LEFT] < 0) | (mesh.table[:, RIGHT] < 0)).sum())
    first = np.bincount(mesh.copy_of, minlength=len(mesh))
    repeated = int(first[first > 1].sum())
    components = int(component_of_faces(mesh).max(initial=-1)) + 1
    loops, faces = len(mesh.loop_edge), mesh.face_count
    whole = not border and not repeated
    found = Topology(used, len(mesh), faces, loops, components, len(borders(mesh)), border, repeated, fans, None)
    genus = (2 * components - found.euler) // 2 if whole else None
    return Topology(used, len(mesh), faces, loops, components, found.borders, border, repeated, fans, genus)


def component_of_faces(mesh: WingedEdge) -> Numbers:
    """(f,) which faces hang together by edges, numbered by their first face; copies of an edge count as one edge."""
    sides = mesh.table[:, [LEFT, RIGHT]]
    both = (sides >= 0).all(axis=1)
    any_face = sides.max(axis=1, initial=-1)
    copied = np.flatnonzero(mesh.copy_of != np.arange(len(mesh)))
    one = np.concatenate((sides[both, 0], any_face[copied]))
    other = np.concatenate((sides[both, 1], any_face[mesh.copy_of[copied]]))
    return pieces(one, other, mesh.face_count)


def contradictions(mesh: WingedEdge) -> list[str]:
    """Where a winged edge contradicts itself, in words; none in one that is sound."""
    table, found = mesh.table, []
    ends = table[:, [START, END]]
    if len(table) and (ends.min() < 0 or ends.max() >= len(mesh.vertices)):
        return ["an edge has an end that is no vertex"]
    loop_of_side = {}
    for loop in range(len(mesh.loop_edge)):
        face = int(np.searchsorted(mesh.face_loops, loop, side="right")) - 1
        edge, side = int(mesh.loop_edge[loop]), int(mesh.loop_side[loop])
        first, steps = (edge, side), 0
        while True:
            if (edge, side) in loop_of_side:
                found.append(f"edge {edge} is on loops {loop_of_side[edge, side]} and {loop}")
                break
            loop_of_side[edge, side] = loop
            if table[edge, LEFT + side] != face:
                found.append(f"edge {edge} has face {table[edge, LEFT + side]} where loop {loop} is of face {face}")
            vertex = int(table[edge, END - side])
            onward = int(table[edge, LEFT_AFTER + 2 * side])
            if not 0 <= onward < len(table):
                found.append(f"nothing follows edge {edge} on loop {loop}")
                break
            turned = 0 if table[onward, START] == vertex else 1
            if table[onward, START + turned] != vertex:
                found.append(f"edge {onward} follows edge {edge} and does not begin where that ends")
                break
            if table[onward, LEFT_BEFORE + 2 * turned] != edge:
                found.append(f"edge {edge} is followed by {onward}, which has another one before it")
            edge, side, steps = onward, turned, steps + 1
            if (edge, side) == first:
                break
            if steps > 2 * len(table):
                found.append(f"loop {loop} does not end")
                break
    for edge in np.flatnonzero((table[:, LEFT] >= 0) | (table[:, RIGHT] >= 0)).tolist():
        for side in (0, 1):
            if table[edge, LEFT + side] >= 0 and (edge, side) not in loop_of_side:
                found.append(f"edge {edge} has a face that no loop of it runs along")
    for vertex in np.flatnonzero(mesh.vertex_edge >= 0).tolist():
        if vertex not in ends[mesh.vertex_edge[vertex]]:
            found.append(f"vertex {vertex} knows edge {mesh.vertex_edge[vertex]}, which does not end there")
    return found
