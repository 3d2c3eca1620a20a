"""Rays through the tree: against all triangles one by one, by formula, single as many; lines of sight past bodies."""

import numpy as np
import pytest

from solidtree.model.partition import native
from solidtree.model.partition.build import build
from solidtree.model.partition.faces import faces_of_meshes, faces_of_polygons
from solidtree.model.partition.rays import Rays, first_hit, hits, sees
from solidtree.model.partition.sight import inside, line_of_sight
from solidtree.model.partition.textbook import build_in_order
from solidtree.model.script import box, cylinder, evaluate, sphere

PLATE = (
    box(40, 30, 12)
    - cylinder(4, 40, centred=True, segments=24).at(10, 15)
    - cylinder(3, 40, centred=True, segments=20).at(30, 15)
)
SCENES = {
    "plate": (PLATE,),
    "crossing": (box(20).at(-5, -5, -5), sphere(12, segments=16), box(30, 4, 4).at(-20)),
    "touching": (box(10), box(10).at(10), box(10).at(0, 10), sphere(4, segments=12).at(5, 5, 14)),
    "ball": (sphere(10, segments=96),),
}
BUILDERS = {"numpy": lambda faces: build(faces, compiled=False), "textbook": build_in_order}
if native.available():
    BUILDERS["compiled"] = lambda faces: build(faces, compiled=True)
CASES = [(scene, builder) for scene in SCENES for builder in BUILDERS if (scene, builder) != ("ball", "textbook")]


def meshes_of(*solids):
    evaluation = evaluate(*solids)
    return [evaluation.display(result) for result in evaluation.solids]


def tree_of(*solids, builder=build):
    return builder(faces_of_meshes(meshes_of(*solids)))


def all_distances(faces, origin, direction):
    """(n, t) how far along each ray each triangle is, inf for a miss: Moeller and Trumbore (1997), nothing left out."""
    a, b, c = faces.points[faces.corners.reshape(-1, 3)].transpose(1, 0, 2)
    one, two = b - a, c - a
    along = direction / np.linalg.norm(direction, axis=1, keepdims=True)
    found = np.full((len(origin), len(a)), np.inf)
    for i in range(len(origin)):
        across = np.cross(along[i], two)
        determinant = np.einsum("ij,ij->i", one, across)
        offset = origin[i] - a
        turned = np.cross(offset, one)
        with np.errstate(divide="ignore", invalid="ignore"):
            u = np.einsum("ij,ij->i", offset, across) / determinant
            v = turned @ along[i] / determinant
            far = np.einsum("ij,ij->i", two, turned) / determinant
        hit = (u >= 0) & (v >= 0) & (u + v <= 1) & (far >= 0)
        found[i, hit] = far[hit]
    return found


@pytest.mark.parametrize(("scene", "builder"), CASES)
def test_first_and_all_hits_are_those_of_all_triangles_one_by_one(scene, builder):
    tree = tree_of(*SCENES[scene], builder=BUILDERS[builder])
    rng = np.random.default_rng(7)
    low, high = tree.faces.points.min(axis=0), tree.faces.points.max(axis=0)
    origin = rng.uniform(low - 8, high + 8, (1000, 3))
    direction = np.where(
        rng.random((1000, 1)) < 0.3, rng.normal(size=(1000, 3)), rng.uniform(low, high, (1000, 3)) - origin
    )
    expected = all_distances(tree.faces, origin, direction)
    rays = Rays(tree)
    distance, face = rays.first(origin, direction)
    assert 300 < np.isfinite(distance).sum() < 1000
    np.testing.assert_allclose(distance, expected.min(axis=1), atol=1e-9)
    met = np.flatnonzero(face >= 0)
    np.testing.assert_allclose(expected[met, face[met]], distance[met], atol=1e-9)
    found = rays.all(origin, direction)
    assert np.array_equal(np.bincount(found.ray, minlength=1000), np.isfinite(expected).sum(axis=1))
    normals = tree.faces.planes[tree.faces.plane_of[found.face], :3]
    assert np.array_equal(found.front, np.einsum("ij,ij->i", normals, direction[found.ray]) < 0)
    single = [rays.hit(origin[i], direction[i]) for i in range(200)]
    assert [hit.face if hit else -1 for hit in single] == face[:200].tolist()


def test_a_part_of_a_ray_meets_what_lies_in_it_alone():
    tree = tree_of(*SCENES["crossing"])
    rng = np.random.default_rng(3)
    origin, direction = rng.uniform(-30, 30, (500, 3)), rng.normal(size=(500, 3))
    near = rng.uniform(0, 30, 500)
    expected = all_distances(tree.faces, origin, direction)
    expected[(expected < near[:, None]) | (expected > near[:, None] + 10)] = np.inf
    distance, _ = Rays(tree).first(origin, direction, near, near + 10)
    np.testing.assert_allclose(distance, expected.min(axis=1), atol=1e-9)
    assert 20 < np.isfinite(distance).sum() < 400


