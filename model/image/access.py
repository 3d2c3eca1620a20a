"""What windows, rows and columns of a picture cost row by row and in tiles: bytes counted, time measured."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..document.errors import Refusal
from .bitmap import Bytes
from .tiled_file import TiledFile, write_tiled

PAGE = 4096
"""Bytes that a computer reads from a file at least."""
RUNS = 5


@dataclass(frozen=True, slots=True)
class Access:
    """One way to read: `rows` and `tiles` are the bytes that have to be read row by row and in tiles, `*_time`
    seconds."""

    name: str
    wanted: int
    rows: int
    tiles: int
    rows_time: float | None = None
    tiles_time: float | None = None


def counted(width: int, height: int, tile: int, depth: int, side: int = 256) -> list[Access]:
    """Of a picture of `depth` bytes a pixel: a window of `side` pixels at most in its middle, a column, a row. Of a
    file row by row whole pages are read."""
    found = []
    for name, x, y, across, down in _ways(width, height, side):
        starts = ((np.arange(y, y + down) * width) + x) * depth
        ends = starts + across * depth - 1
        pages = np.concatenate([np.arange(a, b + 1) for a, b in zip(starts // PAGE, ends // PAGE, strict=True)])
        tiles = ((x + across - 1) // tile - x // tile + 1) * ((y + down - 1) // tile - y // tile + 1)
        found.append(Access(name, across * down * depth, len(np.unique(pages)) * PAGE, tiles * tile * tile * depth))
    return found


def measured(pixels: Bytes, tile: int, side: int = 256) -> list[Access]:
    """The same of a picture (height, width, depth) written to two files, read with the files in the system's memory:
    the least time of a few runs. Raises Refusal where no file can be written."""
    try:
        return _measured(pixels, tile, side)
    except OSError as error:
        raise Refusal(f"nothing can be measured: {error.strerror or error}") from None


def _measured(pixels: Bytes, tile: int, side: int) -> list[Access]:
    height, width, depth = pixels.shape
    found = []
    with tempfile.TemporaryDirectory() as folder:
        plain, in_tiles = Path(folder, "rows"), Path(folder, "tiles")
        pixels.tofile(plain)
        write_tiled(in_tiles, iter([pixels]), width, height, depth, tile)
        file = TiledFile(in_tiles)
        for access, (_, x, y, across, down) in zip(
            counted(width, height, tile, depth, side), _ways(width, height, side), strict=True
        ):

            def by_rows(x: int = x, y: int = y, across: int = across, down: int = down) -> Bytes:
                rows = np.memmap(plain, np.uint8, "r", shape=pixels.shape)
                return np.array(rows[y : y + down, x : x + across])

            def by_tiles(x: int = x, y: int = y, across: int = across, down: int = down) -> Bytes:
                return file.window(x, y, across, down)

            found.append(
                Access(access.name, access.wanted, access.rows, access.tiles, _least(by_rows), _least(by_tiles))
            )
    return found


def _ways(width: int, height: int, side: int) -> list[tuple[str, int, int, int, int]]:
    across, down = min(side, width), min(side, height)
    return [
        (f"window of {across} \u00d7 {down}", (width - across) // 2, (height - down) // 2, across, down),
        ("column", width // 2, 0, 1, height),
        ("row", 0, height // 2, width, 1),
    ]


def _least(read: Callable[[], object]) -> float:
    times = []
    for _ in range(RUNS):
        start = time.perf_counter()
        read()
        times.append(time.perf_counter() - start)
    return min(times)
