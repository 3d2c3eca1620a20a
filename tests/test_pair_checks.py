"""A document against what is asked of its solids: findings worst first, words for every case, and what is kept."""

import numpy as np
import pytest
from lane_listener import Listener
from PySide6.QtCore import QObject

from solidtree.gui.jobs import Jobs
from solidtree.model.document.errors import Refusal
from solidtree.model.operations.checks import check_pair, set_clearance
from solidtree.model.operations.operations import move, rename
from solidtree.model.project.assets import default_store
from solidtree.model.proximity.checking import check_document, table_of
from solidtree.model.proximity.checks import Checks
from solidtree.model.proximity.memo import PairMemo
from solidtree.model.proximity.words import finding_words, remark_words, report_words
from solidtree.model.script import (
    box,
    circle,
    clearances,
    document_of,
    halfspace,
    in_words,
    open_document,
    sphere,
    with_clearance,
)
from solidtree.model.worker.lane import Lane
from solidtree.model.worker.messages import PairsChecked, Progress

SHEET = "v 0 0 0\nv 6 0 0\nv 0 6 0\nv 0 0 6\nf 1 3 2\nf 1 2 4\nf 2 3 4\n"
TOLERANCE = 0.05


@pytest.fixture
def sheet(tmp_path):
    """A surface that is not closed."""
    path = tmp_path / "sheet.obj"
    path.write_text(SHEET)
    return open_document(path).solids[0]


@pytest.fixture
def listener():
    heard = Listener()
    yield heard
    heard.lane.close()


def words(document, **checks):
    report = check_document(document, TOLERANCE, Checks(**checks) if checks else None)
    return [finding_words(finding) for finding in report.findings]


def test_worst_come_first_and_tell_what_is_missing():
    document = document_of(a=box(10), b=box(10).at(9.5), c=box(10).at(19.4, 9.7), d=box(1).at(0, 0, 10.3))
    report = check_document(set_clearance(document, 0.5), TOLERANCE)
    assert [finding.names for finding in report.findings] == [("a", "b"), ("b", "c"), ("a", "d")]
    large, small, gap = report.findings
    assert large.overlap == pytest.approx(50) and small.overlap == pytest.approx(0.1 * 0.3 * 10)
    assert gap.gap == pytest.approx(0.3) and gap.missing == pytest.approx(0.2) and gap.asked == 0.5
    assert large.bounds == pytest.approx(np.array([(9.5, 0, 0), (10, 10, 10)]))
    assert (report.solids, report.pairs, report.in_order) == (4, 6, False)
    assert report_words(report) == "6 pairs of 4 solids, a clearance of 0.5 mm asked: 2 overlap, 1 is too near."


def test_pairs_have_a_clearance_of_their_own_or_are_meant_to_touch():
    document = set_clearance(document_of(a=box(10), lid=box(10).at(0, 0, 10), pin=box(1).at(12)), 1)
    assert words(document) == ["“a” and “lid” touch; 1 mm is asked."]
    document = check_pair(check_pair(document, "n1", "n2", touching=True), "n1", "n3", 3)
    assert words(document) == ["“a” and “pin” are 2 mm apart; 3 mm is asked."]
    lifted = move(document, "n2", 0, 0, 0.3)
    report = check_document(lifted, TOLERANCE)
    assert [finding.fault for finding in report.findings] == ["near", "parted"]  # a whole millimetre is missing
    assert finding_words(report.findings[1]) == "“a” and “lid” are meant to touch, and are 0.3 mm apart."
    assert [row["b"] for row in table_of(report)["parted"]] == ["lid"]
    within = check_document(move(document, "n2", 0, 0, 0.04), TOLERANCE)  # as curved surfaces are told apart
    assert [finding.fault for finding in within.findings] == ["near"]
    sunk = words(move(document, "n2", 0, 0, -1))
    assert sunk[0] == "“a” and “lid” overlap by 100 mm³."
    apart = words(document, clearance=0, pairs=document.checks.pairs)
    assert apart == ["“a” and “pin” are 2 mm apart; 3 mm is asked."]


