"""The menu on nodes, in the tree, in the diagram and wherever else nodes are shown."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMenu, QWidget

from ..commands.actions import Actions

Entries = Sequence["str | tuple[str, Entries]"]

NODE_MENU: Entries = (
    "rename", "toggle_visible", "isolate", "fit_selection", "",
    "cut", "copy", "paste", "duplicate", "delete", "",
    ("Combine", ("union", "difference", "intersection", "hull", "minkowski", "", "linear_array", "polar_array",
                 "mirror", "displace", "", "group")),
    ("Change to", ("change_to_union", "change_to_difference", "change_to_intersection", "change_to_hull",
                   "change_to_minkowski", "", "change_to_linear_array", "change_to_polar_array", "change_to_mirror", "",
                   "change_to_extrude", "change_to_revolve")),
    ("Surface", ("use_material", "take_off_material", "checker_board", "", "texture_placement")),
    ("Order", ("move_up", "move_down", "move_out", "move_in", "", "promote", "swap")),
    ("Select", ("select_parent", "select_children", "select_same_kind", "", "select_definition", "select_instances")),
    "dissolve", "",
    "link", "unlink", "",
    "copy_script",
)  # fmt: skip
"""Names of commands; "" makes a line between them, a pair a submenu."""


def node_menu(actions: Actions, parent: QWidget) -> QMenu:
    """The menu, which goes when it is closed. A submenu in which nothing can be used is greyed."""
    menu = QMenu(parent)
    menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    _fill(menu, actions, NODE_MENU)
    return menu


def _fill(menu: QMenu, actions: Actions, entries: Entries) -> None:
    menu.setToolTipsVisible(True)
    for entry in entries:
        if isinstance(entry, tuple):
            title, names = entry
            below = menu.addMenu(title)
            _fill(below, actions, names)
            below.setEnabled(any(action.isEnabled() for action in below.actions() if not action.isSeparator()))
        elif entry:
            menu.addAction(actions[entry])
        else:
            menu.addSeparator()
