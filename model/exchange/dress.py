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
    from ..solid.results import OwnedFaces

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
    """The triangles (t, 3) of one coat (None: bare) over their own points (p, 3), which are the solid's vertices
    `vertex` (p,), with coordinates (p, 2)."""

    coat: Coat | None
    points: Floats
    vertex: NDArray[np.int64]
    coordinates: Floats
    triangles: NDArray[np.int64]

    @property
    def copy(self) -> tuple[float, float]:
        """Millimetres along a copy of the bitmap to the right and upwards, in the mean over the faces."""
        corners, flat = self.points[self.triangles], self.coordinates[self.triangles]
        first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        (a, b), (c, d) = (flat[:, 1] - flat[:, 0]).T, (flat[:, 2] - flat[:, 0]).T
        turned = a * d - b * c
        lies = np.abs(turned) > 1e-12
        if not lies.any():
            return 1.0, 1.0
        first, second, a, b, c, d, turned = (values[lies] for values in (first, second, a, b, c, d, turned))
        area = np.linalg.norm(np.cross(first, second), axis=1)
        right = np.linalg.norm(first * d[:, None] - second * b[:, None], axis=1) / np.abs(turned)
        up = np.linalg.norm(second * a[:, None] - first * c[:, None], axis=1) / np.abs(turned)
        weight = area / area.sum() if area.sum() > 0.0 else np.full(len(area), 1.0 / len(area))
        return float(right @ weight), float(up @ weight)


def dress_of(document: Document, root: Node, faces: OwnedFaces) -> Dress | None:
    """What a solid of a resolved tree wears; None where no face wears a material."""
    looks = appearances(document, root, faces.owners)
    coats: dict[Coat, int] = {}
    numbers = [-1 if look.material is None else coats.setdefault(Coat(look.material, look.colour), len(coats))
               for look in looks]  # fmt: skip
    if not coats:
        return None
    coat = np.where(faces.owner >= 0, np.array(numbers)[faces.owner], -1)
    return Dress(tuple(coats), coat, coordinates(faces, looks))


def pieces_of(vertices: Floats, triangles: NDArray, dress: Dress) -> Iterator[Piece]:
    """The faces of a solid by coat, bare ones first; points that have two coordinates are there twice."""
    for number in np.unique(dress.coat).tolist():
        rows = np.flatnonzero(dress.coat == number)
        corner = np.asarray(triangles)[rows].astype(np.int64).reshape(-1)
        flat = dress.coordinates[rows].reshape(-1, 2)
        kept, place = _points_of(corner, flat, len(vertices))
        coat = dress.coats[number] if number >= 0 else None
        yield Piece(coat, vertices[corner[kept]], corner[kept], flat[kept], place.reshape(-1, 3))


def _points_of(corner: NDArray[np.int64], flat: Floats, count: int) -> tuple[NDArray[np.intp], NDArray[np.int64]]:
    """Corners, by number, that stand for all of their vertex and coordinates, and for each corner the place of the one
    that stands for it. Most vertices have the same coordinates everywhere: only the others are sorted."""
    leader = np.empty(count, np.int64)
    leader[corner[::-1]] = np.arange(len(corner))[::-1]
    leads = leader[corner]
    same = np.rint(flat * 2.0**24).astype(np.int64)
    apart = np.flatnonzero((np.abs(same - same[leads]) > 1).any(axis=1))
    first = leads == np.arange(len(corner))
    leader_place = np.cumsum(first) - 1
    place = leader_place[leads]
    if not len(apart):
        return np.flatnonzero(first), place
    order = np.lexsort((same[apart, 1], same[apart, 0], corner[apart]))
    keys = np.column_stack((corner[apart], same[apart]))[order]
    new = np.concatenate(([True], (np.diff(keys, axis=0) != 0).any(axis=1)))
    place[apart[order]] = int(first.sum()) + np.cumsum(new) - 1
    return np.concatenate((np.flatnonzero(first), apart[order[new]])), place


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


def normal_map(material: Material, copy: tuple[float, float]) -> bytes:
    """A PNG of the normals of a bump map whose copies are `copy` mm wide and high. Raises Refusal."""
    unit = copy if material.bump_kind == "heights" else (1.0, 1.0)
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
