"""GLB written: metres and y up, as the standard has it; names, and colours or materials with their
bitmaps."""

from __future__ import annotations

import json
import struct
from collections.abc import Sequence
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from ..document.colours import rgb
from ..document.errors import Refusal
from .dress import Coat, Piece, is_translucent, normal_map, pieces_of, texture_file
from .gltf import METRE, UP
from .solids import OutSolid


def write_glb(stream: BinaryIO, solids: Sequence[OutSolid]) -> None:
    """Each solid as a node with its name, and its colour or what its faces wear as materials, with their bitmaps. GLB
    knows single precision only."""
    materials = Materials()
    data = Data()
    meshes: list[dict[str, Any]] = []
    for solid in solids:
        if solid.dress is None:
            number = materials.of_colour(solid.colour) if solid.colour else None
            primitives = [data.primitive(solid.vertices, solid.triangles, None, number)]
        else:
            primitives = [
                data.primitive(
                    piece.points,
                    piece.triangles,
                    None if piece.coat is None else piece.coordinates,
                    materials.of_piece(piece, solid.colour, data),
                )
                for piece in pieces_of(solid.vertices, solid.triangles, solid.dress)
            ]
        meshes.append({"name": solid.name, "primitives": primitives})
    content: dict[str, Any] = {
        "asset": {"version": "2.0", "generator": "Solidtree"},
        "scene": 0,
        "scenes": [{"nodes": list(range(len(solids)))}],
        "nodes": [{"name": solid.name, "mesh": i} for i, solid in enumerate(solids)],
        "meshes": meshes,
        "accessors": data.accessors,
        "bufferViews": data.views,
        "buffers": [{"byteLength": data.size}],
    }
    content |= materials.tables()
    text = json.dumps(content, ensure_ascii=False, separators=(",", ":")).encode("utf-8", "replace")
    text += b" " * (-len(text) % 4)
    if 28 + len(text) + data.size >= 1 << 32:
        raise Refusal("GLB holds at most 4 GB; write a 3MF")
    stream.write(
        struct.pack("<4sII", b"glTF", 2, 28 + len(text) + data.size) + struct.pack("<I4s", len(text), b"JSON") + text
    )
    stream.write(struct.pack("<I4s", data.size, b"BIN\0"))
    stream.writelines(data.pieces)


class Data:
    """The binary part of a file: pieces one behind the other, and the tables that tell where they are."""

    def __init__(self) -> None:
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []
        self.pieces: list[bytes] = []
        self.size = 0

    def view(self, data: bytes, **more: Any) -> int:
        """The number of a new view of these bytes."""
        self.views.append({"buffer": 0, "byteOffset": self.size, "byteLength": len(data), **more})
        data += bytes(-len(data) % 4)
        self.pieces.append(data)
        self.size += len(data)
        return len(self.views) - 1

    def accessor(self, values: NDArray[Any], target: int, **more: Any) -> int:
        self.accessors.append({"bufferView": self.view(values.tobytes(), target=target), **more})
        return len(self.accessors) - 1

    def primitive(
        self, points: NDArray[Any], triangles: NDArray[Any], coordinates: NDArray[Any] | None, material: int | None
    ) -> dict[str, Any]:
        """Triangles (t, 3) over points (p, 3) in millimetres, with texture coordinates (p, 2), v upwards."""
        places = (points @ UP / METRE + 0.0).astype("<f4")
        low, high = places.min(axis=0).tolist(), places.max(axis=0).tolist()
        attributes = {
            "POSITION": self.accessor(
                places, 34962, componentType=5126, count=len(places), type="VEC3", min=low, max=high
            )
        }
        indices = self.accessor(triangles.astype("<u4"), 34963, componentType=5125, count=triangles.size, type="SCALAR")
        if coordinates is not None:
            down = (coordinates * (1.0, -1.0) + (0.0, 1.0)).astype("<f4")
            attributes["TEXCOORD_0"] = self.accessor(down, 34962, componentType=5126, count=len(down), type="VEC2")
        primitive: dict[str, Any] = {"attributes": attributes, "indices": indices}
        if material is not None:
            primitive["material"] = material
        return primitive


class Materials:
    """The materials of a file, each once, and their textures, images and samplers."""

    def __init__(self) -> None:
        self._rows: dict[Any, int] = {}
        self._materials: list[dict[str, Any]] = []
        self._textures: list[dict[str, Any]] = []
        self._images: list[dict[str, Any]] = []
        self._image_of: dict[bytes, int] = {}
        self._samplers: list[dict[str, Any]] = []

    def tables(self) -> dict[str, Any]:
        tables = {"materials": self._materials, "textures": self._textures, "images": self._images,
                  "samplers": self._samplers}  # fmt: skip
        return {name: rows for name, rows in tables.items() if rows}

    def of_colour(self, colour: str) -> int:
        if colour not in self._rows:
            self._rows[colour] = len(self._materials)
            self._materials.append(
                {
                    "name": colour,
                    "pbrMetallicRoughness": {
                        "baseColorFactor": [*_to_linear(np.array(rgb(colour)) / 255).tolist(), 1.0],
                        "metallicFactor": 0.0,
                        "roughnessFactor": 0.8,
                    },
                }
            )
        return self._rows[colour]

    def of_piece(self, piece: Piece, colour: str | None, data: Data) -> int | None:
        """The number of the material of a piece; `colour` is the solid's."""
        coat = piece.coat
        if coat is None:
            return self.of_colour(colour) if colour else None
        right, up = piece.copy if coat.material.bump else (0.0, 0.0)
        copy = (round(right, 6), round(up, 6))
        key = (coat, copy)
        if key not in self._rows:
            self._rows[key] = len(self._materials)
            self._materials.append(self._made(coat, copy, data))
        return self._rows[key]

    def _made(self, coat: Coat, copy: tuple[float, float], data: Data) -> dict[str, Any]:
        """Roughness such that the highlight is as wide: GGX's alpha of Blinn's exponent (Karis 2013), its root."""
        material = coat.material
        base = _to_linear(np.array(rgb(coat.colour or "#ffffff")) / 255).tolist()
        surface: dict[str, Any] = {
            "baseColorFactor": [*base, material.opacity],
            "metallicFactor": 0.0,
            "roughnessFactor": round((2.0 / (material.shininess + 2.0)) ** 0.25, 6) if material.specular else 1.0,
        }
        row: dict[str, Any] = {"name": material.name, "pbrMetallicRoughness": surface}
        if material.texture:
            surface["baseColorTexture"] = {"index": self._texture(*texture_file(coat), material.wrap, data)}
        if material.bump:
            row["normalTexture"] = {"index": self._texture(normal_map(material, copy), "png", material.wrap, data)}
        if is_translucent(coat):
            row["alphaMode"] = "BLEND"
        return row

    def _texture(self, image: bytes, kind: str, wrap: str, data: Data) -> int:
        if image not in self._image_of:
            self._image_of[image] = len(self._images)
            self._images.append({"bufferView": data.view(image), "mimeType": f"image/{kind}"})
        mode = {"repeat": 10497, "mirror": 33648, "clamp": 33071}[wrap]
        sampler = {"magFilter": 9729, "minFilter": 9987, "wrapS": mode, "wrapT": mode}
        if sampler not in self._samplers:
            self._samplers.append(sampler)
        texture = {"sampler": self._samplers.index(sampler), "source": self._image_of[image]}
        if texture not in self._textures:
            self._textures.append(texture)
        return self._textures.index(texture)


def _to_linear(srgb: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
