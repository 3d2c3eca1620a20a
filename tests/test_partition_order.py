"""The painter's order as such: directions, reversal, fans, and what no node owns."""

import dataclasses

import numpy as np
import pytest
from painter_check import eyes_around
from partition_scenes import SCENES, crossing, disc, faces_of

from solidtree.model.partition import native
from solidtree.model.partition.build import build
from solidtree.model.partition.faces import faces_of_polygons
from solidtree.model.partition.order import Sorter, heights
from solidtree.model.partition.tree import INNER
from solidtree.model.script import sphere

NAMES = ["a CSG part", "crossing parts", "cyclic bars", "a soup"]


@pytest.fixture(params=[False, True], ids=["numpy", "compiled"])
def compiled(request) -> bool:
    if request.param and not native.available():
        pytest.skip("the compiled extension is not here")
    return request.param


def test_heights_by_formula():
    planes = np.array([[0.0, 0, 1, 2], [1, 0, 0, -3]])
    assert heights(planes, np.array([1.0, 5, 7]), False).tolist() == [5, 4]
    assert heights(planes, np.array([1.0, 5, 7]), True).tolist() == [7, 1]


@pytest.mark.parametrize("name", NAMES)
def test_every_fragment_and_every_triangle_once(name: str, compiled: bool):
    tree = build(SCENES[name](), compiled=False)
    sorter = Sorter(tree, compiled)
    for eye in eyes_around(tree.points, 4):
        fragments = sorter.fragments(eye.towards, eye.parallel)
        triangles = sorter.triangles(eye.towards, eye.parallel)
        assert sorted(fragments.tolist()) == list(range(len(tree.source)))
        assert sorted(triangles.tolist()) == list(range(len(sorter.fans)))
        # The triangles go through the fragments in the fragments' order.
        of = sorter.fragment_of[triangles]
        assert of[np.flatnonzero(np.diff(of, prepend=-1))].tolist() == fragments.tolist()


@pytest.mark.parametrize("name", NAMES)
def test_front_first_is_the_reverse(name: str, compiled: bool):
    tree = build(SCENES[name](), compiled=False)
    sorter = Sorter(tree, compiled)
    for eye in eyes_around(tree.points, 4):
        for ordered in (sorter.fragments, sorter.triangles):
            back_first = ordered(eye.towards, eye.parallel)
            assert np.array_equal(ordered(eye.towards, eye.parallel, front_first=True), back_first[::-1])


@pytest.mark.parametrize("name", NAMES)
def test_a_direction_is_an_eye_far_away(name: str, compiled: bool):
    tree = build(SCENES[name](), compiled=False)
    sorter = Sorter(tree, compiled)
    for eye in eyes_around(tree.points, 6):
        away = -eye.axes[2]
        far = away * 1e9 * tree.faces.size
        assert np.array_equal(sorter.fragments(away, parallel=True), sorter.fragments(far))


def test_fans_cover_their_fragments(compiled: bool):
    tree = build(faces_of_polygons([disc(9), disc(3, 2.0, 1.0), disc(70, 3.0, 2.0)]), compiled=False)
    sorter = Sorter(tree, compiled)
    assert len(sorter.fans) == 7 + 1 + 68
    corners = tree.points[tree.corners[sorter.fans]]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    found = np.bincount(tree.source[sorter.fragment_of], areas)
    assert found == pytest.approx([n / 2 * r * r * np.sin(2 * np.pi / n) for n, r in ((9, 1), (3, 2), (70, 3))])


def test_what_no_reachable_node_owns_is_left_out(compiled: bool):
    tree = build(faces_of(*crossing(3)), compiled=False)
    assert tree.kind[tree.root] == INNER
    root = int(max(tree.front[tree.root], tree.back[tree.root]))
    half = dataclasses.replace(tree, root=root)
    kept = {int(f) for n in np.concatenate(half.levels()) for f in range(tree.first[n], tree.first[n] + tree.count[n])}
    sorter = Sorter(half, compiled)
    for eye in eyes_around(tree.points, 4):
        drawn = sorter.fragments(eye.towards, eye.parallel).tolist()
        assert len(drawn) == len(kept) == half.fragments < tree.fragments and set(drawn) == kept
        assert set(sorter.fragment_of[sorter.triangles(eye.towards, eye.parallel)].tolist()) == kept


def test_of_a_convex_body_what_looks_away_comes_first_and_of_a_hollow_last(compiled: bool):
    ball = faces_of(sphere(4, segments=32))
    hollow = dataclasses.replace(ball, planes=-ball.planes, side=-ball.side)
    for faces, rising in ((ball, True), (hollow, False)):
        tree = build(faces, compiled=False)
        for eye in eyes_around(tree.points, 4):
            drawn = Sorter(tree, compiled).fragments(eye.towards, eye.parallel)
            planes = faces.planes[faces.plane_of[tree.source[drawn]]]
            steps = np.diff((heights(planes, eye.towards, eye.parallel) > 0).astype(int))
            assert ((steps if rising else -steps) >= 0).all()
