"""Views on a page: their places by the rules of projection, scales, and what is refused in words."""

import numpy as np
import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.drafting.drawn import Draughts
from solidtree.model.drafting.page import Fill, Group, Strokes, Text, box_of, items_of, walk
from solidtree.model.drafting.plan import Eye, NothingToDraw, Plan
from solidtree.model.drafting.sheet import Arranged, fitted, views_of
from solidtree.model.script import box, cylinder, document_of

BLOCK = box(30, 20, 10) + box(4, 4, 5).at(26, 0, 10)
"""With a stud on its front edge at the right."""


def page_of(solid, **choices):
    return Draughts(document_of(part=solid)).page(Plan(**choices)).page


def view(page, name) -> Group:
    return next(group for group in page.groups if group.name == name)


def lines_box(group):
    items = [i for g in walk((group,)) for i in g.items if isinstance(i, Strokes) and i.role == "visible"]
    return box_of(items)


@pytest.mark.parametrize("sheet", ["first", "third"])
def test_views_are_aligned_and_stand_where_the_angle_puts_them(sheet):
    page = page_of(BLOCK, sheet=sheet, title="block")
    side = "Left" if sheet == "first" else "Right"
    front, top, beside, iso = (lines_box(view(page, name)) for name in ("Front", "Top", side, "Iso"))
    s = page.scale
    assert np.ptp(front, axis=0) == pytest.approx(np.array([30, 15]) * s)
    assert np.ptp(top, axis=0) == pytest.approx(np.array([30, 20]) * s)
    assert np.ptp(beside, axis=0) == pytest.approx(np.array([20, 15]) * s)
    assert top[:, 0] == pytest.approx(front[:, 0]) and beside[:, 1] == pytest.approx(front[:, 1])
    assert beside[0, 0] > front[1, 0] and iso[0, 0] > front[1, 0]
    if sheet == "first":
        assert top[1, 1] < front[0, 1] and iso[1, 1] < beside[0, 1]
    else:
        assert top[0, 1] > front[1, 1] and iso[0, 1] > beside[1, 1]
    # The stud is in front: away from the front view in first angle, beside it in third.
    stud = [line for group in walk((view(page, side),)) for item in group.items if isinstance(item, Strokes)
            for line in item.lines if line[:, 1].max() > beside[1, 1] - 1e-6]  # fmt: skip
    reach = np.concatenate(stud)[:, 0]
    assert (reach.max() == pytest.approx(beside[1, 0])) == (sheet == "first")
    assert (reach.min() == pytest.approx(beside[0, 0])) == (sheet == "third")
    assert {item.words for item in items_of(page, "dimension") if isinstance(item, Text)} == {"30", "20", "15"}
    words = {item.words for item in items_of(page, "title")}
    assert {"block", "mm", "A4", f"{sheet.capitalize()} angle"} <= words


def test_the_symbol_shows_the_small_end_of_the_cone_where_the_method_puts_it():
    for sheet, way in (("first", 1.0), ("third", -1.0)):
        cone, *circles = items_of(page_of(box(10), sheet=sheet), "symbol")[0].lines
        middle = circles[0].mean(axis=0)
        assert np.sign(middle[0] - cone[:, 0].mean()) == way
        ends = [np.ptp(cone[np.isclose(cone[:, 0], x), 1]) for x in (cone[:, 0].min(), cone[:, 0].max())]
        assert ends[0] < ends[1]  # seen from the left it is the small end, with both circles in view
        assert len(circles) == 2


def test_nothing_leaves_the_frame_on_any_page():
    for page in ("A4", "A4-portrait", "Tabloid", "100x80", "60x200"):
        for choices in ({"sheet": "first"}, {"view": "iso", "dimensions": True}, {"view": "top", "faces": "fill"}):
            drawn = page_of(
                BLOCK, page=page, title="a name that is a good deal longer than its page is wide", **choices
            )
            frame = box_of([items_of(drawn, "frame")[0]])
            for item in items_of(drawn):
                around = box_of([item])
                assert (around[0] >= frame[0] - 1e-6).all() and (around[1] <= frame[1] + 1e-6).all(), item


@pytest.mark.parametrize(("size", "scale"), [(100, 1.0), (10, 10.0), (80, 2.0), (88, 1.0), (900, 0.1), (0.01, 10000.0)])
def test_the_largest_standard_scale_that_fits_is_taken(size, scale):
    # A4 across leaves 210 - 2 * 10 - 8 - 2 * 4 = 174 mm upright.
    page = page_of(box(size), view="front", page="A4-landscape")
    assert page.scale == pytest.approx(scale)
    assert np.ptp(lines_box(view(page, "Front")), axis=0) == pytest.approx(size * scale)


