"""The menu of the space bar: the tools for what is selected or under the pointer, at the pointer, each by a letter."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QAction, QCursor, QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QFrame, QGridLayout, QLabel, QPushButton, QToolButton, QVBoxLayout

from ...model.document.tree import find
from .tool import Tool

if TYPE_CHECKING:
    from ..window import MainWindow

COLUMNS, CELL = 3, 158  # buttons in a line, and their width in pixels
MOST = 21

# In the order of the menu; what the tables do not hold, or what cannot be done now, is left out.
SEVERAL = (
    "union", "difference", "intersection", "handles_move", "handles_turn", "handles_scale", "measure", "section_face",
    "hull", "group", "isolate", "toggle_visible", "fit_selection", "duplicate", "ghosts", "delete", "drop_to_ground",
)  # fmt: skip
ONE = (
    "handles_move", "handles_turn", "handles_scale", "handles_size", "place_on_face", "drop_to_ground", "measure",
    "section_face", "ghosts", "isolate", "toggle_visible", "fit_selection", "rename", "duplicate", "delete",
    "promote", "dissolve", "unlink", "linear_array", "polar_array", "mirror",
)  # fmt: skip
NOTHING = (
    "add_box", "add_sphere", "add_cylinder", "add_cone", "add_torus", "add_halfspace", "measure", "fit", "select_all",
    "view_iso", "view_front", "view_top", "view_right", "perspective", "grid", "section_face",
)  # fmt: skip


def tools_for(window: MainWindow, count: int) -> list[str]:
    """Names of the commands that make sense for so many selected nodes and can be used now."""
    wanted = SEVERAL if count > 1 else ONE if count else NOTHING
    commands = {command.name: command for command in window.actions_.commands()}
    tools = [name for name, command in commands.items() if command.menu == "Tools"]
    names = [name for name in dict.fromkeys((*wanted, *tools)) if name in commands and name != "tool_menu"]
    return [name for name in names if window.actions_.fault(name) is None][:MOST]


def letters_for(titles: Iterable[str]) -> list[int]:
    """For each title the place of a letter that no other has: a word's first one if it is free; -1 where none is."""
    taken: set[str] = set()
    places: list[int] = []
    for title in titles:
        letters = [(i, c) for i, c in enumerate(title.lower()) if c.isalpha() and c.isascii()]
        first = [(i, c) for i, c in letters if i == 0 or title[i - 1] == " "]
        place, letter = next(((i, c) for i, c in (*first, *letters) if c not in taken), (-1, ""))
        taken.add(letter)
        places.append(place)
    return places


