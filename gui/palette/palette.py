"""The command palette: commands, nodes, parameters and files by a few letters, with keys, and why one is greyed."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QAbstractListModel, QEvent, QModelIndex, QObject, QPersistentModelIndex, QRect, QSize, Qt
from PySide6.QtGui import QFont, QFontMetrics, QKeyEvent, QPainter, QPalette
from PySide6.QtWidgets import (
    QFrame,
    QLabel,
    QLineEdit,
    QListView,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QVBoxLayout,
)

from ..theme import colours_now
from .entries import Entry, entries

if TYPE_CHECKING:
    from ..window import MainWindow

ENTRY = Qt.ItemDataRole.UserRole
LINES, LINE_HEIGHT, WIDTH = 12, 28, 600
HINT = "↑ ↓ choose, Enter runs, Esc closes;  @ finds nodes"


class Palette(QFrame):
    """A pop-up over the window; it goes when something is run, with Escape, or with a click beside it."""

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window, Qt.WindowType.Popup | Qt.WindowType.FramelessWindowHint)
        self.setObjectName("palette")
        self.setProperty("popup", True)
        self._window = window
        self.field = QLineEdit(self)
        self.field.setPlaceholderText("Find a command, a parameter or a @node …")
        self.field.setAccessibleName("Find a command")
        self.field.setClearButtonEnabled(True)
        self.field.installEventFilter(self)
        self.rows = _Rows(self)
        self.list = QListView(self)
        self.list.setModel(self.rows)
        self.list.setItemDelegate(_Line(self.list))
        self.list.setUniformItemSizes(True)
        self.list.setMouseTracking(True)
        self.list.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.list.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._hint = QLabel(self)
        self._hint.setProperty("muted", True)
        self._hint.setContentsMargins(8, 4, 8, 4)
        self._column = layout = QVBoxLayout(self)
        layout.setContentsMargins(8, 8, 8, 4)
        layout.setSpacing(6)
        layout.addWidget(self.field)
        layout.addWidget(self.list)
        layout.addWidget(self._hint)
        self.field.textChanged.connect(self._filter)
        self.list.clicked.connect(lambda index: self._run(index.row()))
        self.list.selectionModel().currentChanged.connect(lambda index, _: self._tell(index.row()))

    def open(self, text: str = "") -> None:
        """Show it over the upper middle of the window, with what `text` finds, or everything."""
        window = self._window
        width = min(WIDTH, window.width() - 40)
        corner = window.mapToGlobal(QRect(0, 0, window.width(), 0).topLeft())
        self.setGeometry(corner.x() + (window.width() - width) // 2, corner.y() + 80, width, 300)
        self.field.blockSignals(True)
        self.field.setText(text)
        self.field.blockSignals(False)
        self._filter(text)
        self.show()
        self.field.setFocus(Qt.FocusReason.PopupFocusReason)

    @property
    def current(self) -> Entry | None:
        """The row that Enter runs."""
        return self.rows.entry(self.list.currentIndex().row())

    def _filter(self, text: str) -> None:
        found = entries(self._window, text)
        self.rows.show(found)
        self._choose(0, 1)
        lines = min(max(len(found), 1), LINES)
        self.list.setFixedHeight(lines * LINE_HEIGHT + 4)
        self._column.activate()
        self.resize(self.width(), self._column.sizeHint().height())
        if not found:
            self._hint.setText("Nothing is called that.")

    def _choose(self, row: int, step: int) -> None:
        """Go to a row, or on from it over headings."""
        count = self.rows.rowCount()
        row = min(max(row, 0), count - 1)
        if 0 <= row < count and not self.rows.chooseable(row):
            on = next((r for r in range(row, count if step > 0 else -1, step) if self.rows.chooseable(r)), None)
            row = on if on is not None else next((r for r in range(count) if self.rows.chooseable(r)), -1)
        if row >= 0:
            self.list.setCurrentIndex(self.rows.index(row))
            if row == 1 and not self.rows.chooseable(0):
                self.list.scrollToTop()

    def _tell(self, row: int) -> None:
        entry = self.rows.entry(row)
        if entry is not None:
            self._hint.setText(f"Not now: {entry.fault}" if entry.fault else entry.tip or HINT)

    def _run(self, row: int) -> None:
        entry = self.rows.entry(row)
        if entry is None or entry.run is None or entry.fault:
            return
        self.close()
        if entry.command:
            self._window.settings.add_recent_command(entry.command)
        entry.run()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if isinstance(event, QKeyEvent) and event.type() == QEvent.Type.KeyPress:
            row, last = self.list.currentIndex().row(), self.rows.rowCount() - 1
            plain = not event.modifiers() & Qt.KeyboardModifier.ShiftModifier  # Shift selects in the field
            match event.key():
                case Qt.Key.Key_Down:
                    self._choose(row + 1 if row < last else 0, 1)
                case Qt.Key.Key_Up:
                    first = not any(self.rows.chooseable(r) for r in range(row))
                    self._choose(last if first else row - 1, -1)
                case Qt.Key.Key_PageDown:
                    self._choose(row + LINES - 1, 1 if row + LINES <= last else -1)
                case Qt.Key.Key_PageUp:
                    self._choose(row - LINES + 1, -1 if row >= LINES else 1)
                case Qt.Key.Key_Home if plain:
                    self._choose(0, 1)
                case Qt.Key.Key_End if plain:
                    self._choose(last, -1)
                case Qt.Key.Key_Return | Qt.Key.Key_Enter:
                    self._run(row)
                case Qt.Key.Key_Escape:
                    self.close()
                case _:
                    return super().eventFilter(watched, event)
            return True
        return super().eventFilter(watched, event)


class _Rows(QAbstractListModel):
    """The entries found; those without a `run` are headings."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._entries: Sequence[Entry] = ()

    def show(self, found: Sequence[Entry]) -> None:
        self.beginResetModel()
        self._entries = found
        self.endResetModel()

    def entry(self, row: int) -> Entry | None:
        return self._entries[row] if 0 <= row < len(self._entries) else None

    def chooseable(self, row: int) -> bool:
        return self._entries[row].run is not None

    def rowCount(self, parent: QModelIndex | QPersistentModelIndex = QModelIndex()) -> int:  # noqa: B008
        return 0 if parent.isValid() else len(self._entries)

    def flags(self, index: QModelIndex | QPersistentModelIndex) -> Qt.ItemFlag:
        return super().flags(index) if self.chooseable(index.row()) else Qt.ItemFlag.NoItemFlags

    def data(self, index: QModelIndex | QPersistentModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        entry = self._entries[index.row()]
        match role:
            case Qt.ItemDataRole.DisplayRole:
                return entry.title
            case Qt.ItemDataRole.AccessibleDescriptionRole:
                return ", ".join(part for part in (entry.detail, entry.keys, entry.fault) if part)
            case Qt.ItemDataRole.UserRole:
                return entry
        return None


class _Line(QStyledItemDelegate):
    """Icon, title with the letters found, then its place or why it is greyed, and the keys at the right."""

    def paint(
        self, painter: QPainter, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        entry: Entry = index.data(ENTRY)
        self.initStyleOption(option, index)
        chosen = bool(option.state & QStyle.StateFlag.State_Selected)
        option.text = ""
        painter.save()
        colours, area, middle = colours_now(), option.rect.adjusted(34, 0, -10, 0), Qt.AlignmentFlag.AlignVCenter
        bold = QFont(option.font)
        bold.setWeight(QFont.Weight.Bold)
        if entry.run is None:
            painter.setFont(bold)
            painter.setPen(option.palette.color(QPalette.ColorGroup.Active, QPalette.ColorRole.PlaceholderText))
            painter.drawText(option.rect.adjusted(8, 4, 0, 0), middle, entry.title)
            painter.restore()
            return
        option.widget.style().drawControl(QStyle.ControlElement.CE_ItemViewItem, option, painter, option.widget)
        text = colours.on_accent if chosen else colours.disabled if entry.fault else colours.text
        quiet = colours.on_accent if chosen else colours.muted
        if entry.picture is not None:
            spot = QRect(option.rect.left() + 8, option.rect.center().y() - 8, 18, 18)
            mode = entry.picture.Mode
            entry.picture.paint(
                painter, spot, middle, mode.Selected if chosen else mode.Disabled if entry.fault else mode.Normal
            )
        painter.setPen(quiet)
        painter.drawText(area, middle | Qt.AlignmentFlag.AlignRight, entry.keys)
        room = area.adjusted(0, 0, -option.fontMetrics.horizontalAdvance(entry.keys) - 12, 0)
        x = room.left()
        for found, run in groupby(enumerate(entry.title), lambda pair: pair[0] in entry.places):
            part = "".join(letter for _, letter in run)
            painter.setFont(bold if found else option.font)
            painter.setPen(text if chosen or entry.fault or not found else colours.link)
            painter.drawText(room.adjusted(x - room.left(), 0, 0, 0), middle, part)
            x += QFontMetrics(bold if found else option.font).horizontalAdvance(part)
        painter.setFont(option.font)
        painter.setPen(quiet)
        rest = room.adjusted(x - room.left() + 12, 0, 0, 0)
        words = "  \u00b7  ".join(part for part in (entry.detail, entry.fault) if part)
        painter.drawText(rest, middle, option.fontMetrics.elidedText(words, Qt.TextElideMode.ElideRight, rest.width()))
        painter.restore()

    def sizeHint(self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex) -> QSize:
        return QSize(100, LINE_HEIGHT)
