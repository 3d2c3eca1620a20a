"""Windows and columns of a 20,000 x 20,000 bitmap on disk, in tiles against row by row, ratios within one run."""

from __future__ import annotations

import os
import resource
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from solidtree.model.image.tiled_file import TiledFile, write_tiled

SIDE, TILE, WINDOW, PAGE = 20_000, 128, 256, 4096
MOST_BYTES = 1 / 20
"""Share of the bytes of whole rows that a window in tiles may read."""
MOST_MEMORY = 1 / 10
"""Share of the bitmap by which the program's memory may grow."""


def bands(copy: Path) -> Iterator[np.ndarray]:
    """The picture in bands, each written row by row too."""
    across = np.arange(SIDE, dtype=np.uint32)
    with copy.open("wb") as file:
        for top in range(0, SIDE, 32):
            down = np.arange(top, min(top + 32, SIDE), dtype=np.uint32)
            band = ((across * 7 ^ down[:, None] * 13) >> 3).astype(np.uint8)
            file.write(band.data)
            yield band[..., None]


def seconds(function: Callable[[], object], *paths: Path) -> float:
    """Of one call, the pages of the files dropped from the system's memory before it where the system can."""
    for path in paths if hasattr(os, "posix_fadvise") else ():
        with path.open("rb") as file:
            os.fsync(file.fileno())
            os.posix_fadvise(file.fileno(), 0, 0, os.POSIX_FADV_DONTNEED)
    start = time.perf_counter()
    function()
    return time.perf_counter() - start


def main() -> int:
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    generator = np.random.default_rng(1)
    with tempfile.TemporaryDirectory() as folder:
        tiles, rows = Path(folder) / "tiles", Path(folder) / "rows"
        took = seconds(lambda: write_tiled(tiles, bands(rows), SIDE, SIDE, 1, TILE))
        file = TiledFile(tiles)

        def by_rows(x: int, y: int, width: int, height: int) -> np.ndarray:
            with rows.open("rb") as stored:
                stored.seek(y * SIDE)
                out = np.empty((height, width), np.uint8)
                for row in range(height):
                    out[row] = np.frombuffer(stored.read(SIDE), np.uint8)[x : x + width]
            return out

        def by_pages(x: int, y: int, width: int, height: int) -> np.ndarray:
            stored = np.memmap(rows, np.uint8, "r", shape=(SIDE, SIDE))
            return np.array(stored[y : y + height, x : x + width])

        kept = True
        print(f"written with {len(file.levels)} levels in {took:.1f} s")
        print(f"{'read':>14} {'tiles':>12} {'rows':>12} {'pages':>12} {'bytes: of rows':>15} {'of pages':>9}"
              f" {'time: of rows':>14} {'of pages':>9}")  # fmt: skip
        jobs = []
        for name, width, height, count in (("window", WINDOW, WINDOW, 12), ("column", 1, SIDE, 3)):
            corners = [[int(generator.integers(0, SIDE - side + 1)) for side in (width, height)] for _ in range(count)]
            places = [(x, y, width, height) for x, y in corners]
            file.bytes_read = 0
            here = sum(seconds(lambda place=place: file.window(*place), tiles) for place in places)
            jobs.append((name, places, here, file.bytes_read))
        # Before the peers read: a memory map of the rows counts as the program's memory.
        grown = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) * 1024 / SIDE**2
        for name, places, here, got in jobs:
            read = sum(height * SIDE for _, _, _, height in places)
            touched = 0
            for left, top, across, down in places:
                starts = np.arange(top, top + down) * SIDE + left
                touched += int(((starts + across - 1) // PAGE - starts // PAGE + 1).sum()) * PAGE
            rowwise = sum(seconds(lambda place=place: by_rows(*place), rows) for place in places)
            paged = sum(seconds(lambda place=place: by_pages(*place), rows) for place in places)
            kept &= all((file.window(*place)[..., 0] == by_pages(*place)).all() for place in places)
            kept &= got <= MOST_BYTES * read
            count = len(places)
            print(f"{name:>14} {got // count:12,} {read // count:12,} {touched // count:12,} {got / read:15.4f}"
                  f" {got / touched:9.3f} {here / rowwise:14.3f} {here / paged:9.3f}")  # fmt: skip
    print(f"memory grew by {grown:.3f} of the bitmap")
    return 0 if kept and grown <= MOST_MEMORY else 1


if __name__ == "__main__":
    sys.exit(main())
