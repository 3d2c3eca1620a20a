"""The surface under a face, by formula: radii and axes as they were typed."""

import math

import numpy as np
import pytest

from solidtree.model.document.nodes import Node
from solidtree.model.document.placement import Turn
from solidtree.model.measuring.surfaces import (
    ConeSurface,
    CylinderSurface,
    Facet,
    Plane,
    SphereSurface,
    Surface,
    TorusSurface,
    leaf_at,
    planar,
    surface_at,
)
from solidtree.model.script import (
    box,
    circle,
    cone,
    cylinder,
    document_of,
    extrude,
    halfspace,
    hull,
    linear_array,
    mesh,
    mirror,
    polar_array,
    polygon,
    rectangle,
    revolve,
    save,
    sphere,
    torus,
    union,
)
from solidtree.model.solid.display import DisplayMesh
from solidtree.model.solid.provenance import occurrences
from solidtree.model.solid.results import evaluate_document


def shown(solid: Node) -> tuple[Node, DisplayMesh]:
    evaluation = evaluate_document(document_of(part=solid))
    display = evaluation.display(evaluation.solids[0])
    assert display is not None
    return evaluation.solids[0].root, display


def surfaces(solid: Node, step: int = 1) -> list[Surface]:
    """Of every triangle, or of some."""
    root, display = shown(solid)
    return [surface_at(root, display, triangle) for triangle in range(0, len(display.triangles), step)]


def kinds(solid: Node) -> set[type]:
    return {type(surface) for surface in surfaces(solid)}


def curved(solid: Node, step: int = 1) -> list[Surface]:
    return [surface for surface in surfaces(solid, step) if not planar(surface)]


def test_the_hole_of_a_turned_plate_has_the_typed_radius_and_its_axis():
    part = (box(20, 20, 5) - cylinder(3.3, 30, centred=True).at(10, 7)).turned(y=90).at(1, 2, 3)
    found = curved(part)
    assert found and all(isinstance(surface, CylinderSurface) and surface.hollow for surface in found)
    assert {surface.radius for surface in found} == {3.3}
    for surface in found:
        assert np.abs(surface.axis) == pytest.approx((1, 0, 0), abs=1e-15)
        # The axis through (10, 7, *) is turned by 90 degrees about y: (x, y, z) becomes (z, y, -x).
        assert surface.point[1:] == pytest.approx((9, -7)) and surface.deviation is None


def test_planes_point_out_of_the_result():
    normals = {tuple(np.round(surface.normal).tolist()) for surface in surfaces(box(10) - box(4).at(3, 3, 8))}
    assert len(normals) == 6
    floor = [s for s in surfaces(box(10) - box(4).at(3, 3, 8)) if abs(s.point[2] - 8) < 1e-6]
    assert floor and all(isinstance(s, Plane) and s.normal == pytest.approx((0, 0, 1)) for s in floor)
    cut = surfaces(sphere(10) & halfspace((0, 0, 1), (0, 0, 4)))
    caps = [s for s in cut if isinstance(s, Plane)]
    assert caps and all(s.normal == pytest.approx((0, 0, -1)) and s.point[2] == pytest.approx(4) for s in caps)


@pytest.mark.parametrize(
    ("solid", "wanted"),
    [
        (sphere(7).at(1, 2, 3), SphereSurface((1, 2, 3), 7)),
        (sphere(7).scaled(2).at(1, 2, 3), SphereSurface((1, 2, 3), 14)),
        (cylinder(4, 10).scaled(2, 2, 5), CylinderSurface((0, 0, 0), (0, 0, 1), 8)),
        (torus(15, 4).at(0, 0, 5), TorusSurface((0, 0, 5), (0, 0, 1), 15, 4)),
        (cone(10, 4, 6), ConeSurface((0, 0, 10), (0, 0, -1), 45)),
        (cone(4, 10, 6, centred=True), ConeSurface((0, 0, -7), (0, 0, 1), 45)),
        (cone(10, 4, 6).scaled(1, 1, 2), ConeSurface((0, 0, 20), (0, 0, -1), math.degrees(math.atan(0.5)))),
        (cone(5, 5, 6), CylinderSurface((0, 0, 0), (0, 0, 1), 5)),
        (extrude(circle(3).at(5, 6), 9), CylinderSurface((5, 6, 0), (0, 0, 1), 3)),
        (extrude(circle(6), 3, top_scale=0.5), ConeSurface((0, 0, 6), (0, 0, -1), 45)),
        (
            extrude(circle(6).at(1, 2), 3, taper=45, below=1, centred=True) & halfspace((0, 0, 1), (0, 0, -0.9)),
            ConeSurface((1, 2, 5), (0, 0, -1), 45),
        ),
        (
            extrude(circle(6).at(1, 2), 3, bevel=1) & halfspace((0, 0, 1), (0, 0, 2.1)),
            ConeSurface((1, 2, 8), (0, 0, -1), 45),
        ),
        (revolve(circle(4).at(15, 5)), TorusSurface((0, 0, 5), (0, 0, 1), 15, 4)),
        (revolve(polygon([(0, 0), (6, 0), (0, 6)])), ConeSurface((0, 0, 6), (0, 0, -1), 45)),
        (revolve(rectangle(4, 5)), CylinderSurface((0, 0, 0), (0, 0, 1), 4)),
    ],
    ids=lambda value: value.kind if isinstance(value, Node) else "",
)
def test_each_kind_of_curved_leaf(solid, wanted):
    found = curved(solid)
    assert found and all(type(surface) is type(wanted) for surface in found)
    for surface in found:
        for name in wanted.__slots__:
            value, expected = getattr(surface, name), getattr(wanted, name)
            assert value is expected if expected is None else value == pytest.approx(expected, abs=1e-12), name


