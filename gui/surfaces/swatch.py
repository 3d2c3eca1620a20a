"""Small pictures of materials and bitmaps: a sphere lit as the textbook has it, and texels made small."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import Qt
from PySide6.QtGui import QIcon, QImage, QPixmap

from ...model.document.colours import rgb
from ...model.document.errors import Refusal
from ...model.surface.bitmaps import keyed, luminance, slopes_of, small_texels
from ...model.surface.intensity import Eye, terms
from ...model.surface.light import PROGRAM
from ...model.surface.mapping import turns
from ...model.surface.material import Material

Floats = NDArray[np.float64]

PLAIN = "#a9b8c9"
"""The colour of a sphere whose material has none."""
GROUND = (205.0, 165.0)  # grey levels of the squares behind what is translucent
RADIUS = 12.0  # mm, against which bumps are high or low
FACETS = (16, 8)  # of a sphere with flat shading, around and up
TURNED = np.radians(215.0)  # where the bitmap's middle is before the eye, seen a little from above


@lru_cache(maxsize=256)
def sphere_pixels(material: Material, side: int) -> NDArray[np.uint8]:
    """(side, side, 4) RGBA of a sphere of the material under the program's lights; bitmaps that are missing are left
    out."""
    fine = 2 * side
    across = (np.arange(fine) + 0.5) / fine * 2.0 - 1.0
    x, y = np.meshgrid(across / 0.96, -across / 0.96)
    within = x * x + y * y <= 1.0
    normals = np.column_stack((x[within], y[within], np.sqrt(1.0 - x[within] ** 2 - y[within] ** 2)))
    colours, alpha = _lit(material, normals)
    squares = (np.indices((fine, fine)) // (fine // 4)).sum(axis=0) % 2
    ground = np.where(squares[within] == 0, *GROUND)[:, None] / 255.0
    pixels = np.zeros((fine, fine, 4))
    pixels[within, :3] = colours * alpha[:, None] + ground * (1.0 - alpha[:, None])
    pixels[within, 3] = 1.0
    pixels[..., :3] *= pixels[..., 3:]
    joined = pixels.reshape(side, 2, side, 2, 4).mean(axis=(1, 3))
    joined[..., :3] /= np.maximum(joined[..., 3:], 1e-9)
    return np.rint(255.0 * np.clip(joined, 0.0, 1.0)).astype(np.uint8)


def swatch(material: Material, side: int = 32) -> QIcon:
    """The sphere as an icon, sharp on dense screens too."""
    picture = _pixmap(sphere_pixels(material, 2 * side))
    found = QIcon(picture)
    found.addPixmap(picture, QIcon.Mode.Selected)  # or a selected row would tint it
    return found


def thumbnail(sha: str, side: int = 32) -> QPixmap | None:
    """A bitmap made small; None where it is missing or cannot be read."""
    try:
        picture = _pixmap(small_texels(sha))
    except Refusal:
        return None
    aspect, how = Qt.AspectRatioMode.KeepAspectRatio, Qt.TransformationMode.SmoothTransformation
    return picture.scaled(2 * side, 2 * side, aspect, how)


def _pixmap(rgba: NDArray[np.uint8]) -> QPixmap:
    data = np.ascontiguousarray(rgba)
    image = QImage(data.data, data.shape[1], data.shape[0], 4 * data.shape[1], QImage.Format.Format_RGBA8888)
    picture = QPixmap.fromImage(image)
    picture.setDevicePixelRatio(2.0)
    return picture


def _lit(material: Material, normals: Floats) -> tuple[Floats, Floats]:
    """Colours (n, 3) and alpha (n,) of the sphere where it has these normals, in the eye's axes."""
    place = _turned(normals)
    u, v = turns(place[:, 0], place[:, 1]), np.arcsin(np.clip(place[:, 2], -1.0, 1.0)) / np.pi + 0.5
    if material.shading == "flat":
        around, up = FACETS
        middle_u, middle_v = (np.floor(u * around) + 0.5) / around, (np.floor(v * up) + 0.5) / up
        normals = _turned(_on_sphere(middle_u, middle_v), back=True)
    surface = np.broadcast_to(
        np.array(rgb(material.colour or ("#ffffff" if material.texture else PLAIN))), normals.shape
    )
    surface, alpha = surface / 255.0, np.full(len(normals), material.opacity)
    texture = _texels(material.texture)
    if texture is not None:
        texel = _sample(keyed(texture, material.key), u, v, 2.0) / 255.0
        surface, alpha = surface * texel[:, :3], alpha * texel[:, 3]
    bump = _texels(material.bump)
    if bump is not None and material.shading in ("", "phong"):
        normals = _bumped(material, bump, normals, u, v)
    light_map = _texels(material.light_map)
    received = None if light_map is None else luminance(_sample(light_map, u, v, 2.0))
    eye = Eye(np.zeros(3), np.eye(3), parallel=True)
    points = np.zeros_like(normals)
    highlights = material.shading != "gouraud-diffuse"
    colours = terms(points, normals, eye, material, surface, PROGRAM, received, highlights).clamped
    room = _texels(material.reflection)
    if room is not None:
        mirrored = 2.0 * normals[:, 2:] * normals - np.array((0.0, 0.0, 1.0))
        seen = _sample(
            room, turns(mirrored[:, 0], -mirrored[:, 2]), np.arcsin(np.clip(mirrored[:, 1], -1, 1)) / np.pi + 0.5
        )
        colours = (1.0 - material.reflectivity) * colours + material.reflectivity * seen[:, :3] / 255.0
    return colours, alpha


def _texels(sha: str) -> NDArray[np.uint8] | None:
    try:
        return small_texels(sha) if sha else None
    except Refusal:
        return None


def _sample(texels: NDArray[Any], u: Floats, v: Floats, copies: float = 1.0) -> NDArray[Any]:
    """The texels nearest to the coordinates; `copies` of the bitmap go around."""
    height, width = texels.shape[:2]
    column = np.floor(u * copies % 1.0 * width).astype(int) % width
    row = np.clip(np.floor((1.0 - v) * height).astype(int), 0, height - 1)
    return texels[row, column]


def _bumped(material: Material, texels: NDArray[np.uint8], normals: Floats, u: Floats, v: Floats) -> Floats:
    slopes = _sample(slopes_of(texels, material.bump_kind, material.bump_height, True), u, v, 2.0).astype(float)
    if material.bump_kind == "heights":  # mm across one copy, of which two go around and one up
        slopes = slopes / (np.pi * RADIUS)
    right = np.column_stack((normals[:, 2], np.zeros(len(normals)), -normals[:, 0]))
    right /= np.maximum(np.linalg.norm(right, axis=1, keepdims=True), 1e-9)
    return normals - slopes[:, :1] * right - slopes[:, 1:] * np.cross(normals, right)


def _turned(points: Floats, back: bool = False) -> Floats:
    """From the eye's axes to the sphere's own, whose z axis stands up and a little towards the eye; or `back`."""
    tilt = np.radians(18.0)
    c, s = np.cos(tilt), np.sin(tilt)
    upright = np.array(((1, 0, 0), (0, s, -c), (0, c, s)))  # x right, y away, z up
    a, b = np.cos(TURNED), np.sin(TURNED)
    matrix = np.array(((a, -b, 0), (b, a, 0), (0, 0, 1))) @ upright
    return points @ (matrix if back else matrix.T)


def _on_sphere(u: Floats, v: Floats) -> Floats:
    angle, height = 2 * np.pi * u, np.pi * (v - 0.5)
    return np.column_stack((np.cos(angle) * np.cos(height), np.sin(angle) * np.cos(height), np.sin(height)))
