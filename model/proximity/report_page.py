"""The report of a check as one HTML page, which needs nothing beside it, and prints on A4."""

from __future__ import annotations

import base64
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape

from ..document.document import Document
from .boxes import Floats
from .findings import NEAR, OVERLAP, Finding, Report
from .words import finding_words, length_text, remark_words, report_words, volume_text

ONE, OTHER, SHARED = "#3f7fbf", "#c98a1b", "#d0342c"
"""The colours of a pair in its pictures, and of what they share."""
TITLES = {OVERLAP: "Overlap", NEAR: "Too near"}

STYLE = """
@page { size: A4; margin: 16mm 15mm; }
* { box-sizing: border-box; }
body { font: 10.5pt/1.45 "Helvetica Neue", Helvetica, Arial, sans-serif; color: #1d242d; background: #fff;
  max-width: 180mm; margin: 10mm auto; padding: 0 4mm; }
h1 { font-size: 17pt; font-weight: 600; margin: 0 0 1mm; }
h2 { font-size: 12pt; font-weight: 600; margin: 8mm 0 2mm; break-after: avoid; }
p { margin: 0 0 2mm; }
.about { color: #5b6673; }
.verdict { font-size: 12pt; margin: 5mm 0; padding: 3mm 4mm; border-left: 1.2mm solid #2f8f4e; background: #f1f7f3; }
.verdict.wrong { border-color: #d0342c; background: #fcf2f1; }
table { border-collapse: collapse; width: 100%; }
th, td { text-align: left; vertical-align: top; padding: 1.2mm 3mm 1.2mm 0; border-bottom: 0.2mm solid #d8dee5; }
th { color: #5b6673; font-weight: 500; }
.number { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
article { break-inside: avoid; border-top: 0.3mm solid #b9c3ce; margin: 6mm 0 0; padding: 3mm 0 0; }
article h3 { font-size: 11pt; font-weight: 600; margin: 0 0 1mm; }
.dot { display: inline-block; width: 2.6mm; height: 2.6mm; border-radius: 50%; margin-right: 1mm; }
.pictures { display: flex; gap: 4mm; margin: 2mm 0 0; }
figure { margin: 0; flex: 0 1 calc(50% - 2mm); min-width: 0; }
svg { display: block; width: 100%; height: auto; border: 0.2mm solid #d8dee5; }
figcaption { color: #5b6673; font-size: 9pt; margin-top: 0.8mm; }
@media print { body { margin: 0; padding: 0; max-width: none; }
  * { print-color-adjust: exact; -webkit-print-color-adjust: exact; } }
"""


@dataclass(frozen=True, slots=True, eq=False)
class Figure:
    """A picture of a finding as the bytes of a PNG of `size` pixels; `line` (2, 2) are the ends of its gap there."""

    png: bytes
    size: tuple[int, int]
    caption: str
    line: Floats | None = None


def page_of(
    report: Report,
    document: Document,
    title: str,
    tolerance: float,
    date: str,
    figures: Mapping[int, Sequence[Figure]],
) -> str:
    """The page as HTML; `figures` are those of a finding by its number in the report, for as many as have some."""
    head = (
        f"<h1>Clearance of {escape(title)}</h1>"
        f'<p class="about">{escape(date)} · curved surfaces within {length_text(tolerance)} </p>'
        f'<p class="verdict{"" if report.in_order else " wrong"}">{escape(report_words(report))}</p>'
    )
    parts = [head, _table(report), _asked(document)]
    if report.remarks:
        parts.append("<h2>Not known</h2>" + "".join(f"<p>{escape(remark_words(one))}</p>" for one in report.remarks))
    if figures:
        worst = f" of the worst {len(figures)}" if len(figures) < len(report.findings) else ""
        parts.append(f"<h2>Pictures{worst}</h2>")
    parts += [_article(number, report.findings[number], figures[number]) for number in sorted(figures)]
    body = "\n".join(part for part in parts if part)
    return (
        f'<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f'<meta name="viewport" content="width=device-width">\n<title>Clearance of {escape(title)}</title>\n'
        f"<style>{STYLE}</style>\n</head>\n<body>\n{body}\n</body>\n</html>\n"
    )


