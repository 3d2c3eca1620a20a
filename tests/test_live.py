"""Contacts of dragged parts, and how far they come: by formula."""

import numpy as np
import pytest

from solidtree.model.document.placement import turn_about
from solidtree.model.partition.native import available
from solidtree.model.proximity.live import LiveContacts
from solidtree.model.proximity.parts import Part
from solidtree.model.script import box, cylinder, document_of, sphere
from solidtree.model.solid.results import arrays_of, evaluate_document

HERE = (0.0, 0.0, 0.0)
SOLIDS = {}
"""Of the parts that were made last, by key."""


def part(key, solid):
    (result,) = evaluate_document(document_of(solid)).solids
    SOLIDS[key] = result.solid
    return Part(key, *arrays_of(result.mesh()))


def at(*by):
    pose = np.eye(4)
    pose[:3, 3] = by
    return pose


def told(contacts):
    return {contact.standing.key: (contact.kind, pytest.approx(contact.gap, abs=1e-9)) for contact in contacts}


def overlap(moving, standing, pose):
    """The volume that both share, by a boolean."""
    return (SOLIDS[moving.key].transform(pose[:3]) ^ SOLIDS[standing.key]).volume()


def test_spheres_meet_where_their_middles_are_two_radii_apart():
    one, other = part("one", sphere(10, segments=128)), part("other", sphere(10, segments=128).at(40, 0, 0))
    live = LiveContacts([one], [other], reach=15.0)
    (contact,) = live.contacts(at(-10, 0, 0))
    assert contact.kind == "near" and contact.gap == pytest.approx(10.0, abs=0.02)
    assert contact.points == pytest.approx(np.array([[10, 0, 0], [20, 0, 0]]), abs=0.02)
    gone, stop = live.stopped(HERE, (-60.0, 0.0, 0.0))
    assert gone == pytest.approx([-20.0, 0.0, 0.0], abs=0.02) and stop is not None
    assert told(live.contacts(at(*gone))) == {"one": ("touches", 0.0)} and overlap(other, one, at(*gone)) < 1e-9
    # Askew: middles at (40, 12, 0) + t (-1, 0, 0), which are 20 apart where 40 - t is 16.
    live = LiveContacts([one], [part("other", sphere(10, segments=128).at(40, 12, 0))])
    assert live.stopped(HERE, (-60.0, 0.0, 0.0))[0][0] == pytest.approx(-24.0, abs=0.05)


def test_kinds_of_contact_by_distance_and_clearance():
    plate, block = part("plate", box(50, 50, 10)), part("block", box(10).at(20, 20, 12))
    live = LiveContacts([plate], [block], lambda one, other: 1.0, reach=3.0)
    kinds = {z: [c.kind for c in live.contacts(at(0, 0, z))] for z in (2.0, 0.0, -1.5, -2.0, -2.001, -11.0)}
    assert kinds == {2.0: [], 0.0: ["near"], -1.5: ["close"], -2.0: ["touches"], -2.001: ["overlaps"],
                     -11.0: ["overlaps"]}  # fmt: skip
    inner = part("inner", box(2).at(4, 4, 4))
    assert [c.kind for c in LiveContacts([plate], [inner]).contacts(np.eye(4))] == ["overlaps"]
    hollow = part("hollow", box(20) - box(10).at(5, 5, 5))
    assert LiveContacts([hollow], [part("loose", box(2).at(9, 9, 9))]).contacts(np.eye(4)) == ()


def test_a_box_slides_over_a_floor_at_its_height_and_into_the_corner():
    floor = part("floor", box(100, 100, 10).at(0, 0, -10))
    walls = [part("east", box(10, 100, 50).at(50, 0, 0)), part("north", box(100, 10, 50).at(0, 60, 0))]
    block = part("block", box(10).at(20, 20, 5))
    live = LiveContacts([floor, *walls], [block])
    assert live.stopped(HERE, (15.0, 0.0, -15.0))[0] == pytest.approx([5.0, 0.0, -5.0])
    assert live.slid(HERE, (15.0, 0.0, -15.0))[0] == pytest.approx([15.0, 0.0, -5.0], abs=1e-12)
    corner, _ = live.slid(HERE, (200.0, 200.0, -200.0))
    assert corner == pytest.approx([20.0, 30.0, -5.0], abs=1e-12)
    assert {c.standing.key: c.kind for c in live.contacts(at(*corner))} == dict.fromkeys(
        ("floor", "east", "north"), "touches"
    )
    # What lies on the floor slides on it, and away from it.
    down = (0.0, 0.0, -5.0)
    assert live.slid(down, (7.0, 3.0, 0.0))[0] == pytest.approx([7.0, 3.0, 0.0], abs=1e-12)
    assert live.slid(down, (1.0, 0.0, 4.0))[0] == pytest.approx([1.0, 0.0, 4.0], abs=1e-12)
    assert live.stopped(down, (0.0, 0.0, -1e-3))[0] == pytest.approx([0.0, 0.0, 0.0], abs=1e-12)


