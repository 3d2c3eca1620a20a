"""Path data of SVG: every command, its grammar, and where it stops at a fault."""

import json
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from solidtree.model.exchange.drawings.svg_path import read_path
from solidtree.model.path.path import Path
from solidtree.model.path.pieces import area, bounds, length, pieces_of

SAME = (1.0, 0.0, 0.0, 1.0, 0.0, 0.0)


def commands(text, tolerance=None):
    """Plain tuples: a word and its points as pairs; contours one after the other."""
    outline, _ = read_path(text, tolerance)
    return [
        (word, *(tuple(np.asarray(point).tolist()) for point in points))
        for contour in outline.contours(SAME)
        for word, *points in contour
    ]


def path(text, tolerance=None):
    contours = read_path(text, tolerance)[0].contours(SAME)
    return Path.of_commands([command for contour in contours for command in contour])


def fault(text):
    return read_path(text)[1]


# What stands before the fault is kept; svgpathtools reads on, and svgelements raises.
STOPPED = {
    "A 5 5 0 0 1 50 50": 0.0,
    "M 30 40 L 110 160 L 150#80": math.hypot(80, 120),
    "M 100 100 h -25 a 25 25 0 1 -1 25 25 z": 25.0,
    "M 100 100 h -25 a 25 2501 025 -25 z": 25.0,
    "M 100 100 h 25 a 25 25 0 1 7 -25 -25 z": 25.0,
}


def test_published_path_strings(corpus):
    cases = json.loads((corpus / "svg" / "expected_paths.json").read_text(encoding="utf-8"))
    assert len(cases) == 42
    seen = 0
    for case in cases:
        found, said = path(case["d"], 1e-9), fault(case["d"])
        if case["d"] in STOPPED:
            assert said, case["d"]
            assert found.length() == pytest.approx(STOPPED[case["d"]], rel=1e-12)
            continue
        assert not said, case["d"]
        expected = case["svgpathtools"]
        if expected["bbox"] is None:
            assert not found.contours
            continue
        groups = pieces_of(found.contours)
        size = np.abs(expected["bbox"]).max()
        assert length(groups) == pytest.approx(expected["length"], rel=2e-8), case["d"]  # its arcs: by chords
        assert bounds(groups).ravel() == pytest.approx(expected["bbox"], abs=1e-7 * size), case["d"]
        assert area(groups, np.zeros(2)) == pytest.approx(expected["curve_integral_area"], abs=1e-7 * size**2)
        seen += 1
    assert seen == 33


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("M1 2L3 4", [("move", (1, 2)), ("line", (3, 4))]),
        ("m1 2 3 4 5 6", [("move", (1, 2)), ("line", (4, 6)), ("line", (9, 12))]),
        ("M1 2 3 4", [("move", (1, 2)), ("line", (3, 4))]),
        ("M1 2H5V7h-1v-2", [("move", (1, 2)), *(("line", p) for p in [(5, 2), (5, 7), (4, 7), (4, 5)])]),
        ("M0 0H1 2 3", [("move", (0, 0)), ("line", (1, 0)), ("line", (2, 0)), ("line", (3, 0))]),
        ("M1 1q1 0 2 2", [("move", (1, 1)), ("quad", (2, 1), (3, 3))]),
        ("M0 0Q1 0 2 2T4 0", [("move", (0, 0)), ("quad", (1, 0), (2, 2)), ("quad", (3, 4), (4, 0))]),
        ("M0 0T4 0", [("move", (0, 0)), ("quad", (0, 0), (4, 0))]),
        (
            "M0 0c1 1 2 1 3 0s2-1 3 0",
            [("move", (0, 0)), ("cubic", (1, 1), (2, 1), (3, 0)), ("cubic", (4, -1), (5, -1), (6, 0))],
        ),
        ("M0 0S1 1 2 0", [("move", (0, 0)), ("cubic", (0, 0), (1, 1), (2, 0))]),
        ("M0 0Q1 1 2 0S3 1 4 0", [("move", (0, 0)), ("quad", (1, 1), (2, 0)), ("cubic", (2, 0), (3, 1), (4, 0))]),
        (
            "M1 1h2v2zl3 0",  # goes on from where the closed one began
            [("move", (1, 1)), ("line", (3, 1)), ("line", (3, 3)), ("close",), ("move", (1, 1)), ("line", (4, 1))],
        ),
        (
            "M1 1h2v2zm1 1h1",
            [("move", (1, 1)), ("line", (3, 1)), ("line", (3, 3)), ("close",), ("move", (2, 2)), ("line", (3, 2))],
        ),
        ("M 0,0\n\tL .5.5-.5-.5e0+1.", [("move", (0, 0)), ("line", (0.5, 0.5)), ("line", (-0.5, -0.5))]),
        ("M0 0A0 5 0 0 1 3 4", [("move", (0, 0)), ("line", (3, 4))]),  # without a radius a line
        ("M0 0A5 5 0 0 1 0 0", []),  # without a way nothing
        ("M5 5", []),
        ("M5 5z", []),
        ("", []),
    ],
)
def test_commands(text, wanted):
    assert commands(text) == wanted


