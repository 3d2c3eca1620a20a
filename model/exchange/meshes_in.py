"""Foreign files as documents: which reader a file needs, by its content first, and the parts that it holds."""

from __future__ import annotations

import os
import re
import threading
import warnings
import zipfile
from collections import OrderedDict
from collections.abc import Callable
from pathlib import Path

from ..document.document import Document
from ..document.errors import Refusal
from ..document.primitives import ImportedMesh
from ..document.tree import unique_name
from ..image.pictures import FORMATS as PICTURES
from ..image.pictures import is_bitmap
from ..project.assets import AssetStore, default_store
from ..project.disk import one_line, read_whole, reason_of
from ..project.project_file import open_project
from .drawings import drawings_in
from .gltf import read_gltf
from .obj import Fetch, read_obj
from .off import HEADER, read_off
from .parts import Part
from .ply import read_ply
from .stl import is_binary, read_stl
from .threemf import read_3mf

MAX_BYTES = 1_000_000_000
PROJECT = ".solidtree"
FORMATS: dict[str, tuple[str, Callable[[bytes], list[Part]]]] = {
    "stl": ("STL", read_stl),
    "3mf": ("3MF", read_3mf),
    "obj": ("OBJ", read_obj),
    "ply": ("PLY", read_ply),
    "off": ("OFF", read_off),
    "glb": ("GLB", read_gltf),
    "gltf": ("glTF", read_gltf),
}
"""By ending: what the format is called and what reads it."""
DRAWINGS = ("svg", "svgz", "dxf")
UNFORESEEN = "is damaged in a way that this program did not foresee; save it again with the program that made it"
_HEAD = 4096


def read_mesh_file(source: str | os.PathLike[str] | bytes, file_format: str) -> tuple[Part, ...]:
    """The solids of a mesh file, given by its path or its bytes, in file order. Raises Refusal.

    The parts are in millimetres with z up: the units of 3MF, and the metres and the upward y of GLB, are converted.
    """
    fetch = None
    if not isinstance(source, bytes):
        fetch = _beside(Path(source))
        source = read_whole(source, MAX_BYTES)
    return _read(source, file_format, fetch)


def _read(data: bytes, file_format: str, fetch: Fetch | None = None) -> tuple[Part, ...]:
    if file_format not in FORMATS:
        raise Refusal(f"{file_format[:20]!r} is no format that can be read; known are {', '.join(FORMATS)}")
    title, reader = FORMATS[file_format]
    blank = b"\0 \t\r\n"
    if not data[:_HEAD].strip(blank) and not data.strip(blank):
        raise Refusal(f"is empty, no {title} file")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            parts = read_obj(data, fetch) if file_format == "obj" else reader(data)
    except Refusal as refusal:
        raise Refusal(one_line(str(refusal))) from None
    except MemoryError:
        raise Refusal("needs more memory to be read than there is") from None
    except (ValueError, LookupError, TypeError, AttributeError, ArithmeticError, RecursionError):
        raise Refusal(UNFORESEEN) from None
    if not any(len(part.triangles) for part in parts):
        raise Refusal(f"holds no triangles, so there is no solid in this {title} file")
    return tuple(part for part in parts if len(part.triangles))


def _beside(path: Path) -> Fetch:
    def fetch(name: str) -> bytes | None:
        # Only from the file's own folder: whoever wrote the name may not choose what of this computer is read.
        try:
            return read_whole(path.parent / Path(name.replace("\\", "/")).name, 16_000_000)
        except (Refusal, ValueError):
            return None

    return fetch


def format_of(data: bytes, ending: str) -> str | None:
    """The format of a mesh file by its content, else by its ending (with or without a dot, any case); None: unknown."""
    head = data[:_HEAD].lstrip(b"\xef\xbb\xbf \t\r\n")
    ending = ending.lower().removeprefix(".")
    if data[:4] == b"PK\x03\x04":
        return "3mf"
    if data[:4] == b"glTF":
        return "glb"
    if re.match(rb"ply\s*\n", data[:_HEAD]):
        return "ply"
    if HEADER.match(head):
        return "off"
    if is_binary(data) or (head[:5].lower() == b"solid" and b"facet" in head.lower()):
        return "stl"
    if head[:1] == b"{" and b'"asset"' in data[: 1 << 20]:
        return "gltf"
    return ending if ending in FORMATS else None


