"""The builders of the BSP tree: nothing is painted in a wrong order, little is cut, and every input ends."""

import dataclasses

import numpy as np
import pytest
from painter_check import centroid_order, eyes_around, judge, judged
from partition_scenes import (
    SCENES,
    bars,
    crossing,
    disc,
    dumbbell,
    faces_of,
    loose,
    mesh_of,
    part,
    plate,
    soup,
    sponge,
)  # fmt: skip

from solidtree.model.document.errors import Refusal
from solidtree.model.partition import build as build_module
from solidtree.model.partition import native
from solidtree.model.partition.build import build
from solidtree.model.partition.faces import Faces, faces_of_meshes, faces_of_polygons
from solidtree.model.partition.order import Sorter
from solidtree.model.partition.textbook import build_in_order
from solidtree.model.partition.tree import CONCAVE, CONVEX, INNER, Tree
from solidtree.model.script import box, sphere


@pytest.fixture(params=[False, True], ids=["numpy", "compiled"])
def compiled(request) -> bool:
    if request.param and not native.available():
        pytest.skip("the compiled extension is not here")
    return request.param


def painted(tree: Tree, compiled: bool, count=8, pixels=96):
    """What the rasteriser says of the tree's own order."""
    sorter = Sorter(tree, compiled=compiled)
    eyes = eyes_around(tree.faces.points, count, pixels=pixels)
    return judged(tree, lambda eye: sorter.fragments(eye.towards, eye.parallel), eyes)


def owned(tree: Tree) -> np.ndarray:
    """The fragments that count."""
    return np.concatenate(
        [np.arange(tree.first[n], tree.first[n] + tree.count[n]) for n in np.concatenate(tree.levels())]
    )


def areas(points: np.ndarray, corners: np.ndarray, starts: np.ndarray) -> np.ndarray:
    sizes = np.diff(starts)
    origin = np.repeat(points[corners[starts[:-1]]], sizes, axis=0)
    following = np.arange(1, len(corners) + 1)
    following[starts[1:] - 1] = starts[:-1]
    across = np.cross(points[corners] - origin, points[corners[following]] - origin)
    return np.linalg.norm(np.add.reduceat(across, starts[:-1], axis=0), axis=1) / 2


def check_tree(tree: Tree) -> None:
    """Every fragment lies on the right side of all planes above it, in its own node's plane, and no area is lost."""
    faces, near = tree.faces, 2 * tree.epsilon
    seen: list[int] = []
    waiting: list[tuple[int, list[tuple[int, float]]]] = [(tree.root, [])]
    while waiting:
        node, above = waiting.pop()
        own = np.arange(tree.first[node], tree.first[node] + tree.count[node])
        seen += own.tolist()
        assert (np.diff(tree.source[own]) >= 0).all()
        corners = np.unique(np.concatenate([tree.corners[tree.starts[f] : tree.starts[f + 1]] for f in own] or [[]]))
        points = tree.points[corners.astype(int)]
        for other, sign in above:
            assert (sign * (points @ tree.plane[other, :3] - tree.plane[other, 3]) >= -near).all()
        if tree.kind[node] == INNER:
            assert (np.abs(points @ tree.plane[node, :3] - tree.plane[node, 3]) <= max(near, 2e-7 * faces.size)).all()
            for child, sign in ((tree.front[node], 1.0), (tree.back[node], -1.0)):
                if child >= 0:
                    waiting.append((child, [*above, (node, sign)]))
        else:
            assert tree.front[node] < 0 and tree.back[node] < 0 and len(own)
            sign = {CONVEX: 1.0, CONCAVE: -1.0}[tree.kind[node]]
            for f in own:
                plane = faces.planes[faces.plane_of[tree.source[f]]]
                ring = tree.points[tree.corners[tree.starts[f] : tree.starts[f + 1]]]
                if len(own) > 1 and areas(ring, np.arange(len(ring)), np.array([0, len(ring)]))[0] > 1e-9:
                    assert (sign * (points @ plane[:3] - plane[3]) <= near).all()
    assert len(set(seen)) == len(seen) == tree.fragments
    pieces = np.bincount(tree.source, areas(tree.points, tree.corners, tree.starts), faces.count)
    assert np.allclose(pieces, areas(faces.points, faces.corners, faces.starts), atol=1e-7 * faces.size**2)


