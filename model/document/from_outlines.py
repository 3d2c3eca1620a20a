"""Solids made of outlines: drawn up, turned, drawn along a path, stretched between several."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from . import fields
from .expression import Number
from .nodes import Node


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Extrude(Node):
    """An outline in the plane z = 0, drawn up along z, and down where `below` says so.

    Twist, scale and taper begin at the outline and go on at the same rate on both sides of it; a bevel is at the top
    alone.
    """

    title: ClassVar[str] = "Extrusion"
    operands: ClassVar[tuple[int, int | None]] = (1, 1)
    height: Number = fields.size(10.0, "Height")
    below: Number = fields.length(0.0, "Below", "How far it is drawn to the other side as well", minimum=0.0)
    taper: Number = fields.angle(0.0, "Taper", "How far the walls lean inwards, from -89 to 89")
    bevel: Number = fields.length(0.0, "Bevel", "Cuts the edge of the top at 45°, by so much in height and in width; "
                                  "what is narrower ends in a ridge", minimum=0.0)  # fmt: skip
    twist: Number = fields.angle(0.0, "Twist", "From the outline to the top")
    top_scale: Number = fields.factor(1.0, "Top scale", "Of the outline at the top; 0 makes a point", minimum=0.0)
    centred: bool = fields.flag(False, "Centred", "The origin at half the height")
    segments: Number | None = fields.segments()
    tolerance: Number | None = fields.tolerance()


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Revolve(Node):
    """An outline turned about its y axis, which becomes z; what lies at x < 0 is left out.

    An open curve is closed along the axis.
    """

    title: ClassVar[str] = "Revolution"
    operands: ClassVar[tuple[int, int | None]] = (1, 1)
    angle: Number = fields.angle(360.0, "Angle", minimum=0.0, above=True)
    start: Number = fields.angle(0.0, "Start", "Where the turn begins")
    segments: Number | None = fields.segments()
    tolerance: Number | None = fields.tolerance()


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Sweep(Node):
    """The first operand, an outline, drawn along the second, a path; the outline's origin runs along the path.

    The outline stands across the path and does not turn about it (rotation-minimising frame); at the start its y axis
    is as near to z as it can be.
    """

    title: ClassVar[str] = "Sweep"
    operands: ClassVar[tuple[int, int | None]] = (2, 2)
    twist: Number = fields.angle(0.0, "Twist", "From start to end")
    end_scale: Number = fields.factor(1.0, "End scale", "Of the outline at the end; 0 makes a point", minimum=0.0)
    segments: Number | None = fields.segments()
    tolerance: Number | None = fields.tolerance()


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Loft(Node):
    """A solid stretched over outlines, from the first to the last; each stands where it is placed."""

    title: ClassVar[str] = "Loft"
    operands: ClassVar[tuple[int, int | None]] = (2, None)
    smooth: bool = fields.flag(False, "Smooth", "Curved from outline to outline; else straight")
    closed: bool = fields.flag(False, "Closed", "From the last outline back to the first")
    tolerance: Number | None = fields.tolerance()


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Pipe(Node):
    """A round bar, or a tube, along a path."""

    title: ClassVar[str] = "Pipe"
    operands: ClassVar[tuple[int, int | None]] = (1, 1)
    radius: Number = fields.size(2.0, "Radius")
    bore: Number = fields.length(0.0, "Bore", "Radius of the hole along it; 0: none", minimum=0.0)
    rounded: bool = fields.flag(False, "Rounded", "Ends are half balls")
    segments: Number | None = fields.segments()
    tolerance: Number | None = fields.tolerance()


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Wrap(Node):
    """An outline laid round a cylinder about the z axis: its x runs round, its y is z; x = 0 is in front, at -y.

    It reaches from `below` under the cylinder's surface to `height` above it.
    """

    title: ClassVar[str] = "Wrap"
    operands: ClassVar[tuple[int, int | None]] = (1, 1)
    radius: Number = fields.size(20.0, "Radius", "Of the cylinder")
    height: Number = fields.length(1.0, "Height", "How far it stands out", minimum=0.0)
    below: Number = fields.length(1.0, "Below", "How far it goes in", minimum=0.0)
    tolerance: Number | None = fields.tolerance()


FROM_OUTLINES: tuple[type[Node], ...] = (Extrude, Revolve, Sweep, Loft, Pipe, Wrap)
