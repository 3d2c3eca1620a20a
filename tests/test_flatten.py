"""Flattening: within the tolerance everywhere, ends exact, whole paths at once."""

from __future__ import annotations

import numpy as np
import pytest
from manifold3d import CrossSection, FillRule

from solidtree.model.curve.bezier import evaluated
from solidtree.model.document.errors import Refusal
from solidtree.model.path.flatten import chords, flatten
from solidtree.model.path.path import Path
from solidtree.model.path.shapes import ellipse, rectangle
from solidtree.model.spline.bspline import BSpline
from solidtree.model.spline.bspline import evaluated as on_spline


def apart(points: np.ndarray, line: np.ndarray) -> np.ndarray:
    """(k,) how far points are from a polyline, by brute force."""
    along = np.diff(line, axis=0)
    way = points[:, None] - line[:-1]
    share = np.clip((way * along).sum(-1) / np.maximum((along**2).sum(-1), 1e-300), 0.0, 1.0)
    return np.linalg.norm(way - share[..., None] * along, axis=-1).min(axis=1)


@pytest.mark.parametrize("tolerance", [1.0, 1e-2, 1e-4])
def test_no_point_of_the_curve_is_further_away_than_the_tolerance(tolerance: float) -> None:
    random = np.random.default_rng(5)
    t = np.linspace(0.0, 1.0, 301)
    for count, name in ((3, "quad"), (4, "cubic")):
        for controls in random.normal(0.0, 10.0, (12, count, 2)):
            path = Path.of_commands([("move", controls[0]), (name, *controls[1:])])
            line = flatten(path, tolerance)[0]
            assert (line[[0, -1]] == controls[[0, -1]]).all()
            assert apart(evaluated(controls, t), line).max() <= tolerance


def test_rational_splines_keep_the_tolerance_however_uneven_their_weights() -> None:
    random = np.random.default_rng(6)
    for _ in range(8):
        weights = 10.0 ** random.uniform(-1.5, 1.5, 7)
        knots = [0, 0, 0, 0, 0.2, 0.5, 0.5, 1, 1, 1, 1]
        spline = BSpline(random.normal(0.0, 10.0, (7, 2)), 3, np.array(knots), weights)
        path = Path.of_commands([("move", spline.points[0]), ("spline", spline)])
        assert apart(on_spline(spline, np.linspace(0.0, 1.0, 2001)), flatten(path, 0.01)[0]).max() <= 0.01


def test_contours_of_all_kinds_come_apart_and_fill_what_they_should() -> None:
    ring = Path((*rectangle(10, 8, 2).contours, *ellipse((5, 4), 2, exact=True).contours), "evenodd")
    polygons = flatten(ring, 1e-4)
    assert len(polygons) == 2
    assert all((polygon[0] != polygon[-1]).any() for polygon in polygons)
    area = CrossSection(polygons, FillRule.EvenOdd).area()
    # The corners' cubics reach out by less than 3e-4 of their radius.
    assert area == pytest.approx(80.0 - 16.0 + 4.0 * np.pi - 4.0 * np.pi, abs=1e-4 * 50.0 + 3e-4 * 2.0 * 4.0 * np.pi)


def test_an_open_contour_keeps_its_end_and_a_line_is_two_points() -> None:
    path = Path.of_commands([("move", (0, 0)), ("line", (1, 0)), ("move", (5, 5)), ("line", (6, 5)), ("close",)])
    assert [len(line) for line in flatten(path, 0.1)] == [2, 2]
    assert flatten(Path(()), 0.1) == []


def test_chords_tell_where_on_the_path_their_points_lie() -> None:
    knots = np.array([0.0, 0, 0, 1, 3, 3, 3])
    spline = BSpline(np.array([(0.0, 0.0), (3.0, 5.0), (6.0, -5.0), (9.0, 0.0)]), 2, knots)
    cubic = np.array([(9.0, 0.0), (9.0, 9.0), (0.0, 9.0), (2.0, 2.0)])
    commands = [("move", (0, 0)), ("spline", spline), ("cubic", *cubic[1:]), ("close",), ("move", (20, 0))]
    found = chords(Path.of_commands([*commands, ("line", (21, 0))]), 1e-3)
    assert found.starts.tolist() == [0, len(found.points) - 2, len(found.points)]
    on = found.segment == 0
    assert np.allclose(found.points[on], on_spline(spline, 3.0 * found.parameter[on]), rtol=0.0, atol=1e-12)
    on = found.segment == 1
    assert np.allclose(found.points[on], evaluated(cubic, found.parameter[on]), rtol=0.0, atol=1e-12)
    assert found.segment[-2:].tolist() == [3, 3]
    assert found.parameter[-2:].tolist() == [0.0, 1.0]
    assert (found.points[found.starts[1] - 1] == found.points[0]).all()


@pytest.mark.parametrize("tolerance", [0.0, -1.0, np.nan, np.inf, 1e-300])
def test_tolerances_that_make_no_sense_are_refused(tolerance: float) -> None:
    with pytest.raises(Refusal, match="tolerance"):
        flatten(ellipse((0, 0), 10), tolerance)
