"""The window's commands on the BSP panel. They take the MainWindow."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...model.editing.commands import Command

if TYPE_CHECKING:
    from ..window import MainWindow

MENU = "View/Hidden surfaces"


def _show(window: MainWindow) -> None:
    window.docks["BSP"].show()
    window.docks["BSP"].raise_()


def _panel(window: MainWindow) -> None:
    """Bring the panel to the front, or the properties where it is there already."""
    if window.bsp.in_front:
        window.docks["Properties"].show()
        window.docks["Properties"].raise_()
    else:
        _show(window)


def _figure(window: MainWindow) -> None:
    from ..partition.panel import FIGURE

    _show(window)
    window.bsp.show_page(FIGURE)


def _unsorted(window: MainWindow) -> str | None:
    return None if window.hidden_surfaces.mode == "bsp" else "choose BSP tree for hidden surfaces first"


def _play(window: MainWindow) -> None:
    _show(window)
    window.bsp.toggle_play()


def _probe(window: MainWindow) -> None:
    _show(window)
    window.bsp.toggle_probe()


PARTITION_COMMANDS: tuple[Command, ...] = (
    Command("bsp_panel", "BSP panel", "View", _panel, shortcut="Alt+B", icon="bsp_panel",
            tip="The tree that sorts the faces: its planes, its fragments, the painter's order step by step"),
    Command("bsp_figure", "Textbook's figure of a BSP tree", MENU, _figure,
            tip="Objects A to E and the planes h1 to h3, with an eye and a point to drag"),
    Command("bsp_play", "Play the painter's order", MENU, _play, _unsorted, "Alt+Shift+B", "play",
            "Draw the faces one after the other, from back to front; again to stop"),
    Command("bsp_probe", "Probe the BSP tree …", MENU, _probe, _unsorted, icon="probe",
            tip="Click a point: its way down the tree, with f(p) at each plane"),
)  # fmt: skip
