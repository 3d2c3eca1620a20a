"""The window's commands for measuring. They take the MainWindow."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...model.editing.commands import Command

if TYPE_CHECKING:
    from ..window import MainWindow


def _nothing(window: MainWindow) -> str | None:
    if window.measure.active or any(root.visible for root in window.session.document.solids):
        return None
    return "no solid is visible"


def _none_taken(window: MainWindow) -> str | None:
    return None if window.measure.taken else "nothing has been measured"


def _toggle(window: MainWindow) -> None:
    if window.measure.active:
        window.measure.end()
        return
    window.place_on_face.end()
    window.sight.end()
    window.docks["Measure"].show()
    window.docks["Measure"].raise_()
    window.measure.start()


MEASURE_COMMANDS: tuple[Command, ...] = (
    Command("measure", "Measure", "Tools", _toggle, _nothing, "Shift+M", "measure",
            "Corners, edges, faces and walls; two of them for distance and angle", True,
            checked=lambda w: w.measure.active),
    Command("clear_measurements", "Clear measurements", "Tools", lambda w: w.measure.clear(), _none_taken,
            tip="Take all measurements out of the list and the picture"),
)  # fmt: skip
