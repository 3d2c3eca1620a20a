"""What the inspector tells of a bitmap: its memory with the sums written out, single pixels, bytes, channels."""

from __future__ import annotations

import numpy as np

from .bitmap import Bitmap, Bytes, pitch_of

CHANNELS = ("colour", "red", "green", "blue", "alpha", "luminance")
PER_LINE = 16
"""Bytes in a line of the table of bytes."""


def memory_rows(bitmap: Bitmap, file_size: int | None) -> list[tuple[str, str, str]]:
    """(what, size in bytes, how it is reckoned) of the pixels packed, as stored, in the file, and as RGBA."""
    width, height, bits = bitmap.width, bitmap.height, bitmap.bits
    padded = bitmap.pitch == pitch_of(width, bits)
    pitch = (
        f"pitch: \u2308{width} \u00b7 {bits} / 32\u2309 \u00b7 4 = {bitmap.pitch:,}"
        if padded
        else f"pitch: {bitmap.pitch:,}"
    )
    rows = [
        ("Packed", f"{bitmap.packed_size:,}", f"\u2308{width} \u00b7 {height} \u00b7 {bits} / 8\u2309, no row padded"),
        ("Stored", f"{bitmap.stored_size:,}", f"{height} rows of {bitmap.pitch:,} bytes; {pitch}"),
    ]
    if bitmap.palette is not None:
        rows.append(("Palette", f"{4 * len(bitmap.palette):,}", f"{len(bitmap.palette)} colours of 4 bytes"))
    if file_size is not None:
        share = 100.0 * file_size / max(bitmap.stored_size, 1)
        rows.append(("File", f"{file_size:,}", f"{share:.1f} % of the stored pixels, with header and palette"))
    rows.append(
        ("As a texture", f"{4 * width * height:,}", f"{width} \u00b7 {height} \u00b7 4, red, green, blue and alpha")
    )
    return rows


def place_of(bitmap: Bitmap, x: int, y: int) -> tuple[int, int]:
    """(byte, bit) where a pixel of row y from the top begins in the stored pixels; bit 0 is the highest of the byte."""
    row = y if bitmap.top_down else bitmap.height - 1 - y
    byte, bit = divmod(x * bitmap.bits, 8)
    return row * bitmap.pitch + byte, bit


def number_at(bitmap: Bitmap, x: int, y: int) -> int:
    """The number that is stored for a pixel of row y from the top: its index, or its bytes as one number."""
    byte, bit = place_of(bitmap, x, y)
    row, column = divmod(byte, bitmap.pitch)
    if bitmap.bits < 8:
        return int(bitmap.pixels[row, column]) >> (8 - bitmap.bits - bit) & (2**bitmap.bits - 1)
    return int.from_bytes(bitmap.pixels[row, column : column + bitmap.bits // 8].tobytes(), "little")


def lost_words(bitmap: Bitmap, ending: str) -> str:
    """What a file of this ending does not keep of a bitmap, in words; "" where it keeps all."""
    lost = []
    if ending in (".bmp", ".dib"):
        if bitmap.colour_key is not None:
            lost.append("the colour key, which BMP does not have")
    else:
        if bitmap.palette is not None:
            lost.append("the palette: the colours themselves are written")
        if ending in (".jpg", ".jpeg"):
            lost.append(
                "what JPEG drops" + (", transparency too" if bitmap.alpha or bitmap.colour_key is not None else "")
            )
    return "; ".join(lost)


def pixel_words(bitmap: Bitmap, rgba: Bytes, x: int, y: int) -> str:
    """A pixel in words: its number as stored, its colour, where it stands. `rgba` as `Bitmap.to_rgba` gives it."""
    red, green, blue, alpha = rgba[y, x].tolist()
    colour = f"red {red}, green {green}, blue {blue}" + (f", alpha {alpha}" if alpha < 255 or bitmap.alpha else "")
    if bitmap.bits <= 8:
        value = f"index {number_at(bitmap, x, y)}: {colour}"
    elif bitmap.bits in (16, 32):
        value = f"{number_at(bitmap, x, y):0{bitmap.bits // 4}x}: {colour}"
    else:
        value = colour
    byte, bit = place_of(bitmap, x, y)
    where = f"byte {byte:,}" + (f", bit {bit}" if bitmap.bits < 8 else "")
    return f"column {x}, row {y}: {value}; {where} of the pixels"


def channel(bitmap: Bitmap, rgba: Bytes, name: str) -> Bytes:
    """(height, width, 3 or 4) one channel as grey: of CHANNELS, or "bit N" of the stored numbers, 0 the lowest."""
    if name == "colour":
        return rgba
    if name.startswith("bit "):
        samples = bitmap.samples()
        grey = ((samples >> samples.dtype.type(int(name[4:]))) & 1).astype(np.uint8) * 255
    elif name == "luminance":
        grey = np.rint(rgba[..., :3] @ np.array([0.2126, 0.7152, 0.0722])).astype(np.uint8)
    else:
        grey = rgba[..., ("red", "green", "blue", "alpha").index(name)]
    return np.repeat(grey[..., None], 3, axis=2)


def channels_of(bitmap: Bitmap) -> list[str]:
    """The names that `channel` takes."""
    planes = bitmap.bits if bitmap.bits <= 16 or bitmap.bits == 32 else 0
    return [*CHANNELS, *(f"bit {number}" for number in reversed(range(planes)))]


def byte_lines(data: bytes, start: int, count: int, base: int = 0) -> list[str]:
    """Lines of an address, PER_LINE bytes in hexadecimal and their letters, from the line that `start` is in; the first
    byte of `data` has the address `base`."""
    first = max(start // PER_LINE * PER_LINE, base)
    found = []
    for at in range(first, min(first + count * PER_LINE, base + len(data)), PER_LINE):
        piece = data[at - base : at - base + PER_LINE]
        digits = " ".join(f"{byte:02x}" for byte in piece).ljust(3 * PER_LINE - 1)
        letters = "".join(chr(byte) if 32 <= byte < 127 else "\u00b7" for byte in piece)
        found.append(f"{at:08x}  {digits}  {letters}")
    return found
