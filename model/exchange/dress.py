"""What the faces of exported solids wear: materials, and texture coordinates with their seams split."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from io import BytesIO
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..document.document import Document
from ..document.errors import Refusal
from ..surface.appearance import appearances, coordinates
from ..surface.bitmaps import keyed, luminance, slopes_of, texels_of
from ..surface.material import Material

if TYPE_CHECKING:
    from ..document.nodes import Node
    from ..solid.display import DisplayMesh

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Coat:
    """A material and the colour that it has on some faces (None: none)."""

    material: Material
    colour: str | None


@dataclass(frozen=True, slots=True, eq=False)
class Dress:
    """Of one solid: its coats, the coat of each triangle (t,), -1 where it wears none, and the texture coordinates
    (t, 3, 2) of its corners."""

    coats: tuple[Coat, ...]
    coat: NDArray[np.intp]
    coordinates: Floats


@dataclass(frozen=True, slots=True, eq=False)
class Piece:
    """The triangles (t, 3) of one coat (None: bare) over their own points (p, 3) with coordinates (p, 2)."""

    coat: Coat | None
    points: Floats
    coordinates: Floats
    triangles: NDArray[np.int64]

    @property
    def copy(self) -> float:
        """Millimetres along a copy of the bitmap, in the mean over the faces."""
        corners, flat = self.points[self.triangles], self.coordinates[self.triangles]
        solid = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum()
        one, other = flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0]
        drawn = np.abs(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]).sum()
        return float(np.sqrt(solid / drawn)) if drawn > 0.0 else 1.0


def dress_of(document: Document, root: Node, mesh: DisplayMesh) -> Dress | None:
    """What a solid of a resolved tree wears; None where no face wears a material."""
    looks = appearances(document, root, mesh.owners)
    coats: dict[Coat, int] = {}
    numbers = [-1 if look.material is None else coats.setdefault(Coat(look.material, look.colour), len(coats))
               for look in looks]  # fmt: skip
    if not coats:
        return None
    coat = np.where(mesh.owner >= 0, np.array(numbers)[mesh.owner], -1)
    return Dress(tuple(coats), coat, coordinates(mesh, looks))


def pieces_of(vertices: Floats, triangles: NDArray, dress: Dress) -> Iterator[Piece]:
    """The faces of a solid by coat; points that have two coordinates are there twice."""
    for number in np.unique(dress.coat).tolist():
        rows = np.flatnonzero(dress.coat == number)
        corner = np.asarray(triangles)[rows].astype(np.int64).reshape(-1)
        flat = dress.coordinates[rows].reshape(-1, 2)
        same = np.round(flat * 2.0**24).astype(np.int64)
        order = np.lexsort((same[:, 1], same[:, 0], corner))
        keys = np.column_stack((corner, same))[order]
        first = np.concatenate(([True], (np.diff(keys, axis=0) != 0).any(axis=1)))
        place = np.empty(len(corner), np.int64)
        place[order] = np.cumsum(first) - 1
        kept = order[first]
        coat = dress.coats[number] if number >= 0 else None
        yield Piece(coat, vertices[corner[kept]], flat[kept], place.reshape(-1, 3))


def texture_file(coat: Coat) -> tuple[bytes, str]:
    """The texture of a coat as the bytes of a file and "png" or "jpeg": the file that came, where other programs read
    it. Raises Refusal."""
    from ..project.assets import default_store

    data = default_store().read(coat.material.texture)
    if coat.material.key is None:
        if data.startswith(b"\x89PNG\r\n"):
            return data, "png"
        if data.startswith(b"\xff\xd8\xff"):
            return data, "jpeg"
    return png_of(keyed(texels_of(coat.material.texture), coat.material.key)), "png"


def normal_map(material: Material, copy: float) -> bytes:
    """A PNG of the normals of a bump map whose copies are `copy` mm wide and high. Raises Refusal."""
    unit = copy if material.bump_kind == "heights" else 1.0
    slopes = slopes_of(texels_of(material.bump), material.bump_kind, material.bump_height, material.wrap != "clamp")
    normals = np.dstack((-slopes.astype(np.float64) / unit, np.ones(slopes.shape[:2])))
    normals /= np.linalg.norm(normals, axis=2, keepdims=True)
    return png_of(np.clip(np.rint((normals + 1.0) * 127.5), 0, 255).astype(np.uint8))


def height_map(material: Material) -> bytes:
    """A PNG of the heights of a bump map in grey. Raises Refusal."""
    grey = np.rint(255.0 * luminance(texels_of(material.bump))).astype(np.uint8)
    return png_of(np.dstack((grey, grey, grey)))


def is_translucent(coat: Coat) -> bool:
    """Whether light comes through it. Raises Refusal where its bitmap cannot be read."""
    material = coat.material
    if material.opacity < 1.0:
        return True
    has_alpha = material.texture and bool((texels_of(material.texture)[..., 3] < 255).any())
    return bool(has_alpha) or (bool(material.texture) and material.key is not None)


def check_bitmaps(dress: Dress) -> None:
    """Raises Refusal that names the material whose bitmap is missing or cannot be read."""
    for coat in dress.coats:
        for sha in (coat.material.texture, coat.material.bump):
            try:
                if sha:
                    texels_of(sha)
            except Refusal as refusal:
                raise Refusal(f"the material “{coat.material.name}”: {refusal}") from None


def png_of(texels: NDArray[np.uint8]) -> bytes:
    """A PNG file of texels (height, width, 3 or 4), rows from the top down."""
    from PIL import Image

    out = BytesIO()
    Image.fromarray(np.ascontiguousarray(texels)).save(out, "PNG")
    return out.getvalue()
