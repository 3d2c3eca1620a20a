"""What a view cone prunes, against points drawn at random from the cone and from the cells."""

import numpy as np
import pytest

from solidtree.model.partition.cone import Cone, flat_cone, prune, view_cone
from solidtree.model.partition.descent import below, owned
from solidtree.model.partition.faces import faces_of_polygons
from solidtree.model.partition.textbook import build_in_order
from solidtree.model.partition.tree import INNER, empty_tree
from solidtree.render.camera import Camera, project
from solidtree.render.view_cone import camera_cone

CORNERS = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], float)


@pytest.fixture(scope="module")
def tree():
    """Of 120 triangles that cross one another."""
    random = np.random.default_rng(5)
    middles = random.uniform(-20, 20, (120, 1, 3))
    return build_in_order(faces_of_polygons(list(middles + random.normal(0, 4, (120, 3, 3)))))


def pyramid(eye, target, spread):
    """A square picture of `spread` times its distance about the target."""
    forward = np.subtract(target, eye)
    right = np.cross(forward, (0.3, 0.2, 1.0))
    right *= spread * np.linalg.norm(forward) / np.linalg.norm(right)
    up = np.cross(right, forward) / np.linalg.norm(forward)
    return view_cone(eye, target + CORNERS @ np.array([right, up]))


def drawn(cone, count, random):
    """Points (count, 3) of a cone: means of its points, and sums of its rays of very different lengths."""
    shares = random.dirichlet(np.full(len(cone.points), 0.3), count)
    factors = random.exponential(1.0, (count, len(cone.rays))) * 10.0 ** random.uniform(-3, 3, (count, 1))
    return shares @ cone.points + factors @ cone.rays


def cones():
    random = np.random.default_rng(11)
    found = [pyramid(*random.uniform(-40, 40, (2, 3)), spread) for spread in (0.02, 0.1, 0.3, 0.6) for _ in range(8)]
    prisms = [Cone(random.uniform(-8, 8, (4, 3)), np.outer((1.0, -1.0), random.normal(size=3))) for _ in range(6)]
    return [*found, *prisms]


def test_sides_of_planes_agree_with_points_of_the_cone(tree):
    random = np.random.default_rng(3)
    planes = tree.plane[tree.kind == INNER]
    both = 0
    for cone in cones():
        before, behind = cone.sides(planes)
        heights = planes[:, :3] @ drawn(cone, 4000, random).T - planes[:, 3:]
        assert not (heights > 1e-6)[~before].any() and not (heights < -1e-6)[~behind].any()
        # What the cone reaches is met by a point near one of its corners or far out along one of its rays.
        far = np.concatenate([cone.points, *(cone.points + 1e7 * ray for ray in cone.rays)])
        ends = planes[:, :3] @ far.T - planes[:, 3:]
        assert ((ends > 0.0).any(axis=1) == before).all() and ((ends < 0.0).any(axis=1) == behind).all()
        both += int((before & behind).sum())
    assert both > 100


def test_nothing_that_is_pruned_reaches_into_the_cone(tree):
    random = np.random.default_rng(4)
    pruned_at_all = 0
    for cone in cones():
        found = prune(tree, cone)
        assert found.nodes == found.seen.sum() and found.fragments == tree.count[found.seen].sum()
        gone = np.concatenate([below(tree, int(node)) for node in found.cut]) if len(found.cut) else np.zeros(0, int)
        assert set(gone) | set(np.flatnonzero(found.seen)) == set(below(tree, tree.root))
        assert not found.seen[gone].any() and len(gone) + found.nodes == tree.nodes
        pruned_at_all += len(gone)
        # A point in the cone never lies in the cell of a pruned sub-tree.
        points = drawn(cone, 500, random)
        for way in (walk(tree, point) for point in points[:60]):
            assert found.seen[way].all()
        # And every fragment of which a point lies in the cone is kept.
        kept = set(owned(tree, np.flatnonzero(found.seen)).tolist())
        middles = np.array([tree.points[tree.corners[a:b]].mean(axis=0)
                            for a, b in zip(tree.starts[:-1], tree.starts[1:], strict=True)])  # fmt: skip
        if len(cone.points) == 1:
            assert set(np.flatnonzero(inside(cone, middles)).tolist()) <= kept
    assert pruned_at_all > 500


def walk(tree, point):
    """The nodes on the way of a point, by the plane's sign alone."""
    nodes, node = [], tree.root
    while node >= 0:
        nodes.append(node)
        if tree.kind[node] != INNER:
            break
        node = int((tree.front if tree.plane[node, :3] @ point > tree.plane[node, 3] else tree.back)[node])
    return nodes


def inside(cone, points):
    """Which points lie in a pyramid, by the planes of its four sides."""
    normals = np.cross(cone.rays, np.roll(cone.rays, -1, axis=0))
    normals *= np.sign(normals @ cone.rays.mean(axis=0))[:, None]
    return ((points - cone.points[0]) @ normals.T > 1e-9).all(axis=1)


def test_a_cone_in_the_plane_stands_about_its_direction():
    cone = flat_cone((2, 3), (0, 5), 60)
    up, right = np.array([[0, 1, 0, 3.0]]), np.array([[1, 0, 0, 2.0]])
    assert [bool(side[0]) for side in cone.sides(up)] == [True, False]
    assert [bool(side[0]) for side in cone.sides(right)] == [True, True]
    steep = np.array([[np.cos(np.radians(29)), -np.sin(np.radians(29)), 0, 0]])
    steep[0, 3] = steep[0, :3] @ (2, 3, 0)
    assert [bool(side[0]) for side in cone.sides(steep)] == [True, True]  # 30 degrees on either side
    steep[0, :2] = np.cos(np.radians(31)), -np.sin(np.radians(31))
    steep[0, 3] = steep[0, :3] @ (2, 3, 0)
    assert [bool(side[0]) for side in cone.sides(steep)] == [False, True]


@pytest.mark.parametrize("parallel", [False, True])
def test_a_cameras_cone_holds_what_its_picture_shows(tree, parallel):
    random = np.random.default_rng(9)
    size = (300.0, 200.0)
    box = np.array([tree.points.min(axis=0), tree.points.max(axis=0)])
    pruned = 0
    for place in random.uniform(-30, 30, (20, 3)):
        camera = Camera(tuple(place), tuple(random.uniform(-20, 20, 3)), parallel=parallel, parallel_scale=6.0)
        endless, ended = prune(tree, camera_cone(camera, size)), prune(tree, camera_cone(camera, size, box))
        assert not (ended.seen & ~endless.seen).any()
        pruned += endless.nodes - ended.nodes
        x, y, depth = project(camera, tree.points, size).T
        shown = (x > 0) & (x < size[0]) & (y > 0) & (y < size[1]) & (parallel | (depth > 0))
        for node in np.flatnonzero(~ended.seen):
            own = owned(tree, np.array([node]))
            corners = np.concatenate([tree.corners[tree.starts[f] : tree.starts[f + 1]] for f in own])
            assert not shown[corners].any(), camera
    assert pruned > 0


def test_an_empty_tree_and_a_view_away_from_everything(tree):
    empty = prune(empty_tree(faces_of_polygons(())), flat_cone((0, 0), (1, 0), 30))
    assert (empty.nodes, empty.fragments, len(empty.cut)) == (0, 0, 0)
    away = prune(tree, pyramid((0, 0, 500), (0, 0, 900), 0.2))
    assert 0 < away.nodes < tree.nodes / 2
