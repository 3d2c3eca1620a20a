"""A drawn page on a desk: fitted into the widget until the user zooms or pans."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, QPointF, QRectF, Qt
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontMetricsF,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPainterPath,
    QPaintEvent,
    QPen,
    QPixmap,
    QPolygonF,
    QResizeEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QWidget

from ..theme import colours_now

if TYPE_CHECKING:
    from ...model.drafting.page import Fill, Item, Page, Strokes, Text

MARGIN = 16  # logical pixels around the fitted page
SMALLEST, LARGEST = 0.02, 400.0  # pixels a millimetre
STEP = 1.2
FONTS = ["Helvetica", "Arial", "DejaVu Sans"]
LETTERS = 100  # pixels of the font that text is drawn with and then scaled
SEAM = 0.15  # mm of a face's own colour around it, as in the files


class PageView(QWidget):
    """Shows a Page. The wheel, + and - zoom, a drag and the arrows pan; 0, Home and a double click fit it again."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAccessibleName("Preview of the drawing")
        self.setMinimumSize(360, 300)
        self.setToolTip("The wheel zooms, a drag moves, a double click fits the page")
        self.page: Page | None = None
        self._painted: list[tuple[Item, QPainterPath]] = []
        self._picture: QPixmap | None = None
        self._fitted = True
        self._outdated = False
        self._scale, self._corner = 1.0, QPointF(0.0, 0.0)
        self._grip: QPointF | None = None

    def show_page(self, page: Page) -> None:
        """Draw this page, at the same place unless it has another size."""
        fit = self.page is None or (self.page.width, self.page.height) != (page.width, page.height)
        self.page = page
        self._painted = [(item, _path(item)) for item in _items(page)]
        self._outdated = False
        if fit or self._fitted:
            self.fit()
        self._redraw()

    def set_outdated(self, outdated: bool) -> None:
        """Whether the page is no longer what has been asked for: then it is pale."""
        if outdated != self._outdated:
            self._outdated = outdated
            self.update()

    @property
    def scale(self) -> float:
        """Logical pixels a millimetre."""
        return self._scale

    def fit(self) -> None:
        """Show the whole page."""
        self._fitted = True
        if self.page is not None:
            wide, high = max(self.width() - 2.0 * MARGIN, 1.0), max(self.height() - 2.0 * MARGIN, 1.0)
            self._scale = min(wide / self.page.width, high / self.page.height)
            size = QPointF(self.page.width, self.page.height) * self._scale
            self._corner = (QPointF(self.width(), self.height()) - size) / 2.0
        self._redraw()

    def zoom(self, factor: float, about: QPointF) -> None:
        """By a factor about a point of the widget."""
        scale = min(max(self._scale * factor, SMALLEST), LARGEST)
        self._corner = about - (about - self._corner) * (scale / self._scale)
        self._scale, self._fitted = scale, False
        self._redraw()

    def pan(self, by: QPointF) -> None:
        self._corner += by
        self._fitted = False
        self._redraw()

    def _redraw(self) -> None:
        self._picture = None
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        ratio = self.devicePixelRatioF()
        if self._picture is None or self._picture.devicePixelRatioF() != ratio:
            self._picture = self._drawn(ratio)
        painter = QPainter(self)
        painter.setOpacity(0.4 if self._outdated and self.page is not None else 1.0)
        painter.drawPixmap(0, 0, self._picture)
        if self.hasFocus():
            painter.setOpacity(1.0)
            painter.setPen(QPen(QColor(colours_now().accent), 1))
            painter.drawRect(self.rect().adjusted(0, 0, -1, -1))
        painter.end()

    def _drawn(self, ratio: float) -> QPixmap:
        picture = QPixmap(self.size() * ratio)
        picture.setDevicePixelRatio(ratio)
        colours = colours_now()
        picture.fill(QColor(colours.window))
        if self.page is None:
            return picture
        painter = QPainter(picture)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.translate(self._corner)
        sheet = QRectF(0.0, 0.0, self.page.width * self._scale, self.page.height * self._scale)
        painter.fillRect(sheet.translated(2.0, 2.0), QColor(0, 0, 0, 50))
        painter.fillRect(sheet, QColor("#ffffff"))
        painter.setClipRect(sheet)
        painter.translate(0.0, sheet.height())
        painter.scale(self._scale, -self._scale)
        for item, path in self._painted:
            _paint(painter, item, path)
        painter.end()
        return picture

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() in (QEvent.Type.PaletteChange, QEvent.Type.StyleChange):
            self._redraw()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        if self._fitted:
            self.fit()
        self._redraw()

    def wheelEvent(self, event: QWheelEvent) -> None:
        self.zoom(STEP ** (event.angleDelta().y() / 120.0), event.position())
        event.accept()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self._grip = event.position()
        self.setCursor(Qt.CursorShape.ClosedHandCursor)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self._grip is not None:
            self.pan(event.position() - self._grip)
            self._grip = event.position()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        self._grip = None
        self.unsetCursor()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        self.fit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        keys = Qt.Key
        ways = {keys.Key_Left: (1, 0), keys.Key_Right: (-1, 0), keys.Key_Up: (0, 1), keys.Key_Down: (0, -1)}
        middle = QPointF(self.rect().center())
        key = keys(event.key())
        if key in ways:
            self.pan(QPointF(*ways[key]) * 40.0)
        elif key in (keys.Key_Plus, keys.Key_Equal):
            self.zoom(STEP, middle)
        elif key == keys.Key_Minus:
            self.zoom(1.0 / STEP, middle)
        elif key in (keys.Key_0, keys.Key_Home):
            self.fit()
        else:
            super().keyPressEvent(event)


