"""Which material each owner of a mesh has, and where bitmaps lie on it: of the node nearest to it on its way up."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..document.document import Document
from ..document.from_outlines import Revolve
from ..document.nodes import LinearArray, Mirror, Node, PolarArray
from ..document.placement import IDENTITY, product
from ..document.primitives import Box, Cone, Cylinder, Sphere, Torus
from .mapping import CAP, Floats, TextureMapping, projected, seamless
from .material import Material

if TYPE_CHECKING:
    from ..solid.display import DisplayMesh
    from ..solid.provenance import Occurrence
    from ..solid.results import OwnedFaces

Path = tuple[str | int, ...]


@dataclass(frozen=True, slots=True)
class Appearance:
    """`material` None: the program's own. `colour` is what is multiplied with the texture: the material's, else white
    under a texture, else that of the nearest coloured node; None where there is none.

    `kind` and `extent` as in `projected`; `frame` are the twelve numbers of the (3, 4) map from the solid's axes to the
    projection's.
    """

    material: Material | None
    colour: str | None
    mapping: TextureMapping
    kind: str
    extent: tuple[float, ...]
    frame: tuple[float, ...]

    @property
    def matrix(self) -> Floats:
        return np.array(self.frame).reshape(3, 4)


DEFAULT = Appearance(None, None, TextureMapping(), "box", (20.0, 20.0), tuple(IDENTITY.reshape(-1).tolist()))
"""Of what wears nothing."""


def appearances(document: Document, root: Node, owners: Sequence[Path]) -> tuple[Appearance, ...]:
    """Of each owner of a mesh of `root`, a solid of a resolved tree; `document` tells of materials."""
    from ..solid.provenance import occurrences

    by_path = {occurrence.path: occurrence for occurrence in occurrences(root)}
    materials = {material.name: material for material in document.materials}
    matrices: dict[Path, Floats] = {}
    return tuple(_appearance(by_path.get(path), materials, matrices) for path in owners)


def is_dressed(document: Document, root: Node) -> bool:
    """Whether a solid wears a material of the document anywhere; `root` may be one of the document itself."""
    from ..document.tree import walk

    names = {material.name for material in document.materials}
    return bool(names) and any(node.material in names for node in walk(root, *document.definitions))


def _appearance(
    occurrence: Occurrence | None, materials: dict[str, Material], matrices: dict[Path, Floats]
) -> Appearance:
    if occurrence is None:
        return DEFAULT
    nodes = occurrence.nodes
    worn = next((i for i in reversed(range(len(nodes))) if nodes[i].material in materials), -1)
    material = materials[str(nodes[worn].material)] if worn >= 0 else None
    tinted = next((i for i in reversed(range(len(nodes))) if nodes[i].colour), -1)
    colour = nodes[tinted].colour if tinted >= 0 else None
    if material is not None and (colour is None or tinted <= worn):
        colour = material.colour or ("#ffffff" if material.texture else colour)
    mapped = next((i for i in reversed(range(len(nodes))) if nodes[i].mapping is not None), -1)
    mapping = nodes[mapped].mapping if mapped >= 0 else None
    mapping = mapping or TextureMapping()
    natural = mapping.projection == "natural"
    kind, extent, shift = _natural(nodes[-1], mapping) if natural else (mapping.projection, mapping.size, None)
    matrix = occurrence.matrix if natural or mapped == len(nodes) - 1 else _matrix_at(occurrence, mapped, matrices)
    inverse = np.linalg.inv(np.vstack((matrix, (0, 0, 0, 1))))[:3] if abs(np.linalg.det(matrix[:, :3])) > 0 else matrix
    frame = product(mapping.frame(), inverse)
    if shift is not None:
        frame = frame + np.column_stack((np.zeros((3, 3)), shift))
    return Appearance(material, colour, mapping, kind, extent, tuple(frame.reshape(-1).tolist()))


def _natural(node: Node, mapping: TextureMapping) -> tuple[str, tuple[float, ...], Floats | None]:
    """Kind, extent, and what a point of the node's axes is moved by to be where the kind wants it."""
    values: dict[str, Any] = node.values()
    match node:
        case Box():
            size = tuple(float(n) for n in values["size"])
            return "faces", size, np.array(size) / 2.0 if values["centred"] else None
        case Sphere():
            return "spherical", (), None
        case Cylinder() | Cone():
            height = float(values["height"])
            radius = max(float(values["radius"]), float(values.get("top_radius", 0.0)))
            return "cylinder", (height, radius), np.array((0.0, 0.0, height / 2.0)) if values["centred"] else None
        case Torus():
            return "torus", (float(values["radius"]),), None
        case Revolve():
            return "cylindrical", mapping.size, None
    return "box", mapping.size, None


