"""Offsets and strokes: distances by dense sampling, areas by formula, manifold3d's offset as the peer."""

from __future__ import annotations

import numpy as np
import pytest
from manifold3d import CrossSection, FillRule, JoinType

from solidtree.model.document.errors import Refusal
from solidtree.model.path.areas.offsetting import offset, outline
from solidtree.model.path.flatten import flatten
from solidtree.model.path.path import Contour, Kind, Path
from solidtree.model.path.shapes import ellipse, rectangle, star
from solidtree.model.spline.bspline import BSpline
from solidtree.model.spline.knots import clamped_knots

TOLERANCE = 1e-3
CIRCLE = ellipse((0, 0), 10, exact=True)
LOOP = Path.of_commands(
    [("move", (0, 0)), ("cubic", (30, 40), (-20, 40), (10, 0)), ("cubic", (40, -10), (30, -30), (0, 0)), ("close",)]
)
RING = Path((*ellipse((0, 0), 10).contours, *ellipse((0, 0), 5).contours), "evenodd")
WAVE = Path.of_commands(
    [("move", (0, 0)), ("cubic", (10, 20), (20, -20), (30, 0)), ("line", (30, 10)), ("quad", (20, 20), (10, 8))]
)
SHAPES = {
    "circle": CIRCLE,
    "rectangle": rectangle(20, 10, (0, 2, 0, 4)),
    "star": star(5, 10, 4),
    "loop": LOOP,
    "ring": RING,
}


def distances(points: np.ndarray, lines: list[np.ndarray]) -> np.ndarray:
    """(k,) how far points are from polylines, by brute force."""
    begin = np.vstack([line[:-1] for line in lines])
    along = np.vstack([np.diff(line, axis=0) for line in lines])
    found = np.empty(len(points))
    for start in range(0, len(points), 500):
        way = points[start : start + 500, None] - begin
        share = np.clip((way * along).sum(-1) / np.maximum((along**2).sum(-1), 1e-300), 0.0, 1.0)
        found[start : start + 500] = np.linalg.norm(way - share[..., None] * along, axis=-1).min(axis=1)
    return found


def closed_lines(path: Path, tolerance: float) -> list[np.ndarray]:
    lines = flatten(path, tolerance)
    pairs = zip(path.contours, lines, strict=True)
    return [np.vstack((line, line[:1])) if contour.closed else line for contour, line in pairs]


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("distance", [1.0, -0.7, -2.2])
def test_every_point_of_a_round_offset_is_at_its_distance(name: str, distance: float) -> None:
    path = SHAPES[name]
    found = offset(path, distance, TOLERANCE)
    source = closed_lines(path, 1e-4)
    points = np.vstack(flatten(found, TOLERANCE))[::2]
    # Where the curve folds over itself, distances are those to the boundary of what is filled.
    assert np.abs(distances(points, source) - abs(distance)).max() <= TOLERANCE + 1e-4
    filled = CrossSection(flatten(path, 1e-4), FillRule.EvenOdd if path.rule == "evenodd" else FillRule.NonZero)
    peer = filled.offset(distance, JoinType.Round, 2.0, 4000)
    assert found.area() == pytest.approx(peer.area(), abs=2.0 * TOLERANCE * found.length())
    assert len(found.contours) == len(
        [p for p in peer.to_polygons() if CrossSection([p], FillRule.NonZero).area() > 0.01]
    )


def test_offsets_of_circles_and_rectangles_by_formula() -> None:
    assert offset(CIRCLE, 2, 1e-4).area() == pytest.approx(144.0 * np.pi, abs=1e-4 * 24 * np.pi)
    assert offset(CIRCLE, -3, 1e-4).area() == pytest.approx(49.0 * np.pi, abs=1e-4 * 14 * np.pi)
    grown = offset(rectangle(20, 10), 1, 1e-5)
    assert grown.area() == pytest.approx(200.0 + 60.0 + np.pi, abs=1e-5 * 70)
    assert sorted(set(grown.contours[0].kinds.tolist())) == [Kind.LINE, Kind.CUBIC]
    assert offset(rectangle(20, 10), 1, 1e-5, "miter").area() == pytest.approx(22.0 * 12.0, abs=1e-9)
    assert offset(rectangle(20, 10), 1, 1e-5, "bevel").area() == pytest.approx(22.0 * 12.0 - 2.0, abs=1e-9)
    shrunk = offset(rectangle(20, 10), -2, 1e-5)
    assert shrunk.contours[0].kinds.tolist() == [Kind.LINE] * 4
    assert shrunk.area() == pytest.approx(16.0 * 6.0, abs=1e-9)


def test_offsets_stay_few_curves() -> None:
    assert len(offset(CIRCLE, 2, TOLERANCE).contours[0]) <= 16
    assert sum(map(len, offset(LOOP, 1, TOLERANCE).contours)) <= 30


def test_the_way_a_contour_runs_does_not_matter() -> None:
    assert offset(LOOP.reversed(), 1, TOLERANCE).area() == pytest.approx(offset(LOOP, 1, TOLERANCE).area(), abs=1e-2)
    grown = offset(RING, 1, TOLERANCE)
    areas = sorted(contour.area() for contour in grown.contours)
    assert areas == pytest.approx([-16.0 * np.pi, 121.0 * np.pi], abs=0.2)  # the hole runs clockwise


