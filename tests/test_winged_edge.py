"""Lists of faces, the winged edge and its walks, against brute force; meshes of the corpus against published counts."""

import json
from collections import defaultdict
from pathlib import Path

import numpy as np
import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.mesh.lists import of_facets, of_polygons, of_triangles
from solidtree.model.mesh.topology import component_of_faces, contradictions, topology
from solidtree.model.mesh.walks import bends, borders, chain, stars
from solidtree.model.mesh.winged import (
    COLUMNS,
    END,
    LEFT,
    LEFT_AFTER,
    LEFT_BEFORE,
    RIGHT,
    RIGHT_AFTER,
    RIGHT_BEFORE,
    START,
    reversed_edges,
    winged_edge,
)
from solidtree.model.script import box, cylinder, document_of, evaluate

CUBE = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
SQUARES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]


def turned(loop):
    """A loop from its least vertex on."""
    at = int(np.argmin(loop))
    return (*loop[at:], *loop[:at])


def faces_of(lists):
    return [sorted(turned(loop.tolist()) for loop in lists.face(face)) for face in range(lists.face_count)]


def lists_of(node):
    document = document_of(node)
    evaluation = evaluate(document)
    mesh = evaluation.display(evaluation.solids[0])
    return of_facets(mesh.vertices, mesh.corners, mesh.facet)


def test_the_box_has_the_textbooks_lists_and_table():
    lists = of_polygons(CUBE, SQUARES)
    assert (len(lists.vertices), len(lists.normals), lists.face_count) == (8, 6, 6)
    np.testing.assert_allclose(lists.normals[lists.face_normal[0]], (0, 0, -1))
    mesh = winged_edge(lists)
    assert mesh.table.shape == (12, 8) and len(COLUMNS) == 8
    found = topology(mesh)
    assert (found.vertices, found.edges, found.faces, found.euler, found.genus) == (8, 12, 6, 2, 0) and found.closed
    # The edge from 0 to 2 is the first side of the bottom; on its right are the faces and edges of x = 0.
    row = mesh.table[0]
    assert row[START] == 0 and row[END] == 2 and row[LEFT] == 0 and row[RIGHT] == 4
    ends = mesh.table[:, :2]
    assert set(ends[row[LEFT_BEFORE]]) == {1, 0} and set(ends[row[LEFT_AFTER]]) == {2, 3}
    assert set(ends[row[RIGHT_BEFORE]]) == {6, 2} and set(ends[row[RIGHT_AFTER]]) == {0, 4}
    assert contradictions(mesh) == [] and faces_of(mesh.lists()) == faces_of(lists)


def test_facets_become_polygons_with_their_holes():
    """A plate with a round hole: 4 sides, two faces with a hole each, and the facets of the wall."""
    lists = lists_of(box(20, 20, 4, centred=True) - cylinder(5, 20, centred=True, segments=12))
    holes = np.diff(lists.face_loops) - 1
    assert lists.face_count == 6 + 12 and sorted(holes.tolist()) == [0] * 16 + [1, 1]
    areas = np.linalg.norm(lists.loop_areas(), axis=1)
    for face in np.flatnonzero(holes):
        outer, inner = areas[lists.face_loops[face] : lists.face_loops[face + 1]]
        assert outer == pytest.approx(400) and inner == pytest.approx(12 / 2 * 25 * np.sin(np.pi / 6))
        loops = lists.loop_areas()[lists.face_loops[face] : lists.face_loops[face + 1]]
        assert loops[0] @ loops[1] < 0  # the hole runs the other way
    mesh = winged_edge(lists)
    found = topology(mesh)
    assert found.genus == 1 and found.euler == 0 and found.loops - found.faces == 2
    assert contradictions(mesh) == [] and faces_of(mesh.lists()) == faces_of(lists)


