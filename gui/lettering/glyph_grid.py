"""Glyphs in cells that wrap: each on its baseline, its name below, a dot where it is edited."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QPainter, QTransform
from PySide6.QtWidgets import QAbstractItemView, QListView, QStyle, QStyledItemDelegate, QStyleOptionViewItem, QWidget

from ..theme import colours_now
from .glyph_model import CHANGED, NAME, GlyphFilter, GlyphModel, Index

CELL = QSize(68, 82)  # logical pixels
NAME_HEIGHT = 18


class GlyphPainter(QStyledItemDelegate):
    """A cell: the glyph on its baseline, its character or name below, a dot where it is edited."""

    def sizeHint(self, option: QStyleOptionViewItem, index: Index) -> QSize:
        return CELL

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        view = self.parent()
        model = view.glyphs if isinstance(view, GlyphGrid) else None
        if model is None or model.face is None:
            return
        colours, name = colours_now(), str(index.data(NAME))
        chosen = bool(option.state & QStyle.StateFlag.State_Selected)  # type: ignore[attr-defined]
        box = QRectF(option.rect).adjusted(1, 1, -1, -1)  # type: ignore[attr-defined]
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QColor(colours.accent if chosen else colours.border))
        painter.setBrush(QColor(colours.checked if chosen else colours.ground))
        painter.drawRoundedRect(box.adjusted(0.5, 0.5, -0.5, -0.5), 4, 4)
        metrics = model.face.metrics
        height = max(metrics.ascender - metrics.descender, 1.0)
        room = box.adjusted(5, 5, -5, -NAME_HEIGHT)
        path = model.path(name)
        bounds = path.boundingRect()
        width = max(model.advance(name), bounds.right(), 1.0) - min(bounds.left(), 0.0)
        scale = min(room.height() / height, room.width() / width)
        left = room.center().x() - scale * (width / 2 + min(bounds.left(), 0.0))
        baseline = room.center().y() + scale * (metrics.ascender + metrics.descender) / 2
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(colours.text))
        painter.drawPath(QTransform(scale, 0, 0, -scale, left, baseline).map(path))
        if index.data(CHANGED):
            painter.setBrush(QColor(colours.warning))
            painter.drawEllipse(QRectF(box.right() - 11, box.top() + 5, 6, 6))
        small = QFont(option.font)  # type: ignore[attr-defined]
        small.setPointSizeF(max(small.pointSizeF() - 1.5, 7.0))
        painter.setFont(small)
        painter.setPen(QColor(colours.muted))
        below = QRectF(box.left() + 3, box.bottom() - NAME_HEIGHT, box.width() - 6, NAME_HEIGHT - 2)
        words = painter.fontMetrics().elidedText(name, Qt.TextElideMode.ElideRight, int(below.width()))
        painter.drawText(below, Qt.AlignmentFlag.AlignCenter, words)
        painter.restore()


class GlyphGrid(QListView):
    """Cells that wrap; several may be chosen."""

    def __init__(self, glyphs: GlyphModel, shown: GlyphFilter, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.glyphs = glyphs
        self.setObjectName("glyphs")
        self.setModel(shown)
        self.setViewMode(QListView.ViewMode.IconMode)
        self.setResizeMode(QListView.ResizeMode.Adjust)
        self.setMovement(QListView.Movement.Static)
        self.setUniformItemSizes(True)
        self.setGridSize(CELL)
        self.setSelectionMode(QAbstractItemView.SelectionMode.ExtendedSelection)
        self.setVerticalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.setItemDelegate(GlyphPainter(self))
        self.setAccessibleName("Glyphs")
