"""The window of the light probe: the equation of a place with its numbers, beside the pixel that the picture has."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtGui import QCloseEvent, QColor, QFont, QPixmap
from PySide6.QtWidgets import QHeaderView, QLabel, QMainWindow, QTableWidgetItem, QVBoxLayout, QWidget

from ..bitmap.facts_pages import table
from .equation import rows_of, title_of
from .light_probe import LightProbe, Taken

if TYPE_CHECKING:
    from ..window import MainWindow

EQUATION = (
    "I = I<sub>a</sub> r<sub>a</sub> + \u03a3 (I<sub>d</sub> r<sub>d</sub> max(0, s\u00b7m) + "
    "I<sub>s</sub> r<sub>s</sub> max(0, h\u00b7m)<sup>f</sup>)"
)
LETTERS = "m is the normal, s the way to a light, v the one to the eye, h halfway between s and v; all of length 1."
EMPTY = "Click a face in the picture."
SWATCH = 14


class LightWindow(QMainWindow):
    """One for each main window; it has the probe's tool, which is in use while the window is open."""

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window, Qt.WindowType.Tool)
        self.setObjectName("light_window")
        self.setWindowTitle("Light of a point")
        self._window = window
        self.tool = LightProbe(window.session, window.viewport, self)
        window.viewport.add_tool(self.tool)
        self.tool.taken.connect(self.show_taken)
        self.tool.said.connect(window.status.set_hint)
        self.tool.refused.connect(window.status.say)
        self.tool.began.connect(self._give_way)
        self.tool.ended.connect(self._ended)
        for other in (window.measure, window.sight, window.draw, window.face_plane, window.engrave):
            other.began.connect(self.tool.end)
        window.files.opened.connect(self.tool.end)
        equation = QLabel(EQUATION, self)
        equation.setTextFormat(Qt.TextFormat.RichText)
        font = QFont(equation.font())
        font.setPointSizeF(font.pointSizeF() * 1.25)
        equation.setFont(font)
        letters = QLabel(LETTERS, self)
        letters.setProperty("muted", True)
        letters.setWordWrap(True)
        self.title = QLabel(EMPTY, self)
        self.title.setObjectName("title")
        self.title.setWordWrap(True)
        self.rows = table(("Term", "Red", "Green", "Blue", "Reckoned as"), self)
        self.rows.setObjectName("terms")
        self.rows.horizontalHeader().setSectionResizeMode(4, QHeaderView.ResizeMode.Stretch)
        central = QWidget(self)
        column = QVBoxLayout(central)
        column.setContentsMargins(12, 10, 12, 10)
        column.addWidget(equation)
        column.addWidget(letters)
        column.addWidget(self.title)
        column.addWidget(self.rows, 1)
        self.setCentralWidget(central)
        self.resize(800, 460)

    def start(self) -> None:
        self.show()
        self.raise_()
        self.tool.start()

    def show_taken(self, taken: Taken | None) -> None:
        """The terms of a place; None: none has been clicked, or it is out of date."""
        if taken is None:
            self.title.setText(EMPTY)
            self.rows.setRowCount(0)
            return
        self.title.setText(title_of(taken.probe, taken.name))
        rows = rows_of(taken.probe, taken.ambient, taken.pixel)
        self.rows.setRowCount(len(rows))
        for i, row in enumerate(rows):
            values = row.values or ()
            words = [f"{value:.0f}" if row.levels else f"{value:.4f}" for value in values]
            for j, text in enumerate((row.title, *words, row.reckoned)):
                item = QTableWidgetItem(text)
                if 0 < j < 4:
                    item.setTextAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
                if row.kind == "sum":
                    font = QFont(item.font())
                    font.setBold(True)
                    item.setFont(font)
                self.rows.setItem(i, j, item)
            if row.levels and row.title != "Difference" and (cell := self.rows.item(i, 0)) is not None:
                swatch = QPixmap(SWATCH, SWATCH)
                swatch.fill(QColor(*(min(max(round(value), 0), 255) for value in values)))
                cell.setIcon(swatch)
        self.rows.resizeRowsToContents()

    def _give_way(self) -> None:
        window = self._window
        others = (window.measure, window.sight, window.place_on_face, window.draw, window.face_plane, window.engrave)
        for tool in others:
            tool.end()
        window.handles.set_hidden(True)

    def _ended(self) -> None:
        self._window.handles.set_hidden(False)
        self._window.actions_.refresh()
        self.hide()

    def closeEvent(self, event: QCloseEvent) -> None:
        super().closeEvent(event)
        self.tool.end()

    def end(self) -> None:
        """Before the main window goes."""
        self.close()


def switch_probe(window: MainWindow) -> None:
    """Begin to probe, or end it."""
    found = window.side_windows.of(LightWindow)
    if found.tool.active:
        found.tool.end()
    else:
        found.start()
