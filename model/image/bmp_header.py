"""The headers of a BMP file, of every version from OS/2 1 to Windows 5."""

from __future__ import annotations

import struct
from dataclasses import dataclass

from ..document.errors import Refusal
from .bitmap import DEPTHS, MASKS_555, MASKS_888, MOST_PIXELS, Bytes, Masks, pitch_of

_OS2 = (16, 20, 24, 28, 32, 36, 42, 44, 46, 48, 60, 64)
_NAMES = {12: "OS/2 1", 40: "Windows 3", 52: "Windows 3, masks", 56: "Windows 3, masks and alpha", 108: "Windows 4",
          124: "Windows 5"}  # fmt: skip
_RUNS = {"rle4": 4, "rle8": 8, "rle24": 24, "huffman": 1}
_PER_BYTE = 256
"""Pixels that a byte of run-length code may stand for, on the average of a large picture, before it is disbelieved."""


@dataclass(frozen=True, slots=True)
class Header:
    """Where things are in the file, in bytes from its start; sizes in pixels."""

    type: str
    width: int
    height: int
    top_down: bool
    bits: int
    compression: str
    palette_at: int
    colours: int
    entry: int
    masks: Masks | None
    pixels_at: int


def header_of(data: bytes) -> Header:
    """The header of a file's bytes, checked against the file's size before anything is made of it."""
    base = 14 if data[:2] == b"BA" else 0  # a bitmap array (OS/2): its first picture follows, with places in the file
    if data[base : base + 2] != b"BM":
        raise Refusal("it is no BMP file: it does not begin with BM; check that it is the right file")
    if len(data) < base + 26:
        raise Refusal(f"it ends after {len(data)} bytes, within the header; the file is cut short")
    declared, pixels_at = struct.unpack_from("<I4xI", data, base + 2)
    if declared > len(data) and base == 0:
        raise Refusal(f"its header speaks of {declared:,} bytes, the file has {len(data):,}; get it anew")
    size = struct.unpack_from("<I", data, base + 14)[0]
    if size not in _NAMES and size not in _OS2:
        raise Refusal(f"byte {base + 14}: a header of {size} bytes is of no known version; save the file anew")
    after = base + 14 + size
    if after > len(data):
        raise Refusal(f"it ends after {len(data)} bytes, within the header; the file is cut short")
    fields = data[base + 18 : after]
    if size == 12:
        width, height, planes, bits = struct.unpack("<HHHH", fields)
    else:
        width, height, planes, bits = struct.unpack("<iiHH", fields[:12])
    method, image, across, down, colours = struct.unpack_from("<IIiiI", fields[12:32].ljust(20, b"\0"))
    _check(width, height, planes, bits, across, down)
    if (image > len(data) and method != 0) or image > 2 * len(data):
        raise Refusal(f"byte {base + 34}: its pixels are said to take {image:,} bytes, more than the file; get it anew")
    compression = _compression(method, size, bits)
    masks = None
    if bits in (16, 32):
        masks = MASKS_555 if bits == 16 else MASKS_888
    if compression == "bit fields":
        count = 4 if size >= 56 or method == 6 else 3
        if base + 54 + 4 * count > len(data):
            raise Refusal("it ends within the masks of its bit fields; the file is cut short")
        masks = _masks(struct.unpack_from(f"<{count}I", data, base + 54), bits, base + 54)
        after = max(after, base + 54 + 4 * count)
    entry = 3 if size == 12 else 4
    if bits and bits <= 8:
        stated = colours
        colours = colours or 2**bits
        room = (pixels_at - after) // entry
        if stated and after + stated * entry > len(data):
            raise Refusal(f"byte {base + 46}: a palette of {stated:,} colours is larger than the file; save it anew")
        colours = min(colours, max(room, 0))  # a palette may be shorter than the depth allows
    else:
        colours = 0
    if not after <= pixels_at < len(data):
        raise Refusal(
            f"byte {base + 10}: its pixels are said to begin at byte {pixels_at}, outside the data; get it anew"
        )
    header = Header(
        f"OS/2 2 ({size} bytes)" if size in _OS2 else _NAMES[size],
        width,
        abs(height),
        height < 0,
        bits,
        compression,
        after,
        min(colours, 2**bits if bits else 0),
        entry,
        masks,
        pixels_at,
    )
    _check_room(header, len(data) - pixels_at)
    return header


