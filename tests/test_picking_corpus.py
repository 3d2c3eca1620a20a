"""Every face of a result names the operand that made it: against rays cast at the operands alone, see csg_rays."""

import numpy as np
import pytest
from csg_rays import first_change, read
from csg_reader import read_csg

from solidtree.model.document.tree import numbered
from solidtree.model.script import (
    box,
    cylinder,
    hull,
    intersection,
    linear_array,
    minkowski,
    mirror,
    polar_array,
    sphere,
    union,
)  # fmt: skip
from solidtree.model.solid.evaluate import Evaluator
from solidtree.model.solid.results import display_of, result_of
from solidtree.render.pick import Picker

MOST, SOME = 20_000, 5_000  # of a model with more triangles than the first number, so many are looked at
RAYS = 600  # of a model, through the picker
EXACT = 4e-6  # of the model's size: pictures hold single precision
INNER = np.array([[1 / 3, 1 / 3, 1 / 3], [0.57, 0.22, 0.21], [0.19, 0.61, 0.20], [0.23, 0.18, 0.59]])

CORPUS = (
    "boolean/csg/Spiral_120_nested", "thingicsg/basic/10x10", "thingicsg/basic/demo_reel",
    "thingicsg/basic/fibo_cylinders", "thingicsg/basic/hollow_ball", "thingicsg/basic/multi_rot_cube",
    "thingicsg/basic/multi_rot_cube_rand20_inter", "thingicsg/basic/nasty_gear_3", "thingicsg/basic/seven_sins",
    "thingicsg/basic/spiky", "boolean/csg/LazyCollider_r2", "boolean/csg/TreeTransforms",
)  # fmt: skip


def ball(radius):
    return sphere(radius, segments=24)


def cube(side):
    return box(side, centred=True)


def drill(radius=2.0, height=30.0):
    return cylinder(radius, height, segments=20)


