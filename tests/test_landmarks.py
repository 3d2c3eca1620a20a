"""Faces and landmarks of meshes, by formula."""

import gc
import weakref

import numpy as np
import pytest
from render_meshes import box as plain_box

from solidtree.model.measuring.features import features
from solidtree.model.measuring.landmarks import curved, face_at, landmarks
from solidtree.model.script import box, cylinder, document_of, hull, polygon, sphere, union
from solidtree.model.script import extrude as extruded
from solidtree.model.solid.results import evaluate_document


def mesh_of(solid, tolerance=0.05):
    evaluation = evaluate_document(document_of(solid), tolerance)
    mesh = evaluation.display(evaluation.solids[0])
    assert mesh is not None
    return mesh


def looking(mesh, direction):
    """The first triangle whose normal is the direction."""
    a, b, c = (mesh.points[mesh.triangles[:, i]].astype(float) for i in range(3))
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    return int(np.flatnonzero(normal @ direction > 0.999)[0])


def rows(points, digits=4):
    return {tuple(row) for row in (np.round(points, digits) + 0.0).tolist()}


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("sign", [-1, 1])
def test_the_face_of_a_box(axis, sign):
    size = np.array([10.0, 20.0, 30.0])
    mesh = mesh_of(box(*size))
    normal = sign * np.eye(3)[axis]
    face = face_at(mesh, looking(mesh, normal))
    others = np.delete(size, axis)
    assert face.area == pytest.approx(others.prod())
    assert np.allclose(face.normal, normal)
    assert np.allclose(face.centre, np.where(np.arange(3) == axis, size * (sign > 0), size / 2))
    assert len(face.triangles) == 2 and len(face.rim) == 4
    # Along the rim the face lies on the left, seen from outside.
    along = face.rim[:, 1] - face.rim[:, 0]
    inward = face.centre - face.rim.mean(axis=1)
    assert (np.cross(along, inward) @ face.normal > 0).all()
    assert np.linalg.norm(along, axis=1).sum() == pytest.approx(2 * others.sum())


def test_the_centre_is_that_of_the_area():
    """An L of three squares: the mean of its corners, or of its triangles, would be another point."""
    mesh = mesh_of(extruded(polygon([(0, 0), (20, 0), (20, 10), (10, 10), (10, 20), (0, 20)]), 4))
    face = face_at(mesh, looking(mesh, (0, 0, 1)))
    assert np.allclose(face.centre, (25 / 3, 25 / 3, 4)) and face.area == pytest.approx(300)


def test_a_hole_shifts_the_centre():
    mesh = mesh_of(box(40, 20, 5) - box(10, 10, 20).at(25, 5, -5))
    face = face_at(mesh, looking(mesh, (0, 0, 1)))
    assert face.area == pytest.approx(700)
    assert np.allclose(face.centre, ((800 * 20 - 100 * 30) / 700, 10, 5))
    assert len(landmarks(mesh, int(face.triangles[0])).vertices) == 8


def test_a_face_cut_in_two_is_two_faces():
    mesh = mesh_of(box(40, 20, 5) - box(10, 40, 5).at(10, -5, 2))
    top = [t for t in range(len(mesh.triangles)) if np.allclose(mesh.points[mesh.triangles[t]][:, 2], 5)]
    assert len({int(mesh.facet[t]) for t in top}) == 1
    areas = {round(face_at(mesh, t).area) for t in top}
    assert areas == {200, 400}
    for t in top:
        face = face_at(mesh, t)
        assert t in face.triangles and face.centre[0] == pytest.approx(5 if face.area < 300 else 30)


def test_landmarks_of_a_box_face():
    mesh = mesh_of(box(10, 20, 30))
    found = landmarks(mesh, looking(mesh, (0, 0, 1)))
    assert rows(found.vertices) == {(0, 0, 30), (10, 0, 30), (0, 20, 30), (10, 20, 30)}
    assert rows(found.midpoints) == {(5, 0, 30), (5, 20, 30), (0, 10, 30), (10, 10, 30)}
    assert found.edges.shape == (4, 2, 3) and np.allclose(found.edges.mean(axis=1), found.midpoints)
    assert np.allclose(found.centre, (5, 10, 30)) and np.allclose(found.normal, (0, 0, 1))
    assert len(found.centres) == 0