@pytest.mark.parametrize("name", SCENES)
def test_the_painters_order_is_right_at_every_layer(name: str, compiled: bool):
    assert painted(build(SCENES[name](), compiled=compiled), compiled).flawless


def test_the_scenes_of_the_corpus(corpus, compiled: bool):
    files = sorted((corpus / "hsr" / "scenes").glob("*.obj"))
    assert len(files) >= 8
    for file in files:
        words = [line.split() for line in file.read_text().splitlines()]
        points = np.array([word[1:4] for word in words if word[:1] == ["v"]], float)
        rings = [[int(corner.split("/")[0]) - 1 for corner in word[1:]] for word in words if word[:1] == ["f"]]
        triangles = [points[[ring[0], *ring[i : i + 2]]] for ring in rings for i in range(1, len(ring) - 1)]
        assert painted(build(faces_of_polygons(triangles), compiled=compiled), compiled, 4, 64).flawless, file.stem


@pytest.mark.parametrize("name", ["a CSG part", "crossing parts", "a torus", "a soup", "touching cubes", "far away"])
def test_fragments_keep_to_their_sides_and_add_up(name: str, compiled: bool):
    check_tree(build(SCENES[name](), compiled=compiled))


def test_the_textbooks_tree_passes_the_same_checks():
    for faces in (faces_of(box(4), box(4).at(2, 1, 3).turned(z=30)), bars(), soup(12), faces_of(plate(1, 12))):
        tree = build_in_order(faces)
        check_tree(tree)
        assert painted(tree, False, 4).flawless


def test_sorting_by_middles_fails_the_check():
    for faces, visible in ((faces_of(plate()), True), (faces_of(*crossing(4)), True), (bars(), True)):
        tree = build(faces, compiled=False)
        verdict = judged(tree, lambda eye, tree=tree: centroid_order(tree, eye), eyes_around(faces.points, 8))
        assert verdict.disordered > 0 and (verdict.wrong > 0) == visible and not verdict.lost


def test_the_check_sees_what_is_missing_or_there_twice():
    tree = build(faces_of(part()), compiled=False)
    eye = eyes_around(tree.points, 1)[0]
    order = Sorter(tree).fragments(eye.towards)
    assert judge(tree, order, eye).flawless
    drawn = order[np.isin(tree.source[order], np.unique(tree.source[order[-40:]]))]
    assert judge(tree, order[~np.isin(order, drawn)], eye).lost > 0
    assert judge(tree, np.concatenate((order, drawn)), eye).lost > 0
    assert judge(tree, order[::-1], eye).wrong > 0


def test_a_convex_solid_is_one_leaf_however_fine(compiled: bool):
    faces = faces_of(sphere(10, segments=160))
    tree = build(faces, compiled=compiled)
    assert faces.count > 10_000 and (tree.nodes, tree.depth, tree.fragments) == (1, 1, faces.count)
    assert tree.kind[tree.root] == CONVEX


def test_a_hollow_is_one_leaf_that_is_seen_from_inside():
    hollow = faces_of(box(30, centred=True) - sphere(10, segments=64))
    tree = build(hollow, compiled=False)
    reached = np.concatenate(tree.levels())
    inside = reached[tree.kind[reached] == CONCAVE]
    assert tree.count[inside].tolist() == [hollow.count - 12]
    assert tree.fragments == hollow.count and tree.depth <= 7


@pytest.mark.parametrize(
    ("nodes", "most"),
    [
        (lambda: [plate(10, 24)], 1.25),
        (lambda: [sponge(2)], 1.5),
        (lambda: [part(32)], 1.5),
        (lambda: [dumbbell(32)], 1.5),
        (lambda: crossing(8, 24, 12.0), 2.0),
    ],
    ids=["plate", "sponge", "part", "dumbbell", "crossing"],
)
def test_few_faces_are_cut(nodes, most: float, compiled: bool):
    tree = build(faces_of(*nodes()), compiled=compiled)
    assert 1.0 <= tree.fragments / tree.faces.count <= most


