"""The window's commands that make relief of bitmaps. They take the MainWindow."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from ...model.document.outlines import is_outline
from ...model.document.primitives import Relief
from ...model.editing.chosen import chosen
from ...model.editing.commands import Command

if TYPE_CHECKING:
    from ..window import MainWindow


def _flat(window: MainWindow) -> str | None:
    nodes = chosen(window.session).nodes
    if not nodes:
        return "select a solid first"
    outlines = any(is_outline(node, window.session.document.definitions) for node in nodes)
    return "an outline is flat; select solids" if outlines else None


def _add(window: MainWindow) -> None:
    from ..surfaces.bitmap_files import ask_bitmap

    def add(sha: str, path: Path) -> None:
        window.session.do("insert", Relief(asset=sha, name=path.stem), label=f"Add relief {path.stem}")

    ask_bitmap(window, add)


def _displace(window: MainWindow) -> None:
    from ..surfaces.bitmap_files import ask_bitmap

    ids = list(window.session.selection)

    def displace(sha: str, path: Path) -> None:
        window.session.do("displace_each", ids, sha, label=f"Displace by {path.name}")

    ask_bitmap(window, displace)


RELIEF_COMMANDS: tuple[Command, ...] = (
    Command("add_relief", "Relief …", "Add", _add, icon="relief",
            tip="A plate whose top rises with the lightness of a bitmap file"),
    Command("displace", "Displace …", "Combine", _displace, _flat, "", "displace",
            "Raise the faces of the selected solids by the lightness of a bitmap file"),
)  # fmt: skip
