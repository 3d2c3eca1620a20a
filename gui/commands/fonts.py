"""The window's commands on fonts, in the menu Curve. They take the MainWindow."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from ...model.document.outlines import Lettering
from ...model.document.project_font import font_named
from ...model.editing.chosen import chosen
from ...model.editing.commands import Command, done

if TYPE_CHECKING:
    from ..window import MainWindow


def _font(window: MainWindow) -> str | None:
    """The font of the selected lettering; None where there is none, or where there are several."""
    fonts = {node.font for node in chosen(window.session).nodes if isinstance(node, Lettering)}
    return fonts.pop() if len(fonts) == 1 else None


def _carried(wanted: bool) -> Callable[[MainWindow], str | None]:
    def fault(window: MainWindow) -> str | None:
        name = _font(window)
        if name is None:
            return "select lettering in one font first"
        font = font_named(window.session.document.fonts, name)
        if (font is not None and bool(font.asset)) is wanted:
            return None
        return f"the project carries no “{name}”" if wanted else f"the project carries “{name}” already"

    return fault


def _edit(window: MainWindow) -> None:
    from ..lettering.font_window import open_font_window

    open_font_window(window)


def _on_font(operation: str, label: str) -> Callable[[MainWindow], None]:
    return lambda w: done(w.session.do(operation, _font(w), label=label))


FONT_COMMANDS: tuple[Command, ...] = (
    Command("edit_font", "Edit font …", "Curve/Fonts", _edit, shortcut="Alt+G", icon="edit_font",
            tip="The glyphs of the selected lettering's font, with their control points; fonts side by side"),
    Command("carry_font", "Carry font in the project", "Curve/Fonts", _on_font("carry_font", "Carry font"),
            _carried(False), "", "carry_font",
            "Put the font's file into the project, so that the lettering is the same on every computer"),
    Command("release_font", "Leave font out of the project", "Curve/Fonts", _on_font("release_font", "Release font"),
            _carried(True), "", "release_font",
            "Take the font's file, and what was edited of it, out of the project: the installed font counts again"),
)  # fmt: skip