def test_loops_that_touch_in_a_vertex_stay_apart():
    """Two squares of one facet that share a corner only are two faces."""
    points = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 1, 0), (2, 2, 0), (1, 2, 0)], float)
    triangles = [(0, 1, 2), (0, 2, 3), (2, 4, 5), (2, 5, 6)]
    lists = of_facets(points, triangles, np.zeros(4, int))
    assert faces_of(lists) == [[(0, 1, 2, 3)], [(2, 4, 5, 6)]]
    mesh = winged_edge(lists)
    found = topology(mesh)
    assert found.components == 2 and found.fans == 1 and found.borders == 2 and found.genus is None
    starts, edges, begins = stars(mesh)
    assert starts[3] - starts[2] == 4 and len(set(edges[starts[2] : starts[3]].tolist())) == 4
    assert sum(starts[2] <= begin < starts[3] for begin in begins) == 2


def test_reversing_edges_swaps_faces_and_wings():
    mesh = winged_edge(of_polygons(CUBE, SQUARES))
    some = np.array([0, 3, 7, 11])
    other = reversed_edges(mesh, some)
    assert contradictions(other) == [] and faces_of(other.lists()) == faces_of(mesh.lists())
    one, two = mesh.table[3], other.table[3]
    assert (one[START], one[END], one[LEFT], one[RIGHT]) == (two[END], two[START], two[RIGHT], two[LEFT])
    assert (one[LEFT_BEFORE], one[LEFT_AFTER]) == (two[RIGHT_BEFORE], two[RIGHT_AFTER])
    np.testing.assert_array_equal(reversed_edges(other, some).table, mesh.table)


def test_open_and_branching_meshes_are_described():
    square = winged_edge(of_polygons(CUBE[:4], [(0, 1, 3, 2)]))
    (border,) = borders(square)
    assert len(border) == 4 and topology(square).border_edges == 4 and topology(square).genus is None
    loop = [int(square.table[edge, START]) for edge in border]
    assert turned(loop[::-1]) == (0, 1, 3, 2)  # the hole runs against the face
    # Three squares on one edge: it has two copies, which belong together.
    points = np.array(
        [(0, 0, 0), (0, 0, 1), (1, 0, 0), (1, 0, 1), (-1, 1, 0), (-1, 1, 1), (-1, -1, 0), (-1, -1, 1)], float
    )
    fan = winged_edge(of_polygons(points, [(0, 2, 3, 1), (1, 5, 4, 0), (0, 6, 7, 1)]))
    found = topology(fan)
    assert found.repeated == 2 and found.components == 1 and not found.closed
    copies = np.flatnonzero(fan.copy_of != np.arange(len(fan)))
    assert len(copies) == 1 and set(fan.table[copies[0], :2]) == set(fan.table[fan.copy_of[copies[0]], :2]) == {0, 1}
    assert contradictions(fan) == []
    # Neighbours that run the same way: the side is there twice.
    wrong = winged_edge(of_triangles(CUBE, [(0, 1, 2), (0, 1, 4)]))
    assert topology(wrong).repeated == 2 and topology(wrong).border_edges == 6


def test_smooth_chains_and_bends():
    mesh = winged_edge(lists_of(cylinder(5, 10, segments=16)))
    lists = mesh.lists()
    angles = bends(mesh, lists.normals[lists.face_normal])
    sharp = np.abs(angles) > 30
    assert sharp.sum() == 32 and np.allclose(angles[sharp], 90) and np.allclose(np.sort(angles)[:16], 22.5)
    ring = chain(mesh, int(np.flatnonzero(sharp)[0]), sharp)
    assert len(ring) == len(set(ring)) == 16
    assert len({round(z, 6) for edge in ring for z in mesh.vertices[mesh.table[edge, :2], 2]}) == 1
    assert chain(mesh, 0, sharp, bend=10.0) == [0]


def brute(triangles):
    """By vertex: the vertices around it, by edge: its faces."""
    around, faces = defaultdict(set), defaultdict(list)
    for number, face in enumerate(triangles.tolist()):
        for a, b in zip(face, face[1:] + face[:1], strict=True):
            around[a].add(b)
            around[b].add(a)
            faces[min(a, b), max(a, b)].append((number, a < b))
    return around, faces