def test_smooth_solids_without_provenance_stay_shallow(compiled: bool):
    tree = build(loose(faces_of(sphere(10, segments=64))), compiled=compiled)
    assert tree.depth < 100 and tree.fragments < 1.5 * tree.faces.count


def test_a_fragment_may_have_more_corners_than_64(compiled: bool):
    square = np.array([[0.97, -2, -1], [0.97, 2, -1], [0.97, 2, 1], [0.97, -2, 1.0]])
    slanted = np.array([[-2.0, -2, -1], [2, -2, -1], [2, 2, 1.5], [-2, 2, 1.5]])
    tree = build(faces_of_polygons([disc(500), square, slanted]), compiled=compiled)
    check_tree(tree)
    assert np.diff(tree.starts)[owned(tree)].max() > 64
    assert painted(tree, compiled).flawless


def test_pieces_of_neighbours_meet_in_the_same_points(compiled: bool):
    """Sheets in one plane make it the best to part a wall of triangles; each of the wall's sides has one new point."""
    across = np.linspace(-3, 3, 14)
    zigzag = np.column_stack((across, 0.1 * across**2, np.where(np.arange(14) % 2, 1.1, -0.9)))
    wall = [zigzag[i : i + 3] if i % 2 else zigzag[i : i + 3][::-1] for i in range(12)]
    sheet = np.array([[-9.0, -9, 0.03], [9, -9, -0.07], [9, 9, -0.05], [-9, 9, 0.05]])
    tree = build(faces_of_polygons([sheet, *wall]), compiled=compiled)
    straight = build_in_order(faces_of_polygons([sheet, *wall]))
    added = {tuple(point) for point in straight.points[len(straight.faces.points) :]}
    assert len(added) == 13 and len(straight.points) - len(straight.faces.points) == 24
    for side in range(13):
        low, high = sorted(zigzag[side : side + 2], key=lambda end: end[2])
        ends = tree.points[len(tree.faces.points) :]
        on = np.linalg.norm(np.cross(ends - low, high - low), axis=1) < 1e-9
        near = [tuple(end) for end in ends[on]]
        assert len(set(near)) == len({tuple(np.round(end, 9)) for end in near})


def test_coplanar_faces_of_a_node_keep_their_order(compiled: bool):
    rings = [disc(12, radius) for radius in (1, 3, 2, 3)]
    tree = build(faces_of_polygons(rings), compiled=compiled)
    for eye in ([0, 0, 5], [0, 0, -5]):
        assert tree.source[Sorter(tree, compiled).fragments(eye)].tolist() == [0, 1, 2, 3]


def test_nothing_and_next_to_nothing(compiled: bool):
    empty = build(faces_of_polygons(()), compiled=compiled)
    assert (empty.nodes, empty.depth, empty.fragments, empty.root) == (0, 0, 0, -1)
    assert Sorter(empty, compiled).triangles([0, 0, 1]).tolist() == []
    one = build(faces_of_polygons([disc(3)]), compiled=compiled)
    assert (one.nodes, one.depth, one.fragments) == (1, 1, 1)
    assert Sorter(one, compiled).triangles([0, 0, 1]).tolist() == [0]
    point = build(faces_of_polygons([np.zeros((3, 3))] * 3), compiled=compiled)
    assert sorted(Sorter(point, compiled).fragments([0, 0, 1]).tolist()) == [0, 1, 2]


def test_faces_without_an_area_end_and_harm_nobody(compiled: bool):
    rng = np.random.default_rng(5)
    needles = [np.array([a, a, b]) for a, b in rng.uniform(-3, 3, (60, 2, 3))]
    needles += [np.array([a, (a + b) / 2, b]) for a, b in rng.uniform(-3, 3, (60, 2, 3))]
    cube = faces_of(box(4, centred=True))
    faces = faces_of_polygons([*needles, *cube.points[cube.corners.reshape(-1, 3)], *[np.ones((3, 3))] * 20])
    tree = build(faces, compiled=compiled)
    assert painted(tree, compiled).flawless
    assert set(tree.source[owned(tree)].tolist()) == set(range(faces.count))
    only = build(faces_of_polygons(needles), compiled=compiled)
    assert only.fragments == len(needles)


