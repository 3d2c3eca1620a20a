"""What is wrong with meshes: single faults made on purpose, and the corpus by its published counts."""

import json
from pathlib import Path

import numpy as np
import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.mesh.report import check

CUBE = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
TRIANGLES = np.array([(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3),
                      (0, 4, 6), (0, 6, 2), (1, 3, 7), (1, 7, 5)])  # fmt: skip


def counted(vertices, triangles, tolerance=0.01):
    return {kind: count for kind, count in check(vertices, triangles, tolerance).counts.items() if count}


def test_a_sound_cube_has_nothing():
    found = check(CUBE, TRIANGLES)
    assert found.clean and not found.findings
    assert (found.vertices, found.triangles, found.edges, found.components) == (8, 12, 18, 1)
    assert str(found) == "12 triangles, 8 vertices, 1 piece: nothing found"


def test_each_fault_is_found_at_its_place():
    missing = check(CUBE, TRIANGLES[1:])
    assert missing.counts["open edge"] == 3 and missing.findings[0].size == pytest.approx(2**0.5)
    assert all(finding.place[2] == 0 for finding in missing.findings)
    assert counted(CUBE, np.vstack((TRIANGLES[:-1], TRIANGLES[-1:, ::-1]))) == {"turned edge": 3}
    twice = counted(CUBE, np.vstack((TRIANGLES, TRIANGLES[3:4])))
    assert twice == {"doubled face": 1, "branching edge": 3}
    flat = np.vstack((TRIANGLES, [(0, 0, 1)]))
    assert counted(CUBE, flat) == {"degenerate face": 1}
    fin = np.vstack((CUBE, [(0.5, 0.5, 2)]))
    assert counted(fin, np.vstack((TRIANGLES, [(4, 7, 8)]))) == {"branching edge": 1, "open edge": 2}


def test_a_gap_is_found_by_its_vertices_and_its_edges():
    """The top is a square of its own, 4 thousandths above the walls; one of the walls' corners has another vertex."""
    top = CUBE[4:] + np.array((0, 0, 0.004))
    points = np.vstack((CUBE, top, [(0.5, 0.0, 1.001)]))
    faces = np.vstack((TRIANGLES[:2], TRIANGLES[4:], [(8, 9, 11), (8, 11, 10)]))
    found = check(points, faces, 0.01)
    assert found.counts["near vertices"] == 4 and found.components == 2 and found.counts["open edge"] == 8
    assert {round(one.size, 6) for one in found.findings if one.kind == "near vertices"} == {0.004}
    assert check(points, faces, 0.001).counts["near vertices"] == 0
    split = np.vstack((faces[:-2], [(8, 12, 11), (12, 9, 11), (8, 11, 10)]))
    beside = [one for one in check(points, split, 0.01).findings if one.kind == "vertex near edge"]
    assert len(beside) == 1 and beside[0].size == pytest.approx(0.001) and beside[0].place == (0.5, 0.0, 1.001)


def test_slivers_are_thinner_than_the_tolerance():
    points = np.array([(0, 0, 0), (10, 0, 0), (5, 0.005, 0), (5, -3, 0)])
    faces = [(0, 1, 2), (1, 0, 3)]
    assert counted(points, faces)["sliver"] == 1 and "sliver" not in counted(points, faces, 0.001)


def test_vertices_at_one_place_count_once():
    soup = CUBE[TRIANGLES].reshape(-1, 3)
    found = check(soup, np.arange(36).reshape(-1, 3))
    assert found.clean and found.vertices == 8


def test_meshes_of_the_corpus_have_their_published_counts(corpus):
    from solidtree.model.exchange.meshes_in import read_mesh_file

    expected = json.loads((corpus / "mesh" / "expected.json").read_text())
    done = dirty = 0
    for name, case in sorted(expected.items()):
        told = case.get("independent")
        if not told or not 1 <= told.get("triangles", 0) <= 20000 or "components_by_edge" not in told:
            continue
        try:
            parts = read_mesh_file(corpus / "mesh" / name, Path(name).suffix[1:].lower())
        except Refusal:
            continue
        if len(parts) != 1 or len(parts[0].triangles) != told["triangles"] - told.get("degenerate_dropped", 0):
            continue
        found = check(parts[0].vertices, parts[0].triangles)
        if found.vertices != told["vertices"]:
            continue
        assert found.counts["open edge"] == told["boundary_edges"], name
        assert found.counts["branching edge"] == told["nonmanifold_edges"], name
        assert found.components == told["components_by_edge"], name
        done += 1
        dirty += bool(told["boundary_edges"] or told["nonmanifold_edges"])
    assert done >= 60 and dirty >= 10
