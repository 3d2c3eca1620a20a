"""Bitmaps too large for memory's comfort: in tiles on disk, with smaller copies, read at the size wanted."""

from __future__ import annotations

import secrets
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..image.bitmap import Bitmap
from ..image.tiled_file import TiledFile, write_tiled

TILED_FROM = 2**24
"""Pixels from which on a bitmap is kept so."""
BAND = 256  # rows whose colours are held at once


def tiles_path(asset: Path) -> Path:
    """Where the tiles of an asset's file lie."""
    return asset.parent / "tiles" / asset.name


def keep_tiles(bitmap: Bitmap, asset: Path) -> TiledFile:
    """Write the tiles of an asset's bitmap; several processes may do so at once. Raises Refusal."""
    path = tiles_path(asset)
    part = path.with_name(f".{secrets.token_hex(8)}.part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_tiled(part, _bands(bitmap), bitmap.width, bitmap.height, 4, 256)
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)
    return TiledFile(path)


def level_of(file: TiledFile, side: int) -> NDArray[np.uint8]:
    """(height, width, 4) of the largest copy whose sides are `side` texels at most."""
    levels = file.levels
    number = next((i for i, size in enumerate(levels) if max(size) <= side), len(levels) - 1)
    return file.window(0, 0, *levels[number], level=number)


def _bands(bitmap: Bitmap) -> Iterator[NDArray[np.uint8]]:
    rows = bitmap.rows()
    for top in range(0, bitmap.height, BAND):
        part = rows[top : top + BAND]
        yield replace(bitmap, height=len(part), pixels=part, top_down=True).to_rgba()
