"""Bitmaps of materials: files kept as assets, and assets as texels."""

from __future__ import annotations

import os
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..document.colours import rgb
from ..document.errors import Refusal
from ..image.tiled_file import TiledFile
from .pyramid import TILED_FROM, keep_tiles, level_of, tiles_path

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
"""The shares of red, green and blue (ITU-R BT.709)."""
LARGEST_SIDE = 8192
"""Texels along one side that a picture is given; larger bitmaps are halved until they fit."""


def keep_bitmap(path: str | os.PathLike[str]) -> str:
    """The SHA-256 of a bitmap file, now kept as an asset. Raises Refusal where it cannot be read as a bitmap."""
    from ..image.pictures import file_bytes, read_bitmap
    from ..project.assets import default_store

    read_bitmap(Path(path))
    return default_store().put(file_bytes(Path(path)))


@lru_cache(maxsize=16)
def texels_of(sha: str) -> NDArray[np.uint8]:
    """(height, width, 4) RGBA of an asset, rows from the top down; read-only. Raises Refusal."""
    return _texels(sha, LARGEST_SIDE)


@lru_cache(maxsize=64)
def small_texels(sha: str, side: int = 256) -> NDArray[np.uint8]:
    """The same made small: both sides are `side` texels at most. Of large bitmaps no more is read than that takes."""
    path = tiles_path(_path(sha))
    if path.exists():
        return _texels(sha, side)
    rgba = texels_of(sha)
    while max(rgba.shape[:2]) > side:
        rgba = halved(rgba)
    return rgba


def _path(sha: str) -> Path:
    from ..project.assets import default_store

    store = default_store()
    if not store.has(sha):
        raise Refusal("its bitmap is missing from the project")
    return store.path(sha)


def _texels(sha: str, side: int) -> NDArray[np.uint8]:
    from ..image.pictures import read_bitmap

    path = _path(sha)
    if tiles_path(path).exists():
        rgba = level_of(TiledFile(tiles_path(path)), side)
    else:
        bitmap = read_bitmap(path)
        if bitmap.width * bitmap.height > TILED_FROM:
            rgba = level_of(keep_tiles(bitmap, path), side)
        else:
            rgba = bitmap.to_rgba()
    while max(rgba.shape[:2]) > side:
        rgba = halved(rgba)
    rgba = np.ascontiguousarray(rgba)
    rgba.setflags(write=False)
    return rgba


def halved(rgba: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Half as many texels along each side longer than one, each the mean of those it stands for."""
    height, width = (max(side // 2, 1) for side in rgba.shape[:2])
    down, across = rgba.shape[0] // height, rgba.shape[1] // width
    cut = rgba[: height * down, : width * across].reshape(height, down, width, across, 4)
    return np.rint(cut.mean(axis=(1, 3), dtype=np.float32)).astype(np.uint8)


def keyed(rgba: NDArray[np.uint8], key: str | None) -> NDArray[np.uint8]:
    """With texels of the colour `key` made transparent."""
    if key is None:
        return rgba
    result = rgba.copy()
    result[(rgba[..., :3] == np.array(rgb(key), np.uint8)).all(axis=2), 3] = 0
    return result


def luminance(rgba: NDArray[np.uint8]) -> NDArray[np.float64]:
    """(height, width) 0 to 1: the mean weighed as ITU-R BT.709 has it, of the values as they are stored."""
    return rgba[..., :3] @ LUMINANCE / 255.0


def slopes_of(rgba: NDArray[np.uint8], kind: str, height: float, wrap: bool) -> NDArray[np.float32]:
    """(height, width, 2) by how much a bump map rises along u and v, rows from the top down.

    Of "heights", mm for once across the bitmap, where white is `height` mm above black; of "normals", without a unit,
    times `height`: the slopes of the normals that the texels' red, green and blue encode.
    """
    if kind == "normals":
        normals = rgba[..., :3].astype(np.float64) / 127.5 - 1.0
        return (-height * normals[..., :2] / np.maximum(normals[..., 2:], 0.05)).astype(np.float32)
    heights = height * luminance(rgba)
    slopes = []
    for axis in (1, 0):
        count = heights.shape[axis]
        if count == 1:
            slope = np.zeros_like(heights)
        elif wrap:
            slope = (np.roll(heights, -1, axis) - np.roll(heights, 1, axis)) / 2.0
        else:
            slope = np.gradient(heights, axis=axis)
        slopes.append(slope * count)
    return np.stack((slopes[0], -slopes[1]), axis=2).astype(np.float32)