@pytest.mark.parametrize(
    ("solids", "expected"),
    [
        ((box(10), box(10).at(10)), []),  # touching is no fault where no gap is asked
        ((box(10), box(10)), ["“a” and “b” are the same body in the same place: 1,000 mm³."]),
        ((box(1).at(4, 4, 4), box(10)), ["“a” lies inside “b”, all of its 1 mm³."]),
        ((box(10), box(1).at(0, 4, 4)), ["“b” lies inside “a”, all of its 1 mm³."]),  # and meets its wall
        ((box(10) - box(8).at(1, 1, 1), box(2).at(4, 4, 4)), []),  # in a cavity
        ((box(10) - box(8).at(1, 1, 1), box(8).at(1, 1, 1)), []),  # filling it
        ((box(10), box(4).at(8)), ["“a” and “b” overlap by 32 mm³."]),
    ],
)
def test_touching_coincident_and_nested_solids_in_words(solids, expected):
    assert words(document_of(**dict(zip("ab", solids, strict=True)))) == expected


def test_open_empty_failed_and_endless_solids_are_told_and_the_rest_is_checked(sheet):
    document = document_of(sheet=sheet, void=box(1) - box(3), ground=halfspace(), bad=box("1 / 0"), a=box(10), b=box(9))
    report = check_document(document, TOLERANCE)
    assert [remark_words(remark) for remark in report.remarks] == [
        "“sheet” is not closed: gaps to it are found, overlaps only once its holes are filled. It meets “a” and “b”.",
        "“void” is empty: there is nothing of it to check.",
        "“ground” is not checked, since it failed: goes on without end: intersect the half-space with something that "
        "has one.",
        "“bad” is not checked, since it failed: “1 / 0” divides by zero.",
    ]
    assert [remark.kind for remark in report.remarks] == ["open", "empty", "unbounded", "failed"]
    assert [finding_words(finding) for finding in report.findings] == ["“b” lies inside “a”, all of its 729 mm³."]
    near = words(document_of(sheet=sheet, a=box(10)), clearance=1)
    assert near == ["“sheet” and “a” meet, and may overlap, since one is not closed; 1 mm is asked."]


def test_few_solids_in_words():
    for document, told in ((document_of(), "none"), (document_of(box(1)), "one")):
        assert report_words(check_document(document, TOLERANCE)).endswith(f"there is {told}.")
    fine = check_document(document_of(box(1), box(1).at(3)), TOLERANCE)
    assert report_words(fine) == "1 pair of solids, no overlaps asked: all in order."


def test_only_what_changed_is_looked_at_again():
    document = document_of(*[box(10).at(9 * place) for place in range(8)])
    memo = PairMemo()
    assert len(check_document(document, TOLERANCE, memo=memo).findings) == 7 == memo.looked_at
    renamed = rename(document, "n1", "first")
    assert check_document(renamed, TOLERANCE, memo=memo).findings[0].names[0] == "first" and memo.looked_at == 7
    moved = move(document, "n1", 0, 1, 0)
    check_document(moved, TOLERANCE, memo=memo)
    assert memo.looked_at == 8
    wider = check_document(moved, TOLERANCE, Checks(20), memo)
    fresh = check_document(moved, TOLERANCE, Checks(20))
    assert [finding_words(one) for one in wider.findings] == [finding_words(one) for one in fresh.findings]
    again = check_document(moved, TOLERANCE, Checks(8), memo)  # of the wider answers those that count
    assert len(again.findings) == len(check_document(moved, TOLERANCE, Checks(8)).findings)


def test_answers_do_not_depend_on_the_order_of_the_solids():
    inner, outer, beside = box(2).at(3, 3, 3), box(10), sphere(3).at(14, 5, 5)
    memo = PairMemo()
    one = check_document(document_of(a=inner, b=outer, c=beside), TOLERANCE, Checks(2), memo).findings
    other = check_document(document_of(c=beside, b=outer, a=inner), TOLERANCE, Checks(2), memo).findings
    assert [finding.kind for finding in one] == ["inside", "apart"] and other[0].kind == "around"
    assert one[1].points == pytest.approx(other[1].points[::-1])
    assert one[1].points[0][0] == 10


