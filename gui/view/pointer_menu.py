"""The menu of a right click in the picture: what lies under the pointer, and the commands on nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QPoint
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu

from ...model.document.tree import walk
from ..icons import kind_icon
from ..tree.tree_menu import node_menu

if TYPE_CHECKING:
    from ...model.editing.session import Session
    from ..commands.actions import Actions
    from .occurrences import Path
    from .viewport import Viewport

MOST = 12
"""Nodes that are listed."""
ON_NOTHING = ("fit", "select_all", "", "view_iso", "view_front", "view_top", "view_right", "", "perspective", "grid")


def open_pointer_menu(
    viewport: Viewport, session: Session, actions: Actions, entries: list[tuple[str, Path, str]], place: QPoint
) -> QMenu:
    """`entries` as from Pointing: (id, path, words), front to back; the entry under the pointer is tinted in the
    picture."""
    menu = node_menu(actions, viewport.window())
    menu.setObjectName("pointer_menu")
    first = menu.actions()[0]
    if not entries and not session.selection:
        menu.clear()
        for name in ON_NOTHING:
            if name:
                menu.addAction(actions[name])
            else:
                menu.addSeparator()
    elif entries:
        kinds = {node.id: type(node) for node in walk(*session.document.roots)}
        chosen = set(session.selection)
        for owner, path, words in entries[:MOST]:
            action = QAction(kind_icon(kinds[owner]), words.replace("&", "&&"), menu)
            font = action.font()
            font.setBold(owner in chosen)
            action.setFont(font)
            action.setStatusTip("Select it")
            action.hovered.connect(lambda path=path: viewport.tint(path))
            action.triggered.connect(lambda _=False, owner=owner: session.select((owner,)))
            menu.insertAction(first, action)
        menu.insertSeparator(first)
    menu.aboutToHide.connect(lambda: viewport.tint(None))
    menu.popup(place)
    return menu
