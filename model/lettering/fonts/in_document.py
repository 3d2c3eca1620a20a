"""Fonts as a document has them: the face that a name stands for, its file, and its edited glyphs."""

from __future__ import annotations

from ...document.document import Document
from ...document.outlines import Lettering
from ...document.project_font import ProjectFont, font_key, font_named
from ...document.tree import walk
from .drawn_glyph import DrawnGlyph
from .edited_face import EditedFace
from .face import Face
from .library import bytes_of, face_of


def face_in(document: Document, font: str) -> Face:
    """The face that a font's name stands for in a document. Raises Refusal."""
    font = str(font)
    known = font_named(document.fonts, font)
    if known is not None:
        return face_of(known.name, known.asset or known.base, known.face)
    used = asset_of(document, font)
    return face_of(font, *used) if used else face_of(font)


def file_of(document: Document, font: str) -> tuple[bytes, int, dict[str, DrawnGlyph]]:
    """A font's file, the number of its face, and the glyphs that the project has edited. Raises Refusal."""
    known = font_named(document.fonts, font)
    if known is not None and known.asset:
        return bytes_of(known.name, known.base, known.face)[0], known.face, drawn_of(known)
    return *bytes_of(font, *(asset_of(document, font) or ("", 0))), {}


def asset_of(document: Document, font: str) -> tuple[str, int] | None:
    """The font file, and the number of the face, that lettering in a font of this name refers to."""
    for node in walk(*document.roots):
        if isinstance(node, Lettering) and node.asset and font_key(node.font) == font_key(font):
            return node.asset, int(node.face) if isinstance(node.face, float) else 0
    return None


def drawn_of(font: ProjectFont) -> dict[str, DrawnGlyph]:
    """The glyphs of a font that the project has edited, by name. Raises Refusal."""
    face = face_of(font.name, font.asset, font.face) if font.edited else None
    return dict(face.drawn) if isinstance(face, EditedFace) else {}
