"""What scripts, the console and the examples write: `box(10) - cylinder(3)`.

Everything is a value: a call returns a new one. Lengths are millimetres and angles degrees; any number may be an
expression, as text or made from `parameter`. The methods of a solid place and dress it, in call order, about the
world's origin: `at`, `turned`, `scaled`, `mirrored`, `transformed`, `named`, `coloured`, `noted`, `hidden`. The nodes
of an open document are placed by `move`, `turn` and `scale`, operations that the window's script log shows.
"""

# Nodes take numbers as text too, and keep them as expressions; their types tell what they keep.
# pyright: reportArgumentType=false

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from .document import placement
from .document.document import Document, Parameter
from .document.errors import Refusal
from .document.expression import Expression, Number
from .document.nodes import (
    Difference,
    Hull,
    Instance,
    Intersection,
    LinearArray,
    Minkowski,
    Mirror,
    Node,
    PolarArray,
    Union,
)
from .document.placement import Affine, Move, Reflect, Scale, Turn
from .document.primitives import (
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
from .document.tree import numbered, unique_name, walk
from .operations.parameters import declared, names_of

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
    from .exchange.meshes_in import read_any

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


def _solids(nodes: Iterable[Any]) -> tuple[Node, ...]:
    found: list[Node] = []
    for node in nodes:
        found += [node] if isinstance(node, Node) else _solids(node)
    return tuple(found)


def union(*solids: Node | Iterable[Node]) -> Union:
    """All that lies in any of the solids; `a + b` in short.

    >>> measure(union(box(1), box(1).at(5))).components
    2
    """
    return Union(children=_solids(solids))


def difference(first: Node | Iterable[Node] = (), *others: Node | Iterable[Node]) -> Difference:
    """The first solid less all others; `a - b` in short.

    >>> measure(difference(box(2), box(1))).volume
    7.0
    """
    return Difference(children=_solids((first, *others)))


def intersection(*solids: Node | Iterable[Node]) -> Intersection:
    """What lies in all of the solids; `a & b` in short.

    >>> measure(intersection(box(2), box(2).at(1, 1, 1))).volume
    1.0
    """
    return Intersection(children=_solids(solids))


def hull(*solids: Node | Iterable[Node]) -> Hull:
    """The smallest convex solid around the solids.

    >>> measure(hull(box(1), box(1).at(4))).volume
    5.0
    """
    return Hull(children=_solids(solids))


def minkowski(first: Node | Iterable[Node] = (), *others: Node | Iterable[Node]) -> Minkowski:
    """The first solid swept by each of the others (Minkowski sum).

    >>> measure(minkowski(box(3), box(1))).volume
    64.0
    """
    return Minkowski(children=_solids((first, *others)))


def linear_array(solid: Node, count: Value = 3, step: Sequence[Value] = (20, 0, 0)) -> LinearArray:
    """Copies of a solid, each one step further.

    >>> measure(linear_array(box(1), 5, (2, 0, 0))).volume
    5.0
    """
    return LinearArray(children=(solid,), count=count, step=tuple(step))


def polar_array(
    solid: Node,
    count: Value = 6,
    angle: Value = 360,
    axis: Sequence[Value] = (0, 0, 1),
    point: Sequence[Value] = (0, 0, 0),
) -> PolarArray:
    """Copies of a solid turned about an axis; a full turn spreads them evenly, a part of one goes from first to last.

    >>> measure(polar_array(box(1).at(5), 4)).components
    4
    """
    return PolarArray(children=(solid,), count=count, angle=angle, axis=tuple(axis), point=tuple(point))


def mirror(
    solid: Node, normal: Sequence[Value] = (1, 0, 0), point: Sequence[Value] = (0, 0, 0), keep: bool = True
) -> Mirror:
    """A solid and its mirror image in a plane, or with `keep=False` the image alone (as `solid.mirrored` has it).

    >>> measure(mirror(box(1).at(2))).volume
    2.0
    """
    return Mirror(children=(solid,), normal=tuple(normal), point=tuple(point), keep=keep)


def instance(definition: str = "") -> Instance:
    """The document's definition of this id, once more; it has a meaning only in that document."""
    return Instance(definition=definition)


def at(x: Value = 0, y: Value = 0, z: Value = 0) -> Move:
    """A placement step for `place`: a move by millimetres.

    >>> box(1).placed(turned(z=45), at(5)) == box(1).turned(z=45).at(5)
    True
    """
    return placement.moved(x, y, z)


def turned(x: Value = 0, y: Value = 0, z: Value = 0) -> Turn:
    """A placement step for `place`: a turn by degrees about x, then y, then z."""
    return placement.turned(x, y, z)


def scaled(x: Value = 1, y: Value | None = None, z: Value | None = None) -> Scale:
    """A placement step for `place`: a scaling by one factor, or by one for each axis."""
    return placement.scaled(x, y, z)


def mirrored(normal: Sequence[Value] = (1, 0, 0)) -> Reflect:
    """A placement step for `place`: a reflection in the plane through the origin with this normal."""
    return Reflect(tuple(normal))


def transformed(matrix: Iterable[Iterable[Value]]) -> Affine:
    """A placement step for `place`: a map by a (3, 4) matrix."""
    return placement.affine(matrix)


def document_of(*solids: Node | Document, **named: Node) -> Document:
    """A document of these solids; a keyword is a solid's name. Parameters are those that their numbers declare."""
    if len(solids) == 1 and isinstance(solids[0], Document) and not named:
        return solids[0]
    roots: list[Node] = []
    taken: set[str] = set()
    for name, solid in [*((None, solid) for solid in solids), *named.items()]:
        if not isinstance(solid, Node):
            raise Refusal(f"a document holds solids, not {solid!r:.60}")
        wanted = unique_name(name or solid.label, taken)
        taken.add(wanted)
        roots.append(solid if solid.name == wanted else solid.with_(name=wanted))
    return Document(solids=numbered(roots), parameters=_declared(roots))


def document_from(table: Mapping[str, Any]) -> Document:
    """The document of a table, the plain values that project files hold; logs write large trees and documents so.

    >>> document_from({"nodes": {"n1": {"kind": "Box", "name": "lid"}}, "solids": ["n1"]}).solids
    (<Box “lid” n1>,)
    """
    from .document.table import from_table

    return from_table(table)


def _declared(roots: Iterable[Node]) -> tuple[Parameter, ...]:
    expressions = [expression for node in walk(*roots) for expression in node.expressions()]
    found = declared(expressions)
    used = names_of([*expressions, *(parameter.value for parameter in found.values())])
    missing = sorted(used - found.keys())
    if missing:
        raise Refusal(f"there is no parameter called {missing[0]}; declare it with parameter({missing[0]!r}, …)")
    return tuple(found.values())


def evaluate(*solids: Node | Document, tolerance: float = 0.05):
    """Solids or a document as evaluated results; see solidtree.model.solid.results.Evaluation."""
    from .solid.results import evaluate_document

    return evaluate_document(document_of(*solids), tolerance)


def measure(solid: Node, tolerance: float = 0.05):
    """Volume, area, bounds, centroid, triangles, components, genus, inertia about the centroid (density 1), principal
    moments and axes of a solid. Raises Refusal where it has none.

    >>> measure(box(10)).area
    600.0
    """
    result = evaluate(solid, tolerance=tolerance).solids[0]
    measures = result.measures()
    if measures is None:
        raise Refusal(next(message.message for message in result.messages if message.error))
    return measures


def thinnest_wall(solid: Node, rays: int = 2000, tolerance: float = 0.05):
    """An estimate of a solid's least wall, as `length`, `point` and `exit`: the shortest of `rays` rays inwards from
    points spread over the surface. Thinner spots that no ray begins at are missed. Raises Refusal where none is.

    >>> round(thinnest_wall(box(20, 20, 3)).length, 9)
    3.0
    """
    from .measuring.thickness import thinnest

    result = evaluate(solid, tolerance=tolerance).solids[0]
    if result.solid is None:
        raise Refusal(next(message.message for message in result.messages if message.error))
    found = thinnest(result.solid, rays)
    if found is None:
        raise Refusal(f"“{solid.label}” has no wall: it is empty, or all of its faces meet at sharp angles")
    return found


def align(
    *solids: Node | Iterable[Node],
    axis: str = "x",
    side: str = "min",
    to: float | None = None,
    tolerance: float = 0.05,
) -> tuple[Node, ...]:
    """Solids moved along an axis until their sides ("min", "middle" or "max") lie in one plane: that of the first one,
    or the one at the coordinate `to`.

    >>> low, high = align(box(10), box(4).at(0, 0, 50), axis="z", side="max")
    >>> measure(high).bounds[1]
    (4.0, 4.0, 10.0)
    """
    from .measuring.arrange import aligned

    return _moved(solids, tolerance, lambda bounds: aligned(bounds, axis, side, to))


def distribute(
    *solids: Node | Iterable[Node], axis: str = "x", by: str = "gaps", tolerance: float = 0.05
) -> tuple[Node, ...]:
    """Three solids or more, moved along an axis so that the gaps between them are equal, or the steps from middle to
    middle with `by="centres"`. The outermost two stay.

    >>> first, second, third = distribute(box(10), box(10).at(11), box(10).at(40))
    >>> measure(second).bounds[0]
    (20.0, 0.0, 0.0)
    """
    from .measuring.arrange import spread

    return _moved(solids, tolerance, lambda bounds: spread(bounds, axis, by))


def dropped(solid: Node, height: float = 0, tolerance: float = 0.05) -> Node:
    """A solid moved up or down until its lowest point is at z = `height`.

    >>> measure(dropped(box(10).at(0, 0, 7))).bounds[0]
    (0.0, 0.0, 0.0)
    """
    from .measuring.arrange import grounded

    return _moved([solid], tolerance, lambda bounds: grounded(bounds, height))[0]


def _moved(
    solids: Iterable[Node | Iterable[Node]], tolerance: float, moves: Callable[[list[Any]], Any]
) -> tuple[Node, ...]:
    """Solids after the moves (n, 3) that a function gives for their bounds. Raises Refusal where one has none."""
    nodes = _solids(solids)
    bounds = [measure(node, tolerance).bounds for node in nodes]
    for node, box_ in zip(nodes, bounds, strict=True):
        if box_ is None:
            raise Refusal(f"“{node.label}” is empty: it has no place")
    return tuple(node.at(*map(float, by)) for node, by in zip(nodes, moves(bounds), strict=True))


def section(
    solid: Node, point: Sequence[float] = (0, 0, 0), normal: Sequence[float] = (0, 0, 1), tolerance: float = 0.05
):
    """The outline in which the plane through `point` cuts a solid, seen against `normal`, which points to the viewer.

    It has `area`, `perimeter`, `centroid`, `bounds` and `contours`, outer ones counter-clockwise and holes clockwise,
    in the plane's own coordinates: x and y of the world in a plane across z, seen from above. `save("cut.svg")` or
    `save("cut.dxf")` writes it in millimetres. Raises Refusal.

    >>> section(box(10) - box(4).at(3, 3, 3), (0, 0, 5)).area
    84.0
    """
    from .section.solid_sections import document_sections

    (found,), _ = document_sections(document_of(solid), point, normal, tolerance)
    return found.outline


def open_document(path: str | os.PathLike[str]) -> Document:
    """The document in a project file, or made of any file that can be imported."""
    from .exchange.meshes_in import read_any

    return read_any(Path(path))


def with_parameters(document: Document, from_set: str = "", /, **values: Value | str) -> Document:
    """A document with other values of its parameters: those of a saved set, if one is named, and then these.

    >>> plate = document_of(plate=box(parameter("width", 10, maximum=50), 5, 1))
    >>> with_parameters(plate, width=20).parameter("width").value
    20.0
    """
    from .operations.parameter_sets import apply_set, set_parameters

    return set_parameters(apply_set(document, from_set) if from_set else document, list(values.items()))


def with_sets(document: Document, path: str | os.PathLike[str]) -> Document:
    """A document with the sets of parameter values in a file: OpenSCAD's customizer JSON, or CSV.

    What the document has no parameter for is left out.
    """
    from .exchange.set_files import read_sets
    from .operations.parameter_sets import fitting_sets, put_sets

    return put_sets(document, [(one.name, one.values) for one in fitting_sets(document, read_sets(path))[0]])


def save_sets(path: str | os.PathLike[str], document: Document) -> None:
    """Write a document's sets of parameter values to a file: OpenSCAD's customizer JSON, or CSV."""
    from .exchange.set_files import write_sets

    write_sets(path, document.sets)


def save(path: str | os.PathLike[str], *solids: Node | Document, tolerance: float = 0.05, **named: Node) -> Document:
    """Write a project (.solidtree) or a mesh file (.stl .3mf .obj .ply .off .glb); a keyword is a solid's name.

    The result is the document written.
    """
    document = document_of(*solids, **named)
    target = Path(path)
    if target.suffix.lower() == ".solidtree":
        from .project.project_file import save_project

        save_project(document, target)
    else:
        from .exchange.export import export_document

        export_document(document, target, tolerance)
    return document


__all__ = [
    "Document", "Refusal", "align", "at", "box", "circle", "cone", "cylinder", "difference", "distribute",
    "document_from", "document_of", "dropped", "evaluate", "extrude", "halfspace", "hull", "imported_mesh", "instance",
    "intersection", "linear_array", "measure", "mesh", "minkowski", "mirror", "mirrored", "open_document", "parameter",
    "polar_array", "polygon", "polyhedron", "rectangle", "revolve", "save", "save_sets", "scaled", "section", "sphere",
    "thinnest_wall", "torus", "transformed", "turned", "union", "with_parameters", "with_sets",
]  # fmt: skip
