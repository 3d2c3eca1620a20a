"""How solids stand to each other: by formula, in words for every case, and against brute force over the corpus."""

import numpy as np
import pytest
from manifold3d import Manifold

from solidtree.model.document.errors import Refusal
from solidtree.model.measuring.distance import distance as nearest_triangles
from solidtree.model.proximity.bodies import Body, relation, relations
from solidtree.model.script import (
    box,
    circle,
    clearances,
    contacts_in_motion,
    cylinder,
    distance,
    document_of,
    first_contact,
    halfspace,
    inside,
    meant_to_touch,
    motion,
    moved_by,
    nearest,
    overlap,
    sphere,
    with_clearance,
)
from solidtree.model.script import relation as relation_of
from solidtree.model.solid.results import arrays_of


def body(solid: Manifold, name: str = "") -> Body:
    return Body(name, *arrays_of(solid.to_mesh64()), solid)


CUBE = Manifold.cube((10, 10, 10))


@pytest.mark.parametrize(
    ("other", "kind", "gap", "shared"),
    [
        (CUBE.translate((13, 0, 0)), "apart", 3, 0),
        (CUBE.translate((13, 14, 0)), "apart", 5, 0),
        (CUBE.translate((10, 0, 0)), "touching", 0, 0),
        (CUBE.translate((10, 10, 10)), "touching", 0, 0),
        (CUBE.translate((9, 8, 0)), "overlapping", 0, 20),
        (CUBE, "overlapping", 0, 1000),
        (Manifold.cube((2, 2, 2)).translate((4, 4, 4)), "around", 0, 8),
        (Manifold.cube((20, 20, 20)).translate((-5, -5, -5)), "inside", 0, 1000),
        (Manifold.cube((2, 2, 2)).translate((4, 4, 8)), "overlapping", 0, 8),
        (Manifold.cube((2, 2, 2)).translate((4, 4, 10)), "touching", 0, 0),
    ],
)
def test_boxes_in_every_way(other, kind, gap, shared):
    found = relation(body(CUBE), body(other))
    assert (found.kind, found.gap) == (kind, pytest.approx(gap, abs=1e-12))
    assert found.overlap == pytest.approx(shared, abs=1e-9)
    assert (found.points is None) == (shared > 0)
    if kind == "apart":
        assert np.linalg.norm(found.points[0] - found.points[1]) == pytest.approx(gap)


def test_a_body_in_a_cavity_is_not_inside():
    shell = CUBE - Manifold.cube((6, 6, 6)).translate((2, 2, 2))
    ball = Manifold.cube((2, 2, 2)).translate((4, 4, 4))
    found = relation(body(ball), body(shell))
    assert (found.kind, found.gap, found.overlap) == ("apart", 2, 0)
    assert relation(body(ball), body(shell), 1.5) is None


def test_one_of_two_pieces_inside_is_an_overlap():
    pieces = Manifold.cube((1, 1, 1)).translate((5, 5, 5)) + Manifold.cube((1, 1, 1)).translate((50, 5, 5))
    found = relation(body(pieces), body(CUBE))
    assert (found.kind, found.overlap) == ("overlapping", pytest.approx(1))


def test_open_and_empty_surfaces():
    vertices, triangles = arrays_of(CUBE.to_mesh64())
    sheet = Body("sheet", vertices, triangles[:6])
    found = relation(sheet, body(CUBE.translate((30, 0, 0))))
    assert (found.kind, found.gap, found.overlap) == ("apart", 20, None)
    assert relation(sheet, body(Manifold.cube((1, 1, 1)).translate((5, 5, 5)))).kind == "apart"  # nothing is inside it
    empty = Body("nothing", np.zeros((0, 3)), np.zeros((0, 3), int))
    assert relation(sheet, empty) is None


def test_pairs_are_judged_together_each_below_its_own_limit():
    bodies = [body(CUBE.translate((x, 0, 0))) for x in (0, 9, 19, 29.4)]
    pairs = [(0, 1), (1, 2), (2, 3), (2, 3), (0, 3)]
    found = relations(bodies, pairs, [0.0, 0.0, 0.5, 0.4, 5.0])
    kinds = [one and one.kind for one in found]
    assert kinds == ["overlapping", "touching", "apart", None, None]  # a gap as wide as the limit is wide enough
    assert found[2].gap == pytest.approx(0.4)


def test_all_pairs_of_a_crowd_are_those_of_brute_force():
    rng = np.random.default_rng(4)
    solids = [
        (Manifold.sphere(1, 12) if k % 2 else Manifold.cube((1, 2, 1))).rotate(rng.uniform(0, 360, 3).tolist())
        .translate(rng.uniform(0, 5, 3).tolist()) for k in range(13)
    ]  # fmt: skip
    bodies = [body(solid) for solid in solids]
    pairs = [(i, j) for i in range(13) for j in range(i + 1, 13)]
    known = relations(bodies, pairs, [0.6] * len(pairs))
    found = {pair: one for pair, one in zip(pairs, known, strict=True) if one is not None}
    for i in range(13):
        for j in range(i + 1, 13):
            shared = (solids[i] ^ solids[j]).volume()
            gap = nearest_triangles(*(b.vertices[b.triangles] for b in (bodies[i], bodies[j]))).length
            assert ((i, j) in found) == (shared > 1e-9 or gap < 0.6)
            if (i, j) in found:
                assert found[i, j].overlap == pytest.approx(shared, abs=1e-9)
                assert found[i, j].gap == pytest.approx(0 if shared > 1e-9 else gap, abs=1e-9)


def test_progress_is_told_and_may_stop():
    def stop(done, total):
        raise KeyboardInterrupt

    bodies = [body(CUBE), body(CUBE)]
    with pytest.raises(KeyboardInterrupt):
        relations(bodies, [(0, 1)], [0.0], stop)


