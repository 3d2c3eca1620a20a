"""Shapes as values: parameters, primitives, outlines, and the solids they make."""

# Nodes take numbers as text too, and keep them as expressions; their types tell what they keep.
# pyright: reportArgumentType=false

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from ..document.document import Parameter
from ..document.expression import Expression, Number
from ..document.nodes import (
    Node,
    Union,
)
from ..document.primitives import (
    Box,
    Circle,
    Cone,
    Cylinder,
    Extrude,
    Halfspace,
    ImportedMesh,
    Polygon,
    Polyhedron,
    Rectangle,
    Revolve,
    Sphere,
    Torus,
)

Value = Number | str | int
"""A number, an expression, or an expression's text."""


def parameter(
    name: str,
    value: Value,
    minimum: float | None = None,
    maximum: float | None = None,
    choices: Sequence[float] = (),
    note: str = "",
    group: str = "",
) -> Expression:
    """Declare a parameter of the document; the result may stand in any number and be reckoned with.

    >>> width = parameter("width", 10, minimum=1)
    >>> box(width, width / 2, 3)
    <Box ...>
    """
    new = Parameter(name, value, minimum, maximum, tuple(choices), note, group)
    below = new.value.declares if isinstance(new.value, Expression) else ()
    return Expression(new.name, (*below, new))


def box(x: Any = 20, y: Value | None = None, z: Value | None = None, centred: bool = False, *, size: Any = None) -> Box:
    """A cuboid with its lowest corner at the origin; one number makes a cube.

    >>> measure(box(10, 20, 30)).volume
    6000.0
    """
    wanted = x if size is None else size
    if isinstance(wanted, Iterable) and not isinstance(wanted, str):
        return Box(size=tuple(wanted), centred=centred)
    if size is not None:
        return Box(size=(size, size, size), centred=centred)
    return Box(size=(x, x if y is None else y, x if z is None else z), centred=centred)


def sphere(radius: Value = 10, segments: int | None = None, tolerance: Value | None = None) -> Sphere:
    """A ball about the origin.

    >>> sphere(10).at(0, 0, 5)
    <Sphere ...>
    """
    return Sphere(radius=radius, segments=segments, tolerance=tolerance)


def cylinder(
    radius: Value = 5,
    height: Value = 20,
    centred: bool = False,
    segments: int | None = None,
    tolerance: Value | None = None,
) -> Cylinder:
    """A round bar standing on z = 0 around the z axis.

    >>> measure(cylinder(5, 10, segments=4)).volume
    500.0
    """
    return Cylinder(radius=radius, height=height, centred=centred, segments=segments, tolerance=tolerance)


def cone(
    radius: Value = 10,
    top_radius: Value = 0,
    height: Value = 20,
    centred: bool = False,
    segments: int | None = None,
    tolerance: Value | None = None,
) -> Cone:
    """A cone, or a frustum, standing on z = 0 around the z axis.

    >>> cone(10, top_radius=4, height=20)
    <Cone ...>
    """
    return Cone(
        radius=radius, top_radius=top_radius, height=height, centred=centred, segments=segments, tolerance=tolerance
    )


def torus(
    radius: Value = 15, tube_radius: Value = 4, segments: int | None = None, tolerance: Value | None = None
) -> Torus:
    """A ring around the z axis, centred at the origin.

    >>> torus(15, 4)
    <Torus ...>
    """
    return Torus(radius=radius, tube_radius=tube_radius, segments=segments, tolerance=tolerance)


def halfspace(normal: Sequence[Value] = (0, 0, 1), point: Sequence[Value] = (0, 0, 0)) -> Halfspace:
    """All on the side of the plane through `point` that `normal` points to.

    >>> measure(sphere(10, segments=8) & halfspace((0, 0, 1), (0, 0, 10))).volume
    0.0
    """
    return Halfspace(normal=tuple(normal), point=tuple(point))


def polyhedron(points: Iterable[Sequence[Value]] = (), faces: Iterable[Sequence[int]] = ()) -> Polyhedron:
    """A closed surface: `points` (n, 3), and `faces` as indices, counter-clockwise seen from outside.

    >>> tetrahedron = polyhedron([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
    ...                          [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])
    >>> round(measure(tetrahedron).volume, 6)
    0.166667
    """
    return Polyhedron(points=tuple(tuple(p) for p in points), faces=tuple(tuple(f) for f in faces))


def imported_mesh(asset: str = "", file_format: str = "stl", part: int = 0, unit: Value = 1) -> ImportedMesh:
    """One solid of a mesh file that is among the assets already, by its SHA-256; `mesh` reads a file."""
    return ImportedMesh(asset=asset, file_format=file_format, part=part, unit=unit)


def mesh(path: str | os.PathLike[str]) -> Node:
    """The solids of a mesh file (STL, 3MF, OBJ, PLY, OFF, GLB); several become one union."""
    from ..exchange.meshes_in import read_any

    solids = read_any(Path(path)).solids
    return solids[0] if len(solids) == 1 else Union(children=solids, name=Path(path).stem)


def rectangle(width: Value = 20, height: Value = 10, centred: bool = False) -> Rectangle:
    """An outline with its lowest corner at the origin.

    >>> measure(extrude(rectangle(4, 5), 6)).volume
    120.0
    """
    return Rectangle(width=width, height=height, centred=centred)


def circle(radius: Value = 10, segments: int | None = None, tolerance: Value | None = None) -> Circle:
    """A round outline about the origin.

    >>> circle(4).at(12)
    <Circle ...>
    """
    return Circle(radius=radius, segments=segments, tolerance=tolerance)


def polygon(points: Iterable[Sequence[Value]] = (), loops: Iterable[Sequence[int]] = ()) -> Polygon:
    """A closed outline of straight sides through `points` (n, 2); `loops` of indices make holes (even-odd rule).

    >>> measure(extrude(polygon([(0, 0), (4, 0), (0, 3)]), 2)).volume
    12.0
    """
    return Polygon(points=tuple(tuple(p) for p in points), loops=tuple(tuple(loop) for loop in loops))


def extrude(
    outline: Node,
    height: Value = 10,
    twist: Value = 0,
    top_scale: Value = 1,
    centred: bool = False,
    segments: int | None = None,
    tolerance: Value | None = None,
) -> Extrude:
    """An outline drawn up along z, twisted by degrees and scaled towards the top.

    >>> extrude(circle(10), height=5, top_scale=0.5)
    <Extrude ...>
    """
    return Extrude(
        children=(outline,),
        height=height,
        twist=twist,
        top_scale=top_scale,
        centred=centred,
        segments=segments,
        tolerance=tolerance,
    )


def revolve(outline: Node, angle: Value = 360, segments: int | None = None, tolerance: Value | None = None) -> Revolve:
    """An outline turned about its y axis, which becomes z.

    >>> revolve(circle(4).at(12), angle=180)
    <Revolve ...>
    """
    return Revolve(children=(outline,), angle=angle, segments=segments, tolerance=tolerance)


__all__ = [
    "box",
    "circle",
    "cone",
    "cylinder",
    "extrude",
    "halfspace",
    "imported_mesh",
    "mesh",
    "parameter",
    "polygon",
    "polyhedron",
    "rectangle",
    "revolve",
    "sphere",
    "torus",
]
