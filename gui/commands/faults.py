"""The window's commands on faults of meshes and drawings. They take the MainWindow."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...model.editing.commands import Command

if TYPE_CHECKING:
    from ..window import MainWindow


def _toggle(window: MainWindow) -> None:
    """Bring the panel to the front and check; hide it where it is there already."""
    if window.faults.in_front:
        window.docks["Faults"].hide()
    else:
        window.show_faults()
        window.faults.check()


def _unlisted(window: MainWindow) -> str | None:
    return None if window.faults.repairable else "no mesh or outline with faults is listed; check for faults first"


FAULT_COMMANDS: tuple[Command, ...] = (
    Command("faults", "Faults of meshes and drawings", "Tools", _toggle, shortcut="Ctrl+Alt+F", icon="faults",
            tip="Open borders, faces that cross, slivers, ends that nearly meet: listed, shown and repaired",
            checked=lambda w: w.faults.in_front),
    Command("repair_faults", "Repair all faults", "Tools", lambda w: w.faults.repair_all(), _unlisted, icon="repair",
            tip="Weld, drop duplicates and slivers, turn faces and close holes of what the Faults panel lists"),
)  # fmt: skip
