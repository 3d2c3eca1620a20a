"""Distances of surfaces, nearest points and windings: by formula, by brute force, compiled and in NumPy alike."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from manifold3d import Manifold
from scipy.spatial.transform import Rotation

from solidtree.model.measuring.distance import distance, nearest_on_triangles
from solidtree.model.partition import native as partition_native
from solidtree.model.proximity import boxes, native
from solidtree.model.proximity.boxes import BoxTree


@pytest.fixture(params=["compiled", "numpy"], autouse=True)
def way(request, monkeypatch):
    """Both ways, where there are two."""
    if request.param == "compiled" and not partition_native.available():
        pytest.skip("the compiled extension is not here")
    if request.param == "numpy":
        monkeypatch.setattr(boxes.native, "available", lambda: False)
    return request.param


def triangles_of(solid: Manifold) -> np.ndarray:
    mesh = solid.to_mesh64()
    return np.asarray(mesh.vert_properties)[:, :3][np.asarray(mesh.tri_verts).astype(int)]


def brute(one: np.ndarray, other: np.ndarray) -> float:
    """The least distance over the pairs of triangles, each by itself."""
    return min(distance(a[None], b[None]).length for a in one for b in other)


def test_spheres_are_apart_by_their_centres_less_their_radii():
    ball = triangles_of(Manifold.sphere(1, 64))
    other = ball + np.array((4, 0, 0))
    gap = BoxTree(ball).gap(BoxTree(other))
    assert gap.length == pytest.approx(2, abs=1e-12)  # both have a vertex on the x axis
    assert gap.a == pytest.approx((1, 0, 0)) and gap.b == pytest.approx((3, 0, 0))
    assert BoxTree(ball).gap(BoxTree(other), 1.9).faces == (-1, -1)
    assert BoxTree(ball).gap(BoxTree(ball + np.array((1, 0, 0)))).length == 0


def test_a_sphere_within_another_is_apart_from_it_by_its_wall():
    inner, outer = (triangles_of(Manifold.sphere(radius, 24)) for radius in (1, 3))
    found = BoxTree(inner).gap(BoxTree(outer)).length
    assert 2 - 3 * (1 - np.cos(np.pi / 12)) < found < 2  # chords lie a little within


@settings(deadline=None, max_examples=20)
@given(st.integers(0, 10**6))
def test_the_gap_is_that_of_the_nearest_pair_of_triangles(seed):
    rng = np.random.default_rng(seed)
    one = rng.normal(size=(rng.integers(1, 6), 3, 3)).round(int(rng.integers(0, 4)))
    other = rng.normal(size=(rng.integers(1, 4), 3, 3)).round(1) + rng.uniform(0, 3) * rng.normal(size=3)
    gap = BoxTree(one).gap(BoxTree(other))
    assert gap.length == pytest.approx(brute(one, other), abs=1e-12)
    assert np.linalg.norm(gap.a - gap.b) == pytest.approx(gap.length, abs=1e-12)
    for point, mesh, face in ((gap.a, one, gap.faces[0]), (gap.b, other, gap.faces[1])):
        foot = nearest_on_triangles(point[None], mesh[face][None])
        assert foot[0] == pytest.approx(point, abs=1e-12)


@settings(deadline=None, max_examples=20)
@given(st.integers(0, 10**6))
def test_nearest_points_are_those_of_all_triangles(seed):
    rng = np.random.default_rng(seed)
    mesh = rng.normal(size=(rng.integers(1, 40), 3, 3)).round(int(rng.integers(0, 4)))
    points = 2 * rng.normal(size=(50, 3))
    found = BoxTree(mesh).nearest(points)
    every = np.array([np.linalg.norm(nearest_on_triangles(points, np.broadcast_to(t, (50, 3, 3))) - points, axis=1)
                      for t in mesh])  # fmt: skip
    assert found.distances == pytest.approx(every.min(axis=0), abs=1e-12)
    assert np.linalg.norm(found.places - points, axis=1) == pytest.approx(found.distances, abs=1e-12)
    on = nearest_on_triangles(found.places, mesh[found.faces])
    assert on == pytest.approx(found.places, abs=1e-12)
    near = BoxTree(mesh).nearest(points, 0.5)
    assert ((near.faces >= 0) == (every.min(axis=0) < 0.5)).all() and np.isinf(near.distances[near.faces < 0]).all()


def test_windings_on_the_lattice_of_a_box_with_a_cavity():
    """Every point lies straight below sides and corners of triangles."""
    solid = Manifold.cube((8, 8, 8)) - Manifold.cube((4, 4, 4)).translate((2, 2, 2))
    axis = np.arange(-1.5, 10, 0.5)
    points = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)
    on = np.isin(points, (0, 2, 6, 8)).any(axis=1)  # on planes of faces; the rest is off the surface
    box = ((points > 0) & (points < 8)).all(axis=1)
    hollow = ((points > 2) & (points < 6)).all(axis=1)
    found = BoxTree(triangles_of(solid)).windings(points)
    assert (found[~on] == (box & ~hollow)[~on]).all()
    inside = on & ((points > 0) & (points < 8)).all(axis=1) & ~((points >= 2) & (points <= 6)).all(axis=1)
    assert (found[inside] == 1).all()


def test_windings_tell_how_often_surfaces_lie_round_a_point():
    ball = triangles_of(Manifold.sphere(3, 32))
    twice = BoxTree(np.concatenate((ball, ball / 2)))
    assert twice.windings([(0, 0, 0), (2, 0, 0), (4, 0, 0)]).tolist() == [2, 1, 0]
    turned = BoxTree(ball[:, ::-1])
    assert turned.windings([(0, 0, 0), (0, 0, -4), (0, 0, 4)]).tolist() == [-1, 0, 0]


def test_nothing_and_no_points_have_answers():
    none, ball = BoxTree(np.zeros((0, 3, 3))), BoxTree(triangles_of(Manifold.sphere(1, 8)))
    assert none.gap(ball).faces == ball.gap(none).faces == none.gap(none).faces == (-1, -1)
    assert none.windings([(0, 0, 0)]).tolist() == [0]
    assert np.isinf(none.nearest([(0, 0, 0)]).distances).all()
    assert len(ball.windings(np.zeros((0, 3)))) == len(ball.nearest(np.zeros((0, 3))).distances) == 0


@settings(deadline=None, max_examples=20)
@given(st.integers(0, 10**6))
def test_a_pose_moves_the_other_surface(seed):
    rng = np.random.default_rng(seed)
    one, other = rng.normal(size=(30, 3, 3)), rng.normal(size=(20, 3, 3)).round(1)
    pose = np.eye(4)
    pose[:3, :3] = Rotation.random(random_state=seed).as_matrix()
    pose[:3, 3] = 5 * rng.normal(size=3)
    there = BoxTree(other @ pose[:3, :3].T + pose[:3, 3])
    moved, placed = BoxTree(one).gap(BoxTree(other), pose=pose), BoxTree(one).gap(there)
    assert moved.length == pytest.approx(placed.length, abs=1e-11)
    for point, mesh, face in ((moved.a, one, moved.faces[0]), (moved.b, there.triangles, moved.faces[1])):
        assert nearest_on_triangles(point[None], mesh[face][None])[0] == pytest.approx(point, abs=1e-11)


def test_a_search_that_begins_with_the_nearest_faces_or_with_others_ends_alike():
    ball = triangles_of(Manifold.sphere(1, 32))
    one, other = BoxTree(ball), BoxTree(ball + np.array((3, 0.4, 0.2)))
    found = one.gap(other)
    for first in (found.faces, (0, 0), (10**6, 0), (0, -1)):
        again = one.gap(other, first=first)
        assert (again.length, again.faces) == (found.length, found.faces)
    assert one.gap(other, found.length / 2, first=found.faces).faces == (-1, -1)


def test_below_a_limit_surfaces_without_trees_are_as_far_apart(way):
    if way == "numpy":
        pytest.skip("this is compiled only")
    rng = np.random.default_rng(3)
    kinds = (Manifold.sphere(5, 24), Manifold.cylinder(9, 4, 4, 24, True), Manifold.cube((7, 7, 7), True))
    meshes = [
        triangles_of(kinds[k % 3].rotate(rng.uniform(0, 360, 3).tolist())) + 20 * rng.random(3) for k in range(24)
    ]
    surfaces = [native.Surface(mesh.reshape(-1, 3), np.arange(3 * len(mesh)).reshape(-1, 3)) for mesh in meshes]
    boxes_of = np.array([(mesh.min(axis=(0, 1)), mesh.max(axis=(0, 1))) for mesh in meshes])
    pairs = np.array([(i, j) for i in range(24) for j in range(i)])
    limits = rng.uniform(0, 6, len(pairs))
    lengths, ends, faces = native.near(surfaces, boxes_of, pairs, limits)
    assert np.isfinite(lengths).sum() > 50
    for (one, other), limit, length, points, (left, right) in zip(pairs, limits, lengths, ends, faces, strict=True):
        gap = BoxTree(meshes[one]).gap(BoxTree(meshes[other]), limit)
        assert (length, left >= 0) == (pytest.approx(gap.length, abs=1e-12), gap.faces[0] >= 0)
        if left >= 0:
            assert np.linalg.norm(points[0] - points[1]) == pytest.approx(length, abs=1e-12)
            on = nearest_on_triangles(points, np.array([meshes[one][left], meshes[other][right]]))
            assert on == pytest.approx(points, abs=1e-12)


def test_a_hundred_thousand_points_in_solids_with_formulas(way):
    """A ball's chords lie a little within it, those of a tube between two radii: points near the walls are left out."""
    count = 100_000 if way == "compiled" else 20_000
    points = np.random.default_rng(5).uniform(-6, 6, (count, 3))
    sag = 1 - np.cos(np.pi / 64)
    far = np.linalg.norm(points, axis=1)
    ball = BoxTree(triangles_of(Manifold.sphere(5, 64))).windings(points) > 0
    clear = (far < 5 * (1 - 3 * sag)) | (far > 5)
    assert (ball == (far < 5))[clear].all() and clear.mean() > 0.99
    tube = BoxTree(triangles_of(Manifold.cylinder(8, 4, 4, 64, True) - Manifold.cylinder(9, 2, 2, 64, True)))
    across = np.hypot(*points.T[:2])
    held = (across < 4) & (across > 2) & (np.abs(points[:, 2]) < 4)
    clear = ~(((across > 4 * (1 - sag)) & (across < 4)) | ((across > 2 * (1 - sag)) & (across < 2)))
    assert ((tube.windings(points) > 0) == held)[clear].all() and clear.mean() > 0.99


def test_a_surface_whose_corners_are_no_vertices_is_refused(way):
    if way == "compiled":
        for corners, points in (([[0, 1, 3]], np.zeros((3, 3))), ([[0, 1, 2]], np.full((3, 3), np.inf))):
            with pytest.raises(ValueError, match="vertex"):
                native.Surface(points, np.array(corners))


def test_corners_that_are_no_numbers_are_refused(way):
    if way == "compiled":
        with pytest.raises(ValueError, match="not a finite number"):
            native.Tree(np.full((1, 3, 3), np.nan))
