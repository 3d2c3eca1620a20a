"""The font and the glyph that are worked on: what is shown of them, and how edits become steps of the history."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from PySide6.QtCore import QObject, Signal

from ...model.document.document import Document
from ...model.document.errors import Refusal
from ...model.document.outlines import Lettering
from ...model.document.project_font import font_key, font_named
from ...model.document.tree import walk
from ...model.editing.session import Session, State
from ...model.lettering.fonts.drawn_glyph import DrawnGlyph
from ...model.lettering.fonts.edited_face import EditedFace, glyph_fields
from ...model.lettering.fonts.face import Face
from ...model.lettering.fonts.in_document import face_in
from ...model.lettering.fonts.library import STANDARD
from ...model.path.nodes import inferred
from ...model.path.path import Path

Place = tuple[int, int]
"""Contour and node."""


class GlyphDesk(QObject):
    """`font_changed` tells another font, `glyph_changed` another glyph, `changed` that either looks otherwise now.

    While a drag is on its way `live` is what it shows. `refused` carries the words of what could not be done.
    """

    font_changed = Signal()
    glyph_changed = Signal()
    changed = Signal()
    refused = Signal(str)

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.session = session
        self.font = STANDARD
        self.glyph = ""
        self.face: Face | None = None
        self.fault = ""
        self.live: DrawnGlyph | None = None
        self._drawn: DrawnGlyph | None = None
        self._unlisten = session.on_change(self._follow)

    def end(self) -> None:
        """Hear no more of the session."""
        self._unlisten()

    # What is worked on.

    def fonts(self) -> list[str]:
        """Those of the project and of its lettering, by name, and the standard one."""
        document = self.session.document
        names = {font_key(font.name): font.name for font in document.fonts}
        for node in walk(*document.roots):
            if isinstance(node, Lettering):
                names.setdefault(font_key(node.font), node.font)
        names.setdefault(font_key(STANDARD), STANDARD)
        return sorted(names.values(), key=str.casefold)

    def take_font(self, name: str) -> None:
        """Work on another font; one that cannot be opened leaves words in `fault`."""
        self.font, self.live = name, None
        self._open(self.session.document)
        if self.face is not None and self.glyph not in self.face.glyph_names:
            self.glyph = self.face.characters.get(ord("a"), self.face.glyph_names[0])
        self._drawn = None
        self.font_changed.emit()
        self.glyph_changed.emit()
        self.changed.emit()

    def take_glyph(self, name: str) -> None:
        if name != self.glyph:
            self.glyph, self.live, self._drawn = name, None, None
            self.glyph_changed.emit()
            self.changed.emit()

    @property
    def plain(self) -> Face | None:
        """The font as its file has it."""
        return self.face.base if isinstance(self.face, EditedFace) else self.face

    @property
    def edited(self) -> frozenset[str]:
        """Names of the glyphs that the project has drawn anew."""
        return frozenset(self.face.drawn) if isinstance(self.face, EditedFace) else frozenset()

    @property
    def drawn(self) -> DrawnGlyph | None:
        """The glyph as it is shown, its nodes smooth where the outline is."""
        if self.live is not None:
            return self.live
        if self._drawn is None and self.face is not None and self.glyph:
            try:
                outline = self.face.outline(self.glyph)
                if self.glyph not in self.edited:
                    outline = replace(outline, contours=tuple(inferred(contour) for contour in outline.contours))
                self._drawn = DrawnGlyph(outline, self.face.advance(self.glyph))
            except Refusal as refusal:
                self.fault = str(refusal)
        return self._drawn

    def shown_face(self) -> Face | None:
        """The font with what a drag shows of its glyph."""
        if self.face is None or self.live is None or self.plain is None:
            return self.face
        drawn = self.face.drawn if isinstance(self.face, EditedFace) else {}
        return EditedFace(self.plain, {**drawn, self.glyph: self.live})

    def _open(self, document: Document) -> None:
        try:
            self.face, self.fault = face_in(document, self.font), ""
        except Refusal as refusal:
            self.face, self.fault = None, str(refusal)

    def _follow(self, before: State, after: State) -> None:
        if before.document is after.document:
            return
        one, two = (font_named(state.document.fonts, self.font) for state in (before, after))
        if one == two and self.face is not None:
            return
        old = self.face
        self._open(after.document)
        if self.face is not old:
            self.live = self._drawn = None
            if self.face is not None and self.glyph not in self.face.glyph_names:
                self.take_font(self.font)
            self.changed.emit()

    # Edits.

    def preview(self, outline: Path, advance: float | None = None) -> None:
        """Show the glyph otherwise, without a step."""
        drawn = self.drawn
        if drawn is not None:
            self.live = DrawnGlyph(outline, drawn.advance if advance is None else advance)
            self.changed.emit()

    def cancel(self) -> None:
        if self.live is not None:
            self.live = None
            self.changed.emit()

    def keep(self, label: str) -> None:
        """Make what is previewed a step."""
        if self.live is not None:
            self.put(label, self.live.outline, self.live.advance)

    def put(self, label: str, outline: Path, advance: float | None = None) -> None:
        """Draw the glyph anew, as one step."""
        drawn = self.drawn
        if drawn is None:
            return
        glyph = DrawnGlyph(outline, drawn.advance if advance is None else advance)
        self.live = None
        self.do("edit_glyphs", {self.glyph: glyph_fields(glyph)}, label=label)

    def do(self, operation: str, *arguments: Any, label: str) -> None:
        """An operation on the font, as one step; what is refused is told, and the picture stays."""
        try:
            self.session.cancel()
            self.session.do(operation, self.font, *arguments, label=label)
        except Refusal as refusal:
            self.refused.emit(str(refusal))
            self.changed.emit()

    def reset(self, glyphs: Sequence[str]) -> None:
        self.do("reset_glyphs", list(glyphs), label="Reset glyphs")
