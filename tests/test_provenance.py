"""Every face of a result knows the occurrence that made it."""

import numpy as np
import pytest

from solidtree.model.document.document import Document
from solidtree.model.document.nodes import Instance
from solidtree.model.document.resolve import resolve
from solidtree.model.document.tree import numbered
from solidtree.model.script import (
    box,
    cylinder,
    halfspace,
    hull,
    intersection,
    linear_array,
    mirror,
    polar_array,
    sphere,
    union,
)  # fmt: skip
from solidtree.model.solid.evaluate import Evaluator
from solidtree.model.solid.results import display_of, result_of


def shown(node, incremental=False, evaluator=None):
    """The picture of a tree and, per triangle, the name of the leaf that made it."""
    (root,) = numbered([node])
    evaluator = evaluator or Evaluator(incremental=incremental)
    mesh = display_of(result_of(root, evaluator.evaluate(root)), evaluator)
    names = {n.id: n.name for n in _walk(root)}
    assert (mesh.owner >= 0).all()
    return mesh, np.array([names[mesh.owners[i][-1]] for i in mesh.owner])


def _walk(root):
    stack = [root]
    while stack:
        stack += stack[-1].children if (node := stack.pop()) is None else node.children
        yield node


def middles(mesh):
    return mesh.points[mesh.triangles].astype(float).mean(axis=1)


def test_the_wall_of_a_hole_belongs_to_the_subtracted_cylinder():
    mesh, names = shown(box(20).named("cube") - cylinder(5, 30, segments=16).at(10, 10, -5).named("drill"))
    assert len(np.unique(mesh.facet)) == 6 + 16
    from_axis = np.hypot(*(middles(mesh)[:, :2] - 10).T)
    wall = (from_axis < 5.01) & (np.abs(middles(mesh)[:, 2] - 10) < 9.99)
    assert (names[wall] == "drill").all() and (names[~wall] == "cube").all()
    assert (mesh.subtracted == wall).all()


def test_the_cap_belongs_to_the_half_space():
    mesh, names = shown(sphere(10).named("ball") & halfspace((1, 2, 2), (1, 0, 0)).named("plane"))
    on_plane = np.abs((middles(mesh) - (1, 0, 0)) @ np.array([1, 2, 2]) / 3) < 1e-5
    assert on_plane.any() and (names[on_plane] == "plane").all() and (names[~on_plane] == "ball").all()


def test_equal_parts_in_different_places_are_told_apart():
    balls = [sphere(2, segments=24).at(7 * i, 3 * i).named(str(i)) for i in range(6)]
    mesh, names = shown(union(*balls).turned(10, 20, 30).scaled(2).at(1, 2, 3))
    bounds = np.array([mesh.points[mesh.triangles[names == str(i)]].reshape(-1, 3).mean(axis=0) for i in range(6)])
    steps = np.diff(bounds, axis=0)
    assert np.allclose(np.linalg.norm(steps, axis=1), 2 * np.hypot(7, 3), rtol=1e-3)


def test_copies_carry_their_number():
    (root,) = numbered([polar_array(linear_array(box(1), 3, (2, 0, 0)).at(4), 5)])
    evaluator = Evaluator()
    mesh = display_of(result_of(root, evaluator.evaluate(root)), evaluator)
    assert len(mesh.owners) == 15 == len(np.unique(mesh.owner))
    assert mesh.owners[0] == ("n1", 0, "n2", 0, "n3") and mesh.owners[-1] == ("n1", 4, "n2", 2, "n3")
    # Copy i of 5 is turned by i * 72 degrees and copy j of 3 lies 2 j farther out.
    for number, (i, j) in enumerate((i, j) for i in range(5) for j in range(3)):
        middle = mesh.points[mesh.triangles[mesh.owner == number]].reshape(-1, 3)
        angle = np.radians(72 * i)
        x, y = 4.5 + 2 * j, 0.5
        expected = (x * np.cos(angle) - y * np.sin(angle), x * np.sin(angle) + y * np.cos(angle))
        assert (middle.min(axis=0) + middle.max(axis=0))[:2] / 2 == pytest.approx(expected, abs=1e-5)