class ToolMenu(QFrame):
    """A pop-up. A letter runs a tool, arrows and Enter choose one; Space or other typing goes on into the palette."""

    def __init__(self, window: MainWindow, under: str | None) -> None:
        super().__init__(window, Qt.WindowType.Popup | Qt.WindowType.FramelessWindowHint)
        self.setObjectName("tool_menu")
        self.setProperty("popup", True)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._window = window
        session = window.session
        heading = QLabel(_about(window), self)
        heading.setProperty("heading", True)
        heading.setTextFormat(Qt.TextFormat.PlainText)
        names = tools_for(window, len(session.selection))
        actions = [window.actions_[name] for name in names]
        if under is not None and under not in session.selection:
            label = find(session.document, under).label
            select = QAction(f"Select “{label[:18]}”", self)
            select.triggered.connect(lambda: session.select([under]))
            actions.insert(0, select)
        grid = QGridLayout()
        grid.setSpacing(2)
        self.buttons: list[QToolButton] = []
        self._letters: dict[str, QToolButton] = {}
        titles = [action.text().replace("&", "") for action in actions]
        for place, (action, title, at) in enumerate(zip(actions, titles, letters_for(titles), strict=True)):
            button = QToolButton(self)
            button.setProperty("cell", True)
            button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
            button.setIcon(action.icon())
            button.setText(title if at < 0 else f"{title[:at]}&{title[at:]}")
            button.setToolTip(action.toolTip())
            button.setFixedWidth(CELL)
            button.setCheckable(action.isCheckable())
            button.setChecked(action.isChecked())
            button.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
            button.clicked.connect(lambda _=False, action=action: self._run(action))
            grid.addWidget(button, place // COLUMNS, place % COLUMNS)
            self.buttons.append(button)
            if at >= 0:
                self._letters[title[at].lower()] = button
        self.more = QPushButton("Type or press Space to find any command …", self)
        self.more.setProperty("line", True)
        self.more.setFlat(True)
        self.more.setIcon(window.actions_["palette"].icon())
        self.more.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.more.clicked.connect(lambda: self._find(""))
        layout = QVBoxLayout(self)
        layout.setContentsMargins(8, 8, 8, 6)
        layout.setSpacing(6)
        layout.addWidget(heading)
        layout.addLayout(grid)
        layout.addWidget(self.more)

    def open_at(self, place: QPoint) -> None:
        """Show it with its upper left corner near a place of the screen, wholly inside the screen."""
        self.adjustSize()
        screen = self._window.screen().availableGeometry()
        x = max(screen.left(), min(place.x() + 4, screen.right() - self.width()))
        y = max(screen.top(), min(place.y() + 4, screen.bottom() - self.height()))
        self.move(x, y)
        self.show()
        self.setFocus(Qt.FocusReason.PopupFocusReason)

    def _run(self, action: QAction) -> None:
        self.close()
        action.trigger()

    def _find(self, text: str) -> None:
        self.close()
        self._window.palette_.open(text)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        focus = self.focusWidget()
        at = next((i for i, button in enumerate(self.buttons) if button is focus), -1)
        steps = {Qt.Key.Key_Right: 1, Qt.Key.Key_Left: -1, Qt.Key.Key_Down: COLUMNS, Qt.Key.Key_Up: -COLUMNS}
        step = steps.get(Qt.Key(event.key()))
        text = event.text()
        if step is not None and self.buttons:
            to = (0 if step > 0 else len(self.buttons) - 1) if at < 0 else at + step
            if 0 <= to < len(self.buttons):
                self.buttons[to].setFocus(Qt.FocusReason.TabFocusReason)
        elif event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            if at >= 0:
                self.buttons[at].click()
        elif event.key() == Qt.Key.Key_Space:
            self._find("")
        elif text.lower() in self._letters:
            self._letters[text.lower()].click()
        elif text.isprintable() and text:
            self._find(text)
        else:
            super().keyPressEvent(event)


def _about(window: MainWindow) -> str:
    selection = window.session.selection
    if len(selection) == 1:
        return f"“{find(window.session.document, selection[0]).label}”"
    return f"{len(selection)} nodes selected" if selection else "Nothing is selected"


class SpaceBar(Tool):
    """Space in the picture opens the menu; what lies under the pointer is selected where nothing is selected yet."""

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window)
        self._window = window
        self._pointer: QPointF | None = None

    def move(self, event: QMouseEvent) -> bool:
        self._pointer = event.position()
        return False

    def leave(self) -> None:
        self._pointer = None

    def key(self, event: QKeyEvent) -> bool:
        if event.key() != Qt.Key.Key_Space or event.modifiers() or event.isAutoRepeat():
            return False
        self.open()
        return True

    def open(self) -> ToolMenu:
        """Open the menu at the pointer, or in the middle of the picture where the pointer is elsewhere."""
        viewport, session = self._window.viewport, self._window.session
        here = self._pointer or QPointF(viewport.mapFromGlobal(QCursor.pos()))
        inside = viewport.rect().contains(here.toPoint())
        under = self._under(here) if inside else None
        if under is not None and not session.selection:
            session.select([under])
        menu = ToolMenu(self._window, under)
        place = here.toPoint() if inside else viewport.rect().center()
        menu.open_at(viewport.mapToGlobal(place))
        return menu

    def _under(self, position: QPointF) -> str | None:
        viewer, pointing = self._window.viewport.viewer, self._window.viewport.pointing
        if viewer is None or pointing is None:
            return None
        return pointing.pointed.owner(viewer.pick(position.x(), position.y()))
