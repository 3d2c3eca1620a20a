"""What the Mesh panel says of a mesh and of one of its elements."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from ...model.mesh.inspected import InspectedMesh
from ...model.mesh.selecting import Kind
from ...model.mesh.winged import END, LEFT, RIGHT, START
from ..status import figure

MINUS = "\u2212"


def count_words(mesh: InspectedMesh) -> str:
    """The counts of a mesh, as rich text."""
    found = mesh.topology
    words = (
        f"<b>{found.vertices:,}</b> vertices, <b>{found.edges:,}</b> edges, "
        f"<b>{found.faces:,}</b> {'faces' if mesh.polygons else 'triangles'}"
    )
    holes = found.loops - found.faces
    words += f", <b>{found.loops:,}</b> loops" if holes else ""
    bare = len(mesh.lists.vertices) - found.vertices
    words += f"; {bare:,} vertices without an edge" if bare else ""
    return words


def euler_words(mesh: InspectedMesh) -> str:
    """The Euler-Poincaré formula with the mesh's numbers, or what keeps it from holding."""
    found = mesh.topology
    vertices = found.vertices + found.fans
    left = (
        f"V {MINUS} E + F {MINUS} (L {MINUS} F) = {vertices:,} {MINUS} {found.edges:,} + {found.faces:,} {MINUS} "
        f"({found.loops:,} {MINUS} {found.faces:,}) = {_signed(found.euler)}"
    )
    pieces = _count(found.components, "component")
    if found.genus is not None:
        words = f"{left} = 2 (C {MINUS} G): {pieces}, genus {found.genus:,}."
    else:
        words = f"{left}; {pieces}, {_count(found.borders, 'border')} of {_count(found.border_edges, 'naked edge')}"
        words += f", {found.repeated:,} non-manifold edges." if found.repeated else "."
        words += " It encloses no volume, so the genus stays open."
    if found.fans:
        words += f" V counts {_count(found.fans, 'vertex', 'vertices')} more where surfaces meet in a point only."
    return words


def element_words(mesh: InspectedMesh, labels: Sequence[str], kind: Kind, element: int, first: int) -> str:
    """One vertex, edge or face, as rich text."""
    if kind == "vertex":
        x, y, z = (_figure(value) for value in mesh.lists.vertices[element].tolist())
        edges = int(mesh.degree[element])
        return f"<b>Vertex {element + first:,}</b> at ({x}, {y}, {z}) mm, {_count(edges, 'edge')}."
    if kind == "edge":
        return _edge_words(mesh, element, first)
    maker = _maker(mesh, labels, element)
    loops = len(mesh.lists.face(element))
    holes = f" with {_count(loops - 1, 'hole')}" if loops > 1 else ""
    corners = sum(len(loop) for loop in mesh.lists.face(element))
    x, y, z = (_figure(value) for value in mesh.face_normals[element].tolist())
    normal = int(mesh.lists.face_normal[element]) + first
    area = _figure(float(mesh.area[element]))
    return (
        f"<b>Face {element + first:,}</b>{maker}: {corners:,} corners{holes}, {area} mm², "
        f"normal {normal:,} ({x}, {y}, {z})."
    )


def _edge_words(mesh: InspectedMesh, edge: int, first: int) -> str:
    row = mesh.winged.table[edge]
    start, end = int(row[START]) + first, int(row[END]) + first
    kind = str(mesh.edge_kind[edge])
    turn = f", {_figure(abs(float(mesh.bend[edge])), 4)}° {kind}" if kind in ("convex", "concave") else f", {kind}"
    left, right = int(row[LEFT]), int(row[RIGHT])
    faces = " and ".join(f"{face + first:,}" if face >= 0 else "none" for face in (left, right))
    return (
        f"<b>Edge {edge + first:,}</b> from vertex {start:,} to {end:,}, {_figure(float(mesh.length[edge]))} mm{turn}; "
        f"left and right faces {faces}."
    )


def _maker(mesh: InspectedMesh, labels: Sequence[str], face: int) -> str:
    maker = int(mesh.maker[face])
    return f" of “{escape(labels[maker])}”" if maker >= 0 else ""


def _count(number: int, one: str, more: str = "") -> str:
    return f"{number:,} {one if number == 1 else more or one + 's'}"


def _signed(number: int) -> str:
    return f"{number:,}".replace("-", MINUS)


def _figure(value: float, digits: int = 6) -> str:
    return figure(round(value, 9) + 0.0, digits).replace("-", MINUS)
