"""A line of text in the font that is worked on, over the same line as the font's file sets it."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QTransform
from PySide6.QtWidgets import QVBoxLayout, QWidget

from ...model.document.errors import Refusal
from ...model.lettering.fonts.face import Face
from ...model.lettering.fonts.library import fallbacks
from ...model.lettering.layout import Style, lay_out
from ..panels.text_line import TextLine
from ..theme import colours_now
from .glyph_desk import GlyphDesk
from .glyph_paths import painter_path

PANGRAM = "Hamburgefonstiv Αλφάβητο 0123456789"
MARGIN = 14.0  # logical pixels


class RunningText(QWidget):
    """What is written in the line below is shown above it, live while a glyph is dragged."""

    def __init__(self, desk: GlyphDesk, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.picture = _Line(desk, self)
        self.line = TextLine(parent=self)
        self.line.setText(PANGRAM)
        self.line.setObjectName("running_text")
        self.line.setAccessibleName("Running text")
        self.line.setToolTip("Type what is shown above")
        self.line.textChanged.connect(self._typed)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(8, 0, 8, 8)
        layout.addWidget(self.picture, 1)
        layout.addWidget(self.line)
        self._typed()

    def _typed(self) -> None:
        self.picture.text = self.line.text()
        self.picture.update()


class _Line(QWidget):
    def __init__(self, desk: GlyphDesk, parent: QWidget) -> None:
        super().__init__(parent)
        self._desk, self.text = desk, ""
        self.setAccessibleName("Text in the font")
        desk.changed.connect(self.update)

    def sizeHint(self) -> QSize:
        return QSize(600, 96)

    def minimumSizeHint(self) -> QSize:
        return QSize(100, 56)

    def paintEvent(self, event: QPaintEvent) -> None:
        colours = colours_now()
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(Qt.PenStyle.NoPen)
        face, plain = self._desk.shown_face(), self._desk.plain
        if face is None or plain is None or not self.text.strip():
            return
        try:
            if face is not plain:
                old = QColor(colours.error)
                old.setAlpha(90)
                self._draw(painter, plain, old)
            self._draw(painter, face, QColor(colours.text))
        except Refusal as refusal:
            painter.setPen(QColor(colours.muted))
            painter.drawText(self.rect(), Qt.AlignmentFlag.AlignCenter, str(refusal))

    def _draw(self, painter: QPainter, face: Face, ink: QColor) -> None:
        faces = [face, *(other for other in fallbacks() if other.name != face.name)]
        layout = lay_out(self.text, faces, Style(size=1.0))
        metrics, em = face.metrics, face.units_per_em
        height = max((metrics.ascender - metrics.descender) / em, 0.1)
        scale = min((self.height() - MARGIN) / height, (self.width() - 2 * MARGIN) / max(layout.widths[0], 0.1))
        base = 0.5 * self.height() + 0.5 * scale * (metrics.ascender + metrics.descender) / em
        origin = QPointF(MARGIN, base)
        painter.setBrush(ink)
        for one in layout.glyphs:
            (across, shear, x), (_, up, y) = one.matrix.tolist()
            place = QTransform(scale * across, 0.0, scale * shear, -scale * up, origin.x() + scale * x,
                               origin.y() - scale * y)  # fmt: skip
            painter.drawPath(place.map(painter_path(faces[one.face].outline(one.glyph))))
