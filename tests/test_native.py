"""The compiled builder, order and insertion: right by themselves, the same as NumPy's, safe with whatever comes in."""

import dataclasses
import os
import subprocess
import sys
import threading

import numpy as np
import pytest
from painter_check import eyes_around, judged
from render_meshes import ball, drilled

from solidtree.model.partition import native
from solidtree.model.partition.build import build
from solidtree.model.partition.faces import Faces, faces_of_meshes, faces_of_polygons, joined
from solidtree.model.partition.insertion import Moving
from solidtree.model.partition.order import Sorter
from solidtree.model.partition.textbook import build_in_order
from solidtree.model.partition.tree import CONCAVE, CONVEX, INNER, Tree

pytestmark = pytest.mark.skipif(not native.available(), reason="the compiled extension is not here")

SQUARE = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])


def at(ring: np.ndarray, *shift: float) -> np.ndarray:
    return ring + np.array(shift)


def placed(faces: Faces, turn: tuple[float, float], shift: tuple[float, float, float]) -> Faces:
    """The faces turned about z and x (radians) and shifted (mm)."""
    (cz, cx), (sz, sx) = np.cos(turn), np.sin(turn)
    matrix = np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]]) @ np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]])
    normals = faces.planes[:, :3] @ matrix.T
    planes = np.column_stack((normals, faces.planes[:, 3] + normals @ np.array(shift)))
    return dataclasses.replace(faces, points=faces.points @ matrix.T + shift, planes=planes)


def loose(faces: Faces) -> Faces:
    """The same faces as an imported mesh has them, without groups."""
    none = np.full(faces.count, -1, np.int32)
    return dataclasses.replace(faces, group=none, side=np.zeros(faces.count, np.int8))


def crossing(count: int, spread: float = 12.0) -> Faces:
    """Drilled cubes and balls through each other."""
    rng = np.random.default_rng(count)
    kinds = (faces_of_meshes([drilled(24)]), faces_of_meshes([ball(20)]))
    parts = [
        placed(kinds[i % 2], tuple(rng.uniform(0, 6, 2)), tuple(rng.uniform(-spread, spread, 3))) for i in range(count)
    ]
    return joined(parts)


def triangles(count: int, size: float, seed: int = 1) -> Faces:
    rng = np.random.default_rng(seed)
    middles = rng.uniform(-1, 1, (count, 1, 3))
    return faces_of_polygons(list(middles + size * rng.normal(size=(count, 3, 3))))


SCENES = {
    "one part": lambda: faces_of_meshes([drilled(48)]),
    "crossing parts": lambda: crossing(6),
    "crossing imports": lambda: loose(crossing(3)),
    "touching cubes": lambda: joined(
        [placed(faces_of_meshes([drilled(16)]), (0, 0), (20.0 * i, 0, 0)) for i in range(3)]
    ),
    "identical parts": lambda: joined([faces_of_meshes([drilled(16)])] * 3),
    "random triangles": lambda: triangles(60, 0.7),
    "a thousand times flatter": lambda: flattened(crossing(3)),
}


def flattened(faces: Faces) -> Faces:
    flat = np.array([1, 1, 1e-3])
    normals = faces.planes[:, :3] / flat
    length = np.linalg.norm(normals, axis=1)
    planes = np.column_stack((normals, faces.planes[:, 3])) / length[:, None]
    return dataclasses.replace(faces, points=faces.points * flat, planes=planes)


def areas(points: np.ndarray, corners: np.ndarray, starts: np.ndarray, which: np.ndarray) -> np.ndarray:
    """The areas of some polygons."""
    found = []
    for i in which:
        ring = points[corners[starts[i] : starts[i + 1]]]
        found.append(np.linalg.norm(np.cross(ring[1:-1] - ring[0], ring[2:] - ring[0]).sum(axis=0)) / 2)
    return np.array(found)


def owners(tree: Tree) -> np.ndarray:
    """(f,) the node of each fragment, -1: none."""
    node_of = np.full(len(tree.source), -1)
    for node in np.concatenate(tree.levels()):
        owned = slice(tree.first[node], tree.first[node] + tree.count[node])
        assert (node_of[owned] == -1).all(), "two nodes own one fragment"
        assert (np.diff(tree.source[owned]) >= 0).all(), "the fragments of a node do not ascend by source"
        node_of[owned] = node
    return node_of


