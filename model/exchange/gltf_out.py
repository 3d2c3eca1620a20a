"""GLB written: metres and y up, as the standard has it; names, and colours as materials."""

from __future__ import annotations

import json
import struct
from collections.abc import Sequence
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from ..document.colours import rgb
from ..document.errors import Refusal
from .gltf import METRE, UP
from .solids import OutSolid


def write_glb(stream: BinaryIO, solids: Sequence[OutSolid]) -> None:
    """Each solid as a node with its name and its colour as a material. GLB knows single precision only."""
    colours = list(dict.fromkeys(solid.colour for solid in solids if solid.colour))
    views: list[dict[str, Any]] = []
    accessors: list[dict[str, Any]] = []
    meshes: list[dict[str, Any]] = []
    pieces: list[bytes] = []
    place = 0

    def add(data: bytes, target: int, **more: Any) -> None:
        nonlocal place
        accessors.append({"bufferView": len(views), **more})
        views.append({"buffer": 0, "byteOffset": place, "byteLength": len(data), "target": target})
        pieces.append(data)
        place += len(data)

    for solid in solids:
        points = (solid.vertices @ UP / METRE + 0.0).astype("<f4")
        low, high = points.min(axis=0).tolist(), points.max(axis=0).tolist()
        add(points.tobytes(), 34962, componentType=5126, count=len(points), type="VEC3", min=low, max=high)
        add(
            solid.triangles.astype("<u4").tobytes(),
            34963,
            componentType=5125,
            count=solid.triangles.size,
            type="SCALAR",
        )
        primitive: dict[str, Any] = {"attributes": {"POSITION": len(accessors) - 2}, "indices": len(accessors) - 1}
        if solid.colour:
            primitive["material"] = colours.index(solid.colour)
        meshes.append({"name": solid.name, "primitives": [primitive]})
    content: dict[str, Any] = {
        "asset": {"version": "2.0", "generator": "Solidtree"},
        "scene": 0,
        "scenes": [{"nodes": list(range(len(solids)))}],
        "nodes": [{"name": solid.name, "mesh": i} for i, solid in enumerate(solids)],
        "meshes": meshes,
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": place}],
    }
    if colours:
        content["materials"] = [_material(colour) for colour in colours]
    text = json.dumps(content, ensure_ascii=False, separators=(",", ":")).encode("utf-8", "replace")
    text += b" " * (-len(text) % 4)
    if 28 + len(text) + place >= 1 << 32:
        raise Refusal("GLB holds at most 4 GB; write a 3MF")
    stream.write(
        struct.pack("<4sII", b"glTF", 2, 28 + len(text) + place) + struct.pack("<I4s", len(text), b"JSON") + text
    )
    stream.write(struct.pack("<I4s", place, b"BIN\0"))
    stream.writelines(pieces)


def _material(colour: str) -> dict[str, Any]:
    linear = [*_to_linear(np.array(rgb(colour)) / 255).tolist(), 1.0]
    return {
        "name": colour,
        "pbrMetallicRoughness": {"baseColorFactor": linear, "metallicFactor": 0.0, "roughnessFactor": 0.8},
    }


def _to_linear(srgb: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
