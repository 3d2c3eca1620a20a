"""Faults of what a document holds: meshes as they came, solids, outlines; in the worker, with progress and an end."""

import numpy as np
import pytest
from lane_listener import Listener
from PySide6.QtCore import QObject

from solidtree.gui.jobs import Jobs
from solidtree.model.checking.document_faults import document_faults
from solidtree.model.operations.operations import OPERATIONS
from solidtree.model.project.assets import default_store
from solidtree.model.script import Refusal, box, cylinder, document_of, path, polyhedron
from solidtree.model.worker.lane import Lane
from solidtree.model.worker.messages import FaultsFound, Progress

OPEN_BOX = polyhedron(
    [(0, 0, 0), (4, 0, 0), (4, 3, 0), (0, 3, 0), (0, 0, 2), (4, 0, 2), (4, 3, 2), (0, 3, 2)],
    [(0, 3, 2, 1), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)],
)


@pytest.fixture
def listener():
    found = Listener()
    yield found
    found.lane.close()


def test_every_visible_root_has_a_report_and_so_has_a_mesh_within_one():
    lidless = OPEN_BOX.at(10, 0, 0).named("lidless")
    document = document_of(
        lidless, box(5).named("hidden").hidden(), part=box(8) - OPEN_BOX.named("pocket"),
        o=path("M 0 0 L 10 0 L 10 10 L 0 10.0004").at(0, 0, 7),
    )  # fmt: skip
    reports = {found.name: found for found in document_faults(document)}
    assert list(reports) == ["lidless", "part", "pocket", "o"]
    assert (reports["lidless"].kind, reports["part"].kind, reports["o"].kind) == ("mesh", "solid", "outline")
    assert reports["lidless"].faults.open_edges == 4 and reports["lidless"].places().tolist() == [[12, 1.5, 2]]
    assert reports["part"].faults is None and "not closed" in str(reports["part"])
    assert reports["pocket"].faults.borders == 1
    assert reports["o"].faults.open_ends == 2 and reports["o"].places()[:, 2].tolist() == [7, 7]
    assert reports["lidless"].table()["findings"][0]["place"] == [12, 1.5, 2]


def test_nodes_are_chosen_by_their_ids_and_a_mirrored_mesh_is_not_inside_out():
    document = document_of(a=box(8), b=OPEN_BOX.mirrored((1, 0, 0)))
    closed = OPERATIONS["repair_mesh"](document, document.solids[1].id, ["holes"])
    (report,) = document_faults(closed, ids=[document.solids[1].id])
    assert report.name == "b" and report.faults.sound and report.faults.volume == pytest.approx(24)
    with pytest.raises(Refusal, match="no node n99"):
        document_faults(document, ids=["n99"])
    with pytest.raises(Refusal, match="tolerance"):
        document_faults(document, float("nan"))


def test_progress_runs_from_node_to_node():
    heard = []
    document_faults(document_of(a=OPEN_BOX, b=OPEN_BOX), progress=lambda label, share: heard.append((label, share)))
    assert {label for label, _ in heard} == {"a", "b"}
    shares = [share for _, share in heard]
    assert shares == sorted(shares) and shares[-1] <= 1


def test_the_worker_finds_them_and_can_be_stopped(listener):
    document = document_of(a=OPEN_BOX, b=cylinder(5, 5))
    answer = listener.wait_for(FaultsFound, request=listener.lane.find_faults(document, (), 0.001))
    assert [str(found) for found in answer.found] == [str(found) for found in document_faults(document)]
    refused = listener.wait_for(FaultsFound, request=listener.lane.find_faults(document, ("n99",), 0.001))
    assert refused.found is None and "n99" in refused.fault


def test_the_window_is_told_of_them(qtbot):
    parent = QObject()
    jobs = Jobs(lambda tell: Lane(tell, default_store().folder), parent)
    try:
        with qtbot.waitSignal(jobs.faults_found, timeout=60_000) as told:
            jobs.find_faults(document_of(a=OPEN_BOX), (), 0.001)
        assert [found.name for found in told.args[0]] == ["a"] and told.args[1] == "" and not jobs.finding
        with qtbot.waitSignal(jobs.faults_found) as told:
            jobs.find_faults(document_of(a=OPEN_BOX), (), 0.001)
            jobs.cancel()
        assert told.args == [None, "it was cancelled"]
    finally:
        jobs.close()


def test_looking_ends_when_it_is_no_longer_wanted(listener):
    """A soup of many triangles that all run into each other takes a while; what is asked for next is answered."""
    rng = np.random.default_rng(5)
    points = rng.random((24_000, 3)) * 10
    soup = polyhedron(points.tolist(), np.arange(24_000).reshape(-1, 3).tolist())
    long = listener.lane.find_faults(document_of(soup), (), 0.001)
    listener.wait_for(Progress, request=long)
    listener.lane.stop_finding()
    short = listener.lane.find_faults(document_of(box(1)), (), 0.001)
    listener.wait_for(FaultsFound, request=short)
    assert not any(isinstance(message, FaultsFound) and message.request == long for message in listener.seen)