OWN = {
    "dumbbell": lambda: ball(10).at(-20) + ball(10).at(20) + drill(4, 40).turned(y=90).at(-20),
    "plate": lambda: box(60, 40, 5) - union(*(drill().at(8 + 11 * (i % 5), 9 + 11 * (i // 5), -9) for i in range(15))),
    "nested": lambda: (cube(30) - (ball(18) - (ball(14) - box(40, 6, 6, centred=True)))).turned(20, 30, 40),
    "arrays": lambda: box(80, 20, 6) - linear_array(polar_array(drill(1).at(4), 5), 4, (18, 2, 0)).at(14, 9, -9),
    "mirror": lambda: mirror(box(10).turned(10, 20, 30).at(4) - drill(2).at(9, 5, -9), (1, 0.3, 0), (0.5, 0, 0)),
    "hull and sum": lambda: hull(ball(3), ball(5).at(12)) + minkowski(box(6).at(20), ball(1)) - drill(1).at(6, 0, -9),
    "coincident": lambda: (box(10) + box(10).at(10)) - box(10, 10, 4).at(5, 0, 6) - box(10, 4, 10).at(5),
    "squashed": lambda: intersection(ball(10).scaled(1, 2, 0.5), box(30).mirrored((1, 1, 0)).at(5, 5, -2)),
}  # fmt: skip


def check_owners(mesh, operands, triangles):
    """The samples of the triangles lie on the surface of the operand that the mesh names, which faces the same way,
    or the opposite one where it was subtracted."""
    by_path = {operand.path: operand for operand in operands}
    size = float(np.ptp(mesh.bounds, axis=0).max())
    tolerance = EXACT * max(size, float(np.abs(mesh.bounds).max()))
    corners = mesh.points[mesh.triangles].astype(float)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normals, axis=1)
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    wide = length > 100 * tolerance * longest  # else single precision leaves the direction open
    normals /= np.where(length > 0, length, 1)[:, None]
    assert (mesh.owner >= 0).all()
    for number in np.unique(mesh.owner[triangles]):
        operand = by_path[mesh.owners[number]]
        mine = triangles[mesh.owner[triangles] == number]
        assert (mesh.subtracted[mine] == operand.subtracted).all(), operand.path
        points = np.einsum("sc,tck->tsk", INNER, corners[mine]).reshape(-1, 3)
        facing = np.repeat(normals[mine] * (-1 if operand.subtracted else 1), len(INNER), axis=0)
        sure = np.repeat(wide[mine], len(INNER))
        assert on_surface(operand.corners, points, facing, sure, tolerance).all(), operand.path
    return wide


def on_surface(corners, points, facing, sure, tolerance):
    """(p,) whether points lie within the tolerance of a triangle (t, 3, 3) that faces the same way; where `sure` is
    false the direction does not count."""
    sides = np.roll(corners, -1, axis=1) - corners
    normals = np.cross(sides[:, 0], sides[:, 1])
    size = np.linalg.norm(normals, axis=1)
    corners, sides = corners[size > 0], sides[size > 0]
    normals = normals[size > 0] / size[size > 0, None]
    lower, upper = corners.min(axis=1) - tolerance, corners.max(axis=1) + tolerance
    found = np.zeros(len(points), bool)
    for start in range(0, len(points), 256):
        part = slice(start, start + 256)
        low, high = points[part].min(axis=0), points[part].max(axis=0)
        near = np.flatnonzero(((lower <= high) & (upper >= low)).all(axis=1))
        height = points[part] @ normals[near].T - np.einsum("tk,tk->t", normals[near], corners[near, 0])
        agrees = (facing[part] @ normals[near].T > 0.98) | ~sure[part, None]
        point, triangle = np.nonzero((np.abs(height) < tolerance) & agrees)
        triangle = near[triangle]
        inward = np.cross(normals[triangle, None], sides[triangle])
        inward /= np.linalg.norm(inward, axis=2, keepdims=True)
        away = np.einsum("psk,psk->ps", points[part][point, None] - corners[triangle], inward)
        found[start + point[(away > -tolerance).all(axis=1)]] = True
    return found


def check_picks(mesh, operands, steps, triangles, rng):
    """Rays at the triangles hit what the rays at the operands say, and the triangles themselves."""
    size = float(np.ptp(mesh.bounds, axis=0).max())
    corners = mesh.points[mesh.triangles[triangles]].astype(float)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    aside = rng.normal(size=normals.shape)
    towards = normals + 0.25 * aside / np.linalg.norm(aside, axis=1, keepdims=True)
    towards /= np.linalg.norm(towards, axis=1, keepdims=True)
    origins = (
        np.einsum("c,tck->tk", INNER[1], corners) + 1e-3 * size * rng.uniform(0.5, 2.0, (len(corners), 1)) * towards
    )
    picker, same = Picker(), 0
    tolerance = 20 * EXACT * max(size, float(np.abs(mesh.bounds).max()))
    judged = first_change(operands, steps, origins, -towards, tolerance / 50)
    for triangle, origin, direction, (distance, owners) in zip(triangles, origins, -towards, judged, strict=True):
        pick = picker.pick({"model": mesh}, origin, direction)
        assert pick is not None
        assert pick.distance == pytest.approx(distance, abs=tolerance), (triangle, pick, owners)
        assert pick.path in owners, (triangle, pick, owners)
        same += pick.triangle == triangle
    return same


def check(node):
    (root,) = numbered([node])
    evaluator = Evaluator()
    mesh = display_of(result_of(root, evaluator.evaluate(root)), evaluator)
    operands, steps = read(root)
    rng = np.random.default_rng(7)
    count = len(mesh.triangles)
    triangles = np.arange(count) if count <= MOST else np.sort(rng.choice(count, SOME, replace=False))
    wide = check_owners(mesh, operands, triangles)
    triangles = triangles[wide[triangles]]
    cost = sum(len(operand.corners) for operand in operands)
    some = min(len(triangles), RAYS, max(100, 20_000_000 // cost))
    same = check_picks(mesh, operands, steps, rng.choice(triangles, some, replace=False), rng)
    return mesh, wide, same / some


@pytest.mark.parametrize("name", OWN)
def test_own_trees(name):
    mesh, wide, same = check(OWN[name]())
    assert len(mesh.triangles) and wide.mean() > 0.97
    assert same == 1  # no other face stands in the way


@pytest.mark.parametrize("name", CORPUS)
def test_corpus(corpus, name):
    mesh, wide, same = check(read_csg((corpus / f"{name}.csg").read_text()))
    assert len(mesh.triangles)
    assert wide.mean() > 0.8 and same > 0.9, (wide.mean(), same)


@pytest.mark.parametrize("shift", [1, 3])
def test_a_wrong_owner_is_seen(shift):
    """The judge itself: owners mixed up do not pass."""
    import dataclasses

    (root,) = numbered([OWN["plate"]()])
    evaluator = Evaluator()
    mesh = display_of(result_of(root, evaluator.evaluate(root)), evaluator)
    operands, steps = read(root)
    wrong = dataclasses.replace(mesh, owner=(mesh.owner + shift) % len(mesh.owners))
    with pytest.raises(AssertionError):
        check_owners(wrong, operands, np.arange(len(mesh.triangles)))
    with pytest.raises(AssertionError):
        check_picks(wrong, operands, steps, np.arange(0, len(mesh.triangles), 9), np.random.default_rng(1))
