"""Bitmaps as BMP files: every depth, run-length code, bit fields, and a version 4 header where there is alpha."""

from __future__ import annotations

import struct

import numpy as np

from ..document.errors import Refusal
from .bitmap import MASKS_555, MASKS_888, Bitmap, grey_palette, packed
from .run_length import coded


def bmp_of_bitmap(bitmap: Bitmap, *, run_length: bool = False) -> bytes:
    """A BMP file's bytes, the rows in the bitmap's own order.

    BMP has no colour key and no alpha in a palette: both are left out. Run-length code is for 4 and 8 bits and
    stored from the bottom up.
    """
    if run_length and bitmap.bits not in (4, 8):
        raise Refusal(f"run-length code is for 4 and 8 bits a pixel, this has {bitmap.bits}; change the depth first")
    bits, top_down, masks = bitmap.bits, bitmap.top_down and not run_length, b""
    size, method, palette = 40, 0, b""
    if bits <= 8:
        table = grey_palette(bits) if bitmap.palette is None else bitmap.palette[: 2**bits]
        entries = np.zeros((len(table), 4), np.uint8)
        entries[:, :3] = table[:, 2::-1]
        palette = entries.tobytes()
    elif bits in (16, 32):
        plain = MASKS_555 if bits == 16 else MASKS_888
        found = bitmap.masks or plain
        if found != plain:
            method, masks = 3, struct.pack("<4I" if found[3] else "<3I", *found[: 4 if found[3] else 3])
            size = 108 if found[3] else 40
    if run_length:
        method = 1 if bits == 8 else 2
        data = coded(bitmap.samples()[::-1], bits)
    elif bitmap.pixels.shape[1] != (bitmap.width * bits + 31) // 32 * 4:
        rows = packed(bitmap.samples(), bits)
        data = (rows if top_down else rows[::-1]).tobytes()
    else:
        data = bitmap.pixels.tobytes()
    # Version 4 goes on after the masks with the colour space: sRGB by name, its end points and gammas empty.
    rest = b"BGRs".ljust(52, b"\0") if size == 108 else b""
    at = 14 + 40 + len(masks) + len(rest) + len(palette)
    header = struct.pack(
        "<IiiHHIIiiII",
        size,
        bitmap.width,
        -bitmap.height if top_down else bitmap.height,
        1,
        bits,
        method,
        len(data),
        2835,  # pixels per metre: 72 to the inch
        2835,
        len(palette) // 4,
        0,
    )
    return struct.pack("<2sIHHI", b"BM", at + len(data), 0, 0, at) + header + masks + rest + palette + data
