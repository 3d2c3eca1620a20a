"""What is wrong with drawings: ends that nearly meet, crossings, repeated lines; and lines welded and cut."""

import json

import numpy as np
import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.mesh.faults.drawings import cut_segments, find_drawing_faults, weld_segments
from solidtree.model.mesh.faults.words import DRAWING_KINDS

SQUARE = np.array([((0, 0), (4, 0)), ((4, 0), (4, 4)), ((4, 4), (0, 4)), ((0, 4), (0, 0))], float)


def counted(segments, tolerance=0.01):
    found = find_drawing_faults(segments, tolerance)
    return {words.count: n for words in DRAWING_KINDS.values() if (n := getattr(found, words.count))}


def test_a_square_has_nothing():
    found = find_drawing_faults(SQUARE, 0.01)
    assert found.sound and found.segments == 4 and str(found) == "4 lines: nothing found" and not found.findings
    assert find_drawing_faults([], 0.01).sound


def test_each_fault_is_found_at_its_place():
    loose = SQUARE.copy()
    loose[3, 1] = 0.003, 0.004
    found = find_drawing_faults(loose, 0.01)
    assert counted(loose) == {"open_ends": 2, "near_ends": 1} and str(found).startswith("4 lines: 1 pair of ends near")
    near = next(one for one in found.findings if one.kind == "near ends")
    assert near.gap == pytest.approx(0.005) and near.place == pytest.approx((0.0015, 0.002))
    assert counted([*SQUARE, ((1, -1), (1, 1))]) == {"open_ends": 2, "crossings": 1}
    beside = find_drawing_faults([*SQUARE, ((2, 0.004), (2, 2))], 0.01)
    assert (beside.near_end_segment, beside.open_ends) == (1, 2)
    assert counted([*SQUARE, SQUARE[1, ::-1]]) == {"duplicates": 1}
    assert counted([*SQUARE[:3], ((0, 4), (0, 0.004)), ((0, 0.004), (0, 0))]) == {"short": 1}


def test_crossings_are_as_many_as_pairs_that_cross():
    rng = np.random.default_rng(3)
    lines = rng.random((60, 2, 2)) * 10
    a, b = lines[:, 0], lines[:, 1]
    side = np.sign(cross(b - a, lines[None, :, 0] - a[:, None]) * cross(b - a, lines[None, :, 1] - a[:, None]))
    crossing = int(np.triu((side < 0) & (side.T < 0), 1).sum())
    assert crossing > 50 and find_drawing_faults(lines, 1e-9).crossings == crossing
    cut, said = cut_segments(lines, 1e-9)
    assert len(cut) == 60 + 2 * crossing and said == f"{crossing} crossings cut"
    assert find_drawing_faults(cut, 1e-9).crossings == 0
    assert np.linalg.norm(cut[:, 1] - cut[:, 0], axis=1).sum() == pytest.approx(np.linalg.norm(b - a, axis=1).sum())


def cross(way, points):
    return way[:, None, 0] * points[..., 1] - way[:, None, 1] * points[..., 0]


def test_ends_are_welded_and_what_is_twice_is_dropped():
    rng = np.random.default_rng(8)
    shaken = SQUARE + rng.uniform(-0.001, 0.001, SQUARE.shape)
    welded, said = weld_segments([*shaken, ((4.0, 0.0), (4.0, 0.001)), SQUARE[0, ::-1]], 0.01)
    assert find_drawing_faults(welded, 0.01).sound and len(welded) == 4
    assert "1 short segment dropped" in said and "1 repeated segment dropped" in said
    assert weld_segments(SQUARE, 0.01)[1] == ""


def test_an_end_beside_a_line_is_joined_to_it():
    cut, said = cut_segments([((0, 0), (4, 0)), ((2, 0.004), (2, 2))], 0.01)
    assert said == "1 end joined to segments beside it" and len(cut) == 3
    assert counted(cut) == {"open_ends": 3}


def test_reports_are_plain_values_and_nonsense_is_refused():
    told = json.loads(json.dumps(find_drawing_faults(SQUARE[:3], 0.01).table()))
    assert told["open_ends"] == 2 and [one["words"] for one in told["findings"]] == ["open end", "open end"]
    for segments, tolerance, words in (
        ([((0, 0), (np.inf, 1))], 0.01, "segment 1"),
        ([((0, 0), (1e300, 1))], 0.01, "too far"),
        (SQUARE, -1, "tolerance"),
    ):
        with pytest.raises(Refusal, match=words):
            find_drawing_faults(segments, tolerance)
