"""A sheet of all keys and of what the mouse does, as they are now."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence
from PySide6.QtWidgets import QDialog, QFrame, QGridLayout, QHBoxLayout, QLabel, QScrollArea, QVBoxLayout, QWidget

from ..commands.actions import MENUS, Actions
from ..commands.menus import in_menu_order

COLUMNS = 3
MOUSE = (
    ("Drag", "Orbit"),
    ("Shift+drag, right drag", "Pan"),
    ("Wheel", "Zoom to the pointer"),
    ("Click", "Select the leaf that made the face"),
    ("Click again", "Its parent, and so on up"),
    ("Alt+click", "The whole solid"),
    ("Alt+Shift+click", "What lies behind"),
    ("Ctrl+click", "Add to the selection"),
    ("Right click", "Menu of what lies there"),
    ("Double click", "Fit what was clicked"),
    ("Click on the cube", "Look from there"),
    ("Arrow keys", "Turn the picture"),
    ("Space", "Tools at the pointer"),
    ("Escape", "Take back, or select nothing"),
)
HANDLES = (
    ("Digits", "Type the value, of a drag too"),
    ("=", "Before a value that begins with a name"),
    ("Tab", "The next number"),
    ("Ctrl", "No steps, no snapping"),
    ("Shift", "Finer steps"),
    ("Enter", "Keep it"),
    ("Escape", "As it was before"),
)
NODES = (
    ("Drag", "Nodes, handles, or the curve: it bends"),
    ("Shift, Ctrl with it", "15° steps, no snapping"),
    ("Alt with a handle", "Break the node"),
    ("Shift+click", "Add to the choice"),
    ("Shift+drag", "Choose a frame; Ctrl takes away"),
    ("Double click", "New node; on a node its next kind"),
    ("Right click", "Menu of nodes"),
    ("Arrow keys", "1 mm; Shift 10, Alt 0.1"),
    ("Tab", "The next node"),
    ("Ctrl+A, Delete", "All nodes, take out the chosen"),
)
TREE = (
    ("Drag", "Into an operation, or between rows"),
    ("Ctrl+drag", "A copy"),
    ("Enter, double click", "Rename"),
    ("Escape", "Select nothing"),
)
FIELDS = (
    ("↑ ↓, wheel", "One step"),
    ("Shift, Ctrl with it", "Finer, coarser"),
    ("Drag the label", "Slide the value"),
    ("Escape", "Take back what was typed"),
)


class CheatSheet(QDialog):
    """Made when it is opened, so that it shows the user's own shortcuts."""

    def __init__(self, actions: Actions, parent: QWidget) -> None:
        super().__init__(parent)
        self.setObjectName("cheat_sheet")
        self.setWindowTitle("Keys and mouse")
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        blocks = [
            ("In the picture", MOUSE),
            ("With handles", HANDLES),
            ("On an outline", NODES),
            ("In the tree", TREE),
            ("In number fields", FIELDS),
        ]
        for menu in MENUS:
            rows = []
            for command in in_menu_order(menu, actions.commands()):
                keys = [QKeySequence(one) for one in actions.keys(command.name).split("; ") if one]
                if keys:
                    words = ", ".join(key.toString(QKeySequence.SequenceFormat.NativeText) for key in keys)
                    rows.append((words, command.title))
            if rows:
                blocks.append((menu, tuple(rows)))
        body = QWidget(self)
        columns = QHBoxLayout(body)
        columns.setContentsMargins(20, 16, 20, 16)
        columns.setSpacing(28)
        heights = [0] * COLUMNS
        layouts = [QVBoxLayout() for _ in range(COLUMNS)]
        for layout in layouts:
            layout.setSpacing(14)
            columns.addLayout(layout, 1)
        for title, rows in blocks:
            shortest = heights.index(min(heights))
            heights[shortest] += len(rows) + 2
            layouts[shortest].addWidget(_block(title, rows, body))
        for layout in layouts:
            layout.addStretch(1)
        area = QScrollArea(self)
        area.setWidget(body)
        area.setWidgetResizable(True)
        area.setFrameShape(QFrame.Shape.NoFrame)
        area.setProperty("plain", True)
        outer = QVBoxLayout(self)
        outer.setContentsMargins(0, 0, 0, 0)
        outer.addWidget(area)
        screen = parent.screen().availableSize()
        self.resize(
            min(body.sizeHint().width() + 24, screen.width() - 40),
            min(body.sizeHint().height() + 4, screen.height() - 80),
        )


def _block(title: str, rows: tuple[tuple[str, str], ...], parent: QWidget) -> QWidget:
    block = QWidget(parent)
    grid = QGridLayout(block)
    grid.setContentsMargins(0, 0, 0, 0)
    grid.setHorizontalSpacing(10)
    grid.setVerticalSpacing(4)
    heading = QLabel(title, block)
    heading.setProperty("heading", True)
    grid.addWidget(heading, 0, 0, 1, 2)
    for row, (keys, words) in enumerate(rows, 1):
        key = QLabel(keys, block)
        key.setProperty("key", True)
        grid.addWidget(key, row, 0, Qt.AlignmentFlag.AlignLeft)
        grid.addWidget(QLabel(words, block), row, 1)
    grid.setColumnStretch(1, 1)
    return block
