"""Sets of vertices, edges and faces against a search through all of them."""

import itertools

import numpy as np
import pytest

from solidtree.model.mesh import selecting
from solidtree.model.mesh.inspected import inspect_mesh
from solidtree.model.mesh.winged import END, LEFT, RIGHT, START
from solidtree.model.script import box, cylinder, document_of, inspected, sphere

PART = box(20).named("block") - cylinder(5, 60, centred=True, segments=16).at(10, 10, 10).named("drill")


@pytest.fixture(scope="module", params=["polygons", "triangles", "ball", "open"])
def mesh(request):
    if request.param == "ball":
        return inspected(sphere(10, segments=12) + box(9))
    if request.param == "open":
        return inspect_mesh(open_mesh())
    return inspected(PART, triangles=request.param == "triangles")


def open_mesh():
    """A ball with holes, two of them in one place, and three more triangles on one edge."""
    from dataclasses import replace

    from solidtree.model.script import evaluate

    evaluation = evaluate(sphere(10, segments=16))
    mesh = evaluation.display(evaluation.solids[0])
    kept = np.ones(len(mesh.corners), bool)
    kept[[0, 7, 8, 20]] = False
    corners = np.vstack((mesh.corners[kept], mesh.corners[30][[0, 1, 2]])).astype(np.int32)
    owner = np.append(mesh.owner[kept], 0).astype(np.int32)
    return replace(mesh, corners=corners, owner=owner, facet=np.arange(len(corners), dtype=np.int32))


def members(flags):
    return set(np.flatnonzero(flags).tolist())


def rows(mesh):
    return mesh.winged.table.tolist()


def drawn(count, seed, share=0.2):
    return np.random.default_rng(seed).random(count) < share


def test_edges_by_angle_length_and_faces(mesh):
    normals = mesh.face_normals
    turn = {}
    for edge, row in enumerate(rows(mesh)):
        if min(row[LEFT], row[RIGHT]) >= 0:
            a, b = normals[row[LEFT]], normals[row[RIGHT]]
            along = mesh.lists.vertices[row[END]] - mesh.lists.vertices[row[START]]
            angle = np.degrees(np.arccos(np.clip(a @ b, -1, 1)))
            turn[edge] = np.copysign(angle, np.cross(a, b) @ along)
    found = members(selecting.bent_edges(mesh, 25.0))
    assert found == {edge for edge, angle in turn.items() if abs(angle) >= 25.0}
    assert members(selecting.bent_edges(mesh, 1.0, "concave")) == {e for e, angle in turn.items() if angle <= -1.0}
    assert members(selecting.bent_edges(mesh, 1.0, "convex")) == {e for e, angle in turn.items() if angle >= 1.0}
    ends = [mesh.lists.vertices[[row[START], row[END]]] for row in rows(mesh)]
    assert members(selecting.short_edges(mesh, 3.0)) == {
        edge for edge, (a, b) in enumerate(ends) if np.linalg.norm(b - a) <= 3.0
    }


def test_naked_and_non_manifold_edges_are_told_apart(mesh):
    sides = {}
    for face in range(mesh.lists.face_count):
        for loop in mesh.lists.face(face):
            for a, b in zip(loop.tolist(), np.roll(loop, -1).tolist(), strict=True):
                sides.setdefault(frozenset((a, b)), []).append((a, b))
    naked = {pair for pair, uses in sides.items() if len(uses) == 1}
    broken = {pair for pair, uses in sides.items() if len(uses) > 2 or (len(uses) == 2 and uses[0] == uses[1])}

    def pairs(edges):
        return {frozenset(mesh.winged.table[edge, [START, END]].tolist()) for edge in members(edges)}

    assert pairs(mesh.naked) == naked and pairs(mesh.non_manifold) == broken
    assert not (mesh.naked & mesh.non_manifold).any()


def test_sets_turn_into_each_other(mesh):
    winged, table = mesh.winged, rows(mesh)
    counts = len(mesh.lists.vertices), len(table), mesh.lists.face_count
    vertices, edges, faces = (drawn(count, seed, 0.4) for seed, count in enumerate(counts))
    v, e, f = members(vertices), members(edges), members(faces)
    of_edges = {end for i in e for end in table[i][:2]}
    assert members(selecting.converted(winged, edges, "edge", "vertex")) == of_edges
    of_faces = {i for i, row in enumerate(table) if {row[LEFT], row[RIGHT]} & f}
    assert members(selecting.converted(winged, faces, "face", "edge")) == of_faces
    assert members(selecting.converted(winged, faces, "face", "vertex")) == {
        end for i in of_faces for end in table[i][:2]
    }
    within = {i for i, row in enumerate(table) if {row[START], row[END]} <= v}
    assert members(selecting.converted(winged, vertices, "vertex", "edge")) == within
    around = {face: set() for face in range(counts[2])}
    for i, row in enumerate(table):
        for face in {row[LEFT], row[RIGHT]} - {-1}:
            around[face].add(i)
    assert members(selecting.converted(winged, edges, "edge", "face")) == {k for k, own in around.items() if own <= e}
    assert members(selecting.faces_of_edges(winged, edges, all_of_them=False)) == {
        k for k, o in around.items() if o & e
    }
    assert selecting.converted(winged, faces, "face", "face") is faces
    borders = {i for i, row in enumerate(table) if (row[LEFT] in f) != (row[RIGHT] in f)}
    assert members(selecting.edges_around(winged, faces)) == borders


