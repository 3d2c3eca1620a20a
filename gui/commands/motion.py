"""The window's commands on motions. They take the MainWindow."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...model.editing.commands import Command

if TYPE_CHECKING:
    from ..window import MainWindow


def _toggle(window: MainWindow) -> None:
    """Bring the panel to the front, or hide it where it is there already."""
    if window.motion.in_front:
        window.docks["Motion"].hide()
    else:
        window.show_motion()


def _unplayed(window: MainWindow) -> str | None:
    return None if window.motion.in_front and window.motion.played else "open a motion in the Motion panel first"


MOTION_COMMANDS: tuple[Command, ...] = (
    Command("motion_panel", "Motion", "Tools", _toggle, shortcut="Ctrl+Alt+M", icon="motion_panel",
            tip="Play timed motions, with the contacts of each step", checked=lambda w: w.motion.in_front),
    Command("play_motion", "Play or pause the motion", "Tools", lambda w: w.motion.toggle(), _unplayed, icon="play",
            tip="Let the parts of the motion in the Motion panel move"),
)  # fmt: skip
