"""A row for a bitmap of a material: what it is, another one, none."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QDragEnterEvent, QDropEvent, QIcon
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSizePolicy, QToolButton, QWidget

from ...model.document.errors import Refusal
from ...model.surface.bitmaps import texels_of
from ...model.surface.material import Material, words
from ..icons import icon
from ..panels.property_edit import sentence
from .bitmap_files import ask_bitmap, bitmap_paths, take_bitmap
from .swatch import thumbnail

if TYPE_CHECKING:
    from ..window import MainWindow

SIDE, EMPTY = 32, 18  # pixels of the thumbnail, and of the icon where there is none


class BitmapRow(QWidget):
    """The bitmap in one field of a material; `chosen` carries the material's name and the SHA-256 of another bitmap, ""
    for none."""

    chosen = Signal(str, str)

    def __init__(self, window: MainWindow, field: str, tip: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._window, self._field = window, field
        self.sha = ""
        self._name = ""
        self.setAcceptDrops(True)
        self.picture = QToolButton(self)
        self.picture.setObjectName(f"{field}_picture")
        self.picture.setProperty("flat", True)
        self.picture.setAccessibleName(f"Choose the bitmap of the {words(field)}")
        self.picture.setToolTip(f"<b>{tip}</b><br>A click chooses a file; or drop one here")
        self.picture.clicked.connect(self.ask)
        self.size_words = QLabel(self)
        self.size_words.setProperty("muted", True)
        self.size_words.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.inspect = QToolButton(self)
        self.inspect.setObjectName(f"{field}_inspect")
        self.inspect.setProperty("flat", True)
        self.inspect.setIcon(icon("bitmap_inspector"))
        self.inspect.setToolTip("Look at the bitmap in the inspector")
        self.inspect.setAccessibleName(f"Inspect the bitmap of the {words(field)}")
        self.inspect.clicked.connect(self._inspect)
        self.clear = QToolButton(self)
        self.clear.setObjectName(f"{field}_clear")
        self.clear.setProperty("flat", True)
        self.clear.setIcon(icon("close"))
        self.clear.setToolTip("Take the bitmap off")
        self.clear.setAccessibleName(f"No {words(field)}")
        self.clear.clicked.connect(lambda: self.chosen.emit(self._name, ""))
        line = QHBoxLayout(self)
        line.setContentsMargins(0, 0, 0, 0)
        line.setSpacing(4)
        line.addWidget(self.picture)
        line.addWidget(self.size_words, 1)
        line.addWidget(self.inspect)
        line.addWidget(self.clear)

    def show_material(self, material: Material) -> None:
        self._name, sha = material.name, getattr(material, self._field)
        self.clear.setEnabled(bool(sha))
        self.inspect.setEnabled(bool(sha))
        if sha == self.sha and not self.picture.icon().isNull():
            return
        self.sha = sha
        small = thumbnail(sha, SIDE) if sha else None
        self.picture.setIcon(QIcon(small) if small is not None else icon("warning" if sha else "open"))
        side = SIDE if small is not None else EMPTY
        self.picture.setIconSize(QSize(side, side))
        text, tip = _size_words(sha)
        self.size_words.setText(text)
        self.size_words.setToolTip(tip)

    def ask(self) -> None:
        """Ask for a file."""
        name = self._name
        ask_bitmap(self._window, lambda sha, path: self.chosen.emit(name, sha))

    def take(self, path: Path) -> None:
        """Read a file."""
        name = self._name
        take_bitmap(self._window, path, lambda sha, path: self.chosen.emit(name, sha))

    def _inspect(self) -> None:
        from ..bitmap.bitmap_window import open_inspector

        open_inspector(self._window, self.sha, f"{self._name}: {words(self._field)}")

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        if bitmap_paths(event.mimeData()):
            event.setDropAction(Qt.DropAction.CopyAction)
            event.accept()

    def dropEvent(self, event: QDropEvent) -> None:
        paths = bitmap_paths(event.mimeData())
        if paths:
            event.acceptProposedAction()
            self.take(paths[0])


def _size_words(sha: str) -> tuple[str, str]:
    """The size of a bitmap, or why there is none in words and in a tip."""
    if not sha:
        return "none", ""
    try:
        height, width = texels_of(sha).shape[:2]
    except Refusal as refusal:
        return "cannot be shown", sentence(refusal)
    return f"{width} × {height}", ""