def test_the_page_is_turned_to_the_larger_scale():
    assert page_of(box(10, 10, 200), view="front").width == 210
    assert page_of(box(200, 10, 10), view="front").width == 297


def test_what_does_not_fit_is_refused_with_what_would():
    with pytest.raises(Refusal, match=r"at 5:1 the drawing takes 501 × 501 mm.*take 1:1 or the page A1"):
        page_of(box(100), view="front", page="A4-landscape", scale=5.0)
    with pytest.raises(Refusal, match=r"and A4 portrait has room for 182 × 261 mm; take 1:1 or the page A0"):
        page_of(box(10, 10, 220), view="front", scale=5.0)  # turned to what the offer is for
    with pytest.raises(Refusal, match="no room"):
        fitted(lambda scale: Arranged((), np.array([[0.0, 0.0], [30.0, 40.0]])), Plan(page="40x40"))
    assert page_of(box(100), view="front", scale=0.25).scale == 0.25


def test_hidden_lines_and_faces_are_drawn_as_they_are_wanted():
    plate = box(40, 20, 10) - cylinder(4, 30, segments=32).at(20, 10, -5)
    page = page_of(plate, view="front")
    assert items_of(page, "hidden") and not items_of(page, "face") and not items_of(page, "dimension")
    assert not items_of(page_of(plate, view="front", hidden="omit"), "hidden")
    sheet = page_of(plate, sheet="third", faces="fill")
    assert not [g for g in walk((view(sheet, "Iso"),)) if g.role == "hidden edges"]
    (face,) = [i for g in walk((view(sheet, "Top"),)) for i in g.items if isinstance(i, Fill) and i.role == "face"]
    ring = 40 * 20 - 0.5 * 32 * 16 * np.sin(2 * np.pi / 32)
    assert sum(map(signed, face.contours)) == pytest.approx(ring * sheet.scale**2, rel=1e-6)
    assert len(page_of(plate, sheet="third", iso=False).groups) == 4


def signed(points):
    x, y = points.T
    return 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))


def test_groups_lead_back_to_the_tree():
    document = document_of(part=(box(10).named("lid") - cylinder(2, 30, segments=16).at(5, 5, -1)).named("cut"))
    page = Draughts(document).page(Plan(view="top")).page
    names = {group.name: group.path for group in walk(page.groups) if group.path}
    root = document.solids[0]
    lid = root.children[0]
    assert names["part / lid"] == (root.id, lid.id)


def test_faces_come_before_all_lines_and_dashes_begin_at_corners():
    page = page_of(box(30, 20, 10) - box(10, 10, 4).at(10, 5, -1), view="top", faces="fill")
    roles = [item.role for item in items_of(page) if item.role in ("face", "hidden", "visible")]
    assert roles == sorted(roles, key=("face", "hidden", "visible").index)
    hidden = [line for item in items_of(page, "hidden") for line in item.lines]
    assert len(hidden) == 4 and all(len(line) == 2 for line in hidden)


def test_nothing_and_nonsense_are_refused():
    with pytest.raises(NothingToDraw, match="no solid"):
        Draughts(document_of())
    with pytest.raises(NothingToDraw, match="empty"):
        page_of(box(10) - box(20).at(-5, -5, -5))
    with pytest.raises(NothingToDraw, match="nothing is in view"):
        page_of(box(10), view=Eye((0, 0, 50), (0, 0, 90)), perspective=20.0)
    with pytest.raises(Refusal, match="there is no solid called “lid”"):
        Draughts(document_of(part=box(10)), solid="lid")
    for wrong in ({"view": "up"}, {"sheet": "second"}, {"hidden": "red"}, {"scale": 0.0}, {"perspective": 200.0},
                  {"sheet": "first", "perspective": 30.0}, {"page": "A9"}):  # fmt: skip
        with pytest.raises(Refusal):
            Plan(**wrong)


def test_a_perspective_has_no_dimensions_and_says_where_its_scale_counts():
    page = page_of(box(10), view="iso", perspective=30.0, dimensions=True)
    assert not items_of(page, "dimension")
    assert any("at the target" in item.words for item in items_of(page, "title"))


def test_only_the_views_of_a_plan_are_drawn():
    assert views_of(Plan(sheet="first")) == ("front", "top", "left", "iso")
    assert views_of(Plan(sheet="third", iso=False)) == ("front", "top", "right")
    assert views_of(Plan(view="back")) == ("back",) and views_of(Plan(view=Eye((1, 2, 3)))) == ()
