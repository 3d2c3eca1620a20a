"""The worker behind a lane: answers, progress, cancelling, and what happens when it dies."""

import os
import signal
import time
from multiprocessing import Pipe

import numpy as np
import pytest
from lane_listener import Listener

from solidtree.model.document.document import Document
from solidtree.model.document.table import to_table
from solidtree.model.document.tree import change, numbered
from solidtree.model.operations.operations import OPERATIONS
from solidtree.model.script import box, cylinder, document_of, parameter, sphere, union
from solidtree.model.worker.messages import Cancelled, Died, Evaluated, Examined, Exported, Progress, Started
from solidtree.model.worker.process import WorkerProcess
from solidtree.model.worker.worker import _Worker


@pytest.fixture
def listener():
    listener = Listener()
    listener.lane.start()
    yield listener
    listener.lane.close()


def heavy(number=0):
    """Some seconds of work, in many steps."""
    balls = [sphere(10, segments=128).at(0.7 * i, 0.31 * i, number) for i in range(40)]
    tree = balls[0]
    for ball in balls[1:]:
        tree = (tree - ball).at(0.01) + ball.at(0.3, 0.2)
    return document_of(heavy=tree)


def test_it_answers_with_pictures_and_measures(listener):
    answer = listener.evaluate(document_of(a=box(2), b=(sphere(0) + box(1)), c=box(1).hidden()))
    good, bad = answer.shown.solids["n1"], answer.shown.solids["n2"]
    assert good.measures.volume == pytest.approx(8) and len(good.mesh.triangles) == 12
    assert bad.measures is None and len(bad.mesh.triangles) == 12  # the box is still to be seen
    assert set(answer.shown.solids) == {"n1", "n2"}
    (problem,) = answer.shown.problems
    assert problem.node_id == "n3" and "radius" in problem.message and problem.error


def test_what_is_unchanged_is_the_same_picture(listener):
    document = document_of(a=box(2), b=sphere(3))
    first = listener.evaluate(document).shown
    moved = change(document, "n2", lambda node: node.at(1))
    second = listener.evaluate(moved).shown
    assert second.solids["n1"].mesh is first.solids["n1"].mesh
    assert second.solids["n2"].mesh is not first.solids["n2"].mesh
    back = listener.evaluate(document)
    assert back.shown.solids["n2"].mesh is first.solids["n2"].mesh and back.evaluations == 0


def test_a_rename_evaluates_nothing_and_ids_follow_the_document(listener):
    document = document_of(a=(box(2) - sphere(1)))
    first = listener.evaluate(document).shown.solids["n1"]
    renamed = change(document, "n3", lambda node: node.named("bite"))
    assert listener.evaluate(renamed).shown.solids["n1"].mesh is first.mesh
    (copy,) = numbered(document.solids, 7)
    both = listener.evaluate(document.with_(solids=(*document.solids, copy)))
    assert both.evaluations == 0
    assert both.shown.solids["n7"].mesh.owners == (("n7", "n8"), ("n7", "n9"))
    assert both.shown.solids["n7"].mesh.points is first.mesh.points


def test_parameters_reach_the_worker(listener):
    document = document_of(a=box(parameter("w", 2), 1, 1))
    assert listener.evaluate(document).shown.solids["n1"].measures.volume == pytest.approx(2)
    wider = document.with_(parameters=(document.parameters[0].with_(value=5),))
    assert listener.evaluate(wider).shown.solids["n1"].measures.volume == pytest.approx(5)


def test_a_problem_that_comes_again_from_what_is_kept_has_its_node(listener):
    document = document_of(a=(box(1) & box(1).at(9)))
    first = listener.evaluate(document).shown.problems
    assert listener.evaluate(document).shown.problems == first
    assert [problem.node_id for problem in first] == ["n1"]


def test_progress_is_told_and_a_newer_document_supersedes(listener):
    old = listener.lane.evaluate(heavy())
    progress = listener.wait_for(Progress)
    assert progress.request == old and 0 < progress.done <= progress.total and progress.label
    newer = listener.evaluate(document_of(a=box(1)))
    assert newer.shown.solids["n1"].measures.volume == pytest.approx(1)
    assert not any(isinstance(m, Evaluated) and m.request == old for m in listener.seen)
    assert not any(isinstance(m, Died) for m in listener.seen)


