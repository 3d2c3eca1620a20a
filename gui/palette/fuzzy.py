"""Finding a text by a few of its letters."""

from __future__ import annotations

from typing import NamedTuple


class Match(NamedTuple):
    """Higher scores are better; `places` are the letters of the text that were found, in rising order."""

    score: float
    places: tuple[int, ...]


def match(pattern: str, text: str) -> Match | None:
    """How the words of `pattern` stand in `text`, each anywhere; None where one of them does not.

    A word that stands there whole counts most, more so at the beginning of a word, and so do the initials of several;
    else its letters must come in order, and count more where they begin words or follow each other.
    """
    within = text.lower()
    if len(within) != len(text):  # a letter that becomes two, such as İ, would move the places
        within = text
    total, places = 0.0, set()
    for word in pattern.lower().split():
        both = [one for one in (_whole(word, within), _letters(word, within)) if one is not None]
        if not both:
            return None
        found = max(both, key=lambda one: one.score)
        total += found.score
        places |= set(found.places)
    return Match(total - 0.1 * len(text), tuple(sorted(places)))


def _whole(word: str, within: str) -> Match | None:
    start = within.find(word)
    if start < 0:
        return None
    best = start
    while start >= 0 and not _begins(within, start):
        start = within.find(word, start + 1)
    best = start if start >= 0 else best
    bonus = 60.0 if best == 0 else 40.0 if start >= 0 else 0.0
    return Match(100.0 + bonus + 2.0 * len(word) - 0.2 * best, tuple(range(best, best + len(word))))


def _letters(word: str, within: str) -> Match | None:
    """The letters in order; each at a word's beginning if the rest can still follow, else the next one there is."""
    last = [0] * len(word)  # the last place at which each letter may stand
    place = len(within)
    for i in range(len(word) - 1, -1, -1):
        place = within.rfind(word[i], 0, place)
        if place < 0:
            return None
        last[i] = place
    places: list[int] = []
    total, place = 0.0, 0
    for letter, limit in zip(word, last, strict=True):
        at = within.find(letter, place, limit + 1)
        if not (places and at == places[-1] + 1):
            start = at
            while start >= 0 and not _begins(within, start):
                start = within.find(letter, start + 1, limit + 1)
            at = start if start >= 0 else at
        total += 10.0 if _begins(within, at) else 6.0 if places and at == places[-1] + 1 else 1.0
        places.append(at)
        place = at + 1
    initials = 100.0 if all(_begins(within, at) for at in places) else 0.0
    return Match(total + initials, tuple(places))


def _begins(within: str, place: int) -> bool:
    return place == 0 or not within[place - 1].isalnum()