def test_what_is_scaled_unevenly_has_no_radius():
    assert kinds(sphere(5).scaled(1, 1, 2)) == {Facet}
    assert kinds(cylinder(5, 9).scaled(1, 2, 1)) == {Facet, Plane}
    assert kinds(cylinder(5, 9).turned(x=30).scaled(1, 1, 2)) == {Facet, Plane}
    assert kinds(extrude(rectangle(4, 4), 9, twist=50)) == {Facet, Plane}


def test_a_tube_tells_inside_from_outside():
    found = curved(revolve(rectangle(2, 9).at(5)))
    assert {(surface.radius, surface.hollow) for surface in found} == {(5, True), (7, False)}
    ring = curved(box(50, 50, 20, centred=True) - torus(15, 4))
    assert all(isinstance(surface, TorusSurface) and surface.hollow for surface in ring)


def test_a_cut_revolution_is_still_its_cylinder_and_its_ends_are_flat():
    tube = revolve(rectangle(2, 9).at(5), angle=200) - box(20, 20, 3, centred=True).turned(z=10).at(0, 0, 9)
    found = curved(tube)
    assert {surface.radius for surface in found} == {5, 7}
    assert any(isinstance(s, Plane) and abs(s.normal[2]) < 1e-6 for s in surfaces(tube))


def test_leaves_are_found_in_arrays_mirrors_and_nests():
    part = union(
        linear_array(box(9) - sphere(2).at(4, 4, 9), 3, (12, 0, 0)),
        mirror(polar_array(cylinder(2, 3).at(20), 4), normal=(0, 1, 0)),
    ).turned(10, 20, 30)
    root, _ = shown(part)
    for occurrence in occurrences(root):
        found = leaf_at(root, occurrence.path)
        assert found is not None and found[0] is occurrence.leaf
        assert np.allclose(found[1], occurrence.matrix, atol=1e-12)
    assert leaf_at(root, ("elsewhere",)) is None and leaf_at(root, (root.id, "nothing")) is None
    centres = {tuple(np.round(s.centre, 9)) for s in curved(part) if isinstance(s, SphereSurface)}
    assert len(centres) == 3


def test_an_imported_mesh_is_fitted_and_says_so(tmp_path):
    part = (box(30, 30, 8) - cylinder(4.5, 40, centred=True).at(12, 9)).turned(20, 30, 40) + sphere(6).at(60)
    save(tmp_path / "part.stl", part, tolerance=0.08)
    found = curved(mesh(tmp_path / "part.stl"), 7)
    assert {type(surface) for surface in found} == {CylinderSurface, SphereSurface}
    for surface in found:
        cylindrical = isinstance(surface, CylinderSurface)
        assert surface.radius == pytest.approx(4.5 if cylindrical else 6, rel=1e-5)
        assert surface.hollow is cylindrical
        assert surface.deviation is not None and surface.deviation < 1e-4
        if isinstance(surface, CylinderSurface):
            upright = Turn((20.0, 30.0, 40.0)).matrix()[:, 2]
            assert abs(np.dot(surface.axis, upright)) == pytest.approx(1, abs=1e-8)
    flat = [s for s in surfaces(mesh(tmp_path / "part.stl")) if planar(s)]
    assert flat and all(isinstance(surface, Plane) for surface in flat)


def test_the_wall_of_a_hull_is_fitted_and_its_ends_are_flat():
    found = surfaces(hull(cylinder(5, 9), cylinder(5, 9).at(z=20)))
    walls = [surface for surface in found if not planar(surface)]
    assert len(walls) < len(found) and all(isinstance(surface, CylinderSurface) for surface in walls)
    assert {round(surface.radius, 4) for surface in walls} == {5}


def test_what_neither_fits_is_a_plane():
    assert kinds(hull(cylinder(5, 9).scaled(1, 2, 1), cylinder(5, 9).scaled(1, 2, 1).at(z=1))) == {Plane}
