"""The menu of a right click on a node or a segment of the outline that is edited."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QPoint
from PySide6.QtWidgets import QMenu, QWidget

if TYPE_CHECKING:
    from ...commands.actions import Actions
    from ..active import ActiveCurve

ON_NODES = (
    "nodes_cusp", "nodes_smooth", "nodes_symmetric", "nodes_auto", "",
    "segments_line", "segments_cubic", "insert_nodes", "",
    "break_path", "join_nodes", "merge_nodes", "close_contours", "",
    "smooth_joints", "harmonise_joints", "match_curvature", "",
    "reverse_contours", "delete_nodes", "delete_nodes_plain",
)  # fmt: skip
ON_POINTS = ("convert_to_path", "", "reverse_contours", "delete_nodes")


def open_node_menu(actions: Actions, active: ActiveCurve, parent: QWidget, place: QPoint) -> QMenu:
    """What can be done with the chosen nodes, at a place of the screen; what cannot be done now is left out."""
    menu = QMenu(parent.window())
    menu.setObjectName("node_menu")
    menu.setToolTipsVisible(True)
    for name in ON_POINTS if active.by_points else ON_NODES:
        if not name:
            menu.addSeparator()
        elif actions.fault(name) is None:
            menu.addAction(actions[name])
    menu.aboutToHide.connect(menu.deleteLater)
    menu.popup(place)
    return menu
