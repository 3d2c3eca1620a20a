"""The bitmap inspector: pixels on the left, pages about them on the right."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QAction, QDragEnterEvent, QDropEvent, QKeySequence
from PySide6.QtWidgets import (
    QFileDialog,
    QLabel,
    QMainWindow,
    QPushButton,
    QSplitter,
    QStackedWidget,
    QTabWidget,
    QVBoxLayout,
    QWidget,
)

from ...model.document.errors import Refusal
from ...model.image.inspection import lost_words, pixel_words
from ..background import Background
from ..icons import icon
from ..panels.property_edit import sentence
from ..surfaces.bitmap_files import FILTERS, bitmap_paths
from .change_pages import ChannelsPage, CompressionPage, DepthPage, TrialPage
from .facts_pages import BytesPage, HeaderPage, PalettePage
from .open_bitmap import OpenBitmap, read
from .pixel_view import ZOOM, PixelView
from .tiles_page import TilesPage

if TYPE_CHECKING:
    from ...model.image.bitmap import Bitmap
    from ..window import MainWindow

WRITTEN = (".bmp", ".png", ".tif", ".webp", ".jpg")
SHOWN = 8000  # milliseconds that a message stays


class BitmapWindow(QMainWindow):
    """One for each main window. It changes no document."""

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window, Qt.WindowType.Window)
        self.setObjectName("bitmap_window")
        self.setWindowTitle("Bitmap inspector")
        self.setAcceptDrops(True)
        self._window = window
        self._background = Background(self)
        self._background.busy.connect(self._busy)
        self.opened: OpenBitmap | None = None
        self.view = PixelView(self)
        self.view.pointed.connect(self._pointed)
        self.header = HeaderPage(self)
        self.bytes = BytesPage(self)
        self.palette_ = PalettePage(self)
        self.channels = ChannelsPage(self)
        self.depths = DepthPage(self._run, self)
        self.compression = CompressionPage(self._run, self)
        self.tiles = TilesPage(self._run, self)
        self.channels.shown.connect(self.view.show_pixels)
        self.depths.shown.connect(self.view.show_pixels)
        self.depths.save.connect(self._ask_save)
        self.compression.shown.connect(self.view.show_pixels)
        self.tiles.marked.connect(self._mark)
        self._lay_out()
        self.resize(1120, 700)

    # Opening.

    def ask(self) -> None:
        """Ask for a file."""
        dialog = QFileDialog(self, "Inspect a bitmap", self._window.settings.folder)
        dialog.setNameFilters(FILTERS)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.setFileMode(QFileDialog.FileMode.ExistingFile)
        dialog.fileSelected.connect(lambda path: self.open_file(Path(path)))
        dialog.open()

    def open_file(self, path: Path, name: str = "") -> None:
        """Read a file and show it; where it cannot be read, what is open stays."""

        def done(opened: OpenBitmap) -> None:
            if not name:
                self._window.settings.folder = path.parent
            self.show_bitmap(opened)

        self._background.run(f"Reading {name or path.name}", lambda: read(path, name), done,
                             lambda refusal: self._refuse(name or path.name, refusal))  # fmt: skip

    def open_asset(self, sha: str, name: str) -> None:
        """Show a bitmap of the project."""
        from ...model.project.assets import default_store

        store = default_store()
        if store.has(sha):
            self.open_file(store.path(sha), name)
        else:
            self._refuse(name, Refusal("it is missing from the project"))

    def show_bitmap(self, opened: OpenBitmap) -> None:
        self.opened = opened
        bitmap = opened.bitmap
        self.setWindowTitle(f"{opened.name} \u2013 Bitmap inspector")
        self.stack.setCurrentIndex(1)
        self.view.show_pixels(opened.rgba)
        for page in (self.header, self.bytes, self.palette_, self.channels, self.depths, self.compression, self.tiles):
            page.show_bitmap(opened)
        self.tabs.setEnabled(True)
        self.save_as.setEnabled(True)
        self.key.setEnabled(True)
        self.key.setChecked(bitmap.colour_key is not None)
        words = f"{bitmap.width} \u00d7 {bitmap.height} pixels, {bitmap.bits} bits, {bitmap.type}"
        self.facts.setText(words)
        self.statusBar().clearMessage()
        self._entered()

    def _switch_key(self) -> None:
        """Take the cursor's pixel as the colour key, or none."""
        opened = self.opened
        if opened is None:
            return
        bitmap, key = opened.bitmap, None
        if self.key.isChecked():
            x, y = self.view.cursor_at or (0, 0)
            red, green, blue = opened.rgba[y, x, :3].tolist()
            key = int(bitmap.samples()[y, x]) if bitmap.bits <= 8 else (red, green, blue)
        at = self.view.cursor_at
        self.show_bitmap(opened.with_key(key))
        if at is not None:
            self.view.point_at(*at)

    def _refuse(self, name: str, refusal: Refusal) -> None:
        self.statusBar().showMessage(f"{name}: {sentence(refusal)}", SHOWN)

    # Saving.

    def _ask_save(self, bitmap: Bitmap | None = None) -> None:
        found = bitmap or (self.opened.bitmap if self.opened is not None else None)
        if found is None or self.opened is None:
            return
        dialog = QFileDialog(self, "Save the bitmap as", self._window.settings.folder)
        dialog.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
        endings = {f"{ending[1:].upper()} (*{ending})": ending[1:] for ending in WRITTEN}
        dialog.setNameFilters([*endings])
        dialog.setDefaultSuffix("bmp")
        dialog.filterSelected.connect(lambda words: dialog.setDefaultSuffix(endings[words]))
        dialog.selectFile(Path(self.opened.name).stem)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.fileSelected.connect(lambda path: self.save(found, Path(path)))
        dialog.open()

    def save(self, bitmap: Bitmap, path: Path) -> None:
        """Write a bitmap in the format of the path's ending."""
        from ...model.image.pictures import save_bitmap

        lost = lost_words(bitmap, path.suffix.lower())
        told = f"{path.name} is written" + (f", without {lost}" if lost else "")
        self._background.run(
            f"Writing {path.name}",
            lambda: save_bitmap(bitmap, path),
            lambda _: self.statusBar().showMessage(told, SHOWN),
            lambda refusal: self._refuse(path.name, refusal),
        )

    # Parts.

    def _lay_out(self) -> None:
        bar = self.addToolBar("Bitmap")
        bar.setMovable(False)
        bar.setIconSize(QSize(18, 18))
        self._action(bar, "Open \u2026", "open", "Open a bitmap file", self.ask, QKeySequence.StandardKey.Open)
        self.save_as = self._action(bar, "Save as \u2026", "save_as", "Write the bitmap to another file or format",
                                    self._ask_save, QKeySequence.StandardKey.SaveAs)  # fmt: skip
        self.save_as.setEnabled(False)
        bar.addSeparator()
        self._action(bar, "Zoom in", "zoom_in", "Larger (+)", lambda: self.view.zoom(ZOOM))
        self._action(bar, "Zoom out", "zoom_out", "Smaller (\u2212)", lambda: self.view.zoom(1.0 / ZOOM))
        self._action(bar, "Fit", "fit", "The whole picture (0)", self.view.fit)
        self._action(bar, "1:1", "zoom_reset", "A pixel of the picture on each of the screen (1)", self.view.plain_size)
        empty = QWidget(self)
        column = QVBoxLayout(empty)
        words = QLabel("No bitmap is open.\nOpen one, or drop a file here: BMP, PNG, JPEG, TIFF or WebP.", empty)
        words.setAlignment(Qt.AlignmentFlag.AlignCenter)
        words.setProperty("muted", True)
        button = QPushButton("Open a bitmap \u2026", empty)
        button.clicked.connect(self.ask)
        column.addStretch(1)
        column.addWidget(words)
        column.addWidget(button, 0, Qt.AlignmentFlag.AlignCenter)
        column.addStretch(1)
        tip = "What has the colour of the pixel that was clicked shows nothing (K)"
        self.key = self._action(bar, "Colour key", "eye", tip, self._switch_key)
        self.key.setCheckable(True)
        self.key.setShortcut("K")
        self.key.setEnabled(False)
        self.stack = QStackedWidget(self)
        self.stack.addWidget(empty)
        self.stack.addWidget(self.view)
        self.tabs = QTabWidget(self)
        self.tabs.setDocumentMode(True)
        for title, page in (("Header", self.header), ("Bytes", self.bytes), ("Palette", self.palette_),
                            ("Channels", self.channels), ("Depth", self.depths), ("Compression", self.compression),
                            ("Tiles", self.tiles)):  # fmt: skip
            self.tabs.addTab(page, title)
        self.tabs.setEnabled(False)
        self.tabs.currentChanged.connect(self._entered)
        across = QSplitter(Qt.Orientation.Horizontal, self)
        across.addWidget(self.stack)
        across.addWidget(self.tabs)
        across.setStretchFactor(0, 1)
        across.setSizes([600, 520])
        across.setChildrenCollapsible(False)
        self.setCentralWidget(across)
        self.facts = QLabel(self)
        self.facts.setProperty("muted", True)
        self.statusBar().addPermanentWidget(self.facts)
        self.statusBar().setSizeGripEnabled(False)

    def _action(
        self,
        bar: Any,
        title: str,
        name: str,
        tip: str,
        run: Callable[[], None],
        shortcut: QKeySequence.StandardKey | None = None,
    ) -> QAction:
        action = QAction(icon(name), title, self)
        action.setToolTip(tip)
        action.triggered.connect(lambda: run())
        if shortcut is not None:
            action.setShortcut(QKeySequence(shortcut))
        bar.addAction(action)
        return action

    def _run(
        self, words: str, work: Callable[[], Any], done: Callable[[Any], None], failed: Callable[[], None]
    ) -> None:
        name = self.opened.name if self.opened is not None else ""

        def refused(refusal: Refusal) -> None:
            failed()
            self._refuse(name, refusal)

        self._background.run(words, work, done, refused)

    def _busy(self, words: str) -> None:
        if words:
            self.statusBar().showMessage(f"{words} \u2026")
        elif self.statusBar().currentMessage().endswith("\u2026"):
            self.statusBar().clearMessage()

    def _entered(self) -> None:
        """Another page: the picture shows what belongs to it."""
        page = self.tabs.currentWidget()
        if self.opened is None:
            return
        self.view.marks = []
        if not isinstance(page, ChannelsPage):
            self.view.show_pixels(self.opened.rgba)  # a trial's picture follows when it is there
        if isinstance(page, TrialPage | ChannelsPage | TilesPage):
            page.entered()
        if isinstance(page, BytesPage | PalettePage | TilesPage) and self.view.cursor_at is not None:
            page.point(*self.view.cursor_at)
        self.view.update()

    def _pointed(self, x: int, y: int) -> None:
        opened = self.opened
        if opened is None:
            return
        self.statusBar().showMessage(pixel_words(opened.bitmap, opened.rgba, x, y))
        for page in (self.bytes, self.palette_, self.tiles):
            if page.isVisible():
                page.point(x, y)

    def _mark(self, parts: Any) -> None:
        self.view.marks = list(parts)
        self.view.update()

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        if bitmap_paths(event.mimeData()):
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:
        paths = bitmap_paths(event.mimeData())
        if paths:
            event.acceptProposedAction()
            self.open_file(paths[0])

    def end(self) -> None:
        """Before the main window goes."""
        self.close()
        self._background.close()


def open_inspector(window: MainWindow, sha: str = "", name: str = "") -> BitmapWindow:
    """Bring the inspector to the front, with a bitmap of the project where its hash is told."""
    found = window.side_windows.of(BitmapWindow)
    if sha:
        found.open_asset(sha, name)
    found.show()
    found.raise_()
    found.activateWindow()
    found.view.setFocus()
    return found
