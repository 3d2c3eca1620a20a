"""From documents to pages, here and in the worker: what is drawn once, superseded, given up, written."""

import queue
from pathlib import Path

import numpy as np
import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.drafting.drawn import Draughts
from solidtree.model.drafting.fineness import ON_PAPER, fineness
from solidtree.model.drafting.page import items_of
from solidtree.model.drafting.plan import Eye, Plan
from solidtree.model.project.assets import default_store
from solidtree.model.script import box, cylinder, document_of, halfspace, sphere
from solidtree.model.solid.tessellation import DEFAULT_TOLERANCE
from solidtree.model.worker.lane import Lane
from solidtree.model.worker.messages import Drawn, Exported, Progress

PLATE = document_of(plate=box(40, 20, 5) - cylinder(4, 9).at(10, 10, -2))


def labels_of(draughts, plan):
    told = []
    draughts.page(plan, lambda label: told.append(label), lambda label, share: told.append((label, share)))
    return told


def test_another_page_or_scale_draws_nothing_anew():
    draughts = Draughts(PLATE, 0.05)
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


def rim_of(page, radius, role="visible"):
    """The polyline of a circle around a disc in a top view, from its middle, in mm of paper."""
    points = np.concatenate([line for item in items_of(page, role) for line in item.lines])
    away = points - (points.min(axis=0) + points.max(axis=0)) / 2.0
    return away[np.abs(np.hypot(*away.T) - radius * page.scale) < 0.01 * radius * page.scale]


@pytest.mark.parametrize(("radius", "scale"), [(50.0, 1.0), (3.0, 20.0), (0.05, 1000.0), (600.0, 0.1)])
def test_chords_stay_close_to_their_circle_on_paper_at_any_scale(radius, scale):
    page = Draughts(document_of(disc=cylinder(radius, radius))).page(Plan(view="top", scale=scale)).page
    rim = np.unique(np.round(rim_of(page, radius), 9), axis=0)
    sagitta = radius * scale * (1.0 - np.cos(np.pi / len(rim)))
    assert ON_PAPER / 6 < sagitta <= ON_PAPER or (scale < 0.4 and sagitta <= 0.05 * scale)


def test_the_model_is_never_coarser_than_on_the_screen_and_a_given_tolerance_counts():
    disc = document_of(disc=cylinder(300.0, 10.0))
    rims = [len(rim_of(Draughts(disc, *given).page(Plan(view="top", scale=0.1)).page, 300.0))
            for given in ((), (0.05,), (5.0,))]  # fmt: skip
    assert rims[0] == rims[1] > rims[2]


def test_what_is_not_round_is_drawn_once_for_all_scales():
    draughts = Draughts(document_of(part=box(30, 20, 10)))
    assert any(isinstance(label, tuple) for label in labels_of(draughts, Plan(view="top", scale=1.0)))
    for scale in (2.0, 5.0, None):
        assert not any(isinstance(label, tuple) for label in labels_of(draughts, Plan(view="top", scale=scale)))


def test_fineness_is_bounded_by_the_number_of_triangles():
    def spheres(count):
        return lambda tolerance: int(count * 6.75 * 10.0 / tolerance)

    assert fineness(1.0, 200_000, spheres(1)) == ON_PAPER
    bounded = fineness(1000.0, 200_000, spheres(1))
    assert 50_000 < spheres(1)(bounded) <= 200_000 and bounded > ON_PAPER / 1000.0
    assert fineness(1000.0, 200_000, spheres(1000)) == DEFAULT_TOLERANCE
    assert fineness(0.01, 200_000, spheres(1)) == DEFAULT_TOLERANCE
    walls = fineness(1000.0, 200_000, lambda tolerance: int(40 / tolerance**0.5))
    assert walls == pytest.approx(ON_PAPER / 1000.0)


def test_a_plan_that_does_not_fit_is_refused_before_anything_is_drawn():
    told = []
    with pytest.raises(Refusal, match="at 100:1"):
        Draughts(PLATE).page(Plan(scale=100.0), None, lambda label, share: told.append(label))
    assert not told


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
