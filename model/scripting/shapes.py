"""Shapes as values: parameters and primitives."""

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
from ..document.primitives import Box, Cone, Cylinder, Halfspace, ImportedMesh, Polyhedron, Relief, Sphere, Torus

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


def relief(
    bitmap: str | os.PathLike[str] = "",
    width: Value = 100,
    height: Value = 5,
    base: Value = 2,
    *,
    asset: str = "",
    invert: bool = False,
    smoothing: Value = 0,
    samples: Value = 400,
) -> Relief:
    """A plate whose top rises with the lightness of a bitmap file: `height` mm from black to white above the `base`.

    `samples` are those along the longer side at most; `smoothing` is a standard deviation in samples.
    """
    if bitmap and not asset:
        from .surfaces import kept

        asset = kept(bitmap)
    return Relief(asset=asset, width=width, height=height, base=base, invert=invert, smoothing=smoothing,
                  samples=samples)  # fmt: skip


def mesh(path: str | os.PathLike[str]) -> Node:
    """The solids of a mesh file (STL, 3MF, OBJ, PLY, OFF, GLB); several become one union."""
    from ..exchange.meshes_in import read_any

    solids = read_any(Path(path)).solids
    return solids[0] if len(solids) == 1 else Union(children=solids, name=Path(path).stem)


__all__ = [
    "box",
    "cone",
    "cylinder",
    "halfspace",
    "imported_mesh",
    "mesh",
    "parameter",
    "polyhedron",
    "relief",
    "sphere",
    "torus",
]
