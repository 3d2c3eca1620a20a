"""What the view of texture coordinates shows: triangles of a choice of nodes, by the material that they wear."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ...model.document.errors import Refusal
from ...model.surface.appearance import appearances, coordinates
from ...model.surface.bitmaps import keyed, texels_of
from ...model.surface.material import Material
from ...model.surface.unwrapped import Unwrapped, unwrapped
from ..view.occurrences import maker_of

if TYPE_CHECKING:
    from ...model.document.document import Document
    from ...model.document.nodes import Node
    from ...model.solid.display import DisplayMesh

Path = tuple[str | int, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Sheet:
    """Triangles (t, 3, 2) on the bitmap of one material (None: without); `owner` (t,) are places in `paths`.
    `texels` (height, width, 4) is None where there is no bitmap."""

    material: Material | None
    coordinates: NDArray[np.float64]
    owner: NDArray[np.int64]
    paths: tuple[Path, ...]
    texels: NDArray[np.uint8] | None
    facts: Unwrapped

    @property
    def name(self) -> str:
        return "without a material" if self.material is None else self.material.name

    @property
    def wrap(self) -> str:
        return "repeat" if self.material is None else self.material.wrap

    def node(self, triangle: int) -> str:
        """The id of the node that made a triangle."""
        return maker_of(self.paths[int(self.owner[triangle])])


def sheets_of(
    document: Document, resolved: Mapping[str, Node], meshes: Mapping[str, DisplayMesh], ids: tuple[str, ...]
) -> list[Sheet]:
    """The triangles that the nodes `ids` made, or all where there are none; those with bitmaps first."""
    found: dict[Material | None, list[Any]] = {}
    paths: list[Path] = []
    wanted = set(ids)
    for root_id, mesh in meshes.items():
        root = resolved.get(root_id)
        if root is None or mesh.sheet or not len(mesh.triangles):
            continue
        looks = appearances(document, root, mesh.owners)
        mine = np.array([not wanted or bool(wanted.intersection(path)) for path in mesh.owners], bool)
        if not mine.any():
            continue
        flat, corners = coordinates(mesh, looks), mesh.vertices[mesh.corners]
        first = len(paths)
        paths += mesh.owners
        for material in dict.fromkeys(look.material for look in looks):
            wears = np.array([look.material == material for look in looks], bool) & mine
            rows = np.flatnonzero(wears[mesh.owner])
            if len(rows):
                found.setdefault(material, []).append((flat[rows], corners[rows], mesh.owner[rows] + first))
    sheets = [_sheet(material, parts, tuple(paths)) for material, parts in found.items()]
    return sorted(sheets, key=lambda sheet: (sheet.texels is None, -len(sheet.coordinates)))


def _sheet(material: Material | None, parts: list[Any], paths: tuple[Path, ...]) -> Sheet:
    flat, corners, owner = (np.concatenate(columns) for columns in zip(*parts, strict=True))
    texels = None
    sha = "" if material is None else material.texture or material.bump or material.light_map
    if material is not None and sha:
        try:
            texels = keyed(texels_of(sha), material.key) if material.texture else texels_of(sha)
        except Refusal:
            texels = None
    size = None if texels is None else (texels.shape[1], texels.shape[0])
    facts = unwrapped(flat, corners, size, "repeat" if material is None else material.wrap)
    return Sheet(material, flat, owner.astype(np.int64), paths, texels, facts)


def words_of(sheet: Sheet) -> str:
    """The figures of a sheet in a sentence or two."""
    facts = sheet.facts
    count = f"{facts.count:,} triangle{'s' * (facts.count != 1)}"
    if sheet.texels is None:
        return f"{count}, no bitmap" + _odd(facts)
    height, width = sheet.texels.shape[:2]
    words = f"{count} on {width} \u00d7 {height} texels; {100.0 * facts.used:.1f} % of the bitmap is used"
    if facts.density is not None:
        least, mean, most = facts.density
        even = most - least < 1e-3 * most
        words += f"; {mean:.2f} texels a mm" + ("" if even else f" in the mean, {least:.2f} to {most:.2f}")
    return words + _odd(facts)


def _odd(facts: Unwrapped) -> str:
    mirrored, flat = int(facts.mirrored.sum()), int(facts.flat.sum())
    found = [f"{mirrored:,} mirrored" if mirrored else "", f"{flat:,} flat on it" if flat else ""]
    words = " and ".join(filter(None, found))
    return f"; {words}." if words else "."
