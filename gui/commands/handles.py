"""The commands of the handles, for the window's table: modes, axes, snapping. They take the MainWindow."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from ...model.editing.commands import Command

if TYPE_CHECKING:
    from ..tools.drag_contacts import Mode
    from ..window import MainWindow

_MODES = (
    ("move", "Move", "M", "Arrows along the axes; or type 10 Tab 0 Tab 5 and Enter"),
    ("turn", "Turn", "R", "Rings about the axes; or type the degrees about z and Enter, Tab for another axis"),
    ("scale", "Scale", "S", "Boxes along the node's own axes; or type a factor and Enter"),
    ("size", "Size", "D", "Handles on radius, height and sides alone"),
)

_CONTACTS: tuple[tuple[Mode, str, str, str], ...] = (
    ("show", "Show contacts", "", "What a dragged part touches, overlaps or comes near to lights up"),
    ("stop", "Stop at contact", "", "A part that is dragged stops where it meets another one"),
    ("slide", "Slide along contacts", "Shift+K", "A part that is dragged slides along what it meets"),
    ("off", "No contacts", "", "Parts are dragged through each other, and nothing is said"),
)


def _selected(window: MainWindow) -> str | None:
    return None if window.session.selection else "select a node first"


def _choose(mode: str) -> Callable[[MainWindow], None]:
    def run(window: MainWindow) -> None:
        window.measure.end()  # it would keep the mouse from the handles
        window.sight.end()
        window.draw.end()
        window.face_plane.end()
        window.handles.choose(mode)

    return run


HANDLE_COMMANDS: tuple[Command, ...] = (
    *(
        Command(f"handles_{mode}", title, "Tools", _choose(mode), _selected, keys, mode,
                tip, True, checked=lambda w, mode=mode: w.handles.mode == mode)
        for mode, title, keys, tip in _MODES
    ),
    Command("local_axes", "Local axes", "Tools", lambda w: w.handles.set_local(not w.handles.local), shortcut="X",
            icon="local_axes", tip="Handles along the axes of the node rather than of the world",
            checked=lambda w: w.handles.local),
    Command("snapping", "Snap to geometry", "Tools", lambda w: w.handles.set_snapping(not w.handles.snapping),
            icon="snap", tip="What is dragged goes to corners, middles, centres and edges; Ctrl leaves that out",
            checked=lambda w: w.handles.snapping),
    *(
        Command(f"contacts_{mode}", title, "Tools/Contacts while dragging",
                lambda w, mode=mode: w.handles.contacts.set_mode(mode), shortcut=keys, tip=tip,
                checked=lambda w, mode=mode: w.handles.contacts.mode == mode)
        for mode, title, keys, tip in _CONTACTS
    ),
)  # fmt: skip
