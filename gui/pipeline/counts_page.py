"""How many vertices, polygons and pixels there are at each stage."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QLabel,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from ...model.pipeline.counts import Counts
from ..status import figure

STEPS = (
    ("Vertices in", "vertices", "Each is multiplied by the matrices once"),
    ("Triangles in", "triangles", "Of all solids that are shown"),
    ("Outside", "outside", "Wholly outside the frustum: nothing of them is left"),
    ("Facing away", "away", "With back-face culling: on the screen their corners run clockwise"),
    ("Polygons drawn", "polygons", "What is left goes on"),
    ("\u2026 cut by a plane", "cut", "Of these, the clipping planes have cut so many"),
    ("\u2026 their corners", "corners", "Cutting gives a polygon more corners than three, or fewer"),
    ("Triangles rasterised", "pieces", "Polygons of more than three corners are drawn as fans"),
    ("Fragments", "fragments", "Pixels of all polygons: those whose centre lies in one"),
    ("Hidden fragments", "hidden", "The depth test leaves them unseen"),
    ("Pixels covered", "pixels", "Pixels of the picture that show a polygon"),
    ("Overdraw", "overdraw", "Fragments for each covered pixel"),
)
WAITING = "Counting \u2026"


class CountsPage(QWidget):
    """A row for each stage."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.counts: Counts | None = None
        self.table = QTableWidget(len(STEPS), 2, self)
        self.table.setAccessibleName("Counts at each stage")
        self.table.horizontalHeader().hide()
        self.table.verticalHeader().hide()
        self.table.verticalHeader().setDefaultSectionSize(24)
        self.table.setShowGrid(False)
        self.table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.table.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
        self.table.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.table.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.table.horizontalHeader().setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        self.table.horizontalHeader().setSectionResizeMode(1, QHeaderView.ResizeMode.ResizeToContents)
        self._values: list[QTableWidgetItem] = []
        for row, (title, _, tip) in enumerate(STEPS):
            for column, text in enumerate((title, "")):
                item = QTableWidgetItem(text)
                item.setToolTip(tip)
                if column:
                    item.setTextAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
                    self._values.append(item)
                self.table.setItem(row, column, item)
        self.words = QLabel(WAITING, self)
        self.words.setProperty("muted", True)
        self.words.setWordWrap(True)
        self.words.setContentsMargins(8, 4, 8, 6)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addWidget(self.table, 1)
        layout.addWidget(self.words)

    def show_counts(self, counts: Counts | None) -> None:
        """None while they are worked out: the last ones stay, and words say so."""
        if counts is None:
            self.words.setText(WAITING)
            return
        self.counts = counts
        for item, (_, name, _) in zip(self._values, STEPS, strict=True):
            value = getattr(counts, name)
            item.setText(f"{value:.3f}" if name == "overdraw" else figure(value, 12))
        width, height = counts.size
        share = 100.0 * counts.pixels / (width * height)
        self.words.setText(f"In a picture of {width} \u00d7 {height} pixels, {share:.1f} % of which are covered.")
