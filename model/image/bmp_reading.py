"""BMP files as bitmaps: every header, depth and compression; what is not in order is refused in a line."""

from __future__ import annotations

import numpy as np

from ..document.errors import Refusal
from .bitmap import Bitmap, of_rgba, packed, pitch_of
from .bmp_header import Header, header_of, palette_rows
from .fax import fax_rows
from .run_length import expanded


def bitmap_of_bmp(data: bytes) -> Bitmap:
    """The bitmap in a BMP file's bytes; the sizes are checked before memory is taken.

    Refused with `Refusal`: what is cut short, contradicts itself, or points outside its palette.
    """
    header = header_of(data)
    if header.compression in ("jpeg", "png"):
        return _embedded(data[header.pixels_at :], header)
    if header.compression in ("none", "bit fields"):
        pitch = pitch_of(header.width, header.bits)
        pixels = np.frombuffer(data, np.uint8, pitch * header.height, header.pixels_at).reshape(header.height, pitch)
    elif header.compression == "huffman":
        pixels = packed(fax_rows(data[header.pixels_at :], header.width, header.height), 1)
    else:
        samples = expanded(data[header.pixels_at :], header.width, header.height, header.bits)
        pixels = packed(samples, header.bits)
    bitmap = Bitmap(
        header.width,
        header.height,
        header.bits,
        pixels,
        palette=palette_rows(data, header) if header.bits <= 8 else None,
        masks=header.masks,
        top_down=header.top_down,
        type=f"BMP, {header.type}",
        compression=header.compression,
    )
    if bitmap.palette is not None and len(bitmap.palette) < 2**bitmap.bits:
        highest = int(bitmap.samples().max())
        if highest >= len(bitmap.palette):
            raise Refusal(f"a pixel has colour {highest}, the palette has {len(bitmap.palette)}; save the file anew")
    return bitmap


def _embedded(data: bytes, header: Header) -> Bitmap:
    """A JPEG or PNG picture in a BMP file's place for pixels."""
    from .pictures import rgba_of

    rgba = rgba_of(data, (header.compression.upper(),), (header.width, header.height))
    return of_rgba(rgba, type=f"BMP, {header.type}", compression=header.compression)
