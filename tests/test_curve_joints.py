"""Joints of outlines in a document become what the report then says."""

import numpy as np
import pytest
from curve_session import contour, one, refused

from solidtree.model.document.outlines import Circle, Path
from solidtree.model.path.continuity import report
from solidtree.model.path.path import Kind
from solidtree.model.scripting.outlines import path

WILD = "M 0 0 C 8 -6 18 -2 20 6 C 26 14 22 30 10 31 C 0 36 -9 28 -10 20 Q -14 6 0 0 Z"


@pytest.mark.parametrize(
    ("operation", "grade"), [("smooth_joints", 1), ("harmonise_joints", 2), ("match_curvature", 2)]
)
def test_joints_become_what_the_report_then_says(operation, grade):
    work = one(path(WILD))
    assert all(joint.geometric == 0 for joint in report(contour(work)))
    work.do(operation, "n1", [(0, 1), (0, 2)])
    joints = report(contour(work))
    assert [joint.geometric >= grade for joint in joints] == [True, True, False, False]


@pytest.mark.parametrize(("operation", "grade"), [("smooth_joints", 1), ("harmonise_joints", 2)])
def test_all_joints_at_once_also_beside_a_quadratic_which_becomes_a_cubic(operation, grade):
    work = one(path(WILD))
    work.do(operation, "n1", [(0, i) for i in range(4)])
    assert all(joint.geometric >= grade for joint in report(contour(work)))
    assert set(contour(work).kinds.tolist()) == {Kind.CUBIC}


def test_all_joints_around_are_harmonised_and_told_that_they_cannot_be_matched():
    work = one(Circle(radius=10))
    work.do("convert_to_path", "n1")
    work.do("move_nodes", "n1", [(0, 0)], (4, 3))
    assert any(joint.geometric < 2 for joint in report(contour(work)))
    refused(work, "fewer joints, or harmonise", "match_curvature", "n1", [(0, i) for i in range(4)])
    work.do("match_curvature", "n1", [(0, 0)])
    assert report(contour(work))[-1].geometric == 2
    work.do("harmonise_joints", "n1", [(0, i) for i in range(4)])
    assert [joint.geometric for joint in report(contour(work))] == [2] * 4


def test_joints_beside_lines_splines_and_ends():
    work = one(path("M 0 0 H 10 C 12 4 18 8 20 0"))
    work.do("smooth_joints", "n1", [(0, 1)])
    assert contour(work).points[2, 1] == pytest.approx(0, abs=1e-12)  # the handle follows the line
    refused(work, "a line has no curvature", "harmonise_joints", "n1", [(0, 1)])
    refused(work, "an end of an open curve", "smooth_joints", "n1", [(0, 2)])
    spline = (3, (0.0, 0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0, 1.0), ())
    drawn = Path(
        points=((0, 0), (0, 0), (3, 5), (6, 8), (9, 8), (12, 5), (13, 1), (20, -8), (25, 0)),
        segments="MSC",
        splines=(spline,),
    )
    work = one(drawn)
    old = contour(work).splines[0].points
    work.do("match_curvature", "n1", [(0, 1)])
    assert report(contour(work))[0].geometric == 2
    assert np.array_equal(contour(work).splines[0].points, old)
    refused(work, "match the curvature instead", "harmonise_joints", "n1", [(0, 1)])
