"""One character in several fonts side by side: outline with control points, and filled at several sizes."""

from __future__ import annotations

import unicodedata
from dataclasses import replace

from PySide6.QtCore import QPointF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen, QTransform
from PySide6.QtWidgets import QHBoxLayout, QLabel, QListWidget, QListWidgetItem, QScrollArea, QVBoxLayout, QWidget

from ...model.document.errors import Refusal
from ...model.lettering.fonts.drawn_glyph import DrawnGlyph
from ...model.lettering.fonts.face import Face
from ...model.lettering.fonts.in_document import face_in
from ...model.lettering.fonts.library import BUNDLED, installed
from ...model.path.nodes import inferred
from ...model.path.path import Kind, Path
from ..panels.text_line import TextLine
from ..theme import colours_now
from .glyph_desk import GlyphDesk
from .glyph_paths import painter_path
from .glyph_picture import Shown, draw_outline, draw_points

SIZES = (72, 36, 18, 10)  # pixels of the em
ROW, LARGE, GAP = 280, 320, 18  # logical pixels
HEAD, FOOT = 50, 26


class Comparison(QWidget):
    """Characters to compare, the fonts to tick, and a row for each."""

    def __init__(self, desk: GlyphDesk, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._desk = desk
        self.character = TextLine(parent=self)
        self.character.setObjectName("compared")
        self.character.setAccessibleName("Character")
        self.character.setText("α")
        self.character.setMaximumWidth(90)
        self.meaning = QLabel(self)
        self.meaning.setProperty("muted", True)
        self.fonts = QListWidget(self)
        self.fonts.setAccessibleName("Fonts to compare")
        self.fonts.setMaximumWidth(210)
        self.rows = _Rows(desk, self)
        scroll = QScrollArea(self)
        scroll.setWidgetResizable(True)
        scroll.setWidget(self.rows)
        label = QLabel("Character", self)
        label.setBuddy(self.character)
        top = QHBoxLayout()
        top.setContentsMargins(10, 8, 10, 8)
        top.setSpacing(8)
        top.addWidget(label)
        top.addWidget(self.character)
        top.addWidget(self.meaning, 1)
        side = QHBoxLayout()
        side.setSpacing(0)
        side.addWidget(scroll, 1)
        side.addWidget(self.fonts)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addLayout(top)
        layout.addLayout(side, 1)
        self.character.textChanged.connect(self.follow)
        self.fonts.itemChanged.connect(self.follow)
        desk.font_changed.connect(self._list)
        desk.changed.connect(self.follow)
        self._listed = False

    def showEvent(self, event: object) -> None:
        super().showEvent(event)  # type: ignore[arg-type]
        self._list()

    def _list(self) -> None:
        """The project's fonts and the bundled ones ticked at first; the installed ones are read when first shown."""
        if not self.isVisible():
            return
        ticked = {self.fonts.item(i).text() for i in range(self.fonts.count())
                  if self.fonts.item(i).checkState() == Qt.CheckState.Checked}  # fmt: skip
        own = dict.fromkeys([self._desk.font, *self._desk.fonts()])
        faces = installed()
        bundled = [face.name for face in faces if face.path.name in BUNDLED]
        if not self._listed:
            ticked |= {*own, *bundled}
        self._listed = True
        self.fonts.blockSignals(True)
        self.fonts.clear()
        for name in dict.fromkeys([*own, *bundled, *(face.name for face in faces)]):
            item = QListWidgetItem(name)
            item.setFlags(Qt.ItemFlag.ItemIsEnabled | Qt.ItemFlag.ItemIsUserCheckable | Qt.ItemFlag.ItemIsSelectable)
            item.setCheckState(Qt.CheckState.Checked if name in ticked else Qt.CheckState.Unchecked)
            self.fonts.addItem(item)
        self.fonts.blockSignals(False)
        self.follow()

    def follow(self) -> None:
        """Show what is ticked."""
        text = self.character.text()[:1]
        self.meaning.setText(f"U+{ord(text):04X}  {unicodedata.name(text, '').lower()}" if text else "Type a character")
        items = [self.fonts.item(i) for i in range(self.fonts.count())]
        self.rows.show_fonts([i.text() for i in items if i.checkState() == Qt.CheckState.Checked], text)


class _Rows(QWidget):
    def __init__(self, desk: GlyphDesk, parent: QWidget) -> None:
        super().__init__(parent)
        self._desk = desk
        self.names: list[str] = []
        self.text = ""
        self.setAccessibleName("Comparison of fonts")

    def show_fonts(self, names: list[str], text: str) -> None:
        self.names, self.text = names, text
        self.setMinimumHeight(ROW * len(names))
        self.setMinimumWidth(LARGE + sum(SIZES) + GAP * (len(SIZES) + 3))
        self.updateGeometry()
        self.update()

    def sizeHint(self) -> QSize:
        return QSize(LARGE + sum(SIZES) + GAP * (len(SIZES) + 3), max(ROW * len(self.names), ROW))

    def paintEvent(self, event: QPaintEvent) -> None:
        colours = colours_now()
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.fillRect(self.rect(), QColor(colours.ground))
        if not (self.names and self.text):
            painter.setPen(QColor(colours.muted))
            painter.drawText(self.rect(), Qt.AlignmentFlag.AlignCenter, "Tick fonts at the right")
        faces: list[Face | str] = []
        for name in self.names if self.text else ():
            try:
                faces.append(face_in(self._desk.session.document, name))
            except Refusal as refusal:
                faces.append(str(refusal))
        low, high = self._reach([face for face in faces if isinstance(face, Face)])
        for number, (name, face) in enumerate(zip(self.names, faces, strict=False)):
            top = ROW * number
            painter.setPen(QColor(colours.border))
            painter.drawLine(0, top + ROW - 1, self.width(), top + ROW - 1)
            painter.setPen(QColor(colours.text))
            painter.drawText(QPointF(GAP, top + 20), name)
            fault = face if isinstance(face, str) else self._row(painter, face, top, low, high)
            if fault:
                painter.setPen(QColor(colours.muted))
                painter.drawText(QPointF(GAP, top + 38), fault)

    def _reach(self, faces: list[Face]) -> tuple[float, float]:
        """Lowest and highest place of the character in any of the fonts, in ems; the baseline included."""
        low, high = 0.0, 0.3
        for face in faces:
            glyph = face.characters.get(ord(self.text))
            outline = _outline(face, glyph) if glyph is not None else None
            if outline is not None and outline.contours:
                (_, bottom), (_, top) = outline.bounds().tolist()
                low, high = min(low, bottom / face.units_per_em), max(high, top / face.units_per_em)
        return low, high

    def _row(self, painter: QPainter, face: Face, top: float, low: float, high: float) -> str:
        """Draws the character in one font, all fonts to one scale; words where it cannot be drawn."""
        colours = colours_now()
        glyph = face.characters.get(ord(self.text))
        outline = _outline(face, glyph) if glyph is not None else None
        if glyph is None or outline is None:
            return f"It has no glyph for “{self.text}”" if glyph is None else "Its glyph is broken"
        advance = face.advance(glyph)
        painter.setPen(QColor(colours.muted))
        painter.drawText(QPointF(GAP, top + 38), f"{face.kind}, {_described(outline)}")
        metrics, em = face.metrics, face.units_per_em
        scale = min((ROW - HEAD - FOOT) / (high - low), LARGE / max(advance / em, 0.1)) / em
        baseline = top + HEAD + scale * em * high
        left = GAP + 0.5 * LARGE - 0.5 * scale * advance
        painter.setPen(QPen(QColor(colours.border), 1.0))
        for height in (0.0, metrics.x_height, metrics.cap_height):
            y = baseline - scale * height
            if y > top + HEAD - 8:
                painter.drawLine(QPointF(GAP, y), QPointF(GAP + LARGE, y))
        shown = Shown(face, DrawnGlyph(outline, advance), None, frozenset(), None)
        draw_outline(painter, shown, QTransform(scale, 0, 0, -scale, left, baseline), colours)
        draw_points(painter, shown, lambda x, y: QPointF(left + scale * x, baseline - scale * y), colours)
        x = 2.0 * GAP + LARGE
        for size in SIZES:
            small = size / em
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(QColor(colours.text))
            painter.drawPath(QTransform(small, 0, 0, -small, x, baseline).map(painter_path(outline)))
            painter.setPen(QColor(colours.muted))
            painter.drawText(QPointF(x, top + ROW - 10), f"{size}")
            x += max(size, 14) + GAP
        return ""


def _outline(face: Face, glyph: str) -> Path | None:
    """With its nodes smooth where the curve is; None for a broken glyph."""
    try:
        outline = face.outline(glyph)
    except Refusal:
        return None
    return replace(outline, contours=tuple(inferred(contour) for contour in outline.contours))


def _described(outline: Path) -> str:
    kinds = [Kind(kind) for contour in outline.contours for kind in contour.kinds.tolist()]
    words = [
        f"{kinds.count(kind)} {word}{'s' * (kinds.count(kind) != 1)}"
        for kind, word in ((Kind.LINE, "line"), (Kind.QUADRATIC, "quadratic"), (Kind.CUBIC, "cubic"))
        if kind in kinds
    ]
    return ", ".join(words) or "empty"
