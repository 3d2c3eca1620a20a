"""What evaluation has to say about nodes, and the status that follows from it, for every command that evaluates."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from ..command_line import DONE, NOT_IN_ORDER, warn

if TYPE_CHECKING:
    from ...model.document.document import Document
    from ...model.worker.shown import Message


def told(file: str, messages: Iterable[Message], document: Document) -> int:
    """Say them, a line each; the status is 1 where a solid failed.

    An imported surface that is open has not failed where it is taken as it is.
    """
    failed = set()
    for message in messages:
        warn(file, f"“{message.name}”: {message.message}")
        if message.error:
            failed.add(message.node_id)
    return NOT_IN_ORDER if failed and failed - _open_surfaces(document) else DONE


def _open_surfaces(document: Document) -> set[str]:
    from ...model.document.resolve import Resolver
    from ...model.solid.results import open_surface

    return {root.id for root in Resolver().resolve(document).solids if open_surface(root) is not None}
