"""Bitmap files taken from dialogs and drops: read in the background, kept with the project."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QMimeData, Qt
from PySide6.QtWidgets import QFileDialog

from ...model.document.errors import Refusal
from ...model.image.pictures import FORMATS

if TYPE_CHECKING:
    from ..window import MainWindow

FILTERS = [f"Bitmaps ({' '.join('*' + ending for ending in FORMATS)})", "All files (*)"]


def ask_bitmap(window: MainWindow, then: Callable[[str, Path], None]) -> None:
    """Which bitmap file; `then` gets its SHA-256 and its path."""
    dialog = QFileDialog(window, "Choose a bitmap", window.settings.folder)
    dialog.setNameFilters(FILTERS)
    dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    dialog.setFileMode(QFileDialog.FileMode.ExistingFile)
    dialog.fileSelected.connect(lambda path: take_bitmap(window, Path(path), then))
    dialog.open()


def take_bitmap(window: MainWindow, path: Path, then: Callable[[str, Path], None]) -> None:
    """Read and keep a bitmap file, then do what `then` says; what is refused is said in the status bar."""

    def work() -> str:
        from ...model.surface.bitmaps import keep_bitmap, texels_of

        sha = keep_bitmap(path)
        texels_of(sha)  # remembered: no picture waits for it
        return sha

    def done(sha: str) -> None:
        window.settings.folder = path.parent
        try:
            then(sha, path)
        except Refusal as refusal:
            refused(refusal)

    def refused(refusal: Refusal) -> None:
        window.status.say(f"{path.name}: {refusal}")

    window.files.background.run(f"Reading {path.name}", work, done, refused)


def bitmap_paths(data: QMimeData) -> list[Path]:
    """The bitmap files among what is dropped, by their endings."""
    paths = [Path(url.toLocalFile()) for url in data.urls() if url.isLocalFile()]
    return [path for path in paths if path.suffix.lower() in FORMATS]
