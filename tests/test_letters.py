"""Letters drawn up one by one: the solid is that of the whole outline, and edits make what they touch anew."""

import pytest

from solidtree.model.script import document_of, extrude, lettering, union
from solidtree.model.solid.evaluate import Evaluator
from solidtree.model.solid.outlines.letters import _kept
from solidtree.model.solid.outlines.sections import section_of

LONG = "The quick brown fox jumps over the lazy dog"


def solid(node, tolerance=0.05):
    made = Evaluator().evaluate(node, tolerance).solid
    assert made is not None
    return made


@pytest.mark.parametrize(
    ("text", "more"),
    [
        (LONG, {}),
        ("سلام عليكم والعالم", {}),
        ("TYTYTYTYTY", {"letter_spacing": -2}),
        ("Ὦ ἄνδρες Ἀθηναῖοι", {"font": "GFS Didot", "slant": 14, "weight": 0.2}),
        ("gjpq\ngjpqlk", {"line_spacing": 0.4}),
    ],
)
def test_the_solid_is_that_of_the_whole_outline(text, more):
    letters = lettering(text, 10, **more)
    section, made = section_of(letters, 0.05), solid(extrude(letters, 3, below=1))
    assert made.volume() == pytest.approx(4 * section.area(), rel=1e-7)
    # Euler: each piece of the outline is one body, each of its holes goes through it.
    rings = section.to_polygons()
    pieces = len(section.decompose())
    assert len(made.decompose()) == pieces
    assert sum(part.genus() for part in made.decompose()) == len(rings) - pieces
    low, high = made.bounding_box()[2], made.bounding_box()[5]
    assert (low, high) == (-1, 3)


def test_it_goes_with_its_placement():
    placed = lettering(LONG, 5).turned(z=30).scaled(2, 3).at(4, 5)
    made = solid(extrude(placed, 2, centred=True))
    section = section_of(placed, 0.05)
    assert made.volume() == pytest.approx(2 * section.area(), rel=1e-7)
    assert made.bounding_box()[:2] == pytest.approx(section.bounds()[:2], abs=1e-6)
    assert (made.bounding_box()[2], made.bounding_box()[5]) == (-1, 1)


def test_one_edited_letter_is_drawn_up_alone():
    solid(extrude(lettering(LONG), 2))
    before = _kept.cache_info().misses
    solid(extrude(lettering(LONG.replace("jumps", "dumps")), 2))
    assert _kept.cache_info().misses - before <= 1, "the d is there already; the kerned neighbours may go together"
    solid(extrude(lettering(LONG.replace("lazy", "l@zy")), 2))
    assert 1 <= _kept.cache_info().misses - before <= 3


def test_faces_of_all_letters_are_of_one_node():
    document = document_of(union(extrude(lettering(LONG), 2)))
    from solidtree.model.solid.results import evaluate_document

    evaluation = evaluate_document(document)
    mesh = evaluation.display(evaluation.solids[0])
    assert len(mesh.owners) == 1 and (mesh.owner == 0).all()
