"""What pictures are made of: normals, facets, feature edges."""

import numpy as np
import pytest

from solidtree.model.document.tree import numbered
from solidtree.model.script import box, cone, cylinder, sphere, union
from solidtree.model.solid.evaluate import Evaluator
from solidtree.model.solid.results import display_of, result_of


def picture_of(node):
    (root,) = numbered([node])
    evaluator = Evaluator()
    return display_of(result_of(root, evaluator.evaluate(root)), evaluator)


def lengths(mesh):
    ends = mesh.edge_points[mesh.edges].astype(float)
    return np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)


def test_a_box_has_six_facets_twelve_edges_and_flat_normals():
    mesh = picture_of(box(2, 3, 4))
    assert len(np.unique(mesh.facet)) == 6 and len(mesh.edges) == 12
    assert sorted(lengths(mesh)) == pytest.approx([2] * 4 + [3] * 4 + [4] * 4)
    assert len(mesh.points) == 24
    corners = mesh.points[mesh.triangles]
    flat = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    flat /= np.linalg.norm(flat, axis=1, keepdims=True)
    assert np.allclose(mesh.normals[mesh.triangles], flat[:, None], atol=1e-6)
    assert mesh.bounds.tolist() == [[0, 0, 0], [2, 3, 4]]


def test_the_triangles_beside_an_edge_hold_its_ends_and_lie_in_two_facets():
    mesh = picture_of(box(20) - sphere(8).at(10, 10, 20) - cylinder(2, 30).at(4, 4, -5))
    ends = mesh.edge_points[mesh.edges]
    for side in mesh.edge_sides.T:
        corners = mesh.points[mesh.triangles[side]]
        assert (ends[:, :, None] == corners[:, None]).all(axis=3).any(axis=2).all()
    assert (mesh.facet[mesh.edge_sides[:, 0]] != mesh.facet[mesh.edge_sides[:, 1]]).all()


def test_a_sphere_is_smooth_and_has_no_edges():
    mesh = picture_of(sphere(10))
    assert len(mesh.edges) == 0
    outward = mesh.points / np.linalg.norm(mesh.points, axis=1, keepdims=True)
    assert (np.einsum("ij,ij->i", outward, mesh.normals) > np.cos(np.radians(3))).all()


def test_a_cylinder_is_smooth_around_and_sharp_at_its_rims():
    mesh = picture_of(cylinder(5, 20, segments=48))
    assert len(mesh.edges) == 2 * 48
    assert np.allclose(np.hypot(*mesh.edge_points[:, :2].T), 5, atol=1e-5)
    upright = np.abs(mesh.normals[:, 2]) > 0.5
    sideways = mesh.normals[~upright]
    radial = mesh.points[~upright][:, :2] / 5
    assert np.abs(sideways[:, 2]).max() < 1e-6
    assert np.einsum("ij,ij->i", radial, sideways[:, :2]).min() > np.cos(np.radians(0.1))


def test_a_ridge_between_two_solids_is_an_edge_and_a_flush_joint_is_none():
    cross = picture_of(union(cylinder(3, 20, centred=True), cylinder(3, 20, centred=True).turned(x=90)))
    on_both = np.abs(np.hypot(*cross.edge_points[:, :2].T) - np.hypot(*cross.edge_points[:, [0, 2]].T)) < 0.1
    # They meet in two ellipses with the half-axes 3 and 3 sqrt(2), each 22.9 long; where they touch it fades out.
    assert lengths(cross)[on_both[cross.edges].all(axis=1)].sum() == pytest.approx(2 * 22.9, rel=0.1)
    flush = picture_of(union(box(4), box(4).at(4)))
    assert len(flush.edges) == 12 + 4  # each long edge in two parts, where the vertices are, and no ring between
    assert lengths(flush).sum() == pytest.approx(4 * 8 + 8 * 4)


def test_a_cone_keeps_its_tip():
    mesh = picture_of(cone(5, 0, 10, segments=32))
    assert len(mesh.edges) == 32
    assert np.isfinite(mesh.normals).all() and np.allclose(np.linalg.norm(mesh.normals, axis=1), 1, atol=1e-5)


def test_triangles_look_outward_and_keep_their_area():
    mesh = picture_of((box(20) - sphere(8).at(10, 10, 20)).turned(30, 40, 50))
    a, b, c = (mesh.points[mesh.triangles[:, i]].astype(float) for i in range(3))
    normals = np.cross(b - a, c - a)
    volume = np.einsum("ij,ij->i", a, normals).sum() / 6
    assert volume == pytest.approx(8000 - 2 / 3 * np.pi * 512, rel=0.01)
    assert (np.einsum("tx,tx->t", normals, mesh.normals[mesh.triangles].mean(axis=1)) > 0).all()