def _items(page: Page) -> list[Item]:
    from ...model.drafting.page import items_of

    return items_of(page)


def _path(item: Item) -> QPainterPath:
    """What is filled or stroked, in mm of the page, y up."""
    from ...model.drafting.page import Strokes, Text

    if isinstance(item, Text):
        return _letters(item)
    path = QPainterPath()
    path.setFillRule(Qt.FillRule.OddEvenFill)
    for points in item.lines if isinstance(item, Strokes) else item.contours:
        path.addPolygon(QPolygonF([QPointF(x, y) for x, y in points.tolist()]))
        if not isinstance(item, Strokes):
            path.closeSubpath()
    return path


def _letters(text: Text) -> QPainterPath:

    font = QFont()
    font.setFamilies(FONTS)
    font.setPixelSize(LETTERS)
    wide = QFontMetricsF(font).horizontalAdvance(text.words)
    path = QPainterPath()
    path.addText({"start": 0.0, "middle": -0.5, "end": -1.0}[text.anchor] * wide, 0.0, font, text.words)
    return path


def _paint(painter: QPainter, item: Item, path: QPainterPath) -> None:
    from ...model.drafting.page import EM, Fill, Strokes

    if isinstance(item, Strokes):
        painter.strokePath(path, _pen(item))
    elif isinstance(item, Fill):
        _fill(painter, item, path)
    else:
        size = item.height * EM / LETTERS
        painter.save()
        painter.translate(*item.at)
        painter.rotate(item.angle)
        painter.scale(size, -size)
        painter.fillPath(path, QColor(item.colour))
        painter.restore()


def _fill(painter: QPainter, item: Fill, path: QPainterPath) -> None:
    painter.fillPath(path, QColor(item.colour))
    if item.role == "face":
        painter.strokePath(path, QPen(QColor(item.colour), SEAM))


def _pen(item: Strokes) -> QPen:
    pen = QPen(QColor(item.pen.colour), item.pen.weight)
    pen.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
    pen.setCapStyle(Qt.PenCapStyle.FlatCap if item.pen.dash else Qt.PenCapStyle.RoundCap)
    if item.pen.dash:
        pen.setDashPattern([length / item.pen.weight for length in item.pen.dash])
    return pen
