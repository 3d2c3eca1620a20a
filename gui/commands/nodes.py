"""Commands on the chosen nodes of the outline that is edited, in the menu Curve. They take the MainWindow."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from ...model.document.outlines import CURVES
from ...model.editing.commands import Command
from ..curves.active import ActiveCurve
from ..curves.editing import node_edits

if TYPE_CHECKING:
    from ..window import MainWindow

Fault = Callable[["MainWindow"], str | None]

_KINDS = (
    ("cusp", "Cusp", "The handles of the chosen nodes go their own ways"),
    ("smooth", "Smooth", "The handles of the chosen nodes lie on one line"),
    ("symmetric", "Symmetric", "The handles of the chosen nodes lie on one line and are of one length"),
    ("auto", "Automatic", "The handles of the chosen nodes follow from the nodes beside them"),
)
_SEGMENTS = (
    ("line", "Line", "L", "Straight lines between the chosen nodes"),
    ("quad", "Quadratic", "", "Curves of one handle, as TrueType has them, between the chosen nodes"),
    ("cubic", "Cubic", "U", "Curves of two handles between the chosen nodes"),
)
_SIDES = (
    ("x", "min", "Left sides", "left"),
    ("x", "middle", "Middles, left to right", "middle"),
    ("x", "max", "Right sides", "right"),
    ("y", "min", "Bottoms", "lowest"),
    ("y", "middle", "Middles, bottom to top", "middle"),
    ("y", "max", "Tops", "highest"),
)
_JOINTS = (
    ("smooth_joints", "Make smooth", "One direction on both sides of the chosen nodes (G1), with the least change"),
    ("harmonise_joints", "Harmonise", "One curvature on both sides (G2): the chosen nodes move along their handles"),
    ("match_curvature", "Same curvature", "One curvature on both sides (G2): the handles of the chosen nodes change"),
)


def _nodes(fewest: int = 1, most: int | None = None, points: bool = False) -> Fault:
    """A fault for commands that take so many chosen nodes; `points`: control points will do as well."""

    def fault(window: MainWindow) -> str | None:
        active = window.curve
        if not isinstance(active.node, CURVES) or active.path is None:
            return "select one path first" if not points else "select one path, Bezier curve or B-spline first"
        if active.by_points and not points:
            return f"“{active.node.label}” has control points, no nodes: convert it to a path first"
        count, thing = len(active.chosen), "control point" if active.by_points else "node"
        if count < fewest:
            return f"choose a {thing} first" if fewest == 1 else f"choose {fewest} {thing}s or more first"
        if most is not None and count > most:
            return f"choose {most} {thing}s only"
        return None

    return fault


def _segments(window: MainWindow) -> str | None:
    fault = _nodes(2)(window)
    if fault is None and not node_edits.chosen_segments(window.curve):
        return "choose both nodes of a segment first"
    return fault


def _open(window: MainWindow) -> str | None:
    fault = _nodes(0)(window)
    path = window.curve.path
    if fault is None and path is not None and all(contour.closed for contour in path.contours):
        return "all its contours are closed"
    return fault


def _on(edit: Callable[[ActiveCurve], object]) -> Callable[[MainWindow], None]:
    def run(window: MainWindow) -> None:
        edit(window.curve)

    return run


def _kind(kind: str, title: str, number: int, tip: str) -> Command:
    return Command(f"nodes_{kind}", title, "Curve/Nodes become", _on(lambda curve: node_edits.set_kind(curve, kind)),
                   _nodes(), f"Ctrl+Alt+{number}", f"nodes_{kind}", tip,
                   checked=lambda w: node_edits.kind_of_chosen(w.curve) == kind)  # fmt: skip


def _segment(kind: str, title: str, keys: str, tip: str) -> Command:
    return Command(f"segments_{kind}", title, "Curve/Segments become",
                   _on(lambda curve: node_edits.set_segments(curve, kind, f"Make {title.lower()}")), _segments, keys,
                   f"segments_{kind}", tip,
                   checked=lambda w: node_edits.kind_of_segments(w.curve) == kind)  # fmt: skip


def _align(axis: str, to: str, title: str, where: str) -> Command:
    return Command(f"align_nodes_{axis}_{to}", title, "Curve/Align nodes",
                   _on(lambda curve: node_edits.align(curve, axis, to)), _nodes(2, points=True), "",
                   f"align_{axis}_{to}", f"Bring the chosen nodes to the {where} of them in {axis}")  # fmt: skip


def _distribute(axis: str, title: str) -> Command:
    return Command(f"distribute_nodes_{axis}", title, "Curve/Align nodes",
                   _on(lambda curve: node_edits.distribute(curve, axis)), _nodes(3, points=True), "",
                   f"distribute_{axis}", f"Even steps in {axis} from the first to the last chosen node")  # fmt: skip


NODE_COMMANDS: tuple[Command, ...] = (
    Command("insert_nodes", "Insert nodes", "Curve/Nodes", _on(node_edits.insert_between), _segments, "Ins",
            "insert_nodes", "A node in the middle of each segment whose two nodes are chosen; the shape stays.\n"
            "A double click on the curve inserts one there"),
    Command("delete_nodes", "Delete nodes", "Curve/Nodes", _on(node_edits.delete), _nodes(points=True), "",
            "delete_nodes", "Take the chosen nodes out, the curve staying as near as may be; in the picture by Delete"),
    Command("delete_nodes_plain", "Delete nodes, keep handles", "Curve/Nodes",
            _on(lambda curve: node_edits.delete(curve, False)), _nodes(), "Ctrl+Delete", "delete_nodes_plain",
            "Take the chosen nodes out; the handles of those beside them stay"),
    Command("break_path", "Break at nodes", "Curve/Nodes", _on(node_edits.break_apart), _nodes(), "Ctrl+Shift+B",
            "break_path", "Open the path at the chosen nodes"),
    Command("join_nodes", "Join by a line", "Curve/Nodes", _on(node_edits.join), _nodes(2, 2), "Ctrl+Shift+J",
            "join_nodes", "A line between the two chosen ends"),
    Command("merge_nodes", "Join into one node", "Curve/Nodes", _on(lambda curve: node_edits.join(curve, True)),
            _nodes(2, 2), "Ctrl+Alt+J", "merge_nodes", "The two chosen ends become one node midway"),
    Command("close_contours", "Close", "Curve/Nodes", _on(node_edits.close), _open, "Ctrl+Shift+K", "close_contours",
            "Close the contours of the chosen nodes by a line, all open ones where none is chosen"),
    *(_kind(kind, title, number, tip) for number, (kind, title, tip) in enumerate(_KINDS, 1)),
    *(_segment(*row) for row in _SEGMENTS),
    *(
        Command(name, title, "Curve/Joints", _on(lambda curve, n=name, t=title: node_edits.mend(curve, n, t)), _nodes(),
                "", name, tip)
        for name, title, tip in _JOINTS
    ),
    *(_align(*row) for row in _SIDES),
    _distribute("x", "Even steps left to right"),
    _distribute("y", "Even steps bottom to top"),
    Command("mirror_nodes_x", "Mirror nodes left-right", "Curve/Align nodes",
            _on(lambda curve: node_edits.mirror_chosen(curve, 0)), _nodes(2, points=True), "", "mirror_outline_x",
            "Mirror the chosen nodes in place, left to right"),
    Command("mirror_nodes_y", "Mirror nodes up-down", "Curve/Align nodes",
            _on(lambda curve: node_edits.mirror_chosen(curve, 1)), _nodes(2, points=True), "", "mirror_outline_y",
            "Mirror the chosen nodes in place, bottom to top"),
    Command("transform_box", "Transform box", "Curve", lambda w: w.edit_tool.set_box(not w.edit_tool.box),
            shortcut="Ctrl+Alt+T", icon="transform_box",
            tip="Knobs around two or more chosen nodes scale and turn them; Shift: evenly, Ctrl: about the middle",
            checked=lambda w: w.edit_tool.box),
)  # fmt: skip

NODE_BUTTONS: tuple[tuple[str, ...], ...] = (
    ("nodes_cusp", "nodes_smooth", "nodes_symmetric", "nodes_auto", "", "segments_line", "segments_quad",
     "segments_cubic"),
    ("insert_nodes", "delete_nodes", "break_path", "join_nodes", "merge_nodes", "close_contours", "reverse_contours"),
    ("align_nodes_x_min", "align_nodes_x_middle", "align_nodes_x_max", "align_nodes_y_max", "align_nodes_y_middle",
     "align_nodes_y_min", "", "distribute_nodes_x", "distribute_nodes_y"),
    ("transform_box", "mirror_outline_x", "mirror_outline_y", "", "split_outline", "convert_to_path"),
)  # fmt: skip
"""The buttons of the Curve panel's page of nodes, row by row; "" leaves a gap."""