def test_along_one_axis_nothing_slides_and_in_a_plane_only_within_it():
    ramp = part("ramp", box(100, 100, 10).turned(y=-30).at(20, -50, 0))
    ball = part("ball", box(4).at(0, 0, 20))
    live = LiveContacts([ramp], [ball])
    along = live.slid(HERE, (60.0, 0.0, 0.0), [[1.0, 0.0, 0.0]])[0]
    assert along == pytest.approx(live.stopped(HERE, (60.0, 0.0, 0.0))[0]) and 0.0 < along[0] < 60.0
    inside = live.slid(HERE, (60.0, 5.0, 0.0), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])[0]
    assert inside[2] == 0.0 and inside[0] == pytest.approx(along[0], abs=1e-9) and inside[1] == pytest.approx(5.0)
    up = live.slid(HERE, (60.0, 0.0, 0.0))[0]
    assert up[2] > 1.0 and (up[0] - along[0]) * np.tan(np.radians(30.0)) == pytest.approx(up[2], rel=1e-6)


def test_what_is_overlapped_at_first_is_left_freely_and_stops_from_then_on():
    wall, block = part("wall", box(10, 40, 40)), part("block", box(10).at(5, 5, 5))
    live = LiveContacts([wall], [block])
    assert [c.kind for c in live.begin()] == ["overlaps"]
    assert live.stopped(HERE, (20.0, 0.0, 0.0))[0] == pytest.approx([20.0, 0.0, 0.0])
    live.came_apart(live.contacts(at(20, 0, 0)))
    assert live.stopped((20.0, 0.0, 0.0), (-20.0, 0.0, 0.0))[0] == pytest.approx([-15.0, 0.0, 0.0])


def test_a_turn_ends_where_a_corner_meets_the_wall():
    wall, bar = part("wall", box(10, 100, 10).at(20, -50, 0)), part("bar", box(6, 40, 10).at(-3, -20, 0))

    def pose(angle):
        return np.vstack((turn_about((0.0, 0.0, 1.0), angle), [0, 0, 0, 1]))

    live = LiveContacts([wall], [bar])
    # The corner (3, 20) is at atan2(20, 3), 20.224 from the axis, and meets x = 20 turned by minus so much.
    first = np.degrees(np.arctan2(20.0, 3.0) - np.arccos(20.0 / np.hypot(3.0, 20.0)))
    angle = live.turned(pose, 0.0, -90.0, np.zeros(3))
    assert angle == pytest.approx(-first, abs=1e-9) and overlap(bar, wall, pose(angle)) < 1e-9
    assert live.turned(pose, 0.0, -60.0, np.zeros(3)) == -60.0
    # A part that lies on a floor turns on it.
    live = LiveContacts([part("floor", box(100).at(-50, -50, -100))], [bar])
    assert live.turned(pose, 0.0, 77.0, np.zeros(3)) == 77.0


@pytest.mark.skipif(not available(), reason="there is no compiled code here")
@pytest.mark.parametrize("seed", range(4))
def test_whatever_the_way_nothing_overlaps_at_its_end(seed):
    rng = np.random.default_rng(seed)
    standing = [
        part(f"s{k}", shape.turned(*rng.uniform(0, 90, 3)).at(*rng.uniform(-25, 25, 3)))
        for k, shape in enumerate([box(12, centred=True), cylinder(radius=5, height=16), sphere(8, segments=32)] * 3)
    ]
    moving = part("m", (box(8, centred=True) + cylinder(radius=2, height=12)).turned(20, 30, 40).at(0, 0, 60))
    live = LiveContacts(standing, [moving])
    assert not live.begin()
    start = np.array([0.0, 0.0, 60.0])
    by, stops = np.zeros(3), 0
    for _ in range(12):
        gone, stop = live.slid(by, rng.uniform(-25, 25, 3) - 0.3 * (by + start))
        by, stops = by + gone, stops + (stop is not None)
        assert max(overlap(moving, other, at(*by)) for other in standing) < 1e-9 * SOLIDS[moving.key].volume()
    assert stops
