"""What a drop of nodes does: whether it can be done, in words, and the one operation that does it."""

from __future__ import annotations

import os
from collections.abc import Sequence
from functools import lru_cache

from PySide6.QtCore import QMimeData, Qt
from PySide6.QtGui import QDropEvent

from ...model.document.document import Document
from ...model.document.errors import Refusal
from ...model.document.nodes import Instance, Node
from ...model.document.outlines import is_outline
from ...model.document.tree import find, room
from ...model.editing.session import Session
from ...model.operations.operations import OPERATIONS
from .clipboard import clip_in, mime_of

MIME = "application/x-solidtree-nodes"


def dragged(session: Session, ids: Sequence[str]) -> QMimeData:
    """Nodes to be dropped: by id within their window, as text in others."""
    data = mime_of(session.document, ids)
    data.setData(MIME, "\n".join([_home(session), *ids]).encode())
    return data


def copies(event: QDropEvent) -> bool:
    """Whether Ctrl asks for copies."""
    return bool(event.modifiers() & Qt.KeyboardModifier.ControlModifier)


def answer(event: QDropEvent, copy: bool, fault: str | None) -> None:
    """Tell the drag whether it may be dropped here, which the pointer shows."""
    if fault:
        event.setDropAction(Qt.DropAction.IgnoreAction)
        event.ignore()
    else:
        event.setDropAction(Qt.DropAction.CopyAction if copy else Qt.DropAction.MoveAction)
        event.accept()


def _home(session: Session) -> str:
    return f"{os.getpid()} {id(session)}"


def ids_in(session: Session, data: QMimeData) -> list[str]:
    """The ids that are dragged, where they are nodes of this session; else none."""
    home, *ids = bytes(data.data(MIME).data()).decode(errors="replace").split("\n") if data.hasFormat(MIME) else [""]
    return ids if home == _home(session) else []


def is_drop(data: QMimeData) -> bool:
    return data.hasFormat(MIME)


def root_place(session: Session, data: QMimeData, row: int) -> int:
    """The row among all roots, before which nodes are dropped, as a place among solids or among profiles: the family
    of the first node."""
    document = session.document
    ids = ids_in(session, data)
    if ids:
        flat = node_is_flat(document, ids[0])
    else:
        other = clip_in(data)
        flat = other is not None and not other.solids
    first, family = (len(document.solids), document.profiles) if flat else (0, document.solids)
    return min(max(row - first, 0), len(family))


@lru_cache(maxsize=8)
def node_is_flat(document: Document, node_id: str) -> bool:
    return is_outline(find(document, node_id), document.definitions)


def drop_fault(
    session: Session, data: QMimeData, copy: bool, parent_id: str | None, index: int | None = None
) -> str | None:
    """Why these nodes cannot be dropped there, in words for the status bar, or None."""
    ids = ids_in(session, data)
    document = session.document
    target = None if parent_id is None else find(document, parent_id)
    if target is not None and (isinstance(target, Instance) or type(target).operands[1] == 0):
        return _takes_nothing(target)
    if not ids:
        other = clip_in(data)
        return "there are no nodes in what is dragged" if other is None else _fault(document, "paste", other, parent_id,
                                                                                   index)  # fmt: skip
    fault = _fault(document, "copy_to" if copy else "relocate", tuple(ids), parent_id, index)
    if fault and target is not None and room(target) == 0:
        return fault
    if fault and not copy and any(root.id in ids for root in document.definitions):
        return f"{fault}; hold Ctrl to put an instance of it there"
    return fault


def _takes_nothing(target: Node) -> str:
    kind = target.title.lower()
    article = "an" if kind[0] in "aeiou" else "a"
    named = f"“{target.name}” is {article} {kind}, which" if target.name else f"{article} {kind}"
    return f"{named} takes no operands: drop above or below it"


@lru_cache(maxsize=8)
def _fault(document: Document, name: str, what: tuple[str, ...] | Document, *place: object) -> str | None:
    """Remembered, because a drag asks for the same place at every move of the mouse."""
    try:
        OPERATIONS[name](document, what, *place)
    except Refusal as refusal:
        return str(refusal)
    return None


def drop(session: Session, data: QMimeData, copy: bool, parent_id: str | None, index: int | None = None) -> None:
    """Do it as one step. Raises Refusal."""
    fault = drop_fault(session, data, copy, parent_id, index)
    if fault:
        raise Refusal(fault)
    ids = ids_in(session, data)
    place = [parent_id] if index is None else [parent_id, index]
    if not ids:
        session.do("paste", clip_in(data), *place, label="Drop")
    elif copy:
        session.do("copy_to", ids, *place, label="Copy in tree")
    else:
        session.do("relocate", ids, *place, label="Move in tree", select=ids)
