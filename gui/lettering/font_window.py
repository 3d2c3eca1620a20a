"""The font window: glyphs in a grid, the canvas of one, running text, fonts side by side."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtGui import QCloseEvent
from PySide6.QtWidgets import (
    QComboBox,
    QLabel,
    QMainWindow,
    QScrollArea,
    QSizePolicy,
    QSplitter,
    QTabWidget,
    QVBoxLayout,
    QWidget,
)

from ...model.document.outlines import Lettering
from ...model.editing.chosen import chosen
from ..commands.actions import Actions
from ..curves.nodes_page import button_row
from .comparison import Comparison
from .glyph_canvas import HINT, GlyphCanvas
from .glyph_commands import GLYPH_COMMANDS, NODE_ROWS, TOOL_BAR
from .glyph_desk import GlyphDesk
from .glyph_list import GlyphList
from .glyph_side import GlyphSide
from .running_text import RunningText

if TYPE_CHECKING:
    from ..window import MainWindow

REFUSED = 8000  # milliseconds that a refusal is shown


class FontWindow(QMainWindow):
    """One for each main window; its edits are steps of that window's history."""

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window, Qt.WindowType.Window)
        self.setObjectName("font_window")
        self._window = window
        self.settings, self.background = window.settings, window.files.background
        self.desk = GlyphDesk(window.session, self)
        self.canvas = GlyphCanvas(self.desk, self)
        self.glyphs = GlyphList(self.desk, self)
        self.actions_ = Actions(self, window.settings)
        self.actions_.add(GLYPH_COMMANDS, self)
        self.side = GlyphSide(self.desk, self.canvas, self.glyphs, self._node_buttons(), self)
        self.text = RunningText(self.desk, self)
        self.comparison = Comparison(self.desk, self)
        self.fonts = QComboBox(self)
        self.fonts.setObjectName("font")
        self.fonts.setAccessibleName("Font")
        self.fonts.setMinimumContentsLength(22)
        self.fonts.setToolTip("A font of the project or of its lettering, or any installed one")
        self.state = QLabel(self)
        self.state.setProperty("muted", True)
        self.state.setContentsMargins(0, 0, 12, 0)
        self._lay_out()
        self.fonts.activated.connect(lambda: self.desk.take_font(self.fonts.currentText()))
        self.desk.refused.connect(lambda words: self.statusBar().showMessage(_sentence(words), REFUSED))
        self.actions_.refused.connect(self.desk.refused)
        self.desk.font_changed.connect(self._font)
        self.desk.changed.connect(self._state)
        self.canvas.chosen_changed.connect(self.actions_.refresh)
        self._unlisten = window.session.on_change(lambda before, after: self.actions_.refresh())
        self.resize(1180, 760)

    def show_font(self, name: str, text: str = "") -> None:
        """Work on a font, first on the glyph of the first letter of `text`."""
        if name != self.desk.font or self.desk.face is None:
            self.desk.take_font(name)
        face = self.desk.face
        glyphs = [face.characters[ord(one)] for one in text if ord(one) in face.characters] if face is not None else []
        if glyphs:
            self.desk.take_glyph(glyphs[0])
        if text.strip():
            self.text.line.setText(" ".join(text.split())[:60])
        self.show()
        self.raise_()
        self.activateWindow()
        self.canvas.setFocus()

    def save(self) -> None:
        """Ask how and where to, and write the font."""
        from .save_font import ask_save_font

        ask_save_font(self)

    def saved(self, path: Path, remarks: Sequence[str]) -> None:
        """Tell that the font has been written, and what in it is not as it was."""
        words = "; ".join(remarks)
        self.statusBar().showMessage(
            f"{path.name} is written and read back" + (f". {_sentence(words)}" if words else "")
        )

    def _node_buttons(self) -> QWidget:
        buttons = QWidget(self)
        column = QVBoxLayout(buttons)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2)
        for names in NODE_ROWS:
            row = button_row(self.actions_, names, buttons)
            if row is not None:
                column.addLayout(row)
        return buttons

    def _lay_out(self) -> None:
        bar = self.addToolBar("Font")
        bar.setObjectName("font_tools")
        bar.setMovable(False)
        bar.addWidget(self.fonts)
        self.actions_.fill_tool_bar(bar, TOOL_BAR)
        space = QWidget(self)
        space.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        bar.addWidget(space)
        bar.addWidget(self.state)
        self.tabs = QTabWidget(self)
        self.tabs.setDocumentMode(True)
        self.tabs.addTab(self.canvas, "Glyph")
        self.tabs.addTab(self.comparison, "Compare fonts")
        side = QScrollArea(self)
        side.setWidgetResizable(True)
        side.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        side.setWidget(self.side)
        side.setMinimumWidth(250)
        self.tabs.currentChanged.connect(lambda page: side.setVisible(page == 0))
        across = QSplitter(Qt.Orientation.Horizontal, self)
        for widget, share in ((self.glyphs, 0), (self.tabs, 1), (side, 0)):
            across.addWidget(widget)
            across.setStretchFactor(across.count() - 1, share)
        across.setSizes([330, 590, 260])
        down = QSplitter(Qt.Orientation.Vertical, self)
        down.addWidget(across)
        down.addWidget(self.text)
        down.setStretchFactor(0, 1)
        down.setSizes([620, 130])
        for splitter in (across, down):
            splitter.setChildrenCollapsible(False)
        self.setCentralWidget(down)
        hint = QLabel(HINT, self)
        hint.setProperty("muted", True)
        self.statusBar().addWidget(hint, 1)
        self.statusBar().setSizeGripEnabled(False)

    def _font(self) -> None:
        from ...model.lettering.fonts.library import installed

        names = list(dict.fromkeys([self.desk.font, *self.desk.fonts()]))
        self.fonts.clear()
        self.fonts.addItems(names)
        others = [face.name for face in installed() if face.name not in names]
        if others:
            self.fonts.insertSeparator(len(names))
            self.fonts.addItems(others)
        self.fonts.setCurrentIndex(self.fonts.findText(self.desk.font))
        self._state()

    def _state(self) -> None:
        desk = self.desk
        count = len(desk.edited)
        words = f"{count} glyph{'s' * (count != 1)} edited in this project" if count else "as in its file"
        self.state.setText(words if desk.face is not None else desk.fault)
        self.setWindowTitle(f"Font: {desk.font}")
        self.actions_.refresh()

    def closeEvent(self, event: QCloseEvent) -> None:
        self.desk.cancel()
        super().closeEvent(event)

    def end(self) -> None:
        """Before the main window goes."""
        self._unlisten()
        self.desk.end()
        self.close()


def open_font_window(window: MainWindow) -> None:
    """The font of the selected lettering, or the one that was open last."""
    found = window.side_windows.of(FontWindow)
    nodes = [node for node in chosen(window.session).nodes if isinstance(node, Lettering)]
    if nodes:
        found.show_font(nodes[0].font, nodes[0].text)
    else:
        found.show_font(found.desk.font)


def _sentence(words: str) -> str:
    return words[:1].upper() + words[1:]
