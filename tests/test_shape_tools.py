"""Rectangles, ellipses, polygons, stars, arcs: what points and numbers make of them."""

import numpy as np
import pytest

from solidtree.gui.curves.drawing.draft import Held, Options
from solidtree.gui.curves.drawing.shape_tools import Arc, Ellipse, Polygon, Rectangle, Star
from solidtree.model.document.errors import Refusal
from solidtree.model.outline.paths import path_of
from solidtree.model.path.flatten import flatten

SHIFT, ALT = Held(shift=True), Held(alt=True)


def drawn(kind, *places, held=Held()):  # noqa: B008
    draft = kind(Options())
    for place in places:
        draft.hover(np.array(place, float), held)
        draft.press(np.array(place, float), held)
        draft.release(np.array(place, float), held, False)
    assert draft.complete
    return path_of(draft.node())


@pytest.mark.parametrize(
    ("kind", "held", "bounds"),
    [
        (Rectangle, Held(), [[-8, 2], [2, 7]]),
        (Rectangle, SHIFT, [[-8, 2], [2, 12]]),
        (Rectangle, ALT, [[-8, -3], [12, 7]]),
        (Ellipse, Held(), [[-8, -3], [12, 7]]),
        (Ellipse, ALT, [[-8, 2], [2, 7]]),
    ],
)
def test_boxes_by_two_points_and_the_keys_that_are_held(kind, held, bounds):
    found = drawn(kind, (2, 2), (-8, 7), held=held)
    assert found.bounds() == pytest.approx(np.array(bounds, float)) and found.area() > 0


def test_shift_draws_a_circle_through_the_pointer():
    (line,) = flatten(drawn(Ellipse, (1, 1), (4, 5), held=SHIFT), 1e-3)
    assert np.linalg.norm(line - (1, 1), axis=1) == pytest.approx(np.full(len(line), 5), abs=3e-3)


def test_what_has_no_size_is_refused():
    for kind in (Rectangle, Ellipse, Polygon, Star):
        draft = kind(Options())
        draft.press(np.zeros(2), Held())
        with pytest.raises(Refusal):
            draft.press(np.zeros(2), Held())
        assert not draft.complete


def test_one_radius_is_that_of_a_circle():
    draft = Ellipse(Options())
    draft.press(np.zeros(2), Held())
    assert draft.filled([7.0, None], False) == [7.0, 7.0]
    assert draft.filled([7.0, 3.0], False) == [7.0, 3.0]


def test_polygons_and_stars_point_at_the_pointer():
    (corners,) = drawn(Polygon, (0, 0), (0, 6)).contours
    assert len(corners) == 6 and corners.points[0] == pytest.approx([0, 6])
    (corners,) = drawn(Star, (0, 0), (6, 0)).contours
    assert len(corners) == 10 and np.hypot(*corners.points[1]) == pytest.approx(3)
    draft = Polygon(Options())
    draft.press(np.zeros(2), Held())
    draft.hover(draft.target([4.0, 30.0, 8.0], False), Held())
    assert len(path_of(draft.node()).contours[0]) == 8
    with pytest.raises(Refusal, match="3 to 1,000 sides"):
        draft.target([4.0, 30.0, 2.0], False)


@pytest.mark.parametrize("through", [(5, 2), (5, -2), (5, 40), (5, -40), (0, 1), (5, 0)])
def test_an_arc_goes_through_its_three_points(through):
    found = drawn(Arc, (0, 0), (10, 0), through)
    (line,) = flatten(found, 1e-4)
    (contour,) = found.contours
    assert contour.places[[0, -1]].tolist() == [[0, 0], [10, 0]]
    sides = line[1:] - line[:-1]
    share = np.clip(((through - line[:-1]) * sides).sum(1) / (sides**2).sum(1), 0, 1)
    off = np.linalg.norm(line[:-1] + share[:, None] * sides - through, axis=1).min()
    assert off < 3e-4 * max(np.ptp(line, axis=0).max(), 10)


def test_an_arc_by_its_radius():
    draft = Arc(Options())
    for place in ((0.0, 0.0), (8.0, 0.0)):
        draft.press(np.array(place), Held())
    draft.hover(np.array([4.0, -9.0]), Held())
    draft.hover(draft.target([5.0], False), Held())
    assert draft.pointer == pytest.approx([4, -2]) and draft.values(False) == pytest.approx([5])
    with pytest.raises(Refusal, match="4 mm or more"):
        draft.target([3.0], False)
