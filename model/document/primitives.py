"""The leaves of a CSG tree, and outlines turned into solids."""

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
class Rectangle(Node):
    """An outline with its lowest corner at the origin."""

    title: ClassVar[str] = "Rectangle"
    width: Number = fields.size(20.0, "Width")
    height: Number = fields.size(10.0, "Height")
    centred: bool = fields.flag(False, "Centred", "The origin in the middle")


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Circle(Node):
    """A round outline about the origin."""

    title: ClassVar[str] = "Circle"
    radius: Number = fields.size(10.0, "Radius")
    segments: Number | None = fields.segments()
    tolerance: Number | None = fields.tolerance()


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Polygon(Node):
    """A closed outline of straight sides, with holes; it is filled where an odd number of loops goes round."""

    title: ClassVar[str] = "Polygon"
    points: tuple[tuple[Number, ...], ...] = fields.points("Points", flat=True)
    loops: tuple[tuple[int, ...], ...] = fields.faces("Loops", "Each the indices of its points; none: all in one loop")


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Extrude(Node):
    """An outline in the plane z = 0, drawn up along z."""

    title: ClassVar[str] = "Extrusion"
    operands: ClassVar[tuple[int, int | None]] = (1, 1)
    height: Number = fields.size(10.0, "Height")
    twist: Number = fields.angle(0.0, "Twist", "From foot to top")
    top_scale: Number = fields.factor(1.0, "Top scale", "Of the outline at the top; 0 makes a point", minimum=0.0)
    centred: bool = fields.flag(False, "Centred", "The origin at half the height")
    segments: Number | None = fields.segments()
    tolerance: Number | None = fields.tolerance()


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Revolve(Node):
    """An outline turned about its y axis, which becomes z; what lies at x < 0 is left out."""

    title: ClassVar[str] = "Revolution"
    operands: ClassVar[tuple[int, int | None]] = (1, 1)
    angle: Number = fields.angle(360.0, "Angle", minimum=0.0, above=True)
    segments: Number | None = fields.segments()
    tolerance: Number | None = fields.tolerance()


OUTLINES: tuple[type[Node], ...] = (Rectangle, Circle, Polygon)
