"""The command palette: every command by a few of its letters, with its shortcut and why it is greyed."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QModelIndex, QObject, QPersistentModelIndex, QRect, QSize, Qt
from PySide6.QtGui import QKeyEvent, QKeySequence, QPainter, QPalette
from PySide6.QtWidgets import (
    QApplication,
    QFrame,
    QLabel,
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QVBoxLayout,
    QWidget,
)

from .actions import Actions
from .icons import icon

NAME, DETAIL, FAULT = Qt.ItemDataRole.UserRole, Qt.ItemDataRole.UserRole + 1, Qt.ItemDataRole.UserRole + 2

LINES, LINE_HEIGHT = 12, 28


def score(pattern: str, text: str) -> float | None:
    """How well the letters of `pattern` stand in `text` in this order, higher is better; None where they do not.

    Letters that begin a word and letters that follow each other count most.
    """
    wanted, within = pattern.lower().replace(" ", ""), text.lower()
    if not wanted:
        return 0.0
    if wanted in within.replace(" ", ""):
        start = within.find(pattern.lower().strip())
        return 1000.0 - max(start, 0) - 0.1 * len(within) + (50.0 if start == 0 or within[start - 1] == " " else 0.0)
    total, place, last = 0.0, 0, -2
    for letter in wanted:
        place = within.find(letter, place)
        if place < 0:
            return None
        total += 8.0 if place == 0 or not within[place - 1].isalnum() else 5.0 if place == last + 1 else 1.0
        last, place = place, place + 1
    return total - 0.05 * len(within)


class Palette(QFrame):
    """A pop-up over the window; it goes when a command is run, with Escape, or with a click beside it."""

    def __init__(self, actions: Actions, parent: QWidget) -> None:
        super().__init__(parent, Qt.WindowType.Popup | Qt.WindowType.FramelessWindowHint)
        self.setObjectName("palette")
        self.setProperty("popup", True)
        self._actions = actions
        self._window = parent
        self.field = QLineEdit(self)
        self.field.setPlaceholderText("Find a command …")
        self.field.setClearButtonEnabled(True)
        self.field.installEventFilter(self)
        self.list = QListWidget(self)
        self.list.setItemDelegate(_Line(self.list))
        self.list.setUniformItemSizes(True)
        self.list.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.list.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.list.setIconSize(QSize(18, 18))
        self._hint = QLabel(self)
        self._hint.setProperty("muted", True)
        self._hint.setContentsMargins(8, 4, 8, 4)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(8, 8, 8, 4)
        layout.setSpacing(6)
        layout.addWidget(self.field)
        layout.addWidget(self.list)
        layout.addWidget(self._hint)
        self.field.textChanged.connect(self._filter)
        self.list.itemClicked.connect(self._run)
        self.list.currentItemChanged.connect(self._tell)

    def open(self) -> None:
        """Show it over the upper middle of the window, with everything listed."""
        window = self._window
        width = min(560, window.width() - 40)
        corner = window.mapToGlobal(QRect(0, 0, window.width(), 0).topLeft())
        self.setGeometry(corner.x() + (window.width() - width) // 2, corner.y() + 80, width, 300)
        self.field.clear()
        self._filter("")
        self.show()
        self.field.setFocus(Qt.FocusReason.PopupFocusReason)

    def _filter(self, text: str) -> None:
        found = []
        for place, command in enumerate(self._actions.commands()):
            menu = command.menu.replace("/", " › ")  # noqa: RUF001
            points = [score(text, command.title), score(text, f"{menu} {command.title}")]
            best = max((p + (20.0 if i == 0 else 0.0) for i, p in enumerate(points) if p is not None), default=None)
            if best is not None and command.name != "palette":
                fault = self._actions.fault(command.name)
                found.append((fault is not None and bool(text) is False, -best, place, command, menu, fault))
        self.list.clear()
        for _, _, _, command, menu, fault in sorted(found, key=lambda entry: entry[:3]):
            item = QListWidgetItem(icon(command.icon), self._actions[command.name].text())
            keys = self._actions[command.name].shortcut().toString(QKeySequence.SequenceFormat.NativeText)
            item.setData(NAME, command.name)
            item.setData(DETAIL, (menu, keys))
            item.setData(FAULT, fault or "")
            item.setToolTip(command.tip)
            self.list.addItem(item)
        self.list.setCurrentRow(0)
        lines = min(max(self.list.count(), 1), LINES)
        self.list.setFixedHeight(lines * LINE_HEIGHT + 4)
        self.resize(self.width(), self.sizeHint().height())
        if not found:
            self._hint.setText("No command is called that.")

    def _tell(self, item: QListWidgetItem | None) -> None:
        if item is not None:
            fault = item.data(FAULT)
            self._hint.setText(f"Not now: {fault}" if fault else item.toolTip() or " ")

    def _run(self, item: QListWidgetItem | None) -> None:
        if item is None or item.data(FAULT):
            return
        self.close()
        self._actions.run(item.data(NAME))

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if isinstance(event, QKeyEvent) and event.type() == QEvent.Type.KeyPress:
            match event.key():
                case Qt.Key.Key_Down | Qt.Key.Key_Up | Qt.Key.Key_PageDown | Qt.Key.Key_PageUp:
                    QApplication.sendEvent(self.list, event)
                    return True
                case Qt.Key.Key_Return | Qt.Key.Key_Enter:
                    self._run(self.list.currentItem())
                    return True
                case Qt.Key.Key_Escape:
                    self.close()
                    return True
        return super().eventFilter(watched, event)


class _Line(QStyledItemDelegate):
    """Icon, title, place in the menus, and the shortcut at the right; greyed where the command cannot be used."""

    def paint(
        self, painter: QPainter, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        menu, keys = index.data(DETAIL)
        greyed = bool(index.data(FAULT))
        self.initStyleOption(option, index)
        chosen = bool(option.state & QStyle.StateFlag.State_Selected)
        text, option.text = option.text, ""
        if greyed:
            option.state &= ~QStyle.StateFlag.State_Enabled
        option.widget.style().drawControl(QStyle.ControlElement.CE_ItemViewItem, option, painter, option.widget)
        palette = option.palette
        group = QPalette.ColorGroup.Disabled if greyed else QPalette.ColorGroup.Active
        strong = QPalette.ColorRole.HighlightedText if chosen and not greyed else QPalette.ColorRole.Text
        quiet = strong if chosen else QPalette.ColorRole.PlaceholderText
        area = option.rect.adjusted(34, 0, -10, 0)
        middle = Qt.AlignmentFlag.AlignVCenter
        painter.save()
        painter.setPen(palette.color(group, strong))
        painter.drawText(area, middle | Qt.AlignmentFlag.AlignLeft, text)
        after = area.adjusted(option.fontMetrics.horizontalAdvance(text) + 12, 0, 0, 0)
        painter.setPen(palette.color(group, QPalette.ColorRole.Text if greyed else quiet))
        painter.drawText(after, middle | Qt.AlignmentFlag.AlignLeft, menu)
        painter.drawText(area, middle | Qt.AlignmentFlag.AlignRight, keys)
        painter.restore()

    def sizeHint(self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex) -> QSize:
        return QSize(100, LINE_HEIGHT)