def test_a_ball_and_a_box_by_formula():
    ball = tree_of(sphere(10, segments=256))
    rng = np.random.default_rng(1)
    outward = rng.normal(size=(300, 3))
    outward /= np.linalg.norm(outward, axis=1, keepdims=True)
    distance, _ = Rays(ball).first(30 * outward, -outward)
    np.testing.assert_allclose(distance, 20, atol=10 * (1 - np.cos(np.pi / 128)))
    cube = tree_of(box(10))
    found = hits(cube, (-5, 3, 4), (2, 0, 0))
    assert [(hit.distance, hit.point, hit.normal, hit.front) for hit in found] == [
        (5, (0, 3, 4), (-1, 0, 0), True),
        (15, (10, 3, 4), (1, 0, 0), False),
    ]
    assert first_hit(cube, (-5, 3, 4), (-1, 0, 0)) is None
    far = first_hit(cube, (3e9, 3, 4), (-1, 0, 0))
    assert far is not None and far.distance == pytest.approx(3e9 - 10)


def test_rays_from_faces_in_faces_and_on_borders():
    cube = tree_of(box(10))
    begins = first_hit(cube, (3, 4, 10), (0, 0, -1))
    assert begins is not None and begins.distance == 0 and begins.normal == (0, 0, 1)
    ends = first_hit(cube, (3, 4, 10), (0, 0, -1), near=1e-6)
    assert ends is not None and ends.distance == 10 and not ends.front
    assert first_hit(cube, (3, 4, 15), (0, 0, -1), far=4.9) is None
    # In the plane of the top: that is not met, the sides are.
    assert {hit.normal for hit in hits(cube, (-5, 4, 10), (1, 0, 0))} == {(-1, 0, 0), (1, 0, 0)}
    # Down an edge, through a corner, and through the diagonal that two triangles share.
    assert {hit.normal for hit in hits(cube, (0, 0, 20), (0, 0, -1))} == {(0, 0, 1), (0, 0, -1)}
    corner = hits(cube, (-1, -1, -1), (1, 1, 1))
    assert {hit.normal for hit in corner} == {(-1, 0, 0), (0, -1, 0), (0, 0, -1), (1, 0, 0), (0, 1, 0), (0, 0, 1)}
    for share in np.linspace(0.05, 0.95, 37):
        assert first_hit(cube, (10 * share, 10 * share, 20), (0, 0, -1)) is not None
        assert first_hit(cube, (10 * share, 10 - 10 * share, 20), (0, 0, -1)) is not None


def test_no_ray_slips_through_between_two_faces():
    """Rays at the very corners and edges of a surface, from outside inwards."""
    tree = tree_of(*SCENES["crossing"])
    faces = tree.faces
    corners = faces.points[faces.corners.reshape(-1, 3)]
    targets = np.concatenate(
        (corners.reshape(-1, 3), corners.mean(axis=1), 0.5 * (corners + np.roll(corners, 1, axis=1)).reshape(-1, 3))
    )
    origin = np.tile((60.0, 50.0, 70.0), (len(targets), 1))
    length = np.linalg.norm(targets - origin, axis=1)
    distance, _ = Rays(tree).first(origin, targets - origin)
    assert (distance <= length + 1e-6).all()


def test_what_is_no_ray_is_refused_and_an_empty_scene_has_no_hits():
    cube, empty = tree_of(box(10)), build(faces_of_polygons(()))
    for wrong in (((0, 0, 0), (0, 0, 0)), ((0, 0, np.nan), (1, 0, 0)), ((0, 0, 0), (np.inf, 0, 0))):
        for tree in (cube, empty):
            with pytest.raises(ValueError, match="a ray needs"):
                first_hit(tree, *wrong)
            with pytest.raises(ValueError, match="a ray needs"):
                hits(tree, *wrong)
    with pytest.raises(ValueError, match="end before it begins"):
        first_hit(cube, (0, 0, 0), (1, 0, 0), near=2, far=1)
    with pytest.raises(ValueError, match="coordinates are numbers"):
        sees(cube, (0, 0, 0), (0, 0, np.nan))
    assert first_hit(empty, (0, 0, 0), (1, 0, 0)) is None and hits(empty, (0, 0, 0), (1, 0, 0)) == ()
    assert sees(empty, (0, 0, 0), (1, 0, 0)) and line_of_sight(Rays(empty), (0, 0, 0), (1, 0, 0)).clear
    distance, face = Rays(cube).first(np.zeros((0, 3)), np.zeros((0, 3)))
    assert len(distance) == len(face) == 0