def assert_is_a_tree_of_its_faces(tree: Tree) -> None:
    """Every fragment lies on its side of all planes above it, and the fragments of a face add up to it."""
    node_of = owners(tree)
    used = np.flatnonzero(node_of >= 0)
    faces = tree.faces
    whole = areas(faces.points, faces.corners, faces.starts, np.arange(faces.count))
    pieces = np.bincount(tree.source[used], areas(tree.points, tree.corners, tree.starts, used), faces.count)
    np.testing.assert_allclose(pieces, whole, rtol=1e-9, atol=1e-9 * faces.size**2)

    parent, way = np.full(len(tree.kind), -1), np.zeros(len(tree.kind))
    for side, children in ((1, tree.front), (-1, tree.back)):
        inner = np.flatnonzero((tree.kind == INNER) & (children >= 0))
        parent[children[inner]], way[children[inner]] = inner, side
    parent[tree.root] = -1
    near = 2 * tree.epsilon + 1e-14 * faces.size
    fragment = np.repeat(np.arange(len(node_of)), np.diff(tree.starts))
    place = tree.points[tree.corners]
    at = node_of[fragment]
    own = (at >= 0) & (tree.kind[at] == INNER)
    plane = tree.plane[at[own]]
    assert np.abs(np.einsum("ij,ij->i", plane[:, :3], place[own]) - plane[:, 3]).max(initial=0) <= 1e-7 * faces.size
    while (at >= 0).any():
        above = np.where(at >= 0, parent[at], -1)
        up = above >= 0
        plane = tree.plane[above[up]]
        heights = np.einsum("ij,ij->i", plane[:, :3], place[up]) - plane[:, 3]
        assert (heights * way[at[up]]).min(initial=0) >= -near
        at = above
    for node in np.concatenate(tree.levels()):
        if tree.kind[node] != INNER:
            assert_leaf_needs_no_order(tree, node, near)


def assert_leaf_needs_no_order(tree: Tree, node: int, near: float) -> None:
    owned = np.arange(tree.first[node], tree.first[node] + tree.count[node])
    sign = {CONVEX: 1, CONCAVE: -1}[tree.kind[node]]
    plane_of = tree.faces.plane_of[tree.source[owned]]
    for fragment, own in zip(owned, plane_of, strict=True):
        ring = tree.points[tree.corners[tree.starts[fragment] : tree.starts[fragment + 1]]]
        planes = tree.faces.planes[plane_of[plane_of != own]]
        assert (sign * (planes[:, :3] @ ring.T - planes[:, 3:])).max(initial=0) <= near


def compiled_order(tree: Tree):
    sorter = Sorter(tree, compiled=True)
    return lambda eye: sorter.fragments(eye.towards, eye.parallel)


@pytest.mark.parametrize("scene", SCENES)
def test_fragments_lie_on_their_side_of_all_planes_and_add_up_to_their_faces(scene):
    assert_is_a_tree_of_its_faces(native.build(SCENES[scene]()))


@pytest.mark.parametrize("scene", SCENES)
def test_what_is_painted_later_is_never_farther(scene):
    tree = native.build(SCENES[scene]())
    assert judged(tree, compiled_order(tree), eyes_around(tree.faces.points, 4)).flawless


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize(
    "builder", [native.build, lambda faces: build(faces, compiled=False)], ids=["compiled", "NumPy"]
)
def test_the_order_is_that_of_numpy_for_any_tree(scene, builder):
    tree = builder(SCENES[scene]())
    mine, other = Sorter(tree, compiled=True), Sorter(tree, compiled=False)
    np.testing.assert_array_equal(mine.fans, other.fans)
    np.testing.assert_array_equal(mine.fragment_of, other.fragment_of)
    for eye in eyes_around(tree.faces.points, 4):
        for front_first in (False, True):
            for ask in ("fragments", "triangles"):
                np.testing.assert_array_equal(
                    getattr(mine, ask)(eye.towards, eye.parallel, front_first),
                    getattr(other, ask)(eye.towards, eye.parallel, front_first),
                )


def test_the_faces_of_a_convex_leaf_are_one_node():
    mesh = dataclasses.replace(ball(200), convex=np.ones(1, bool))
    tree = native.build(faces_of_meshes([mesh]))
    assert (tree.nodes, tree.depth, tree.fragments) == (1, 1, tree.faces.count)


def test_a_fragment_may_have_any_number_of_corners():
    around = np.linspace(0, 2 * np.pi, 500, endpoint=False)
    disc = np.column_stack((np.cos(around), np.sin(around), np.zeros(500)))
    wall = np.array([[0.1, -3, -1], [0.1, 3, -1], [0.1, 3, 1], [0.1, -3, 1]])
    tree = native.build(faces_of_polygons([disc, wall, at(wall, 0.3, 0, 0)]))
    assert_is_a_tree_of_its_faces(tree)
    assert np.diff(tree.starts).max() > 200


