"""The widgets of the Mesh panel: which solid, its counts, the modes of choosing, the tables, what is looked at."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QHBoxLayout,
    QLabel,
    QMenu,
    QSizePolicy,
    QTabWidget,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from ..commands.mesh import EDIT, MENU, MESH_SEPARATORS
from ..surfaces.buttons import flat_button
from .costs_page import CostsPage
from .table_page import TablePage

if TYPE_CHECKING:
    from ..commands.actions import Actions

PAGES = ("vertices", "normals", "faces", "edges")
MODES = ("mesh_vertex", "mesh_edge", "mesh_face", "mesh_loop", "mesh_chain")
WALKS = (
    ("Left", "The face on the left of the edge", ("mesh_left_before", "\u2039"), ("mesh_left_after", "\u203a")),
    ("Right", "The face on its right", ("mesh_right_before", "\u2039"), ("mesh_right_after", "\u203a")),
    ("Start", "The vertex that it begins at", ("mesh_start_turned", "\u21ba"), ("mesh_start_back", "\u21bb")),
    ("End", "The vertex that it runs to", ("mesh_end_turned", "\u21ba"), ("mesh_end_back", "\u21bb")),
)
"""What is walked round, and the commands of the two ways with what stands on their buttons."""


class MeshPage(QWidget):
    """What its widgets show and do is the inspector's. `solid_chosen` carries a root's id, `polygons_chosen` whether
    faces are polygons, `first_chosen` what numbers count from."""

    solid_chosen = Signal(str)
    polygons_chosen = Signal(bool)
    first_chosen = Signal(int)

    def __init__(self, actions: Actions, parent: QWidget) -> None:
        super().__init__(parent)
        self._actions = actions
        self.solid = QComboBox(self)
        self.solid.setAccessibleName("The solid that is inspected")
        self.solid.setToolTip("The solid that is inspected; a click on another one in the picture takes that")
        self.solid.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.solid.activated.connect(lambda place: self.solid_chosen.emit(self.solid.itemData(place)))
        self.faces = QComboBox(self)
        self.faces.setAccessibleName("What the faces are")
        self.faces.addItem("Polygons", True)
        self.faces.addItem("Triangles", False)
        self.faces.setToolTip("Flat faces as polygons with holes, or as the triangles that they are drawn by")
        self.faces.activated.connect(lambda place: self.polygons_chosen.emit(self.faces.itemData(place)))
        self.counts, self.euler = _words(self), _words(self)
        self.euler.setProperty("muted", True)
        self.empty = _words(self)
        self.tools = self._tool_row()
        self.pages = QTabWidget(self)
        self.pages.setDocumentMode(True)
        self.pages.setUsesScrollButtons(True)
        self.tables = {name: TablePage(name, self.pages) for name in PAGES}
        for name, page in self.tables.items():
            self.pages.addTab(page, name.capitalize())
        self.costs = CostsPage(self.pages)
        self.pages.addTab(self.costs, "Costs")
        self.looked = _words(self)
        self.looked.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.looked.setMinimumHeight(52)
        self.looked.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.walks = self._walk_row()
        top = QHBoxLayout()
        top.setContentsMargins(8, 6, 8, 0)
        top.setSpacing(4)
        top.addWidget(self.solid, 1)
        top.addWidget(self.faces)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addLayout(top)
        for part in (self.counts, self.euler, self.empty, self.tools):
            layout.addWidget(part)
        layout.addWidget(self.pages, 1)
        layout.addWidget(self.looked)
        layout.addWidget(self.walks)
        layout.addStretch(0)
        self.say("", {}, "")

    def _tool_row(self) -> QWidget:
        row = QWidget(self)
        layout = QHBoxLayout(row)
        layout.setContentsMargins(6, 2, 6, 2)
        layout.setSpacing(0)
        for name in MODES:
            button = flat_button(self._actions[name], row)
            button.setIconSize(QSize(18, 18))
            button.setAccessibleName(self._actions[name].text())
            layout.addWidget(button)
        layout.addStretch(1)
        self.first = QCheckBox("from 1", row)
        self.first.setToolTip("Count vertices, normals, faces and edges from 1 instead of 0")
        self.first.toggled.connect(lambda on: self.first_chosen.emit(int(on)))
        layout.addWidget(self.first)
        for title, menu, tip in (
            ("Choose", MENU, "Elements by angle, length, maker, and what lies around them; the clipboard and files"),
            ("Edit", EDIT, "Change the mesh: edges, faces and vertices of what is chosen"),
        ):
            button = QToolButton(row)
            button.setProperty("flat", True)
            button.setText(f"{title} \u25be")
            button.setToolTip(tip)
            button.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
            button.setMenu(self._menu(menu, button))
            layout.addWidget(button)
        return row

    def _menu(self, place: str, parent: QWidget) -> QMenu:
        menu = QMenu(parent)
        menu.setToolTipsVisible(True)
        for command in self._actions.commands():
            if command.menu == place:
                if command.name in MESH_SEPARATORS:
                    menu.addSeparator()
                menu.addAction(self._actions[command.name])
        return menu

    def _walk_row(self) -> QWidget:
        row = QWidget(self)
        layout = QHBoxLayout(row)
        layout.setContentsMargins(8, 0, 8, 4)
        layout.setSpacing(0)
        for title, tip, *ways in WALKS:
            label = QLabel(title, row)
            label.setToolTip(tip)
            label.setProperty("muted", True)
            layout.addWidget(label)
            for name, sign in ways:
                button = flat_button(self._actions[name], row)
                button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextOnly)
                self._actions[name].setIconText(sign)
                button.setAccessibleName(self._actions[name].text())
                layout.addWidget(button)
            layout.addStretch(1)
        return row

    def say(self, words: str, solids: dict[str, str], solid: str) -> None:
        """Why there is no mesh, "" where there is one; the solids by id, and the one that is shown."""
        there = not words and bool(solids)
        self.empty.setText(words)
        self.empty.setVisible(bool(words))
        for part in (self.counts, self.euler, self.tools, self.pages, self.looked, self.walks):
            part.setVisible(there)
        self.solid.setVisible(bool(solids))
        self.faces.setVisible(bool(solids))
        if [self.solid.itemData(i) for i in range(self.solid.count())] != [*solids] or any(
            self.solid.itemText(i) != name for i, name in enumerate(solids.values())
        ):
            self.solid.clear()
            for root, name in solids.items():
                self.solid.addItem(name, root)
        self.solid.setCurrentIndex(self.solid.findData(solid))

    def table(self) -> TablePage | None:
        """The table that is open; None on the costs."""
        found = self.pages.currentWidget()
        return found if isinstance(found, TablePage) else None


def _words(parent: QWidget) -> QLabel:
    label = QLabel(parent)
    label.setWordWrap(True)
    label.setContentsMargins(8, 4, 8, 4)
    label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
    return label
