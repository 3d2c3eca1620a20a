"""The page on tiled arrays: a small matrix whose cells light up, the index formulas, what accesses cost."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFont, QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QCheckBox, QHBoxLayout, QLabel, QPushButton, QSpinBox, QVBoxLayout, QWidget

from ...model.image.access import Access, counted, measured
from ...model.image.tiles import tile_and_place, tiled_index
from ..theme import colours_now
from .change_pages import Run
from .facts_pages import fill, table
from .open_bitmap import OpenBitmap

LARGEST = 24  # rows and columns of the small matrix
BOOK = (3, 3, 2)  # rows, columns and tile at first


class TilesPage(QWidget):
    """`marked` carries the parts of the open picture, in pixels, that are to be outlined: the tile at the cursor."""

    marked = Signal(object)

    def __init__(self, run: Run, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._run = run
        self._opened: OpenBitmap | None = None
        self._at = (0, 0)
        self._of_picture, self._other_tile = False, 64  # n of the picture, where the matrix is shown, and of that
        self.rows = self._number("rows", "p, rows", BOOK[0])
        self.columns = self._number("columns", "q, columns", BOOK[1])
        self.tile = self._number("tile", "n, side of a tile", BOOK[2])
        self.of_picture = QCheckBox("The open picture", self)
        self.of_picture.setObjectName("of_picture")
        self.of_picture.setToolTip("Take the open picture as one put together of n \u00d7 n bitmaps, "
                                   "and the pixel under its cursor")  # fmt: skip
        self.of_picture.toggled.connect(self._switch)
        self.matrix = Matrix(self)
        self.matrix.chosen.connect(self._choose)
        self.formulas = QLabel(self)
        self.formulas.setObjectName("formulas")
        self.formulas.setWordWrap(True)
        self.formulas.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.costs = table(("Read", "Row by row", "In tiles", "Time"), self)
        self.costs.setObjectName("costs")
        self.measure = QPushButton("Measure", self)
        self.measure.setToolTip("Write the open picture row by row and in tiles to two temporary files, and read "
                                "both, which lie in the system's memory then")  # fmt: skip
        self.measure.clicked.connect(self._measure)
        line = QHBoxLayout()
        for words, box in (("p", self.rows), ("q", self.columns), ("n", self.tile)):
            line.addWidget(QLabel(words, self))
            line.addWidget(box)
        line.addStretch(1)
        line.addWidget(self.of_picture)
        under = QHBoxLayout()
        self.costs_title = QLabel("Bytes that are read", self)
        self.costs_title.setProperty("muted", True)
        under.addWidget(self.costs_title, 1)
        under.addWidget(self.measure)
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 8, 8, 8)
        column.addLayout(line)
        column.addWidget(self.formulas)
        column.addWidget(self.matrix, 3)
        column.addLayout(under)
        column.addWidget(self.costs, 2)
        self._switch()

    def _number(self, name: str, words: str, value: int) -> QSpinBox:
        box = QSpinBox(self)
        box.setObjectName(name)
        box.setAccessibleName(words)
        box.setToolTip(words)
        box.setRange(1, LARGEST)
        box.setValue(value)
        box.valueChanged.connect(self._refresh)
        return box

    def show_bitmap(self, opened: OpenBitmap) -> None:
        self._opened = opened
        self._switch()

    def point(self, x: int, y: int) -> None:
        """The pixel under the picture's cursor."""
        if self.of_picture.isChecked():
            self._choose(x, y)

    def entered(self) -> None:
        self._refresh()

    @property
    def _size(self) -> tuple[int, int]:
        """Rows and columns."""
        if self.of_picture.isChecked() and self._opened is not None:
            return self._opened.bitmap.height, self._opened.bitmap.width
        return self.rows.value(), self.columns.value()

    def _switch(self) -> None:
        opened = self._opened
        self.of_picture.setEnabled(opened is not None)
        picture = self.of_picture.isChecked() and opened is not None
        for box in (self.rows, self.columns):
            box.setEnabled(not picture)
        self.tile.setMaximum(4096)
        if picture != self._of_picture:
            self._of_picture = picture
            kept, self._other_tile = self._other_tile, self.tile.value()
            self.tile.setValue(kept)
        self.tile.setMaximum(4096 if picture else LARGEST)
        self.matrix.setVisible(not picture)
        self.costs.setVisible(picture)
        self.costs_title.setVisible(picture)
        self.measure.setVisible(picture)
        self._choose(0, 0)

    def _choose(self, x: int, y: int) -> None:
        self._at = (x, y)
        self._refresh()

    def _refresh(self) -> None:
        rows, columns = self._size
        n = self.tile.value()
        x, y = min(self._at[0], columns - 1), min(self._at[1], rows - 1)
        self._at = (x, y)
        self.matrix.show_matrix(rows, columns, n, x, y)
        self.formulas.setText(formulas(x, y, rows, columns, n))
        opened = self._opened
        if self.of_picture.isChecked() and opened is not None:
            left, top = x // n * n, y // n * n
            tile = QRectF(left, top, min(n, columns - left), min(n, rows - top))
            self.marked.emit([tile] if self.isVisible() else [])
            self._show_costs(counted(columns, rows, n, opened.rgba.shape[2]))
        else:
            self.marked.emit([])

    def _show_costs(self, found: list[Access]) -> None:
        fill(self.costs, [(each.name, f"{each.rows:,}", f"{each.tiles:,}", _times(each)) for each in found], (1, 2))

    def _measure(self) -> None:
        opened, n = self._opened, self.tile.value()
        if opened is None:
            return
        self.measure.setEnabled(False)

        def done(found: list[Access]) -> None:
            self.measure.setEnabled(True)
            if opened is self._opened and n == self.tile.value():
                self._show_costs(found)

        self._run(f"Measuring tiles of {opened.name}", lambda: measured(opened.rgba, n), done,
                  lambda: self.measure.setEnabled(True))  # fmt: skip


