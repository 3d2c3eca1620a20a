"""What is seen of faces and parts: shadows by formula, words for all cases; scripts and the command line."""

import json

import numpy as np
import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.document.nodes import Node
from solidtree.model.measuring.sight import Scenery
from solidtree.model.measuring.visibility import HIDDEN, SEEN, TURNED, Eye, evenly, visibility
from solidtree.model.script import (
    box,
    cylinder,
    document_of,
    ray_hits,
    save,
    sees,
    sphere,
    visibility_map,
    visible_share,
)

FLOOR = box(20, 20, 1).at(-10, -10, -1).named("floor")
BALL, HIGH = 2.0, 5.0


def floor_seen(eye: Eye, other: Node, tolerance: float = 0.002):
    scenery = Scenery(document_of(FLOOR, other), tolerance)
    return visibility(scenery._solids.rays, [[[-10, -10, 0], [10, -10, 0], [10, 10, 0]],
                                             [[-10, -10, 0], [10, 10, 0], [-10, 10, 0]]], eye)  # fmt: skip


@pytest.mark.parametrize("height", [10.0, 14.0, 40.0, np.inf])
def test_the_shadow_of_a_ball_has_the_area_of_the_formula_within_the_error(height):
    """Of a ball of radius r at height h over a floor, lit from the height H above: a disc of radius
    H r / √((H - h)² - r²), of r for parallel light."""
    eye = Eye((0, 0, 1), True) if np.isinf(height) else Eye((0, 0, height))
    radius = BALL if np.isinf(height) else height * BALL / np.sqrt((height - HIGH) ** 2 - BALL**2)
    found = floor_seen(eye, sphere(BALL).at(0, 0, HIGH))
    assert found.area == pytest.approx(400)
    assert 0 < found.error < 0.006
    assert abs(found.part(HIDDEN) / 400 - np.pi * radius**2 / 400) < found.error + 0.001
    shaded = np.linalg.norm(found.points[found.state == HIDDEN], axis=1)
    lit = np.linalg.norm(found.points[found.state == SEEN], axis=1)
    assert shaded.max() < radius + 0.1 and lit.min() > radius - 0.1


def test_the_shadow_of_a_slab_from_aside_is_a_sheared_and_enlarged_rectangle():
    found = floor_seen(Eye((1, 0, 1), True), box(4, 6, 1e-3).at(0, -3, 5))
    assert found.part(HIDDEN) == pytest.approx(24, rel=0.02)  # it falls 5 mm to the left
    places = found.points[found.state == HIDDEN]
    assert places[:, 0].min() == pytest.approx(-5, abs=0.2) and places[:, 0].max() == pytest.approx(-1, abs=0.2)
    found = floor_seen(Eye((0, 0, 10)), box(4, 6, 1e-3).at(-2, -3, 5))
    assert found.part(HIDDEN) == pytest.approx(4 * 24, rel=0.02)


def test_each_texel_agrees_with_a_single_line_of_sight():
    post, eye = cylinder(1.5, 6), (8.0, 3.0, 7.0)
    found = visibility_map([FLOOR, post], eye, (9, 9, 0))
    rng = np.random.default_rng(5)
    away = np.abs(np.linalg.norm(found.points[:, :2], axis=1) - 1.5) > 0.3
    for k in rng.choice(np.flatnonzero(away), 60, replace=False):
        assert sees([FLOOR, post], eye, found.points[k]) == (found.state[k] == SEEN), found.points[k]
    assert set(found.obstacle[found.state == HIDDEN]) == {"Cylinder"} and set(found.obstacle[found.state == SEEN]) == {
        ""
    }


def test_a_smooth_face_is_looked_at_as_a_whole_and_half_of_a_cylinder_is_turned_away():
    found = visibility_map(cylinder(5, 20), (1, 0, 0), (5, 0, 10), parallel=True, tolerance=0.002)
    assert found.areas.sum() == pytest.approx(2 * np.pi * 5 * 20, rel=1e-3)
    assert found.areas[found.state == TURNED].sum() == pytest.approx(found.areas.sum() / 2, rel=0.05)
    assert found.share == 1.0


