"""The window's commands on hidden surfaces. They take the MainWindow."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...model.editing.commands import Command

if TYPE_CHECKING:
    from ..window import MainWindow

MENU = "View/Hidden surfaces"
MODES = (
    ("zbuffer", "z-buffer", "The nearest face of each pixel is kept, by its depth"),
    ("bsp", "BSP tree", "Faces are sorted by a tree and drawn from back to front, which is exact for translucent ones"),
)


def _choose(mode: str, window: MainWindow) -> None:
    window.hidden_surfaces.set_mode(mode)


HIDDEN_SURFACE_COMMANDS: tuple[Command, ...] = (
    *(
        Command(f"hidden_surface_{mode}", title, MENU, lambda w, mode=mode: _choose(mode, w), tip=tip,
                checked=lambda w, mode=mode: w.hidden_surfaces.mode == mode)
        for mode, title, tip in MODES
    ),
    Command("hidden_surface", "Sorted by a BSP tree", "View", lambda w: w.hidden_surfaces.toggle(), shortcut="B",
            icon="hidden_surface", tip="Faces drawn back to front in the order of a BSP tree, or with the z-buffer",
            toolbar=True, checked=lambda w: w.hidden_surfaces.mode == "bsp"),
    Command("translucent", "Translucent faces", "View", lambda w: w.looks.set_translucent(not w.looks.translucent),
            shortcut="T", icon="translucent", tip="See through all faces; exact when they are sorted by a BSP tree",
            checked=lambda w: w.looks.translucent),
)  # fmt: skip