def test_the_same_faces_give_the_same_tree():
    one, other = native.build(crossing(4)), native.build(crossing(4))
    for field in dataclasses.fields(Tree):
        if field.name != "faces":
            np.testing.assert_array_equal(getattr(one, field.name), getattr(other, field.name))


# Insertion


@pytest.mark.parametrize("ungrouped", [False, True], ids=["grouped", "imported"])
@pytest.mark.parametrize("shift", [(0, 0, 0), (9, 4, -3), (60, 0, 0)], ids=["inside", "across", "beside"])
def test_a_part_put_in_is_in_order_with_the_rest(shift, ungrouped):
    static, part = crossing(4), placed(faces_of_meshes([drilled(24)]), (0.4, 1.0), shift)
    static, part = (loose(static), loose(part)) if ungrouped else (static, part)
    tree = Moving(native.build(static)).with_faces(part)
    assert_is_a_tree_of_its_faces(tree)
    assert judged(tree, compiled_order(tree), eyes_around(tree.faces.points, 4)).flawless
    np.testing.assert_array_equal(tree.faces.points, joined((static, part)).points)
    for eye in eyes_around(tree.faces.points, 4):
        np.testing.assert_array_equal(
            Sorter(tree, compiled=True).triangles(eye.towards, eye.parallel),
            Sorter(tree, compiled=False).triangles(eye.towards, eye.parallel),
        )


def test_coplanar_faces_put_in_ascend_by_source_with_those_that_were_there():
    floor = [SQUARE, at(SQUARE, 0.5, 0.5, 0), at(SQUARE, 0, 0, 3)]
    tree = Moving(native.build(faces_of_polygons(floor))).with_faces(faces_of_polygons([at(SQUARE, 0.2, 0, 0)]))
    assert_is_a_tree_of_its_faces(tree)
    order = tree.source[Sorter(tree).fragments([0.5, 0.5, 10])]
    assert order.tolist() == [0, 1, 3, 2]


def test_what_was_there_keeps_its_place_and_the_tree_of_what_stays_is_not_touched():
    static = native.build(crossing(4))
    kept = {
        field.name: np.copy(getattr(static, field.name)) for field in dataclasses.fields(Tree) if field.name != "faces"
    }
    tree = Moving(static).with_faces(faces_of_meshes([drilled(24)]))
    for name, array in kept.items():
        np.testing.assert_array_equal(getattr(static, name), array)
    for name in ("points", "corners", "starts", "source"):
        np.testing.assert_array_equal(getattr(tree, name)[: len(kept[name])], kept[name])
    faces = tree.faces
    brought = tree.points[len(static.points) : len(static.points) + len(faces.points) - len(static.faces.points)]
    np.testing.assert_array_equal(brought, faces.points[len(static.faces.points) :])


def test_nothing_put_in_or_nothing_there_before():
    static, nothing = native.build(crossing(2)), faces_of_polygons(())
    assert Moving(static).with_faces(nothing) is static
    tree = Moving(native.build(nothing)).with_faces(static.faces)
    assert_is_a_tree_of_its_faces(tree)


def test_a_part_put_into_a_tree_of_another_builder():
    faces = triangles(30, 0.7)
    for static in (build(faces, compiled=False), build_in_order(faces)):
        tree = Moving(static).with_faces(triangles(20, 0.7, seed=2))
        assert_is_a_tree_of_its_faces(tree)


# Whatever comes in


def test_no_face_and_one():
    assert native.build(faces_of_polygons(())).root == -1
    assert Sorter(native.build(faces_of_polygons(())), compiled=True).triangles([0, 0, 1]).tolist() == []
    tree = native.build(faces_of_polygons([SQUARE[:3]]))
    assert (tree.nodes, tree.fragments, tree.depth) == (1, 1, 1)


def test_ten_thousand_identical_faces():
    tree = native.build(faces_of_polygons([SQUARE] * 10_000))
    assert tree.fragments == 10_000 and tree.depth <= 2
    assert tree.source[Sorter(tree).fragments([0, 0, 5])].tolist() == list(range(10_000))


def test_five_thousand_coplanar_faces_facing_both_ways():
    rng = np.random.default_rng(3)
    shifts = np.column_stack((rng.uniform(-20, 20, (5000, 2)), np.zeros(5000)))
    tree = native.build(
        faces_of_polygons([(SQUARE if i % 3 else SQUARE[::-1]) + shift for i, shift in enumerate(shifts)])
    )
    assert (tree.nodes, tree.fragments) == (1, 5000)