def agrees(points, triangles):
    """Whether the winged edge of a mesh finds what brute force does; the mesh."""
    lists = of_triangles(points, triangles)
    mesh = winged_edge(lists)
    np.testing.assert_array_equal(mesh.lists().corners, lists.corners)
    around, faces = brute(triangles)
    starts, edges, _ = stars(mesh)
    for vertex in range(len(points)):
        mine = edges[starts[vertex] : starts[vertex + 1]]
        ends = mesh.table[mine, :2]
        assert (ends == vertex).any(axis=1).all()
        assert set(ends[ends != vertex].tolist()) == around[vertex]
        if len(set(mesh.copy_of[mine].tolist())) == len(mine) and (mesh.table[mine, RIGHT] >= 0).all():
            walked = mesh.star(vertex)
            assert sorted(walked) == sorted(mine.tolist()) or len(walked) < len(mine)
    owners = defaultdict(set)
    for row in mesh.table.tolist():
        key = (min(row[:2]), max(row[:2]))
        owners[key] |= {face for face in (row[LEFT], row[RIGHT]) if face >= 0}
    assert owners == {key: {face for face, _ in found} for key, found in faces.items()}
    missing = (mesh.table[:, RIGHT] < 0).sum()
    forward = {key: sum(1 if way else -1 for _, way in found) for key, found in faces.items()}
    assert missing == sum(abs(balance) for balance in forward.values())
    walked = borders(mesh)
    assert sorted(edge for loop in walked for edge in loop) == np.flatnonzero(mesh.table[:, RIGHT] < 0).tolist()
    return mesh, faces


def test_walks_of_random_meshes_are_those_of_brute_force():
    generator = np.random.default_rng(5)
    for _ in range(30):
        count = int(generator.integers(4, 30))
        triangles = np.array([generator.permutation(count)[:3] for _ in range(int(generator.integers(1, 60)))])
        mesh, _ = agrees(generator.random((count, 3)), triangles)
        assert contradictions(mesh) == []


def test_meshes_of_the_corpus_have_their_published_counts(corpus):
    from solidtree.model.exchange.meshes_in import read_mesh_file

    expected = json.loads((corpus / "mesh" / "expected.json").read_text())
    done = genera = 0
    for name, case in sorted(expected.items()):
        told = case.get("independent")
        if not told or not 4 <= told.get("triangles", 0) <= 6000 or "components_by_edge" not in told:
            continue
        try:
            parts = read_mesh_file(corpus / "mesh" / name, Path(name).suffix[1:].lower())
        except Refusal:
            continue
        if len(parts) != 1 or len(parts[0].triangles) != told["triangles"] - told.get("degenerate_dropped", 0):
            continue
        part = parts[0]
        points, which = np.unique(part.vertices, axis=0, return_inverse=True)
        triangles = which.reshape(-1)[part.triangles.astype(np.int64)]
        if len(points) != told["vertices"]:
            continue
        mesh, faces = agrees(points, triangles)
        assert sum(len(found) == 1 for found in faces.values()) == told["boundary_edges"], name
        found = topology(mesh)
        if not told["nonmanifold_edges"]:
            assert found.components == told["components_by_edge"], name
            assert found.vertices - len(np.unique(mesh.copy_of)) + found.faces == told["euler"], name
        oriented = all(len({way for _, way in sides}) == 2 for sides in faces.values())
        if told.get("closed_2manifold") and oriented:
            assert found.closed and found.genus == told["total_genus"], name
            genera += 1
        else:
            assert found.genus is None, name
        done += 1
    assert done >= 30 and genera >= 10


def test_components_are_numbered_by_their_first_face():
    both = of_triangles(np.vstack((CUBE, CUBE + 5)), [(0, 1, 2), (8, 9, 10), (1, 3, 2)])
    assert component_of_faces(winged_edge(both)).tolist() == [0, 1, 0]
