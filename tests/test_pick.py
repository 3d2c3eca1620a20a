"""Picking against a brute-force ray cast written another way: planes and half-planes instead of Möller-Trumbore."""

import dataclasses
import time

import numpy as np
import pytest
from render_meshes import ball, box, drilled

from solidtree.render.camera import Camera, fit, ray
from solidtree.render.pick import Picker
from solidtree.render.views import standard_view

SIZE = (320.0, 240.0)


def nearest(mesh, origin, direction) -> tuple[int, float]:
    """Intersects the ray with every triangle's plane and asks on which side of the three sides the point lies."""
    a, b, c = np.moveaxis(mesh.points[mesh.triangles].astype(float), 1, 0)
    normal = np.cross(b - a, c - a)
    with np.errstate(divide="ignore", invalid="ignore"):
        distance = ((a - origin) * normal).sum(axis=1) / (normal @ direction)
    point = origin + distance[:, None] * direction
    inside = np.ones(len(a), bool)
    for start, end in ((a, b), (b, c), (c, a)):
        inside &= (np.cross(end - start, point - start) * normal).sum(axis=1) >= 0.0
    distance[~inside | ~(distance >= 0.0)] = np.inf
    index = int(np.argmin(distance))
    return (index, float(distance[index])) if np.isfinite(distance[index]) else (-1, np.inf)


@pytest.mark.parametrize("parallel", [False, True])
def test_picks_equal_brute_force(parallel):
    meshes = {"part": drilled(48), "ball": ball(64, 8.0), "box": box((5, 5, 5), (14, 12, 11))}
    camera = fit(standard_view(Camera(parallel=parallel), "iso"), [[-10.0] * 3, [14.0, 12.0, 11.0]], SIZE[0] / SIZE[1])
    picker = Picker()
    hits = 0
    for x, y in np.random.default_rng(4).uniform((90.0, 40.0), (230.0, 200.0), (300, 2)):
        origin, direction = ray(camera, x, y, SIZE)
        found = {key: nearest(mesh, origin, direction) for key, mesh in meshes.items()}
        wanted = min(found, key=lambda key: found[key][1])
        triangle, distance = found[wanted]
        pick = picker.pick(meshes, origin, direction)
        if triangle < 0:
            assert pick is None
            continue
        hits += 1
        assert pick is not None
        assert (pick.solid_id, pick.triangle) == (wanted, triangle)
        assert pick.distance == pytest.approx(distance)
        assert np.allclose(pick.point, origin + distance * direction)
        mesh = meshes[wanted]
        assert pick.path == mesh.owners[mesh.owner[triangle]]
        assert pick.facet == mesh.facet[triangle]
    assert hits > 150


def test_the_hole_belongs_to_the_drill():
    part = drilled()
    picker = Picker()
    wall = picker.pick({"part": part}, (0.0, 0.0, 1.0), (1.0, 0.0, 0.0))
    assert wall is not None and wall.path == ("part", "drill") and wall.subtracted
    assert np.allclose(wall.point, (6.0, 0.0, 1.0), atol=0.02)
    assert wall.normal[0] < -0.99  # outward from the solid is into the hole
    side = picker.pick({"part": part}, (50.0, 0.0, 1.0), (-1.0, 0.0, 0.0))
    assert side is not None and side.path == ("part", "cube") and not side.subtracted
    assert side.point == pytest.approx((10.0, 0.0, 1.0))
    assert side.distance == pytest.approx(40.0)


def test_rays_along_shared_sides_do_not_slip_through():
    mesh = ball(96)
    picker = Picker()
    a, b, c = np.moveaxis(mesh.points[mesh.triangles].astype(float), 1, 0)
    for goal in np.concatenate([a[::40], (a + b)[::40] / 2.0, (b + c)[::40] / 2.0]):
        direction = goal / np.linalg.norm(goal)
        pick = picker.pick({"ball": mesh}, 40.0 * direction, -direction)
        assert pick is not None
        assert np.allclose(pick.point, goal, atol=1e-5)


def test_all_that_a_ray_meets_front_to_back():
    meshes = {"part": drilled(48), "box": box((-3, 40, -3), (3, 46, 3)), "beside": box((50, 0, 0), (60, 9, 9))}
    origin, direction = np.array([0.1, -60.0, 0.2]), np.array([0.0, 2.0, 0.0])
    found = Picker().pick_all(meshes, origin, direction)
    # The cube's side, the hole's wall twice, the other side, then the box.
    assert [(pick.solid_id, pick.path[-1]) for pick in found] == [
        ("part", "cube"), ("part", "drill"), ("part", "drill"), ("part", "cube"), ("box", "b"), ("box", "b"),
    ]  # fmt: skip
    assert [pick.distance for pick in found] == pytest.approx([50, 54, 66, 70, 100, 106], abs=0.05)
    assert found[0] == Picker().pick(meshes, origin, direction)
    assert Picker().pick_all(meshes, origin, direction, 52.0, 68.0) == found[1:3]
    assert Picker().pick_all(meshes, origin, -direction) == []


def test_misses_and_empty_meshes():
    picker = Picker()
    mesh = box()
    empty = dataclasses.replace(mesh, triangles=mesh.triangles[:0], bounds=np.full((2, 3), np.nan))
    assert picker.pick({}, (0, 0, 0), (0, 0, 1)) is None
    assert picker.pick({"a": empty}, (5, 5, -9), (0, 0, 1)) is None
    assert picker.pick({"a": mesh}, (5, 5, 50), (0, 0, 1)) is None  # it lies behind
    assert picker.pick({"a": mesh}, (50, 5, 5), (0, 0, 1)) is None
    inside = picker.pick({"a": mesh, "b": empty}, (5, 5, 5), (0, 0, 2))
    assert inside is not None and inside.point == pytest.approx((5, 5, 10)) and inside.distance == pytest.approx(5.0)


def test_one_locator_per_mesh_and_none_for_those_gone(monkeypatch):
    from solidtree.render import pick as module

    built = []
    locator = module.vtkStaticCellLocator
    monkeypatch.setattr(module, "vtkStaticCellLocator", lambda: built.append(1) or locator())
    mesh, other = ball(64), ball(64, 5.0)
    picker = Picker()
    for _ in range(3):
        picker.pick({"a": mesh}, (0, 0, 30), (0, 0, -1))
    picker.pick({"renamed": mesh, "b": other}, (0, 0, 30), (0, 0, -1))
    assert len(built) == 1  # the other lies behind the hit and is not asked
    picker.pick({"b": other}, (0, 0, 30), (0, 0, -1))
    assert len(built) == 2
    assert len(picker._locators) == 1


def test_many_triangles_are_picked_within_a_frame():
    mesh = ball(512)
    assert len(mesh.triangles) > 100_000
    picker = Picker()
    directions = np.random.default_rng(5).normal(size=(30, 3))
    picker.pick({"ball": mesh}, directions[0] * 30.0, -directions[0])
    start = time.perf_counter()
    for direction in directions:
        assert picker.pick({"ball": mesh}, direction * 30.0, -direction) is not None
    assert (time.perf_counter() - start) / len(directions) < 0.05  # a tenth of a millisecond is usual
