"""Contours of outlines in a document: broken, joined, closed, split."""

import numpy as np
import pytest
from curve_session import LEAF, contour, curves, moved_by, one, refused, session

from solidtree.model.document.from_outlines import Extrude
from solidtree.model.document.tree import find
from solidtree.model.scripting.outlines import path


def test_breaking_and_joining_gives_the_curve_back():
    work = one(path(LEAF))
    start = find(work.document, "n1")
    work.do("break_path", "n1", [(0, 1), (0, 3)])
    assert [one.closed for one in curves(work).contours] == [False, False]
    assert moved_by(start, work) == 0.0
    work.do("join_nodes", "n1", (0, 0), (1, 2))
    assert len(curves(work).contours) == 1 and len(contour(work)) == 4
    work.do("join_nodes", "n1", (0, 0), (0, 4))
    assert contour(work).closed and len(contour(work)) == 4
    assert moved_by(start, work) == 0.0
    refused(work, "is no end", "join_nodes", "n1", (0, 0), (0, 2))


@pytest.mark.parametrize(("first", "second"), [((0, 0), (1, 0)), ((0, 0), (1, 1)), ((0, 1), (1, 0)), ((0, 1), (1, 1))])
def test_any_two_ends_are_joined_by_a_line_or_into_one(first, second):
    work = one(path("M 0 0 L 10 0 M 0 5 L 10 5"))
    ends = [contour(work, number).places[row] for number, row in (first, second)]
    work.do("join_nodes", "n1", first, second)
    (joined,) = curves(work).contours
    assert len(joined) == 3 and sorted(joined.places[1:3].tolist()) == sorted(np.array(ends).tolist())
    work.undo()
    work.do("join_nodes", "n1", first, second, merge=True)
    (joined,) = curves(work).contours
    assert len(joined) == 2 and joined.places[1].tolist() == np.mean(ends, axis=0).tolist()


def test_closing_and_reversing():
    work = one(path("M 0 0 H 10 V 10 M 20 0 H 30 V 10 Z"))
    work.do("close_contours", "n1")
    assert [one.closed for one in curves(work).contours] == [True, True]
    refused(work, "closed already", "close_contours", "n1")
    areas = [one.area() for one in curves(work).contours]
    work.do("reverse_contours", "n1", [1])
    assert [one.area() for one in curves(work).contours] == [areas[0], -areas[1]]
    work.do("reverse_contours", "n1")
    assert [one.area() for one in curves(work).contours] == [-areas[0], areas[1]]


def test_segments_change_their_kind():
    work = one(path(LEAF))
    start = find(work.document, "n1")
    work.do("set_segments", "n1", [(0, 2), (0, 3)], "cubic")
    assert find(work.document, "n1").segments == "MCCCc" and moved_by(start, work) < 1e-12
    work.do("set_segments", "n1", [(0, 0), (0, 1)], "line")
    assert find(work.document, "n1").segments == "MLLCc"
    refused(work, "line, quad or cubic", "set_segments", "n1", [(0, 0)], "arc")


def test_islands_become_outlines_with_their_holes():
    frame = "M 0 0 H 30 V 30 H 0 Z M 5 5 V 25 H 25 V 5 Z"
    inner = " M 10 10 H 20 V 20 H 10 Z M 100 0 H 110 V 10 H 100 Z M 0 50 L 10 50"
    work = one(path(frame + inner, even_odd=True).named("Sign").coloured("red").at(0, 0, 4))
    area = abs(curves(work).contours[0].area()) - 400
    work.do("split_outline", "n1")
    parts = work.document.profiles
    assert [part.name for part in parts] == ["Sign", "Sign 2", "Sign 3", "Sign 4"]
    assert all(part.colour == parts[0].colour and part.placement == parts[0].placement for part in parts)
    assert [len(curves(work, part.id).contours) for part in parts] == [2, 1, 1, 1]
    assert area == 500
    refused(work, "of one piece", "split_outline", "n1")


def test_by_winding_number_a_hole_runs_the_other_way_and_what_does_not_belongs_to_what_is_around():
    work = one(path("M 0 0 H 30 V 30 H 0 Z M 5 5 H 25 V 25 H 5 Z M 50 0 H 60 V 10 H 50 Z M 52 2 V 8 H 58 V 2 Z"))
    work.do("split_outline", "n1")
    assert [len(curves(work, part.id).contours) for part in work.document.profiles] == [2, 2]


def test_an_outline_within_a_solid_is_not_split():
    solid = Extrude(id="n2", name="Part", children=(path("M0 0H1V1Z M5 0H6V1Z").with_(id="n1"),))
    refused(session(solids=(solid,)), "as one outline", "split_outline", "n1")


def test_contours_are_added_as_scripts_write_paths():
    work = one(path("M 0 0 H 10 V 10 Z"))
    work.do("set_joints", "n1", [(0, 0)], "smooth")
    kinds = contour(work).nodes.tolist()
    work.do("add_contour", "n1", "M 2 2 h 3 v 3 z")
    work.do("add_contour", "n1", [("move", (20, 0)), ("quad", (25, 5), (30, 0))])
    assert [len(one) for one in curves(work).contours] == [3, 3, 1]
    assert contour(work).nodes.tolist() == kinds
    refused(work, "nothing to add", "add_contour", "n1", [])
    refused(work, "coordinates", "add_contour", "n1", [("move", (0, 0, 0)), ("line", (1, 1, 1))])
