"""Normals as needles: where they begin and where they point, by formula."""

import numpy as np

from solidtree.model.mesh.needles import LONGEST, face_needles, needle_length, vertex_needles
from solidtree.model.script import box, cylinder, document_of, sphere
from solidtree.model.solid.results import evaluate_document


def shown(node):
    evaluation = evaluate_document(document_of(node))
    return evaluation.display(evaluation.solids[0])


def test_a_box_has_one_in_the_middle_of_each_side():
    needles = face_needles(shown(box(2, 4, 6)))
    assert needles.total == 6
    feet = needles.feet - (1, 2, 3)
    assert np.allclose(feet, needles.normals * (1, 2, 3))
    ends = needles.lines(0.5)
    assert np.allclose(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1), 0.5)


def test_a_face_with_a_hole_in_its_middle_has_its_needle_on_the_face():
    needles = face_needles(shown(box(20, 20, 4) - cylinder(5, 10).at(10, 10, -2)))
    top = needles.feet[(needles.normals[:, 2] > 0.9)]
    assert len(top) == 1 and top[0, 2] == 4.0
    assert np.linalg.norm(top[0, :2] - 10) > 5 * np.cos(np.pi / 40)


def test_vertices_have_as_many_as_their_creases_make():
    assert vertex_needles(shown(box(10))).total == 8 * 3
    assert vertex_needles(shown(box(10).creased(180))).total == 8
    smooth = vertex_needles(shown(sphere(7)))
    assert np.einsum("ij,ij->i", smooth.feet, smooth.normals).min() > 0.99 * 7
    assert smooth.total == len(np.unique(shown(sphere(7)).vertices, axis=0))


def test_chosen_triangles_alone_have_needles():
    mesh = shown(box(10) + box(10).at(30))
    needles = face_needles(mesh, mesh.owner == 1)
    assert needles.total == 6 and needles.feet[:, 0].min() == 30.0
    assert vertex_needles(mesh, mesh.owner == 1).feet[:, 0].min() == 30.0
    assert vertex_needles(mesh, mesh.owner == 7).total == 0 and face_needles(mesh, mesh.owner == 7).total == 0


def test_of_many_a_part_is_drawn_and_all_are_counted():
    mesh = shown(sphere(10, tolerance=0.01))
    for needles in (face_needles(mesh, most=100), vertex_needles(mesh, most=100)):
        assert len(needles.feet) <= 100 < needles.total
    assert face_needles(mesh, most=100).total == len(np.unique(mesh.facet))


def test_needles_are_no_longer_than_a_share_of_the_whole():
    assert needle_length(shown(box(100)), 10.0) == LONGEST * 10.0
