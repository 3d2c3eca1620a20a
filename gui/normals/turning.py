"""Faces of meshes turned round, off the window's thread, as one step."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ...model.document.document import Document
from ...model.document.tree import find
from ...model.editing import echo
from ...model.operations.meshes.mesh_nodes import MESHES
from ...model.operations.operations import OPERATIONS
from ..panels.property_edit import sentence

if TYPE_CHECKING:
    from ..window import MainWindow

Call = tuple[str, tuple[Any, ...]]


def no_mesh(window: MainWindow) -> str | None:
    """Why the faces of what is selected cannot be turned, or None."""
    if not window.session.selection:
        return "select an imported mesh first"
    nodes = (find(window.session.document, node_id) for node_id in window.session.selection)
    other = next((node for node in nodes if not isinstance(node, MESHES)), None)
    if other is not None:
        return f"“{other.label}” is no mesh: what solids are made of has its outside from its shape"
    return "wait for what is going on" if window.files.background.working else None


def flip(window: MainWindow) -> None:
    """Turn all faces of the selected meshes to the other side."""
    _turn(window, "Turning faces", "Flip normals", [("reverse_mesh_faces", (i,)) for i in window.session.selection], "")


def make_consistent(window: MainWindow) -> None:
    """Turn the faces of the selected meshes that look another way than their neighbours do."""
    calls: list[Call] = [("repair_mesh", (i, ["orient"])) for i in window.session.selection]
    _turn(
        window, "Comparing faces", "Make normals consistent", calls, "The faces agree already: there is nothing to turn"
    )


def _turn(window: MainWindow, words: str, label: str, calls: list[Call], nothing: str) -> None:
    session = window.session
    before = session.document

    def work() -> tuple[Document, list[str]]:
        document, lines = before, []
        for name, arguments in calls:
            after = OPERATIONS[name](document, *arguments)
            if after is not document:
                lines.append(echo.step(document, after, name, *arguments))
            document = after
        return document, lines

    def done(result: tuple[Document, list[str]]) -> None:
        document, lines = result
        if session.document is not before:
            window.status.say("The document has changed meanwhile: nothing was turned; do it again")
        elif lines:
            session.commit(label, document, session.selection, "\n".join(lines))
        else:
            window.status.say(nothing)

    window.files.background.run(words, work, done, lambda refusal: window.status.say(sentence(refusal)))