def test_the_worker_sends_the_overlaps_and_can_be_stopped(listener):
    document = document_of(a=box(10), b=box(10).at(8), c=box(1).at(0, 0, 10.2))
    request = listener.lane.check_pairs(set_clearance(document, 0.5), TOLERANCE)
    report = listener.wait_for(PairsChecked, request=request).report
    assert [finding.fault for finding in report.findings] == ["overlap", "near"]
    body = report.findings[0].body
    assert body.vertices[body.triangles].reshape(-1, 3).min(axis=0) == pytest.approx((8, 0, 0))
    assert report.findings[1].body is None
    crowd = document_of(*[sphere(9).at(k % 8, k // 8 % 8, k // 64) for k in range(200)])
    long = listener.lane.check_pairs(crowd, TOLERANCE)
    listener.wait_for(Progress, request=long)
    listener.lane.stop_checking_pairs()
    listener.wait_for(PairsChecked, request=listener.lane.check_pairs(document, TOLERANCE))
    assert not any(isinstance(message, PairsChecked) and message.request == long for message in listener.seen)


def test_the_window_is_told_of_them(qtbot):
    parent = QObject()
    jobs = Jobs(lambda tell: Lane(tell, default_store().folder), parent)
    try:
        with qtbot.waitSignal(jobs.pairs_checked, timeout=60_000) as told:
            jobs.check_pairs(document_of(a=box(2), b=box(1)), TOLERANCE)
        assert [finding.ids for finding in told.args[0].findings] == [("n1", "n2")] and not jobs.checking_pairs
        with qtbot.waitSignal(jobs.pairs_checked) as told:
            jobs.check_pairs(document_of(a=box(2), b=box(1)), TOLERANCE)
            jobs.cancel()
        assert told.args == [None, "it was cancelled"]
    finally:
        jobs.close()


@pytest.mark.parametrize(
    ("one", "other", "expected"),
    [
        (box(10), box(10).at(13), "“a” and “b” are 3 mm apart."),
        (box(10), box(10).at(10, 10, 10), "“a” and “b” touch, and share no volume."),
        (box(10), box(10), "“a” and “b” are the same body in the same place: 1,000 mm³."),
        (box(10), box(2).at(4, 4, 4), "“b” lies inside “a”, all of its 8 mm³."),
        (box(2).at(0, 4, 4), box(10), "“a” lies inside “b”, all of its 8 mm³."),
        (box(10), box(10).at(9, 8), "“a” and “b” overlap by 20 mm³."),
        (box(10).hidden(), box(1) - box(3), "“b” is empty: there is nothing of it to check."),
    ],
)
def test_scripts_are_answered_in_words(one, other, expected):
    assert in_words(one.named("a"), other.named("b")) == expected


def test_scripts_are_answered_in_words_of_what_is_open_or_no_solid(sheet):
    told = in_words(sheet, box(10).named("b"))
    assert told == "“sheet” and “b” meet; whether they overlap cannot be told, since one is not closed."
    assert "goes on without end" in in_words(halfspace().named("a"), box(10))
    with pytest.raises(Refusal, match="an outline is none"):
        in_words(box(10), circle(5))


def test_of_very_many_findings_the_worst_are_told():
    document = document_of(*[box(1).at(1.5 * place) for place in range(20)], large=box(9).at(-4))
    report = check_document(document, TOLERANCE, Checks(100), most=10)
    assert (len(report.findings), report.left_out) == (10, 21 * 20 // 2 - 10)
    assert [finding.fault for finding in report.findings[:5]] == ["overlap"] * 4 + ["near"]
    assert report_words(report).endswith(": 4 overlap, 206 are too near. Here are the worst 10.")


def test_equal_solids_in_one_place_are_each_asked_what_is_asked_of_them():
    """Whichever clearance comes last, the larger one is heard."""
    names = [("a", 5, "a2", 1), ("a", 1, "a2", 5)]
    for one, first, other, second in names:
        document = document_of(box(10).named(one), box(10).named(other), box(10).at(12).named("b"))
        document = with_clearance(with_clearance(document, first, one, "b"), second, other, "b")
        near = [(pair["a"], pair["b"]) for pair in clearances(document) if pair["relation"] == "apart"]
        assert near == [(one if first == 5 else other, "b")]
