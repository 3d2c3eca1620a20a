"""Dashes fitted to their lines: both ends in one, short lines with short ones, the same in every format."""

import re
import xml.etree.ElementTree as ET

import ezdxf
import numpy as np
import pytest

from solidtree.model.drafting.dashes import SHORTEST, dash_of, dashed
from solidtree.model.drafting.drawing_file import write_page
from solidtree.model.drafting.drawn import Draughts
from solidtree.model.drafting.page import HIDDEN, items_of
from solidtree.model.drafting.plan import Plan
from solidtree.model.script import box, cylinder, difference, document_of

PERIOD = sum(HIDDEN.dash)
RADII = (0.8, 1.5, 3, 5)
PART = difference(box(80, 50, 12), *(cylinder(r, 8).at(10 + 12 * i, 25, -1) for i, r in enumerate(RADII)))


@pytest.mark.parametrize("length", [1.2, 1.9, 2.5, 3.0, 5.0, 8.25, 20.0, 33.3, 400.0])
def test_an_open_line_begins_and_ends_with_a_whole_dash(length):
    dash, gap = dash_of(HIDDEN.dash, length, False)
    gaps = (length - dash) / (dash + gap)
    assert gaps == pytest.approx(round(gaps), abs=0.02) and round(gaps) >= (2 if length >= 3.0 else 1)
    assert dash / gap == pytest.approx(HIDDEN.dash[0] / HIDDEN.dash[1], rel=1e-2)
    assert SHORTEST * HIDDEN.dash[0] <= dash <= 1.35 * HIDDEN.dash[0]


@pytest.mark.parametrize("diameter", [0.6, 1.0, 2.0, 3.0, 6.0, 10.0, 100.0])
def test_a_circle_has_whole_periods_and_small_ones_six_where_there_is_room(diameter):
    length = np.pi * diameter
    periods = length / sum(dash_of(HIDDEN.dash, length, True))
    assert periods == pytest.approx(round(periods), abs=0.02)
    assert round(periods) >= min(6, int(length / (0.4 * PERIOD)), 2)
    assert round(periods) >= 6 or diameter < 2.2


def test_what_is_too_short_for_a_gap_is_one_dash():
    for length, closed in ((1.0, False), (0.01, False), (1.2, True)):
        assert dash_of(HIDDEN.dash, length, closed)[0] == pytest.approx(length, abs=1e-4)


def test_equal_lines_share_their_strokes():
    lines = [np.array([[0.0, y], [20.0, y]]) for y in (0.0, 5.0)] + [np.array([[0.0, 0.0], [0.0, 7.0]])]
    strokes = dashed("hidden", HIDDEN, lines)
    assert sorted(len(item.lines) for item in strokes) == [1, 2]
    assert all(item.pen.weight == HIDDEN.weight and item.role == "hidden" for item in strokes)


def length_of(points, closed=True):
    return np.linalg.norm(np.diff(np.append(points, points[:1], axis=0) if closed else points, axis=0), axis=1).sum()


def test_hidden_circles_have_whole_periods_in_svg_and_dxf(tmp_path):
    page = Draughts(document_of(PART)).page(Plan(view="top", scale=1.0)).page
    for ending in ("svg", "pdf", "dxf"):
        write_page(tmp_path / f"a.{ending}", page)
    circles = [e for e in ET.parse(tmp_path / "a.svg").iter("{http://www.w3.org/2000/svg}path")
               if e.get("class") == "hidden"]  # fmt: skip
    assert len(circles) == 4
    for path in circles:
        points = np.reshape([float(n) for n in re.findall(r"-?\d*\.?\d+", path.get("d"))], (-1, 2))
        periods = length_of(points) / sum(map(float, path.get("stroke-dasharray").split()))
        assert periods == pytest.approx(round(periods), abs=0.05) and periods > 3.9
    drawing = ezdxf.readfile(tmp_path / "a.dxf")
    assert not drawing.audit().errors
    found = [e for e in drawing.modelspace().query("LWPOLYLINE") if e.dxf.layer.endswith("hidden")]
    assert len(found) == 4
    for circle in found:
        periods = length_of(np.array(circle.get_points("xy"))) / (PERIOD * circle.dxf.ltscale)
        assert periods == pytest.approx(round(periods), abs=0.05)
        assert circle.closed and circle.dxf.flags & 128  # the dashes go on across the corners
    assert len({line.pen.dash for line in items_of(page, "hidden")}) == 4
