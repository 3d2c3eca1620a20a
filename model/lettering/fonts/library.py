"""The fonts that lettering can be set in: bundled with the program, installed on this computer, or in a project."""

from __future__ import annotations

import hashlib
import os
import re
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files
from pathlib import Path

from ...document.errors import Refusal
from ...project.assets import default_store
from .edited_face import MARK, EditedFace, glyphs_from_bytes
from .face import PLAIN, Face, name_of
from .failing import failing
from .opening import SFNT, check_embedding, face_count, font_bytes, open_face, read_font
from .type1_face import style_of

BUNDLED = ("DejaVuSans.ttf", "GFSDidot.otf")
STANDARD = "DejaVu Sans"
"""The font of new lettering, and the first in which a character is looked for that the chosen one lacks."""
ENDINGS = (".ttf", ".otf", ".ttc", ".otc", ".pfa", ".pfb", ".t1", ".woff")
"""Of font files."""
HEADER = 32768
"""Bytes of a Type 1 font in which its names stand."""
_SAID = re.compile(rb"/(FamilyName|FullName|Weight)\s*\(([^()]*)\)")
OPEN = 24
"""Faces that are kept open at a time."""


@dataclass(frozen=True, slots=True)
class FontFile:
    """Where a face lies, and what it is called."""

    path: Path
    number: int
    family: str
    style: str

    @property
    def name(self) -> str:
        return name_of(self.family, self.style)


def folders() -> list[Path]:
    """Where this system keeps its fonts, the user's own first."""
    home = Path.home()
    if sys.platform == "win32":
        local, windows = os.environ.get("LOCALAPPDATA"), os.environ.get("WINDIR", r"C:\Windows")
        return [*([Path(local, "Microsoft", "Windows", "Fonts")] if local else []), Path(windows, "Fonts")]
    if sys.platform == "darwin":
        return [home / "Library/Fonts", Path("/Library/Fonts"), Path("/System/Library/Fonts")]
    data = Path(os.environ.get("XDG_DATA_HOME") or home / ".local/share")
    shared = (os.environ.get("XDG_DATA_DIRS") or "/usr/local/share:/usr/share").split(":")
    return [data / "fonts", home / ".fonts", *(Path(one, "fonts") for one in shared if one)]


@lru_cache(maxsize=1)
def installed() -> tuple[FontFile, ...]:
    """Every face of the bundled and the installed fonts, by name; files that cannot be read are left out."""
    found: dict[str, FontFile] = {}
    for path in (*_bundled(), *_files(folders())):
        for face in _names_in(path):
            found.setdefault(face.name.casefold(), face)
    return tuple(sorted(found.values(), key=lambda face: face.name.casefold()))


def find(name: str) -> FontFile | None:
    """The face of that name; a family alone is its regular style. Upper and lower case are the same."""
    wanted = " ".join(name.split()).casefold()
    for path in _bundled():  # without a look at all that is installed
        for face in _names_in(path):
            if wanted in (face.name.casefold(), face.family.casefold()):
                return face
    faces = installed()
    exact = next((face for face in faces if face.name.casefold() == wanted), None)
    if exact is not None:
        return exact
    family = [face for face in faces if face.family.casefold() == wanted]
    return min(family, key=lambda face: (face.style.casefold() not in (*PLAIN, "medium"), face.style), default=None)


def face_of(name: str, asset: str = "", number: int = 0) -> Face:
    """A face by its name, or from a font file among the assets by its SHA-256, if that is there. Raises Refusal."""
    if asset and default_store().has(asset):
        return _from_asset(asset, number)
    found = find(name)
    if found is None:
        near = _near(name)
        raise Refusal(f"no font “{name:.60}” is installed" + (f"; did you mean “{near}”?" if near else ""))
    return _from_file(found.path, found.number, found.path.stat().st_mtime_ns)


