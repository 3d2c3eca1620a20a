"""Measured moves as steps of the history, in documents and scripts."""

import numpy as np
import pytest

from solidtree.model.document.document import parameter_values
from solidtree.model.document.errors import Refusal
from solidtree.model.document.expression import Expression
from solidtree.model.document.placement import IDENTITY, Move, product
from solidtree.model.document.tree import find
from solidtree.model.editing.session import Session
from solidtree.model.measuring.arrange import aligned, laid
from solidtree.model.operations.arranging import followed_in_world, parent_moves, shift
from solidtree.model.operations.operations import OPERATIONS
from solidtree.model.script import (
    align,
    box,
    cylinder,
    distribute,
    document_of,
    dropped,
    measure,
    parameter,
    sphere,
    turned,
    union,
)
from solidtree.model.solid.places import places_of


def test_each_node_has_a_move_of_its_own():
    document = document_of(union(box(1), sphere(2).at(3)), box(4))
    after = shift(document, {"n3": (1, 0, 0), "n4": (0, 2, 0), "n2": (0, 0, 0)})
    assert find(after, "n3").placement.steps == (Move((4, 0, 0)),)
    assert find(after, "n4").placement.position == (0, 2, 0)
    assert find(after, "n2") is find(document, "n2")
    assert shift(document, {}) is document and shift(document, {"n2": (0, 0, 0)}) is document


def test_an_expression_stays():
    width = parameter("width", 10)
    document = document_of(box(1).at(width, 0, 0))
    after = shift(document, {"n1": (5, 0, 1)})
    numbers = [n for step in find(after, "n1").placement.steps for n in step.numbers]
    assert any(isinstance(n, Expression) and "width" in n.text for n in numbers)
    values = parameter_values(after.parameters)[0]
    assert np.allclose(find(after, "n1").placement.resolve(values).matrix()[:, 3], (15, 0, 1))


@pytest.mark.parametrize(
    ("moves", "words"),
    [
        ([("n1", (1, 0, 0))], "by the nodes' ids"),
        ({"n9": (1, 0, 0)}, "no node n9"),
        ({"n1": (1, 0)}, "3 numbers"),
        ({"n1": ("width", 0, 0)}, "are numbers"),
        ({"n1": (1, 0, 0), "n2": (1, 0, 0)}, "n2 moves with what it stands in"),
    ],
)
def test_wrong_moves_are_refused(moves, words):
    with pytest.raises(Refusal, match=words):
        shift(document_of(union(box(1), box(parameter("width", 3)))), moves)


def test_the_echo_does_the_same_without_evaluating():
    session = Session(document_of(union(box(1), sphere(2)), box(4)))
    first = session.document
    session.do("shift", {"n2": (1.5, 0.0, 0.0), "n4": (0.0, 2.0, -1.0)}, label="Align")
    assert session.log == ("shift({'n2': (1.5, 0, 0), 'n4': (0, 2, -1)})",)
    again = eval(session.log[0], {"shift": lambda moves: OPERATIONS["shift"](first, moves)})
    assert again.solids == session.document.solids
    session.undo()
    assert session.document is first


def test_a_move_of_the_world_is_turned_into_the_parent_s_axes():
    inner = box(2).at(5)
    document = document_of(union(inner, box(1)).turned(x=20, z=90).scaled(2).at(7, 8, 9))
    moves = parent_moves(document, ["n2"], [(0, 10, 0)])
    after = shift(document, moves)
    before_at, after_at = (places_of(d.solids, ["n2"])["n2"][0].matrix[:, 3] for d in (document, after))
    assert np.allclose(after_at - before_at, (0, 10, 0))
    assert parent_moves(document, ["n2"], [(0, 0, 0)]) == {}


def world(document, node_id):
    return places_of(document.solids, [node_id])[node_id][0]


@pytest.mark.parametrize("parent", [lambda n: n, lambda n: n.turned(30, 40, 50).scaled(3).at(1, 2, 3),
                                    lambda n: n.scaled(1, 2, 3).turned(z=30)])  # fmt: skip
@pytest.mark.parametrize("own", [lambda n: n, lambda n: n.at(4, 5, 6), lambda n: n.turned(10, 20, 30).at(1),
                                 lambda n: n.mirrored((1, 1, 0)).at(1).turned(z=5)])  # fmt: skip
def test_a_map_of_the_world_follows_the_placement(parent, own):
    document = document_of(parent(union(own(box(2, 3, 4)), box(1))))
    place = world(document, "n2")
    matrix = laid((1, 2, 3), (0.2, 0.3, -1), (7, 8, 9), (1, 2, 2))
    placement = followed_in_world(place.node.placement, place.outer, matrix, {})
    found = product(place.outer, placement.matrix())
    assert np.allclose(found, product(matrix, place.matrix), atol=1e-5)


def test_the_dust_of_single_precision_is_wiped_off_turns():
    """A ramp of 30 degrees whose normal comes from a mesh: nobody wants to read 29.99999965."""
    normal = np.array([np.sin(np.pi / 6) + 3e-8, 0, np.cos(np.pi / 6) - 2e-8])
    placement = followed_in_world(box(1).placement, IDENTITY, laid((0, 0, 0), (0, 0, -1), (1, 2, 3), normal), {}, 5)
    assert placement == box(1).turned(y=30).at(1, 2, 3).placement
    flat = followed_in_world(box(1).placement, IDENTITY, laid((0, 0, 0), (1e-9, 0, -1), (1, 2, 3), (0, 0, 1)), {}, 5)
    assert flat == box(1).at(1, 2, 3).placement


def test_laying_twice_leaves_one_turn_and_one_move():
    placement = box(1).at(3, 4, 5).placement
    for facing in ((1, 2, 3), (0, 1, 0), (0.3, -1, 2)):
        placement = followed_in_world(placement, IDENTITY, laid((0, 0, 0), (0, 0, -1), (9, 9, 9), facing), {})
        assert len(placement.steps) <= 2
    assert followed_in_world(placement, IDENTITY, IDENTITY, {}) == placement


def test_scripts_align_distribute_and_drop():
    tall = cylinder(5, 30).turned(y=90)
    solids = align(box(10), box(4).at(50, 1, 2), tall, axis="z", side="max")
    assert [measure(s).bounds[1][2] for s in solids] == pytest.approx([10, 10, 10])
    assert solids[0].placement == box(10).placement
    (one,) = align(box(10).at(3), side="middle", to=0)
    assert measure(one).bounds[0][0] == -5
    row = distribute([box(10), box(2).at(11), box(4).at(30)])
    assert [measure(s).bounds[0][0] for s in row] == pytest.approx([0, 19, 30])
    assert measure(dropped(sphere(5).at(0, 0, 40))).bounds[0][2] == pytest.approx(0)
    with pytest.raises(Refusal, match="empty"):
        dropped(box(1) - box(2).at(-0.5, -0.5, -0.5))


def test_the_moves_of_an_alignment_are_whole_where_they_can_be():
    bounds = [measure(s).bounds for s in (box(0.1), box(0.3).at(0.7))]
    assert aligned(bounds, "x", "max")[1].tolist() == [-0.9, 0, 0]


def test_placements_of_many_steps_are_not_unrolled():
    lens = parameter("lens", 4)
    node = box(1).placed(turned(x=lens), turned(z=30))
    placement = followed_in_world(
        node.placement, IDENTITY, laid((0, 0, 0), (0, 0, 1), (0, 0, 0), (1, 0, 0)), {"lens": 4}
    )
    assert placement.symbolic()
