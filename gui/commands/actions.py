"""QActions made from the table of commands, kept right after every change, for menus, toolbars and the palette."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QAction, QActionGroup, QKeySequence
from PySide6.QtWidgets import QApplication, QMenu, QMenuBar, QToolBar, QToolButton, QWidget

from ...model.document.errors import Refusal
from ...model.editing.commands import Command
from ..icons import icon
from ..panels.text_line import TextLine
from ..parameters.value_slider import ValueSlider
from ..settings import Settings

MENUS = ("File", "Edit", "Add", "Combine", "Curve", "Tools", "View", "Help")


class Actions(QObject):
    """One action a command, by the command's name. `refused` carries the words of a command that could not be done.

    Shortcuts are the table's, or the user's own, which the settings keep; `keys_changed` tells when they are others.
    """

    refused = Signal(str)
    keys_changed = Signal()

    def __init__(self, owner: QWidget, settings: Settings) -> None:
        super().__init__(owner)
        self._owner = owner
        self._settings = settings
        self._entries: dict[str, tuple[Command, object, QAction]] = {}
        self._groups: dict[str, QActionGroup] = {}

    def add(self, commands: Iterable[Command], context: object) -> None:
        """Make the actions of these commands; `context` is what their functions take."""
        own = self._settings.shortcuts
        for command in commands:
            action = QAction(icon(command.icon or command.name), command.title, self._owner)
            action.setObjectName(command.name)
            action.setShortcuts(_sequences(own.get(command.name, command.shortcut)))
            action.setShortcutContext(Qt.ShortcutContext.WindowShortcut)
            action.setIconVisibleInMenu(not action.icon().isNull())
            if command.checked is not None:
                action.setCheckable(True)
                if "/" in command.menu:  # a submenu of switches is a choice of one
                    self._groups.setdefault(command.menu, QActionGroup(self)).addAction(action)
            action.triggered.connect(lambda _=False, name=command.name: self.run(name))
            self._owner.addAction(action)
            self._entries[command.name] = (command, context, action)

    def __getitem__(self, name: str) -> QAction:
        return self._entries[name][2]

    def commands(self) -> list[Command]:
        return [command for command, _, _ in self._entries.values()]

    def keys(self, name: str) -> str:
        """The shortcuts of a command in portable words, separated by `; `; "" where it has none."""
        return _words(self[name].shortcuts())

    def default_keys(self, name: str) -> str:
        return _words(_sequences(self._entries[name][0].shortcut))

    def holders(self, keys: str) -> list[str]:
        """The names of the commands that have this one shortcut."""
        wanted = QKeySequence(keys)
        return [name for name, (_, _, action) in self._entries.items() if wanted in action.shortcuts()]

    def set_keys(self, name: str, keys: str | None) -> None:
        """Give a command shortcuts of the user's own, "" for none, or the table's again with None."""
        default = self.default_keys(name)
        keys = default if keys is None else keys
        self[name].setShortcuts(_sequences(keys))
        own = {other: kept for other, kept in self._settings.shortcuts.items() if other != name}
        self._settings.shortcuts = own if self.keys(name) == default else own | {name: self.keys(name)}
        self._follow_keys()

    def take_keys(self, name: str, keys: str) -> None:
        """Take one shortcut away from a command; it keeps its others."""
        left = [one for one in self[name].shortcuts() if one != QKeySequence(keys)]
        self.set_keys(name, _words(left))

    def reset_keys(self) -> None:
        """The table's shortcuts for all commands."""
        self._settings.shortcuts = {}
        for command, _, action in self._entries.values():
            action.setShortcuts(_sequences(command.shortcut))
        self._follow_keys()

    def _follow_keys(self) -> None:
        self.refresh()
        self.keys_changed.emit()

    def fault(self, name: str) -> str | None:
        """Why the command cannot be used now, or None."""
        command, context, _ = self._entries[name]
        return command.fault(context)

    def run(self, name: str) -> None:
        command, context, _ = self._entries[name]
        focus = QApplication.focusWidget()
        if isinstance(focus, TextLine | ValueSlider):
            focus.submit()  # what is typed or turned counts before what is done next
        try:
            fault = command.fault(context)
            if fault:
                raise Refusal(f"{command.title}: {fault}")
            command.run(context)
        except Refusal as refusal:
            self.refused.emit(str(refusal))
        self.refresh()

    def refresh(self) -> None:
        """Bring every action's state, words and reason up to date."""
        for command, context, action in self._entries.values():
            fault = command.fault(context)
            action.setEnabled(fault is None)
            action.setToolTip(tool_tip(command, action, fault))
            action.setStatusTip(f"{command.title}: {fault}" if fault else command.tip)
            if command.checked is not None:
                action.setChecked(command.checked(context))

    def fill_menu_bar(self, bar: QMenuBar) -> dict[str, QMenu]:
        """A menu for every first part of the commands' places, and submenus; by place, such as `View/Style`."""
        menus: dict[str, QMenu] = {}
        for title in MENUS:
            menus[title] = bar.addMenu(f"&{title}")
            menus[title].setToolTipsVisible(True)
        for command, _, action in self._entries.values():
            title, _, sub = command.menu.partition("/")
            if sub and command.menu not in menus:
                menus[command.menu] = menus[title].addMenu(sub)
                menus[command.menu].setToolTipsVisible(True)
            menus[command.menu].addAction(action)
        return menus

    def fill_tool_bar(self, bar: QToolBar, names: Iterable[str]) -> None:
        """Buttons by name; an empty name makes a separator."""
        for name in names:
            if name:
                bar.addAction(self[name])
            else:
                bar.addSeparator()
        more = bar.findChild(QToolButton, "qt_toolbar_ext_button")  # shown where the window is too narrow
        if more is not None:
            more.setIcon(icon("more"))
            more.setToolTip("More buttons")


def _sequences(keys: str) -> list[QKeySequence]:
    return [QKeySequence(one) for one in keys.split("; ") if one]


def _words(sequences: Iterable[QKeySequence]) -> str:
    return "; ".join(one.toString() for one in sequences)


def tool_tip(command: Command, action: QAction, fault: str | None) -> str:
    keys = ", ".join(key.toString(QKeySequence.SequenceFormat.NativeText) for key in action.shortcuts())
    lines = [f"<b>{command.title}</b>" + (f"&nbsp;&nbsp;{keys}" if keys else "")]
    if command.tip:
        lines.append(command.tip)
    if fault:
        lines.append(f"<i>Not now: {escape(fault)}</i>")
    return "<p style='white-space:pre'>" + "<br>".join(lines) + "</p>"