def _matrix_at(occurrence: Occurrence, place: int, matrices: dict[Path, Floats]) -> Floats:
    """(3, 4) from the axes of the node at this place of the way down to the world's."""
    from ..solid.copies import copies

    steps = iter(occurrence.path[1:])
    path: Path = occurrence.path[:1]
    matrix = matrices.get(path)
    nodes = occurrence.nodes
    if matrix is None:
        matrix = matrices[path] = nodes[0].placement.matrix()
    for above, node in pairwise(nodes[: place + 1]):
        number = 0
        if isinstance(above, LinearArray | PolarArray | Mirror):
            number = int(next(steps))
            path = (*path, number)
        path = (*path, str(next(steps)))
        known = matrices.get(path)
        if known is None:
            known = product(product(matrix, copies(above)[number]), node.placement.matrix())
            matrices[path] = known
        matrix = known
    return matrix


def coordinates(mesh: DisplayMesh | OwnedFaces, looks: Sequence[Appearance]) -> Floats:
    """(t, 3, 2) texture coordinates at the corners of the triangles of a mesh whose owners look so.

    Triangles that a seam runs through go on beyond 1 instead of back.
    """
    result = np.zeros((len(mesh.corners), 3, 2))
    for rows, look in _by_look(mesh.owner, looks):
        result[rows] = coordinates_on(mesh.vertices[mesh.corners[rows]], look)
    return result


def coordinates_on(corners: Floats, look: Appearance) -> Floats:
    """(t, 3, 2) texture coordinates of triangles by their corners (t, 3, 3) in the solid's axes."""
    matrix = look.matrix
    points = corners @ matrix[:, :3].T + matrix[:, 3]
    normals = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])
    size = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = normals / np.where(size > 0.0, size, 1.0)
    if np.linalg.det(matrix[:, :3]) < 0.0:  # a mirrored solid's faces wind the other way in the node's own axes
        normals = -normals
    st = projected(look.kind, look.extent, points.reshape(-1, 3), np.repeat(normals, 3, axis=0)).reshape(-1, 3, 2)
    if look.kind in ("cylindrical", "spherical", "cylinder", "torus"):
        round_ = np.abs(normals[:, 2]) <= CAP if look.kind == "cylinder" else np.ones(len(st), bool)
        st[round_] = _around(st[round_], points[round_])
        if look.kind == "torus":
            st = seamless(st[..., ::-1])[..., ::-1]
    return look.mapping.finished(st.reshape(-1, 2)).reshape(-1, 3, 2)


def _around(st: Floats, points: Floats) -> Floats:
    """Coordinates (t, 3, 2) around the z axis without jumps; corners on the axis, where every angle is as good, take
    the middle of the other two's."""
    across = np.hypot(points[..., 0], points[..., 1])
    pole = across < 1e-9 * (1.0 + np.abs(points).max(axis=(1, 2))[:, None])
    rows = np.flatnonzero(pole.sum(axis=1) == 1)
    at = pole[rows].argmax(axis=1)
    one, other = (at + 1) % 3, (at + 2) % 3
    st = st.copy()
    st[rows, at, 0] = st[rows, one, 0]
    st = seamless(st)
    st[rows, at, 0] = (st[rows, one, 0] + st[rows, other, 0]) / 2.0
    return st


def _by_look(owner: NDArray[np.int32], looks: Sequence[Appearance]) -> Iterable[tuple[NDArray[np.intp], Appearance]]:
    """Rows of each different look; owners beyond the looks are left out."""
    numbers: dict[Appearance, int] = {}
    number_of = np.array([numbers.setdefault(look, len(numbers)) for look in looks] or [0])
    known = (owner >= 0) & (owner < len(looks))
    number = np.where(known, number_of[np.where(known, owner, 0)], -1)
    for look, i in numbers.items():
        rows = np.flatnonzero(number == i)
        if len(rows):
            yield rows, look
