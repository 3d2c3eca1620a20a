"""Words for how two solids stand to each other, and for solids of which less is known."""

from __future__ import annotations

from .bodies import APART, INSIDE, TOUCHING, Relation
from .findings import EMPTY, NEAR, OPEN, OVERLAP, PARTED, SAME, Finding, Remark, Report, meets_only, nesting


def length_text(length: float) -> str:
    """Millimetres with four figures."""
    return f"{length:.4g} mm"


def volume_text(volume: float) -> str:
    """Cubic millimetres with four figures, large ones in full."""
    return f"{volume:,.0f} mm³" if volume >= 1000.0 else f"{volume:.4g} mm³"


def relation_words(names: tuple[str, str], relation: Relation, shares: tuple[float, float] = (0.0, 0.0)) -> str:
    """How the first of two bodies stands to the second, as a sentence; `shares` see `shares_of`."""
    both = f"“{names[0]}” and “{names[1]}”"
    if relation.kind == APART:
        return f"{both} are {length_text(relation.gap)} apart."
    if meets_only(relation.kind, relation.overlap):
        return f"{both} meet; whether they overlap cannot be told, since one is not closed."
    if relation.kind == TOUCHING:
        return f"{both} touch, and share no volume."
    assert relation.overlap is not None
    return _overlap_words(names, relation.kind, relation.overlap, shares)


def _overlap_words(names: tuple[str, str], kind: str, overlap: float, shares: tuple[float, float]) -> str:
    one, other = names
    volume = volume_text(overlap)
    found = nesting(kind, shares)
    if found == SAME:
        return f"“{one}” and “{other}” are the same body in the same place: {volume}."
    if found:
        inner, outer = (one, other) if found == INSIDE else (other, one)
        return f"“{inner}” lies inside “{outer}”, all of its {volume}."
    return f"“{one}” and “{other}” overlap by {volume}."


def finding_words(finding: Finding) -> str:
    """What is wrong with a pair, as a sentence."""
    one, other = finding.names
    if finding.fault == OVERLAP:
        assert finding.overlap is not None and finding.shares is not None
        return _overlap_words(finding.names, finding.kind, finding.overlap, finding.shares)
    if finding.fault == NEAR:
        asked = f"{length_text(finding.asked)} is asked"
        if finding.kind != TOUCHING:
            return f"“{one}” and “{other}” are {length_text(finding.gap)} apart; {asked}."
        if meets_only(finding.kind, finding.overlap):
            return f"“{one}” and “{other}” meet, and may overlap, since one is not closed; {asked}."
        return f"“{one}” and “{other}” touch; {asked}."
    return f"“{one}” and “{other}” are meant to touch, and are {length_text(finding.gap)} apart."


def remark_words(remark: Remark) -> str:
    """What is not known of a solid and why, as a sentence."""
    if remark.kind == EMPTY:
        return f"“{remark.name}” is empty: there is nothing of it to check."
    if remark.kind == OPEN:
        meets = f" It meets {_listed(remark.meets)}." if remark.meets else ""
        return f"“{remark.name}” is not closed: gaps to it are found, overlaps only once its holes are filled.{meets}"
    return f"“{remark.name}” is not checked, since it failed: {remark.message.removesuffix('.')}."


def report_words(report: Report) -> str:
    """What a check came to, as a sentence."""
    if report.solids < 2:
        return "A check takes two visible solids, and there is " + ("one." if report.solids else "none.")
    asked = f"a clearance of {length_text(report.clearance)}" if report.clearance else "no overlaps"
    looked = f"{report.pairs:,} pairs of {report.solids:,} solids" if report.pairs > 1 else "1 pair of solids"
    overlaps, near, parted = (report.faults.get(fault, 0) for fault in (OVERLAP, NEAR, PARTED))
    counted = [
        words
        for count, words in (
            (overlaps, f"{overlaps:,} overlap{'s' if overlaps == 1 else ''}"),
            (near, f"{near:,} {'is' if near == 1 else 'are'} too near"),
            (parted, f"{parted:,} should touch and {'does' if parted == 1 else 'do'} not"),
        )
        if count
    ]
    worst = f" Here are the worst {len(report.findings):,}." if report.left_out else ""
    return f"{looked}, {asked} asked: {', '.join(counted) if counted else 'all in order'}.{worst}"


def _listed(names: tuple[str, ...], most: int = 4) -> str:
    told = [f"“{name}”" for name in names[:most]]
    if len(names) > most:
        told.append(f"{len(names) - most} more")
    return told[0] if len(told) == 1 else f"{', '.join(told[:-1])} and {told[-1]}"