def test_faces_without_area():
    points = np.random.default_rng(4).uniform(-1, 1, (300, 1, 3))
    needles = points + np.arange(3)[None, :, None] * np.array([0.3, 0.1, 0.2])
    faces = faces_of_polygons([*np.repeat(points, 3, axis=1), *needles, SQUARE, at(SQUARE, 0, 0, 0.5)])
    tree = native.build(faces)
    assert set(tree.source[Sorter(tree).fragments([3, 4, 5])].tolist()) == set(range(602))


def test_three_faces_that_overlap_in_a_circle_are_cut():
    plank = np.array([[-2.0, 0.7, 0.3], [2, 0.7, -0.3], [2, 1.1, -0.3], [-2, 1.1, 0.3]])
    turns = [np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]]) for a in (0, 2.0944, 4.1888)]
    tree = native.build(faces_of_polygons([plank @ turn.T for turn in turns]))
    assert tree.fragments > 3
    assert judged(tree, compiled_order(tree), eyes_around(tree.faces.points, 4)).flawless


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"points": np.full((8, 3), np.nan)}, "finite"),
        ({"planes": np.full((2, 4), np.inf)}, "finite"),
        ({"corners": np.full(8, 8, np.int32)}, "refers to"),
        ({"corners": np.full(8, -1, np.int32)}, "refers to"),
        ({"plane_of": np.array([0, 2], np.int32)}, "refers to"),
        ({"starts": np.array([0, 2, 8], np.int32)}, "three corners"),
        ({"starts": np.array([0, 4, 9], np.int32)}, "three corners"),
        ({"group": np.zeros(1, np.int32)}, "fit together"),
        ({"points": np.zeros((8, 2))}, "fit together"),
    ],
)
def test_faces_that_do_not_hold_together_are_refused(change, words):
    faces = dataclasses.replace(faces_of_polygons([SQUARE, at(SQUARE, 0, 0, 1)]), **change)
    with pytest.raises(ValueError, match=words):
        native.build(faces)


@pytest.mark.parametrize(
    "change", [{"front": 0, "back": 0}, {"front": 10**6}, {"first": 10**6}, {"count": 10**6}, {"source": 10**6}]
)
def test_a_tree_that_is_none_is_refused(change):
    tree = native.build(SCENES["random triangles"]())
    broken = {name: np.full_like(getattr(tree, name), value) for name, value in change.items()}
    broken = dataclasses.replace(tree, **broken, kind=np.zeros_like(tree.kind))
    for ask in (
        lambda: Sorter(broken, compiled=True).fragments([0, 0, 5]),
        lambda: Moving(broken).with_faces(faces_of_polygons([SQUARE])),
    ):
        with pytest.raises(ValueError, match="BSP tree"):
            ask()


# Progress, cancelling, threads


def test_progress_is_told_and_what_it_raises_stops_the_work():
    faces = crossing(12)
    told: list[tuple[int, int]] = []
    tree = native.build(faces, lambda done, total: told.append((done, total)))
    assert len(told) > 2
    assert all(done <= total <= tree.fragments for done, total in told)
    assert [done for done, _ in told] == sorted(done for done, _ in told)
    assert told[-1] == (tree.fragments, tree.fragments)

    calls: list[int] = []

    def stop(done: int, total: int) -> None:
        calls.append(done)
        if done:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        native.build(faces, stop)
    assert [done > 0 for done in calls].count(True) == 1 and 0 < calls[-1] < tree.fragments


def test_threads_do_not_get_into_each_others_way():
    scenes = [crossing(3 + i % 3) for i in range(6)]
    alone = [native.build(faces) for faces in scenes]
    eye = np.array([40.0, -70, 30])
    found: dict[int, tuple[Tree, np.ndarray]] = {}

    def work(number: int) -> None:
        tree = native.build(scenes[number])
        found[number] = tree, Sorter(tree).triangles(eye)

    threads = [threading.Thread(target=work, args=(number,)) for number in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for number, tree in enumerate(alone):
        np.testing.assert_array_equal(found[number][0].corners, tree.corners)
        np.testing.assert_array_equal(found[number][1], Sorter(tree).triangles(eye))


def test_an_environment_variable_leaves_it_out():
    def version(**more: str) -> str:
        code = "import sys; from solidtree.gui.command_line import main; sys.exit(main(['--version']))"
        done = subprocess.run([sys.executable, "-c", code], env={**os.environ, **more}, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return done.stdout

    assert "(BSP: compiled)" in version(SOLIDTREE_COMPILED="1")
    assert "(BSP: NumPy)" in version(SOLIDTREE_COMPILED="0")
