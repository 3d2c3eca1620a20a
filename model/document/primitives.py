"""The leaves of a CSG tree that are solids by themselves."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from . import fields
from .expression import Number
from .nodes import Node


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Box(Node):
    """A cuboid with its lowest corner at the origin."""

    title: ClassVar[str] = "Box"
    size: tuple[Number, ...] = fields.sizes((20.0, 20.0, 20.0), "Size", "Along x, y and z")
    centred: bool = fields.flag(False, "Centred", "The origin in the middle")


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Sphere(Node):
    """A ball about the origin."""

    title: ClassVar[str] = "Sphere"
    radius: Number = fields.size(10.0, "Radius")
    segments: Number | None = fields.segments()
    tolerance: Number | None = fields.tolerance()


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Cylinder(Node):
    """A round bar standing on z = 0 around the z axis."""

    title: ClassVar[str] = "Cylinder"
    radius: Number = fields.size(5.0, "Radius")
    height: Number = fields.size(20.0, "Height")
    centred: bool = fields.flag(False, "Centred", "The origin at half the height")
    segments: Number | None = fields.segments()
    tolerance: Number | None = fields.tolerance()


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Cone(Node):
    """A cone, or a frustum, standing on z = 0 around the z axis."""

    title: ClassVar[str] = "Cone"
    radius: Number = fields.length(10.0, "Radius", "At the foot", minimum=0.0)
    top_radius: Number = fields.length(0.0, "Top radius", "0 makes a point", minimum=0.0)
    height: Number = fields.size(20.0, "Height")
    centred: bool = fields.flag(False, "Centred", "The origin at half the height")
    segments: Number | None = fields.segments()
    tolerance: Number | None = fields.tolerance()


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Torus(Node):
    """A ring around the z axis, centred at the origin."""

    title: ClassVar[str] = "Torus"
    radius: Number = fields.size(15.0, "Radius", "From the axis to the middle of the tube")
    tube_radius: Number = fields.size(4.0, "Tube radius")
    segments: Number | None = fields.segments()
    tolerance: Number | None = fields.tolerance()


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Halfspace(Node):
    """All on the side of a plane that its normal points to."""

    title: ClassVar[str] = "Half-space"
    normal: tuple[Number, ...] = fields.direction((0.0, 0.0, 1.0), "Normal", "Points to the side that is kept")
    point: tuple[Number, ...] = fields.position((0.0, 0.0, 0.0), "Point", "On the plane")


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Polyhedron(Node):
    """A closed surface of flat faces, counter-clockwise seen from outside; an inside-out one is turned."""

    title: ClassVar[str] = "Polyhedron"
    points: tuple[tuple[Number, ...], ...] = fields.points("Points")
    faces: tuple[tuple[int, ...], ...] = fields.faces("Faces", "Each the indices of its points")


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class ImportedMesh(Node):
    """One solid of a mesh file that the document carries."""

    title: ClassVar[str] = "Imported mesh"
    asset: str = fields.text("", "Asset", "SHA-256 of the file")
    file_format: str = fields.text("stl", "Format")
    part: Number = fields.count(0, "Part", "Which solid of the file, from 0", minimum=0)
    unit: Number = fields.factor(1.0, "Unit", "Millimetres in one unit of the file", minimum=0.0, above=True)


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Relief(Node):
    """A plate whose top rises with the lightness of a bitmap that the document carries.

    It stands on z = 0 with its lowest corner at the origin. Samples are the means of the pixels around the middles of
    the grid's cells; between them the top is flat in triangles, and the border is as high as the samples next to it.
    """

    title: ClassVar[str] = "Relief"
    asset: str = fields.text("", "Asset", "SHA-256 of the bitmap")
    width: Number = fields.size(100.0, "Width", "Along x; the other side is in proportion to the bitmap")
    height: Number = fields.size(5.0, "Height", "From black to white")
    base: Number = fields.size(2.0, "Base", "Of the plate below black")
    invert: bool = fields.flag(False, "Invert", "Dark is high")
    smoothing: Number = fields.factor(0.0, "Smoothing", "Standard deviation in samples; 0 leaves the bitmap as it is",
                                      minimum=0.0)  # fmt: skip
    samples: Number = fields.count(400, "Samples", "Along the longer side, at most", minimum=1)
