"""From documents to pages, here and in the worker: what is drawn once, superseded, given up, written."""

import queue
from pathlib import Path

import pytest

from solidtree.model.drafting.drawn import Draughts
from solidtree.model.drafting.plan import Eye, Plan
from solidtree.model.project.assets import default_store
from solidtree.model.script import box, cylinder, document_of, halfspace, sphere
from solidtree.model.worker.lane import Lane
from solidtree.model.worker.messages import Drawn, Exported, Progress

PLATE = document_of(plate=box(40, 20, 5) - cylinder(4, 9).at(10, 10, -2))


def labels_of(draughts, plan):
    told = []
    draughts.page(plan, lambda label: told.append(label), lambda label, share: told.append((label, share)))
    return told


def test_another_page_or_scale_draws_nothing_anew():
    draughts = Draughts(PLATE)
    assert labels_of(draughts, Plan(sheet="first"))
    for plan in (
        Plan(sheet="first", page="A2"),
        Plan(sheet="first", scale=0.5, dimensions=False, title="other"),
        Plan(sheet="third", iso=False, page="A3"),
    ):
        told = labels_of(draughts, plan)
        drawn = {share for _, share in told}
        assert (plan.sheet == "first") == (not drawn)  # the third angle wants the other side view
    told = labels_of(draughts, Plan(view=Eye((50, -50, 50)), perspective=30.0))
    shares = [share for _, share in told]
    assert shares == sorted(shares) and shares[0] >= 0 and shares[-1] == 1.0


def test_what_failed_is_told_with_the_page():
    document = document_of(good=box(10), endless=halfspace())
    drawn = Draughts(document).page(Plan())
    assert [message.name for message in drawn.messages if message.error] == ["endless"]
    hidden = document_of(good=box(10), lid=box(20).hidden())
    wide = Draughts(hidden, solid="lid").page(Plan(view="top", scale=1.0)).page
    assert wide.groups[1].groups[0].groups[0].name == "lid"


class Answers:
    def __init__(self):
        self.messages = queue.Queue()
        self.lane = Lane(self.messages.put, default_store().folder)

    def next(self, *kinds):
        while True:
            message = self.messages.get(timeout=60)
            if isinstance(message, kinds):
                return message


@pytest.fixture
def answers():
    answers = Answers()
    answers.lane.start()
    yield answers
    answers.lane.close()


def heavy():
    """Some seconds of drawing."""
    return document_of(*(sphere(10, segments=96).at(7 * i, 3 * (i % 5), 2 * (i % 3)) for i in range(30)))


def test_the_worker_draws_a_page_and_writes_one(answers, tmp_path: Path):
    lane = answers.lane
    number = lane.draw(PLATE, Plan(sheet="third"))
    first = answers.next(Drawn)
    assert first.request == number and first.fault is None
    assert first.page.scale == Draughts(PLATE).page(Plan(sheet="third")).page.scale
    lane.draw(PLATE, Plan(scale=50.0))
    refused = answers.next(Drawn)
    assert refused.page is None and "at 50:1" in refused.fault
    for path, fault in ((tmp_path / "a.svg", False), (tmp_path / "none" / "a.svg", True)):
        number = lane.draw(PLATE, Plan(sheet="third"), path=path)
        written = answers.next(Exported)
        assert written.request == number and (written.fault is not None) == fault
    assert (tmp_path / "a.svg").exists()


def test_a_newer_plan_takes_the_place_of_an_older_one_and_stopping_needs_no_new_worker(answers):
    lane = answers.lane
    lane.draw(PLATE, Plan())
    answers.next(Drawn)
    worker = lane.pid
    lane.draw(heavy(), Plan(faces="fill"))
    answers.next(Progress)
    number = lane.draw(PLATE, Plan(view="top"))
    assert answers.next(Drawn).request == number
    lane.draw(heavy(), Plan(faces="fill"))
    answers.next(Progress)
    lane.stop_drawing()
    number = lane.draw(PLATE, Plan(view="front"))
    assert answers.next(Drawn).request == number and lane.pid == worker
