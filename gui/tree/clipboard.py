"""Nodes on the system's clipboard: as text, so that they go into other windows and through whatever holds text."""

from __future__ import annotations

import json
from collections.abc import Sequence
from functools import lru_cache

from PySide6.QtCore import QMimeData

from ...model.document.document import Document
from ...model.document.errors import Refusal
from ...model.document.table import from_table, to_table
from ...model.document.tree import find, outermost
from ...model.editing.echo import MAX_NESTING, depth, script_of
from ...model.operations.pasting import clip

FORMAT = "solidtree nodes"
VERSION = 1
LARGEST = 64_000_000  # characters


def text_of(document: Document, ids: Sequence[str]) -> str:
    """The nodes as one JSON object: the table of a small document."""
    table = to_table(clip(document, ids))
    kept = {name: value for name, value in table.items() if value}
    return json.dumps({"format": FORMAT, "version": VERSION, **kept}, ensure_ascii=False)


def mime_of(document: Document, ids: Sequence[str]) -> QMimeData:
    data = QMimeData()
    data.setText(text_of(document, ids))
    return data


def clip_in(data: QMimeData) -> Document | None:
    """The nodes in a clipboard or a drag, None where there are none."""
    text = data.text() if data.hasText() else ""
    if len(text) > LARGEST or FORMAT not in text[:100]:
        return None
    try:
        return read(text)
    except Refusal:
        return None


@lru_cache(maxsize=1)
def read(text: str) -> Document:
    """The document in a clipboard's text. Raises Refusal that says what is wrong with it."""
    try:
        table = json.loads(text)
    except (ValueError, RecursionError):
        table = None
    if not isinstance(table, dict) or table.get("format") != FORMAT:
        raise Refusal("there are no nodes on the clipboard")
    if table.get("version") != VERSION:
        raise Refusal("what is on the clipboard comes from another version of the program")
    return from_table(table)


def script_text(document: Document, ids: Sequence[str]) -> str:
    """The nodes as Python, one line each. Raises Refusal where Python could not read it."""
    nodes = [find(document, node_id) for node_id in outermost(document, ids)]
    for node in nodes:
        if depth(node) > MAX_NESTING:
            raise Refusal(
                f"“{node.label}” is more than {MAX_NESTING} levels deep, which Python cannot read in one line"
            )
    return "\n".join(script_of(node) for node in nodes)


def is_path_text(text: str) -> bool:
    """Whether text begins as SVG path data or an SVG document do, at a glance."""
    head = text[:4096].lstrip()
    if head[:1] in ("m", "M"):
        return head[1:2] in tuple(" \t\r\n,+-.0123456789") and any(letter in head for letter in "0123456789")
    return head[:1] == "<" and "<svg" in head
