"""Repairs of meshes: each fault mended, random damage undone, and nothing made worse without saying so."""

import numpy as np
import pytest
from manifold3d import Manifold
from test_mesh_faults import meshes_of

from solidtree.model.document.errors import Refusal
from solidtree.model.mesh.faults.orienting import windings
from solidtree.model.mesh.faults.repair import NAMES, REPAIRS, mended, repaired
from solidtree.model.mesh.faults.report import FAULTS, find_faults

CUBE = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
TRIANGLES = np.array([(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3),
                      (0, 4, 6), (0, 6, 2), (1, 3, 7), (1, 7, 5)])  # fmt: skip


def arrays(solid):
    mesh = solid.to_mesh64()
    return np.array(mesh.vert_properties)[:, :3], np.array(mesh.tri_verts).astype(np.int64)


SOLIDS = {
    "cube": (CUBE, TRIANGLES),
    "ball": arrays(Manifold.sphere(10, 48)),
    "drilled": arrays(Manifold.cube((20, 20, 20), True) - Manifold.cylinder(40, 6, 6, 40, True)),
    "hollow": arrays(Manifold.cube((20, 20, 20), True) - Manifold.sphere(6, 32)),
}


@pytest.mark.parametrize("name", SOLIDS)
def test_a_sound_solid_is_left_as_it_is(name):
    points, faces = SOLIDS[name]
    result = repaired(points, faces)
    assert result.words == () and result.worse == () and result.after.sound
    assert np.array_equal(result.vertices, points) and np.array_equal(result.triangles, faces)


@pytest.mark.parametrize("name", SOLIDS)
def test_a_soup_of_triangles_is_welded(name):
    points, faces = SOLIDS[name]
    result = repaired(points[faces].reshape(-1, 3), np.arange(faces.size).reshape(-1, 3))
    assert result.after.sound and result.after.vertices == len(points) and not result.worse
    assert result.after.volume == pytest.approx(find_faults(points, faces).volume)


def test_holes_are_filled_and_a_flat_one_by_a_flat_face():
    result = repaired(CUBE, TRIANGLES[2:], repairs=["holes"])
    assert result.words == ("1 hole closed with 2 triangles",) and result.after.volume == pytest.approx(1)
    points, faces = SOLIDS["ball"]
    near = np.linalg.norm(points[faces].mean(axis=1) - (0, 0, 10), axis=1) < 3
    result = repaired(points, faces[~near], repairs=["holes"])
    assert result.after.closed and result.after.volume == pytest.approx(find_faults(points, faces).volume, rel=0.02)


def test_a_ring_shaped_gap_becomes_a_flat_ring():
    """The top of the drilled cube without its flat face: two borders, one within the other."""
    points, faces = SOLIDS["drilled"]
    top = (points[faces][:, :, 2] > 9.999).all(axis=1)
    result = repaired(points, faces[~top], repairs="holes")
    assert result.before.borders == 2 and result.after.sound
    assert result.after.volume == pytest.approx(find_faults(points, faces).volume)


def test_long_borders_are_left_where_a_longest_one_is_given():
    result = repaired(CUBE, TRIANGLES[2:], repairs=["holes"], longest=3.9)
    assert result.words == ("1 longer border left open",) and result.after.open_edges == 4
    assert repaired(CUBE, TRIANGLES[2:], repairs=["holes"], longest=4.1).after.sound


def test_turned_faces_agree_and_cavities_stay_cavities():
    points, faces = SOLIDS["hollow"]
    volume = find_faults(points, faces).volume
    rng = np.random.default_rng(4)
    turned = faces.copy()
    chosen = rng.random(len(faces)) < 0.3
    turned[chosen] = turned[chosen, ::-1]
    for wrong in (turned, faces[:, ::-1]):
        result = repaired(points, wrong, repairs=["orient"])
        assert result.after.sound and result.after.volume == pytest.approx(volume)


def test_a_moebius_band_is_left_with_a_word():
    count = 24
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    middle = np.column_stack((np.cos(angle), np.sin(angle), 0 * angle)) * 10
    way = np.column_stack((np.cos(angle) * np.cos(angle / 2), np.sin(angle) * np.cos(angle / 2), np.sin(angle / 2)))
    points = np.concatenate((middle - way, middle + way))
    rows = []
    for k in range(count):
        a, b, c, d = k, k + 1, k + count + 1, k + count
        if k == count - 1:
            b, c = count, 0
        rows += [(a, b, c), (a, c, d)]
    result = repaired(points, rows, repairs=["orient"])
    assert result.words == ("1 surface with one side only left as it is",)
    assert np.array_equal(result.triangles, rows)


def test_duplicates_go_and_faces_back_to_back_go_both():
    twice = np.vstack((TRIANGLES, TRIANGLES[3:5]))
    result = repaired(CUBE, twice, repairs=["duplicates"])
    assert result.words == ("2 repeated triangles dropped",) and np.array_equal(result.triangles, TRIANGLES)
    points = np.vstack((CUBE, [(3, 0, 0), (3, 1, 0), (3, 0, 1)]))
    flap = np.vstack((TRIANGLES, [(8, 9, 10), (10, 9, 8)]))
    result = repaired(points, flap, repairs=["duplicates"])
    assert result.words == ("1 pair of triangles back to back dropped",) and result.after.sound


