"""The entities of a DXF file as pieces of outlines: lines, arcs, polylines with bulges, ellipses, splines, hatches."""

from __future__ import annotations

from math import atan, degrees, isfinite
from typing import TYPE_CHECKING, Any

import numpy as np

from ...document.errors import Refusal
from ...path.shapes import arc_pieces, unit_arc
from ...spline.bspline import BSpline
from .drawing_shapes import check_near
from .dxf_chains import Piece

if TYPE_CHECKING:
    from ezdxf.entities.dxfentity import DXFEntity

    from ...path.path import Floats

READ = ("LINE", "LWPOLYLINE", "POLYLINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE", "HATCH")
FLAT_BULGE = 1e-9
"""Bulges below it are straight: they leave the chord by less than its 2e-9th part."""
_SPLINE_FRAME = 16
"""Flag of a vertex that only controls the curve which other vertices follow."""


def pieces_of(entity: DXFEntity, matrix: Floats, tolerance: float | None) -> list[Piece]:
    """The outlines of an entity, seen from above: points (x, y, z, 1) @ `matrix` (4, 4) are millimetres.

    Arcs become cubics, quarter by quarter or within `tolerance` mm. Raises Refusal where it cannot be read.
    """
    return _Maker(entity, matrix, tolerance).made()