def read_any(path: str | os.PathLike[str], store: AssetStore | None = None) -> Document:
    """The document of a project file, of any mesh file or of a drawing. Raises Refusal."""
    return open_project(path, store) if _is_project(path) else import_file(path, store)


def _is_project(path: str | os.PathLike[str]) -> bool:
    named = Path(path).suffix.lower() == PROJECT
    try:
        with open(path, "rb") as stream:
            if stream.read(4) != b"PK\x03\x04":
                return named
            with zipfile.ZipFile(stream) as archive:
                names = set(archive.namelist())
                return "document.json" in names or (named and "[Content_Types].xml" not in names)
    except OSError as error:
        raise Refusal(reason_of(error)) from None
    except (zipfile.BadZipFile, ValueError, NotImplementedError, EOFError, OverflowError):
        return named


def import_file(path: str | os.PathLike[str], store: AssetStore | None = None) -> Document:
    """A document that holds each solid of a mesh file as an imported mesh, or each shape of a drawing as an outline.

    The mesh file itself is kept; of a drawing the curves. A bitmap becomes a relief. Raises Refusal.
    """
    path = Path(path)
    store = store or default_store()
    data = read_whole(path, MAX_BYTES)
    file_format = format_of(data, path.suffix)
    if file_format is None:
        drawing_format = drawings_in.format_of(data, path.suffix)
        if drawing_format is not None:
            return _drawing(data, drawing_format, path.stem)
        if is_bitmap(data):
            return _relief(path, data, store)
        known = ", ".join((PROJECT, *(f".{ending}" for ending in (*FORMATS, *DRAWINGS)), *PICTURES))
        raise Refusal(f"is of no kind that can be opened; known are {known}" if data else "is empty")
    parts = _read(data, file_format, _beside(path))
    sha = store.put(data)
    _remember((sha, file_format), parts)
    taken: list[str] = []
    for part in parts:
        taken.append(unique_name(part.name or path.stem, taken))
    return Document(
        solids=tuple(
            ImportedMesh(
                id=f"n{i}",
                name=name,
                colour=part.colour,
                note=part.note,
                asset=sha,
                file_format=file_format,
                part=i - 1,
            )
            for i, (name, part) in enumerate(zip(taken, parts, strict=True), 1)
        )
    )


def _relief(path: Path, data: bytes, store: AssetStore) -> Document:
    from ..document.primitives import Relief
    from ..image.pictures import read_bitmap

    read_bitmap(path)
    return Document(solids=(Relief(id="n1", name=path.stem, asset=store.put(data)),))


_CACHE_BYTES = 256_000_000
_cache: OrderedDict[tuple[str, str], tuple[Part, ...]] = OrderedDict()
_lock = threading.Lock()


def _drawing(data: bytes, drawing_format: str, name: str) -> Document:
    from .drawings.outlines_in import document_of_drawing

    if len(data) > drawings_in.MAX_BYTES:
        raise Refusal(f"has {len(data):,} bytes; of drawings at most {drawings_in.MAX_BYTES:,} are read")
    return document_of_drawing(drawings_in.read_data(data, drawing_format, None), name)


def parts_of_asset(sha: str, file_format: str, store: AssetStore | None = None) -> tuple[Part, ...]:
    """The parts of a kept mesh file; those read last are remembered. Raises Refusal."""
    key = (sha, file_format)
    with _lock:
        if key in _cache:
            _cache.move_to_end(key)
            return _cache[key]
    parts = _read((store or default_store()).read(sha), file_format)
    _remember(key, parts)
    return parts


def _remember(key: tuple[str, str], parts: tuple[Part, ...]) -> None:
    with _lock:
        _cache[key] = parts
        _cache.move_to_end(key)
        sizes = [sum(part.vertices.nbytes + part.triangles.nbytes for part in kept) for kept in _cache.values()]
        total = sum(sizes)
        for size in sizes[:-1]:
            if total <= _CACHE_BYTES:
                break
            _cache.popitem(last=False)
            total -= size
