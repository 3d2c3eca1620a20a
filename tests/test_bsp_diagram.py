"""The diagram of a BSP tree: every node in its place, large trees folded, and unfolded where one asks."""

import itertools

import numpy as np
import pytest

from solidtree.model.partition.descent import below, sizes
from solidtree.model.partition.faces import faces_of_polygons
from solidtree.model.partition.figure import figure
from solidtree.model.partition.textbook import build_in_order
from solidtree.model.partition.tree import empty_tree
from solidtree.render.drawing.bsp_diagram import LEVELS, STEP, bsp_diagram, unfolded


@pytest.fixture(scope="module")
def tree():
    random = np.random.default_rng(2)
    return build_in_order(
        faces_of_polygons(list(random.uniform(-9, 9, (150, 1, 3)) + random.normal(0, 3, (150, 3, 3))))
    )


def names(tree):
    return [str(node) for node in range(len(tree.kind))]


def test_a_small_tree_is_shown_whole_behind_on_the_left_and_before_on_the_right():
    shown = figure()
    items = bsp_diagram(shown.tree, shown.names)
    assert [item.text for item in items] == ["h1", "B", "h2", "h3", "C", "a", "D", "E", "A"]
    place = {item.text: (item.x, item.y) for item in items}
    assert place["B"][0] < place["h1"][0] < place["h2"][0] < place["C"][0] and place["h3"][0] < place["D"][0]
    assert place["E"][0] < place["a"][0] < place["A"][0]
    for item in items:
        if item.parent >= 0:
            above = items[item.parent]
            assert item.y > above.y and (item.side == "front") == (item.x > above.x)
    assert bsp_diagram(empty_tree(shown.tree.faces), ()) == ()


def test_nothing_overlaps_and_folds_count_what_they_hide(tree):
    items = bsp_diagram(tree, names(tree))
    assert len(items) < 2 ** (LEVELS + 1)
    for one, other in itertools.combinations(items, 2):
        assert one.y != other.y or abs(one.x - other.x) >= one.half + other.half
    hidden = sum(int(item.text[1:].replace(",", "")) for item in items if item.role == "fold")
    assert hidden + sum(item.role in ("plane", "leaf") for item in items) == tree.nodes


def test_unfolding_shows_some_levels_more_and_everything_in_the_end(tree):
    opened = frozenset()
    many = sizes(tree)
    for _ in range(tree.nodes):
        items = bsp_diagram(tree, names(tree), opened)
        folds = [item.node for item in items if item.role == "fold"]
        if not folds:
            break
        wider = opened
        for node in folds:
            wider = unfolded(tree, node, wider)
        shown = {item.node for item in bsp_diagram(tree, names(tree), wider) if item.role != "fold"}
        for node in folds:
            gone = {int(one) for one in below(tree, node)} - shown
            assert len(gone) <= max(int(many[node]) - 1 - STEP, 0)
        assert wider > opened
        opened = wider
    assert {item.node for item in items if item.node >= 0} == set(range(len(tree.kind)))
