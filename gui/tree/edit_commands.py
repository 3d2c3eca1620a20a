"""The tree's entries of the table of commands: the clipboard, the search, the diagram. They take the MainWindow."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtGui import QGuiApplication

from ...model.document.errors import Refusal
from ...model.editing.commands import Command, place_beside
from .clipboard import is_path_text, mime_of, read, script_text

if TYPE_CHECKING:
    from ..window import MainWindow


def _unselected(window: MainWindow) -> str | None:
    return None if window.session.selection else "select a node first"


def _empty(window: MainWindow) -> str | None:
    return None if window.session.document.roots else "the document is empty"


def _copy(window: MainWindow) -> None:
    ids = window.tree.nodes.in_order(set(window.session.selection))
    QGuiApplication.clipboard().setMimeData(mime_of(window.session.document, ids))
    window.status.say(f"Copied {_count(ids)}")


def _cut(window: MainWindow) -> None:
    ids = list(window.session.selection)
    data = mime_of(window.session.document, window.tree.nodes.in_order(set(ids)))
    window.session.do("delete", ids, label="Cut")  # first, because it may be refused
    QGuiApplication.clipboard().setMimeData(data)
    window.status.say(f"Cut {_count(ids)}")


def _paste(window: MainWindow) -> None:
    text = QGuiApplication.clipboard().text()
    if not text:
        raise Refusal("there are no nodes on the clipboard")
    if is_path_text(text):
        _paste_outlines(window, text)
    else:
        window.session.do("paste", read(text), *place_beside(window.session))


def _paste_outlines(window: MainWindow, text: str) -> None:
    from ...model.exchange.drawings.outlines_in import document_of_text

    other = document_of_text(text)
    label = "Paste outline" if len(other.profiles) == 1 else "Paste outlines"
    if len(other.profiles) == 1:
        window.session.do("insert", other.profiles[0], label=label)
    else:
        window.session.do("insert_document", other, label=label)
    count = len(other.profiles)
    window.status.say(f"Pasted {count} outline{'s' * (count > 1)} of SVG, turned over: its y runs down")


def _copy_script(window: MainWindow) -> None:
    ids = window.tree.nodes.in_order(set(window.session.selection))
    QGuiApplication.clipboard().setText(script_text(window.session.document, ids))
    window.status.say(f"Copied {_count(ids)} as Python")


def _export_diagram(window: MainWindow) -> None:
    from .. import dialogs

    def write(path: str) -> None:
        from ...model.project.disk import reason_of
        from ...render.drawing.csg_diagram import diagram

        try:
            diagram(window.session.document, path)
            window.status.say(f"Wrote {Path(path).name}")
        except OSError as error:
            dialogs.tell(window, f"{Path(path).name} could not be written", reason_of(error))

    dialogs.ask_diagram_path(window, Path(window.settings.folder, window.files.name).with_suffix(".svg"), write)


def _count(ids: list[str]) -> str:
    return "one node" if len(ids) == 1 else f"{len(ids)} nodes"


EDIT_COMMANDS: tuple[Command, ...] = (
    Command("cut", "Cut", "Edit", _cut, _unselected, "Ctrl+X", "cut", "Copy the selected nodes and take them out"),
    Command("copy", "Copy", "Edit", _copy, _unselected, "Ctrl+C", "copy",
            "The selected nodes, as text on the clipboard"),
    Command("paste", "Paste", "Edit", _paste, shortcut="Ctrl+V", icon="paste",
            tip="Into the selected operation, beside the selected operand, or as solids"),
    Command("copy_script", "Copy as Python", "Edit", _copy_script, _unselected, "Ctrl+Shift+C", "",
            "The selected nodes as the Python that makes them"),
    Command("find", "Search the tree", "Edit", lambda w: w.show_search(), shortcut="Ctrl+F", icon="search",
            tip="By name, kind, note, colour"),
    Command("diagram", "Diagram", "View", lambda w: w.show_diagram(), shortcut="Ctrl+T", icon="diagram",
            tip="The tree as in the textbook; once more goes back to the list"),
    Command("export_diagram", "Export diagram …", "File", _export_diagram, _empty, icon="diagram",
            tip="Write the diagram of the tree as SVG"),
)  # fmt: skip
