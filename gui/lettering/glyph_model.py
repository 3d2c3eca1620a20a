"""The glyphs of a font as rows, and those that a search and a Unicode block leave."""

from __future__ import annotations

import unicodedata

from fontTools.unicodedata import block
from PySide6.QtCore import QAbstractListModel, QModelIndex, QObject, QPersistentModelIndex, QSortFilterProxyModel, Qt
from PySide6.QtGui import QPainterPath

from ...model.document.errors import Refusal
from ...model.lettering.fonts.edited_face import touched
from ...model.lettering.fonts.face import Face
from .glyph_paths import painter_path

ALL = "All blocks"
EDITED = "Edited glyphs"
NO_CHARACTER = "No character of their own"
NAME, CODES, CHANGED = (Qt.ItemDataRole.UserRole + i for i in range(3))
Index = QModelIndex | QPersistentModelIndex


class GlyphModel(QAbstractListModel):
    """A row for each glyph: its name, the characters that it stands for, and whether it is edited."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.names: tuple[str, ...] = ()
        self.codes: dict[str, list[int]] = {}
        self.edited: frozenset[str] = frozenset()
        self.face: Face | None = None
        self._paths: dict[str, QPainterPath] = {}

    def show_font(self, face: Face | None, edited: frozenset[str]) -> None:
        self.beginResetModel()
        self.face, self.edited = face, edited
        self._paths, self.codes = {}, {}
        for code, name in (face.characters if face is not None else {}).items():
            self.codes.setdefault(name, []).append(code)
        self.names = tuple(sorted(face.glyph_names, key=self._order)) if face is not None else ()
        self.endResetModel()

    def show_edits(self, face: Face, edited: frozenset[str]) -> None:
        """The same font with glyphs that are drawn otherwise: those alone are drawn again."""
        other = set(edited) | set(self.edited)
        self.face, self.edited = face, edited
        for name in touched(face, other):
            self._paths.pop(name, None)
        if self.names:
            self.dataChanged.emit(self.index(0), self.index(len(self.names) - 1))

    def _order(self, name: str) -> tuple[int, str]:
        return min(self.codes.get(name, [0x110000])), name

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008 - Qt's own default
        return 0 if parent.isValid() else len(self.names)

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> object:
        name = self.names[index.row()]
        if role in (Qt.ItemDataRole.DisplayRole, NAME):
            return name
        if role == CODES:
            return self.codes.get(name, [])
        if role == CHANGED:
            return name in self.edited
        if role == Qt.ItemDataRole.ToolTipRole:
            return "\n".join([name, *map(_described, self.codes.get(name, [])[:4])])
        return None

    def path(self, name: str) -> QPainterPath:
        """In font units, y up; empty for a glyph that cannot be drawn."""
        if name not in self._paths:
            try:
                self._paths[name] = painter_path(self.face.outline(name)) if self.face is not None else QPainterPath()
            except Refusal:
                self._paths[name] = QPainterPath()
        return self._paths[name]

    def advance(self, name: str) -> float:
        try:
            return self.face.advance(name) if self.face is not None else 0.0
        except Refusal:
            return 0.0


def _described(code: int) -> str:
    name = unicodedata.name(chr(code), "")
    return f"U+{code:04X} {chr(code)} {name.capitalize()}".rstrip()


class GlyphFilter(QSortFilterProxyModel):
    """Rows that a search and a block leave."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._words, self._block = "", ALL

    def look_for(self, words: str, of_block: str) -> None:
        self._words, self._block = words.strip(), of_block
        self.invalidate()

    def filterAcceptsRow(self, source_row: int, source_parent: Index) -> bool:
        model = self.sourceModel()
        if not isinstance(model, GlyphModel):
            return True
        name = model.names[source_row]
        codes = model.codes.get(name, [])
        return self._in_block(name, codes, model.edited) and self._found(name, codes)

    def _in_block(self, name: str, codes: list[int], edited: frozenset[str]) -> bool:
        if self._block == ALL:
            return True
        if self._block == EDITED:
            return name in edited
        if self._block == NO_CHARACTER:
            return not codes
        return any(block(chr(code)) == self._block for code in codes)

    def _found(self, name: str, codes: list[int]) -> bool:
        words = self._words
        if not words:
            return True
        if len(words) == 1 and ord(words) in codes:
            return True
        if words[:2].upper() == "U+":
            return any(f"{code:04X}".startswith(words[2:].upper().lstrip("0").zfill(len(words[2:]))) for code in codes)
        folded = words.casefold()
        return (
            len(words) > 1
            and (folded in name.casefold() or any(folded in unicodedata.name(chr(c), "").casefold() for c in codes))
        ) or (len(words) == 1 and name == words)
