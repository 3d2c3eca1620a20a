"""`solidtree pipeline`, and the pipeline in scripts: stages by formula, counts of what can be counted by hand."""

import json

import numpy as np
import pytest

from solidtree.model.script import Refusal, box, document_of, pipeline, pipeline_counts, save, sphere


@pytest.fixture
def file(tmp_path):
    save(tmp_path / "box.solidtree", document_of(block=box(20, centred=True)))
    return tmp_path / "box.solidtree"


EYE = ("--eye", "0,-100,0", "--perspective", "90", "--size", "400x200")


def test_a_point_goes_through_the_matrices_to_its_pixel(solidtree, file):
    status, out, err = solidtree("pipeline", file, "--point", "10,-10,5", "--target", "0,0,0", *EYE)
    told = json.loads(out)
    assert status == 0 and err == ""
    stages = {stage["name"]: stage["coordinates"] for stage in told["point"]["stages"]}
    assert list(stages) == ["model", "world", "eye", "clip", "device", "pixel"] and told["point"]["seen"]
    np.testing.assert_allclose(stages["eye"], (10, 5, -90), atol=1e-9)
    # 90 degrees high: the picture shows as many mm up and down as the point is away, and twice that to the sides.
    np.testing.assert_allclose(stages["clip"][:2], (5, 5), atol=1e-9)
    assert stages["clip"][3] == pytest.approx(90)
    np.testing.assert_allclose(stages["pixel"][:2], (200 + 200 * 5 / 90, 100 - 100 * 5 / 90))
    view, projection = (np.array(told["matrices"][name]) for name in ("view", "projection"))
    np.testing.assert_allclose(projection @ view @ (10, -10, 5, 1), stages["clip"], atol=1e-9)
    near, far = told["clipping"]
    assert 0 < near < 90 < 110 < far
    # The front, 90 mm away, hides the back.
    side = 20 / 90 * 100
    assert told["counts"]["pixels"] == pytest.approx(side**2, rel=0.05) and told["counts"]["triangles"] == 12


def test_planes_and_culling_are_options_and_words_say_what_is_outside(solidtree, file):
    words = ("pipeline", file, *EYE, "--near", "95", "--far", "105", "--point", "10,-10,5")
    told = json.loads(solidtree(*words)[1])
    assert told["point"]["outside"] == ["near"] and "outside the near plane" in told["point"]["stages"][3]["words"]
    assert told["counts"]["outside"] == 4 and told["counts"]["cut"] == 8  # front and back are gone
    culled = json.loads(solidtree("pipeline", file, *EYE, "--cull")[1])["counts"]
    assert (culled["facing_away"], culled["polygons"], culled["overdraw"]) == (10, 2, 1.0)


def test_what_cannot_be_is_said_in_one_line(solidtree, file, tmp_path):
    status, out, err = solidtree("pipeline", file, *EYE, "--near", "50", "--far", "20")
    assert (status, out) == (2, "") and "must lie behind" in err and err.count("\n") == 1
    assert solidtree("pipeline", file, "--point", "1,2")[0] == 2
    save(tmp_path / "empty.solidtree", document_of())
    status, out, _ = solidtree("pipeline", tmp_path / "empty.solidtree")
    assert status == 1 and json.loads(out)["counts"]["pixels"] == 0


def test_scripts_follow_points_and_count():
    way = pipeline((0, 0, 0), eye=(0, -50, 0), size=(300, 200))
    assert way.pixel[:2] == pytest.approx((150, 100)) and way.outside == () and str(way).startswith("Model")
    aside = pipeline((0, 0, 0), (0, -50, 0), model=[(1, 0, 0, 80), (0, 1, 0, 0), (0, 0, 1, 0)])
    assert aside.stages[1].coordinates == (80, 0, 0) and aside.outside == ("right",)
    assert "80" in aside.stages[1].formulas[0]
    culled, whole = (pipeline_counts(sphere(10, segments=24), eye=(0, -60, 20), cull=cull) for cull in (True, False))
    assert culled.away > 0 and culled.pixels == whole.pixels and culled.fragments < whole.fragments
    assert whole.triangles == culled.triangles == culled.away + culled.polygons
    for wrong in (dict(near=10, far=5), dict(near=-1), dict(size=(0, 10)), dict(model=np.zeros((4, 4)))):
        with pytest.raises(Refusal):
            pipeline((0, 0, 0), (0, -50, 0), **wrong)
    with pytest.raises(Refusal, match="same point"):
        pipeline((0, 0, 0), (0, 0, 0))
