"""Random trees of every kind, sound and unsound: an evaluation always answers, and its numbers are consistent."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from solidtree.model.document.document import Document
from solidtree.model.document.resolve import resolve
from solidtree.model.document.tree import numbered, walk
from solidtree.model.script import (
    box,
    circle,
    cone,
    cylinder,
    difference,
    extrude,
    halfspace,
    hull,
    intersection,
    linear_array,
    minkowski,
    mirror,
    parameter,
    polar_array,
    polygon,
    rectangle,
    revolve,
    sphere,
    torus,
    union,
)  # fmt: skip
from solidtree.model.solid.evaluate import Evaluator
from solidtree.model.solid.results import display_of, evaluate_document, measures_of, result_of

numbers = st.sampled_from([-1.0, 0.0, 0.3, 1.0, 2.5, 7.0])
vectors = st.tuples(numbers, numbers, numbers)
leaves = st.one_of(
    st.builds(box, numbers, numbers, numbers),
    st.builds(sphere, numbers, st.just(12)),
    st.builds(lambda r, h: cylinder(r, h, segments=9), numbers, numbers),
    st.builds(lambda r, t: cone(r, t, segments=8), numbers, numbers),
    st.builds(lambda r, t: torus(r, t, segments=8), numbers, numbers),
    st.builds(halfspace, vectors, vectors),
    st.builds(lambda w, h: extrude(rectangle(w, h), 2, twist=30, segments=12), numbers, numbers),
    st.builds(lambda r, x: revolve(circle(r, segments=8).at(x), segments=10), numbers, numbers),
    st.builds(lambda a, b: extrude(polygon([(0, 0), (a, b), (b, -a)])), numbers, numbers),
    st.just(rectangle()),
    st.just(box(parameter("gone", 1) / 0)),
)


def placed(node, step, vector):
    return [node, node.at(*vector), node.turned(*vector), node.scaled(*vector), node.mirrored(vector or (1, 0, 0))][
        step
    ]


def grown(below):
    several = st.lists(below, max_size=4)
    return st.one_of(
        st.builds(union, several),
        st.builds(difference, several),
        st.builds(intersection, several),
        st.builds(hull, several),
        st.builds(lambda a: minkowski(a, box(0.5)), below),
        st.builds(linear_array, below, st.sampled_from([0, 1, 3, 1.5]), vectors),
        st.builds(polar_array, below, st.sampled_from([1, 4]), numbers, vectors, vectors),
        st.builds(mirror, below, vectors, vectors, st.booleans()),
        st.builds(placed, below, st.integers(0, 4), vectors),
    )


trees = st.recursive(leaves, grown, max_leaves=9)


@settings(max_examples=400, deadline=None)
@given(trees)
def test_an_evaluation_always_answers(tree):
    (root,) = numbered([tree])
    document = Document(solids=(root,))
    (result,) = evaluate_document(document, 0.5).solids
    ids = {node.id for node in walk(root)}
    assert all(message.node_id in ids and message.message for message in result.messages)
    if result.solid is None:
        assert any(message.error for message in result.messages)
        return
    measures = measures_of(result.mesh())
    assert measures.volume >= -1e-6 and np.isfinite(measures.area)
    if measures.triangles:
        low, high = np.array(measures.bounds)
        assert measures.volume <= np.prod(high - low) * (1 + 1e-6) + 1e-9


@settings(max_examples=150, deadline=None)
@given(trees, trees)
def test_what_is_kept_changes_no_answer_and_every_face_has_an_owner(first, second):
    evaluator = Evaluator(incremental=True)
    for tree in (first, second, union(first, second), first):
        (root,) = resolve(Document(solids=numbered([tree]))).solids
        warm, cold = evaluator.evaluate(root, 0.5), Evaluator().evaluate(root, 0.5)
        assert (warm.solid is None) == (cold.solid is None) and warm.problems == cold.problems
        if warm.solid is not None:
            size = 1 + abs(cold.solid.volume())
            assert warm.solid.volume() == pytest.approx(cold.solid.volume(), abs=1e-9 * size)
            mesh = display_of(result_of(root, warm), evaluator)
            assert (mesh.owner >= 0).all()
