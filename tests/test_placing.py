"""Moving, turning and scaling nodes: by formula against matrices, and what the placements read like afterwards."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from solidtree.model.document.document import Document
from solidtree.model.document.errors import Refusal
from solidtree.model.document.expression import Expression
from solidtree.model.document.nodes import Instance, LinearArray, Node, Union
from solidtree.model.document.placement import (
    Affine,
    Move,
    Placement,
    Reflect,
    Scale,
    Turn,
    inverse,
    product,
    turn_about,
)
from solidtree.model.document.primitives import Box, Sphere
from solidtree.model.document.resolve import resolve
from solidtree.model.operations.operations import OPERATIONS
from solidtree.model.operations.placing import move, outer_maps, scale, turn
from solidtree.model.operations.steps import followed, turn_angles
from solidtree.model.script import document_of, parameter
from solidtree.model.solid.places import places_of

numbers = st.floats(-100, 100).map(lambda x: round(x, 3))
triples = st.tuples(numbers, numbers, numbers)
factors = st.tuples(*[st.sampled_from([-3.0, 0.25, 1.0, 2.0])] * 3)
directions = triples.filter(lambda t: np.linalg.norm(t) > 0.1)
steps = st.one_of(
    triples.map(Move),
    triples.map(Turn),
    factors.map(Scale),
    directions.map(Reflect),
    st.just(Affine((1, 0.5, 0, 3, 0, 1, 0, -2, 0, 0.25, 2, 1))),
)
placements = st.lists(steps, max_size=5).map(lambda found: Placement(tuple(found)))


def one(*placement, **more) -> Document:
    return Document(solids=(Box(id="n1", name="Box", **more).placed(*placement),))


def steps_of(document: Document) -> tuple:
    return document.solids[0].placement.steps


def matrix_of(document: Document, node_id: str = "n1") -> np.ndarray:
    """(3, 4) from the node's own axes to the world's."""
    return places_of(resolve(document).solids, [node_id])[node_id][0].matrix


def same(a: np.ndarray, b: np.ndarray, size: float = 1.0) -> bool:
    return bool(np.abs(a - b).max() <= 1e-12 * max(1.0, size, np.abs(b).max()))


def about(linear: np.ndarray, point) -> np.ndarray:
    """(3, 4) the linear map (3, 3) with `point` in its place."""
    point = np.asarray(point, float)
    return np.column_stack((linear, point - linear @ point))


@given(placements, triples)
def test_a_move_is_the_same_map(placement, by):
    document = one(*placement.steps)
    wanted = product(Move(by).matrix(), placement.matrix())
    assert same(matrix_of(move(document, ["n1"], *by)), wanted)


@given(placements, st.sampled_from("xyz"), numbers, st.none() | triples)
def test_a_turn_is_the_same_map(placement, axis, angle, point):
    document = one(*placement.steps)
    before = placement.matrix()
    linear = turn_about({"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1)}[axis], angle)[:, :3]
    wanted = product(about(linear, before[:, 3] if point is None else point), before)
    size = max([np.abs(s.numbers).max() for s in placement.steps], default=1.0) * 10
    assert same(matrix_of(turn(document, ["n1"], axis, angle, point)), wanted, size)


@given(placements, directions, numbers)
def test_a_turn_about_any_axis_is_the_same_map(placement, axis, angle):
    before = placement.matrix()
    wanted = product(about(turn_about(axis, angle)[:, :3], before[:, 3]), before)
    size = max([np.abs(s.numbers).max() for s in placement.steps], default=1.0) * 10
    assert same(matrix_of(turn(one(*placement.steps), ["n1"], axis, angle)), wanted, size)


@given(placements, factors, st.none() | triples)
def test_a_scaling_is_the_same_map(placement, by, point):
    before = placement.matrix()
    wanted = product(about(np.diag(by), before[:, 3] if point is None else point), before)
    size = max([np.abs(s.numbers).max() for s in placement.steps], default=1.0) * 10
    assert same(matrix_of(scale(one(*placement.steps), ["n1"], *by, point)), wanted, size)


@given(placements, factors)
def test_a_scaling_along_the_own_axes_is_the_first_step(placement, by):
    wanted = product(placement.matrix(), Scale(by).matrix())
    assert same(matrix_of(scale(one(*placement.steps), ["n1"], *by, local=True)), wanted)


@given(placements, st.lists(steps.filter(lambda s: not isinstance(s, Move)), max_size=12))
def test_the_list_of_steps_stays_short_and_the_map_the_same(placement, drags):
    wanted, result = placement.matrix(), placement
    size = 1.0
    for step in drags:
        if isinstance(step, Affine):
            step = Affine((1, 0.5, 0, 0, 0, 1, 0, 0, 0, 0.25, 2, 0))
        wanted = product(about(step.matrix()[:, :3], wanted[:, 3]), wanted)
        result = followed(result, step, None, {})
        size = max(size, np.abs(wanted).max())
    assert len(result.steps) <= len(placement.steps) + 6
    assert same(result.matrix(), wanted, 1e3 * size)


@given(st.tuples(st.floats(-180, 180), st.floats(-90, 90), st.floats(-180, 180)))
def test_angles_give_the_rotation_back(angles):
    rotation = Turn(angles).matrix()[:, :3]
    assert np.abs(Turn(turn_angles(rotation)).matrix()[:, :3] - rotation).max() < 1e-13


@pytest.mark.parametrize("y", [90.0, -90.0, 90 - 1e-7, 89.9999])
def test_angles_lose_no_digits_where_y_is_near_a_right_angle(y):
    rotation = Turn((33.0, y, -71.0)).matrix()[:, :3]
    assert np.abs(Turn(turn_angles(rotation)).matrix()[:, :3] - rotation).max() < 1e-13


def test_a_turn_goes_before_the_position_and_joins_the_turn_about_the_same_axis():
    document = turn(one(Move((5, 0, 0))), ["n1"], "z", 30)
    assert steps_of(document) == (Turn((0, 0, 30)), Move((5, 0, 0)))
    assert steps_of(turn(document, ["n1"], "z", 15)) == (Turn((0, 0, 45)), Move((5, 0, 0)))
    assert steps_of(turn(document, ["n1"], "z", -30)) == (Move((5, 0, 0)),)
    assert steps_of(turn(turn(document, ["n1"], "z", 200), ["n1"], "z", 0)) == (Turn((0, 0, -130)), Move((5, 0, 0)))


def test_turns_about_other_axes_become_one_turn():
    document = turn(turn(one(), ["n1"], "x", 20), ["n1"], "z", 30)
    assert steps_of(document) == (Turn((20, 0, 30)),)
    (step,) = steps_of(turn(document, ["n1"], "y", 10))
    assert isinstance(step, Turn)


def test_a_turn_about_a_point_moves_the_position():
    assert steps_of(turn(one(Move((10, 0, 3))), ["n1"], "z", 90, (0, 0, 0))) == (Turn((0, 0, 90)), Move((0, 10, 3)))
    assert steps_of(scale(one(Move((10, 0, 3))), ["n1"], 2, point=(5, 0, 3))) == (Scale((2, 2, 2)), Move((15, 0, 3)))


def test_scalings_join():
    document = scale(one(Turn((0, 0, 45)), Move((1, 2, 3))), ["n1"], 2, 1, 1, local=True)
    assert steps_of(document) == (Scale((2, 1, 1)), Turn((0, 0, 45)), Move((1, 2, 3)))
    document = scale(document, ["n1"], 1.5, local=True)
    assert steps_of(document)[0] == Scale((3, 1.5, 1.5)) and len(steps_of(document)) == 3
    document = scale(document, ["n1"], 2)  # the same along all axes: it joins the scaling wherever that stands
    assert steps_of(document) == (Scale((6, 3, 3)), Turn((0, 0, 45)), Move((1, 2, 3)))
    assert steps_of(scale(one(Scale((2, 4, 1))), ["n1"], 0.5, 0.25, 1, local=True)) == ()


def test_expressions_survive():
    width = Expression("width / 2")
    document = set_width(one(Move((width, 0, 0))))
    moved = move(document, ["n1"], 3, 4, 5)
    assert steps_of(moved) == (Move((width, 0, 0)), Move((3, 4, 5)))
    assert steps_of(move(moved, ["n1"], -3, 0, 1)) == (Move((width, 0, 0)), Move((0, 4, 6)))
    assert steps_of(move(document, ["n1"], 0, 4, 0)) == (Move((width, 4, 0)),)  # nothing had to be added
    assert steps_of(turn(moved, ["n1"], "z", 90)) == (Turn((0, 0, 90)), Move((width, 0, 0)), Move((3, 4, 5)))
    turned = turn(moved, ["n1"], "z", 90, (0, 0, 0))
    assert steps_of(turned)[:2] == (Turn((0, 0, 90)), Move((width, 0, 0)))
    assert same(matrix_of(turned)[:, 3], np.array([-4.0, 8.0, 5.0]))
    symbolic_turn = set_width(one(Turn((0, 0, Expression("width"))), Move((5, 0, 0))))
    assert steps_of(turn(symbolic_turn, ["n1"], "z", 30)) == (
        Turn((0, 0, Expression("width"))), Turn((0, 0, 30)), Move((5, 0, 0)),
    )  # fmt: skip


def set_width(document: Document, value: float = 10.0) -> Document:
    return OPERATIONS["set_parameter"](document, "width", value)


def test_what_is_typed_may_be_an_expression():
    document = set_width(one(Move((5, 0, 0))))
    assert steps_of(move(document, ["n1"], 0, "width", 0)) == (Move((5, Expression("width"), 0)),)
    assert steps_of(turn(document, ["n1"], "y", "width")) == (Turn((0, Expression("width"), 0)), Move((5, 0, 0)))
    about_origin = turn(document, ["n1"], "z", "9 * width", (0, 0, 0))
    assert same(matrix_of(about_origin)[:, 3], np.array([0.0, 5.0, 0.0]))
    assert same(matrix_of(set_width(about_origin, 20))[:, 3], np.array([-5.0, 0.0, 0.0]))
    declared = move(one(), ["n1"], parameter("depth", 7))
    assert declared.parameters[0].name == "depth"
    with pytest.raises(Refusal, match="no parameter called height"):
        move(document, ["n1"], "height")
    with pytest.raises(Refusal, match="about x, y or z"):
        turn(document, ["n1"], (1, 1, 0), "width")


NESTED = Document(
    solids=(
        Union(
            id="n1",
            name="Union",
            children=(Box(id="n2").turned(x=20).at(1, 2, 3), Sphere(id="n3").at(7)),
        )
        .scaled(2)
        .turned(z=90)
        .at(100),
    )
)


def test_in_the_world_s_axes_a_nested_node_follows():
    before = matrix_of(NESTED, "n2")
    moved = matrix_of(move(NESTED, ["n2"], 10, 0, 0, world=True), "n2")
    assert same(moved, product(Move((10, 0, 0)).matrix(), before))
    turned = matrix_of(turn(NESTED, ["n2"], "x", 30, world=True), "n2")
    assert same(turned, product(about(turn_about((1, 0, 0), 30)[:, :3], before[:, 3]), before))
    point = (50, 60, 70)
    scaled = matrix_of(scale(NESTED, ["n2"], 2, 1, 3, point, world=True), "n2")
    assert same(scaled, product(about(np.diag((2.0, 1.0, 3.0)), point), before))
    assert find(move(NESTED, ["n3"], 0, 4, 0, world=True), "n3").placement.steps == (Move((9, 0, 0)),)


def find(document: Document, node_id: str) -> Node:
    from solidtree.model.document.tree import find

    return find(document, node_id)


def test_about_the_own_axes():
    before = matrix_of(NESTED, "n2")
    turned = matrix_of(turn(NESTED, ["n2"], "y", 30, local=True), "n2")
    assert same(turned, product(before, Turn((0, 30, 0)).matrix()))


def test_an_expression_in_the_world_s_axes_is_carried_into_the_parent_s():
    document = set_width(NESTED)
    after = move(document, ["n2"], "width", 0, 0, world=True)
    assert same(matrix_of(set_width(after, 30), "n2")[:, 3] - matrix_of(document, "n2")[:, 3], np.array([30.0, 0, 0]))


def test_the_first_place_counts_in_arrays_and_instances():
    array = document_of(LinearArray(children=(Box(),), count=3, step=(20, 0, 0)).turned(z=90))
    (inner,) = array.solids[0].children
    assert same(outer_maps(array, [inner.id])[inner.id], Turn((0, 0, 90)).matrix())
    shared = Document(
        solids=(Instance(id="n2", name="a", definition="n1").at(5), Instance(id="n3", name="b", definition="n1")),
        definitions=(Box(id="n1").turned(z=10),),
    )
    after = move(shared, ["n1"], 0, 0, 4, world=True)
    assert after.definitions[0].placement.steps == (Turn((0, 0, 10)), Move((0, 0, 4)))
    assert after.solids[0] is shared.solids[0]
    with pytest.raises(Refusal, match="no place in the world"):
        move(Document(definitions=(Box(id="n1"),)), ["n1"], 1, world=True)


def test_several_nodes_and_what_lies_below_them():
    after = move(NESTED, ["n1", "n2"], 1, 0, 0)
    assert after.solids[0].children[0] is NESTED.solids[0].children[0]
    after = turn(NESTED, ["n2", "n3"], "z", 90, (0, 0, 0))
    assert find(after, "n3").placement.steps == (Turn((0, 0, 90)), Move((0, 7, 0)))


def test_nothing_to_do_is_the_same_document():
    document = one(Turn((0, 0, 20)), Move((5, 0, 0)))
    assert move(document, ["n1"], 0, 0, 0) is document
    assert turn(document, ["n1"], "z", 0) is document
    assert scale(document, ["n1"], 1) is document
    assert scale(document, ["n1"], 1, local=True) is document
    assert OPERATIONS["set_fields"](document, "n1", (0, 0, 0), size=(20, 20, 20)) is document


@pytest.mark.parametrize(
    ("words", "call"),
    [
        ("flat", lambda d: scale(d, ["n1"], 0)),
        ("flat", lambda d: scale(d, ["n1"], 1, 0, 1, local=True)),
        ("own origin", lambda d: scale(d, ["n1"], 2, point=(1, 1, 1), local=True)),
        ("x, y, z or three numbers", lambda d: turn(d, ["n1"], "w", 3)),
        ("axis must not be 0, 0, 0", lambda d: turn(d, ["n1"], (0, 0, 0), 3)),
        ("no node n9", lambda d: move(d, ["n9"], 1)),
        ("no field width", lambda d: OPERATIONS["set_fields"](d, "n1", width=3)),
    ],
)
def test_refusals(words, call):
    with pytest.raises(Refusal, match=words.replace("width", "'width'")):
        call(one())


def test_a_box_grows_and_its_far_side_stays():
    document = one(Turn((0, 0, 90)), Move((5, 0, 0)))
    after = OPERATIONS["set_fields"](document, "n1", (-3, 0, 0), size=(23, 20, 20))
    far = np.array([20.0, 0, 0, 1])
    assert same(matrix_of(after) @ (23.0, 0, 0, 1), matrix_of(document) @ far)
    assert steps_of(after) == (Turn((0, 0, 90)), Move((5, -3, 0)))


def test_an_inverse_turn_gives_the_placement_back():
    document = one(Turn((0, 0, 20)), Move((5, 0, 0)))
    after = turn(turn(document, ["n1"], "z", 33), ["n1"], "z", -33)
    assert after.solids[0].placement == document.solids[0].placement
    assert same(product(inverse(matrix_of(document)), matrix_of(after)), np.eye(3, 4))
