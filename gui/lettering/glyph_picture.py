"""What the canvas draws: the glyph and its control points over the lines of its font's metrics."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QTransform

from ...model.lettering.fonts.drawn_glyph import DrawnGlyph
from ...model.lettering.fonts.face import Face
from ...model.path.nodes import handles
from ...model.path.path import Contour, Kind, Node, Path
from ..theme import Colours
from .glyph_desk import Place
from .glyph_paths import painter_path

NODE, HANDLE = 4.0, 3.5  # half sizes, logical pixels
FILL, BEFORE = 40, 90  # alpha of 255
ToScreen = Callable[[float, float], QPointF]


@dataclass(frozen=True, slots=True)
class Shown:
    """What is to be drawn, in font units; `before` the glyph as the font's file has it, None to leave it out."""

    face: Face
    drawn: DrawnGlyph
    before: DrawnGlyph | None
    chosen: frozenset[Place]
    hovered: tuple[int, int] | None
    """Contour and row of the point under the pointer."""


def draw_metrics(painter: QPainter, shown: Shown, at: ToScreen, size: QRectF, colours: Colours) -> None:
    """Baseline, heights and side bearings across the whole canvas, with their names at the left."""
    metrics = shown.face.metrics
    rows = [("Ascender", metrics.ascender), ("Capitals", metrics.cap_height), ("x-height", metrics.x_height),
            ("Baseline", 0.0), ("Descender", metrics.descender)]  # fmt: skip
    taken: list[float] = []
    for name, height in rows:
        y = at(0.0, height).y()
        painter.setPen(QPen(QColor(colours.muted if name == "Baseline" else colours.border), 1.0))
        painter.drawLine(QLineF(0.0, y, size.width(), y))
        if all(abs(y - other) > 13.0 for other in taken):
            taken.append(y)
            painter.setPen(QColor(colours.muted))
            painter.drawText(QPointF(6.0, y - 3.0), f"{name}  {height:g}")
    for x in (0.0, shown.drawn.advance):
        place = at(x, 0.0).x()
        painter.setPen(QPen(QColor(colours.accent), 1.0, Qt.PenStyle.DashLine))
        painter.drawLine(QLineF(place, 0.0, place, size.height()))


def draw_outline(painter: QPainter, shown: Shown, transform: QTransform, colours: Colours) -> None:
    if shown.before is not None:
        painter.setPen(QPen(_faded(colours.error, BEFORE), 1.0))
        painter.setBrush(_faded(colours.error, FILL // 2))
        painter.drawPath(transform.map(painter_path(shown.before.outline)))
    painter.setPen(QPen(QColor(colours.text), 1.25))
    painter.setBrush(_faded(colours.text, FILL))
    painter.drawPath(transform.map(painter_path(shown.drawn.outline)))


def draw_points(painter: QPainter, shown: Shown, at: ToScreen, colours: Colours) -> None:
    """Nodes, handles with their arms, and an arrow at the beginning of each contour."""
    for number, contour in enumerate(shown.drawn.outline.contours):
        arms, nodes = _arms(contour), contour.points[contour.starts[: len(contour.nodes)]].tolist()
        points = contour.points.tolist()
        painter.setPen(QPen(QColor(colours.muted), 1.0))
        for handle, node in arms:
            painter.drawLine(QLineF(at(*points[handle]), at(*points[node])))
        for handle in dict.fromkeys(handle for handle, _ in arms):
            hovered = shown.hovered == (number, handle)
            painter.setPen(QPen(QColor(colours.accent), 1.25))
            painter.setBrush(QColor(colours.accent if hovered else colours.ground))
            painter.drawEllipse(at(*points[handle]), HANDLE, HANDLE)
        for place, (x, y) in enumerate(nodes):
            chosen = (number, place) in shown.chosen
            hovered = shown.hovered == (number, int(contour.starts[place]))
            painter.setPen(QPen(QColor(colours.accent), 1.25))
            painter.setBrush(QColor(colours.accent if chosen or hovered else colours.ground))
            _node(painter, at(x, y), Node(int(contour.nodes[place])))


def _node(painter: QPainter, here: QPointF, kind: Node) -> None:
    """A square for a cusp, a disc for a smooth node, a diamond for a symmetric one, a dotted disc for automatic."""
    box = QRectF(here.x() - NODE, here.y() - NODE, 2 * NODE, 2 * NODE)
    if kind == Node.CUSP:
        painter.drawRect(box)
    elif kind == Node.SYMMETRIC:
        reach = 1.25 * NODE
        sides = (QPointF(0, -reach), QPointF(reach, 0), QPointF(0, reach), QPointF(-reach, 0))
        painter.drawPolygon([here + side for side in sides])
    else:
        painter.drawEllipse(box)
        if kind == Node.AUTO:
            painter.drawPoint(here)


def _arms(contour: Contour) -> list[tuple[int, int]]:
    """(handle, node) as rows of the contour's points; the control point of a quadratic has an arm to either end."""
    found = handles(contour)
    arms = [
        (int(handle), int(node))
        for side in (found.before, found.after)
        for handle, node in zip(side.tolist(), found.node.tolist(), strict=True)
        if handle >= 0
    ]
    starts = contour.starts
    for segment in (contour.kinds == Kind.QUADRATIC).nonzero()[0].tolist():
        control = int(starts[segment]) + 1
        arms += [(control, int(starts[segment])), (control, int(starts[segment + 1]))]
    return arms


def handle_rows(contour: Contour) -> list[int]:
    """The rows of the contour's points that are handles."""
    return list(dict.fromkeys(handle for handle, _ in _arms(contour)))


def bounds_of(outline: Path) -> tuple[float, float, float, float] | None:
    """Lowest x, lowest y, highest x, highest y; None for an empty glyph."""
    if not outline.contours:
        return None
    (left, low), (right, high) = outline.bounds().tolist()
    return left, low, right, high


def _faded(colour: str, alpha: int) -> QColor:
    found = QColor(colour)
    found.setAlpha(alpha)
    return found
