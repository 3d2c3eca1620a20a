"""Run-length coding of BMP: RLE4, RLE8 (Windows) and RLE24 (OS/2)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..document.errors import Refusal
from .bitmap import Bytes


def expanded(data: bytes, width: int, height: int, bits: int) -> Bytes:
    """Samples of run-length coded rows in stored order (bottom first): (height, width), or (height, width, 3) for 24.

    Pixels that the code skips are 0. Refused: a run past the row's end or the last row, code that ends before the end
    of the bitmap. The time is linear in the code, whatever the header says.
    """
    size = 3 if bits == 24 else 1  # bytes of a sample
    flat = bytearray(width * height * size)
    x = y = at = 0
    end = len(data)
    while True:
        if y >= height and x == 0 and at + 1 >= end:
            break
        if at + 1 >= end:
            raise Refusal(f"the run-length code ends at its byte {at}, in row {y} of {height}; the file is cut short")
        count, value = data[at], data[at + 1]
        at += 2
        if count:
            if bits == 24:
                colour = data[at - 1 : at + 2]
                at += 2
                run = colour * count
            elif bits == 8:
                run = bytes((value,)) * count
            else:
                run = (bytes((value >> 4, value & 15)) * ((count + 1) // 2))[:count]
        elif value == 0:
            x, y = 0, y + 1
            continue
        elif value == 1:
            break
        elif value == 2:
            if at + 2 > end:
                raise Refusal(f"the run-length code ends at its byte {at}, within a skip; the file is cut short")
            x, y = x + data[at], y + data[at + 1]
            at += 2
            if x > width or y > height:
                raise Refusal(f"the run-length code skips out of the picture at its byte {at - 4}: save the file anew")
            continue
        else:
            count = value
            if bits == 4:
                pairs = data[at : at + (count + 1) // 2]
                run = bytes(nibble for pair in pairs for nibble in (pair >> 4, pair & 15))[:count]
                at += (len(pairs) + 1) // 2 * 2
            else:
                run = data[at : at + count * size]
                at += (count * size + 1) // 2 * 2
        if len(run) != count * size:
            raise Refusal(f"the run-length code ends within a run of row {y}; the file is cut short")
        if y >= height or x + count > width:
            raise Refusal(f"a run at byte {at} of the run-length code leaves row {y} of {height}: save the file anew")
        start = (y * width + x) * size
        flat[start : start + len(run)] = run
        x += count
    shape = (height, width, 3) if bits == 24 else (height, width)
    return np.frombuffer(flat, np.uint8).reshape(shape)


def coded(samples: NDArray[np.unsignedinteger], bits: int) -> bytes:
    """RLE4 or RLE8 of samples (height, width) in stored order, runs of equal pixels and stretches as they are."""
    out = bytearray()
    for row in samples.astype(np.uint8):
        starts = np.concatenate([[0], np.flatnonzero(np.diff(row)) + 1, [len(row)]])
        loose: list[int] = []
        for start, length in zip(starts[:-1].tolist(), np.diff(starts).tolist(), strict=True):
            value = int(row[start])
            if length < 3:
                loose += [value] * length
                continue
            _write_loose(out, loose, bits)
            loose = []
            twice = value if bits == 8 else value * 17
            while length:
                out += bytes((min(length, 255), twice))
                length -= min(length, 255)
        _write_loose(out, loose, bits)
        out += b"\0\0"
    return bytes(out[:-2] + b"\0\1")


def _write_loose(out: bytearray, values: list[int], bits: int) -> None:
    """Pixels as they are; fewer than three have no such form and become runs of one."""
    for start in range(0, len(values), 252):
        part = values[start : start + 252]
        if len(part) < 3:
            for value in part:
                out += bytes((1, value if bits == 8 else value * 16))
            continue
        out += bytes((0, len(part)))
        if bits == 4:
            even = part + [0] * (len(part) % 2)
            data = bytes(high * 16 + low for high, low in zip(even[::2], even[1::2], strict=True))
        else:
            data = bytes(part)
        out += data + b"\0" * (len(data) % 2)
