"""The window's commands for lines of sight. They take the MainWindow."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...model.editing.commands import Command

if TYPE_CHECKING:
    from ..tools.sight.words import Mode
    from ..window import MainWindow


def _nothing(window: MainWindow) -> str | None:
    if window.sight.active or any(root.visible for root in window.session.document.solids):
        return None
    return "no solid is visible"


def _toggle(window: MainWindow, mode: Mode) -> None:
    if window.sight.mode == mode:
        window.sight.end()
        return
    window.place_on_face.end()
    window.measure.end()
    window.sight.start(mode)
    window.actions_.refresh()


SIGHT_COMMANDS: tuple[Command, ...] = (
    Command("line_of_sight", "Line of sight", "Tools", lambda w: _toggle(w, "points"), _nothing, "Shift+L",
            "line_of_sight", "Whether two points see each other, and what stands in the way",
            checked=lambda w: w.sight.mode == "points"),
    Command("ray_from_face", "Gap and wall of a face", "Tools", lambda w: _toggle(w, "ray"), _nothing, "Shift+R",
            "ray_from_face", "Along a face's normal: how far it is to what stands before it, and how thick the wall is",
            checked=lambda w: w.sight.mode == "ray"),
    Command("seen_from_here", "Seen from here?", "Tools", lambda w: _toggle(w, "part"), _nothing, "Shift+V",
            "seen_from_here", "How much of a part is seen from where you look, and which parts hide the rest",
            checked=lambda w: w.sight.mode == "part"),
    Command("visibility_map", "Visibility map", "Tools", lambda w: _toggle(w, "map"), _nothing, "",
            "visibility_map", "Which places of a face are seen from a point, painted on it",
            checked=lambda w: w.sight.mode == "map"),
)  # fmt: skip
