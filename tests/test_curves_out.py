"""Outlines written to SVG and DXF: what is read back is what was written, and other readers see the same."""

import re
from math import pi

import numpy as np
import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.exchange.curves_out import bounds, outlines_to_write, write_curves
from solidtree.model.exchange.meshes_in import read_any
from solidtree.model.outline.paths import path_of
from solidtree.model.path.flatten import flatten
from solidtree.model.script import (
    bezier,
    box,
    bspline,
    circle,
    document_of,
    path,
    polygon,
    rectangle,
)  # fmt: skip

MIXED = path("M 0 0 C 0 5 10 5 10 0 Q 5 -5 3 -3 L 1 -2 Z")
OUTLINES = {
    "mixed": MIXED,
    "open": path("M 1 1 C 2 2 3 0 4 1 L 5 5"),
    "holed": path("M0 0h9v9h-9z M2 2h5v5h-5z", even_odd=True),
    "triangle": polygon([(0, 0), (4, 0), (0, 3)]),
    "spline": bspline([(0, 0), (10, 10), (20, 0), (30, 10), (40, 10)]),
    "ring": bspline([(0, 0), (10, 0), (10, 10), (0, 10)], closed=True),
    "rational": bspline([(0, 0), (10, 10), (20, 0), (30, 10)], weights=[1, 2, 3, 1]),
    "quintic": bezier([(0, 0), (1, 4), (3, 4), (4, 0), (9, 9), (9, 0)]),
    "moved": rectangle(3, 4).turned(z=30).at(50, 60),
}


@pytest.fixture
def written(tmp_path):
    def write(ending: str, tolerance: float = 1e-4, **outlines):
        """The file, and what is read from it, moved back where it was: SVG counts from the page's lower left."""
        target, curves = tmp_path / f"out.{ending}", outlines_to_write(document_of(**outlines))
        write_curves(target, curves, tolerance)
        document = read_any(target)
        if ending == "svg":
            x, y = (bounds(curves)[0] - 1).tolist()
            document = document.with_(profiles=tuple(root.at(x, y) for root in document.profiles))
        return target, document

    return write


def distance(first, second) -> float:
    """The larger of the two distances from points along one path to the other."""
    a, b = (np.vstack([np.vstack((p, p[:1])) for p in flatten(path_of(node), 1e-4)]) for node in (first, second))

    def off(points, line):
        begin, along = line[:-1], np.diff(line, axis=0)
        gap = points[:, None] - begin
        size = np.maximum((along**2).sum(axis=1), 1e-300)
        share = np.clip((gap * along).sum(axis=2) / size, 0, 1)
        return np.linalg.norm(gap - share[..., None] * along, axis=2).min(axis=1).max()

    return max(off(a, b), off(b, a))


@pytest.mark.parametrize("ending", ["svg", "dxf"])
@pytest.mark.parametrize("name", ["mixed", "triangle", "moved"])
def test_lines_and_bezier_curves_come_back_of_their_kind_and_in_their_place(written, ending, name):
    before = path_of(OUTLINES[name])
    _, document = written(ending, **{name: OUTLINES[name]})
    (root,) = document.profiles
    after = path_of(root)
    assert root.name == name
    for old, new in zip(before.contours, after.contours, strict=True):
        assert new.kinds.tolist() == old.kinds.tolist() and new.closed == old.closed
        np.testing.assert_allclose(new.points, old.points, atol=1e-9)


@pytest.mark.parametrize("ending", ["svg", "dxf"])
def test_every_kind_of_outline_comes_back_within_the_tolerance(written, ending):
    for name, node in OUTLINES.items():
        _, document = written(ending, **{name: node})
        assert len(document.profiles) == 1, name
        assert distance(node, document.profiles[0]) < 5e-4, name


def test_splines_stay_splines_in_dxf(written):
    for name in ("spline", "ring", "rational", "quintic"):
        _, document = written("dxf", **{name: OUTLINES[name]})
        (before,), (after,) = path_of(OUTLINES[name]).contours, path_of(document.profiles[0]).contours
        assert len(after.splines) == 1, name
        assert after.splines[0].degree == before.splines[0].degree
        assert after.length() == pytest.approx(before.length(), rel=1e-12), name


def test_a_cubic_spline_is_exact_in_svg(written):
    _, document = written("svg", spline=OUTLINES["spline"])
    assert path_of(document.profiles[0]).length() == pytest.approx(path_of(OUTLINES["spline"]).length(), rel=1e-11)


def test_a_circle_is_an_arc_in_svg_and_a_circle_in_dxf(written):
    file, _ = written("svg", wheel=circle(5).at(3, 4))
    assert len(re.findall(r"A5 5 0 0 0", file.read_text())) == 2
    file, document = written("dxf", wheel=circle(5).at(3, 4))
    import ezdxf

    (entity,) = ezdxf.readfile(file).modelspace()
    assert entity.dxftype() == "CIRCLE" and entity.dxf.radius == pytest.approx(5)
    assert tuple(entity.dxf.center)[:2] == pytest.approx((3, 4))
    assert path_of(document.profiles[0]).area() == pytest.approx(25 * pi, rel=1e-3)


def test_the_winding_rule_and_the_colour_stay(written):
    _, document = written("svg", holed=OUTLINES["holed"].coloured("#336699"))
    (root,) = document.profiles
    assert root.even_odd and root.colour == "#336699"


def test_another_reader_sees_the_same_path_data(written):
    from fontTools.pens.areaPen import AreaPen
    from fontTools.svgLib.path import parse_path

    file, _ = written("svg", mixed=MIXED)
    data = re.search(r' d="([^"]*)"', file.read_text()).group(1)  # type: ignore[union-attr]
    pen = AreaPen()
    parse_path(data, pen)
    assert abs(pen.value) == pytest.approx(abs(path_of(MIXED).area()), rel=1e-9)


def test_the_page_holds_all_of_the_drawing_in_millimetres(written):
    file, _ = written("svg", a=rectangle(20, 10), b=circle(5).at(-30, 0))
    text = file.read_text()
    assert 'width="57mm" height="17mm"' in text and 'viewBox="-36 -11 57 17"' in text


def test_names_that_no_file_can_hold_are_changed_and_stay_apart(written):
    file, document = written("svg", **{"a b": rectangle(), "a  b!": rectangle(), "1": rectangle(), "<&>": rectangle()})
    assert len(set(re.findall(r' id="([^"]*)"', file.read_text()))) == 4
    assert len(document.profiles) == 4


def test_an_upright_outline_is_written_in_its_own_plane(written):
    _, document = written("svg", wall=rectangle(3, 4).turned(x=90).at(1, 2, 3))
    np.testing.assert_allclose(path_of(document.profiles[0]).bounds(), [[0, 0], [3, 4]], atol=1e-9)


@pytest.mark.parametrize(
    "document, name, words",
    [
        (document_of(box()), None, "no visible outline; of solids a section"),
        (document_of(), None, "no visible outline"),
        (document_of(a=rectangle()), "b", "no outline called “b”; there is “a”"),
        (document_of(a=path([("move", (0, 0, 0)), ("line", (1, 2, 3))])), None, "does not lie in a plane"),
        (document_of(a=bezier([(0, 0)])), None, "“a”: Bezier curve: two or more"),
    ],
)
def test_what_cannot_be_written_is_refused_in_words(document, name, words):
    with pytest.raises(Refusal, match=words):
        outlines_to_write(document, name)
