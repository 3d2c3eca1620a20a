"""Project files: a zip of document.json, the assets that the document refers to, and a picture of it.

Nothing in a file from outside is believed: neither its sizes, nor its names, nor its numbers.
"""

from __future__ import annotations

import json
import os
import re
import zipfile
from collections.abc import Callable
from typing import Any, BinaryIO

from ..document.document import Document
from ..document.errors import Refusal
from ..document.outlines import Lettering
from ..document.project_font import ProjectFont, font_named
from ..document.table import from_table, to_table
from ..document.tree import walk
from .archive import allowance, member, members_of, open_archive, unpacked
from .assets import AssetStore, default_store, is_sha, references
from .disk import one_line, reason_of, replace_file

FORMAT = 7
MIGRATIONS: dict[int, Callable[[dict[str, Any]], dict[str, Any]]] = {
    1: lambda table: table,  # 2 added sets of parameters and sections, which may be missing
    2: lambda table: table,  # 3 added curves, what is made of them, and outlines that stand by themselves
    3: lambda table: table,  # 4 added the project's fonts
    4: lambda table: table,  # 5 added materials, mappings, lights and shading
    5: lambda table: table,  # 6 added crease angles
    6: lambda table: table,  # 7 added checks and motions
}
"""For each older format the function that makes its table one of the next format."""

DOCUMENT, THUMBNAIL, ASSETS = "document.json", "thumbnail.png", "assets/"
MAX_DOCUMENT = 200_000_000
MAX_ASSETS = 2_000_000_000
MAX_VALUES = 8_000_000  # of JSON; each costs some 60 bytes of memory


def save_project(
    document: Document,
    path: str | os.PathLike[str],
    thumbnail: bytes | None = None,
    store: AssetStore | None = None,
) -> None:
    """Writes the document and its assets to `path`, wholly or not at all. Equal documents make equal bytes.

    Installed fonts are noted with their version, by which another computer tells whether it has the same.
    `thumbnail` is a PNG file. Raises Refusal; the file that was there is then untouched.
    """
    store = store or default_store()
    table = {**to_table(with_versions(document)), "format": FORMAT}
    text = json.dumps(table, sort_keys=True, indent=2, ensure_ascii=False, allow_nan=False)
    assets = references(document)

    def write(stream: BinaryIO) -> None:
        with zipfile.ZipFile(stream, "w", allowZip64=True) as archive:
            # Half of a surrogate pair, as broken input methods leave it in names, has no UTF-8.
            archive.writestr(member(DOCUMENT, zipfile.ZIP_DEFLATED), text.encode("utf-8", "replace") + b"\n")
            for sha in sorted(assets):
                try:
                    data = store.read(sha)
                except Refusal as refusal:
                    raise Refusal(f"cannot be written: {assets[sha]}: {refusal}") from None
                archive.writestr(member(ASSETS + sha), data)
            if thumbnail is not None:
                archive.writestr(member(THUMBNAIL), thumbnail)

    replace_file(path, write)


def with_versions(document: Document) -> Document:
    """With the version of each installed font that lettering names, where none is noted yet."""
    names = {node.font for node in walk(*document.roots) if isinstance(node, Lettering) and not node.asset}
    new = []
    for name in sorted(names):
        if font_named((*document.fonts, *new), name) is None:
            from ..lettering.fonts.library import version_of

            found = version_of(name)
            if found is not None:
                new.append(ProjectFont(name, *found))
    return document.with_(fonts=(*document.fonts, *new)) if new else document


def open_project(path: str | os.PathLike[str], store: AssetStore | None = None) -> Document:
    """The document of a project file; its assets are put into the store. Raises Refusal."""
    try:
        with open(path, "rb") as stream:
            return _open(stream, store)
    except OSError as error:
        raise Refusal(reason_of(error)) from None


def _open(stream: BinaryIO, store: AssetStore | None) -> Document:
    try:
        archive = open_archive(stream)
    except Refusal as refusal:
        raise Refusal(f"is no Solidtree project: {refusal}") from None
    with archive:
        members = members_of(archive)
        most = allowance(stream)
        if DOCUMENT not in members:
            raise Refusal(f"is no Solidtree project: it holds no {DOCUMENT}")
        data = b"".join(unpacked(archive, members[DOCUMENT], min(MAX_DOCUMENT, most)))
        document = from_json(data)
        _keep_assets(archive, members, references(document), store or default_store(), min(MAX_ASSETS, most))
    return document


def _keep_assets(
    archive: zipfile.ZipFile, members: dict[str, zipfile.ZipInfo], wanted: dict[str, str], store: AssetStore, most: int
) -> None:
    left = most
    for sha, what in wanted.items():
        if not is_sha(sha):
            raise Refusal(f"{what}: {sha!r:.60} names no asset; an asset's name is 64 hexadecimal digits")
        info = members.pop(ASSETS + sha, None)
        if info is None:
            if store.has(sha):  # kept already, by another file
                continue
            raise Refusal(f"{what}: its file {ASSETS}{sha[:12]}… is missing from the file")
        try:
            store.put_chunks(unpacked(archive, info, left), sha)
        except Refusal as refusal:
            raise Refusal(f"{what}: {refusal}") from None
        left -= store.path(sha).stat().st_size


def from_json(data: bytes) -> Document:
    """The document of the bytes of a document.json. Raises Refusal."""
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise Refusal(f"{DOCUMENT}, line {line}: byte {error.start} is not UTF-8") from None
    values = data.count(b",") + data.count(b"[") + data.count(b"{")
    if values > MAX_VALUES:
        raise Refusal(f"{DOCUMENT} holds more than {MAX_VALUES:,} values, which is more than is read")

    def no_number(constant: str) -> None:
        found = re.search(rf"(?<=[\s:,\[]){re.escape(constant)}(?=[\s,\]}}])", text)
        line = text.count("\n", 0, found.start()) + 1 if found else 1
        raise Refusal(f"{DOCUMENT}, line {line}: {constant} is no number; every number must be finite")

    try:
        table = json.loads(text, parse_constant=no_number, object_pairs_hook=_object)
    except json.JSONDecodeError as error:
        raise Refusal(f"{DOCUMENT}, line {error.lineno}, column {error.colno}: {error.msg.lower()}") from None
    except RecursionError:
        raise Refusal(f"{DOCUMENT} is nested too deeply; Solidtree writes its nodes as a flat table") from None
    except ValueError:
        raise Refusal(f"{DOCUMENT} holds a number of more than 4,300 digits") from None
    try:
        return from_table(_migrated(table))
    except Refusal as refusal:
        raise Refusal(one_line(f"{DOCUMENT}: {refusal}")) from None


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    result = dict(pairs)
    if len(result) < len(pairs):
        seen: set[str] = set()
        twice = next(key for key, _ in pairs if key in seen or seen.add(key))
        raise Refusal(f"{DOCUMENT}: the key {twice!r:.60} stands twice in one object")
    return result


def _migrated(table: Any) -> dict[str, Any]:
    if not isinstance(table, dict):
        raise Refusal("the outermost value must be an object")
    version = table.pop("format", None)
    if type(version) is not int or version < 1:
        raise Refusal(f"“format” must be a whole number from 1, not {version!r:.60}")
    if version > FORMAT:
        raise Refusal(f"was written by a newer Solidtree (format {version}); this one reads up to {FORMAT}: update it")
    for older in range(version, FORMAT):
        table = MIGRATIONS[older](table)
    return table
