"""Zip files: written so that equal content makes equal bytes, read without believing what they tell of themselves."""

from __future__ import annotations

import os
import zipfile
import zlib
from collections.abc import Iterator
from pathlib import PurePosixPath, PureWindowsPath
from typing import BinaryIO

from ..document.errors import Refusal

MAX_MEMBERS = 100_000
MAX_RATIO = 300
"""Of unpacked to packed size, where more than FREE bytes are unpacked."""
FREE = 20_000_000
_CHUNK = 1 << 20


def member(name: str, compression: int = zipfile.ZIP_STORED) -> zipfile.ZipInfo:
    """A zip member that says nothing of the time and the machine it was written on."""
    info = zipfile.ZipInfo(name)
    info.compress_type = compression
    info.create_system = 3
    info.external_attr = 0o644 << 16
    return info


def open_archive(stream: BinaryIO) -> zipfile.ZipFile:
    """The zip file of a stream. Raises Refusal."""
    try:
        return zipfile.ZipFile(stream)
    except (zipfile.BadZipFile, ValueError, NotImplementedError, EOFError, OverflowError):
        stream.seek(0)
        if stream.read(4) == b"PK\x03\x04":
            raise Refusal("it is cut short or damaged: the table of contents at its end cannot be read") from None
        raise Refusal("it is not a zip file") from None


def allowance(stream: BinaryIO) -> int:
    """How many bytes a zip file may unpack to before it counts as a bomb."""
    place = stream.tell()
    size = stream.seek(0, os.SEEK_END)
    stream.seek(place)
    return max(FREE, MAX_RATIO * size)


def members_of(archive: zipfile.ZipFile) -> dict[str, zipfile.ZipInfo]:
    """The members by name. Raises Refusal for names that stand twice or lead out of the file."""
    infos = archive.infolist()
    if len(infos) > MAX_MEMBERS:
        raise Refusal(f"is damaged or forged: it holds {len(infos):,} members")
    members: dict[str, zipfile.ZipInfo] = {}
    for info in infos:
        name = info.filename
        if name in members:
            raise Refusal(f"is damaged or forged: it holds {name!r:.80} twice")
        if ".." in PurePosixPath(name).parts or "\\" in name or name.startswith("/") or PureWindowsPath(name).drive:
            raise Refusal(f"is damaged or forged: the name {name!r:.80} leads out of the file")
        members[name] = info
    return members


def unpacked(archive: zipfile.ZipFile, info: zipfile.ZipInfo, most: int) -> Iterator[bytes]:
    """The member's bytes in pieces; `most` is how many there may really be. Raises Refusal."""
    name = info.filename
    if info.flag_bits & 0x1:
        raise Refusal(f"{name} is encrypted; save the file without a password")
    if info.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise Refusal(
            f"{name} is compressed by method {info.compress_type}, which is not read; zip it again with “deflate”"
        )
    left = most
    try:
        with archive.open(info) as packed:
            while chunk := packed.read(_CHUNK):
                left -= len(chunk)
                if left < 0:
                    raise Refusal(f"{name} unpacks to more than {most / 1e6:,.0f} MB, which is more than is read")
                yield chunk
    except (zipfile.BadZipFile, zlib.error, EOFError, ValueError, NotImplementedError):
        raise Refusal(f"{name} is damaged: its packed bytes cannot be unpacked; use a copy of the file") from None
