"""The bitmap that the inspector has open, with what its pages need of it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ...model.image.bitmap import Bitmap


@dataclass(frozen=True, eq=False)
class OpenBitmap:
    """`data` are the bytes of its file."""

    name: str
    bitmap: Bitmap
    data: bytes

    @cached_property
    def rgba(self) -> NDArray[np.uint8]:
        """(height, width, 4), rows from the top down."""
        return self.bitmap.to_rgba()

    def with_key(self, key: int | tuple[int, int, int] | None) -> OpenBitmap:
        return OpenBitmap(self.name, replace(self.bitmap, colour_key=key), self.data)


def read(path: Path, name: str = "") -> OpenBitmap:
    """Read a file. Raises Refusal."""
    from ...model.image.pictures import file_bytes, read_bitmap

    found = OpenBitmap(name or path.name, read_bitmap(path), file_bytes(path))
    _ = found.rgba  # in the thread that reads
    return found