def test_scripts_ask_in_the_same_words():
    assert distance(cylinder(3, 10), box(4).at(5, 0, 3)) == pytest.approx(2, abs=1e-9)
    assert overlap(box(10), sphere(20)) == pytest.approx(1000)
    with pytest.raises(Refusal, match="no surface"):
        distance(box(1), box(1) - box(2).at(-0.5, -0.5, -0.5))
    pairs = clearances([box(2).named("a"), box(2).at(2.5).named("b"), box(2).at(9).named("c").hidden()], 1)
    assert [(p["a"], p["b"], p["relation"], p["gap"]) for p in pairs] == [("a", "b", "apart", 0.5)]
    assert [x for x, _, _ in pairs[0]["points"]] == [2, 2.5]


def test_scripts_refuse_what_has_no_answer():
    with pytest.raises(Refusal, match="an outline is none"):
        distance(circle(5), box(1))
    with pytest.raises(Refusal, match=r"“Ground”.*without end"):
        distance(halfspace().named("Ground"), box(1))
    with pytest.raises(Refusal, match=r"“Ground”.*without end"):  # and not an empty list: nobody has looked
        clearances([box(1), halfspace().named("Ground")], 1)
    for clearance in (-1, np.nan, np.inf):
        with pytest.raises(Refusal, match="a clearance"):
            clearances([box(1), box(1).at(3)], clearance)


@pytest.mark.parametrize(
    "question",
    [
        lambda: clearances("box"),
        lambda: clearances([box(1), None]),
        lambda: meant_to_touch(box(1), "a", "b"),
        lambda: contacts_in_motion(box(1)),
        lambda: distance(box(1), box(1), np.nan),
        lambda: distance(sphere(1), box(1), "0.1"),
        lambda: nearest(box(1), [(1e200, 0, 0)]),
        lambda: inside(box(1), "here"),
        lambda: first_contact(box(1), None, [moved_by()]),
        lambda: first_contact(box(1), box(1).at(3), [moved_by(), moved_by(1)], ["a", "b"]),
        lambda: first_contact(box(1), box(1).at(3), None),
        lambda: motion(document_of(box(1)), "far", start=-1e308, end=1e308),
    ],
)
def test_bad_questions_are_refused_in_words(question):
    with pytest.raises(Refusal):
        question()


def test_solids_that_touch_far_from_the_origin_touch():
    one, other = (box(10).at(1e5 + x).turned(z=30) for x in (0, 10))
    assert relation_of(one, other).kind == "touching"


def test_corpus_solids_at_random_places(corpus):
    """Gaps against the pairs of triangles, and witness points on both surfaces."""
    from pathlib import Path

    from solidtree.model.exchange.meshes_in import read_mesh_file

    rng = np.random.default_rng(9)
    solids = []
    for path in sorted((corpus / "mesh").rglob("*.stl")):
        try:
            part = read_mesh_file(path, Path(path).suffix[1:].lower())[0]
        except Refusal:
            continue
        if not part.closed or not 4 <= len(part.triangles) <= 1500:
            continue
        size = np.ptp(part.vertices, axis=0).max()
        points = (part.vertices - part.vertices.mean(axis=0)) / size
        mesh = points[part.triangles]
        if np.einsum("ij,ij->i", mesh[:, 0], np.cross(mesh[:, 1], mesh[:, 2])).sum() > 0:
            solids.append((points, part.triangles.astype(np.int64)))
    assert len(solids) >= 5
    for _ in range(30):
        (p, one), (q, other) = (solids[k] for k in rng.integers(0, len(solids), 2))
        q = q @ np.linalg.qr(rng.normal(size=(3, 3)))[0] + rng.normal(size=3)
        found = Body("", p, one).tree.gap(Body("", q, other).tree)
        expected = nearest_triangles(p[one], q[other]).length
        assert found.length == pytest.approx(expected, abs=1e-9)
        for point, tree in ((found.a, Body("", p, one).tree), (found.b, Body("", q, other).tree)):
            assert tree.nearest(point[None]).distances[0] < 1e-9


def test_scripts_ask_where_points_are():
    hollow = box(10) - box(4).at(3, 3, 3)
    places = nearest(hollow, [(5, 5, 5), (5, 5, 12)])
    assert places.distances.tolist() == [2, 2] and places.places[1].tolist() == [5, 5, 10]
    assert inside(hollow, np.array([(5, 5, 5), (1, 5, 5), (11, 5, 5)])).tolist() == [False, True, False]
    assert inside(hollow, (1, 1, 1)).tolist() == [True] and inside(hollow, []).shape == (0,)
    for points in ("here", [(1, 2)], [(1, 2, np.nan)]):
        with pytest.raises(Refusal, match="rows of three finite numbers"):
            nearest(hollow, points)
    with pytest.raises(Refusal, match="an outline is none"):
        inside(circle(5), [(0, 0, 0)])


def test_scripts_say_what_is_to_hold_of_pairs():
    document = document_of(a=box(10), b=box(10).at(10.5), c=box(10).at(0, 10.2))
    asked = with_clearance(with_clearance(document, 0.3), 1, "a", "b")
    assert [(pair["b"], pair["asked"]) for pair in clearances(asked)] == [("c", 0.3), ("b", 1)]
    assert [pair["b"] for pair in clearances(asked, 0)] == ["b"]
    assert [pair["gap"] for pair in clearances(meant_to_touch(document, "a", "b"))] == [0.5]
    with pytest.raises(Refusal, match="name both"):
        with_clearance(document, 1, "a")
    with pytest.raises(Refusal, match="no solid called “d”"):
        meant_to_touch(document, "a", "d")