def test_pieces_in_line_are_one_edge():
    """Two boxes side by side: their front edges are one edge of 30 mm to the eye, and there is no corner between."""
    mesh = mesh_of(union(box(10, 10, 10), box(20, 10, 10).at(10)))
    lines = features(mesh)
    assert rows(lines.points[lines.corners]) == {(x, y, z) for x in (0, 30) for y in (0, 10) for z in (0, 10)}
    assert (15.0, 0.0, 10.0) in rows(lines.midpoints) and len(lines.straight) == 12


def test_a_cylinder_has_rims_with_centres_and_no_corners():
    mesh = mesh_of(cylinder(5, 20).at(1, 2, 3))
    lines = features(mesh)
    assert len(lines.corners) == 0 and len(lines.straight) == 0
    assert np.allclose(lines.circles.radii, 5)
    upright = np.ptp(mesh.points[mesh.triangles][:, :, 2], axis=1) > 0
    wall, cap = int(np.flatnonzero(upright)[0]), looking(mesh, (0, 0, 1))
    assert curved(mesh, wall) and not curved(mesh, cap)
    on_wall = landmarks(mesh, wall)
    assert rows(on_wall.centres) == {(1, 2, 3), (1, 2, 23)} and on_wall.centre is None and on_wall.normal is None
    assert len(on_wall.midpoints) == 0 and len(on_wall.vertices) == 0
    on_cap = landmarks(mesh, cap)
    assert rows(on_cap.centres) == {(1, 2, 23)} and np.allclose(on_cap.centre, (1, 2, 23), atol=1e-5)


def test_a_half_cut_rim_is_an_arc_with_its_centre():
    mesh = mesh_of(cylinder(8, 5) - box(40, 40, 40, centred=True).at(-20))
    top = landmarks(mesh, looking(mesh, (0, 0, 1)))
    assert rows(top.centres, 3) == {(0, 0, 5)} and rows(top.midpoints, 3) == {(0, 0, 5)}
    assert rows(top.vertices, 3) == {(0, 8, 5), (0, -8, 5)}


def test_a_slot_has_two_straight_sides_and_two_round_ends():
    cut = hull(cylinder(3, 20, segments=64), cylinder(3, 20, segments=64).at(20)).at(10, 10, -1)
    mesh = mesh_of(box(40, 20, 5) - cut)
    top = landmarks(mesh, looking(mesh, (0, 0, 1)))
    assert rows(top.centres, 3) == {(10, 10, 5), (30, 10, 5)}
    assert {(20, 7, 5), (20, 13, 5)} <= rows(top.midpoints, 3) and len(top.midpoints) == 6
    assert {(10, 7, 5), (30, 7, 5), (10, 13, 5), (30, 13, 5)} <= rows(top.vertices, 3)


def test_an_ellipse_has_no_centre_of_a_circle():
    mesh = mesh_of(cylinder(5, 20).scaled(1, 1.5, 1))
    assert len(features(mesh).circles.centres) == 0


def test_a_ball_has_no_landmarks_and_a_cut_one_its_rim():
    ball = mesh_of(sphere(10))
    whole = landmarks(ball, 0)
    assert curved(ball, 0) and whole.centre is None
    assert len(whole.vertices) == len(whole.midpoints) == len(whole.centres) == 0
    cut = mesh_of(sphere(10) - box(40, 40, 40, centred=True).at(0, 0, 26))
    rim = landmarks(cut, looking(cut, (0, 0, 1)))
    assert len(rim.centres) == 1 and np.allclose(rim.centres, (0, 0, 6), atol=0.01)


def test_the_flat_side_of_a_rounded_block_is_flat():
    block = hull(*(cylinder(3, 10, segments=48).at(x, y) for x in (0, 30) for y in (0, 20)))
    mesh = mesh_of(block)
    side = looking(mesh, (0, -1, 0))
    assert not curved(mesh, side)
    assert np.allclose(landmarks(mesh, side).centre, (15, -3, 5), atol=1e-4)


def test_all_is_kept_as_long_as_the_mesh():
    mesh = plain_box()
    assert features(mesh) is features(mesh) and landmarks(mesh, 3) is landmarks(mesh, 2)
    assert face_at(mesh, 3) is face_at(mesh, 2)
    gone = weakref.ref(mesh)
    del mesh
    gc.collect()
    assert gone() is None
