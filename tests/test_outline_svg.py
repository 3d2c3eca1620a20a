"""Outlines as SVG: read back as XML, with the areas, the size and the side up that the section has."""

import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.exchange.outline_svg import svg_of
from solidtree.model.exchange.outlines_out import NamedOutline, write_outlines
from solidtree.model.script import box, cylinder, section

PLATE = box(40, 20, 5) - cylinder(4, 9, segments=48).at(10, 12, -2)
SVG = "{http://www.w3.org/2000/svg}"


def contours_of(data):
    """The closed contours of a path's data, y downward."""
    for part in data.removesuffix("Z").split("Z"):
        numbers = [float(number) for number in re.findall(r"-?[\d.]+(?:e-?\d+)?", part)]
        yield np.reshape(numbers, (-1, 2))


def signed_area(points):
    x, y = points.T
    return 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))


def drawing(*named, **how):
    return ET.fromstring(svg_of(named, **how).encode())


def test_the_path_holds_the_sections_area_and_stands_upright():
    outline = section(PLATE, (0, 0, 2), (0, 0, 1))
    root = drawing(NamedOutline("plate <1> & more", None, outline))
    (path,) = root.iter(SVG + "path")
    assert path.get("fill-rule") == "evenodd" and root.find(f".//{SVG}title").text == "plate <1> & more"
    contours = list(contours_of(path.get("d")))
    assert -sum(map(signed_area, contours)) == pytest.approx(outline.area, rel=1e-9)
    hole = max(contours, key=len)
    assert hole.mean(axis=0) == pytest.approx((10, -12))  # twelve up


def test_a_unit_is_a_millimetre_and_all_is_in_view():
    outline = section(PLATE, (0, 0, 2), (0, 0, 1))
    root = drawing(NamedOutline("plate", None, outline))
    left, top, width, height = (float(number) for number in root.get("viewBox").split())
    assert root.get("width") == f"{width:g}mm" and root.get("height") == f"{height:g}mm"
    points = np.concatenate(list(contours_of(root.find(f".//{SVG}path").get("d"))))
    assert (points >= (left, top)).all() and (points <= (left + width, top + height)).all()
    assert (width, height) == (42.0, 22.0)


def test_fills_strokes_and_hatches_differ_by_solid():
    one = NamedOutline("one", "#ff0000", section(box(10), (0, 0, 5), (0, 0, 1)))
    two = NamedOutline("two", None, section(box(10).at(20), (0, 0, 5), (0, 0, 1)))
    groups = list(drawing(one, two, fill="colour", stroke=None).iter(SVG + "g"))
    assert groups[0].get("fill") == "#ff0000" and groups[1].get("fill") not in ("none", "#ff0000")
    assert groups[0].get("stroke") == "none"
    hatches = [
        path.get("d") for path in drawing(one, two, fill="hatch").iter(SVG + "path") if path.get("class") == "hatch"
    ]
    slopes = []
    for data in hatches:
        (x0, y0), (x1, y1) = np.reshape([float(n) for n in re.findall(r"-?[\d.]+", data.split("M")[3])], (2, 2))
        slopes.append(round((y1 - y0) / (x1 - x0), 6))
    assert slopes == [-1.0, 1.0]  # 45 and 135 degrees, y downward


def test_what_cannot_be_written_is_refused_and_leaves_nothing(tmp_path):
    outline = section(PLATE, (0, 0, 2), (0, 0, 1))
    missed = section(PLATE, (0, 0, 99), (0, 0, 1))
    with pytest.raises(Refusal, match="meets no solid"):
        write_outlines(tmp_path / "a.svg", [NamedOutline("plate", None, missed)])
    with pytest.raises(Refusal, match="is no drawing"):
        write_outlines(tmp_path / "a.stl", [NamedOutline("plate", None, outline)])
    with pytest.raises(Refusal, match="no such file or folder"):
        write_outlines(tmp_path / "none" / "a.svg", [NamedOutline("plate", None, outline)])
    assert not list(tmp_path.iterdir())
