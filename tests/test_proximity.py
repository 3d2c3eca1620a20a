"""Distances of surfaces, nearest points and windings: by formula, by brute force, compiled and in NumPy alike."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from manifold3d import Manifold

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


def test_corners_that_are_no_numbers_are_refused(way):
    if way == "compiled":
        with pytest.raises(ValueError, match="not a finite number"):
            native.Tree(np.full((1, 3, 3), np.nan))
