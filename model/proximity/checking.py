"""A document checked against what is asked of its solids: which of them overlap, come too near, or do not touch."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..document.document import Document
from ..mesh.faults.box_pairs import meeting
from ..worker.shown import Message
from .bodies import TOUCHING, Relation
from .checks import Checks
from .findings import NEAR, OVERLAP, PARTED, Finding, Remark, Report, badness, meets_only, shares_of
from .memo import PairMemo, Standing
from .words import finding_words, remark_words

MOST_SHOWN = 200_000
"""Triangles of overlaps that a report carries, those of the worst findings."""


@dataclass(frozen=True, slots=True)
class _Asked:
    """Two places in the list of solids, and what is asked of them."""

    one: int
    other: int
    clearance: float
    touching: bool = False


def check_document(
    document: Document,
    tolerance: float,
    checks: Checks | None = None,
    memo: PairMemo | None = None,
    progress: Callable[[str], None] | None = None,
    told: Callable[[int, int], None] | None = None,
    bodies: bool = False,
    most: int | None = None,
) -> Report:
    """Every pair of visible solids against the document's own checks, or others.

    Solids are evaluated within `tolerance` mm, and what is meant to touch may be so far apart. `progress` hears what is
    evaluated, `told` how many of the pairs whose boxes are near have been looked at; either may raise to stop, and the
    memo keeps what is known by then. With `bodies` the findings carry the surfaces of the overlaps. `most` is how many
    findings are told, the worst; None: all.
    """
    memo, checks = memo or PairMemo(), checks or document.checks
    solids = memo.standing(document, tolerance, progress)
    pairs = _pairs(solids, checks)
    found: list[tuple[str, Relation, _Asked]] = []
    meets: dict[int, list[str]] = {}
    limits = [math.inf if asked.touching else asked.clearance for asked in pairs]
    ends = [(solids[asked.one], solids[asked.other]) for asked in pairs]
    known = memo.relations([(*two, limit) for two, limit in zip(ends, limits, strict=True)], told)
    for asked, (one, other), relation in zip(pairs, ends, known, strict=True):
        if relation is None:
            continue
        if meets_only(relation.kind, relation.overlap):
            for place, beside in ((asked.one, other), (asked.other, one)):
                meets.setdefault(place, []).append(beside.root.name)
        fault = _fault(relation, asked, tolerance)
        if fault:
            found.append((fault, relation, asked))
    found.sort(key=lambda row: badness(row[1].overlap, abs(row[2].clearance - row[1].gap)))  # else as they stand
    worst = [asked for *_, asked in found[:most]]
    findings = [_finding(solids, *row) for row in found[:most]]
    return Report(
        tuple(_with_bodies(findings, worst, solids, memo) if bodies else findings),
        tuple(_remarks(solids, meets)),
        checks.clearance,
        len(solids),
        len(solids) * (len(solids) - 1) // 2,
        len(pairs),
        Counter(fault for fault, *_ in found),
        tuple(message for one in solids for message in one.messages),
    )


def _pairs(solids: Sequence[Standing], checks: Checks) -> list[_Asked]:
    """The pairs that are to be looked at: those whose boxes are near, and those that are meant to touch."""
    some = [place for place, one in enumerate(solids) if not one.body.empty]
    if len(some) < 2:
        return []
    places = {solids[place].root.id: place for place in some}
    boxes = np.array([solids[place].body.bounds for place in some])
    reach = checks.clearance / 2.0 * (1.0 + 1e-9)
    near = [np.sort(np.column_stack(pair), axis=1) for pair in meeting(boxes[:, 0] - reach, boxes[:, 1] + reach)]
    asked = {(some[i], some[j]): (checks.clearance, False) for i, j in np.concatenate(near).tolist()} if near else {}
    for pair in checks.pairs:
        if pair.one in places and pair.other in places:
            ends = places[pair.one], places[pair.other]
            clearance = checks.clearance if pair.clearance is None else pair.clearance
            asked[min(ends), max(ends)] = (0.0 if pair.touching else clearance), pair.touching
    return [_Asked(*ends, *asked[ends]) for ends in sorted(asked)]


def _fault(relation: Relation, asked: _Asked, tolerance: float) -> str:
    if relation.points is None:
        return OVERLAP
    if asked.touching:
        return PARTED if relation.gap > tolerance else ""
    return NEAR if asked.clearance > 0.0 and (relation.kind == TOUCHING or relation.gap < asked.clearance) else ""


def _finding(solids: Sequence[Standing], fault: str, relation: Relation, asked: _Asked) -> Finding:
    one, other, shares = solids[asked.one], solids[asked.other], None
    if fault == OVERLAP:
        bounds = np.array([one.body.bounds, other.body.bounds])
        bounds = np.array([bounds[:, 0].max(axis=0), bounds[:, 1].min(axis=0)])
        assert relation.overlap is not None
        shares = shares_of(one.body, other.body, relation.overlap)
    else:
        assert relation.points is not None
        bounds = np.array([relation.points.min(axis=0), relation.points.max(axis=0)])
    return Finding(
        one.root.id, other.root.id, (one.root.name, other.root.name), fault, relation.kind, relation.gap,
        asked.clearance, asked.touching, relation.points, relation.overlap, shares, bounds,
    )  # fmt: skip


def _with_bodies(
    found: Sequence[Finding], pairs: Sequence[_Asked], solids: Sequence[Standing], memo: PairMemo
) -> list[Finding]:
    """The findings with the surfaces of their overlaps, as long as there is room for them."""
    findings, room = [], MOST_SHOWN
    for finding, asked in zip(found, pairs, strict=True):
        if finding.fault == OVERLAP and room > 0:
            body = memo.overlap(solids[asked.one], solids[asked.other])
            room -= len(body.triangles)
            if room >= 0 and len(body.triangles):
                bounds = np.array([body.vertices.min(axis=0), body.vertices.max(axis=0)])
                finding = replace(finding, body=body, bounds=bounds)
        findings.append(finding)
    return findings


def _remarks(solids: Sequence[Standing], meets: Mapping[int, Sequence[str]]) -> list[Remark]:
    return [one.remark(meets.get(place, ())) for place, one in enumerate(solids) if one.kind]


def checked(
    document: Document,
    clearance: float | None,
    tolerance: float,
    progress: Callable[[str], None] | None = None,
    told: Callable[[int, int], None] | None = None,
) -> tuple[dict[str, Any], tuple[Message, ...]]:
    """What `solidtree check` prints, as plain JSON values, and what evaluation had to say.

    The clearance in mm takes the place of the document's own, where one is given; pairs with one of their own keep it.
    Raises Refusal.
    """
    checks = document.checks if clearance is None else document.checks.with_(clearance=clearance)
    report = check_document(document, tolerance, checks, progress=progress, told=told)
    return table_of(report), report.messages


def table_of(report: Report) -> dict[str, Any]:
    """A report as plain JSON values: `pairs` that overlap or are too near, `parted` those that were meant to touch, the
    nearest first, and `remarks` on solids."""
    rows = sorted(report.findings, key=lambda finding: (finding.gap, *finding.badness))
    return {
        "pairs": [_row(finding) for finding in rows if finding.fault != PARTED],
        "parted": [_row(finding) for finding in rows if finding.fault == PARTED],
        "clearance": report.clearance,
        "remarks": [
            {"solid": remark.name, "kind": remark.kind, "words": remark_words(remark)} for remark in report.remarks
        ],
    }


def _row(finding: Finding) -> dict[str, Any]:
    return {
        "a": finding.names[0],
        "b": finding.names[1],
        "relation": finding.kind,
        "gap": finding.gap,
        "overlap_volume": finding.overlap,
        "points": None if finding.points is None else finding.points.tolist(),
        "asked": None if finding.touching else finding.asked,
        "words": finding_words(finding),
    }
