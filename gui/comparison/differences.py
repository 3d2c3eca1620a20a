"""What differs between neighbouring pictures of a row: how many grey levels at most, where, on how much of it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import QRect, QSize, Qt
from PySide6.QtGui import QImage, QPainter, QPaintEvent
from PySide6.QtWidgets import QWidget

from ..theme import colours_now

if TYPE_CHECKING:
    from ...render.surfaces.comparison import Difference

WORDS = 42  # pixels below the pictures
SEEN = 2  # grey levels that count as a difference


class Differences(QWidget):
    """Black where both pictures are the same, white where they differ most."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.differences: Sequence[Difference] = ()
        self._titles: Sequence[str] = ()
        self.setObjectName("differences")
        self.setAccessibleName("Differences of the pictures above")
        self.setToolTip("Black where both pictures are the same, white where they differ most")

    def show_differences(self, titles: Sequence[str], differences: Sequence[Difference]) -> None:
        self._titles, self.differences = titles, differences
        self.setAccessibleDescription("; ".join(": ".join(words) for words in self._words()))
        self.update()

    def _words(self) -> list[tuple[str, str]]:
        found = []
        for title, each in zip(self._titles, self.differences, strict=True):
            share = f"more than {SEEN} on {100.0 * each.share(SEEN):.1f} % of the picture"
            found.append((title, f"up to {each.greatest} grey levels; {share}"))
        return found

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        count = max(len(self.differences), 1)
        for place, (each, (title, words)) in enumerate(zip(self.differences, self._words(), strict=True)):
            left, right = place * self.width() // count, (place + 1) * self.width() // count
            picture = each.picture()
            height, width = picture.shape[:2]
            size = QSize(width, height).scaled(
                right - left - 16, self.height() - WORDS - 8, Qt.AspectRatioMode.KeepAspectRatio
            )
            middle = (left + right) // 2
            where = QRect(middle - size.width() // 2, 8, size.width(), size.height())
            painter.drawImage(where, QImage(picture.data, width, height, 3 * width, QImage.Format.Format_RGB888))
            row = QRect(left, self.height() - WORDS, right - left, WORDS // 2)
            painter.setPen(colours_now().text)
            painter.drawText(row, Qt.AlignmentFlag.AlignCenter, title)
            painter.setPen(colours_now().muted)
            painter.drawText(row.translated(0, WORDS // 2 - 2), Qt.AlignmentFlag.AlignCenter, words)

    def sizeHint(self) -> QSize:
        return QSize(960, 190)

    def minimumSizeHint(self) -> QSize:
        return QSize(400, 110)
