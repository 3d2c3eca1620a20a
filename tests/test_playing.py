"""Motions of documents step by step: which step touches, by formula; shapes are cut once."""

import numpy as np
import pytest

from solidtree.model.document.document import Document
from solidtree.model.document.errors import Refusal
from solidtree.model.proximity.checks import Checks, PairCheck
from solidtree.model.proximity.moving.parts import MovingParts
from solidtree.model.proximity.moving.playing import play
from solidtree.model.script import (
    box,
    contacts_in_motion,
    cylinder,
    document_of,
    first_contact,
    motion,
    moved_by,
    parameter,
    penetration,
    sphere,
)


def crank(steps=36):
    """A piston on a crank of 20 mm that turns once, and a stop that it reaches at 16 mm from the middle."""
    t = parameter("t", 0)
    piston = box(10).at(-5, -5, 0).at(z=20 * parameter_sine(t)).named("piston")
    stop = box(10, 10, 4).at(-5, -5, 26).named("stop")
    return motion(document_of(piston, stop, cylinder(2, 5).at(60).named("far")), "turn", steps=steps, seconds=2)


def parameter_sine(t):
    from solidtree.model.document.expression import Expression

    return Expression("sin(t * 360)", t.declares)


def kinds(played, step):
    return {(played.names[t.one], played.names[t.other]): t.kind for t in played.touches[step]}


def test_a_piston_meets_its_stop_in_the_steps_that_the_sine_says():
    played = play(crank())
    heights = 20 * np.sin(np.radians(10.0 * np.arange(37)))
    for step, height in enumerate(heights):
        told = kinds(played, step)
        assert told == ({("piston", "stop"): "overlapping"} if height > 16 else {})
        if told:
            assert played.touches[step][0].overlap == pytest.approx(100 * min(height - 16, 4), rel=1e-9)
    first = played.first
    assert first is not None and first.time == pytest.approx(2 * np.degrees(np.arcsin(0.8)) / 360, abs=1e-6)
    assert first.place[2] == pytest.approx(26, abs=1e-3)
    assert played.moving.tolist() == [True, False, False] and not played.recut.any()


def test_two_gears_of_one_tooth_meet_in_the_steps_that_their_corners_say():
    t = parameter("t", 0)

    def gear(name, x, way, begin):
        tooth = box(12, 1, 4).at(0, -0.5, 0)
        return (cylinder(6, 4, segments=64) + tooth).turned(z=way * t * 360 + begin).at(x).named(name)

    document = motion(document_of(gear("one", 0, 1, -90), gear("other", 20, -1, -90)), "roll", steps=72)
    played = play(document)
    # They mirror each other in the plane half way between: they meet where a corner of the tooth is past it.
    away = np.radians(5.0 * np.abs(np.arange(73) - 18))
    past = (12 * np.cos(away) + 0.5 * np.sin(away) > 10) & (away < np.pi / 2)
    assert [bool(kinds(played, step)) for step in range(73)] == past.tolist()
    first = np.degrees(np.arccos(10 / np.hypot(12, 0.5)) + np.arctan2(0.5, 12))
    assert played.first is not None and played.first.time == pytest.approx(4 * (90 - first) / 360, abs=1e-5)


def test_pairs_are_asked_what_the_checks_ask():
    t = parameter("t", 0)
    document = motion(document_of(box(10).at(t * 10).named("a"), box(10).at(25).named("b")), "go", steps=10)
    a, b = (root.id for root in document.solids)
    assert not any(play(document).touches)
    near = play(document.with_(checks=Checks(7.5)))
    assert [bool(listed) for listed in near.touches] == [False] * 8 + [True] * 3
    assert near.touches[10][0].kind == "apart" and near.touches[10][0].gap == pytest.approx(5)
    own = play(document.with_(checks=Checks(7.5, (PairCheck(a, b, 6.5),))))
    assert [bool(listed) for listed in own.touches] == [False] * 9 + [True] * 2
    document = motion(document_of(box(10).at(t * 10).named("a"), box(10).at(15).named("b")), "go", steps=10)
    a, b = (root.id for root in document.solids)
    played = play(document)
    assert [kinds(played, step) for step in (4, 5, 6)] == [{}, {("a", "b"): "touching"}, {("a", "b"): "overlapping"}]
    meant = play(document.with_(checks=Checks(0, (PairCheck(a, b, touching=True),))))
    assert [bool(listed) for listed in meant.touches] == [False] * 6 + [True] * 5


def test_what_is_quicker_than_the_steps_is_found_between_them():
    t = parameter("t", 0)
    scene = document_of(sphere(1).at(t * 1000).named("ball"), box(0.01, 30, 30).at(501, -15, -15).named("wall"))
    document = motion(scene, "shot", steps=5, seconds=1)
    played = play(document)
    assert played.first is None and not any(played.touches)
    first = play(document, between=True).first
    assert first is not None and first.time == pytest.approx(0.5, abs=1e-6)


