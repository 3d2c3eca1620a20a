"""Operations on the project's fonts: carrying their files, and their glyphs drawn anew.

Files of fonts and edited glyphs are assets; the document has their SHA-256.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..document.document import Document
from ..document.errors import Refusal
from ..document.outlines import Lettering
from ..document.project_font import ProjectFont, font_key, font_named
from ..document.tree import change_each, unique_name, walk

if TYPE_CHECKING:
    from ..lettering.fonts.drawn_glyph import DrawnGlyph
    from ..lettering.fonts.face import Face


def carry_font(document: Document, font: str) -> Document:
    """Put the file of a font into the project, so that its lettering is the same on every computer.

    Raises Refusal where the font's licence bits forbid it.
    """
    known = font_named(document.fonts, font)
    return document if known is not None and known.asset else _put(document, _carried(document, font))


def release_font(document: Document, font: str) -> Document:
    """Leave a font's file, and what has been edited of it, out of the project: the name is an installed font's."""
    from ..lettering.fonts.library import find

    known = _known(document, font)
    if find(known.name) is None and any(font_key(name) == font_key(known.name) for name in _used(document)):
        raise Refusal(f"“{known.name}” is not installed here: without it the lettering that it sets would be lost")
    return document.with_(fonts=tuple(one for one in document.fonts if one is not known))


def copy_font(document: Document, font: str, name: str) -> Document:
    """Another font of the project, called `name`, with the glyphs that `font` has now: to be edited by itself."""
    from ..lettering.fonts.library import find

    plain = " ".join(str(name).split())
    if font_named(document.fonts, plain) is not None or find(plain) is not None:
        raise Refusal(f"there is a font called “{plain}” already")
    return _put(document, _carried(document, font).with_(name=plain))


def edit_glyphs(document: Document, font: str, glyphs: Mapping[str, Mapping[str, Any]]) -> Document:
    """Draw glyphs of a font anew, by their names: the project carries the font from then on, under the same name.

    Each has `advance`, `points`, `segments` and `joints`, as a path's, in font units. Lettering in this font follows.
    """
    from ..lettering.fonts.edited_face import drawn_glyph

    if not isinstance(glyphs, Mapping):
        raise Refusal(f"glyphs by their names are needed, not {glyphs!r:.60}")
    return _edited(document, font, {name: drawn_glyph(str(name), fields) for name, fields in glyphs.items()})


def transform_glyphs(
    document: Document,
    font: str,
    glyphs: Sequence[str] | str,
    matrix: Sequence[Sequence[float]] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
    weight: float = 0.0,
) -> Document:
    """Put glyphs of a font, by their names, under an affine map (2, 3), and grow them by `weight` units on every side.

    Widths go with the map's scale along x, and side bearings stay as the outlines grow.
    """
    from ..lettering.fonts.edited_face import transformed
    from ..lettering.fonts.in_document import face_in

    try:
        affine = np.array(matrix, float)
    except (TypeError, ValueError):
        affine = np.zeros(0)
    if affine.shape != (2, 3) or not np.isfinite(affine).all():
        raise Refusal("the map of glyphs is two rows of three numbers")
    if abs(np.linalg.det(affine[:, :2])) < 1e-9:
        raise Refusal("the map would flatten the glyphs to a line")
    face = face_in(document, font)
    names = _listed(glyphs)
    _check_names(face, font, names)
    return _edited(document, font, {name: transformed(face, name, affine, float(weight)) for name in names})


def reset_glyphs(document: Document, font: str, glyphs: Sequence[str] | str | None = None) -> Document:
    """Give glyphs, by their names, the shapes that the font's file has; None: all."""
    from ..lettering.fonts.in_document import drawn_of

    known = _known(document, font)
    drawn = drawn_of(known)
    gone = set(drawn) if glyphs is None else set(_listed(glyphs))
    if not gone & set(drawn):
        return document
    return _put(document, _with_glyphs(known, {name: glyph for name, glyph in drawn.items() if name not in gone}))


def with_fonts_of(document: Document, other: Document) -> tuple[Document, Document]:
    """A document with the fonts that another one carries, and that other with new names for those that differ."""
    fonts, renamed = list(document.fonts), {}
    for font in other.fonts:
        here = font_named(fonts, font.name)
        if here is None:
            fonts.append(font)
        elif font.asset and here.asset != font.asset:
            name = unique_name(font.name, [one.name for one in fonts])
            fonts.append(font.with_(name=name))
            renamed[font_key(font.name)] = name
    if renamed:
        ids = [n.id for n in walk(*other.roots) if isinstance(n, Lettering) and font_key(n.font) in renamed]
        other = change_each(other, ids, lambda node: node.with_(font=renamed[font_key(node.font)]))  # type: ignore[attr-defined]
    return document.with_(fonts=tuple(fonts)), other


def _edited(document: Document, font: str, glyphs: Mapping[str, DrawnGlyph]) -> Document:
    from ..lettering.fonts.edited_face import check_glyph
    from ..lettering.fonts.in_document import drawn_of, face_in

    known = _carried(document, font)
    _check_names(face_in(document, font), font, glyphs)
    for name, glyph in glyphs.items():
        check_glyph(name, glyph)
    return _put(document, _with_glyphs(known, {**drawn_of(known), **glyphs})) if glyphs else document


def _listed(glyphs: object) -> list[str]:
    names = [glyphs] if isinstance(glyphs, str) else glyphs
    if not isinstance(names, Sequence) or not all(isinstance(name, str) for name in names):
        raise Refusal(f"the names of glyphs are needed, not {glyphs!r:.60}")
    return list(names)


def _check_names(face: Face, font: str, names: Iterable[str]) -> None:
    own = set(face.glyph_names)
    for name in names:
        if name not in own:
            raise Refusal(f"{font} has no glyph “{name!s:.60}”")


def _carried(document: Document, font: str) -> ProjectFont:
    """The project's font of that name, with its file among the assets."""
    from ..lettering.fonts.in_document import asset_of
    from ..lettering.fonts.library import take

    font = str(font)
    known = font_named(document.fonts, font)
    if known is not None and known.asset:
        return known
    used = asset_of(document, font)
    if used is not None and known is None:
        return ProjectFont(font, used[0], used[1], used[0])
    name = known.name if known is not None else font
    base, face = take(name)
    return ProjectFont(name, base, face, base)


def _known(document: Document, font: str) -> ProjectFont:
    known = font_named(document.fonts, font)
    if known is None or not known.asset:
        raise Refusal(f"the project carries no font called “{font!s:.60}”")
    return known


def _with_glyphs(font: ProjectFont, drawn: Mapping[str, DrawnGlyph]) -> ProjectFont:
    from ..lettering.fonts.edited_face import glyphs_as_bytes
    from ..project.assets import default_store

    if not drawn:
        return font.with_(asset=font.base)
    return font.with_(asset=default_store().put(glyphs_as_bytes(font.base, font.face, drawn)))


def _put(document: Document, font: ProjectFont) -> Document:
    old = font_named(document.fonts, font.name)
    if old == font:
        return document
    if old is None:
        return document.with_(fonts=(*document.fonts, font))
    return document.with_(fonts=tuple(font if one is old else one for one in document.fonts))


def _used(document: Document) -> set[str]:
    """Names of the fonts of lettering that refers to no file itself."""
    return {node.font for node in walk(*document.roots) if isinstance(node, Lettering) and not node.asset}
