"""Fitting: within the tolerance at every point, corners kept, curves that were cubics found again."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from solidtree.model.curve.bezier import evaluated
from solidtree.model.document.errors import Refusal
from solidtree.model.path.fitting import fit, stroke
from solidtree.model.path.path import Node


def circle(count: int, radius: float = 10.0) -> np.ndarray:
    angle = np.linspace(0.0, 2.0 * np.pi, count)
    return radius * np.stack((np.cos(angle), np.sin(angle)), axis=1)


def square(side: float, count: int) -> np.ndarray:
    corners = np.array([(0.0, 0.0), (side, 0.0), (side, side), (0.0, side), (0.0, 0.0)])
    return np.concatenate([np.linspace(a, b, count, endpoint=False) for a, b in pairwise(corners)])


def off(points: np.ndarray, controls: np.ndarray) -> float:
    """The largest distance of a point from the cubics, by dense sampling."""
    line = evaluated(controls, np.linspace(0.0, 1.0, 200)).reshape(-1, points.shape[1])
    along, way = np.diff(line, axis=0), points[::3, None] - line[:-1]
    share = np.clip((way * along).sum(-1) / np.maximum((along**2).sum(-1), 1e-300), 0.0, 1.0)
    return float(np.linalg.norm(way - share[..., None] * along, axis=-1).min(axis=1).max())


@pytest.mark.parametrize("tolerance", [1.0, 0.1, 1e-2])
def test_every_point_is_within_the_tolerance(tolerance: float) -> None:
    t = np.linspace(0.0, 6.0, 700)
    points = np.stack((20.0 * t, 10.0 * np.sin(3.0 * t) + t**2), axis=1)
    found = fit(points, tolerance)
    assert found.deviation <= tolerance
    assert off(points, found.controls) <= tolerance + 0.01 * tolerance
    assert (found.controls[0, 0] == points[0]).all() and (found.controls[-1, -1] == points[-1]).all()
    assert (found.controls[1:, 0] == found.controls[:-1, 3]).all()
    joints = found.controls[1:, 1] - found.controls[1:, 0], found.controls[:-1, 3] - found.controls[:-1, 2]
    cosines = (joints[0] * joints[1]).sum(1) / np.linalg.norm(joints[0], axis=1) / np.linalg.norm(joints[1], axis=1)
    assert cosines == pytest.approx(1.0, abs=1e-12)


def test_points_of_one_cubic_give_that_cubic() -> None:
    cubic = np.array([(0.0, 0.0), (5.0, 12.0), (14.0, 9.0), (20.0, 0.0)])
    # Uneven steps, so that lengths along the chords are no good guess of the parameters.
    found = fit(evaluated(cubic, np.linspace(0.0, 1.0, 401) ** 1.5), 1e-3)
    assert len(found.controls) == 1
    assert np.abs(found.controls[0] - cubic).max() < 0.05


def test_a_circle_takes_few_cubics_and_has_no_corner() -> None:
    found = fit(circle(1000), 0.01, closed=True)
    assert len(found.controls) <= 8
    assert not len(found.corners)
    assert (found.controls[-1, -1] == found.controls[0, 0]).all()


@pytest.mark.parametrize("turn", [0, 30])
def test_corners_stay_corners(turn: int) -> None:
    points = np.roll(square(10.0, 100), -turn, axis=0)
    found = fit(points, 0.05, closed=True)
    assert sorted((found.corners + turn) % 400) == [0, 100, 200, 300]
    assert len(found.controls) == 4
    assert found.deviation < 1e-12


def test_noise_below_the_tolerance_makes_no_corner() -> None:
    noise = np.random.default_rng(2).normal(0.0, 0.02, (1000, 2))
    path = stroke(circle(1000) + noise, 0.2, closed=True)
    assert set(path.contours[0].nodes.tolist()) == {Node.SMOOTH}
    assert path.area() == pytest.approx(100.0 * np.pi, rel=0.02)


def test_a_stroke_in_space_and_one_of_two_points() -> None:
    t = np.linspace(0.0, 4.0 * np.pi, 400)
    helix = np.stack((np.cos(t), np.sin(t), 0.3 * t), axis=1)
    path = stroke(helix, 1e-3)
    assert path.length() == pytest.approx(4.0 * np.pi * np.hypot(1.0, 0.3), rel=1e-3)
    line = fit([(0, 0), (0, 0), (3, 6), (3, 6)], 0.1).controls
    assert np.allclose(line[0], np.arange(4)[:, None] * np.array([1.0, 2.0]))


@pytest.mark.parametrize("points", [[], [(1, 1)], [(1, 1), (1, 1)], [(0, 0), (1, np.inf)], [1, 2, 3]])
def test_what_is_no_curve_is_refused(points: list) -> None:
    with pytest.raises(Refusal, match="curve"):
        fit(points, 0.1)


def test_a_tolerance_of_nought_is_refused() -> None:
    with pytest.raises(Refusal, match="tolerance"):
        fit([(0, 0), (1, 1)], 0.0)