@pytest.mark.parametrize("kind", ["vertex", "edge", "face"])
def test_growing_takes_what_touches_and_shrinking_takes_it_back(mesh, kind):
    table = rows(mesh)
    corners: dict[int, set[int]] = {}
    if kind == "vertex":
        corners = {i: {i} for i in range(len(mesh.lists.vertices))}
        for row in table:
            corners[row[START]] = corners[row[START]] | {row[END]}
            corners[row[END]] = corners[row[END]] | {row[START]}
    elif kind == "edge":
        corners = {i: {row[START], row[END]} for i, row in enumerate(table)}
    else:
        corners = {i: {v for loop in mesh.lists.face(i) for v in loop.tolist()} for i in range(mesh.lists.face_count)}
    chosen = drawn(len(corners), 5, 0.1)
    mine = members(chosen)
    if kind == "vertex":
        expected = mine | {i for i, near in corners.items() if near & mine}
    else:
        taken = {v for i in mine for v in corners[i]}
        expected = mine | {i for i, own in corners.items() if own & taken}
    grown = selecting.grown(mesh.winged, chosen, kind)
    assert members(grown) == expected
    assert not (selecting.shrunk(mesh.winged, grown, kind) & ~grown).any()
    assert not (chosen & ~selecting.shrunk(mesh.winged, grown, kind)).any()


@pytest.mark.parametrize("most", [0.0, 20.0, 180.0])
def test_connected_faces_are_a_flood(mesh, most):
    near = {face: set() for face in range(mesh.lists.face_count)}
    for edge, row in enumerate(rows(mesh)):
        if min(row[LEFT], row[RIGHT]) >= 0 and abs(mesh.bend[edge]) <= most + 1e-4:
            near[row[LEFT]].add(row[RIGHT])
            near[row[RIGHT]].add(row[LEFT])
    reached, waiting = {3}, [3]
    while waiting:
        fresh = near[waiting.pop()] - reached
        reached |= fresh
        waiting += fresh
    start = selecting.flags(mesh.lists.face_count, [3])
    assert members(selecting.connected_faces(mesh, start, most)) == reached


def test_faces_by_direction_area_and_maker():
    mesh = inspected(document_of(PART))
    up = selecting.faces_towards(mesh, (0, 0, 5), 1.0)
    assert [mesh.face_normals[face].tolist() for face in members(up)] == [[0, 0, 1]]
    assert not selecting.faces_towards(mesh, (0, 0, 0), 90).any()
    half = selecting.faces_towards(mesh, (0, 0, 1), 90.0)
    assert members(half) == {i for i, normal in enumerate(mesh.face_normals) if normal[2] >= -1e-9}
    large = selecting.faces_of_area(mesh, 300.0, 400.0)
    assert members(large) == {i for i, area in enumerate(mesh.area) if 300 <= area <= 400} and large.sum() == 6
    drill = next(path[-1] for path in mesh.owners if selecting.faces_of_makers(mesh, [path[-1]]).sum() == 16)
    walls = selecting.faces_of_makers(mesh, [drill])
    assert all(abs(mesh.face_normals[face][2]) < 1e-9 for face in members(walls))
    whole = selecting.faces_of_makers(mesh, [mesh.owners[0][0]])
    assert whole.all() and not selecting.faces_of_makers(mesh, ["nobody"]).any()


def test_loops_and_chains_of_an_edge():
    mesh = inspected(PART)
    table = rows(mesh)
    rim = [i for i, row in enumerate(table) if mesh.length[i] < 3 and (mesh.lists.vertices[row[:2]][:, 2] == 20).all()]
    assert len(rim) == 16
    assert set(selecting.chain_of_edge(mesh, rim[0])) == set(rim)
    top = int(np.flatnonzero(selecting.faces_towards(mesh, (0, 0, 1), 1.0))[0])
    side = 0 if table[rim[0]][LEFT] == top else 1
    assert set(selecting.loop_of_edge(mesh, rim[0], side)) == set(rim)
    wall = selecting.loop_of_edge(mesh, rim[0], 1 - side)
    assert len(wall) == 4 and rim[0] in wall
    outer = next(i for i, row in enumerate(table) if top in row[2:4] and mesh.length[i] == 20)
    assert len(selecting.loop_of_edge(mesh, outer, 0 if table[outer][LEFT] == top else 1)) == 4
    assert selecting.chain_of_edge(mesh, outer) == [outer]


def test_the_loop_of_a_naked_edge_is_the_border():
    mesh = inspect_mesh(open_mesh())
    for edge in np.flatnonzero(mesh.naked)[:4].tolist():
        loop = selecting.loop_of_edge(mesh, edge)
        assert edge in loop and all(mesh.naked[i] for i in loop)
        ends = [set(mesh.winged.table[i, :2].tolist()) for i in loop]
        assert all(a & b for a, b in itertools.pairwise([*ends, ends[0]]))
    assert selecting.loop_from(mesh.winged, int(np.flatnonzero(mesh.naked)[0]), 1) == []
