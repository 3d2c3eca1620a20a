"""What scripts do with shapes: documents, measures, sections, arrangement, files."""

# Nodes take numbers as text too, and keep them as expressions; their types tell what they keep.
# pyright: reportArgumentType=false

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from ..document.document import Document, Parameter
from ..document.errors import Refusal
from ..document.nodes import Node
from ..document.tree import Names, numbered, put, walk
from ..operations.parameters import declared, names_of
from ..operations.surfaces import with_materials_of
from ..surface.light import Light
from .joining import solids_of
from .shapes import Value


def document_of(*solids: Node | Document | Light, **named: Node | Light) -> Document:
    """A document of these solids and outlines, with the materials that they wear, and of lights; a keyword is a name.
    Parameters are those that their numbers declare."""
    if len(solids) == 1 and isinstance(solids[0], Document) and not named:
        return solids[0]
    roots: list[Node] = []
    lights: list[Light] = []
    names = Names()
    for name, solid in [*((None, solid) for solid in solids), *named.items()]:
        if isinstance(solid, Light):
            lights.append(solid if name is None else solid.with_(name=name))
            continue
        if not isinstance(solid, Node):
            raise Refusal(f"a document holds solids, not {solid!r:.60}")
        wanted = names.take(name or solid.label)
        roots.append(solid if solid.name == wanted else solid.with_(name=wanted))
    document = Document(parameters=_declared(roots), lights=tuple(lights))
    document, roots = with_materials_of(document, numbered(roots))
    return put(document, roots)


def document_from(table: Mapping[str, Any]) -> Document:
    """The document of a table, the plain values that project files hold; logs write large trees and documents so.

    >>> document_from({"nodes": {"n1": {"kind": "Box", "name": "lid"}}, "solids": ["n1"]}).solids
    (<Box “lid” n1>,)
    """
    from ..document.table import from_table

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
    from ..solid.results import evaluate_document

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
    from ..measuring.thickness import thinnest

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
    from ..measuring.arrange import aligned

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
    from ..measuring.arrange import spread

    return _moved(solids, tolerance, lambda bounds: spread(bounds, axis, by))


def dropped(solid: Node, height: float = 0, tolerance: float = 0.05) -> Node:
    """A solid moved up or down until its lowest point is at z = `height`.

    >>> measure(dropped(box(10).at(0, 0, 7))).bounds[0]
    (0.0, 0.0, 0.0)
    """
    from ..measuring.arrange import grounded

    return _moved([solid], tolerance, lambda bounds: grounded(bounds, height))[0]


def _moved(
    solids: Iterable[Node | Iterable[Node]], tolerance: float, moves: Callable[[list[Any]], Any]
) -> tuple[Node, ...]:
    """Solids after the moves (n, 3) that a function gives for their bounds. Raises Refusal where one has none."""
    nodes = solids_of(solids)
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
    from ..section.solid_sections import document_sections

    (found,), _ = document_sections(document_of(solid), point, normal, tolerance)
    return found.outline


def open_document(path: str | os.PathLike[str]) -> Document:
    """The document in a project file, or made of any file that can be imported."""
    from ..exchange.meshes_in import read_any

    return read_any(Path(path))


def with_parameters(document: Document, from_set: str = "", /, **values: Value | str) -> Document:
    """A document with other values of its parameters: those of a saved set, if one is named, and then these.

    >>> plate = document_of(plate=box(parameter("width", 10, maximum=50), 5, 1))
    >>> with_parameters(plate, width=20).parameter("width").value
    20.0
    """
    from ..operations.parameter_sets import apply_set, set_parameters

    return set_parameters(apply_set(document, from_set) if from_set else document, list(values.items()))


def with_sets(document: Document, path: str | os.PathLike[str]) -> Document:
    """A document with the sets of parameter values in a file: OpenSCAD's customizer JSON, or CSV.

    What the document has no parameter for is left out.
    """
    from ..exchange.set_files import read_sets
    from ..operations.parameter_sets import fitting_sets, put_sets

    return put_sets(document, [(one.name, one.values) for one in fitting_sets(document, read_sets(path))[0]])


def save_sets(path: str | os.PathLike[str], document: Document) -> None:
    """Write a document's sets of parameter values to a file: OpenSCAD's customizer JSON, or CSV."""
    from ..exchange.set_files import write_sets

    write_sets(path, document.sets)


def save(
    path: str | os.PathLike[str], *solids: Node | Document | Light, tolerance: float = 0.05, **named: Node | Light
) -> Document:
    """Write a project (.solidtree), a mesh file (.stl .3mf .obj .ply .off .glb) or outlines (.svg .dxf).

    A keyword is a name. The result is the document written.
    """
    document = document_of(*solids, **named)
    target = Path(path)
    if target.suffix.lower() == ".solidtree":
        from ..project.project_file import save_project

        save_project(document, target)
    else:
        from ..exchange.export import export_document

        export_document(document, target, tolerance)
    return document


__all__ = [
    "align",
    "distribute",
    "document_from",
    "document_of",
    "dropped",
    "evaluate",
    "measure",
    "open_document",
    "save",
    "save_sets",
    "section",
    "thinnest_wall",
    "with_parameters",
    "with_sets",
]
