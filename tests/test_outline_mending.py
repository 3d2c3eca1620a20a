"""Outlines mended: ends that nearly meet are joined, whatever the curves; lines are cut where they cross."""

import numpy as np
import pytest

from solidtree.model.checking.document_faults import document_faults
from solidtree.model.operations.operations import OPERATIONS
from solidtree.model.outline.paths import path_of
from solidtree.model.path.path import Kind
from solidtree.model.script import Refusal, circle, document_of, path


def mended(outline, *arguments, **more):
    document = document_of(outline)
    after = OPERATIONS["repair_outline"](document, document.profiles[0].id, *arguments, **more)
    return after, path_of(after.profiles[0])


def test_ends_within_the_tolerance_are_joined_and_curves_stay_curves():
    loose = path("M 0 0 C 0 10 10 10 10 0 M 10.0004 0.0003 L 10 -5 M 0 0 L 0.0002 -5 L 10 -5")
    after, curves = mended(loose, tolerance=0.001)
    (contour,) = curves.contours
    assert contour.closed and sorted(contour.kinds.tolist()) == sorted([Kind.CUBIC, *[Kind.LINE] * 3])
    assert abs(curves.area()) == pytest.approx(50 + cubic_area(), abs=0.02)
    (report,) = document_faults(after)
    assert report.faults.sound and str(report) == "4 lines: nothing found"


def cubic_area():
    """Between the cubic (0 0) (0 10) (10 10) (10 0) and its chord: the integral of y dx."""
    x, y = np.polynomial.Polynomial([0, 0, 30, -20]), np.polynomial.Polynomial([0, 30, -30])
    return float((y * x.deriv()).integ()(1))


def test_what_is_farther_apart_stays_and_the_document_with_it():
    document = document_of(path("M 0 0 L 5 0 M 5.01 0 L 5 5"))
    assert OPERATIONS["repair_outline"](document, document.profiles[0].id) is document
    after = OPERATIONS["repair_outline"](document, document.profiles[0].id, tolerance=0.02)
    assert len(path_of(after.profiles[0]).contours) == 1 and after.profiles[0].id == document.profiles[0].id


def test_lines_that_overshoot_are_cut_and_the_square_between_them_closes():
    hatch = path("M 0 1 L 10 1 M 0 9 L 10 9 M 1 0 L 1 10 M 9 0 L 9 10")
    assert document_faults(document_of(hatch))[0].faults.crossings == 4
    after, curves = mended(hatch, ("cut", "weld"))
    closed = [contour for contour in curves.contours if contour.closed]
    assert len(closed) == 1 and abs(closed[0].area()) == pytest.approx(64)
    assert document_faults(after)[0].faults.crossings == 0
    assert sum(contour.length() for contour in curves.contours) == pytest.approx(40)


def test_a_line_drawn_twice_is_kept_once_and_closed_contours_are_left_alone():
    _, curves = mended(path("M 0 0 L 5 0 M 5 0 L 0 0 M 10 10 L 12 10 L 12 12 Z"))
    assert [contour.closed for contour in curves.contours] == [True, False]
    assert curves.contours[1].length() == pytest.approx(5)


def test_what_cannot_be_mended_is_refused_in_words():
    for outline, arguments, words in (
        (circle(5), (), "convert it to a path"),
        (path("M 0 0 C 1 5 4 5 5 0"), (("cut",),), "straight lines"),
        (path("M 0 0 L 5 0"), (("glue",),), "no repair of outlines; there are cut, weld"),
        (path("M 0 0 L 5 0"), (("weld",), -1), "tolerance"),
    ):
        with pytest.raises(Refusal, match=words):
            mended(outline, *arguments)
