"""Solids made of outlines: they stand where the outlines stood, and take in what they can be made of."""

import numpy as np
import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.document.nodes import Instance
from solidtree.model.document.outlines import is_outline
from solidtree.model.document.placement import product
from solidtree.model.document.resolve import resolve
from solidtree.model.document.table import from_table, to_table
from solidtree.model.document.tree import find
from solidtree.model.editing.session import Session
from solidtree.model.operations.operations import OPERATIONS
from solidtree.model.outline.frames import frame_of
from solidtree.model.script import box, circle, document_of, evaluate, hull, instance, mirror, parameter, path, polygon

from solidtree.model.script import rectangle, sphere, union  # isort: skip

RAIL = path([("move", (0, 0, 0)), ("line", (0, 0, 9))]).named("rail")
OPEN = path("M0 0H9").named("open")
# n1 rectangle in space, n2 circle, n3 rail, n4 open line, n5 box
DOCUMENT = document_of(
    rectangle(4, 6).named("plate").turned(30, 40, 50).at(1, 2, 3), circle(2).named("disc").at(9), RAIL.at(5, 5, 5),
    OPEN, box(1),
)  # fmt: skip


def do(document, name, *arguments, **keywords):
    after = OPERATIONS[name](document, *arguments, **keywords)
    names = [root.name for root in after.standing]
    assert len(set(names)) == len(names) and all(names)
    assert not any(is_outline(root, after.definitions) for root in after.solids)
    assert all(is_outline(root, after.definitions) for root in after.profiles)
    assert to_table(from_table(to_table(after))) == to_table(after)
    return after


@pytest.mark.parametrize("kind", ["extrude", "revolve", "pipe"])
def test_each_outline_makes_a_solid_and_stays_where_it_is(kind):
    after = do(DOCUMENT, "make_solid", kind, ["n1", "n2"], tolerance=0.2)
    assert [root.kind.lower() for root in after.solids] == ["box", kind, kind] and len(after.profiles) == 2
    for node_id, solid in zip(("n1", "n2"), after.solids[1:], strict=True):
        assert solid.children[0].id == node_id and solid.tolerance == 0.2
        np.testing.assert_allclose(frame_of(after, node_id), frame_of(DOCUMENT, node_id), atol=1e-12)


def test_a_solid_of_an_outline_stands_on_it():
    after = do(DOCUMENT, "make_solid", "extrude", "n1", height=5)
    measures = evaluate(after).solids[1].measures()
    assert measures.volume == pytest.approx(4 * 6 * 5)
    frame = frame_of(DOCUMENT, "n1")
    assert measures.centroid == pytest.approx(frame[:, :3] @ (2, 3, 2.5) + frame[:, 3])
    turned = do(DOCUMENT, "make_solid", "revolve", "n1")
    measures = evaluate(turned, tolerance=1e-4).solids[1].measures()
    assert measures.volume == pytest.approx(np.pi * 16 * 6, rel=1e-3)
    assert measures.centroid == pytest.approx(frame[:, :3] @ (0, 3, 0) + frame[:, 3], abs=1e-3)


def test_what_an_outline_is_scaled_by_is_not_the_solids():
    after = do(document_of(rectangle(4, 6).scaled(2).at(1)), "make_solid", "extrude", "n1", height=5)
    (solid,) = after.solids
    assert evaluate(after).solids[0].measures().volume == pytest.approx(8 * 12 * 5)
    assert len(solid.placement.steps) == len(solid.children[0].placement.steps) == 1


@pytest.mark.parametrize("order", [["n2", "n3"], ["n3", "n2"]])
def test_a_sweep_takes_the_closed_one_as_its_outline(order):
    (solid,) = do(DOCUMENT, "make_solid", "sweep", order).solids[1:]
    assert [child.id for child in solid.children] == ["n2", "n3"]
    both = do(DOCUMENT, "make_solid", "sweep", ["n2", "n1"])
    assert [child.id for child in both.solids[-1].children] == ["n2", "n1"]
    after = do(DOCUMENT, "make_solid", "sweep", order)
    np.testing.assert_allclose(frame_of(after, "n3"), frame_of(DOCUMENT, "n3"), atol=1e-12)