class _Maker:
    def __init__(self, entity: Any, matrix: Floats, tolerance: float | None) -> None:
        self.entity, self.matrix = entity, matrix
        scale = matrix[:3, :3]
        if not (np.isfinite(scale).all() and scale.any()):
            raise Refusal("has no extent")
        self.tolerance = None if tolerance is None else tolerance / float(np.linalg.norm(scale, 2))

    def made(self) -> list[Piece]:
        kind = self.entity.dxftype()
        if kind == "HATCH":
            return self._hatch()
        return [getattr(self, f"_{kind.lower()}")()]

    def _from_entity(self) -> None:
        """From here on points are in the entity's own system (its extrusion's), not the world's."""
        ocs = self.entity.ocs()
        if ocs.transform:
            own = np.array([tuple(axis) for axis in (ocs.ux, ocs.uy, ocs.uz)])
            self.matrix = np.vstack((own @ self.matrix[:3], self.matrix[3:]))

    def _seen(self, points: Floats) -> Floats:
        """(n, 2) millimetres from above, of points (n, 3)."""
        seen = points @ self.matrix[:3, :2] + self.matrix[3, :2]
        check_near(seen)
        return seen

    def _piece(self, words: list[str], points: Floats, closed: bool = False) -> Piece:
        """`points` (n, 3): where it begins, and then those of each word in turn."""
        rows = iter(self._seen(points))
        start = next(rows)
        commands = [(word, *(next(rows) for _ in range(3 if word == "cubic" else 1))) for word in words]
        return Piece(start, commands, closed)

    def _line(self) -> Piece:
        dxf = self.entity.dxf
        return self._piece(["line"], np.array([tuple(dxf.start), tuple(dxf.end)]))

    def _circle(self) -> Piece:
        return self._round(self.entity.dxf.radius, 0.0, 360.0)

    def _arc(self) -> Piece:
        start, end = self.entity.dxf.start_angle, self.entity.dxf.end_angle
        return self._round(self.entity.dxf.radius, start, (end - start) % 360.0 or 360.0)

    def _round(self, radius: float, start: float, sweep: float) -> Piece:
        self._from_entity()
        if not (isfinite(radius) and radius):
            raise Refusal(f"has a radius of {radius:g}")
        axes = abs(radius) * np.eye(3)[:2]  # as AutoCAD and ezdxf take one below 0
        return self._elliptic(np.array(tuple(self.entity.dxf.center)), axes, start, sweep)

    def _ellipse(self) -> Piece:
        dxf = self.entity.dxf
        axes = np.array([tuple(dxf.major_axis), tuple(self.entity.minor_axis)])
        start, end = degrees(dxf.start_param), degrees(dxf.end_param)
        return self._elliptic(np.array(tuple(dxf.center)), axes, start, _sweep(start, end))

    def _elliptic(self, centre: Floats, axes: Floats, start: float, sweep: float) -> Piece:
        """centre + cos t axes[0] + sin t axes[1], (2, 3)."""
        size = float(np.linalg.norm(axes, 2))
        if not (np.isfinite(axes).all() and np.isfinite([start, sweep]).all() and size > 0.0):
            raise Refusal("has no extent")
        curves = unit_arc(start, sweep, arc_pieces(size, sweep, self.tolerance)) @ axes + centre
        closed = abs(sweep) >= 360.0 - 1e-9
        if closed:
            curves[-1, -1] = curves[0, 0]
        points = np.concatenate((curves[:1, 0], curves[:, 1:].reshape(-1, 3)))
        return self._piece(["cubic"] * len(curves), points, closed)

    def _lwpolyline(self) -> Piece:
        self._from_entity()
        rows = np.array(self.entity.get_points("xyb"), float).reshape(-1, 3)
        height = float(self.entity.dxf.elevation)
        return self._bulged(rows[:, :2], rows[:, 2], height, bool(self.entity.closed))

    def _polyline(self) -> Piece:
        entity = self.entity
        if not (entity.is_2d_polyline or entity.is_3d_polyline):
            raise Refusal("is a mesh, not an outline")
        vertices = [vertex.dxf for vertex in entity.vertices if not vertex.dxf.flags & _SPLINE_FRAME]
        points = np.array([tuple(vertex.location) for vertex in vertices], float).reshape(-1, 3)
        bulges = np.array([vertex.get("bulge", 0.0) for vertex in vertices], float)
        if entity.is_3d_polyline:
            return self._corners(points, bool(entity.is_closed))
        self._from_entity()
        return self._bulged(points[:, :2], bulges, points[0, 2] if len(points) else 0.0, bool(entity.is_closed))

    def _corners(self, points: Floats, closed: bool) -> Piece:
        if len(points) < 2:
            raise Refusal("has fewer than two points")
        if closed:
            points = np.vstack((points, points[:1]))
        return self._piece(["line"] * (len(points) - 1), points, closed)

    def _bulged(self, points: Floats, bulges: Floats, height: float, closed: bool) -> Piece:
        """A polyline whose bulges are the tangents of a quarter of the angle that the arc to the next point turns."""
        flat = np.abs(bulges) < FLAT_BULGE
        raised = np.column_stack((points, np.full(len(points), height)))
        if not np.isfinite(bulges).all():
            raise Refusal("has a bulge that is no finite number")
        if flat.all() or (not closed and flat[:-1].all()):
            return self._corners(raised, closed)
        if len(points) < 2:
            raise Refusal("has fewer than two points")
        ends = np.vstack((raised, raised[:1])) if closed else raised
        words: list[str] = []
        rows = [ends[:1]]
        for begin, end, bulge in zip(ends[:-1], ends[1:], bulges.tolist(), strict=False):
            if abs(bulge) < FLAT_BULGE or (begin == end).all():
                words.append("line")
                rows.append(end[None])
                continue
            curves = bulge_curves(begin[:2], end[:2], bulge, self.tolerance)
            words += ["cubic"] * len(curves)
            rows.append(np.column_stack((curves[:, 1:].reshape(-1, 2), np.full(3 * len(curves), height))))
        return self._piece(words, np.concatenate(rows), closed)

    def _spline(self) -> Piece:
        try:
            tool = self.entity.construction_tool()
        except (ValueError, TypeError, ArithmeticError, LookupError) as error:
            raise Refusal(f"has points and knots that make no curve ({error!s:.60})") from None
        return self._spline_piece(tool)

    def _spline_piece(self, tool: Any) -> Piece:
        points = np.array([tuple(point) for point in tool.control_points], float).reshape(-1, 3)
        weights = tool.weights()
        rational = len(weights) > 0 and len(set(weights)) > 1
        spline = BSpline(
            self._seen(points), tool.order - 1, np.array(tool.knots(), float), np.array(weights) if rational else None
        )
        from ...spline.bspline import ends

        start, end = ends(spline)
        size = float(np.ptp(spline.points, axis=0).max())
        closed = bool(np.abs(end - start).max() <= 1e-9 * size)
        word = {2: "line", 3: "quad", 4: "cubic"}.get(len(spline.points))
        if word is not None and len(spline.points) == spline.degree + 1 and spline.clamped and not rational:
            return Piece(start, [(word, *spline.points[1:])], closed)  # one Bezier curve
        return Piece(start, [("spline", spline)], closed)

    def _hatch(self) -> list[Piece]:
        self._from_entity()
        hatch = self.entity
        height = float(hatch.dxf.elevation[2])
        found = []
        for path in hatch.paths.rendering_paths(hatch.dxf.hatch_style):
            if path.type == 1:
                rows = np.array(path.vertices, float).reshape(-1, 3)
                found.append(self._bulged(rows[:, :2], rows[:, 2], height, True))
            else:
                found += [self._edge(edge, height) for edge in path.edges]
        return found

    def _edge(self, edge: Any, height: float) -> Piece:
        """An edge of a hatch's boundary; which way it runs is found when they are joined."""
        kind = int(edge.type)
        if kind == 1:
            return self._piece(["line"], np.array([(*edge.start, height), (*edge.end, height)]))
        if kind == 4:
            return self._spline_piece(edge.construction_tool())
        centre = np.array((*edge.center, height))
        if kind == 2:
            axes = edge.radius * np.eye(3)[:2]
            return self._elliptic(centre, axes, edge.start_angle, _sweep(edge.start_angle, edge.end_angle))
        major = np.array((*edge.major_axis, 0.0))
        minor = edge.ratio * np.array((-major[1], major[0], 0.0))
        start, end = degrees(edge.start_param), degrees(edge.end_param)
        return self._elliptic(centre, np.array((major, minor)), start, _sweep(start, end))


def _sweep(start: float, end: float) -> float:
    """Degrees counter-clockwise from start to end; a whole turn where they are the same."""
    rest = (end - start) % 360.0
    return rest if 1e-9 < rest < 360.0 - 1e-9 else 360.0


def bulge_curves(begin: Floats, end: Floats, bulge: float, tolerance: float | None) -> Floats:
    """(k, 4, 2) cubics of the arc between two points, counter-clockwise where the bulge is above 0; ends exact."""
    angle = 4.0 * atan(bulge)
    chord = complex(*(end - begin))
    radius = 0.5 * abs(chord) / abs(np.sin(0.5 * angle))
    curves = unit_arc(0.0, degrees(angle), arc_pieces(radius, degrees(angle), tolerance))
    circle = curves[..., 0] + 1j * curves[..., 1]
    # The similarity that takes the ends of the unit arc to the two points.
    turn = chord / (circle[-1, -1] - circle[0, 0])
    placed = complex(*begin) + (circle - circle[0, 0]) * turn
    found = np.stack((placed.real, placed.imag), axis=-1)
    found[0, 0], found[-1, -1] = begin, end
    return found
