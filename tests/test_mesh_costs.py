"""What representations answer and what they take."""

import numpy as np
import pytest

from solidtree.model.mesh.costs import KINDS, QUESTIONS, REPRESENTATIONS, EdgeList, FaceLists, Soup, Wings, costs, sizes
from solidtree.model.script import box, cylinder, inspected, sphere


def test_all_representations_give_the_same_answers():
    mesh = inspected(box(20) - cylinder(4, 60, centred=True, segments=12).at(10, 10, 10), triangles=True)
    points = mesh.lists.vertices

    def places(found):
        return {tuple(place) for place in np.asarray(found, float).reshape(-1, 3).tolist()}

    soup, *others = (kind(mesh) for kind in KINDS)
    for face in range(mesh.lists.face_count):
        near = {int(i) for i in soup.neighbours(face)}
        assert len(near) == 3
        for answers in others:
            assert places(points[np.asarray(answers.corners(face))]) == places(soup.corners(face))
            assert {int(i) for i in answers.neighbours(face)} == near
    for vertex in range(len(points)):
        around = places(soup.star(vertex))
        for answers in others:
            assert places(points[np.asarray(answers.star(vertex))]) == around
    for edge in range(len(mesh.winged)):
        sides = {int(i) for i in soup.sides(edge)}
        assert all({int(i) for i in answers.sides(edge)} == sides for answers in others)


def test_polygons_with_holes_answer_alike():
    mesh = inspected(box(20) - cylinder(4, 60, centred=True, segments=12).at(10, 10, 10))
    lists, edges, wings = FaceLists(mesh), EdgeList(mesh), Wings(mesh)
    for face in range(mesh.lists.face_count):
        assert sorted(wings.corners(face)) == sorted(lists.corners(face).tolist())
        assert (
            set(wings.neighbours(face)) == set(lists.neighbours(face).tolist()) == set(edges.neighbours(face).tolist())
        )
    for vertex in range(len(mesh.lists.vertices)):
        assert set(wings.star(vertex)) == set(lists.star(vertex).tolist()) == set(edges.star(vertex).tolist())


def test_memory_is_that_of_the_arrays_and_searches_grow_with_the_mesh():
    small, large = (
        inspected(sphere(10, segments=16), triangles=True),
        inspected(sphere(10, segments=400), triangles=True),
    )
    assert list(sizes(small)) == list(REPRESENTATIONS)
    assert sizes(small)["triangle soup"] == 72 * len(small.triangles) == Soup(small).points.nbytes
    assert sizes(small)["winged edge"] == small.winged.nbytes + small.lists.vertices.nbytes
    before, after = costs(small, 0.05), costs(large, 0.05)
    assert [cost.name for cost in after] == list(REPRESENTATIONS)
    assert all(len(cost.seconds) == len(QUESTIONS) for cost in after)
    grown = len(large.triangles) / len(small.triangles)
    assert after[0].nbytes / before[0].nbytes == pytest.approx(grown)
    star = QUESTIONS.index("edges at a vertex")
    # A hundred times the mesh: what searches is slower by far than what walks.
    assert after[0].seconds[star] > 10 * after[3].seconds[star]
    assert not any(after[3].searches) and after[0].searches[star]
