"""Which fonts a text is set in after the chosen one, and for which of its characters."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel

from ....model.document.errors import Refusal
from ....model.document.nodes import Node
from ....model.lettering.lettering import Chain, chain_of
from ...theme import colours_now
from ..property_edit import sentence
from .face_of_node import lettering_in

if TYPE_CHECKING:
    from ..form import Form

SHOWN = 8
"""Characters that are shown; the others are counted."""


class ChainLine(QLabel):
    def __init__(self, form: Form) -> None:
        super().__init__(form)
        self._form = form
        self.setObjectName("font_chain")
        self.setProperty("muted", True)
        self.setWordWrap(True)
        self.setTextFormat(Qt.TextFormat.RichText)
        self.setToolTip("Where the font lacks a character, it comes from the next font that has it")
        form.rows.append(self._refresh)

    def _refresh(self, node: Node, values: dict[str, float]) -> None:
        lettering = lettering_in(self._form.session.document, node, values)
        try:
            text = chain_words(chain_of(lettering), colours_now().warning) if lettering is not None else ""
        except Refusal as refusal:
            text = f'<span style="color:{colours_now().warning}">{escape(sentence(refusal))}</span>'
        if text != self.text():
            self.setText(text)


def chain_words(chain: Chain, warning: str) -> str:
    """The fonts after the first as rich text, what no font has in the colour `warning`."""
    lines = [escape(f"then {', '.join(chain.then)}")] if chain.then else []
    lines += [escape(f"{_shown(codes)} from {name}") for name, codes in chain.lent]
    if chain.lost:
        words = f"In no font, shown as a box: {_shown(chain.lost, True)}"
        lines.append(f'<span style="color:{warning}">{escape(words)}</span>')
    return "<br>".join(lines)


def _shown(codes: Sequence[int], numbered: bool = False) -> str:
    more = f" and {len(codes) - SHOWN} more" if len(codes) > SHOWN else ""
    return " ".join(f"“{chr(code)}”" + (f" (U+{code:04X})" if numbered else "") for code in codes[:SHOWN]) + more
