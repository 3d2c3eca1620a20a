"""What scripts and the command line learn from rays: the node that is met, and what stands between two points."""

import json

import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.script import (
    box,
    cylinder,
    document_of,
    first_hit,
    halfspace,
    linear_array,
    obstacle,
    save,
    sees,
    sphere,
)
from solidtree.model.scripting import sight

PLATE = (box(40, 30, 12) - linear_array(cylinder(4, 40, centred=True).named("drill").at(10, 15), 2)).named("plate")


def test_a_hit_names_the_node_that_made_the_face_and_its_way_from_the_root():
    hole = first_hit(PLATE, (30, 15, 6), (0, 3, 0))
    assert hole is not None and (hole.name, hole.solid) == ("drill", "plate")
    assert hole.path == ("plate", "Linear array", 1, "drill") and hole.front
    assert hole.distance == pytest.approx(4, abs=0.05) and hole.normal[1] == pytest.approx(-1, abs=0.2)
    top = first_hit(PLATE, (5, 5, 40), (0, 0, -1))
    assert top is not None and (top.name, top.point, top.distance) == (
        "Box",
        pytest.approx((5, 5, 12)),
        pytest.approx(28),
    )
    below = first_hit(PLATE, top.point, (0, 0, -1))  # it goes on from the face that it begins on
    assert below is not None and below.distance == pytest.approx(12) and not below.front
    assert first_hit(PLATE, (5, 5, 40), (0, 0, 1)) is None


def test_several_solids_and_documents_without_what_is_hidden():
    ball = sphere(3).at(5, 5, 30).named("ball")
    hit = first_hit([PLATE, ball], (5, 5, 60), (0, 0, -1))
    assert hit is not None and hit.name == "ball"
    document = document_of(PLATE, ball.hidden())
    hit = first_hit(document, (5, 5, 60), (0, 0, -1))
    assert hit is not None and hit.solid == "plate"
    assert not sees([PLATE, ball], (5, 5, 60), (5, 5, 13)) and sees(document, (5, 5, 60), (5, 5, 13))
    way = obstacle([PLATE, ball], (5, 5, 60), (5, 5, 13))
    assert way is not None and way.name == "ball" and way.distance == pytest.approx(27, abs=0.05)


def test_many_rays_evaluate_and_build_once():
    part = box(10) - sphere(4)
    sight._kept.clear()
    for i in range(50):
        first_hit(part, (20, i / 5, 3), (-1, 0, 0))
        sees(part, (20, i / 5, 3), (-20, 0, 0))
    assert len(sight._kept) == 1
    for i in range(2 * sight.MOST):
        first_hit(box(i + 1), (50, 0.5, 0.5), (-1, 0, 0))
    assert len(sight._kept) == sight.MOST
    hit = first_hit(part.named("other"), (20, 5, 5), (-1, 0, 0))  # equal, and called otherwise
    assert hit is not None and hit.solid == "other"


def test_what_cannot_be_asked_is_refused():
    for wrong in (((0, 0, 0), (0, 0, 0)), ((0, 0), (1, 0, 0)), ((0, 0, float("nan")), (1, 0, 0)), ("abc", (1, 0, 0))):
        with pytest.raises(Refusal, match="ray"):
            first_hit(PLATE, *wrong)
    with pytest.raises(Refusal, match="“Half-space”: goes on without end"):
        first_hit(halfspace(), (0, 0, 5), (0, 0, -1))
    with pytest.raises(Refusal, match="no solid is visible"):
        sees(PLATE.hidden(), (0, 0, 0), (1, 1, 1))


@pytest.fixture
def file(tmp_path):
    save(tmp_path / "part.solidtree", PLATE, box(10).named("block").at(60))
    return tmp_path / "part.solidtree"


def test_the_command_line_tells_the_hit_and_a_miss_is_an_answer(solidtree, file):
    status, out, err = solidtree("ray", file, "--origin", "100,5,5", "--direction=-2,0,0")
    assert status == 0 and err == ""
    assert json.loads(out)["hit"] == {
        "distance": pytest.approx(30),
        "point": pytest.approx([70, 5, 5]),
        "normal": [1, 0, 0],
        "front": True,
        "node": "block",
        "solid": "block",
        "path": ["block"],
    }
    assert json.loads(solidtree("ray", file, "--origin", "100,5,5", "--direction", "1,0,0")[1]) == {"hit": None}
    alone = solidtree("ray", file, "--origin", "100,5,5", "--direction=-1,0,0", "--solid", "plate")[1]
    assert json.loads(alone)["hit"]["point"] == pytest.approx([40, 5, 5])


def test_the_command_line_tells_what_stands_in_the_way(solidtree, file):
    status, out, _ = solidtree("ray", file, "--from", "100,5,5", "--to", "50,5,5")
    assert status == 0 and json.loads(out)["sees"] is False and json.loads(out)["obstacle"]["node"] == "block"
    status, out, _ = solidtree("ray", file, "--from", "10,15,50", "--to=10,15,-50")
    assert status == 0 and json.loads(out) == {"sees": True, "obstacle": None}


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        ([], "give --origin and --direction"),
        (["--origin", "1,2,3"], "give --origin and --direction"),
        (["--origin", "1,2,3", "--direction", "1,0,0", "--to", "1,1,1"], "give --origin and --direction"),
        (["--origin", "1,2,3", "--direction", "0,0,0"], "not zero"),
        (["--origin", "1,2", "--direction", "0,0,1"], "not three numbers"),
        (["--from", "1,2,3", "--to", "0,0,1", "--solid", "no"], "there is no solid called “no”"),
    ],
)
def test_what_cannot_be_done_is_one_line_and_status_2(solidtree, file, words, reason):
    status, out, err = solidtree("ray", file, *words)
    assert status == 2 and out == "" and reason in err and err.count("\n") == 1
