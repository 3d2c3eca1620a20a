"""Huffman code of black and white rows: ITU-T T.4 (fax group 3), one-dimensional, as OS/2 bitmaps have it."""

from __future__ import annotations

from functools import cache

import numpy as np

from ..document.errors import Refusal
from .bitmap import Bytes

_WHITE = """
00110101 000111 0111 1000 1011 1100 1110 1111 10011 10100 00111 01000 001000 000011 110100 110101 101010 101011
0100111 0001100 0001000 0010111 0000011 0000100 0101000 0101011 0010011 0100100 0011000 00000010 00000011 00011010
00011011 00010010 00010011 00010100 00010101 00010110 00010111 00101000 00101001 00101010 00101011 00101100 00101101
00000100 00000101 00001010 00001011 01010010 01010011 01010100 01010101 00100100 00100101 01011000 01011001 01011010
01011011 01001010 01001011 00110010 00110011 00110100 11011 10010 010111 0110111 00110110 00110111 01100100 01100101
01101000 01100111 011001100 011001101 011010010 011010011 011010100 011010101 011010110 011010111 011011000
011011001 011011010 011011011 010011000 010011001 010011010 011000 010011011
"""
"""Codes of 0 to 63 white pixels, then of 64, 128, ... 1728 (T.4, tables 2 and 3a)."""

_BLACK = """
0000110111 010 11 10 011 0011 0010 00011 000101 000100 0000100 0000101 0000111 00000100 00000111 000011000
0000010111 0000011000 0000001000 00001100111 00001101000 00001101100 00000110111 00000101000 00000010111 00000011000
000011001010 000011001011 000011001100 000011001101 000001101000 000001101001 000001101010 000001101011 000011010010
000011010011 000011010100 000011010101 000011010110 000011010111 000001101100 000001101101 000011011010 000011011011
000001010100 000001010101 000001010110 000001010111 000001100100 000001100101 000001010010 000001010011 000000100100
000000110111 000000111000 000000100111 000000101000 000001011000 000001011001 000000101011 000000101100 000001011010
000001100110 000001100111 0000001111 000011001000 000011001001 000001011011 000000110011 000000110100 000000110101
0000001101100 0000001101101 0000001001010 0000001001011 0000001001100 0000001001101 0000001110010 0000001110011
0000001110100 0000001110101 0000001110110 0000001110111 0000001010010 0000001010011 0000001010100 0000001010101
0000001011010 0000001011011 0000001100100 0000001100101
"""

_LONG = """
00000001000 00000001100 00000001101 000000010010 000000010011 000000010100 000000010101 000000010110 000000010111
000000011100 000000011101 000000011110 000000011111
"""
"""Of either colour: 1792, 1856, ... 2560 (table 3b)."""

_LONGEST = 13


@cache
def _runs(codes: str) -> list[tuple[int, int]]:
    """For every 13 bits (length of the run, bits of its code); no bits where no code begins so."""
    found = [(0, 0)] * 2**_LONGEST
    for number, code in enumerate((codes + _LONG).split()):
        free = _LONGEST - len(code)
        start = int(code, 2) << free
        found[start : start + 2**free] = [(number if number < 64 else 64 * (number - 63), len(code))] * 2**free
    return found


def fax_rows(data: bytes, width: int, height: int) -> Bytes:
    """Samples (height, width), 0 for white runs, 1 for black.

    The bits fill each byte from the highest; codes for ends of lines may stand or not.
    Refused: code that is none, a row that is too long, code that ends before the last row.
    """
    tables = _runs(_WHITE), _runs(_BLACK)
    samples = np.zeros((height, width), np.uint8)
    at, end = 0, 8 * len(data)
    for y in range(height):
        at = _after_line_end(data, at)
        x = black = run = 0
        while x < width or run >= 64:  # a long code is followed by a short one, even of 0
            first = at >> 3
            bits = int.from_bytes(data[first : first + 3].ljust(3, b"\0"), "big") >> (11 - (at & 7)) & 0x1FFF
            run, length = tables[black][bits]
            if at + length > end or at >= end:
                raise Refusal(f"the Huffman code ends in row {y} of {height}; the file is cut short")
            if not length:
                raise Refusal(f"the Huffman code has no meaning at its byte {first}, in row {y}; save the file anew")
            if x + run > width:
                raise Refusal(f"a run of {run} pixels leaves row {y} at byte {first} of the Huffman code; save it anew")
            at += length
            if black:
                samples[y, x : x + run] = 1
            x += run
            if run < 64:
                black = 1 - black
    return samples


def _after_line_end(data: bytes, at: int) -> int:
    """Past eleven or more zeros and a one, where they stand; else where it was."""
    first = at >> 3
    ahead = int.from_bytes(data[first : first + 3].ljust(3, b"\0"), "big") << (at & 7) & 0xFFFFFF
    if ahead >> 13:
        return at
    place, end = at, 8 * len(data)
    while place < end and not data[place >> 3] >> (7 - (place & 7)) & 1:
        place += 8 if place & 7 == 0 and not data[place >> 3] else 1
    return place + 1
