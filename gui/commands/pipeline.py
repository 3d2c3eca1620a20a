"""The window's commands on the pipeline: its panel, the vertex that is followed, culling, near and far. They take the
MainWindow."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Qt

from ...model.editing.commands import Command

if TYPE_CHECKING:
    from ..window import MainWindow

WIDTH = 400  # pixels that the panel has at least when it is opened


def _show(window: MainWindow) -> None:
    dock = window.docks["Pipeline"]
    dock.show()
    dock.raise_()
    if not dock.isFloating() and dock.width() < WIDTH:
        window.resizeDocks([dock], [WIDTH], Qt.Orientation.Horizontal)


def _panel(window: MainWindow) -> None:
    """Bring the panel to the front, or the properties where it is there already."""
    if window.pipeline.in_front and not window.docks["Pipeline"].isFloating():
        window.docks["Properties"].show()
        window.docks["Properties"].raise_()
    else:
        _show(window)


def _follow(window: MainWindow) -> None:
    _show(window)
    window.pipeline.toggle_pick()


def _automatic(window: MainWindow) -> str | None:
    return "near and far plane follow what is shown already" if window.looks.clipping is None else None


def _nothing(window: MainWindow) -> str | None:
    shown = window.pipeline.tool.active or any(root.visible for root in window.session.document.solids)
    return None if shown else "no solid is visible"


PIPELINE_COMMANDS: tuple[Command, ...] = (
    Command("pipeline_panel", "Pipeline panel", "View", _panel, shortcut="Alt+Shift+V", icon="pipeline_panel",
            tip="A vertex on its way to its pixel: matrices, clipping, division, pixels, and counts at each stage"),
    Command("follow_vertex", "Follow a vertex", "Tools", _follow, _nothing, icon="probe",
            tip="Click a corner: its coordinates at each stage of the pipeline",
            checked=lambda w: w.pipeline.tool.active),
    Command("cull_back_faces", "Back-face culling", "View", lambda w: w.looks.set_culling(not w.looks.culling),
            icon="cull_back_faces", tip="Leave out the faces that are turned away from the eye",
            checked=lambda w: w.looks.culling),
    Command("automatic_clipping", "Automatic near and far plane", "View", lambda w: w.looks.set_clipping(None),
            _automatic, tip="Let the planes that cut off what is near and far follow what is shown again"),
)  # fmt: skip
