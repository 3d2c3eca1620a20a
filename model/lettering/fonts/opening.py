"""A font file opened: which format it is, which face of a collection, and what is refused before it is read."""

from __future__ import annotations

import os
import struct
import zlib
from io import BytesIO
from pathlib import Path as FilePath

from ...document.errors import Refusal
from ...project.disk import reason_of
from .face import Face
from .failing import failing

LARGEST = 64 * 2**20
"""Bytes of a font file that is opened, and of its tables together when they are packed."""
SFNT = (b"\0\1\0\0", b"OTTO", b"true", b"ttcf", b"wOFF")


def read_font(path: str | os.PathLike[str], number: int = 0) -> Face:
    """The face of a font file; `number` of a collection's, from 0. Raises Refusal."""
    try:
        return open_face(font_bytes(path), number)
    except Refusal as refusal:
        raise Refusal(f"{FilePath(path).name}: {refusal}") from None


def font_bytes(path: str | os.PathLike[str]) -> bytes:
    """What is in a font file. Raises Refusal for one too large, or that cannot be read."""
    file = FilePath(path)
    try:
        if file.stat().st_size > LARGEST:
            raise Refusal(f"larger than {LARGEST >> 20} MB: no font is")
        return file.read_bytes()
    except OSError as error:
        raise Refusal(reason_of(error)) from None


def open_face(data: bytes, number: int = 0) -> Face:
    """A face from the bytes of a font file. Raises Refusal."""
    if len(data) > LARGEST:
        raise Refusal(f"larger than {LARGEST >> 20} MB: no font is")
    if data[:4] in SFNT:
        if not 0 <= number < face_count(data):
            raise Refusal(f"the file has no face {number}: they are 0 to {face_count(data) - 1}")
        if data[:4] == b"wOFF":
            _check_packed(data)
        else:
            _check_tables(data, number)
        from .sfnt_face import SfntFace

        return SfntFace(data, number)
    if data[:4] == b"wOF2":
        raise Refusal("a WOFF2 font for the web: convert it to TTF or OTF first")
    if data[:2] in (b"%!", b"\x80\x01") or data[6:8] == b"%!":
        if b"%!PS-TrueTypeFont" in data[:64] or b"/FontType 42" in data[:4096]:
            raise Refusal("a Type 42 font (TrueType inside PostScript): open the TrueType file instead")
        from .type1_face import Type1Face

        return Type1Face(data)
    raise Refusal("not a font: TTF, OTF, TTC, WOFF, PFA and PFB files are")


RESTRICTED = 0x0002
"""Of a font's embedding bits (fsType of OS/2): it may not go with documents at all."""


def check_embedding(data: bytes, number: int = 0) -> None:
    """Raises Refusal for a font whose licence bits forbid that a project carries it."""
    if data[:4] not in SFNT:
        return
    from fontTools.ttLib import TTFont

    with failing("the font cannot be read"), TTFont(BytesIO(data), fontNumber=number, lazy=True) as font:
        bits = int(getattr(font["OS/2"], "fsType", 0)) if "OS/2" in font else 0
    if bits & 0x000F == RESTRICTED:  # a milder bit beside it allows more
        raise Refusal(
            "its licence bits forbid that documents carry it: install it on this computer and choose it by its name"
        )


def face_count(data: bytes) -> int:
    """How many faces a file has: more than one where it is a collection."""
    if data[:4] != b"ttcf":
        return 1
    count = int.from_bytes(data[8:12], "big")
    if len(data) < 12 + 4 * count:
        raise Refusal("the font is damaged: it ends in its header")
    return count


def _check_tables(data: bytes, number: int) -> None:
    """Raises Refusal where a table lies beyond the end of the file."""
    begin = struct.unpack(">I", data[12 + 4 * number : 16 + 4 * number])[0] if data[:4] == b"ttcf" else 0
    try:
        count = struct.unpack(">H", data[begin + 4 : begin + 6])[0]
        rows = range(begin + 12, begin + 12 + 16 * count, 16)
        tables = [struct.unpack(">4sIII", data[row : row + 16]) for row in rows]
    except struct.error:
        raise Refusal("the font is damaged: it ends in its header") from None
    for tag, _, offset, length in tables:
        if offset + length > len(data):
            raise Refusal(f"the font is damaged: its table {_word(tag)} lies beyond its end")


def _word(tag: bytes) -> str:
    return tag.decode("latin-1").strip() if tag.strip().isalnum() else repr(tag)[1:]


def _check_packed(data: bytes) -> None:
    """Unpack each table of a WOFF file no further than it says it is long."""
    try:
        count = struct.unpack(">H", data[12:14])[0]
        tables = [struct.unpack(">4sIIII", data[44 + 20 * k : 64 + 20 * k]) for k in range(count)]
    except struct.error:
        raise Refusal("the font is damaged: it ends in its header") from None
    if sum(length for _, _, _, length, _ in tables) > LARGEST:
        raise Refusal(f"its tables take more than {LARGEST >> 20} MB: no font's do")
    for tag, offset, packed, length, _ in tables:
        if packed < length:
            unpacker = zlib.decompressobj()
            try:
                unpacker.decompress(data[offset : offset + packed], length + 1)
            except zlib.error:
                raise Refusal(f"the font is damaged: its table {_word(tag)} cannot be unpacked") from None
            if not unpacker.eof:
                raise Refusal(f"the font is damaged: its table {_word(tag)} is longer than it says")
