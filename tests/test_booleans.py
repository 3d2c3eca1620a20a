"""Booleans of outlines that stay curves: against formulae, polygons and what CrossSection makes of chords."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from manifold3d import CrossSection, FillRule

from solidtree.model.curve.bezier import evaluated
from solidtree.model.curve.nearest import nearest
from solidtree.model.document.errors import Refusal
from solidtree.model.path import shapes
from solidtree.model.path.areas import booleans
from solidtree.model.path.areas.booleans import KINDS, combined
from solidtree.model.path.flatten import flatten
from solidtree.model.path.path import Contour, Kind, Node, Path

RULES = {"nonzero": FillRule.NonZero, "evenodd": FillRule.EvenOdd}


def circle(x, radius, y=0.0):
    return shapes.ellipse((x, y), radius, exact=True)


def area_of(path, fine=1e-4):
    return CrossSection([np.ascontiguousarray(p) for p in flatten(path, fine)], RULES[path.rule])


def by_polygons(kind, paths, fine=1e-4):
    """The area that chords of the paths give."""
    first, *others = [area_of(path, fine) for path in paths]
    for other in others:
        first = {
            "union": lambda a, b: a + b,
            "difference": lambda a, b: a - b,
            "intersection": lambda a, b: a ^ b,
            "exclusion": lambda a, b: (a - b) + (b - a),
        }[kind](first, other)
    return first.area()


@pytest.fixture
def exact(monkeypatch):
    """Fails where a result is fitted to polygons."""

    def through(*_):
        raise AssertionError("the edges did not close")

    monkeypatch.setattr(booleans, "through", through)


def squares(*places, size=10.0):
    return [shapes.rectangle(size, size, corner=place) for place in places]


def chain(points):
    """A closed contour of cubics through every third of the points (3 n, 2)."""
    closed = np.vstack((points, points[:1]))
    return Contour.of_segments([closed[i : i + 4] for i in range(0, len(points), 3)], True)


def test_two_circles_have_the_areas_of_the_lens_formula_and_meet_where_they_cross(exact):
    r, d = 10.0, 7.0
    lens = 2 * r * r * np.arccos(d / 2 / r) - d / 2 * np.sqrt(4 * r * r - d * d)
    whole = np.pi * r * r
    wanted = {"union": 2 * whole - lens, "difference": whole - lens, "intersection": lens,
              "exclusion": 2 * (whole - lens)}  # fmt: skip
    for kind, area in wanted.items():
        found = combined(kind, [circle(0, r), circle(d, r)])
        assert found.area() == pytest.approx(area, rel=1e-12)
        assert all((contour.kinds == Kind.SPLINE).all() for contour in found.contours)
        places = np.concatenate([contour.places for contour in found.contours])
        for sign in (-1, 1):
            crossing = np.array([d / 2, sign * np.sqrt(r * r - d * d / 4)])
            assert np.linalg.norm(places - crossing, axis=1).min() < 1e-9 * r


def test_rectangles_side_by_side_become_one_rectangle_and_identical_ones_stay_as_they_were(exact):
    joined = combined("union", squares((0, 0), (10, 0)))
    (contour,) = joined.contours
    assert sorted(map(tuple, contour.places.tolist())) == [(0, 0), (0, 10), (20, 0), (20, 10)]
    (square,) = squares((0, 0))
    for kind in ("union", "intersection"):
        found = combined(kind, [square, square])
        assert np.array_equal(found.contours[0].points, square.contours[0].points)
    for kind in ("difference", "exclusion"):
        assert not combined(kind, [square, square]).contours


def test_what_stays_whole_keeps_its_points_kinds_and_nodes_to_the_last_digit(exact):
    disc = shapes.ellipse((0, 0), 5)
    far = shapes.rectangle(4, 4, radius=1, corner=(20, 0))
    found = combined("union", [disc, far])
    for before, after in zip((*disc.contours, *far.contours), found.contours, strict=True):
        assert np.array_equal(before.points, after.points) and np.array_equal(before.nodes, after.nodes)
    cut = combined("difference", [disc, shapes.rectangle(20, 20, corner=(0, -10))])
    (half,) = cut.contours
    kinds = dict(zip(map(tuple, half.places.round(9).tolist()), half.nodes.tolist(), strict=True))
    assert kinds[(-5.0, 0.0)] == Node.SYMMETRIC  # its neighbours are whole
    assert kinds[(0.0, 5.0)] == kinds[(0.0, -5.0)] == Node.CUSP
    assert sorted(half.kinds.tolist()) == [Kind.LINE, Kind.CUBIC, Kind.CUBIC]


def test_segments_are_parts_of_those_given_and_keep_their_kind(exact):
    quad = Path.of_commands([("move", (0, 0)), ("quad", (20, 0), (20, 20)), ("line", (0, 20)), ("close",)])
    cubic = Path.of_commands([("move", (5, 5)), ("cubic", (30, 0), (30, 30), (5, 30)), ("close",)])
    found = combined("union", [quad, cubic])
    (contour,) = found.contours
    assert set(contour.kinds.tolist()) == {Kind.LINE, Kind.QUADRATIC, Kind.CUBIC}
    whole = quad.contours[0].segment(0), cubic.contours[0].segment(0)
    for segment in contour.segments():
        if len(segment) > 2:
            curve = next(one for one in whole if len(one) == len(segment))
            _, away = nearest(curve, evaluated(segment, np.linspace(0, 1, 9)))
            assert away.max() < 1e-12 * 30


def test_outer_contours_run_counter_clockwise_and_holes_clockwise(exact):
    outer, inner = shapes.rectangle(30, 30), shapes.rectangle(10, 10, corner=(10, 10)).reversed()
    for hole in (inner, inner.reversed()):
        found = combined("difference", [outer.reversed(), hole])
        assert sorted(contour.area() for contour in found.contours) == pytest.approx([-100, 900])
        assert found.rule == "nonzero"


@pytest.mark.parametrize(
    ("kind", "middle", "radius", "count"),
    [("union", 20, 10, 2), ("difference", 20, 10, 1), ("intersection", 20, 10, 0), ("union", 10 / 3, 20 / 3, 1),
     ("difference", 5, 5, 2)],
)  # fmt: skip
def test_circles_that_touch_are_told_apart(exact, kind, middle, radius, count):
    pair = [circle(0, 10), circle(middle, radius)]
    found = combined(kind, pair)
    assert len(found.contours) == count
    assert found.area() == pytest.approx(by_polygons(kind, pair), abs=1e-4 * 100)
    assert all(len(contour) == 1 for contour in found.contours)  # no node where they touch


def test_squares_that_touch_at_a_corner_stay_two_contours(exact):
    found = combined("union", squares((0, 0), (10, 10)))
    assert [len(contour) for contour in found.contours] == [4, 4]


def test_a_path_that_overlaps_itself_is_resolved_by_its_rule(exact):
    star = Path(shapes.polygon(5, 10).contours)
    ring = star.contours[0].places[[0, 2, 4, 1, 3]]
    for rule in RULES:
        path = Path((Contour(np.vstack((ring, ring[:1])), np.full(5, Kind.LINE, np.uint8), True),), rule)
        found = combined("union", [path])
        assert found.area() == pytest.approx(area_of(path).area(), rel=1e-7)  # the polygons have eight digits
        assert sum(len(contour) for contour in found.contours) == {"nonzero": 10, "evenodd": 15}[rule]
    # Strokes of a letter that lie on each other, as variable fonts have them, one with a loop of its own.
    stem, bar = shapes.rectangle(4, 30), shapes.rectangle(20, 4, corner=(0, 20))
    bowl = chain(np.array([(4, 10), (30, 0), (-10, 0), (12, 12), (12, 16), (8, 16), (4, 16), (4, 14), (4, 12)], float))
    letter = Path((*stem.contours, *bar.contours, bowl))
    assert combined("union", [letter]).area() == pytest.approx(area_of(letter).area(), abs=1e-2)


def test_shared_parts_of_curves_are_one_edge(exact):
    disc = shapes.ellipse((0, 0), 10)
    right = shapes.rectangle(40, 40, corner=(0, -20))
    halves = combined("intersection", [disc, right]), combined("difference", [disc, right])
    again = combined("union", halves)
    (contour,) = again.contours
    assert contour.area() == pytest.approx(disc.area(), rel=1e-12)
    assert (contour.kinds == Kind.CUBIC).all() and len(contour) == 4
    assert not combined("intersection", halves).contours


numbers = st.integers(-1000, 1000).map(lambda n: n / 50)


def outlines(kinds):
    def made(rows, kind, rule):
        points = np.array(rows)
        step = {"line": 1, "quad": 2, "cubic": 3}[kind]
        points = points[: len(points) // step * step]
        closed = np.vstack((points, points[:1]))
        segments = [closed[i : i + step + 1] for i in range(0, len(points), step)]
        return Path((Contour.of_segments(segments, True),), rule)

    rows = st.lists(st.tuples(numbers, numbers), min_size=9, max_size=15, unique=True)
    return st.builds(made, rows, st.sampled_from(kinds), st.sampled_from(sorted(RULES)))


@settings(max_examples=25, deadline=None)
@given(outlines(("cubic", "quad", "line")), outlines(("cubic", "quad", "line")), st.sampled_from(KINDS))
def test_any_outlines_fill_what_their_chords_fill(first, second, kind):
    found = combined(kind, [first, second])
    fine, length = 1e-4, first.length() + second.length()
    assert found.area() == pytest.approx(by_polygons(kind, [first, second], fine), abs=2 * fine * length)
    if found.contours:  # nothing overlaps: the signed area is that of what is filled
        assert area_of(found, fine).area() == pytest.approx(found.area(), abs=2 * fine * length)


def test_where_edges_do_not_close_the_polygons_are_fitted(monkeypatch):
    monkeypatch.setattr(booleans, "_exact", lambda *_: None)
    pair = [circle(0, 10), circle(7, 10)]
    found = combined("union", pair, tolerance=0.01)
    assert found.area() == pytest.approx(by_polygons("union", pair), abs=0.01 * 100)
    (contour,) = found.contours
    assert len(contour) < 40 and set(contour.kinds.tolist()) <= {Kind.LINE, Kind.CUBIC}


def test_a_wrong_result_is_never_given(monkeypatch):
    wrong = shapes.rectangle(1, 1)
    monkeypatch.setattr(booleans, "_exact", lambda *_: wrong)
    assert combined("union", squares((0, 0), (5, 0))).area() == pytest.approx(150, rel=1e-3)


def test_open_curves_and_curves_in_space_are_refused():
    open_path = Path.of_commands([("move", (0, 0)), ("line", (10, 0)), ("line", (10, 10))])
    with pytest.raises(Refusal, match="ends at \\(10, 10\\): close it"):
        combined("union", [open_path])
    with pytest.raises(Refusal, match="leaves its plane"):
        combined("union", [shapes.rectangle(1, 1).transformed(np.eye(3, 4))])
    with pytest.raises(Refusal, match="union, difference"):
        combined("sum", [])


def test_what_reaches_too_far_is_refused():
    with pytest.raises(Refusal, match=r"farther than 1e\+09 mm"):
        combined("union", [circle(0, 5), circle(1e11, 5)])
