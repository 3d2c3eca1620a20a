"""The angle at which faces stop to look smooth: normals and edges follow it, solids do not."""

import numpy as np
import pytest
from lane_listener import Listener

from solidtree.model.document.errors import Refusal
from solidtree.model.document.table import from_table, same_document, to_table
from solidtree.model.editing.echo import script_of
from solidtree.model.editing.session import Session
from solidtree.model.script import box, cylinder, document_of, sphere
from solidtree.model.solid.evaluate import Evaluator
from solidtree.model.solid.results import evaluate_document


def shown(node, evaluator=None):
    evaluation = evaluate_document(document_of(node), evaluator=evaluator)
    return evaluation.display(evaluation.solids[0])


def bends(mesh):
    """(t, 3) the angle in degrees between each triangle's plane and the normals at its corners."""
    corners = mesh.vertices[mesh.corners]
    flat = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    flat /= np.linalg.norm(flat, axis=1, keepdims=True)
    return np.degrees(np.arccos(np.clip(np.einsum("ti,tji->tj", flat, mesh.normals[mesh.triangles]), -1, 1)))


def test_no_angle_makes_every_face_flat_and_gives_each_its_edges():
    mesh = shown(cylinder(5, 10, segments=12).creased(0))
    assert bends(mesh).max() < 0.1
    assert len(mesh.edges) == 3 * 12


def test_the_largest_angle_makes_all_smooth_without_an_edge():
    mesh = shown(box(10).creased(180))
    assert len(mesh.edges) == 0
    corner = mesh.normals[np.linalg.norm(mesh.points, axis=1) < 1e-6]
    assert np.allclose(corner, -np.ones(3) / np.sqrt(3), atol=1e-6)


@pytest.mark.parametrize(("angle", "edges"), [(29, 3 * 12), (31, 2 * 12)])
def test_faces_part_at_the_very_angle_between_them(angle, edges):
    assert len(shown(cylinder(5, 10, segments=12).creased(angle)).edges) == edges


def test_without_an_angle_it_is_as_the_kind_has_it():
    assert len(shown(cylinder(5, 10, segments=12)).edges) == 3 * 12  # 30 degrees: above the 25 of an edge
    assert len(shown(cylinder(5, 10, segments=16)).edges) == 2 * 16
    assert len(shown(sphere(5, segments=8)).edges) > 0
    assert bends(shown(sphere(5, segments=8))).max() > 10  # and still shaded as one


def test_a_leaf_takes_the_angle_of_the_nearest_node_above_that_has_one():
    flat, round_ = cylinder(5, 10, segments=16).creased(0), cylinder(5, 10, segments=16).at(20)
    mesh = shown((flat + round_).creased(180))
    of_flat = mesh.owner == 0
    assert bends(mesh)[of_flat].max() < 0.1 < bends(mesh)[~of_flat].max()
    assert (mesh.owner[mesh.edge_sides] == 0).all() and len(mesh.edges) == 3 * 16


def test_a_new_angle_cuts_nothing_again():
    evaluator = Evaluator()
    part = box(10) - cylinder(3, 20)
    shown(part, evaluator)
    before = evaluator.evaluations
    assert len(shown(part.creased(0), evaluator).edges) > len(shown(part, evaluator).edges)
    assert evaluator.evaluations == before


def test_it_is_no_part_of_the_shape_but_of_the_picture():
    plain, creased = box(10) + sphere(3), box(10) + sphere(3).creased(5)
    assert plain == creased and not plain.creases and creased.creases
    assert creased.creases != (box(10) + sphere(3).creased(6)).creases
    assert creased.creases != (box(10).creased(5) + sphere(3)).creases


def test_the_worker_makes_another_picture_and_undo_brings_the_first_back():
    listener = Listener()
    listener.lane.start()
    try:
        session = Session(document_of(cylinder(5, 10, segments=16).named("bar")))
        root = session.document.solids[0].id
        plain = listener.evaluate(session.document).shown.solids[root].mesh
        session.do("set_crease", [root], 0)
        flat = listener.evaluate(session.document)
        assert len(flat.shown.solids[root].mesh.edges) == 3 * 16 and flat.evaluations == 0
        session.undo()
        assert listener.evaluate(session.document).shown.solids[root].mesh is plain
    finally:
        listener.lane.close()


def test_the_step_is_one_and_its_line_does_it_again():
    session = Session(document_of(box(10), sphere(4).at(20)))
    first, second = (root.id for root in session.document.solids)
    session.do("set_crease", [first, second], 20)
    assert session.log[-1] == f"set_crease({[first, second]!r}, 20)"
    assert [root.crease for root in session.document.solids] == [20.0, 20.0]
    session.undo()
    assert [root.crease for root in session.document.solids] == [None, None]
    before = session.document
    session.do("set_crease", [first])
    assert session.document is before


def test_file_and_script_keep_it():
    part = (box(10) - sphere(4).creased(0)).creased(12.5)
    document = document_of(part)
    assert same_document(from_table(to_table(document)), document)
    assert script_of(part).endswith(".creased(12.5)") and "sphere(radius=4).creased(0)" in script_of(part)


@pytest.mark.parametrize("angle", [-1, 181, float("nan"), True, "wide"])
def test_what_is_no_angle_is_refused(angle):
    with pytest.raises(Refusal, match="Box: a crease angle is a plain number of degrees from 0 to 180"):
        box(10).creased(angle)


def test_an_instance_unlinked_keeps_what_held_for_it():
    session = Session(document_of(box(10)))
    session.do("link", [session.document.solids[0].id])
    session.do("set_crease", [session.document.solids[0].id], 7)
    session.do("unlink", [session.document.solids[0].id])
    assert session.document.solids[0].crease == 7.0