def test_a_whole_turn_between_two_steps_is_none_that_stands_still():
    """A bar that turns once meets a post behind it after half a turn."""
    t = parameter("t", 0)
    bar, post = box(10, 2, 2).at(0, -1).turned(z=t * 360).named("bar"), box(1).at(-8, -0.5).named("post")
    first = play(motion(document_of(bar, post), "turn", steps=1), between=True).first
    assert first is not None and (first.one, first.other) == (0, 1)
    reach = np.hypot(7.0, 0.5)  # of the post's near corners, at which the bar's side, 1 mm off its middle, arrives
    angle = 180 - np.degrees(np.arctan2(0.5, 7.0)) - np.degrees(np.arcsin(1 / reach))
    assert first.time == pytest.approx(4 * angle / 360, abs=2e-3)


def test_parts_that_grow_into_each_other_have_a_first_contact():
    t = parameter("t", 0)
    scene = document_of(box(1 + t * 30, 2, 2).named("grows"), box(2).at(15).named("stands"))
    first = play(motion(scene, "growth", seconds=4)).first
    assert first is not None and first.time == pytest.approx(4 * 14 / 30, abs=4 / 50 / 1000)
    assert first.place[0] == pytest.approx(15, abs=1e-2)


def test_what_touches_and_then_goes_in_meets_when_it_does():
    t = parameter("t", 0)
    scene = document_of(box(10).at(t * 5).named("goes"), box(10).at(10).named("stands"))
    one, other = (root.id for root in scene.solids)
    first = play(motion(scene.with_(checks=Checks(0, (PairCheck(one, other, touching=True),))), "push")).first
    assert first is not None and first.time == pytest.approx(0, abs=1e-3)


def test_what_slides_a_hair_above_a_plate_is_told_of_all_the_same():
    t = parameter("t", 0)
    plate = (box(100, 10, 2) + box(2, 10, 20).at(20)).named("plate")
    first = play(motion(document_of(box(3).at(t * 40, 3, 2 + 6e-5), plate), "slide", steps=1), between=True).first
    assert first is not None and first.time < 4 * 17 / 40


def test_only_what_changes_its_shape_is_cut_again():
    t = parameter("t", 1)
    document = motion(
        document_of(
            (box(9) - sphere(3)).turned(z=t * 40).at(t * 5).named("moves"),
            cylinder(2, 5 + t).at(50).named("grows"),
            box(3).scaled(1 + t).at(90).named("swells"),
            (box(9) - sphere(3)).at(-50).named("stands"),
        ),
        "all", start=1, end=2, steps=4,
    )  # fmt: skip
    parts = MovingParts(document, document.motions[0], 0.05)
    parts.at_rest()
    assert len(parts.bodies) == 3  # one shape stands in two places
    played = play(document)
    assert played.recut.any(axis=0).tolist() == [False, True, True, False]
    assert played.moving.tolist() == [True, True, True, False]
    place = played.moves[4, 0, :3] @ [5.0, 0, 0, 1.0]  # the middle of the turn, at rest where t is 1
    assert place == pytest.approx([10, 0, 0])
    between = played.move(0.125)[0]
    assert np.degrees(np.arctan2(between[1, 0], between[0, 0])) == pytest.approx(5)


def test_the_document_stays_and_no_motion_is_refused_in_words():
    document = crank()
    before = document.parameters
    play(document)
    assert document.parameters is before
    with pytest.raises(Refusal, match="holds no motion"):
        play(Document())
    with pytest.raises(Refusal, match="no motion called “x”, but turn"):
        play(document, "x")
    two = motion(document, "again")
    with pytest.raises(Refusal, match="name one of the motions: turn, again"):
        play(two)
    with pytest.raises(Refusal, match="there is no such parameter"):
        play(document.with_(motions=(document.motions[0].with_(parameter="q"),)))


def test_scripts_ask_the_same():
    told = contacts_in_motion(crank())
    assert (told["first"]["a"], told["first"]["b"]) == ("piston", "stop") and told["moving"] == ["piston"]
    assert len(told["steps"]) == 37 and told["steps"][9]["contacts"][0]["relation"] == "overlapping"
    found = first_contact(sphere(1), [box(2).at(9, -1, -1), box(2).at(5, -1, -1)], [moved_by(), moved_by(20)])
    assert found is not None and found.other == 1 and found.time == pytest.approx(0.2, abs=1e-5)
    way = penetration(box(10), box(10).at(8, 1))
    assert way is not None and way.depth == pytest.approx(2) and way.exact
    assert penetration(box(10), box(10).at(20)) is None
    with pytest.raises(Refusal, match="“lid” has no surface"):
        penetration(box(1), (box(2) - box(9).at(-1, -1, -1)).named("lid"))
