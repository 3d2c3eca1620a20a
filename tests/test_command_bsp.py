"""`solidtree bsp` and `bsp_tree` in scripts: figures of trees that can be counted by hand, and what is refused."""

import json

import numpy as np
import pytest

from solidtree.model.partition.descent import counts, cut_fragments, node_of_fragments, owned, parents, sizes
from solidtree.model.partition.faces import faces_of_polygons
from solidtree.model.partition.report import MOST_IN_ORDER, built
from solidtree.model.script import Refusal, box, bsp_tree, document_of, save, sphere

KEYS = ["faces", "fragments", "fragments_per_face", "splits", "nodes", "depth", "leaves", "build_seconds",
        "order_seconds", "builder"]  # fmt: skip


@pytest.fixture
def file(tmp_path):
    save(tmp_path / "two.solidtree", document_of(a=box(10), b=box(10).at(30)))
    return tmp_path / "two.solidtree"


def test_two_boxes_apart_need_no_cut_and_three_nodes(solidtree, file):
    status, out, err = solidtree("bsp", file)
    told = json.loads(out)
    assert status == 0 and err == "" and list(told) == KEYS
    assert [told[key] for key in KEYS[:7]] == [24, 24, 1.0, 0, 3, 2, 2]
    assert told["builder"] in ("compiled", "numpy") and told["build_seconds"] > 0 and told["order_seconds"] > 0
    one = json.loads(solidtree("bsp", file, "--solid", "b")[1])
    assert [one[key] for key in KEYS[:7]] == [12, 12, 1.0, 0, 1, 1, 1]  # one convex body: one leaf, nothing to order


def test_the_textbook_takes_a_plane_for_every_side_of_a_box(solidtree, file):
    told = json.loads(solidtree("bsp", file, "--solid", "a", "--builder", "textbook")[1])
    assert [told[key] for key in KEYS[:7]] == [12, 12, 1.0, 0, 6, 6, 0] and told["builder"] == "textbook"


def test_what_cannot_be_is_said_in_one_line(solidtree, file, tmp_path):
    assert solidtree("bsp", file, "--solid", "c") == (
        2, "", f"solidtree: {file}: there is no solid called “c”; there is “a”, “b”\n")  # fmt: skip
    save(tmp_path / "many.solidtree", document_of(sphere(10, segments=60)))
    status, out, err = solidtree("bsp", tmp_path / "many.solidtree", "--builder", "textbook")
    assert (status, out) == (2, "") and f"up to {MOST_IN_ORDER:,} faces" in err and err.count("\n") == 1
    with pytest.raises(Refusal, match="up to"):
        bsp_tree(sphere(10, segments=60), builder="textbook")
    with pytest.raises(Refusal, match="good or textbook"):
        bsp_tree(box(1), builder="best")


def test_scripts_get_the_tree():
    tree = bsp_tree(box(10), box(10).at(30))
    assert (tree.nodes, tree.depth, tree.fragments) == (3, 2, 24)
    assert bsp_tree(sphere(10, segments=80)).depth == 1


def test_counts_of_a_tree_of_crossing_squares():
    """Three squares through one middle: the second is cut once, the third into four."""
    square = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], float)
    planes = [np.insert(square, axis, 0, axis=1) for axis in range(3)]
    tree, told = built(faces_of_polygons(planes), "textbook")
    assert (told.counts.faces, told.counts.fragments, told.counts.splits) == (3, 7, 4)
    assert told.counts == counts(tree) and told.counts.fragments_per_face == pytest.approx(7 / 3)
    up, many, node = parents(tree), sizes(tree), node_of_fragments(tree)
    assert many[tree.root] == tree.nodes == 7 and up[tree.root] == -1
    for place in range(7):
        family = [int(child) for child in (tree.front[place], tree.back[place]) if child >= 0]
        assert all(up[child] == place for child in family) and many[place] == 1 + sum(many[family])
        assert set(owned(tree, np.array([place]))) == set(np.flatnonzero(node == place))
    whole = tree.source[~cut_fragments(tree)]
    assert list(whole) == [0]
