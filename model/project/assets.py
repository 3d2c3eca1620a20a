"""Imported files as they came, kept once each under their SHA-256, where every process of the program finds them."""

from __future__ import annotations

import atexit
import contextlib
import hashlib
import os
import re
import secrets
import shutil
import tempfile
from collections.abc import Iterable
from pathlib import Path

from ..document.document import Document
from ..document.errors import Refusal
from ..document.nodes import Displace
from ..document.outlines import Lettering
from ..document.primitives import ImportedMesh, Relief
from ..document.tree import walk
from .disk import reason_of

CARRIERS = (ImportedMesh, Relief, Displace, Lettering)
"""The kinds of nodes that refer to an asset."""
_SHA = re.compile(r"[0-9a-f]{64}")


def is_sha(text: str) -> bool:
    """Whether `text` is a SHA-256 as assets are called by."""
    return _SHA.fullmatch(text) is not None


class AssetStore:
    """A folder of files named by the SHA-256 of their content. Several processes may use it at once."""

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = Path(folder)

    def path(self, sha: str) -> Path:
        """Where the asset lies, or would lie. Raises Refusal for what is no SHA-256."""
        if not is_sha(sha):
            raise Refusal(f"{sha!r:.60} names no asset; an asset's name is 64 hexadecimal digits")
        return self.folder / sha

    def has(self, sha: str) -> bool:
        return is_sha(sha) and self.path(sha).is_file()

    def put(self, data: bytes) -> str:
        """Keeps `data` and returns its SHA-256. Raises Refusal."""
        sha = hashlib.sha256(data).hexdigest()
        return sha if self.has(sha) else self.put_chunks([data])

    def put_chunks(self, chunks: Iterable[bytes], wanted: str | None = None) -> str:
        """Keeps what the chunks make up and returns its SHA-256. Raises Refusal, also where it is not `wanted`."""
        temporary = self.folder / f".{secrets.token_hex(8)}.part"
        digest = hashlib.sha256()
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            with open(temporary, "xb") as stream:
                for chunk in chunks:
                    digest.update(chunk)
                    stream.write(chunk)
            sha = digest.hexdigest()
            if wanted is not None and sha != wanted:
                raise Refusal(f"its bytes have the SHA-256 {sha[:12]}…, so it is not the file that was stored")
            os.replace(temporary, self.path(sha))
        except OSError as error:
            raise Refusal(f"the imported file cannot be kept in {self.folder}: {reason_of(error)}") from None
        finally:
            with contextlib.suppress(OSError):
                temporary.unlink(missing_ok=True)
        return sha

    def read(self, sha: str) -> bytes:
        """The asset's bytes. Raises Refusal where they are missing or are no longer what they were."""
        path = self.path(sha)
        try:
            data = path.read_bytes()
        except OSError as error:
            raise Refusal(
                f"the imported file {sha[:12]}… cannot be read: {reason_of(error)}; import it again"
            ) from None
        if hashlib.sha256(data).hexdigest() != sha:
            raise Refusal(f"the imported file {sha[:12]}… has changed on the disk; import it again")
        return data


_current: AssetStore | None = None


def default_store() -> AssetStore:
    """The store of this process: the one given to `use_store`, else a temporary folder that goes with the process."""
    global _current
    if _current is None:
        folder = tempfile.mkdtemp(prefix="solidtree-assets-")
        owner = os.getpid()

        def remove() -> None:
            if os.getpid() == owner:  # a forked child leaves the folder to its parent
                shutil.rmtree(folder, ignore_errors=True)

        atexit.register(remove)
        _current = AssetStore(folder)
    return _current


def use_store(folder: str | os.PathLike[str]) -> AssetStore:
    """Makes this process use the store of another one."""
    global _current
    _current = AssetStore(folder)
    return _current


def references(document: Document) -> dict[str, str]:
    """The SHA-256 of every asset that the document refers to, and words for what refers to it first."""
    found: dict[str, str] = {}
    for node in walk(*document.roots):
        if isinstance(node, CARRIERS) and node.asset:
            found.setdefault(node.asset, f"node {node.id} (“{node.label}”)")
    for font in document.fonts:
        if font.asset:
            found.setdefault(font.asset, f"the font “{font.name}”")
            found.setdefault(font.base, f"the font “{font.name}”")
    for material in document.materials:
        for sha in material.bitmaps:
            found.setdefault(sha, f"the material “{material.name}”")
    return found


def assets_of(document: Document) -> set[str]:
    """The SHA-256 of every asset that the document refers to."""
    return set(references(document))