def test_a_loft_keeps_every_outline_in_its_place():
    after = do(DOCUMENT, "make_solid", "loft", ["n2", "n1"])
    assert [child.id for child in after.solids[-1].children] == ["n2", "n1"]
    for node_id in ("n1", "n2"):
        np.testing.assert_allclose(frame_of(after, node_id), frame_of(DOCUMENT, node_id), atol=1e-12)


@pytest.mark.parametrize(
    ("kind", "ids", "words"),
    [
        ("box", ["n1"], "no solid of outlines called"),
        ("extrude", ["n5"], "is no outline"),
        ("extrude", ["n4"], r"“open” is open, it ends at \(9, 0\): close it first"),
        ("extrude", [], "select the outlines"),
        ("sweep", ["n1"], "takes two"),
        ("sweep", ["n3", "n4"], "neither is one"),
        ("loft", ["n1"], "two outlines or more"),
        ("loft", ["n1", "n4"], "is open"),
        ("pipe", ["n99"], "no node n99"),
    ],
)
def test_what_no_solid_can_be_made_of(kind, ids, words):
    with pytest.raises(Refusal, match=words):
        OPERATIONS["make_solid"](DOCUMENT, kind, ids)


def test_fields_are_those_of_the_kind():
    with pytest.raises(Refusal, match="Extrusion has no field 'bore'"):
        OPERATIONS["make_solid"](DOCUMENT, "extrude", "n1", bore=1)
    after = do(DOCUMENT, "make_solid", "extrude", "n1", height=parameter("tall", 7))
    assert after.parameter("tall").value == 7 and str(after.solids[-1].height) == "tall"


def test_an_operand_of_outlines_is_taken_out_but_not_the_last():
    joined = do(DOCUMENT, "combine", "union", ["n1", "n2"])
    (root,) = [root for root in joined.profiles if root.kind == "Union"]
    after = do(joined, "make_solid", "extrude", "n2")
    assert len(find(after, root.id).children) == 1
    np.testing.assert_allclose(frame_of(after, "n2"), frame_of(joined, "n2"), atol=1e-12)
    with pytest.raises(Refusal, match="cannot be without the last"):
        OPERATIONS["make_solid"](after, "extrude", "n1")
    whole = do(joined, "make_solid", "extrude", root.id)
    assert whole.solids[-1].children[0].id == root.id


@pytest.mark.parametrize("kind", ["extrude", "revolve"])
def test_a_dissolved_solid_leaves_its_outline_where_it_stood(kind):
    made = do(DOCUMENT, "make_solid", kind, "n1")
    after = do(made, "dissolve", made.solids[-1].id)
    assert {root.id for root in after.profiles} == {"n1", "n2", "n3", "n4"} and len(after.solids) == 1
    np.testing.assert_allclose(frame_of(after, "n1"), frame_of(DOCUMENT, "n1"), atol=1e-12)
    assert find(after, "n1").name == "plate"


def test_the_section_of_a_dissolved_sweep_stays_across_the_path():
    made = do(DOCUMENT, "make_solid", "sweep", ["n2", "n3"])
    after = do(made, "dissolve", made.solids[-1].id)
    for node_id in ("n2", "n3"):
        np.testing.assert_allclose(frame_of(after, node_id), frame_of(made, node_id), atol=1e-12)
    np.testing.assert_allclose(frame_of(after, "n2")[:, 3], (5, 5, 5), atol=1e-12)


def test_outlines_on_one_plane_are_joined_in_it():
    tilted = [rectangle(4, 4).turned(x=90).at(0, 3), circle(1).at(4, 2).turned(x=90).at(0, 3)]
    after = do(document_of(*tilted), "combine", "difference", ["n1", "n2"])
    (row,) = evaluate(after).profiles
    assert not row.messages and row.path.contours[0].dimension == 2
    solid = do(after, "make_solid", "extrude", after.profiles[0].id, height=2)
    assert evaluate(solid, tolerance=1e-4).solids[0].measures().volume == pytest.approx(2 * (16 - np.pi / 2), rel=1e-3)


