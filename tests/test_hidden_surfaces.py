"""The worker behind a lane as it sorts faces: the tree, a newer question, cancelling, and what happens when it dies."""

import os
import signal
import time
from dataclasses import replace

import numpy as np
import pytest
from lane_listener import Listener

from solidtree.model.partition.faces import faces_of_meshes
from solidtree.model.partition.order import Sorter
from solidtree.model.script import box, cylinder, document_of, sphere
from solidtree.model.solid.evaluate import Evaluator
from solidtree.model.solid.results import display_of, result_of
from solidtree.model.worker.messages import Cancelled, Died, Exported, Partitioned, Progress


@pytest.fixture
def listener():
    listener = Listener()
    listener.lane.start()
    yield listener
    listener.lane.close()


def meshes_of(*roots):
    evaluator = Evaluator()
    solids = document_of(*roots).solids
    return tuple(display_of(result_of(root, evaluator.evaluate(root, 0.05)), evaluator) for root in solids)


@pytest.fixture(scope="module")
def many():
    """Seconds of work: a million triangles of balls that cross one another."""
    (ball,) = meshes_of(sphere(10, segments=256))
    shifts = np.random.default_rng(4).uniform(-6, 6, (20, 3))
    return tuple(replace(ball, vertices=ball.vertices + shift) for shift in shifts)


def areas(tree):
    """(m,) the area of the pieces of each face."""
    fans = Sorter(tree)
    a, b, c = (tree.points[tree.corners[fans.fans[:, corner]]] for corner in range(3))
    size = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    reached = np.isin(fans.fragment_of, fans.fragments((0, 0, 0)))
    return np.bincount(tree.source[fans.fragment_of[reached]], size[reached], tree.faces.count)


def test_the_tree_is_that_of_the_triangles_one_mesh_after_the_other(listener):
    meshes = meshes_of(box(10) - cylinder(radius=3, height=30).at(5, 5, -10), sphere(4).at(2, 1))
    answer = listener.partition(*meshes)
    assert answer.fault is None and answer.seconds > 0
    faces = faces_of_meshes(meshes)
    for name in ("points", "corners", "starts", "planes", "plane_of", "group", "side"):
        assert np.array_equal(getattr(answer.tree.faces, name), getattr(faces, name)), name
    corners = np.concatenate([mesh.vertices[mesh.corners] for mesh in meshes])
    whole = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    assert areas(answer.tree) == pytest.approx(whole, abs=1e-9)


def test_no_mesh_gives_the_empty_tree(listener):
    assert listener.partition().tree.root == -1


def test_what_does_not_fit_together_is_refused_in_words(listener):
    (cube,) = meshes_of(box(1))
    answer = listener.partition(replace(cube, vertices=np.full_like(cube.vertices, np.nan)))
    assert answer.tree is None and answer.fault
    assert listener.partition(cube).tree.fragments == 12


def test_progress_is_told_and_a_newer_question_takes_the_place_of_an_older_one(listener, many):
    old = listener.lane.partition(many)
    progress = listener.wait_for(Progress, request=old)
    assert progress.label == "Sorting faces" and 0 <= progress.done <= progress.total
    waiting = listener.lane.partition(many[:3])
    (cube,) = meshes_of(box(1))
    start = time.monotonic()
    assert listener.partition(cube).tree.fragments == 12
    assert time.monotonic() - start < 10
    gone = {old, waiting}
    assert not any(isinstance(m, Partitioned | Cancelled | Died) and m.request in gone for m in listener.seen)


def test_cancel_ends_it_within_a_second_and_the_lane_goes_on(listener, many):
    request = listener.lane.partition(many)
    listener.wait_for(Progress, request=request)
    start = time.monotonic()
    listener.lane.cancel()
    assert listener.wait_for(Cancelled).request == request
    assert time.monotonic() - start < 1
    assert listener.partition(*meshes_of(box(1))).tree.fragments == 12


def test_a_worker_that_dies_is_asked_once_more(listener, many):
    (cube,) = meshes_of(box(1))
    request = listener.lane.partition(many)
    for given_up in (False, True):
        listener.wait_for(Progress, request=request)
        os.kill(listener.lane.pid, signal.SIGKILL)
        died = listener.wait_for(Died)
        assert died.request == request and died.given_up is given_up
    assert listener.partition(cube).tree.fragments == 12


def test_a_file_is_written_before_faces_are_sorted_and_both_are_answered(listener, many, tmp_path):
    sorting = listener.lane.partition(many)
    listener.wait_for(Progress, request=sorting)
    writing = listener.lane.export(document_of(a=box(1)), tmp_path / "a.stl")
    (cube,) = meshes_of(box(1))
    newest = listener.lane.partition((cube,))
    assert listener.wait_for(Exported, request=writing).fault is None
    assert listener.wait_for(Partitioned).request == newest