def test_shapes_that_grow_together_become_one_and_thin_ones_vanish() -> None:
    two = Path((*rectangle(4, 4).contours, *rectangle(4, 4, corner=(5, 0)).contours))
    assert len(offset(two, 0.4, TOLERANCE).contours) == 2
    assert len(offset(two, 0.6, TOLERANCE).contours) == 1
    merged = offset(two, 1.0, TOLERANCE, "miter")  # sides that lie on each other
    assert merged.area() == pytest.approx(11.0 * 6.0, abs=1e-6)
    assert offset(two, -2.1, TOLERANCE).contours == ()
    dumbbell = Path.of_commands(
        [
            ("move", (0, 0)),
            *(("line", p) for p in [(4, 0), (4, 1), (6, 1), (6, 0), (10, 0), (10, 4), (6, 4)]),
            *(("line", p) for p in [(6, 2), (4, 2), (4, 4), (0, 4)]),
            ("close",),
        ]
    )
    assert len(offset(dumbbell, -0.8, TOLERANCE).contours) == 2


@pytest.mark.parametrize("join", ["round", "miter", "bevel"])
@pytest.mark.parametrize("ends", ["butt", "round", "square"])
def test_a_stroke_of_an_open_path(join: str, ends: str) -> None:
    found = outline(WAVE, 2.0, TOLERANCE, join, ends)
    assert len(found.contours) == 1
    points, source = np.vstack(flatten(found, TOLERANCE)), closed_lines(WAVE, 1e-5)
    apart = distances(points, source)
    if join == ends == "round":
        assert np.abs(apart - 1.0).max() <= TOLERANCE + 1e-4
    else:
        assert (np.abs(apart - 1.0) <= TOLERANCE + 1e-4).mean() > 0.9
    added = {"butt": 0.0, "round": np.pi, "square": 4.0}[ends]
    butt = outline(WAVE, 2.0, TOLERANCE, join, "butt")
    assert found.area() - butt.area() == pytest.approx(added, abs=TOLERANCE * 10)


def test_strokes_by_formula() -> None:
    ring = outline(CIRCLE, 2.0, 1e-4)
    assert ring.area() == pytest.approx((121.0 - 81.0) * np.pi, abs=1e-4 * 40 * np.pi)
    assert len(ring.contours) == 2
    line = Path.of_commands([("move", (0, 0)), ("line", (10, 0))])
    assert outline(line, 2, 1e-5).area() == pytest.approx(20.0, abs=1e-9)
    assert outline(line, 2, 1e-5, ends="square").area() == pytest.approx(24.0, abs=1e-9)
    cross = Path.of_commands([("move", (0, 0)), ("line", (10, 0)), ("move", (5, -5)), ("line", (5, 5))])
    assert outline(cross, 2, 1e-5).area() == pytest.approx(36.0, abs=1e-9)


def test_miters_end_at_their_limit() -> None:
    corner = Path.of_commands([("move", (0, 0)), ("line", (10, 0)), ("line", (10, 10))])
    plain = outline(corner, 2, 1e-5, "bevel").area()
    assert outline(corner, 2, 1e-5, "miter").area() - plain == pytest.approx(0.5, abs=1e-9)
    assert outline(corner, 2, 1e-5, "miter", limit=1.4).area() == pytest.approx(plain, abs=1e-9)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: offset(WAVE, 1, 0.1), "closed outline"),
        (lambda: offset(CIRCLE, np.nan, 0.1), "finite"),
        (lambda: offset(CIRCLE, 1, 0.0), "tolerance"),
        (lambda: offset(CIRCLE, 1, 0.1, "sharp"), "round, miter, bevel"),
        (lambda: offset(CIRCLE, 1, 0.1, "miter", 0.5), "limit"),
        (lambda: outline(WAVE, 0, 0.1), "width"),
        (lambda: outline(WAVE, 1, 0.1, ends="pointed"), "butt, round, square"),
    ],
)
def test_what_makes_no_offset_is_refused(call, words: str) -> None:
    with pytest.raises(Refusal, match=words):
        call()


def test_what_would_reach_too_far_is_refused():
    for wide in (CIRCLE.transformed(np.array([[1e9, 0, 0], [0, 1e9, 0]])), CIRCLE):
        with pytest.raises(Refusal, match=r"farther than 1e\+09 mm"):
            offset(wide, 1e12, 2)
        with pytest.raises(Refusal, match=r"farther than 1e\+09 mm"):
            outline(wide, 1e12, 2)


def test_weights_that_ask_for_too_many_points_are_refused():
    corners = np.array([[0, 0], [9, -3], [8, 9], [-4, 6], [0, 0]], float)
    spline = BSpline(corners, 4, clamped_knots(5, 4), np.array([1, 1e-6, 1, 1, 1]))
    extreme = Path((Contour.of_segments([spline], True),))
    with pytest.raises(Refusal, match="points of the curve; take a coarser one"):
        offset(extreme, 1, TOLERANCE)
    with pytest.raises(Refusal, match="points of the curve; take a coarser one"):
        outline(extreme, 1, TOLERANCE)
