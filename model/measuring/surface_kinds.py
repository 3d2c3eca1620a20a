"""The kinds of surfaces that faces lie on, in the world's axes and millimetres."""

from __future__ import annotations

from dataclasses import dataclass

Vector = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Plane:
    """`normal` is unit and points out of the solid; `point` lies on the plane."""

    point: Vector
    normal: Vector


@dataclass(frozen=True, slots=True)
class CylinderSurface:
    """`axis` is unit; `hollow` tells a hole's wall from a bar's. `deviation`: see surfaces.surface_at."""

    point: Vector
    axis: Vector
    radius: float
    hollow: bool = False
    deviation: float | None = None


@dataclass(frozen=True, slots=True)
class ConeSurface:
    """`axis` points from the apex into the cone; `half_angle` in degrees, between the axis and the surface."""

    apex: Vector
    axis: Vector
    half_angle: float
    hollow: bool = False


@dataclass(frozen=True, slots=True)
class SphereSurface:
    centre: Vector
    radius: float
    hollow: bool = False
    deviation: float | None = None


@dataclass(frozen=True, slots=True)
class TorusSurface:
    """`radius` from the axis to the middle of the tube, `tube_radius` of the tube."""

    centre: Vector
    axis: Vector
    radius: float
    tube_radius: float
    hollow: bool = False


@dataclass(frozen=True, slots=True)
class Facet:
    """A flat piece of a surface that has no radius: of a twisted or unevenly scaled one, say."""

    point: Vector
    normal: Vector


Surface = Plane | CylinderSurface | ConeSurface | SphereSurface | TorusSurface | Facet
