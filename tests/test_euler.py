"""Operators on a winged edge keep it valid: thousands of them at random, and single ones by counting."""

from itertools import pairwise

import numpy as np
import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.mesh.euler import EditedMesh
from solidtree.model.mesh.lists import of_polygons, of_triangles
from solidtree.model.mesh.topology import contradictions, topology
from solidtree.model.mesh.walks import stars
from solidtree.model.mesh.winged import LEFT, RIGHT, START, winged_edge
from solidtree.model.script import box, cylinder, document_of, evaluate, sphere

CUBE = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
SQUARES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]


def solid(node):
    evaluation = evaluate(document_of(node))
    mesh = evaluation.display(evaluation.solids[0])
    return winged_edge(of_triangles(mesh.vertices, mesh.corners))


def counts(mesh):
    found = topology(mesh)
    return found.vertices, found.edges, found.faces


def volume(mesh):
    """By the fans of all faces from their first corner."""
    lists, total = mesh.lists(), 0.0
    for loop in range(lists.loop_count):
        points = lists.vertices[lists.loop(loop)]
        for b, c in pairwise(points[1:]):
            total += points[0] @ np.cross(b, c) / 6.0
    return total


def test_an_edge_is_split():
    edited = EditedMesh(winged_edge(of_polygons(CUBE, SQUARES)))
    vertex, edge = edited.split_edge(0, (0.0, 0.5, 0.0))
    mesh = edited.result()
    assert (vertex, edge) == (8, 12) and counts(mesh) == (9, 13, 6) and contradictions(mesh) == []
    assert volume(mesh) == pytest.approx(1.0) and len(mesh.star(8)) == 2


def test_a_face_is_split_and_its_edge_turned():
    edited = EditedMesh(winged_edge(of_polygons(CUBE, SQUARES)))
    for face in range(6):
        sides = edited.sides(face)
        edited.split_face(sides[0], sides[2])
    mesh = edited.result()
    assert counts(mesh) == (8, 18, 12) and contradictions(mesh) == [] and volume(mesh) == pytest.approx(1.0)
    diagonals = [
        edge for edge in range(18) if np.linalg.norm(np.diff(mesh.vertices[mesh.table[edge, :2]], axis=0)) > 1.1
    ]
    ends = set(mesh.table[diagonals[0], :2].tolist())
    edited.flip(diagonals[0])
    other = edited.result()
    assert contradictions(other) == [] and counts(other) == (8, 18, 12) and volume(other) == pytest.approx(1.0)
    assert not ends & set(other.table[diagonals[0], :2].tolist())


def test_an_edge_is_collapsed_with_the_triangles_beside_it():
    before = solid(sphere(5, segments=12))
    edited = EditedMesh(before)
    kept = edited.collapse(7, point=(0, 0, 9))
    mesh = edited.result()
    v, e, f = counts(before)
    assert counts(mesh) == (v - 1, e - 3, f - 2) and contradictions(mesh) == [] and topology(mesh).genus == 0
    assert (mesh.vertices[kept] == (0, 0, 9)).all()


def test_collapsing_beside_a_square_leaves_a_triangle():
    edited = EditedMesh(winged_edge(of_polygons(CUBE, SQUARES)))
    edited.collapse(0)
    mesh = edited.result()
    assert counts(mesh) == (7, 11, 6) and contradictions(mesh) == []
    assert sorted(np.diff(mesh.lists().loop_starts).tolist()) == [3, 3, 4, 4, 4, 4]


def test_what_would_be_no_surface_is_refused_and_changes_nothing():
    tetrahedron = winged_edge(of_triangles(CUBE[[0, 1, 2, 4]], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]))
    edited = EditedMesh(tetrahedron)
    for work in (lambda: edited.collapse(0), lambda: edited.flip(0), lambda: edited.collapse(99),
                 lambda: edited.split_face(edited.sides(0)[0], edited.sides(0)[1])):  # fmt: skip
        with pytest.raises(Refusal):
            work()
    np.testing.assert_array_equal(edited.result().table, tetrahedron.table)
    square = EditedMesh(winged_edge(of_triangles(CUBE[:4], [(0, 1, 3), (0, 3, 2)])))
    with pytest.raises(Refusal, match="border"):
        square.flip(0)
    # Between the rims of a ring of eight squares, each in two triangles: an edge from rim to rim would pinch it.
    turn = np.arange(8) * np.pi / 4
    rims = np.concatenate([np.column_stack((r * np.cos(turn), r * np.sin(turn), 0 * turn)) for r in (1.0, 2.0)])
    rows = [(n, n + 8, (n + 1) % 8 + 8) for n in range(8)] + [(n, (n + 1) % 8 + 8, (n + 1) % 8) for n in range(8)]
    ring = EditedMesh(winged_edge(of_triangles(rims, rows)))
    half = ring.half(0, 8)
    with pytest.raises(Refusal, match="border"):
        ring.collapse(half[0])


@pytest.mark.parametrize(
    ("make", "seed"),
    [
        (lambda: solid(sphere(5, segments=16)), 1),
        (lambda: solid(box(20, 20, 4, centred=True) - cylinder(5, 20, centred=True, segments=12)), 2),
        (lambda: winged_edge(of_polygons(CUBE, SQUARES)), 3),
        (lambda: winged_edge(of_triangles(*_grid(7))), 4),
    ],
)
def test_thousands_of_operators_keep_it_valid(make, seed):
    """5,000 in all that were not refused."""
    mesh = make()
    start = topology(mesh)
    edited, generator = EditedMesh(mesh), np.random.default_rng(seed)
    done = dict.fromkeys(("split_edge", "split_face", "flip", "collapse"), 0)

    def attempt(name):
        edge = int(generator.choice(edited.live_edges()))
        if name == "split_edge":
            edited.split_edge(edge, generator.random(3))
        elif name == "split_face":
            sides = edited.sides(int(generator.choice(edited.live_faces())))
            edited.split_face(*(sides[int(n)] for n in generator.integers(0, len(sides), 2)))
        else:
            getattr(edited, name)(edge)

    for step in range(10_000):
        if sum(done.values()) >= 1250:
            break
        name = list(done)[step % 4]
        if name == "collapse" and len(edited.live_edges()) < 40:
            continue
        for _ in range(300):
            try:
                attempt(name)
            except Refusal:
                continue
            done[name] += 1
            break
        if sum(done.values()) % 10 == 0:
            now = edited.result()
            assert contradictions(now) == []
            found = topology(now)
            assert (found.euler, found.components, found.borders, found.genus, found.fans, found.repeated) == (
                start.euler, start.components, start.borders, start.genus, 0, 0
            )  # fmt: skip
            _, edges_at, begins = stars(now)
            assert len(edges_at) == 2 * len(now) and len(begins) == found.vertices
    assert sum(done.values()) >= 1250 and min(done.values()) > 200
    back = winged_edge(edited.result().lists())
    assert counts(back) == counts(edited.result()) and (back.table[:, START] >= 0).all()
    assert ((back.table[:, LEFT] >= 0) & (back.table[:, RIGHT] >= -1)).all()


def _grid(count):
    """A square patch with a border."""
    x, y = np.meshgrid(np.arange(count), np.arange(count))
    points = np.column_stack((x.reshape(-1), y.reshape(-1), np.zeros(count * count))).astype(float)
    corner = (y[:-1, :-1] * count + x[:-1, :-1]).reshape(-1)
    right, up = corner + 1, corner + count
    return points, np.concatenate((np.column_stack((corner, right, up)), np.column_stack((right, up + 1, up))))