@pytest.mark.parametrize(
    "text", ["a25 25 0 1 0 25-25", "a25 25 0 1025-25", "a25,25 0 10 25,-25", "a25 25 0,1,0,25,-25", "a25 25 0 1 025-25"]
)
def test_flags_of_arcs_need_no_separators(text):
    assert commands("M100 100h-25" + text) == commands("M 100 100 h -25 a 25 25 0 1 0 25 -25")


def test_several_arcs_in_one_command():
    once = commands("M0 0a5 5 0 0 1 5 5a5 5 0 0 1 5 5")
    assert commands("M0 0a5 5 0 0 1 5 5 5 5 0 0 1 5 5") == once
    assert commands("M0 0a5 5 0 015 5 5 5 0 015 5") == once
    assert len(once) == 3


@pytest.mark.parametrize("tolerance", [None, 1e-2, 1e-6, 1e-9])
def test_arcs_leave_the_circle_by_what_is_told(tolerance):
    radius = 50.0
    found = path(f"M {radius} 0 A {radius} {radius} 0 1 1 0 {-radius}", tolerance)
    curves = np.array(found.contours[0].segments())
    t = np.linspace(0, 1, 101)[:, None, None]
    a, b, c, d = np.moveaxis(curves, 1, 0)
    points = (1 - t) ** 3 * a + 3 * t * (1 - t) ** 2 * b + 3 * t**2 * (1 - t) * c + t**3 * d
    off = np.abs(np.hypot(points[..., 0], points[..., 1]) - radius).max()
    assert off <= (2.73e-4 * radius if tolerance is None else tolerance)
    assert len(curves) == 3 if tolerance is None else len(curves) >= 3
    assert tolerance is None or len(curves) < 3 or off > tolerance / 20  # not more of them than are needed


def test_an_arc_that_cannot_reach_is_made_larger():
    assert path("M0 0A1 1 0 0 1 10 0").bounds() == pytest.approx(np.array([[0, -5], [10, 0]]), abs=2e-3)


@pytest.mark.parametrize(
    ("text", "kept", "words"),
    [
        ("M0 0L1 1 2", 2, ["character 11", "its end"]),
        ("M0 0L1 1,", 2, ["“,”"]),
        ("M0 0L1 1,,2 2", 2, ["“,,2”"]),
        ("M0 0L1 1X5 5", 2, ["“X5”", "no command"]),
        ("M0 0L1 1Lnan 5", 2, ["“nan”"]),
        ("M0 0L1 1L1e999 5", 2, ["too large"]),
        ("M0 0L1 1 1e16 5 7 7", 2, ["too large"]),
        ("M0 0L1 1a1 1 0 2 0 5 5", 2, ["“1”", "needs 7"]),
        ("M0 0L1 1L٣ 4", 2, ["“٣”"]),  # digits of other scripts are none
        ("L1 1", 0, ["before the first moveto"]),
        ("M", 0, ["needs 2"]),
        ("M0 0L1 1\N{NO-BREAK SPACE}L2 2", 2, ["no command"]),
    ],
)
def test_a_fault_ends_the_path_and_is_told(text, kept, words):
    assert len(commands(text)) == kept
    assert all(word in fault(text) for word in words), fault(text)


def test_a_fault_in_words_ends_in_one_line():
    assert fault("M0 0L1 1" + "?" * 100_000).count("?") <= 12


NUMBERS = st.integers(-50, 50).map(lambda n: n / 4)
SEGMENTS = st.one_of(
    *(
        st.tuples(st.just(letter), st.lists(NUMBERS, min_size=count, max_size=count))
        for letter, count in {"L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2}.items()
    ),
    st.tuples(st.just("Z"), st.just([])),
    st.tuples(st.just("M"), st.lists(NUMBERS, min_size=2, max_size=2)),
)


@given(st.lists(SEGMENTS, max_size=12), NUMBERS, NUMBERS)
def test_relative_and_absolute_say_the_same(segments, x, y):
    absolute, relative = f"M{x} {y}", f"M{x} {y}"
    start = (x, y)
    for letter, numbers in segments:
        absolute += letter + " ".join(map(str, numbers))
        if letter == "Z":
            x, y = start
            relative += "z"
            continue
        origin = {"H": [x], "V": [y]}.get(letter, [x, y])
        moved = [value - origin[i % len(origin)] for i, value in enumerate(numbers)]
        relative += letter.lower() + ",".join(map(str, moved))
        x = numbers[-1] if letter == "H" else x if letter == "V" else numbers[-2]
        y = numbers[-1] if letter != "H" else y
        if letter == "M":
            start = (x, y)
    assert commands(absolute) == commands(relative)


@given(st.lists(st.lists(NUMBERS, min_size=6, max_size=6), min_size=1, max_size=30))
def test_many_segments_of_one_letter_are_as_one_by_one(groups):
    together = "M1 2c" + " ".join(" ".join(map(str, group)) for group in groups)
    single = "M1 2" + "".join("c" + " ".join(map(str, group)) for group in groups)
    assert commands(together) == commands(single)


@given(st.text(alphabet="MmZzLlHhVvCcSsQqTtAa0123456789.,-+eE \n#", max_size=60))
def test_no_text_breaks_the_reader(text):
    outline, _ = read_path(text)
    for contour in outline.contours(SAME):
        assert contour[0][0] == "move" and len(contour) > 1
    Path.of_commands([command for contour in outline.contours(SAME) for command in contour])