def _check(width: int, height: int, planes: int, bits: int, across: int, down: int) -> None:
    if width <= 0 or height == 0:
        raise Refusal(f"it is said to be {width} x {height} pixels; both must be positive: save the file anew")
    if width * abs(height) > MOST_PIXELS:
        raise Refusal(f"it is said to be {width} x {abs(height)} pixels; at most {MOST_PIXELS:,} can be opened: cut it")
    if planes != 1:
        raise Refusal(f"it is said to have {planes} planes, where BMP has one; save the file anew")
    if bits and bits not in DEPTHS:
        raise Refusal(
            f"it is said to have {bits} bits a pixel; {', '.join(map(str, DEPTHS))} can be read: save it anew"
        )
    if across > 0 and down > 0 and max(across, down) > 1000 * min(across, down):
        raise Refusal(f"its density of {across} x {down} pixels per metre cannot be; save the file anew")


def _compression(method: int, size: int, bits: int) -> str:
    found = {0: "none", 1: "rle8", 2: "rle4", 3: "bit fields", 4: "jpeg", 5: "png", 6: "bit fields"}.get(method)
    if size in _OS2 or (size == 40 and (method, bits) in ((3, 1), (4, 24))):
        found = {3: "huffman", 4: "rle24"}.get(method, found if method < 3 else None)
    if found is None:
        raise Refusal(f"its compression, number {method}, is unknown; save it without")
    fits = bits == _RUNS[found] if found in _RUNS else bits in (16, 32) if found == "bit fields" else True
    if not fits or ((bits == 0) != (found in ("jpeg", "png")) and not (bits and found in ("jpeg", "png"))):
        raise Refusal(f"{found} does not go with {bits} bits a pixel; save the file anew")
    return found


def _masks(words: tuple[int, ...], bits: int, at: int) -> Masks:
    red, green, blue, alpha = (*words, 0)[:4]
    together = 0
    for mask in (red, green, blue, alpha):
        low = mask & -mask
        if mask & together or mask >> bits or (mask and (mask // low) & (mask // low + 1)):
            raise Refusal(f"byte {at}: the masks of its bit fields overlap, have gaps or are too wide; save it anew")
        together |= mask
    if not red | green | blue:
        raise Refusal(f"byte {at}: the masks of its bit fields are empty; save the file anew")
    return red, green, blue, alpha


def _check_room(header: Header, room: int) -> None:
    if header.compression in ("none", "bit fields"):
        needed = pitch_of(header.width, header.bits) * header.height
        if room < needed:
            raise Refusal(f"its pixels take {needed:,} bytes, {room:,} are there; the file is cut short: get it anew")
    elif header.compression in _RUNS:
        if header.top_down:
            raise Refusal("run-length code cannot be stored from the top down; save the file anew")
        pixels = header.width * header.height
        if pixels > 2**22 and pixels > _PER_BYTE * room:
            raise Refusal(f"{room:,} bytes cannot hold its {header.width} x {header.height} pixels; get the file anew")


def palette_rows(data: bytes, header: Header) -> Bytes:
    """(colours, 4) RGBA, opaque; the file has blue, green, red and, but for OS/2 1, a byte that means nothing."""
    import numpy as np

    stored = np.frombuffer(data, np.uint8, header.colours * header.entry, header.palette_at)
    palette = np.full((header.colours, 4), 255, np.uint8)
    palette[:, :3] = stored.reshape(-1, header.entry)[:, 2::-1]
    return palette
