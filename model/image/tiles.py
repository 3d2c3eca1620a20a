"""Arrays in square tiles: where an element stands, and row by row to tile by tile and back."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def tiled_index(x, y, width: int, tile: int):
    """Where column x of row y stands, all from 0, in one step; scalars or arrays.

    Tiles follow each other row by row, and so do the elements in a tile; tiles at the edge are padded to full size.
    """
    return ((y // tile) * -(-width // tile) + x // tile) * tile * tile + (y % tile) * tile + x % tile


def tile_and_place(x, y, width: int, tile: int):
    """The same in two steps: the number of the tile, and the place inside it."""
    return (y // tile) * -(-width // tile) + x // tile, (y % tile) * tile + x % tile


def position_of(index, width: int, tile: int):
    """(x, y) of a place among the tiles: the inverse of `tiled_index`."""
    number, place = index // (tile * tile), index % (tile * tile)
    across = -(-width // tile)
    return number % across * tile + place % tile, number // across * tile + place // tile


def tiled(rows: NDArray, tile: int) -> NDArray:
    """(tiles down, tiles across, tile, tile, ...) of (height, width, ...); its memory is in the order of `tiled_index`.

    What pads the tiles at the edge is 0.
    """
    height, width = rows.shape[:2]
    down, across = -(-height // tile), -(-width // tile)
    padded = rows
    if (down * tile, across * tile) != (height, width):
        padded = np.zeros((down * tile, across * tile, *rows.shape[2:]), rows.dtype)
        padded[:height, :width] = rows
    return np.ascontiguousarray(padded.reshape(down, tile, across, tile, *rows.shape[2:]).swapaxes(1, 2))


def untiled(tiles: NDArray, width: int, height: int) -> NDArray:
    """(height, width, ...) row by row again, without the padding."""
    down, across, tile = tiles.shape[:3]
    rows = tiles.swapaxes(1, 2).reshape(down * tile, across * tile, *tiles.shape[4:])
    return np.ascontiguousarray(rows[:height, :width])
