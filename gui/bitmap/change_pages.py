"""Pages of the inspector that try changes: channels, depths, compression. Nothing is written but by Save."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QGridLayout,
    QLabel,
    QListWidget,
    QPushButton,
    QSlider,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from ...model.image.inspection import channel, channels_of
from .facts_pages import fill, table
from .open_bitmap import OpenBitmap

if TYPE_CHECKING:
    from ...model.image.bitmap import Bitmap
    from ...model.image.depth import Comparison

Run = Callable[[str, Callable[[], Any], Callable[[Any], None], Callable[[], None]], None]
"""Words, work for a thread, what takes its result, and what is done where it is refused."""
DEPTHS = (1, 2, 4, 8, 16, 24, 32)
DITHERS = (("None", "none"), ("Floyd\u2013Steinberg", "floyd-steinberg"), ("Ordered (Bayer)", "bayer"))
QUALITY = 80
QUIET = 150  # milliseconds after the last change of a value


class ChannelsPage(QWidget):
    """`shown` carries the pixels of the chosen channel."""

    shown = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.names = QListWidget(self)
        self.names.setObjectName("channels")
        self.names.setAccessibleName("Channel")
        self.names.currentTextChanged.connect(self._choose)
        words = QLabel("What the picture shows: all colours, one channel as grey, or one bit of the stored numbers.")
        words.setProperty("muted", True)
        words.setWordWrap(True)
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 8, 8, 8)
        column.addWidget(words)
        column.addWidget(self.names, 1)
        self._opened: OpenBitmap | None = None

    def show_bitmap(self, opened: OpenBitmap) -> None:
        self._opened = None
        self.names.clear()
        self.names.addItems([name.capitalize() for name in channels_of(opened.bitmap)])
        self.names.setCurrentRow(0)
        self._opened = opened

    def entered(self) -> None:
        """The page has come to the front."""
        item = self.names.currentItem()
        self._choose(item.text() if item is not None else "")

    def _choose(self, name: str) -> None:
        if self._opened is not None and name:
            self.shown.emit(channel(self._opened.bitmap, self._opened.rgba, name.lower()))


class TrialPage(QWidget):
    """A bitmap made anew by the values of a page, a moment after they have changed, beside the one that is open.

    `shown` carries the pixels of what is to be seen.
    """

    shown = Signal(object)

    def __init__(self, run: Run, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._run = run
        self._opened: OpenBitmap | None = None
        self._working = self._again = False
        self.result: Bitmap | None = None
        self.comparison: Comparison | None = None
        self.facts = table(("", "", ""), self)
        self.view = QComboBox(self)
        self.view.setObjectName("view")
        self.view.setAccessibleName("What the picture shows")
        self.view.addItems(["After", "Before", "Difference", "Difference, amplified"])
        self.view.activated.connect(self._show)
        self._quiet = QTimer(self)
        self._quiet.setSingleShot(True)
        self._quiet.setInterval(QUIET)
        self._quiet.timeout.connect(self._begin)

    def show_bitmap(self, opened: OpenBitmap) -> None:
        self._opened, self.result, self.comparison = opened, None, None
        self.facts.setRowCount(0)
        if self.isVisible():
            self._quiet.start(0)

    def entered(self) -> None:
        """The page has come to the front."""
        if self.result is None and self._opened is not None:
            self._quiet.start(0)
        else:
            self._show()

    def change(self) -> None:
        self._quiet.start()

    def _work(self, opened: OpenBitmap) -> Callable[[], Any]:
        raise RuntimeError("sub-classes say what is to be done")

    def _begin(self) -> None:
        """One at a time; of the values that come meanwhile the last ones count."""
        opened = self._opened
        if opened is None or self._working:
            self._again = opened is not None
            return
        self._working, self._again = True, False

        def done(result: tuple[Any, ...]) -> None:
            ended()
            if opened is self._opened and not self._again:
                self._take(*result)
                self._show()

        def ended() -> None:
            self._working = False
            if self._again:
                self._begin()

        self._run(f"Converting {opened.name}", self._work(opened), done, ended)

    def _take(self, *result: Any) -> None:
        raise RuntimeError("sub-classes keep what has been done")

    def _show(self) -> None:
        if self._opened is None or self.result is None or self.comparison is None or not self.isVisible():
            return
        what = self.view.currentIndex()
        difference = self.comparison.difference
        if what == 0:
            self.shown.emit(self.result.to_rgba())
        elif what == 1:
            self.shown.emit(self._opened.rgba)
        elif what == 2:
            self.shown.emit(difference)
        else:
            self.shown.emit(np.rint(difference * (255.0 / max(self.comparison.largest, 1))).astype(np.uint8))


class DepthPage(TrialPage):
    """Other depths, with and without dithering. `save` asks where the result goes."""

    save = Signal(object)

    def __init__(self, run: Run, parent: QWidget | None = None) -> None:
        super().__init__(run, parent)
        self.bits = QComboBox(self)
        self.bits.setObjectName("depth")
        self.bits.setAccessibleName("Depth")
        self.bits.addItems([f"{bits} bits" if bits > 1 else "1 bit" for bits in DEPTHS])
        self.bits.setCurrentIndex(2)
        self.dither = QComboBox(self)
        self.dither.setObjectName("dither")
        self.dither.setAccessibleName("Dithering")
        self.dither.addItems([title for title, _ in DITHERS])
        self.grey = QCheckBox("Even steps of grey", self)
        self.grey.setToolTip("Up to 8 bits: greys instead of the palette that suits the picture best (median cut)")
        for box in (self.bits, self.dither):
            box.activated.connect(self._chosen)
        self.grey.toggled.connect(self.change)
        button = QPushButton("Save as \u2026", self)
        button.setToolTip("Write the bitmap of this depth: BMP keeps every depth, PNG the colours")
        button.clicked.connect(lambda: self.result is not None and self.save.emit(self.result))
        grid = QGridLayout()
        for row, (words, widget) in enumerate(
            (("Depth", self.bits), ("Dithering", self.dither), ("", self.grey), ("Show", self.view), ("", button))
        ):
            grid.addWidget(_label(words, self), row, 0)
            grid.addWidget(widget, row, 1)
        grid.setColumnStretch(1, 1)
        self.facts.setHorizontalHeaderLabels(["", "Before", "After"])
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 8, 8, 8)
        column.addLayout(grid)
        column.addWidget(self.facts, 1)

    def _chosen(self) -> None:
        bits = DEPTHS[self.bits.currentIndex()]
        self.dither.setEnabled(bits <= 16)
        self.grey.setEnabled(1 < bits <= 8)
        self.change()

    def _work(self, opened: OpenBitmap) -> Callable[[], Any]:
        bits, dither, grey = DEPTHS[self.bits.currentIndex()], DITHERS[self.dither.currentIndex()][1], self.grey
        is_grey = grey.isChecked()

        def work() -> tuple[Bitmap, Comparison]:
            from ...model.image.depth import compared, with_depth

            made = with_depth(opened.bitmap, bits, dither, grey=is_grey)  # type: ignore[arg-type]
            return made, compared(opened.bitmap, made)

        return work

    def _take(self, *result: Any) -> None:
        self.result, self.comparison = made, comparison = result
        before = self._opened.bitmap if self._opened is not None else made
        fill(
            self.facts,
            [
                ("Bits a pixel", str(before.bits), str(made.bits)),
                ("Stored", f"{before.stored_size:,} bytes", f"{made.stored_size:,} bytes"),
                ("Palette", _palette(before), _palette(made)),
                ("Alpha", _yes(before.alpha), "lost" if before.alpha and not made.alpha else _yes(made.alpha)),
                ("Farthest off", "", f"{comparison.largest} levels"),
                ("PSNR", "", psnr_words(comparison.psnr)),
            ],
        )


class CompressionPage(TrialPage):
    """PNG, which loses nothing, against JPEG at a quality."""

    def __init__(self, run: Run, parent: QWidget | None = None) -> None:
        super().__init__(run, parent)
        self.quality = QSlider(Qt.Orientation.Horizontal, self)
        self.quality.setRange(1, 100)
        self.quality.setValue(QUALITY)
        self.quality.setObjectName("quality")
        self.quality.setAccessibleName("Quality of JPEG")
        self.number = QSpinBox(self)
        self.number.setRange(1, 100)
        self.number.setValue(QUALITY)
        self.quality.valueChanged.connect(self.number.setValue)
        self.number.valueChanged.connect(self.quality.setValue)
        self.quality.valueChanged.connect(self.change)
        self._png: tuple[OpenBitmap, int] | None = None
        grid = QGridLayout()
        grid.addWidget(_label("JPEG quality", self), 0, 0)
        grid.addWidget(self.quality, 0, 1)
        grid.addWidget(self.number, 0, 2)
        grid.addWidget(_label("Show", self), 1, 0)
        grid.addWidget(self.view, 1, 1, 1, 2)
        grid.setColumnStretch(1, 1)
        self.facts.setHorizontalHeaderLabels(["", "Bytes", "Of the stored pixels"])
        self.words = _label("", self)
        self.words.setWordWrap(True)
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 8, 8, 8)
        column.addLayout(grid)
        column.addWidget(self.facts, 1)
        column.addWidget(self.words)

    def _work(self, opened: OpenBitmap) -> Callable[[], Any]:
        quality = self.quality.value()
        known = self._png[1] if self._png is not None and self._png[0] is opened else None

        def work() -> tuple[Bitmap, Comparison, OpenBitmap, int]:
            from ...model.image.depth import through_jpeg
            from ...model.image.pictures import encoded

            back, comparison = through_jpeg(opened.bitmap, quality)
            png = len(encoded(opened.rgba, "PNG")) if known is None else known
            return back, comparison, opened, png

        return work

    def _take(self, *result: Any) -> None:
        self.result, comparison, opened, png = result
        self.comparison = comparison
        self._png = (opened, png)
        stored = opened.bitmap.stored_size
        rows = [("Stored", stored), ("File as it is", len(opened.data)), ("PNG", png), ("JPEG", comparison.sizes[1])]
        fill(self.facts, [(name, f"{size:,}", f"{100.0 * size / max(stored, 1):.1f} %") for name, size in rows], (1,))
        alpha = " JPEG has no transparency: it is lost." if bool((opened.rgba[..., 3] < 255).any()) else ""
        self.words.setText(
            f"PNG loses nothing. JPEG is off by up to {comparison.largest} levels; "
            f"signal to noise (PSNR) {psnr_words(comparison.psnr)}.{alpha}"
        )


def psnr_words(psnr: float) -> str:
    return "without loss" if np.isinf(psnr) else f"{psnr:.1f} dB"


def _yes(there: bool) -> str:
    return "yes" if there else "no"


def _palette(bitmap: Bitmap) -> str:
    return "none" if bitmap.palette is None else f"{len(bitmap.palette)} colours"


def _label(words: str, parent: QWidget) -> QLabel:
    label = QLabel(words, parent)
    label.setProperty("muted", True)
    return label
