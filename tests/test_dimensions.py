"""Dimensions of a bounding box: figures, places and lengths by formula."""

import numpy as np
import pytest

from solidtree.model.drafting.dimensions import ARROW, OFFSET, box_dimensions, dimension_words
from solidtree.model.drafting.page import Fill, Strokes, Text, box_of
from solidtree.model.drawing.projection import standard

BOX = np.array([[0.0, 0.0, 0.0], [30.0, 20.0, 10.0]])
SIDES = {"front": (30, 10), "top": (30, 20), "left": (20, 10), "back": (30, 10)}


def parts(items, kind):
    return [item for item in items if isinstance(item, kind)]


@pytest.mark.parametrize(("view", "sizes"), SIDES.items())
def test_a_view_along_an_axis_has_its_two_lengths_beside_it(view, sizes):
    items = box_dimensions(standard(view, BOX), BOX, 2.0)
    assert {text.words for text in parts(items, Text)} == {str(size) for size in sizes}
    half = np.array(sizes, float)  # 2:1, from the middle
    for strokes, text in zip(parts(items, Strokes), parts(items, Text), strict=True):
        start, end = strokes.lines[-1]
        assert np.linalg.norm(end - start) == pytest.approx(2.0 * float(text.words))
        outside = np.abs(np.array([start, end])).max(axis=0) - half
        assert outside.max() == pytest.approx(OFFSET) and outside.min() == pytest.approx(0.0)
    assert len(parts(items, Fill)) == 4
    assert all(area(arrow.contours[0]) == pytest.approx(ARROW / 2.0) for arrow in parts(items, Fill))


def area(points):
    x, y = points.T
    return 0.5 * abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1)))


def test_a_view_from_a_corner_has_the_three_true_lengths_outside_the_box():
    projection = standard("iso", BOX)
    items = box_dimensions(projection, BOX, 1.0)
    texts = parts(items, Text)
    assert sorted(text.words for text in texts) == ["10", "20", "30"]
    corners = np.array([[x, y, z] for x in (0, 30) for y in (0, 20) for z in (0, 10)], float)
    flat = projection.picture(corners)[:, :2]
    for strokes in parts(items, Strokes):
        start, end = strokes.lines[-1]
        along = (end - start) / np.linalg.norm(end - start)
        side = np.array([-along[1], along[0]])
        reach = flat @ side
        place = float(start @ side)
        assert min(abs(place - reach.min()), abs(place - reach.max())) == pytest.approx(OFFSET)
        assert not reach.min() < place < reach.max()
    for text in texts:
        assert -90 < text.angle <= 90  # to be read from below or from the right


def test_where_there_is_no_room_between_the_arrows_the_figure_stands_beside_them():
    flat = np.array([[0.0, 0.0, 0.0], [0.5, 20.0, 10.0]])
    items = box_dimensions(standard("front", flat), flat, 1.0, {0: (0.0, -1.0)})
    (text,) = parts(items, Text)
    arrows = np.concatenate([arrow.contours[0] for arrow in parts(items, Fill)])
    assert text.words == "0.5" and text.at[0] > arrows[:, 0].max() - 1e-9 - ARROW
    assert box_of([text])[0, 0] >= 0.25 + ARROW  # right of the right arrow
    assert len(parts(items, Fill)) == 2


def test_figures_have_two_decimals_at_most_and_flat_boxes_their_lengths():
    assert [dimension_words(v) for v in (12.346, 12.3, 12.0, 1200.0)] == ["12.35", "12.3", "12", "1200"]
    flat = np.array([[0.0, 0.0, 5.0], [30.0, 20.0, 5.0]])
    assert {t.words for t in parts(box_dimensions(standard("top", flat), flat, 1.0), Text)} == {"30", "20"}
    assert {t.words for t in parts(box_dimensions(standard("front", flat), flat, 1.0), Text)} == {"30"}
