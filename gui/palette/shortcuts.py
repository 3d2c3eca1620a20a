"""The dialog in which every command's keys are looked up and changed."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QHBoxLayout,
    QHeaderView,
    QKeySequenceEdit,
    QLabel,
    QLineEdit,
    QPushButton,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

from ..commands.actions import Actions
from ..icons import icon
from .fuzzy import match

TITLE, MENU, KEYS, DEFAULT = range(4)
NAME = Qt.ItemDataRole.UserRole

# What has a meaning of its own in the picture, in lists or in fields, and would lose it.
RESERVED = {
    "Esc": "takes back what is under way",
    "Space": "opens the tools at the pointer",
    "Left": "turns the picture",
    "Right": "turns the picture",
    "Up": "turns the picture",
    "Down": "turns the picture",
    "Return": "accepts what is typed",
    "Enter": "accepts what is typed",
    "Tab": "goes on to the next field",
    "Backspace": "erases what is typed",
    "Ctrl+C": "copies text",
    "Ctrl+V": "pastes text",
    "Ctrl+X": "cuts text",
}


class KeyField(QKeySequenceEdit):
    """Takes one shortcut, as it is pressed."""

    def __init__(self, hint: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setMaximumSequenceLength(1)
        self.setClearButtonEnabled(True)
        self.line = self.findChild(QLineEdit)
        if isinstance(self.line, QLineEdit):
            self.line.setPlaceholderText(hint)

    @property
    def keys(self) -> str:
        return self.keySequence().toString()


class Shortcuts(QDialog):
    """Changes hold at once, in menus, tooltips and the palette; the settings keep what is not the default."""

    def __init__(self, actions: Actions, parent: QWidget) -> None:
        super().__init__(parent)
        self.setObjectName("shortcuts")
        self.setWindowTitle("Keyboard shortcuts")
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._actions = actions
        self.search = QLineEdit(self)
        self.search.setPlaceholderText("Find by name …")
        self.search.setClearButtonEnabled(True)
        self.pressed = KeyField("… or press its keys", self)
        self.pressed.setToolTip("Press a shortcut to see what has it")
        self.list = QTreeWidget(self)
        self.list.setRootIsDecorated(False)
        self.list.setUniformRowHeights(True)
        self.list.setAccessibleName("Commands")
        self.list.setHeaderLabels(["Command", "Menu", "Shortcut", "By default"])
        header = self.list.header()
        header.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        header.setStretchLastSection(False)
        header.setSectionResizeMode(TITLE, QHeaderView.ResizeMode.Stretch)
        for column, width in ((MENU, 130), (KEYS, 140), (DEFAULT, 130)):
            self.list.setColumnWidth(column, width)
        self.what = QLabel(self)
        self.what.setTextFormat(Qt.TextFormat.PlainText)
        self.field = KeyField("Press the new keys", self)
        self.clear = QPushButton("Remove", self)
        self.reset = QPushButton("Reset", self)
        self.told = QLabel(self)
        self.told.setWordWrap(True)
        self.told.setTextFormat(Qt.TextFormat.PlainText)
        self.take = QPushButton("Take it", self)
        self.leave = QPushButton("Leave it", self)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close, self)
        self.reset_all = buttons.addButton("Reset all", QDialogButtonBox.ButtonRole.ResetRole)
        for button in self.findChildren(QPushButton):
            button.setAutoDefault(False)  # Return is a key like others here
        top, editor, question = QHBoxLayout(), QHBoxLayout(), QHBoxLayout()
        top.addWidget(self.search, 1)
        top.addWidget(self.pressed)
        for widget in (self.what, self.field, self.clear, self.reset):
            editor.addWidget(widget, int(widget is self.what))
        for widget in (self.told, self.take, self.leave):
            question.addWidget(widget, int(widget is self.told))
        layout = QVBoxLayout(self)
        layout.setContentsMargins(16, 16, 16, 16)
        layout.setSpacing(8)
        layout.addLayout(top)
        layout.addWidget(self.list, 1)
        for line in (editor, question):
            line.setSpacing(8)
            layout.addLayout(line)
        layout.addWidget(buttons)
        self.resize(720, 560)
        self._fill()
        self.search.textChanged.connect(self._filter)
        self.pressed.keySequenceChanged.connect(self._filter)
        self.list.currentItemChanged.connect(lambda: self._show_current())
        self.list.itemActivated.connect(lambda: self.field.setFocus())
        self.field.keySequenceChanged.connect(self._pressed_new)
        self.clear.clicked.connect(lambda: self._set(""))
        self.reset.clicked.connect(self._reset)
        self.take.clicked.connect(self._take)
        self.leave.clicked.connect(self._show_current)
        self.reset_all.clicked.connect(self._actions.reset_keys)
        buttons.rejected.connect(self.reject)
        actions.keys_changed.connect(self._refresh)
        self.choose(actions.commands()[0].name)
        self.search.setFocus()

    @property
    def name(self) -> str:
        """The command whose row is current, "" for none."""
        item = self.list.currentItem()
        return "" if item is None or item.isHidden() else item.data(TITLE, NAME)

    def choose(self, name: str) -> None:
        """Make a command's row the current one."""
        for item in self._items():
            if item.data(TITLE, NAME) == name:
                self.list.setCurrentItem(item)
                self.list.scrollToItem(item)

    def _items(self) -> list[QTreeWidgetItem]:
        found = (self.list.topLevelItem(row) for row in range(self.list.topLevelItemCount()))
        return [item for item in found if item is not None]

    def _fill(self) -> None:
        for command in self._actions.commands():
            item = QTreeWidgetItem([command.title, command.menu.replace("/", " › ")])  # noqa: RUF001
            item.setData(TITLE, NAME, command.name)
            picture = self._actions[command.name].icon()
            item.setIcon(TITLE, icon("blank") if picture.isNull() else picture)
            item.setToolTip(TITLE, command.tip)
            self.list.addTopLevelItem(item)
        self._refresh()

    def _refresh(self) -> None:
        for item in self._items():
            name = item.data(TITLE, NAME)
            own, default = self._actions.keys(name), self._actions.default_keys(name)
            item.setText(KEYS, _native(own))
            item.setText(DEFAULT, _native(default) if own != default else "")
            font = item.font(KEYS)
            font.setBold(own != default)
            item.setFont(KEYS, font)
        self._filter()
        self._show_current()

    def _filter(self) -> None:
        text, keys = self.search.text().strip(), self.pressed.keys
        holders = self._actions.holders(keys) if keys else []
        for item in self._items():
            named = not text or match(text, item.text(TITLE)) is not None
            item.setHidden(not named or bool(keys and item.data(TITLE, NAME) not in holders))
        shown = [item for item in self._items() if not item.isHidden()]
        current = self.list.currentItem()
        if shown and (current is None or current.isHidden()):
            self.list.setCurrentItem(shown[0])
        elif not shown:
            self._show_current()
            self._tell(f"No command has {_native(keys)}" if keys and not text else "No command is called that", False)

    def _show_current(self) -> None:
        name = self.name
        title = self._title(name) if name else ""
        self.what.setText(f"New shortcut for “{title}”" if name else "")
        self.field.blockSignals(True)
        self.field.clear()
        self.field.blockSignals(False)
        own = self._actions.keys(name) if name else ""
        self.field.setEnabled(bool(name))
        self.clear.setEnabled(bool(own))
        self.reset.setEnabled(bool(name) and own != self._actions.default_keys(name))
        self._tell("", False)

    def _title(self, name: str) -> str:
        return next(command.title for command in self._actions.commands() if command.name == name)

    def _tell(self, text: str, question: bool) -> None:
        self.told.setText(text or " ")
        self.told.setProperty("fault", bool(text))
        self.told.style().polish(self.told)
        self.take.setVisible(question)
        self.leave.setVisible(question)

    def _pressed_new(self) -> None:
        keys, name = self.field.keys, self.name
        if not keys or not name:
            return
        native = _native(keys)
        if keys in RESERVED:
            self._tell(f"{native} {RESERVED[keys]} and stays what it is", False)
            return
        others = [self._title(other) for other in self._actions.holders(keys) if other != name]
        if others:
            self._tell(f"{native} is “{'” and “'.join(others)}”: take it away there?", True)
            self.take.setFocus()
        else:
            self._set(keys)

    def _take(self) -> None:
        keys, name = self.field.keys, self.name
        for other in self._actions.holders(keys):
            if other != name:
                self._actions.take_keys(other, keys)
        self._set(keys)

    def _set(self, keys: str) -> None:
        name = self.name
        self._actions.set_keys(name, keys)
        words = f"“{self._title(name)}” is {_native(keys)} now" if keys else f"“{self._title(name)}” has no keys now"
        self.told.setText(words)
        self.told.setProperty("fault", False)
        self.told.style().polish(self.told)
        self.list.setFocus()

    def _reset(self) -> None:
        name = self.name
        default = self._actions.default_keys(name)
        for keys in filter(None, default.split("; ")):
            others = [self._title(other) for other in self._actions.holders(keys) if other != name]
            if others:
                self._tell(f"{_native(keys)} is “{others[0]}” now; take it away there first", False)
                return
        self._actions.set_keys(name, None)
        self.list.setFocus()


def _native(keys: str) -> str:
    return ", ".join(QKeySequence(one).toString(QKeySequence.SequenceFormat.NativeText) for one in keys.split("; "))
