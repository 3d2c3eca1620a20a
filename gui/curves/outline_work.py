"""Operations on outlines that may take long: in a thread, committed as one step when they are done."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ...model.editing import echo
from ...model.operations.operations import OPERATIONS

if TYPE_CHECKING:
    from ...model.document.document import Document
    from ...model.document.errors import Refusal
    from ..window import MainWindow


def do_aside(window: MainWindow, name: str, *arguments: Any, label: str, **keywords: Any) -> None:
    """As `session.do`, without keeping the window waiting; not done where the document changes meanwhile."""
    session = window.session
    session.cancel()
    before = session.document

    def finished(after: Document) -> None:
        if session.document is before:
            commit(window, before, after, name, *arguments, label=label, **keywords)
        else:
            window.status.say(f"{label}: the document has changed meanwhile; try again")

    def refused(refusal: Refusal) -> None:
        window.status.say(str(refusal))

    work = OPERATIONS[name]
    window.files.background.run(label, lambda: work(before, *arguments, **keywords), finished, refused)


def commit(
    window: MainWindow, before: Document, after: Document, name: str, *arguments: Any, label: str, **keywords: Any
) -> None:
    """Make what an operation made of `before` the next step of the history, with its line of Python."""
    line = echo.step(before, after, name, *arguments, **keywords)
    window.session.commit(label, after, line=line)
