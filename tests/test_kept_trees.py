"""Trees that are kept by what is shown, and put together from them."""

import gc
from sys import getrefcount

import pytest

from solidtree.gui.view.kept_trees import MOST_PIECES, KeptTrees, meshes, triangles
from solidtree.model.partition import native
from solidtree.model.script import box, cylinder, document_of, sphere
from solidtree.model.solid.evaluate import Evaluator
from solidtree.model.solid.results import display_of, result_of


def shown_of(*roots):
    evaluator = Evaluator()
    solids = document_of(*roots).solids
    return tuple((root.id, display_of(result_of(root, evaluator.evaluate(root, 0.05)), evaluator)) for root in solids)


@pytest.fixture
def shown():
    return shown_of(box(4), sphere(2, segments=16).at(4, 2, 2), cylinder(radius=1, height=9, segments=24))


def test_a_tree_is_found_for_the_very_meshes_in_any_order(shown):
    trees = KeptTrees()
    assert trees.find(shown) is None
    tree = trees.build(shown).tree
    assert shown in trees and tree.faces.count == triangles(shown)
    found = trees.find(shown[::-1])
    assert found.tree is tree and found.built and found.solid_ids == tuple(solid_id for solid_id, _ in shown)
    equal = shown_of(box(4), sphere(2, segments=16).at(4, 2, 2), cylinder(radius=1, height=9, segments=24))
    assert equal not in trees  # other objects, though of the same shape


def test_what_a_kept_tree_lacks_is_put_into_it(shown):
    trees = KeptTrees()
    trees.build(shown[:1])
    trees.build(shown[:2])
    found = trees.find(shown)
    if not native.available():
        assert found is None
        return
    assert found.solid_ids == tuple(solid_id for solid_id, _ in shown) and not found.built
    assert found.tree.faces.count == triangles(shown) and shown not in trees
    static = trees.find(shown[:2]).tree
    assert (found.tree.points[: len(static.points)] == static.points).all()  # the larger one was taken


def test_a_tree_with_what_is_no_longer_shown_is_no_use(shown):
    trees = KeptTrees()
    trees.build(shown)
    assert trees.find(shown[:2]) is None


def test_a_tree_that_is_not_kept_is_built_again(shown):
    trees = KeptTrees()
    assert trees.build(shown, keep=False).built and trees.find(shown) is None


def test_the_oldest_trees_go_when_there_are_too_many_pieces(shown, monkeypatch):
    trees = KeptTrees()
    pieces = [len(trees.build(entry).tree.source) for entry in (shown[:1], shown[1:2], shown[2:])]
    assert sum(pieces) < MOST_PIECES
    monkeypatch.setattr("solidtree.gui.view.kept_trees.MOST_PIECES", pieces[0] + pieces[2] + 3)
    trees.find(shown[:1])  # used again
    trees.build(shown[2:])
    assert shown[1:2] not in trees and shown[:1] in trees and shown[2:] in trees
    assert [mesh for _, mesh in shown] == list(meshes(shown))


def test_cleared_trees_are_gone_and_hold_nothing_that_was_shown(shown):
    trees, entry = KeptTrees(), shown[0]
    before = getrefcount(entry)
    tree = trees.build(shown[:1]).tree
    trees.find(shown)
    assert trees.seconds(tree) is not None and getrefcount(entry) > before
    trees.clear()
    gc.collect()
    assert getrefcount(entry) == before
    assert trees.find(shown[:1]) is None and trees.seconds(tree) is None


def test_many_triangles_do_not_fit_into_a_picture_s_time(shown):
    trees = KeptTrees()
    ball = shown_of(sphere(10, segments=512))
    assert trees.fits(shown[:1]) and not trees.fits(ball) and not trees.fits_in(ball)
