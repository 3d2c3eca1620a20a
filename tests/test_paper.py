"""Pages and scales as people write them."""

import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.drafting.paper import papers, scale_from, scale_words, standard_scales


def test_sizes_are_those_of_the_standards_either_way_round():
    assert [(p.width, p.height, p.words) for p in papers("a3")] == [
        (420, 297, "A3 landscape"),
        (297, 420, "A3 portrait"),
    ]
    assert [(p.width, p.height) for p in papers("A0 portrait")] == [(841, 1189)]
    (letter,) = papers("letter-landscape")
    assert (letter.width, letter.height) == pytest.approx((279.4, 215.9))
    (own,) = papers("300 x 200.5mm")
    assert (own.width, own.height, own.words) == (300, 200.5, "300 × 200.5 mm")


@pytest.mark.parametrize("words", ["", "B9", "A4-sideways", "10x300", "300x99999", "300x", "axb", "-5x100"])
def test_what_is_no_page_is_refused(words):
    with pytest.raises(Refusal):
        papers(words)


def test_scales_are_read_as_they_are_written():
    assert [scale_from(words) for words in ("1:2", "5:1", " 0.5 ", "1:2.5", "FIT")] == [0.5, 5, 0.5, 0.4, None]
    for scale in (0.5, 5.0, 1.0, 0.4, 1 / 5000):
        assert scale_from(scale_words(scale)) == pytest.approx(scale)
    for words in ("", "1:0", "0", "-1:2", "nan", "1:2:3", "inf", "two"):
        with pytest.raises(Refusal, match="is no scale"):
            scale_from(words)


def test_standard_scales_come_from_the_largest_down():
    scales = list(standard_scales())
    assert scales == sorted(scales, reverse=True) and len(set(scales)) == len(scales)
    for scale in (10, 5, 2, 1, 1 / 2, 1 / 5, 1 / 10, 1 / 20, 1 / 50, 1 / 100):
        assert scale in scales