def _table(report: Report) -> str:
    if report.in_order:
        return ""
    rows = []
    for number, finding in enumerate(report.findings, 1):
        asked = "to touch" if finding.touching else length_text(finding.asked)
        rows.append(
            f'<tr><td class="number">{number}</td><td>{escape(finding.names[0])}</td>'
            f"<td>{escape(finding.names[1])}</td>"
            f'<td>{TITLES.get(finding.fault, "Apart")}</td><td class="number">{_measure(finding)}</td>'
            f'<td class="number">{asked}</td><td class="number">{_point(finding.bounds.mean(axis=0), 4)}</td></tr>'
        )
    head = '<th class="number">No.</th><th>Solid</th><th>and</th><th>Fault</th>'
    head += "".join(f'<th class="number">{title}</th>' for title in ("Gap or volume", "Asked", "About"))
    body = "\n".join(rows)
    return (
        f"<h2>Findings, the worst first</h2>\n<table><thead><tr>{head}</tr></thead>\n<tbody>\n{body}\n</tbody></table>"
    )


def _measure(finding: Finding) -> str:
    if finding.fault == OVERLAP and finding.overlap is not None:
        return volume_text(finding.overlap)
    return length_text(finding.gap)


def _asked(document: Document) -> str:
    """The pairs that something of their own is asked of."""
    names = {root.id: root.name for root in document.solids}
    rows = [
        f"<tr><td>{escape(names[pair.one])}</td><td>{escape(names[pair.other])}</td><td>"
        + ("meant to touch" if pair.clearance is None else f"at least {length_text(pair.clearance)}")
        + "</td></tr>"
        for pair in document.checks.pairs
        if pair.one in names and pair.other in names
    ]
    if not rows:
        return ""
    return (
        "<h2>Asked of pairs by themselves</h2>\n<table><thead><tr><th>Solid</th><th>and</th><th>Asked</th></tr></thead>"
        "\n<tbody>\n" + "\n".join(rows) + "\n</tbody></table>"
    )


def _article(number: int, finding: Finding, figures: Sequence[Figure]) -> str:
    one, other = (escape(name) for name in finding.names)
    keys = f'<span class="dot" style="background:{ONE}"></span>{one} &nbsp; '
    keys += f'<span class="dot" style="background:{OTHER}"></span>{other}'
    if finding.fault == OVERLAP:
        keys += f' &nbsp; <span class="dot" style="background:{SHARED}"></span>what they share'
    place = ""
    if finding.points is not None:
        place = " From " + " to ".join(_point(point) for point in finding.points) + "."
    elif finding.overlap is not None:
        place = f" Between {_point(finding.bounds[0])} and {_point(finding.bounds[1])}."
    return (
        f"<article><h3>{number + 1}. {escape(finding_words(finding))}</h3>\n"
        f'<p class="about">{keys}<br>{place.strip()}</p>\n<div class="pictures">\n'
        + "\n".join(_figure(figure, finding) for figure in figures)
        + "\n</div></article>"
    )


def _figure(figure: Figure, finding: Finding) -> str:
    width, height = figure.size
    data = base64.b64encode(figure.png).decode("ascii")
    marks = ""
    if figure.line is not None:
        (ax, ay), (bx, by) = figure.line
        line = f'x1="{ax:.1f}" y1="{ay:.1f}" x2="{bx:.1f}" y2="{by:.1f}"'
        ends = "".join(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="5" fill="{SHARED}"/>' for x, y in figure.line)
        x, y = (ax + bx) / 2.0, min(ay, by) - 14.0
        anchor = "start" if x < width * 0.25 else "end" if x > width * 0.75 else "middle"
        text = f'<text x="{x:.1f}" y="{max(y, 30.0):.1f}" text-anchor="{anchor}" font-size="24" '
        text += 'font-family="Helvetica, Arial, sans-serif" '
        words = f"{length_text(finding.gap)}</text>"
        label = f'{text}stroke="#fff" stroke-width="6" stroke-linejoin="round">{words}{text}fill="#1d242d">{words}'
        marks = f'<line {line} stroke="#fff" stroke-width="8"/><line {line} stroke="{SHARED}" stroke-width="4"/>'
        marks += ends + label
    return (
        f'<figure><svg viewBox="0 0 {width} {height}" role="img" aria-label="{escape(figure.caption)}">'
        f'<image width="{width}" height="{height}" href="data:image/png;base64,{data}"/>{marks}</svg>'
        f"<figcaption>{escape(figure.caption)}</figcaption></figure>"
    )


def _point(point: Floats, figures: int = 6) -> str:
    return "(" + ", ".join(f"{value:.{figures}g}" for value in (point.round(9) + 0.0).tolist()) + ")"