def _times(access: Access) -> str:
    if access.rows_time is None or access.tiles_time is None:
        return "not measured"
    ratio = access.rows_time / access.tiles_time
    words = f"tiles {ratio:.1f} times faster" if ratio >= 1.0 else f"tiles {1.0 / ratio:.1f} times slower"
    return f"{1e3 * access.rows_time:.2f} and {1e3 * access.tiles_time:.2f} ms, {words}"


def formulas(x: int, y: int, rows: int, columns: int, n: int) -> str:
    """The place of column x of row y in rich text: row by row, in tiles in two steps, and in one."""
    across = -(-columns // n)
    number, place = (int(value) for value in tile_and_place(x, y, columns, n))
    index = int(tiled_index(x, y, columns, n))
    lines = (
        ("Row by row", f"y \u00b7 q + x = {y} \u00b7 {columns} + {x} = <b>{y * columns + x}</b>"),
        (
            "In tiles, two steps",
            f"tile (y\u00f7n) \u00b7 \u2308q/n\u2309 + x\u00f7n "
            f"= {y // n} \u00b7 {across} + {x // n} = <b>{number}</b>, "
            f"place (y mod n) \u00b7 n + x mod n = {y % n} \u00b7 {n} + {x % n} = <b>{place}</b>",
        ),
        (
            "In one step",
            f"((y\u00f7n) \u00b7 \u2308q/n\u2309 + x\u00f7n) \u00b7 n\u00b2 + (y mod n) \u00b7 n + x mod n = "
            f"{number} \u00b7 {n * n} + {place} = <b>{index}</b>",
        ),
        (
            "Memory",
            f"{rows * columns:,} elements; in tiles {-(-rows // n) * across:,} \u00b7 {n * n:,} = "
            f"{-(-rows // n) * across * n * n:,}, padded at the edges",
        ),
    )
    muted = colours_now().muted
    return f"Column x = {x} of row y = {y}, from 0<br>" + "<br>".join(
        f'<span style="color:{muted}">{title}:</span> {words}' for title, words in lines
    )


class Matrix(QWidget):
    """Cells with their place row by row above and their place in tiles below; the chosen cell, its tile, and what comes
    before it in its tile are tinted. `chosen` tells column and row."""

    chosen = Signal(int, int)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("matrix")
        self.setAccessibleName("Matrix in tiles")
        self.setToolTip("A click or the arrow keys choose a cell; above its place row by row, below in tiles")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self._shape = (1, 1, 1)
        self._at = (0, 0)

    def show_matrix(self, rows: int, columns: int, tile: int, x: int, y: int) -> None:
        self._shape, self._at = (rows, columns, tile), (x, y)
        self.setAccessibleDescription(f"{rows} rows, {columns} columns, tiles of {tile}; column {x} of row {y}")
        self.update()

    def _cell(self) -> float:
        """The side of a cell; padding counts."""
        rows, columns, n = self._shape
        across, down = -(-columns // n) * n, -(-rows // n) * n
        return max(min((self.width() - 8) / across, (self.height() - 8) / down, 64.0), 1.0)

    def paintEvent(self, event: QPaintEvent) -> None:
        rows, columns, n = self._shape
        x, y = self._at
        side, colours = self._cell(), colours_now()
        painter = QPainter(self)
        painter.translate(4, 4)
        font = QFont(self.font())
        font.setPointSizeF(max(min(side / 4.6, 11.0), 4.0))
        painter.setFont(font)
        for row in range(-(-rows // n) * n):
            for column in range(-(-columns // n) * n):
                cell = QRectF(column * side, row * side, side, side)
                inside = row < rows and column < columns
                same = row // n == y // n and column // n == x // n
                before = same and (row % n, column % n) <= (y % n, x % n)
                ground = colours.checked if before else colours.hover if same else colours.ground
                if (row, column) == (y, x):
                    ground = colours.accent
                painter.fillRect(cell, QColor(ground if inside or same else colours.window))
                painter.setPen(QPen(QColor(colours.border), 1.0))
                painter.drawRect(cell)
                if side < 14.0:
                    continue
                strong = colours.on_accent if (row, column) == (y, x) else colours.text
                half = QRectF(cell.x(), cell.y(), side, side / 2)
                painter.setPen(QColor(strong if inside else colours.disabled))
                painter.drawText(half.translated(0, side / 2), Qt.AlignmentFlag.AlignCenter,
                                 str(int(tiled_index(column, row, columns, n))))  # fmt: skip
                painter.setPen(QColor(strong if (row, column) == (y, x) else colours.muted))
                if inside:
                    painter.drawText(half, Qt.AlignmentFlag.AlignCenter, str(row * columns + column))
        painter.setPen(QPen(QColor(colours.text), 2.0))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        for top in range(0, rows, n):
            for left in range(0, columns, n):
                painter.drawRect(QRectF(left * side, top * side, n * side, n * side))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        at = (event.position() - QPointF(4, 4)) / self._cell()
        self._take(int(at.x()), int(at.y()))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        ways = {Qt.Key.Key_Left: (-1, 0), Qt.Key.Key_Right: (1, 0), Qt.Key.Key_Up: (0, -1), Qt.Key.Key_Down: (0, 1)}
        way = ways.get(Qt.Key(event.key()))
        if way is None:
            super().keyPressEvent(event)
        else:
            self._take(self._at[0] + way[0], self._at[1] + way[1])

    def _take(self, x: int, y: int) -> None:
        if 0 <= x < self._shape[1] and 0 <= y < self._shape[0]:
            self.chosen.emit(x, y)

    def sizeHint(self) -> QSize:
        return QSize(320, 260)

    def minimumSizeHint(self) -> QSize:
        return QSize(160, 120)