def test_previews_of_a_drag_are_finished_and_of_those_that_wait_the_newest_is_taken(listener):
    some = document_of(some=union(*(sphere(10, segments=64).at(3 * i) for i in range(20))))
    first = listener.lane.evaluate(some, 0.2, supersedes=False)
    while listener.lane.at_work != first:
        os.sched_yield()
    second = listener.lane.evaluate(document_of(a=box(1)), 0.2, supersedes=False)
    third = listener.lane.evaluate(document_of(a=box(2)), 0.2, supersedes=False)
    assert listener.wait_for(Evaluated).request == first
    assert listener.wait_for(Evaluated).request == third and second < third
    at_last = listener.lane.evaluate(heavy(), supersedes=False)
    listener.wait_for(Progress, request=at_last)
    committed = listener.evaluate(document_of(a=box(3)))  # which a preview does not delay
    assert committed.shown.solids["n1"].measures.volume == pytest.approx(27)
    assert not any(isinstance(m, Evaluated) and m.request == at_last for m in listener.seen)


def test_cancel_ends_the_work_within_a_second_and_the_lane_goes_on(listener):
    request = listener.lane.evaluate(heavy(1))
    listener.wait_for(Progress)
    start = time.monotonic()
    listener.lane.cancel()
    assert listener.wait_for(Cancelled).request == request
    assert time.monotonic() - start < 1
    assert listener.evaluate(document_of(a=box(3))).shown.solids["n1"].measures.volume == pytest.approx(27)


@pytest.mark.skipif(not hasattr(signal, "SIGSTOP"), reason="a process cannot be stopped here")
def test_cancel_does_not_wait_for_a_worker_that_does_not_read(listener):
    assert listener.evaluate(document_of(a=box(1))).shown.solids
    os.kill(listener.lane.pid, signal.SIGSTOP)
    many = document_of(many=union(*(box(1).at(2 * i) for i in range(3000))))  # far more than a pipe takes
    number = listener.lane.evaluate(many)
    while listener.lane.at_work != number:
        os.sched_yield()
    listener.lane.cancel()
    assert listener.wait_for(Cancelled, Evaluated, Died).request == number
    assert isinstance(listener.seen[-1], Cancelled)
    assert listener.evaluate(document_of(a=box(2))).shown.solids["n1"].measures.volume == pytest.approx(8)


def test_nodes_are_looked_at_by_themselves_and_kept(listener):
    document = document_of(a=(box(10) - cylinder(2, 30).at(5, 5, -10)))
    first = listener.wait_for(Examined, request=listener.lane.examine(document, ("n3", "n9"))).parts
    assert list(first) == ["n3"] and first["n3"].mesh.bounds[1][2] == 30  # before its placement
    assert first["n3"].measures.bounds[1][2] == pytest.approx(20)
    moved = change(document, "n3", lambda node: node.at(1))
    second = listener.wait_for(Examined, request=listener.lane.examine(moved, ("n3",))).parts
    assert second["n3"].mesh is first["n3"].mesh
    assert second["n3"].measures.centroid[0] == pytest.approx(6)


def test_a_question_about_nodes_waits_for_an_evaluation_and_is_answered_then(listener):
    asked = listener.lane.examine(heavy(), (heavy().solids[0].id,))
    listener.wait_for(Progress, request=asked)
    assert listener.evaluate(document_of(a=box(1))).shown.solids
    assert not any(isinstance(message, Examined) for message in listener.seen)
    assert listener.wait_for(Examined, request=asked).parts["n1"].mesh is not None


def test_a_worker_killed_from_outside_loses_nothing(listener):
    document = document_of(a=box(2) - sphere(1))
    first = listener.evaluate(document).shown.solids["n1"].mesh
    os.kill(listener.lane.pid, signal.SIGKILL)
    listener.wait_for(Died)
    again = listener.evaluate(document)
    assert again.shown.solids["n1"].mesh is first
    assert listener.evaluate(document_of(a=box(4))).shown.solids["n1"].measures.volume == pytest.approx(64)