def test_slivers_are_drawn_together_or_laid_across():
    points = np.vstack((CUBE, [(0.5, 0, 0), (0.5, 0.0005, 0)]))  # on an edge, and just beside it
    faces = np.array([*TRIANGLES[2:4], *TRIANGLES[5:], (0, 2, 9), (2, 3, 9), (3, 1, 9), (0, 9, 8), (9, 1, 8),
                      (0, 8, 5), (8, 1, 5)])  # fmt: skip
    before = find_faults(points, faces)
    assert before.closed and before.slivers == 2
    result = repaired(points, faces, repairs=["slivers"])
    assert result.after.slivers == 0 and result.after.closed and not result.after.crossings
    assert result.after.volume == pytest.approx(1, abs=1e-3)


def test_a_vertex_beside_an_open_edge_is_joined_to_it():
    """The lid's border has a vertex that the walls' straight edge lacks."""
    points = np.vstack((CUBE, [(0.4, 0.0, 1.0002)]))
    faces = np.vstack((TRIANGLES[:2], TRIANGLES[3:], [(4, 8, 7), (8, 5, 7)]))
    result = repaired(points, faces, 0.001)
    assert result.before.near_vertex_edge == 1 and result.after.sound
    assert result.words[0] == "1 open edge cut at a vertex beside it"


@pytest.mark.parametrize("seed", range(12))
def test_random_damage_is_undone_or_told(seed):
    """Triangles taken out, turned, doubled and torn apart, at random: closed again with the volume back."""
    rng = np.random.default_rng(seed)
    name = sorted(SOLIDS)[seed % len(SOLIDS)]
    points, faces = SOLIDS[name]
    volume, size = find_faults(points, faces).volume, float(np.ptp(points, axis=0).max())
    damaged = faces.copy()
    turned = rng.random(len(faces)) < 0.1
    damaged[turned] = damaged[turned, ::-1]
    damaged = np.vstack((damaged, damaged[rng.integers(0, len(damaged), 3)]))
    torn = points[damaged].reshape(-1, 3) + rng.uniform(-1e-7, 1e-7, (damaged.size, 3)) * size
    gone = rng.integers(0, len(faces), 2)  # of the first copies; their doubles may be among the last three rows
    rows = np.setdiff1d(np.arange(len(damaged)), gone)
    result = repaired(torn, np.arange(damaged.size).reshape(-1, 3)[rows], 1e-5 * size)
    assert result.after.closed and not result.after.turned_edges and not result.after.duplicates, str(result.after)
    assert result.after.volume == pytest.approx(volume, rel=0.03)
    assert_told(result)


@pytest.mark.parametrize("seed", range(8))
def test_whatever_a_mesh_is_what_is_worse_is_told(seed):
    """Triangles over few vertices at random: all sorts of edges, nothing to be closed by any means."""
    rng = np.random.default_rng(seed)
    points = rng.integers(0, 4, (30, 3)) * 1.0 + rng.choice([0.0, 1e-4], (30, 3))
    result = repaired(points, rng.integers(0, 30, (60, 3)), 1e-3)
    assert_told(result)


def assert_told(result):
    """Every count that rose stands in `worse`, and so does a volume that changed."""
    for name in FAULTS:
        if getattr(result.after, name) > getattr(result.before, name):
            assert any(line.startswith(f"{NAMES[name]}:") for line in result.worse), name
    if None not in (result.before.volume, result.after.volume):
        one, two = abs(result.before.volume), abs(result.after.volume)
        assert abs(one - two) <= 1e-9 * one or any(line.startswith("volume:") for line in result.worse)
    again = find_faults(result.vertices, result.triangles, result.after.tolerance)
    assert [getattr(again, name) for name in FAULTS] == [getattr(result.after, name) for name in FAULTS]


def test_absurd_meshes_do_no_harm():
    one = [(0, 1, 2)]
    for points, faces in (
        (np.zeros((0, 3)), np.zeros((0, 3), int)),
        (CUBE[:3], one),
        (np.zeros((3, 3)), one),
        (CUBE, np.array([(0, 0, 0)])),
        (CUBE * 1e-300, TRIANGLES),
        (CUBE * 1e-160, TRIANGLES),
        (CUBE * 1e150, TRIANGLES),
        (CUBE * 1e300, TRIANGLES),
        (CUBE * [1e300, 1e-300, 1.0], TRIANGLES),
        (np.array([(-1.7e308, 0, 0), (1.7e308, 0, 0), (0, 1.7e308, 0)]), one),
    ):
        try:
            result = repaired(points, faces)
        except Refusal:
            continue
        assert result.after.triangles == len(result.triangles)


def test_no_mesh_of_the_corpus_is_made_worse_without_a_word(corpus):
    closed = done = 0
    for name, _, part in meshes_of(corpus):
        if len(part.triangles) > 2_500:
            continue
        before = find_faults(part.vertices, part.triangles)
        if before.sound:
            continue
        result = repaired(part.vertices, part.triangles)
        assert_told(result)
        assert result.after.open_edges <= before.open_edges, name
        assert result.after.closed or not before.closed or result.worse, name
        done += 1
        closed += not before.closed and result.after.closed
    assert done >= 15 and closed >= 8


def test_repairs_are_known_by_their_names():
    with pytest.raises(Refusal, match="no repair; there are weld, duplicates, slivers, orient, holes"):
        mended(CUBE, TRIANGLES, repairs=["glue"])
    with pytest.raises(Refusal, match="longest border"):
        mended(CUBE, TRIANGLES, longest=float("nan"))
    assert list(REPAIRS) == ["weld", "duplicates", "slivers", "orient", "holes"]


def test_windings_tell_inside_from_outside():
    points = np.array([(0.5, 0.5, 0.5), (2.0, 0.5, 0.5)])
    assert windings(points, CUBE[TRIANGLES]) == pytest.approx([1, 0], abs=1e-12)
