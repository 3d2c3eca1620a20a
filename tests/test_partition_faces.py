"""What a tree is built from: planes of facets, groups of convex bodies, polygons made by hand."""

import json

import numpy as np
import pytest
from partition_scenes import disc, dumbbell, faces_of, mesh_of, part, plate

from solidtree.model.partition.faces import (
    faces_of_meshes,
    faces_of_polygons,
    facet_planes,
    joined,
    plane_of_ring,
)
from solidtree.model.partition.order import Sorter
from solidtree.model.partition.textbook import build_in_order
from solidtree.model.partition.tree import EPSILON
from solidtree.model.script import box, cone, cylinder, hull, polyhedron, sphere, torus, union


def heights(faces) -> np.ndarray:
    """How far each corner lies from the plane of its face."""
    planes = np.repeat(faces.planes[faces.plane_of], np.diff(faces.starts), axis=0)
    return np.einsum("ij,ij->i", planes[:, :3], faces.points[faces.corners]) - planes[:, 3]


@pytest.mark.parametrize("node", [part(), dumbbell(), plate(), torus(8, 2), box(1e-3, 5, 1e3).turned(20, 30, 40)])
def test_a_plane_a_facet_and_every_corner_in_it(node):
    mesh = mesh_of(node)
    faces = faces_of_meshes([mesh])
    assert len(faces.planes) == mesh.facet.max() + 1
    assert np.abs(heights(faces)).max() < EPSILON * faces.size
    assert np.allclose(np.linalg.norm(faces.planes[:, :3], axis=1), 1)
    corners = faces.points[faces.corners.reshape(-1, 3)]
    areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    wide = np.linalg.norm(areas, axis=1) > 1e-6
    assert (np.einsum("ij,ij->i", areas, faces.planes[faces.plane_of][:, :3])[wide] > 0).all()


def test_a_facet_that_is_bent_has_a_plane_a_triangle():
    vertices = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0.1], [0, 1, 0], [2, 0, 0], [2, 1, 0]])
    corners = np.array([[0, 1, 2], [0, 2, 3], [1, 4, 5]], np.int32)
    planes, plane_of = facet_planes(vertices, corners, np.array([0, 0, 1]))
    assert plane_of[0] != plane_of[1] and plane_of[2] == 1
    for triangle, plane in zip(corners, planes[plane_of], strict=True):
        assert np.allclose(vertices[triangle] @ plane[:3], plane[3], atol=1e-15)


def test_the_faces_of_convex_leaves_are_groups_and_those_of_others_are_not():
    ball, ring = sphere(5, segments=24), torus(8, 1.5, segments=24)
    faces = faces_of(union(ball, ring) - cylinder(1, 30, segments=24, centred=True))
    groups = {int(group): faces.side[faces.group == group] for group in np.unique(faces.group)}
    assert len(groups) == 3 and (groups[-1] == 0).all()
    assert sorted(int(side[0]) for group, side in groups.items() if group >= 0) == [-1, 1]
    corners = faces.points[faces.corners.reshape(-1, 3)]
    around = np.hypot(corners[..., 0], corners[..., 1])
    assert (around[faces.group < 0].min() > 6) and (around[faces.side < 0].max() < 1 + 1e-9)
    assert (np.linalg.norm(corners[faces.side > 0], axis=2) < 5 + 1e-9).all()


@pytest.mark.parametrize(
    "node",
    [
        box(3),
        cone(4, 1, 5),
        hull(sphere(2, segments=12), box(1).at(5)),
        cylinder(2, 3).scaled(1, 3, 1).mirrored((1, 0, 0)),
    ],
)
def test_a_convex_solid_is_one_group(node):
    faces = faces_of(node)
    assert (faces.group == 0).all() and (faces.side == 1).all()
    behind = faces.points @ faces.planes[:, :3].T - faces.planes[:, 3]
    assert behind.max() < EPSILON * faces.size


def test_a_mesh_is_looked_at():
    corners = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]])
    sides = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
    assert (faces_of(polyhedron(corners.tolist(), sides)).group == 0).all()
    dented = mesh_of(union(box(4), box(4).at(2, 2, 2)))
    copied = polyhedron(dented.vertices.tolist(), dented.corners.tolist())
    assert (faces_of(copied).group == -1).all()


def test_meshes_and_parts_one_after_the_other():
    meshes = [mesh_of(box(2)), mesh_of(sphere(1, segments=12)), mesh_of(box(1).at(5))]
    faces = faces_of_meshes(meshes)
    triangles = np.concatenate([mesh.vertices[mesh.corners] for mesh in meshes])
    assert np.array_equal(faces.points[faces.corners.reshape(-1, 3)], triangles)
    assert np.abs(heights(faces)).max() < EPSILON * faces.size
    assert faces.group.tolist() == [number for number, mesh in enumerate(meshes) for _ in mesh.corners]
    again = joined([faces_of_meshes([mesh]) for mesh in meshes])
    assert np.array_equal(again.planes[again.plane_of], faces.planes[faces.plane_of])
    assert faces_of_meshes([]).count == 0 and faces_of_meshes([]).size == 0.0


def test_polygons_are_checked():
    assert faces_of_polygons([disc(7), disc(3)]).starts.tolist() == [0, 7, 10]
    with pytest.raises(ValueError, match="polygon 1 has 2 corners"):
        faces_of_polygons([disc(3), disc(2)])
    arrow = [[0, 0, 0], [4, 0, 0], [1, 1, 0], [0, 4, 0]]
    with pytest.raises(ValueError, match="polygon 0 is not convex"):
        faces_of_polygons([arrow])


def test_planes_of_polygons_look_where_they_turn_counter_clockwise():
    assert plane_of_ring(disc(5, height=2)) == pytest.approx([0, 0, 1, 2])
    assert plane_of_ring(disc(5, height=2)[::-1]) == pytest.approx([0, 0, -1, -2])
    for ring in (np.zeros((3, 3)), np.ones((4, 3)), np.outer(np.arange(3.0), [1, 2, 3])):
        plane = plane_of_ring(ring)
        assert np.linalg.norm(plane[:3]) == pytest.approx(1) and ring @ plane[:3] == pytest.approx(plane[3])


def test_the_textbooks_builder_gives_the_published_orders(corpus):
    cases = json.loads((corpus / "hsr" / "bsp_reference.json").read_text())["cases"]
    told = [case for case in cases if "draw_order" in case]
    assert len(told) >= 5
    for case in told:
        faces = faces_of_polygons(case["polygons"])
        orders = [case.get("insert_order")]
        if case["name"] == "Coplanar":
            orders = [[0, 1, 2], [2, 0, 1]]
        for order in orders:
            tree = build_in_order(faces, order)
            drawn = Sorter(tree).fragments([0, 0, 1], parallel=True)
            assert tree.source[drawn].tolist() == case["draw_order"], case["name"]
        for piece, fragment in zip(case.get("pieces", ()), drawn, strict=False):
            if piece is not None:
                ring = tree.points[tree.corners[tree.starts[fragment] : tree.starts[fragment + 1]]]
                assert {tuple(corner) for corner in np.round(ring, 9)} == {tuple(corner) for corner in piece}
