"""A bitmap in tiles on disk, with smaller copies of itself (mip levels), read by the tile.

The file is a header of 32 bytes and the tiles of each level in the order of `tiled_index`; neighbours in a row are one
read. Tiled TIFF (tifffile, zarr) was the other choice: other programs open it, but it needs two libraries more, and
looks a tile up in a table where the formula shown here gives its place. A memory map was tried: the system reads far
around every page that is touched, and the pages count as the program's memory.
"""

from __future__ import annotations

import os
import struct
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

import numpy as np

from ..document.errors import Refusal
from .bitmap import Bytes
from .tiles import tiled

_MAGIC = b"STTILES1"
_HEADER = struct.Struct("<8sIIIII4x")
MOST_SIDE = 2**20


@dataclass(frozen=True, slots=True)
class _Level:
    width: int
    height: int
    across: int
    down: int
    start: int
    """Of its first tile, in bytes from the start of the file."""


@dataclass(frozen=True, slots=True)
class Piece:
    """A bitmap whose top left corner is at column x of row y of a larger one; `load`: (height, width, channels)."""

    x: int
    y: int
    width: int
    height: int
    load: Callable[[], Bytes]


def _levels(width: int, height: int, channels: int, tile: int) -> list[_Level]:
    levels, start = [], _HEADER.size
    while True:
        across, down = -(-width // tile), -(-height // tile)
        levels.append(_Level(width, height, across, down, start))
        start += across * down * tile * tile * channels
        if across == down == 1:
            return levels
        width, height = (width + 1) // 2, (height + 1) // 2


class TiledFile:
    """Windows, columns and levels of a file that `write_tiled` made; `bytes_read` counts the tiles touched."""

    def __init__(self, path: str | Path) -> None:
        try:
            with open(path, "rb") as file:
                head = file.read(_HEADER.size)
                size = file.seek(0, 2)
        except OSError as error:
            raise Refusal(f"{path}: it cannot be read: {error.strerror or error}") from None
        if len(head) < _HEADER.size or not head.startswith(_MAGIC):
            raise Refusal(f"{path}: it is no file of tiles; make it from a bitmap")
        _, self.width, self.height, self.channels, self.tile, count = _HEADER.unpack(head)
        sides = (self.width, self.height, self.tile)
        if not (all(0 < side <= MOST_SIDE for side in sides) and 1 <= self.channels <= 4):
            raise Refusal(f"{path}: its header has sizes that cannot be; make it anew from a bitmap")
        levels = _levels(self.width, self.height, self.channels, self.tile)
        self._levels = levels
        needed = levels[-1].start + self.tile**2 * self.channels
        if count != len(levels) or size != needed:
            raise Refusal(f"{path}: it should have {needed:,} bytes and has {size:,}; make it anew from a bitmap")
        self._path = path
        self.bytes_read = 0

    @property
    def levels(self) -> list[tuple[int, int]]:
        """(width, height) of each level, the full size first, down to one tile."""
        return [(level.width, level.height) for level in self._levels]

    def window(self, x: int, y: int, width: int, height: int, level: int = 0) -> Bytes:
        """(height, width, channels) from column x of row y on; it must lie within the level."""
        of, tile = self._levels[level], self.tile
        if min(x, y) < 0 or min(width, height) < 1 or x + width > of.width or y + height > of.height:
            raise Refusal(f"{width} x {height} pixels from {x}, {y} leave the {of.width} x {of.height} of the picture")
        first, last = x // tile, (x + width - 1) // tile
        size = tile * tile * self.channels
        out = np.empty((height, width, self.channels), np.uint8)
        with open(self._path, "rb", buffering=0) as file:
            if hasattr(os, "posix_fadvise"):  # or the system reads far ahead of every tile
                os.posix_fadvise(file.fileno(), 0, 0, os.POSIX_FADV_RANDOM)
            for row in range(y // tile, (y + height - 1) // tile + 1):
                file.seek(of.start + (row * of.across + first) * size)
                stored = np.fromfile(file, np.uint8, (last - first + 1) * size)
                self.bytes_read += stored.nbytes
                if stored.nbytes != (last - first + 1) * size:
                    raise Refusal(f"{self._path}: it has become shorter; make it anew from a bitmap")
                band = stored.reshape(-1, tile, tile, self.channels).swapaxes(0, 1).reshape(tile, -1, self.channels)
                top, bottom = max(row * tile, y), min((row + 1) * tile, y + height)
                left = x - first * tile
                out[top - y : bottom - y] = band[top - row * tile : bottom - row * tile, left : left + width]
        return out

    def column(self, x: int, level: int = 0) -> Bytes:
        """(height, channels): one pixel of every row."""
        return self.window(x, 0, 1, self._levels[level].height, level)[:, 0]


def write_tiled(
    path: str | Path, bands: Iterable[Bytes], width: int, height: int, channels: int, tile: int = 128
) -> None:
    """Write rows (any number, width, channels), as they come from the top on, in tiles with all levels.

    A level is the mean of two by two pixels of the one before, the last column or row repeated where the number is odd.
    Held at a time: a row of tiles a level and one band.
    """
    if not (0 < width <= MOST_SIDE and 0 < height <= MOST_SIDE and 1 <= channels <= 4 and 0 < tile <= 4096):
        raise Refusal(f"{width} x {height} pixels of {channels} channels in tiles of {tile} cannot be stored")
    levels = _levels(width, height, channels, tile)
    try:
        with open(path, "wb") as file:
            file.write(_HEADER.pack(_MAGIC, width, height, channels, tile, len(levels)))
            rows = [_LevelRows(file, level, channels, tile) for level in levels]
            for band in bands:
                _pass_on(rows, band, last=False)
            _pass_on(rows, np.empty((0, width, channels), np.uint8), last=True)
    except OSError as error:
        raise Refusal(f"{path}: it cannot be written: {error.strerror or error}") from None
    if rows[0].written != height:
        raise Refusal(f"{path}: {rows[0].written} rows came for a picture of {height}; the file is of no use")


class _LevelRows:
    """The rows of a level on their way to the file."""

    def __init__(self, file: BinaryIO, level: _Level, channels: int, tile: int) -> None:
        self._file, self._level, self._tile = file, level, tile
        self._waiting = np.zeros((tile, level.width, channels), np.uint8)
        self._odd: Bytes | None = None
        self._filled = self.written = 0

    def add(self, rows: Bytes, last: bool) -> Bytes:
        """Take rows; what they are in the next level."""
        if self.written + len(rows) > self._level.height:
            raise Refusal(f"more rows came than the {self._level.height} of the picture")
        at = 0
        while at < len(rows):
            count = min(self._tile - self._filled, len(rows) - at)
            self._waiting[self._filled : self._filled + count] = rows[at : at + count]
            self._filled += count
            self.written += count
            at += count
            if self._filled == self._tile:
                self._flush()
        if last and self._filled:
            self._waiting[self._filled :] = 0
            self._flush()
        if self._odd is not None:
            rows = np.concatenate([self._odd, rows])
        if len(rows) % 2 and last:
            rows = np.concatenate([rows, rows[-1:]])
        even = len(rows) // 2 * 2
        self._odd = rows[even:].copy() if even < len(rows) else None
        return _halved(rows[:even])

    def _flush(self) -> None:
        row = tiled(self._waiting, self._tile)
        number = (self.written - 1) // self._tile
        self._file.seek(self._level.start + number * row.nbytes)
        self._file.write(row.data)
        self._filled = 0


def _pass_on(levels: list[_LevelRows], rows: Bytes, last: bool) -> None:
    for level in levels:
        rows = level.add(rows, last)


def _halved(rows: Bytes) -> Bytes:
    """Means of two by two, rounded, of an even number of rows."""
    if rows.shape[1] % 2:
        rows = np.concatenate([rows, rows[:, -1:]], axis=1)
    pairs = np.add(rows[::2], rows[1::2], dtype=np.uint16)
    return ((pairs[:, ::2] + pairs[:, 1::2] + np.uint16(2)) >> 2).astype(np.uint8)


def bands_of_pieces(
    pieces: Iterable[Piece], width: int, height: int, channels: int, rows: int = 128
) -> Iterator[Bytes]:
    """One large picture of many, in bands for `write_tiled`: later pieces lie over earlier ones, the ground is 0.

    A piece is loaded when the first band reaches it and dropped after its last.
    """
    pieces, held = list(pieces), {}
    for top in range(0, height, rows):
        band = np.zeros((min(rows, height - top), width, channels), np.uint8)
        bottom = top + len(band)
        for number, piece in enumerate(pieces):
            if piece.y >= bottom or piece.y + piece.height <= top:
                continue
            if number not in held:
                held[number] = piece.load()
                if held[number].shape != (piece.height, piece.width, channels):
                    raise Refusal(f"piece {number} is {held[number].shape}, not as large as was said")
            first, last = max(top, piece.y), min(bottom, piece.y + piece.height)
            left, right = max(0, piece.x), min(width, piece.x + piece.width)
            if left < right:
                part = held[number][first - piece.y : last - piece.y, left - piece.x : right - piece.x]
                band[first - top : last - top, left:right] = part
            if piece.y + piece.height <= bottom:
                del held[number]
        yield band