def test_mirror_images_and_instances():
    mesh, _ = shown(mirror(box(1).at(3), (1, 0, 0)))
    assert [path[1] for path in mesh.owners] == [0, 1]
    left = mesh.points[mesh.triangles[mesh.owner == 1]].reshape(-1, 3)
    assert left[:, 0].max() == -3
    document = Document(
        solids=(union(Instance(id="a", definition="d"), Instance(id="b", definition="d").at(9)).with_(id="u"),),
        definitions=((box(1).with_(id="p") - box(0.5).with_(id="q")).with_(id="d"),),
    )
    root = resolve(document).solids[0]
    evaluator = Evaluator()
    mesh = display_of(result_of(root, evaluator.evaluate(root)), evaluator)
    assert mesh.owners == tuple(("u", i, "d", leaf) for i in "ab" for leaf in "pq")
    assert set(mesh.owner) == {0, 1, 2, 3}


def test_a_hull_is_the_owner_of_its_faces():
    _, names = shown(hull(sphere(1), sphere(2).at(9)).named("skin") + box(1).at(0, 0, 5).named("knob"))
    assert set(names) == {"skin", "knob"}


def test_an_incremental_result_knows_its_owners_too():
    def tree(x):
        holes = [cylinder(1, 6, segments=12).at(3 + 5 * i, 3 + 5 * j, -1) for i in range(10) for j in range(6)]
        holes[23] = cylinder(1, 6, segments=12).at(19.4 + x, 19.1, -1).named("moving")
        return box(52, 32, 4).named("plate") - union(*holes)

    evaluator = Evaluator(incremental=True)
    for x in (0, 0.3, 0.6, 0):
        mesh, names = shown(tree(x), evaluator=evaluator)
        walls = middles(mesh)[names == "moving"]
        assert len(walls) and (np.hypot(walls[:, 0] - 19.4 - x, walls[:, 1] - 19.1) < 1.01).all()
        assert mesh.subtracted[names == "moving"].all() and not mesh.subtracted[names == "plate"].any()


def test_random_trees_against_the_surfaces_of_their_leaves():
    rng = np.random.default_rng(5)
    for _ in range(12):
        leaves = [
            [box(6, 5, 4), sphere(3, segments=20), cylinder(2, 7, segments=14)][i % 3]
            .turned(*rng.uniform(0, 360, 3)).at(*rng.uniform(-3, 3, 3)).named(str(i))
            for i in range(7)
        ]  # fmt: skip
        a, b, c, d, e, f, g = leaves
        tree = (union(a, b) - c + intersection(d, union(e, f))).turned(*rng.uniform(0, 360, 3)) - g
        mesh, names = shown(tree)
        matrix = tree.children[0].placement.matrix() if tree.children[0].placement.steps else np.eye(3, 4)
        points = middles(mesh)
        for leaf in leaves:
            mine = points[names == leaf.name]
            if leaf is not g:
                mine = (mine - matrix[:, 3]) @ np.linalg.inv(matrix[:, :3]).T
            placed = leaf.placement.matrix()
            local = (mine - placed[:, 3]) @ np.linalg.inv(placed[:, :3]).T
            surface, _ = shown(leaf.with_(placement=type(leaf.placement)()))
            corners = surface.points[surface.triangles].astype(float)
            normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
            normals /= np.linalg.norm(normals, axis=1, keepdims=True)
            offset = np.einsum("ij,ij->i", normals, corners[:, 0])
            if len(local):
                # On one of the leaf's planes, and within all others: the leaves are convex.
                height = local @ normals.T - offset
                assert np.abs(height.max(axis=1)).max() < 1e-4