def test_a_worker_killed_at_work_is_replaced_and_the_work_done_again(listener):
    holes = [cylinder(1, 6, segments=32).at(3 * (i % 30), 3 * (i // 30), -1) for i in range(600)]
    document = document_of(plate=box(95, 65, 4).at(-3, -3) - union(*holes))
    listener.wait_for(Started)
    request = listener.lane.evaluate(document)
    listener.wait_for(Progress)
    os.kill(listener.lane.pid, signal.SIGKILL)
    died = listener.wait_for(Died)
    assert died.request == request and not died.given_up
    answer = listener.wait_for(Evaluated, request=request)
    area = 32 / 2 * np.sin(2 * np.pi / 32)
    assert answer.shown.solids["n1"].measures.volume == pytest.approx(4 * (95 * 65 - 600 * area), rel=1e-9)


def test_a_document_that_kills_the_worker_twice_is_given_up(listener):
    listener.wait_for(Started)
    request = listener.lane.evaluate(heavy(2))
    for given_up in (False, True):
        listener.wait_for(Progress)
        os.kill(listener.lane.pid, signal.SIGKILL)
        died = listener.wait_for(Died)
        assert (died.request, died.given_up) == (request, given_up)
    assert listener.evaluate(document_of(a=box(1))).shown.solids["n1"].measures.volume == pytest.approx(1)


def test_export_writes_a_file_or_says_why_not(listener, tmp_path):
    document = document_of(a=box(2), b=sphere(0))
    done = listener.wait_for(Exported, request=listener.lane.export(document, tmp_path / "a.stl", solid="a"))
    assert done.fault is None and (tmp_path / "a.stl").stat().st_size == 84 + 12 * 50
    for target, solid, words in (
        (tmp_path / "b.stl", "b", "radius"),
        (tmp_path / "b.stl", "c", "no solid called"),
        (tmp_path / "b.xyz", "a", "xyz"),
        (tmp_path / "none" / "b.stl", "a", "no such file or folder"),
    ):
        failed = listener.wait_for(Exported, request=listener.lane.export(document, target, solid=solid))
        assert words in failed.fault and not target.exists()


def test_getting_ready_makes_the_first_move_of_an_operand_cheap(listener):
    holes = [cylinder(1, 6, segments=16).at(3 * (i % 20), 3 * (i // 20), -1) for i in range(200)]
    document = document_of(plate=box(65, 35, 4).at(-3, -3) - union(*holes))
    listener.evaluate(document)
    hole = document.solids[0].children[1].children[77]
    listener.lane.prepare(document, hole.id)
    moved = change(document, hole.id, lambda node: node.at(0.2))
    answer = listener.evaluate(moved)
    assert answer.shown.solids["n1"].measures.genus == 200
    listener.lane.prepare(Document(solids=moved.solids), "n1")  # nothing to get ready for: no harm
    assert listener.evaluate(document).evaluations == 0


def test_in_a_definition_there_is_nothing_to_get_ready_for():
    linked = OPERATIONS["link"](document_of(box(10) - sphere(3)), ["n1"])
    here, there = Pipe()
    with here, there:
        _Worker(there).answer(("prepare", 7, to_table(linked), (0.05,), linked.definitions[0].children[1].id))
        assert here.recv() == ("prepared", 7)


def test_the_worker_goes_when_its_owner_does():
    listener = Listener()
    listener.lane.start()
    pid = listener.wait_for(Started).pid
    listener.lane.close()
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)


def test_a_worker_that_cannot_start_is_not_started_for_ever(monkeypatch):
    class Unstartable(WorkerProcess):
        def start(self):
            super().start()
            self.kill()

    monkeypatch.setattr("solidtree.model.worker.lane.WorkerProcess", Unstartable)
    listener = Listener()
    lane = listener.lane
    lane.start()
    deaths = [listener.wait_for(Died) for _ in range(3)]
    assert [death.given_up for death in deaths] == [False, False, True]
    lane.evaluate(document_of(a=box(1)))  # asked again, it tries again
    assert not listener.wait_for(Died).given_up
    lane.close()


def test_a_document_that_cannot_be_told_is_refused_and_the_lane_goes_on(listener):
    twin = box(1).with_(id="n1")
    answer = listener.evaluate(Document(solids=(twin, twin.at(3))))
    assert answer.shown.solids == {} and "n1" in answer.shown.problems[0].message
    assert listener.evaluate(document_of(a=box(1))).shown.solids["n1"].measures.volume == pytest.approx(1)


def test_an_unforeseen_fault_is_told_and_the_lane_goes_on(listener, capfd):
    request = listener.lane.evaluate("no document at all")
    died = listener.wait_for(Died, request=request)
    assert died.given_up and "Traceback" in capfd.readouterr().err
    assert listener.evaluate(document_of(a=box(1))).shown.solids["n1"].measures.volume == pytest.approx(1)