def test_the_families_stay_apart_whatever_is_done():
    linked = do(DOCUMENT, "link", ["n1"])
    shown = next(root for root in linked.profiles if isinstance(root, Instance))
    assert do(linked, "make_solid", "extrude", shown.id).solids[-1].children[0].id == shown.id
    assert do(linked, "unlink", shown.id).profiles[0].kind == "Rectangle"
    assert len(do(DOCUMENT, "duplicate", ["n1", "n5"]).profiles) == 5
    swapped = do(DOCUMENT, "swap", "n1", "n3")
    assert [root.id for root in swapped.profiles] == ["n3", "n2", "n1", "n4"]
    assert [root.id for root in do(DOCUMENT, "relocate", ["n4"], None, 0).profiles] == ["n4", "n1", "n2", "n3"]
    assert [root.id for root in do(DOCUMENT, "reorder", ["n4"], -1).profiles] == ["n1", "n2", "n4", "n3"]
    assert do(DOCUMENT, "replace", "n2", box(2)).solids[-1].name == "disc"
    assert do(DOCUMENT, "replace", "n5", circle(2)).profiles[-1].name == "Box"
    copied = do(DOCUMENT, "insert_document", DOCUMENT)
    assert len(copied.profiles) == 8 and len(copied.solids) == 2
    assert do(DOCUMENT, "rename", "n1", "x").profiles[0].name == "x"
    for taken in ("disc", "Box"):
        with pytest.raises(Refusal, match=f"called “{taken}” already"):
            OPERATIONS["rename"](DOCUMENT, "n1", taken)
    with pytest.raises(Refusal, match="called “disc” already"):
        OPERATIONS["rename_each"](DOCUMENT, ["n5"], "disc")
    grouped = do(DOCUMENT, "combine", "union", ["n1", "n2"])
    with pytest.raises(Refusal, match="takes solids"):
        OPERATIONS["change_kind"](grouped, grouped.profiles[0].id, "hull")
    with pytest.raises(Refusal, match="which is flat"):
        OPERATIONS["insert"](document_of(hull(box(1))), circle(1), "n1")
    with pytest.raises(Refusal, match="cannot be without the last"):
        OPERATIONS["delete"](grouped, ["n1", "n2"])


def test_an_instance_keeps_being_what_it_is():
    document = do(do(DOCUMENT, "link", ["n1"]), "link", ["n5"])
    flat, solid = document.profiles[0], document.solids[0]
    with pytest.raises(Refusal, match="is an outline, and what it should be an instance of is not"):
        OPERATIONS["set_field"](document, flat.id, "definition", solid.definition)
    with pytest.raises(Refusal, match="is a solid"):
        OPERATIONS["set_field"](document, solid.id, "definition", flat.definition)
    assert is_outline(instance(flat.definition), document.definitions)
    mirrored = do(document, "combine", "mirror", [flat.id])
    assert mirrored.profiles[0].kind == "Mirror"


def test_one_step_makes_the_solid_and_one_takes_it_back():
    session = Session(DOCUMENT)
    session.select(["n1"])
    session.do("make_solid", "extrude", ["n1"], height=5)
    assert session.selection == (session.document.solids[-1].id,)
    assert session.log == ("make_solid('extrude', ['n1'], height=5)",)
    session.undo()
    assert session.document is DOCUMENT and session.selection == ("n1",)


def test_the_solid_follows_its_outline():
    made = do(DOCUMENT, "make_solid", "extrude", "n1", height=5)
    wider = do(made, "set_field", "n1", "width", 8)
    assert evaluate(wider).solids[1].measures().volume == pytest.approx(2 * evaluate(made).solids[1].measures().volume)


def test_space_is_kept_below_a_turned_parent():
    mirrored = document_of(mirror(polygon([(0, 0), (4, 0), (0, 3)]), keep=False).turned(x=90).at(1, 2, 3), sphere(1))
    child = mirrored.profiles[0].children[0]
    world = product(resolve(mirrored).profiles[0].placement.matrix(), np.diag([-1.0, 1, 1, 1])[:3])
    np.testing.assert_allclose(frame_of(mirrored, child.id), world, atol=1e-12)
    assert union(circle(1)).children  # an outline may be wrapped by itself
    wrapped = do(mirrored, "combine", "union", [child.id])
    assert wrapped.profiles[0].children[0].kind == "Union"
