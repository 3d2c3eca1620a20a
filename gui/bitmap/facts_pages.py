"""Pages of the inspector that tell: the header, the memory, the bytes, the palette."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QRect, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFontDatabase, QMouseEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QComboBox,
    QHeaderView,
    QLabel,
    QPlainTextEdit,
    QScrollArea,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from ...model.image.inspection import PER_LINE, byte_lines, memory_rows, number_at, place_of
from ...model.image.report import header_facts
from ..theme import colours_now
from .open_bitmap import OpenBitmap

LINES = 512  # of bytes that are shown at once
SWATCH, ACROSS = 22, 16


def table(columns: Sequence[str], parent: QWidget) -> QTableWidget:
    """A table that is read, not written; the last column takes what room is left."""
    made = QTableWidget(0, len(columns), parent)
    made.setHorizontalHeaderLabels(list(columns))
    made.verticalHeader().hide()
    made.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
    made.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
    made.setShowGrid(False)
    made.setTabKeyNavigation(False)  # Tab goes on to what is next
    made.setWordWrap(True)
    head = made.horizontalHeader()
    head.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
    head.setSectionResizeMode(len(columns) - 1, QHeaderView.ResizeMode.Stretch)
    head.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
    return made


def fill(into: QTableWidget, rows: Sequence[Sequence[str]], numbers: Sequence[int] = ()) -> None:
    """Show these rows; the columns `numbers` stand to the right."""
    into.setRowCount(len(rows))
    for i, row in enumerate(rows):
        for j, words in enumerate(row):
            item = QTableWidgetItem(words)
            if j in numbers:
                item.setTextAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
            into.setItem(i, j, item)
    into.resizeRowsToContents()


class HeaderPage(QWidget):
    """The fields of the header by the textbook's names, and the memory that the pixels take."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.header = table(("Field", "Value"), self)
        self.header.setObjectName("header")
        self.memory = table(("Memory", "Bytes", "Reckoned as"), self)
        self.memory.setObjectName("memory")
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 8, 8, 8)
        column.addWidget(self.header, 3)
        column.addWidget(self.memory, 2)

    def show_bitmap(self, opened: OpenBitmap) -> None:
        facts = header_facts(opened.bitmap, len(opened.data))
        left_out = ("palette", "packed_size", "stored_size", "file_size")
        rows = [(_title(name), _words(value)) for name, value in facts.items() if name not in left_out]
        palette = opened.bitmap.palette
        rows.append(("Palette", "none" if palette is None else f"{len(palette)} colours"))
        fill(self.header, rows)
        fill(self.memory, memory_rows(opened.bitmap, len(opened.data)), (1,))


