"""How the second view is drawn: the wire-frame within and without, the frustum or its cube, the ray of the vertex."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPolygonF

from ....model.pipeline.clipping import NAMES, PLANES, clipped_lines
from ....model.pipeline.stages import divided
from ...theme import colours_now
from ..flow import BEFORE_EYE, CUBE, Flow
from ..inks import inks_now

if TYPE_CHECKING:
    from .frustum_view import FrustumView

Floats = NDArray[np.float64]
SIDES = np.array([(0, 1), (1, 2), (2, 3), (3, 0)])
RIMS = {"near": SIDES, "far": SIDES + 4}
BETWEEN = np.array([(0, 4), (1, 5), (2, 6), (3, 7)])
AROUND = np.array([*PLANES, *BEFORE_EYE]) + np.array([[0.0, 0.0, 0.0, 1.5]] * 6 + [[0.0] * 4])
"""Planes of a larger cube: so much of what is outside is drawn in device space."""
MOST_POLYGONS = 800
SMOOTH = 1000
"""So many lines are drawn smoothly."""
CROWD = 400
"""Of more lines each is drawn fainter, so that they stay lines."""
NOTHING = "Nothing is shown: add a solid, or show one."
AXIS = 24.0  # pixels that an axis is long
APART = 26.0  # pixels between points that are both named


def device_axes(points: Floats) -> Floats:
    """(..., 3) device coordinates as they are shown: x to the right, y up, depth away from who looks."""
    return points[..., [0, 2, 1]]


class FrustumPainter:
    """Paints one picture."""

    def __init__(self, view: FrustumView, painter: QPainter) -> None:
        self._view, self._painter = view, painter
        self._inks, self._colours = inks_now(), colours_now()

    def paint(self) -> None:
        view, painter = self._view, self._painter
        painter.fillRect(view.rect(), QColor(self._colours.ground))
        flow = view.flow
        if flow is None:
            painter.setPen(QColor(self._colours.muted))
            painter.drawText(QRectF(view.rect()), Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap, NOTHING)
            return
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, len(flow.lines) <= SMOOTH)
        self._wires(flow)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        self._polygons(flow)
        self._frustum(flow)
        self._ray(flow)
        self._axes()

    def _shown(self, clip: Floats) -> Floats:
        """(..., 3) where clip coordinates (..., 4) stand in what is shown."""
        assert self._view.flow is not None
        return device_axes(divided(clip)) if self._view.device else self._view.flow.world(clip)

    def _wires(self, flow: Flow) -> None:
        if self._view.device:
            found, visible = clipped_lines(flow.lines, AROUND)
            outside = self._shown(found[visible])
            found, visible = clipped_lines(flow.inside, BEFORE_EYE)
            inside = self._shown(found[visible])
        else:
            outside, inside = flow.geometry.lines, self._shown(flow.inside)
        self._draw(outside, self._inks.outside, 1.0)
        many = len(inside) > CROWD
        self._draw(inside, self._inks.inside, 1.0 if many else 1.3, opacity=0.45 if many else 1.0)

    def _polygons(self, flow: Flow) -> None:
        """What the planes have cut, tinted."""
        fill = QColor(self._inks.cut)
        fill.setAlpha(110)
        self._painter.setPen(QPen(QColor(self._inks.cut), 1.2))
        self._painter.setBrush(fill)
        for polygon in flow.cut[:MOST_POLYGONS]:
            shown = self._shown(polygon)
            if np.isfinite(shown).all():
                self._painter.drawPolygon(QPolygonF([QPointF(x, y) for x, y in self._view.to_widget(shown).tolist()]))
        self._painter.setBrush(Qt.BrushStyle.NoBrush)

    def _frustum(self, flow: Flow) -> None:
        device = self._view.device
        corners = device_axes(CUBE) if device else flow.frustum
        self._draw(corners[BETWEEN], self._inks.frustum, 1.4)
        eye = None if device else flow.eye
        if eye is not None:
            ways = np.stack((np.broadcast_to(eye, (4, 3)), corners[:4]), axis=1)
            self._draw(ways, self._inks.frustum, 1.0, Qt.PenStyle.DashLine)
            self._dot(eye, self._inks.frustum, 4.0)
            self._word(eye, "eye", self._inks.frustum, (-10.0, -12.0))
        for name, rim in RIMS.items():
            ink = getattr(self._inks, name)
            off = not (flow.planes == PLANES[NAMES.index(name)]).all(axis=1).any()
            self._draw(corners[rim], ink, 2.0, Qt.PenStyle.DotLine if off else Qt.PenStyle.SolidLine)
            corner = corners[rim[0 if name == "near" else 2, 0]]
            if eye is None or self._apart(corner, eye):
                self._word(corner, name, ink, (-12.0, 15.0) if name == "near" else (4.0, -4.0))

    def _ray(self, flow: Flow) -> None:
        point = flow.clip_point
        if point is None or flow.point is None:
            return
        ink = self._inks.ray
        eye = flow.eye
        with np.errstate(all="ignore"):
            x, y = point[:2] / point[3]
        if point[3] > 0.0 and np.isfinite((x, y)).all():
            ends = self._shown(np.array([(x, y, -1.0, 1.0), (x, y, 1.0, 1.0)]))
            start = ends[0] if self._view.device or eye is None else eye
            self._draw(np.array([(start, ends[1])]), ink, 1.6)
            shown = self._shown(point)
            self._cross(ends[0], ink, self._apart(ends[0], shown) and self._apart(ends[0], start, self._view.device))
        else:
            shown = None if self._view.device else flow.point
        if shown is not None:
            self._dot(shown, ink, 4.0)
            self._word(shown, "vertex", ink, (-44.0, -8.0))

    def _axes(self) -> None:
        """The three axes of what is shown, in the lower left corner."""
        names = ("x", "depth", "y") if self._view.device else ("x", "y", "z")
        middle = np.asarray(self._view.camera.target, float)
        size = 2.0 * self._view.camera.half_height / max(self._view.height(), 1) * AXIS
        ends = self._view.to_widget(middle + size * np.vstack((np.zeros(3), np.eye(3))))
        ends += np.array((34.0, self._view.height() - 34.0)) - ends[0]
        ink = QColor(self._colours.muted)
        self._painter.setPen(QPen(ink, 1.4))
        for name, end in zip(names, ends[1:], strict=True):
            self._painter.drawLine(QPointF(*ends[0]), QPointF(*end))
            way = end - ends[0]
            place = end + way / max(float(np.linalg.norm(way)), 8.0) * 9.0
            box = QRectF(place[0] - 30.0, place[1] - 8.0, 60.0, 16.0)
            self._painter.drawText(box, Qt.AlignmentFlag.AlignCenter, name)

    # In pixels.

    def _draw(
        self,
        lines: Floats,
        ink: str,
        width: float,
        style: Qt.PenStyle = Qt.PenStyle.SolidLine,
        opacity: float = 1.0,
    ) -> None:
        """Lines (n, 2, 3) of what is shown, cut off at the widget's border: the far end of a frustum may be far."""
        if not len(lines):
            return
        size = np.array((max(self._view.width(), 1), max(self._view.height(), 1)), float)
        pixels = self._view.to_widget(lines.reshape(-1, 3)) / size * 2.0 - 1.0
        flat = np.column_stack((pixels, np.zeros(len(pixels)), np.full(len(pixels), 1.05))).reshape(-1, 2, 4)
        flat = flat[np.isfinite(flat).all(axis=(1, 2))]
        found, visible = clipped_lines(flat, PLANES[:4])
        ends = (found[visible, :, :2] + 1.0) / 2.0 * size
        colour = QColor(ink)
        colour.setAlphaF(opacity)
        self._painter.setPen(QPen(colour, width, style))
        self._painter.drawLines([QLineF(*row) for row in ends.reshape(-1, 4).tolist()])

    def _place(self, point: Floats) -> QPointF | None:
        x, y = self._view.to_widget(point[None])[0].tolist()
        return QPointF(x, y) if abs(x) < 1e5 and abs(y) < 1e5 else None

    def _dot(self, point: Floats, ink: str, radius: float) -> None:
        place = self._place(point)
        if place is not None:
            self._painter.setPen(QPen(QColor(self._colours.ground), 1.5))
            self._painter.setBrush(QColor(ink))
            self._painter.drawEllipse(place, radius, radius)
            self._painter.setBrush(Qt.BrushStyle.NoBrush)

    def _apart(self, one: Floats, other: Floats, yes: bool = False) -> bool:
        """Whether two points are so far from each other that both can be named."""
        return yes or float(np.abs(np.subtract(*self._view.to_widget(np.array((one, other))))).max()) > APART

    def _cross(self, point: Floats, ink: str, named: bool) -> None:
        """The pixel, on the near side."""
        place = self._place(point)
        if place is not None:
            self._painter.setPen(QPen(QColor(ink), 2.0))
            self._painter.drawLine(place - QPointF(5.0, 0.0), place + QPointF(5.0, 0.0))
            self._painter.drawLine(place - QPointF(0.0, 5.0), place + QPointF(0.0, 5.0))
            if named:
                self._word(point, "pixel", ink, (7.0, -5.0))

    def _word(self, point: Floats, text: str, ink: str, aside: tuple[float, float]) -> None:
        place = self._place(point)
        if place is not None:
            self._painter.setPen(QColor(ink))
            x, y = place.x() + aside[0], place.y() + aside[1]
            if 0.0 <= place.x() <= self._view.width() and 0.0 <= place.y() <= self._view.height():
                wide = self._painter.fontMetrics().horizontalAdvance(text)
                x = min(max(x, 2.0), self._view.width() - wide - 2.0)
                y = min(max(y, 12.0), self._view.height() - 4.0)
            self._painter.drawText(QPointF(x, y), text)
