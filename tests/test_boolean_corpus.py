"""Cases of other people's test suites, with the volumes, areas and genera that they publish."""

import json

import pytest
from csg_reader import read_csg

from solidtree.model.document.primitives import Halfspace
from solidtree.model.script import box
from solidtree.model.solid.evaluate import Evaluator
from solidtree.model.solid.results import measures_of


def measured(node):
    entry = Evaluator().evaluate(node)
    assert entry.solid is not None, entry.problems
    return measures_of(entry.solid.to_mesh64())


def check_published(measures, published):
    """Published figures hold within the tolerance that comes with them, else within rounding."""
    if published.get("empty"):
        assert measures.triangles == 0 and measures.volume == 0
        return
    for name in ("volume", "area"):
        if f"{name}_analytic" in published:
            assert getattr(measures, name) == pytest.approx(published[f"{name}_analytic"], rel=1e-9)
        elif name in published:
            slack = published.get(f"{name}_tol", 1e-9 * max(1, published[name]))
            assert getattr(measures, name) == pytest.approx(published[name], abs=slack)
    if "components" in published:
        assert measures.components == published["components"]
    if "genus" in published:
        # Published as 1 - chi / 2 for the whole; ours is the sum over the surfaces.
        assert measures.genus - measures.components + 1 == published["genus"]


def test_published_boolean_cases(corpus):
    folder = corpus / "boolean"
    cases = json.loads((folder / "expected.json").read_text())
    wrong = {}
    for name, case in cases.items():
        node = read_csg((folder / "csg" / f"{name}.csg").read_text())
        try:
            measures = measured(node)
            check_published(measures, case["published"])
            if "volume" in case.get("cgal", {}) and "volume" not in case["published"]:
                # From a file of six digits.
                assert measures.volume == pytest.approx(case["cgal"]["volume"], rel=1e-4)
        except AssertionError as error:
            wrong[name] = str(error)
    assert not wrong


def test_published_half_spaces(corpus):
    """The cases that the suite cuts by a plane, cut by a half-space here."""
    folder = corpus / "boolean"
    cases = json.loads((folder / "expected.json").read_text())
    found = {name: case["published"] for name, case in cases.items() if "half_space" in case["published"]}
    assert found
    for name, published in found.items():
        plane = published["half_space"]
        keep = 1 if plane["keep"] == "above" else -1
        normal = tuple(keep * x for x in plane["normal"])
        point = tuple(plane["offset"] * x for x in plane["normal"])
        whole = read_csg((folder / "csg" / f"{name}.csg").read_text())
        check_published(measured(whole & Halfspace(normal=normal, point=point)), published)


def test_thingicsg_cases(corpus):
    folder = corpus / "thingicsg"
    wrong = {}
    for name, case in json.loads((folder / "expected.json").read_text())["cases"].items():
        expected = case["expected"]
        measures = measured(read_csg((folder / "basic" / f"{name.removeprefix('Basic__')}.csg").read_text()))
        try:
            assert measures.volume == pytest.approx(expected["volume"], rel=1e-4)
            assert measures.area == pytest.approx(expected["area"], rel=1e-4)
            if expected["closed_2manifold"] and expected["total_genus"] is not None:
                assert measures.components == expected["components_by_vertex"]
                assert measures.genus == expected["total_genus"]
        except AssertionError as error:
            wrong[name] = str(error)
    assert not wrong


def test_the_reader_reads_what_it_should():
    """The reader itself, without the corpus."""
    text = """
    difference() {
      multmatrix([[1, 0, 0, 5], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) { cube(size = [4, 4, 4], center = true); }
      cylinder($fn = 4, $fa = 12, $fs = 2, h = 10, r1 = 1, r2 = 1, center = true);
    }
    """
    node = read_csg(text)
    assert measured(node).volume == pytest.approx(64)
    assert node == box(4, centred=True).transformed([[1, 0, 0, 5], [0, 1, 0, 0], [0, 0, 1, 0]]) - node.children[1]