def version_of(name: str) -> tuple[str, int] | None:
    """The SHA-256 of the file that the font of this name is in, and the number of its face; None where it is not
    installed."""
    found = find(name)
    if found is None:
        return None
    try:
        return _digest(found.path, found.path.stat().st_mtime_ns), found.number
    except OSError:
        return None


def bytes_of(name: str, asset: str = "", number: int = 0) -> tuple[bytes, int]:
    """What is in the file of a font, by its name or among the assets, and the number of its face. Raises Refusal."""
    if asset and default_store().has(asset):
        return default_store().read(asset), number
    found = find(name)
    if found is None:
        face_of(name)  # which says so
        raise Refusal(f"no font “{name:.60}” is installed")
    return font_bytes(found.path), found.number


def take(name: str) -> tuple[str, int]:
    """Take the file of an installed font among the assets: its SHA-256 and the number of the face. Raises Refusal,
    also where its licence forbids it."""
    data, number = bytes_of(name)
    check_embedding(data, number)
    return default_store().put(data), number


def fallbacks() -> list[Face]:
    """The faces in which characters are looked for that the chosen font lacks, in order."""
    return [_from_file(path, 0, 0) for path in _bundled()]


def keep(path: str | os.PathLike[str], number: int = 0) -> tuple[str, str]:
    """Take a font file among the assets: the name of its face and its SHA-256. Raises Refusal."""
    try:
        data = font_bytes(path)
        name = open_face(data, number).name
        check_embedding(data, number)
    except Refusal as refusal:
        raise Refusal(f"{Path(path).name}: {refusal}") from None
    return name, default_store().put(data)


def faces_in(path: str | os.PathLike[str]) -> tuple[FontFile, ...]:
    """The faces of a font file, in their order; none where it cannot be read."""
    return _names_in(Path(path))


@lru_cache(maxsize=OPEN)
def _from_asset(asset: str, number: int) -> Face:
    data = default_store().read(asset)
    if not data.startswith(MARK):
        return open_face(data, number)
    base, number, drawn = glyphs_from_bytes(data)
    plain = _from_asset(base, number)
    if isinstance(plain, EditedFace):
        raise Refusal("the edited glyphs of the font are damaged")
    return EditedFace(plain, drawn)


@lru_cache(maxsize=64)
def _digest(path: Path, changed: int) -> str:
    return hashlib.sha256(font_bytes(path)).hexdigest()


@lru_cache(maxsize=OPEN)
def _from_file(path: Path, number: int, changed: int) -> Face:
    """`changed` is when the file was: another version of it is another face."""
    return read_font(path, number)


def _bundled() -> list[Path]:
    folder = Path(str(files("solidtree.resources"))) / "fonts"
    return [folder / name for name in BUNDLED]


def _files(places: Iterable[Path]) -> list[Path]:
    found = []
    for place in places:
        for folder, _, names in os.walk(place):
            found += [Path(folder, name) for name in sorted(names) if name.lower().endswith(ENDINGS)]
    return found


@lru_cache(maxsize=4096)
def _names_in(path: Path) -> tuple[FontFile, ...]:
    """The faces of a file, from its table of names or its header alone."""
    try:
        with open(path, "rb") as file:
            head = file.read(HEADER)
        if head[:4] in SFNT:
            return tuple(FontFile(path, number, *_names(path, number)) for number in range(min(face_count(head), 64)))
        found = {key.decode(): text.decode("latin-1") for key, text in _SAID.findall(head)}
        family = found.get("FamilyName", "")
        return (FontFile(path, 0, family, style_of(found, family)),) if family else ()
    except (OSError, Refusal):
        return ()


def _names(path: Path, number: int) -> tuple[str, str]:
    from fontTools.ttLib import TTFont

    from .sfnt_face import names_of

    with failing("the font cannot be read"), TTFont(path, fontNumber=number, lazy=True) as font:
        return names_of(font)


def _near(name: str) -> str:
    from difflib import get_close_matches

    names = {face.name.casefold(): face.name for face in installed()}
    near = get_close_matches(name.casefold(), list(names), 1, 0.6)
    return names[near[0]] if near else ""