def test_the_same_face_many_times_is_not_cut(compiled: bool):
    tree = build(faces_of_polygons([disc(5)] * 300), compiled=compiled)
    assert tree.fragments == 300 and tree.depth <= 2


def test_a_fan_whose_faces_all_meet_in_one_point(compiled: bool):
    tip = np.array([0.0, 0, 2])
    ring = disc(400)
    ring[::2, 2] = 0.3  # neither convex nor concave
    triangles = [np.array([tip, ring[i], ring[(i + 1) % 400]]) for i in range(400)]
    tree = build(faces_of_polygons(triangles), compiled=compiled)
    assert painted(tree, compiled, pixels=64).flawless
    assert tree.fragments < 3 * 400


def test_vertices_rounded_to_single_precision_cost_nearly_nothing(compiled: bool):
    faces = faces_of(part())
    rounded = dataclasses.replace(faces, points=faces.points.astype(np.float32).astype(float))
    verdict = painted(build(rounded, compiled=compiled), compiled)
    assert verdict.wrong <= 1e-4 * verdict.covered


def test_the_same_faces_give_the_same_tree(compiled: bool):
    faces = faces_of(*crossing(3))
    one, other = build(faces, compiled=compiled), build(faces, compiled=compiled)
    for field in dataclasses.fields(Tree):
        assert np.array_equal(getattr(one, field.name), getattr(other, field.name)) or field.name == "faces"


def test_the_faces_are_only_read(compiled: bool):
    faces = faces_of(*crossing(2))
    for field in dataclasses.fields(Faces):
        getattr(faces, field.name).setflags(write=False)
    tree = build(faces, compiled=compiled)
    assert not np.shares_memory(tree.points, faces.points) or len(tree.points) == len(faces.points)


def test_progress_grows_to_the_whole_and_can_stop_the_work(compiled: bool):
    faces = faces_of(*crossing(8, 24))
    steps: list[tuple[int, int]] = []
    tree = build(faces, compiled=compiled, progress=lambda done, total: steps.append((done, total)))
    done, total = np.array(steps).T
    assert (np.diff(done) >= 0).all() and (done <= total).all() and len(steps) >= 2
    assert total[-1] <= len(tree.source)

    class Stopped(Exception):
        pass

    def stop(done: int, total: int) -> None:
        raise Stopped

    with pytest.raises(Stopped):
        build(faces, compiled=compiled, progress=stop)


def test_a_tree_that_would_not_fit_is_refused_in_words(compiled: bool, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(build_module, "MOST_A_FACE", 1)
    monkeypatch.setattr(build_module, "MOST_MORE", 1000)
    with pytest.raises(Refusal, match=r"cross so often .* z-buffer"):
        build(soup(400, 3.0), compiled=compiled)


def test_what_is_no_number_is_refused(compiled: bool):
    faces = faces_of(box(2))
    points = faces.points.copy()
    points[3, 1] = np.nan
    with pytest.raises(ValueError, match="not a finite number"):
        build(dataclasses.replace(faces, points=points), compiled=compiled)


def test_two_solids_of_one_mesh_each_keep_their_numbers():
    meshes = [mesh_of(box(2)), mesh_of(sphere(3, segments=12).at(9))]
    faces = faces_of_meshes(meshes)
    assert faces.count == sum(len(mesh.triangles) for mesh in meshes)
    tree = build(faces)
    assert set(tree.source.tolist()) == set(range(faces.count))


def test_the_textbooks_builder_refuses_what_it_would_cut_for_minutes():
    corners = np.random.default_rng(1).normal(size=(400, 3, 3))
    with pytest.raises(Refusal, match="more than 50,000 times"):
        build_in_order(faces_of_polygons(list(corners)))


@pytest.mark.parametrize("turned", [1, -1])
def test_of_faces_that_face_each_other_in_one_plane_the_later_one_is_on_top(compiled: bool, turned: int):
    square = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    tree = build(faces_of_polygons([square[::turned], square[::-turned]]), compiled=compiled)
    for eye in ((0, 0, 5), (0, 0, -5)):
        assert Sorter(tree, compiled).fragments(eye).tolist() == [0, 1]