def test_points_see_each_other_both_ways_exactly_when_no_triangle_is_between():
    tree = tree_of(*SCENES["crossing"])
    rng = np.random.default_rng(5)
    a, b = rng.uniform(-25, 25, (1500, 3)), rng.uniform(-25, 25, (1500, 3))
    rays = Rays(tree)
    free = rays.see(a, b)
    length = np.linalg.norm(b - a, axis=1)
    assert np.array_equal(free, all_distances(tree.faces, a, b - a).min(axis=1) > length)
    assert np.array_equal(free, rays.see(b, a)) and 300 < free.sum() < 1200
    assert sees(tree, a[0], b[0]) == free[0]


def test_what_lies_in_a_body():
    rays = Rays(tree_of(*SCENES["crossing"]))
    rng = np.random.default_rng(9)
    points = rng.uniform(-20, 20, (2000, 3))
    cube = ((points > -5) & (points < 15)).all(axis=1)
    bar = ((points > (-20, 0, 0)) & (points < (10, 4, 4))).all(axis=1)
    away = np.linalg.norm(points, axis=1)
    sure = cube | bar | (away > 12) | (away < 11)  # between the sphere and its facets it depends
    expected = cube | bar | (away < 11)
    assert np.array_equal(inside(rays, points)[sure], expected[sure]) and 200 < expected.sum() < 1500


@pytest.mark.parametrize(
    ("a", "b", "reach"),
    [
        ((1, 15, 12), (39, 15, 12), None),  # along the top, over both holes, through corners of their facets
        ((0, 0, 0), (40, 0, 0), None),  # along an edge
        ((-10, 0, 12), (60, 0, 12), None),  # along an edge and on
        ((-10, 5, 12), (60, 5, 12), None),  # along a face and on
        ((-10, 0, 0), (10, -20, 0), None),
        ((10, 15, 30), (10, 15, -30), None),  # through a hole
        ((14, 15, 6), (6, 15, 6), None),  # from wall to wall of a hole
        ((5, 5, 12), (5, 5, 0), 0),  # through the plate, from face to face
        ((0, 0, 0), (40, 30, 12), 0),  # from corner to corner
        ((5, 5, 12), (5, 5, -20), 0),
        ((5, 5, 30), (5, 5, -20), 18),
        ((14, 15, 6), (33, 15, 6), 0),  # from hole to hole
        ((20, 20, 6), (20, 20, 40), 6),  # from within, as far as the surface
        ((20, 20, 6), (22, 20, 6), None),
    ],
)
def test_a_line_of_sight_may_touch_bodies_but_not_pass_through(a, b, reach):
    rays = Rays(tree_of(PLATE))
    there, back = line_of_sight(rays, a, b), line_of_sight(rays, b, a)
    assert there.clear == back.clear == (reach is None)
    if there.obstacle is not None:
        assert there.obstacle.distance == pytest.approx(reach)


def test_between_the_touching_faces_of_two_bodies_nothing_is_seen():
    rays = Rays(tree_of(box(40, 30, 12), cylinder(3, 30, segments=32).at(20, 6, 12)))
    blocked = line_of_sight(rays, (0, 6, 12), (40, 6, 12))
    assert blocked.obstacle is not None and blocked.obstacle.distance == pytest.approx(17)
    assert line_of_sight(rays, (0, 9, 12), (40, 9, 12)).clear  # it touches the foot
    assert line_of_sight(rays, (0, 10, 12), (40, 10, 12)).clear


def test_an_open_sheet_stands_in_the_way_from_both_sides():
    sheet = build(faces_of_polygons([[(0, 0, 0), (10, 0, 0), (10, 10, 0), (0, 10, 0)]]))
    rays = Rays(sheet)
    for a, b in (((5, 5, 5), (5, 5, -5)), ((5, 5, -5), (5, 5, 5))):
        sight = line_of_sight(rays, a, b)
        assert sight.obstacle is not None and sight.obstacle.distance == 5 and not sees(sheet, a, b)
    assert line_of_sight(rays, (1, 1, 0), (9, 9, 0)).clear and sees(sheet, (1, 1, 0), (9, 9, 0))
    assert line_of_sight(rays, (11, 5, 5), (11, 5, -5)).clear


def test_the_picture_picks_the_same_faces():
    from solidtree.render.pick import Picker

    meshes = meshes_of(*SCENES["crossing"])
    rays, picker = Rays(build(faces_of_meshes(meshes))), Picker()
    by_id = {str(number): mesh for number, mesh in enumerate(meshes)}
    starts = np.cumsum([0, *(len(mesh.triangles) for mesh in meshes)])
    rng = np.random.default_rng(2)
    same = 0
    for _ in range(200):
        origin, target = rng.normal(size=3) * 40, rng.uniform(-10, 10, 3)
        pick, hit = picker.pick(by_id, origin, target - origin), rays.hit(origin, target - origin)
        assert (pick is None) == (hit is None)
        if pick is not None and hit is not None:
            assert hit.distance == pytest.approx(pick.distance, abs=1e-4)  # the picture's points are single precision
            same += starts[int(pick.solid_id)] + pick.triangle == hit.face
    assert same > 150
