"""glTF 2.0, binary (GLB) or JSON with its data inside: nodes with names, places and colours.

The standard's unit is the metre and its y points up; parts are turned to millimetres and z up, and back on writing.
"""

from __future__ import annotations

import base64
import binascii
import json
import struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..document.errors import Refusal
from ..document.placement import IDENTITY, product
from .parts import MAX_PARTS, Part, check_parts, check_total, fan, make_part, placed

METRE = 1000.0
UP = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])  # (x, y, z) with y up to (x, -z, y) with z up
_COMPONENTS = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
_READ = (
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "EXT_mesh_manifold",
    "KHR_materials_",
    "EXT_texture_",
    "KHR_lights_",
)


def read_gltf(data: bytes) -> list[Part]:
    """A part for each node of the scene that has triangles. Raises Refusal."""
    try:
        return _File(data).parts()
    except (KeyError, IndexError, TypeError, ValueError, AttributeError, OverflowError, RecursionError):
        raise Refusal("is damaged: its JSON does not have the form of glTF 2.0") from None


class _File:
    def __init__(self, data: bytes) -> None:
        self.binary: bytes | None = None
        text = self._chunks(data) if data[:4] == b"glTF" else data
        try:
            self.json: dict[str, Any] = json.loads(text.decode("utf-8"))
        except UnicodeDecodeError as error:
            raise Refusal(f"is damaged: byte {error.start} of its JSON is not UTF-8") from None
        except json.JSONDecodeError as error:
            what = error.msg.split(" (")[0].lower()
            raise Refusal(f"is damaged: its JSON, line {error.lineno}, column {error.colno}: {what}") from None
        if not isinstance(self.json, dict) or not str(self.json.get("asset", {}).get("version", "")).startswith("2."):
            raise Refusal("is no glTF 2.0 file; save it again in this version")
        for name in self.json.get("extensionsRequired", []):
            if not str(name).startswith(_READ):
                raise Refusal(f"needs the extension {str(name)[:60]}, which is not read; save it without compression")
        self.buffers: dict[int, bytes] = {}

    def _chunks(self, data: bytes) -> bytes:
        if len(data) < 20:
            raise Refusal(f"is cut short: a GLB file has at least 20 bytes, this one has {len(data)}")
        _, version, length = struct.unpack_from("<4sII", data)
        if version != 2:
            raise Refusal(f"is a GLB file of version {version}; only version 2 is read")
        if length > len(data):
            raise Refusal(f"is cut short: it should have {length:,} bytes and has {len(data):,}")
        text, place = None, 12
        while place + 8 <= length:
            size, kind = struct.unpack_from("<I4s", data, place)
            if place + 8 + size > length:
                raise Refusal(
                    f"is damaged: the chunk at byte {place} should have {size:,} bytes, but the file ends before"
                )
            chunk = data[place + 8 : place + 8 + size]
            if text is None:
                if kind != b"JSON":
                    raise Refusal("is damaged: the first chunk of this GLB file is not JSON")
                text = chunk
            elif kind == b"BIN\0" and self.binary is None:
                self.binary = chunk
            place += 8 + size
        if text is None:
            raise Refusal("is damaged: this GLB file has no JSON")
        return text

    def parts(self) -> list[Part]:
        nodes = self.json.get("nodes", [])
        scenes = self.json.get("scenes", [])
        below = {child for node in nodes for child in node.get("children", [])}
        if scenes:
            roots = scenes[self.json.get("scene", 0)].get("nodes", [])
        else:
            roots = [i for i in range(len(nodes)) if i not in below]
        stack: list[tuple[int, NDArray[np.float64]]] = [(root, IDENTITY) for root in reversed(roots)]
        seen: set[int] = set()
        parts: list[Part] = []
        total = 0
        while stack:
            index, matrix = stack.pop()
            if type(index) is not int or not 0 <= index < len(nodes):
                raise Refusal(f"is damaged: there is no node {str(index)[:20]}")
            if index in seen:
                raise Refusal(f"is damaged: node {index} has two places, or goes in a circle")
            seen.add(index)
            node = nodes[index]
            matrix = product(matrix, _placement(node))
            if "mesh" in node:
                part = self._part(node, matrix)
                total += len(part.triangles) if part else 0
                check_total(total)
                parts += [part] if part else []
                check_parts(len(parts))
            stack += [(child, matrix) for child in reversed(node.get("children", []))]
        return parts

    def _part(self, node: dict[str, Any], matrix: NDArray[np.float64]) -> Part | None:
        mesh = _item(self.json.get("meshes", []), node["mesh"], "mesh")
        name = str(node.get("name") or mesh.get("name") or "")
        vertices, triangles, colours, count = [], [], set(), 0
        for primitive in mesh.get("primitives", [])[:MAX_PARTS]:
            mode = primitive.get("mode", 4)
            if mode not in (4, 5, 6):
                continue  # points and lines
            if (
                "KHR_draco_mesh_compression" in primitive.get("extensions", {})
                and "POSITION" not in primitive["attributes"]
            ):
                raise Refusal(f"“{name}” is compressed by Draco, which is not read; save it without compression")
            points = self._accessor(primitive["attributes"]["POSITION"], 3).astype(np.float64)
            if "indices" in primitive:
                order = self._accessor(primitive["indices"], 1).ravel().astype(np.int64)
            else:
                order = np.arange(len(points))
            if len(order) and order.max() >= len(points):
                raise Refusal(f"“{name}” asks for vertex {order.max()} of {len(points):,}, counted from 0")
            triangles.append(_triangles(order, mode) + count)
            vertices.append(points)
            colours.add(self._colour(primitive))
            count += len(points)
        if not count or not any(len(piece) for piece in triangles):
            return None
        corners = np.concatenate(triangles)
        if np.linalg.det(matrix[:, :3]) < 0:
            corners = corners[:, ::-1]  # the standard says so: section 3.7.2.1
        upright = placed(np.concatenate(vertices), matrix) @ UP.T
        return make_part(name, colours.pop() if len(colours) == 1 else None, upright, corners, unit=METRE)

    def _colour(self, primitive: dict[str, Any]) -> str | None:
        if "material" not in primitive:
            return None
        material = _item(self.json.get("materials", []), primitive["material"], "material")
        factor = material.get("pbrMetallicRoughness", {}).get("baseColorFactor")
        if factor is None:
            return None
        linear = np.clip(np.array(factor[:3], dtype=np.float64), 0, 1)
        return "#" + "".join(f"{round(255 * float(v)):02x}" for v in _to_srgb(linear))

    def _accessor(self, index: Any, width: int) -> NDArray[Any]:
        """(count, width) numbers."""
        accessor = _item(self.json.get("accessors", []), index, "accessor")
        count, kind = accessor["count"], np.dtype(_COMPONENTS[accessor["componentType"]])
        if _WIDTHS.get(accessor["type"]) != width or type(count) is not int or count < 1:
            raise Refusal(f"is damaged: accessor {index} is not {width} numbers to each of its items")
        check_total(count // 3)
        if "bufferView" in accessor:
            table = self._view(accessor["bufferView"], accessor.get("byteOffset", 0), count, width, kind)
        else:
            table = np.zeros((count, width), dtype=kind)
        if "sparse" in accessor:
            sparse = accessor["sparse"]
            places, values, many = sparse["indices"], sparse["values"], sparse["count"]
            rows = self._view(
                places["bufferView"],
                places.get("byteOffset", 0),
                many,
                1,
                np.dtype(_COMPONENTS[places["componentType"]]),
            )
            table = table.copy()
            table[rows.ravel()] = self._view(values["bufferView"], values.get("byteOffset", 0), many, width, kind)
        if accessor.get("normalized") and kind.kind != "f":
            return np.maximum(table / float(np.iinfo(kind).max), -1.0)
        return table

    def _view(self, index: Any, offset: int, count: int, width: int, kind: np.dtype) -> NDArray[Any]:
        view = _item(self.json.get("bufferViews", []), index, "bufferView")
        size = width * kind.itemsize
        stride, start, length = view.get("byteStride") or size, view.get("byteOffset", 0), view["byteLength"]
        numbers = (offset, count, stride, start, length)
        if any(type(number) is not int or number < 0 for number in numbers) or stride < size:
            raise Refusal(f"is damaged: bufferView {index} has impossible numbers")
        data = self._buffer(view.get("buffer", 0))
        need = offset + stride * (count - 1) + size if count else 0
        if need > length or start + length > len(data):
            raise Refusal(f"is damaged: bufferView {index} asks for {max(need, length):,} bytes from {start:,} on, "
                          f"and there are {len(data):,}")  # fmt: skip
        return np.ndarray((count, width), kind, data, start + offset, (stride, kind.itemsize))

    def _buffer(self, index: int) -> bytes:
        if index not in self.buffers:
            uri = _item(self.json.get("buffers", []), index, "buffer").get("uri")
            if uri is None:
                self.buffers[index] = self.binary if self.binary is not None and index == 0 else b""
            elif str(uri).startswith("data:"):
                try:
                    self.buffers[index] = base64.b64decode(uri.partition(",")[2], validate=True)
                except binascii.Error:
                    raise Refusal(f"is damaged: the data of buffer {index} is not base64") from None
            else:
                raise Refusal(
                    f"has its data in another file, {str(uri)[:60]!r}; save it as GLB, which holds all in one"
                )
        return self.buffers[index]


def _item(family: list[dict[str, Any]], index: Any, what: str) -> dict[str, Any]:
    if type(index) is not int or not 0 <= index < len(family):
        raise Refusal(f"is damaged: there is no {what} {str(index)[:20]}")
    return family[index]


def _placement(node: dict[str, Any]) -> NDArray[np.float64]:
    if "matrix" in node:
        return np.array(node["matrix"], dtype=np.float64).reshape(4, 4).T[:3]
    x, y, z, w = np.array(node.get("rotation", (0, 0, 0, 1)), dtype=np.float64)
    turn = np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ])  # fmt: skip
    scale = np.array(node.get("scale", (1, 1, 1)), dtype=np.float64).reshape(3)
    return np.column_stack((turn * scale, np.array(node.get("translation", (0, 0, 0)), dtype=np.float64).reshape(3)))


def _triangles(order: NDArray[np.int64], mode: int) -> NDArray[np.int64]:
    if mode == 4:
        return order[: len(order) // 3 * 3].reshape(-1, 3)
    if mode == 6:
        return fan(order, np.array([len(order)]))
    strip = np.column_stack((order[:-2], order[1:-1], order[2:]))
    strip[1::2] = strip[1::2, [1, 0, 2]]  # every other triangle of a strip is the other way round
    return strip


def _to_srgb(linear: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
