"""Numbers typed while a handle is dragged, or instead of dragging it."""

from __future__ import annotations

from dataclasses import dataclass, field

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent

from ...model.document.expression import Expression, Number, number

CURSOR = "|"
FIRST = "0123456789.-+(="
"""What a typed number may begin with where letters are shortcuts; after = come letters too."""


@dataclass(slots=True)
class Entry:
    """The text of each of a drag's numbers, and which of them is being typed."""

    names: tuple[str, ...]
    place: int = 0
    texts: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.texts = self.texts or [""] * len(self.names)

    @property
    def typing(self) -> bool:
        return any(self.texts)

    def takes(self, event: QKeyEvent, letters: bool) -> bool:
        """Whether `key` would do something with it; `letters` whether a text may begin with one."""
        if event.key() in (Qt.Key.Key_Tab, Qt.Key.Key_Backtab):
            return True
        if event.key() == Qt.Key.Key_Backspace:
            return self.typing
        if event.modifiers() & (Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.AltModifier):
            return False
        text = event.text()
        begun = bool(self.texts[self.place]) or letters
        return bool(text) and text.isprintable() and (begun or text in FIRST)

    def key(self, event: QKeyEvent) -> None:
        """Take a key that `takes` took."""
        match event.key():
            case Qt.Key.Key_Tab:
                self.place = (self.place + 1) % len(self.names)
            case Qt.Key.Key_Backtab:
                self.place = (self.place - 1) % len(self.names)
            case Qt.Key.Key_Backspace:
                self.texts[self.place] = self.texts[self.place][:-1]
            case _:
                self.texts[self.place] += event.text()

    def numbers(self) -> list[Number | None]:
        """What has been typed, None where nothing has. Raises Refusal for what cannot be read."""
        found: list[Number | None] = []
        for name, text in zip(self.names, self.texts, strict=True):
            plain = text.strip().removeprefix("=").strip()
            found.append(number(plain, name) if plain and plain not in "+-." else None)
        return found

    def words(self, shown: list[str]) -> str:
        """All numbers as text with the cursor in one of them; `shown` stands where nothing has been typed."""
        parts = []
        for i, (name, text) in enumerate(zip(self.names, self.texts, strict=True)):
            value = text + CURSOR if i == self.place else text or shown[i]
            parts.append(f"{name} {value}")
        return "   ".join(parts)


def number_text(value: Number) -> str:
    """A number as the picture shows it."""
    return value.text if isinstance(value, Expression) else f"{round(value, 4) + 0.0:.8g}"
