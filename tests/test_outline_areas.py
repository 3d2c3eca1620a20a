"""Operations that join, grow and stroke outlines of a document."""

import numpy as np
import pytest

from solidtree.model.document.document import Document, Parameter
from solidtree.model.document.errors import Refusal
from solidtree.model.document.expression import Expression
from solidtree.model.document.from_outlines import Extrude
from solidtree.model.document.nodes import Union
from solidtree.model.document.outlines import Circle, Path, Rectangle
from solidtree.model.document.primitives import Box
from solidtree.model.editing.session import Session
from solidtree.model.operations.curves.outline_areas import own_axes_path
from solidtree.model.outline.paths import path_of
from solidtree.model.scripting.outlines import path


def session(*profiles, solids=(), **more):
    return Session(Document(solids=solids, profiles=profiles, **more))


def area(document, node_id):
    return own_axes_path(document, node_id).area()


def test_the_result_takes_the_place_name_and_colour_of_the_first_and_undo_brings_all_back():
    first = Circle(id="n1", name="Disc", radius=10.0, colour="#ff0000").at(30, 0, 7)
    other = Rectangle(id="n2", name="Bar", width=40.0, height=4.0).at(30, -2, 7)
    work = session(first, other)
    before = work.document
    work.do("combine_outlines", "difference", ["n1", "n2"])
    (left,) = work.document.profiles
    assert isinstance(left, Path) and (left.id, left.name, left.colour) == ("n1", "Disc", "#ff0000")
    assert left.placement == first.placement
    bar = 2 * np.sqrt(96) + 100 * np.arcsin(0.2)  # the integral of √(100 - y²) from -2 to 2
    assert area(work.document, "n1") == pytest.approx(np.pi * 100 - bar, rel=1e-9)
    assert work.log[-1] == "combine_outlines('difference', ['n1', 'n2'])"
    work.undo()
    assert work.document is before


def test_outlines_are_joined_where_they_lie_in_space():
    upright = Rectangle(id="n1", name="Left", width=10.0, height=10.0).turned(90.0, 0.0, 0.0)
    beside = Rectangle(id="n2", name="Right", width=10.0, height=10.0).turned(90.0, 0.0, 0.0).at(10, 0, 0)
    work = session(upright, beside)
    work.do("combine_outlines", "union", ["n1", "n2"])
    assert area(work.document, "n1") == pytest.approx(200)
    assert len(own_axes_path(work.document, "n1").contours[0]) == 4
    lying = Rectangle(id="n2", name="Flat", width=10.0, height=10.0)
    with pytest.raises(Refusal, match="“Flat” does not lie in the plane of “Left”"):
        session(upright, lying).do("combine_outlines", "union", ["n1", "n2"])


def test_an_outline_within_a_solid_is_changed_where_it_stands():
    profile = Rectangle(id="n2", width=10.0, height=10.0)
    work = session(solids=(Extrude(id="n1", name="Part", children=(profile,)),))
    work.do("offset_outline", "n2", 1.0, "miter")
    (child,) = work.document.solids[0].children
    assert isinstance(child, Path) and area(work.document, "n2") == pytest.approx(144, rel=1e-9)


def test_offset_follows_steiner_and_a_stroke_pappus():
    work = session(
        Rectangle(id="n1", name="A", width=30.0, height=20.0), Circle(id="n2", name="B", radius=10.0).at(100)
    )
    work.do("offset_outline", ["n1", "n2"], 2.0)
    assert area(work.document, "n1") == pytest.approx(600 + 2 * 100 + np.pi * 4, abs=0.01 * 120)
    assert area(work.document, "n2") == pytest.approx(np.pi * 144, abs=0.01 * 80)
    work.undo()
    work.do("stroke_outline", "n2", 2.0)
    assert area(work.document, "n2") == pytest.approx(2 * np.pi * 10 * 2, abs=0.01 * 140)
    line = path("M 0 0 H 20").with_(id="n1", name="Line")
    work = session(line)
    work.do("stroke_outline", "n1", 4.0, "round", "butt")
    assert area(work.document, "n1") == pytest.approx(80, abs=0.01 * 50)


def test_expressions_are_resolved():
    node = Circle(id="n1", name="Disc", radius=Expression("r * 2"))
    work = session(node, parameters=(Parameter("r", 3.0),))
    work.do("offset_outline", "n1", 1.0)
    assert area(work.document, "n1") == pytest.approx(np.pi * 49, abs=0.5)


def test_live_operations_on_outlines_are_paths_as_well():
    square = Rectangle(width=10.0, height=10.0)
    both = Union(children=(square, Rectangle(width=10.0, height=10.0).at(5, 5, 0)))
    assert path_of(both).area() == pytest.approx(175)
    (cut,) = path_of(square - Circle(radius=2.0)).contours
    assert cut.area() == pytest.approx(100 - np.pi)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("combine_outlines", "union", ["n1", "n3"]), "“Box” is no outline"),
        (("combine_outlines", "sum", ["n1"]), "union, difference"),
        (("combine_outlines", "union", []), "select an outline"),
        (("combine_outlines", "intersection", ["n1", "n2"]), "nothing is left of “A”"),
        (("combine_outlines", "union", ["n1", "n4"]), "“Line”: an open curve has no inside"),
        (("offset_outline", "n1", -6.0), "nothing is left of “A”"),
        (("offset_outline", "n4", 1.0), "“Line”: only a closed outline"),
        (("offset_outline", "n1", 1.0, "odd"), "corners are joined"),
        (("stroke_outline", "n1", 0.0), "needs a width above 0"),
    ],
)
def test_what_cannot_be_done_is_said_in_words(arguments, words):
    work = session(
        Rectangle(id="n1", name="A", width=10.0, height=10.0),
        Rectangle(id="n2", name="B", width=10.0, height=10.0).at(50),
        path("M 0 0 H 20").with_(id="n4", name="Line"),
        solids=(Box(id="n3", name="Box"),),
    )
    before = work.document
    with pytest.raises(Refusal, match=words):
        work.do(*arguments)
    assert work.document is before


def test_an_offset_by_nothing_is_no_step_and_a_stroke_too_thin_asks_for_more_width():
    work = session(Rectangle(id="n1", name="Bar"))
    before = work.document
    work.do("offset_outline", "n1", 0)
    assert work.document is before and not work.undo()
    with pytest.raises(Refusal, match="take a greater width"):
        work.do("stroke_outline", "n1", 1e-9)
