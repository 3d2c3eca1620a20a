"""Finding a text by a few of its letters: what counts more, and which letters were found."""

import pytest

from solidtree.gui.palette.fuzzy import match


def best(pattern, *texts):
    found = ((match(pattern, text), text) for text in texts)
    return max(((one.score, text) for one, text in found if one is not None), default=(0, None))[1]


@pytest.mark.parametrize(
    ("pattern", "wanted", "others"),
    [
        ("un", "Union", ["Ground grid", "Run again"]),
        ("hs", "Half-space", ["Those shapes"]),
        ("sel all", "Select all", ["Fit selection", "Show all"]),
        ("all select", "Select all", ["Select", "Show all"]),
        ("fs", "Fit selection", ["Offset"]),
        ("grid", "Ground grid", ["Go right in detail"]),
    ],
)
def test_what_a_person_means_comes_first(pattern, wanted, others):
    assert best(pattern, *others, wanted) == wanted


@pytest.mark.parametrize(
    ("pattern", "text", "places"),
    [
        ("fs", "Fit selection", (0, 4)),
        ("sel", "Fit selection", (4, 5, 6)),
        ("SEL fit", "Fit selection", (0, 1, 2, 4, 5, 6)),
        ("aa", "banana", (1, 3)),
        ("", "Box", ()),
    ],
)
def test_the_letters_found_are_told(pattern, text, places):
    assert match(pattern, text).places == places


@pytest.mark.parametrize(
    ("pattern", "text"), [("xq", "Box"), ("xb", "Box"), ("boxx", "Box"), ("box y", "Box"), ("a", "")]
)
def test_what_does_not_stand_there_is_not_found(pattern, text):
    assert match(pattern, text) is None


def test_a_letter_that_is_two_when_small_moves_no_place():
    assert match("tan", "İstan").places == (2, 3, 4)
