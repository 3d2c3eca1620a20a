"""Icons from resources/icons, drawn when needed in the colours of the palette, so that a theme recolours them all."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from importlib.resources import files

from PySide6.QtCore import QByteArray, QRect, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QGuiApplication, QIcon, QIconEngine, QPainter, QPalette, QPixmap
from PySide6.QtSvg import QSvgRenderer

from .. import resources
from ..model.document.kind_names import function_name
from ..model.document.nodes import Node

INK = "#1d242d"
Colour = str | Callable[[], str] | None
_pixmaps: dict[tuple[str, int, str], QPixmap] = {}


@cache
def _text(name: str) -> str:
    """The SVG's text, empty where there is no such icon."""
    file = files(resources).joinpath("icons", f"{name}.svg")
    return file.read_text(encoding="utf-8") if name and file.is_file() else ""


def pixmap(name: str, size: int, colour: str) -> QPixmap:
    """The icon in one colour; `size` in device pixels. Remembered."""
    key = (name, size, colour)
    if key not in _pixmaps:
        picture = QPixmap(size, size)
        picture.fill(Qt.GlobalColor.transparent)
        text = _text(name)
        if text:
            painter = QPainter(picture)
            QSvgRenderer(QByteArray(text.replace("currentColor", colour).encode())).render(
                painter, QRectF(0, 0, size, size)
            )
            painter.end()
        _pixmaps[key] = picture
    return _pixmaps[key]


class _Engine(QIconEngine):
    """Takes the colour at the moment of drawing, from the application's palette unless one is given."""

    def __init__(self, name: str, colour: Colour = None) -> None:
        super().__init__()
        self._name = name
        self._colour = colour

    def paint(self, painter: QPainter, rect: QRect, mode: QIcon.Mode, state: QIcon.State) -> None:
        side = min(rect.width(), rect.height())
        ratio = painter.device().devicePixelRatio() if painter.device() else 1.0
        target = QRect(0, 0, side, side)
        target.moveCenter(rect.center())
        painter.drawPixmap(target, self.scaledPixmap(QSize(side, side) * ratio, mode, state, ratio))

    def pixmap(self, size: QSize, mode: QIcon.Mode, state: QIcon.State) -> QPixmap:
        return self.scaledPixmap(size, mode, state, 1.0)

    def scaledPixmap(self, size: QSize, mode: QIcon.Mode, state: QIcon.State, scale: float) -> QPixmap:
        return pixmap(self._name, max(1, min(size.width(), size.height())), self._colour_for(mode))

    def _colour_for(self, mode: QIcon.Mode) -> str:
        palette = QGuiApplication.palette()
        if mode == QIcon.Mode.Disabled:
            return palette.color(QPalette.ColorGroup.Disabled, QPalette.ColorRole.WindowText).name()
        if mode == QIcon.Mode.Selected:
            return palette.color(QPalette.ColorRole.HighlightedText).name()
        given = self._colour() if callable(self._colour) else self._colour
        return given or palette.color(QPalette.ColorRole.WindowText).name()

    def clone(self) -> QIconEngine:
        return _Engine(self._name, self._colour)


class _Chip(QIconEngine):
    """The icon in dark ink on a ground of a light colour, the same in every mode."""

    def __init__(self, name: str, ground: str) -> None:
        super().__init__()
        self._name = name
        self._ground = ground

    def paint(self, painter: QPainter, rect: QRect, mode: QIcon.Mode, state: QIcon.State) -> None:
        side = min(rect.width(), rect.height())
        ratio = painter.device().devicePixelRatio() if painter.device() else 1.0
        target = QRect(0, 0, side, side)
        target.moveCenter(rect.center())
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(self._ground))
        painter.drawRoundedRect(target, 0.2 * side, 0.2 * side)
        margin = round(0.1 * side)
        inner = target.adjusted(margin, margin, -margin, -margin)
        painter.drawPixmap(inner, pixmap(self._name, max(1, round(inner.width() * ratio)), INK))
        painter.restore()

    def pixmap(self, size: QSize, mode: QIcon.Mode, state: QIcon.State) -> QPixmap:
        return self.scaledPixmap(size, mode, state, 1.0)

    def scaledPixmap(self, size: QSize, mode: QIcon.Mode, state: QIcon.State, scale: float) -> QPixmap:
        picture = QPixmap(size)
        picture.fill(Qt.GlobalColor.transparent)
        painter = QPainter(picture)
        self.paint(painter, QRect(0, 0, size.width(), size.height()), mode, state)
        painter.end()
        return picture

    def clone(self) -> QIconEngine:
        return _Chip(self._name, self._ground)


def icon(name: str, colour: Colour = None) -> QIcon:
    """The icon of this name, in a colour of its own or the text's; a null icon where the set has none."""
    return QIcon(_Engine(name, colour)) if _text(name) else QIcon()


@cache
def kind_icon(kind: type[Node]) -> QIcon:
    """The picture of a kind of node."""
    return icon(function_name(kind))


@cache
def chip_icon(kind: type[Node], ground: str) -> QIcon:
    """The picture of a kind of node on a ground of a light colour, `#rrggbb`."""
    return QIcon(_Chip(function_name(kind), ground))


def severity_icon(error: bool) -> QIcon:
    """The mark of an error or a warning, in the theme's colour for it."""
    from .theme import colours_now

    return icon("error", lambda: colours_now().error) if error else icon("warning", lambda: colours_now().warning)
