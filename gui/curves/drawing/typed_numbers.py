"""Numbers typed for the next point of a draft: x and y, a length and an angle after <, or the sizes of a shape."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtGui import QKeyEvent

from ....model.document.document import Document, parameter_values
from ....model.document.expression import resolved
from ...tools.entry import Entry, number_text

if TYPE_CHECKING:
    from .draft import Draft, Floats


class TypedNumbers:
    """The texts, and whether they are a length and an angle (`polar`)."""

    def __init__(self, draft: Draft) -> None:
        self._draft = draft
        self.clear()

    def clear(self) -> None:
        """Nothing has been typed."""
        self.polar = False
        self._entry = Entry(self._draft.names(False) or ("",))

    @property
    def typing(self) -> bool:
        return self._entry.typing

    def takes(self, event: QKeyEvent) -> bool:
        return bool(self._draft.names(self.polar)) and self._entry.takes(event, False)

    def key(self, event: QKeyEvent) -> None:
        """Take a key that `takes` took."""
        entry, draft = self._entry, self._draft
        here = entry.texts[entry.place]
        if self.typing and event.text() == "<" and draft.last is not None and draft.names(True) != draft.names(False):
            self.polar = True
            self._entry = Entry(draft.names(True), 1, [entry.texts[0], ""])
        elif self.typing and event.text() == "," and here.count("(") == here.count(")"):
            entry.place = (entry.place + 1) % len(entry.names)
        else:
            entry.key(event)

    def target(self, document: Document) -> Floats:
        """(2,) the point that the numbers mean; what is not typed is as the pointer has it. Raises Refusal."""
        values = parameter_values(document.parameters)[0]
        typed = [None if one is None else float(resolved(one, values)) for one in self._entry.numbers()]
        return self._draft.target(self._draft.filled(typed, self.polar), self.polar)

    def words(self) -> str:
        """All numbers, as typed or as the pointer has them."""
        names = self._draft.names(self.polar)
        if not names or self._draft.pointer is None:
            return ""
        shown = [number_text(value) for value in self._draft.values(self.polar)]
        if self.typing:
            return self._entry.words(shown)
        return "   ".join(f"{name} {value}" for name, value in zip(names, shown, strict=True))