def test_words_for_what_is_seen_hidden_covered_enclosed_and_turned_away():
    lid, arm = box(10).named("lid"), box(20, 20, 1).at(-5, -5, 30).named("arm")
    assert visible_share(lid, (5, 5, 50), [arm]).words == "Nothing of “lid” is seen from there; “arm” hides 100 %"
    assert visible_share(lid, (5, 5, 50)).words == "All of “lid” that is turned this way is seen from there"
    assert visible_share(lid, (5, 5, 5)).words == "All of “lid” is turned away from there"
    half = visible_share(lid, (0, 0, 1), [box(5, 10, 1).at(0, 0, 20).named("strip")], parallel=True)
    assert half.share == pytest.approx(0.5, abs=1e-9 + half.error) and half.hiders == {"strip": pytest.approx(0.5)}
    assert "“strip” hides 50 %" in half.words
    touching = visible_share(lid, (5, 5, 50), [box(10).at(0, 0, 10).named("cap")])
    assert touching.share == 0.0 and touching.hiders == {"cap": 1.0}
    bowl = visible_share((box(10) - box(8, 8, 9).at(1, 1, 1)).named("bowl"), (1, 0, 1), parallel=True)
    assert 0 < bowl.share < 1 and "it hides" in bowl.words and "itself" in bowl.words


def test_an_eye_on_a_face_sees_before_it_and_nothing_through_its_body():
    wall = box(1, 20, 20).at(-11, -10, 0).named("wall")
    before, through = (visible_share(FLOOR, (x, 0, 10), [wall]) for x in (-10, -11))
    assert before.share == 1.0
    assert through.share == 0.0 and through.hiders == {"wall": pytest.approx(1.0)}


def test_many_triangles_are_sampled_evenly_by_area_and_the_error_is_told():
    ball = sphere(5, segments=256)
    scenery = Scenery(document_of(ball, box(20, 10, 1).at(-10, 0, 20)))
    rays, mesh = scenery._solids.rays, scenery._solids.meshes[0]
    found = visibility(rays, mesh.vertices[mesh.corners], Eye((0, 0, 1), True), most=2000)
    assert len(found.state[found.state != TURNED]) == 2000 and 0.01 < found.error < 0.03
    assert found.share == pytest.approx(0.5, abs=found.error)  # the slab covers one half
    assert np.bincount(evenly(np.array([1.0, 3.0, 0.0, 4.0]), 800)).tolist() == [100, 300, 0, 400]


def test_all_hits_of_a_ray_come_in_order_and_edges_count_once():
    hits = ray_hits([box(10).named("a"), box(10).at(20).named("b")], (-5, 5, 5), (1, 0, 0))
    assert [(hit.distance, hit.solid, hit.front) for hit in hits] == [
        (5, "a", True), (15, "a", False), (25, "b", True), (35, "b", False)
    ]  # fmt: skip
    assert len(ray_hits(box(10), (-5, 5, 5), (0, 1, 0))) == 0
    corner = ray_hits(box(10), (-5, -5, 5), (1, 1, 0))  # in at an edge, out at the opposite one
    assert [hit.distance for hit in corner] == pytest.approx([5 * 2**0.5, 15 * 2**0.5])
    ball = ray_hits(sphere(3), (-10, 0.1, 0.2), (1, 0, 0), tolerance=0.001)
    reach = (9 - 0.1**2 - 0.2**2) ** 0.5
    assert [hit.distance for hit in ball] == pytest.approx([10 - reach, 10 + reach], abs=0.002)


def test_what_cannot_be_asked_is_refused():
    with pytest.raises(Refusal, match="direction to the eye is zero"):
        visible_share(box(10), (0, 0, 0), parallel=True)
    with pytest.raises(Refusal, match="eye of a ray is three numbers"):
        visible_share(box(10), (0, 0))
    with pytest.raises(Refusal, match="no face is at"):
        visibility_map(box(10), (5, 5, 50), (5, 5, 40))


def test_the_command_line_answers_for_points_parts_and_faces(solidtree, tmp_path):
    file = tmp_path / "parts.solidtree"
    save(file, box(10).named("lid"), box(5, 10, 1).at(0, 0, 20).named("strip"))
    status, out, err = solidtree("sight", file, "--from", "0,0,1", "--parallel", "--part", "lid")
    answer = json.loads(out)
    assert status == 0 and err == "" and answer["share"] == pytest.approx(0.5, abs=0.01)
    assert answer["hiders"] == {"strip": pytest.approx(0.5, abs=0.01)} and answer["area"]["turned_away"] == 500
    answer = json.loads(solidtree("sight", file, "--from", "5,5,15", "--face", "5,5,10")[1])
    assert answer["share"] == 1 and answer["area"]["seen"] == pytest.approx(100)
    answer = json.loads(solidtree("sight", file, "--from", "2,5,40", "--to", "2,5,10")[1])
    assert answer["sees"] is False and answer["obstacle"]["solid"] == "strip"
    status, out, err = solidtree("sight", file, "--from", "2,5,40", "--part", "none")
    assert status == 2 and "there is “lid”, “strip”" in err
