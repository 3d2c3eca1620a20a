"""The glyphs of a font in a grid, found by name, character and Unicode block."""

from __future__ import annotations

from collections.abc import Iterable

from fontTools.unicodedata import block
from PySide6.QtCore import QItemSelection, QItemSelectionModel, Signal
from PySide6.QtWidgets import QAbstractItemView, QComboBox, QHBoxLayout, QLabel, QVBoxLayout, QWidget

from ..panels.text_line import TextLine
from .glyph_desk import GlyphDesk
from .glyph_grid import GlyphGrid
from .glyph_model import ALL, EDITED, NAME, NO_CHARACTER, GlyphFilter, GlyphModel, Index


class GlyphList(QWidget):
    """Search, block and grid. `chosen` tells that the choice is another one."""

    chosen = Signal()

    def __init__(self, desk: GlyphDesk, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._desk = desk
        self.glyphs = GlyphModel(self)
        self._shown = GlyphFilter(self)
        self._shown.setSourceModel(self.glyphs)
        self.grid = GlyphGrid(self.glyphs, self._shown, self)
        self.search = TextLine(parent=self)
        self.search.setPlaceholderText("Name, character, U+03B1")
        self.search.setAccessibleName("Search glyphs")
        self.search.setClearButtonEnabled(True)
        self.block = QComboBox(self)
        self.block.setAccessibleName("Unicode block")
        self.block.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.block.setMinimumContentsLength(10)
        self.count = QLabel(self)
        self.count.setProperty("muted", True)
        top = QHBoxLayout()
        top.setContentsMargins(8, 8, 8, 4)
        top.setSpacing(6)
        top.addWidget(self.search, 3)
        top.addWidget(self.block, 2)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addLayout(top)
        layout.addWidget(self.grid, 1)
        layout.addWidget(self.count)
        self.count.setContentsMargins(8, 3, 8, 4)
        self.search.textChanged.connect(self._look)
        self.block.currentIndexChanged.connect(self._look)
        self.grid.selectionModel().currentChanged.connect(self._current)
        self.grid.selectionModel().selectionChanged.connect(lambda *_: (self._tell(), self.chosen.emit()))
        desk.font_changed.connect(self._font)
        desk.glyph_changed.connect(self._glyph)
        desk.changed.connect(self._edits)

    def chosen_glyphs(self) -> list[str]:
        """Names in the order of the grid."""
        rows = sorted(index.row() for index in self.grid.selectionModel().selectedIndexes())
        return [str(self._shown.index(row, 0).data(NAME)) for row in rows]

    def choose(self, names: Iterable[str]) -> None:
        """Choose these glyphs alone; those that are filtered out stay out."""
        wanted, chosen = set(names), QItemSelection()
        for row in range(self._shown.rowCount()):
            index = self._shown.index(row, 0)
            if index.data(NAME) in wanted:
                chosen.select(index, index)
        self.grid.selectionModel().select(chosen, QItemSelectionModel.SelectionFlag.ClearAndSelect)

    def _font(self) -> None:
        self.glyphs.show_font(self._desk.face, self._desk.edited)
        codes = self._desk.face.characters if self._desk.face is not None else {}
        blocks = dict.fromkeys(block(chr(code)) for code in sorted(codes))
        self.block.blockSignals(True)
        self.block.clear()
        self.block.addItems([ALL, EDITED, NO_CHARACTER])
        self.block.insertSeparator(3)
        self.block.addItems(list(blocks))
        self.block.blockSignals(False)
        self._look()

    def _look(self) -> None:
        self._shown.look_for(self.search.text(), self.block.currentText() or ALL)
        self._glyph()
        self._tell()

    def _tell(self) -> None:
        shown, chosen = self._shown.rowCount(), len(self.grid.selectionModel().selectedIndexes())
        total = len(self.glyphs.names)
        words = f"{shown:,} of {total:,} glyphs" if shown < total else f"{total:,} glyphs"
        if not shown and self.glyphs.names:
            words = "No glyph is like that"
        self.count.setText(words + (f", {chosen} chosen" if chosen > 1 else ""))

    def _glyph(self) -> None:
        """Bring the glyph that is worked on into view."""
        name = self._desk.glyph
        current = self.grid.currentIndex()
        if current.isValid() and current.data(NAME) == name:
            return
        if name in self.glyphs.names:
            index = self._shown.mapFromSource(self.glyphs.index(self.glyphs.names.index(name)))
            if index.isValid():
                self.grid.setCurrentIndex(index)
                self.grid.scrollTo(index, QAbstractItemView.ScrollHint.PositionAtCenter)

    def _current(self, index: Index) -> None:
        if index.isValid():
            self._desk.take_glyph(str(index.data(NAME)))

    def _edits(self) -> None:
        face = self._desk.face
        if face is not None and self._desk.live is None and face is not self.glyphs.face:
            self.glyphs.show_edits(face, self._desk.edited)
            if self.block.currentText() == EDITED:
                self._look()