class BytesPage(QWidget):
    """The bytes of the file, or those of the pixels as they are stored, where the cursor's pixel is marked."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.title = QLabel(self)
        self.title.setProperty("muted", True)
        self.title.setWordWrap(True)
        self.text = QPlainTextEdit(self)
        self.text.setObjectName("bytes")
        self.text.setReadOnly(True)
        self.text.setLineWrapMode(QPlainTextEdit.LineWrapMode.NoWrap)
        self.text.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
        self.what = QComboBox(self)
        self.what.setObjectName("what")
        self.what.setAccessibleName("Which bytes")
        self.what.addItems(["The file", "The pixels as stored"])
        self.what.setToolTip("The file from its header on; or the rows with their padding, without compression, "
                             "where the cursor's pixel is marked")  # fmt: skip
        self.what.activated.connect(self._refresh)
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 8, 8, 8)
        column.addWidget(self.what)
        column.addWidget(self.title)
        column.addWidget(self.text, 1)
        self._opened: OpenBitmap | None = None
        self._at: tuple[int, int] | None = None

    def show_bitmap(self, opened: OpenBitmap) -> None:
        self._opened, self._at = opened, None
        self._refresh()

    def point(self, x: int, y: int) -> None:
        """The cursor's pixel."""
        self._at = (x, y)
        if self._of_pixels and self.isVisible():
            self._refresh()

    @property
    def _of_pixels(self) -> bool:
        return self.what.currentIndex() == 1

    def _refresh(self) -> None:
        opened = self._opened
        if opened is None:
            return
        if not self._of_pixels:
            data, start, base, byte = opened.data, 0, 0, 0
            self.title.setText(f"{len(data):,} bytes" + _cut(len(data)))
        else:
            bitmap = opened.bitmap
            byte, bit = place_of(bitmap, *self._at) if self._at is not None else (0, 0)
            start = max(byte // PER_LINE - LINES // 4, 0) * PER_LINE
            first = start // bitmap.pitch
            last = min((start + LINES * PER_LINE) // bitmap.pitch + 1, bitmap.height)
            data, base = bitmap.pixels[first:last].tobytes(), first * bitmap.pitch
            where = f"; the cursor's pixel begins at byte {byte:08x}, bit {bit}" if self._at is not None else ""
            self.title.setText(f"{bitmap.stored_size:,} bytes in rows of {bitmap.pitch}{where}")
        lines = byte_lines(data, start, LINES, base)
        self.text.setPlainText("\n".join(lines))
        if self._of_pixels and self._at is not None:
            block = self.text.document().findBlockByNumber((byte - start) // PER_LINE)
            cursor = self.text.textCursor()
            cursor.setPosition(block.position() + 10 + 3 * (byte % PER_LINE))
            cursor.movePosition(cursor.MoveOperation.Right, cursor.MoveMode.KeepAnchor, 2)
            self.text.setTextCursor(cursor)
            self.text.centerCursor()


class PalettePage(QWidget):
    """The colours by index. `chosen` tells one that is clicked; the cursor's is marked."""

    chosen = Signal(int)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.swatches = Swatches(self)
        self.swatches.chosen.connect(self._choose)
        self.words = QLabel(self)
        self.words.setProperty("muted", True)
        self.words.setWordWrap(True)
        area = QScrollArea(self)
        area.setWidgetResizable(True)
        area.setWidget(self.swatches)
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 8, 8, 8)
        column.addWidget(self.words)
        column.addWidget(area, 1)
        self._opened: OpenBitmap | None = None

    def show_bitmap(self, opened: OpenBitmap) -> None:
        self._opened = opened
        palette = opened.bitmap.palette
        self.swatches.show_palette([] if palette is None else [tuple(row) for row in palette.tolist()])
        if palette is None:
            depth = f"{opened.bitmap.bits} bits a pixel hold the colours themselves: there is no palette."
            self.words.setText(depth if opened.bitmap.bits > 8 else "Without a palette: even steps of grey.")
        else:
            self.words.setText(f"{len(palette)} colours; a click tells how many pixels have one.")

    def point(self, x: int, y: int) -> None:
        if self._opened is not None and self._opened.bitmap.palette is not None and self.isVisible():
            self.swatches.mark(number_at(self._opened.bitmap, x, y))

    def _choose(self, index: int) -> None:
        if self._opened is None or self._opened.bitmap.palette is None:
            return
        samples = self._opened.bitmap.samples()
        count, red, green, blue = int((samples == index).sum()), *self._opened.bitmap.palette[index, :3].tolist()
        share = 100.0 * count / max(samples.size, 1)
        self.words.setText(
            f"Index {index}: #{red:02x}{green:02x}{blue:02x}, red {red}, green {green}, blue {blue}; "
            f"{count:,} pixels, {share:.1f} %"
        )
        self.chosen.emit(index)


class Swatches(QWidget):
    """Squares of colours, ACROSS in a row."""

    chosen = Signal(int)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName("Palette")
        self._colours: list[tuple[int, ...]] = []
        self._marked = -1

    def show_palette(self, colours: list[tuple[int, ...]]) -> None:
        self._colours, self._marked = colours, -1
        self.setMinimumSize(self.sizeHint())
        self.update()

    def mark(self, index: int) -> None:
        if index != self._marked:
            self._marked = index
            self.update()

    def sizeHint(self) -> QSize:
        return QSize(ACROSS * SWATCH + 2, -(-len(self._colours) // ACROSS) * SWATCH + 2)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        for index, (red, green, blue, *_) in enumerate(self._colours):
            square = _square(index)
            painter.fillRect(square, QColor(red, green, blue))
            painter.setPen(QColor(colours_now().border))
            painter.drawRect(square)
        if 0 <= self._marked < len(self._colours):
            for colour, width in (("white", 0), (colours_now().error, 1)):
                painter.setPen(QColor(colour))
                painter.drawRect(_square(self._marked).adjusted(width, width, -width, -width))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        place = event.position().toPoint()
        index = place.y() // SWATCH * ACROSS + place.x() // SWATCH
        if place.x() < ACROSS * SWATCH and 0 <= index < len(self._colours):
            self.mark(index)
            self.chosen.emit(index)


def _square(index: int) -> QRect:
    return QRect(index % ACROSS * SWATCH, index // ACROSS * SWATCH, SWATCH - 2, SWATCH - 2)


def _title(name: str) -> str:
    return name.replace("_", " ").capitalize()


def _words(value: object) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, list | tuple):
        return ", ".join(map(str, value))
    return "none" if value is None else str(value)


def _cut(count: int) -> str:
    return f"; the first {LINES * PER_LINE:,} of them" if count > LINES * PER_LINE else ""
