"""What a check found and what a repair did, in words: a line for each solid, counts before and after, and links."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtWidgets import QFrame, QLabel, QScrollArea, QSizePolicy, QWidget

from ..theme import LIGHT, colours_now
from .checked import is_sound

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ...model.checking.document_faults import NodeFaults
    from .repairing import Mended

SOUND = ("#14703a", "#5fd38d")
"""The colour of what is in order, on light ground and on dark."""
SHORT = 20  # letters of a count's name that stays on one line
MOST = 60  # solids that have a line each


class ReportView(QScrollArea):
    """`linked` carries what a link is about: `undo`, `solid ID` or `convert ID`."""

    linked = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.words = QLabel(self)
        self.words.setTextFormat(Qt.TextFormat.RichText)
        self.words.setWordWrap(True)
        self.words.setContentsMargins(10, 6, 8, 8)
        self.words.setAlignment(Qt.AlignmentFlag.AlignTop | Qt.AlignmentFlag.AlignLeft)
        self.words.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        flags = Qt.TextInteractionFlag
        self.words.setTextInteractionFlags(
            flags.TextSelectableByMouse | flags.LinksAccessibleByMouse | flags.LinksAccessibleByKeyboard
        )
        self.words.setAccessibleName("Report")
        self.words.linkActivated.connect(self.linked)
        self.setWidget(self.words)
        self.setWidgetResizable(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._reports: Sequence[NodeFaults] = ()
        self._mended: Sequence[Mended] = ()
        self._can_undo = False
        self._tolerance = 0.0

    def show_report(
        self, reports: Sequence[NodeFaults], tolerance: float, mended: Sequence[Mended] = (), can_undo: bool = False
    ) -> None:
        """The reports of solids and outlines, below what the last repair did."""
        self._reports, self._tolerance, self._mended, self._can_undo = reports, tolerance, mended, can_undo
        self._write()

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and (self._reports or self._mended):
            self._write()

    def _write(self) -> None:
        parts = [mended_words(one, self._can_undo and one is self._mended[0]) for one in self._mended]
        if parts:
            parts.append("<hr>")
        if self._reports:
            parts.append(summary(self._reports, self._tolerance))
        self.words.setText("".join(parts))


def good_ink() -> str:
    return SOUND[0] if colours_now() is LIGHT else SOUND[1]


def summary(reports: Sequence[NodeFaults], tolerance: float) -> str:
    """As rich text: what was found in which solid; those in which nothing was are told together."""
    dirty = [report for report in reports if not is_sound(report)]
    sound = len(reports) - len(dirty)
    lines = []
    for report in dirty[:MOST]:
        style = f"color:{colours_now().text}; text-decoration:none"
        name = f'<a href="solid {escape(report.id)}" style="{style}"><b>{escape(report.name)}</b></a>'
        lines.append(f"<p>{name}: {escape(str(report))}{_convert(report)}</p>")
    if len(dirty) > MOST:
        lines.append(f"<p>{len(dirty) - MOST:,} more have faults.</p>")
    if sound:
        what = f"Nothing found within {tolerance:g} mm"
        if dirty:
            what = f"Nothing found in {sound:,} other{'s' * (sound != 1)}"
        elif sound == 1:
            what += f" in “{reports[0].name}”"
        else:
            what += f" in {sound:,} solids and outlines"
        lines.append(f'<p style="color:{good_ink()}">✓ {escape(what)}.</p>')
    return "".join(lines)


def _convert(report: NodeFaults) -> str:
    if report.faults is None or report.kind != "solid":
        return ""
    return (
        f'<br><span style="color:{colours_now().muted}">It is made of other nodes: change those, or '
        f'<a href="convert {escape(report.id)}">make a mesh of it and repair that</a>.</span>'
    )


def mended_words(mended: Mended, can_undo: bool = False) -> str:
    """As rich text: what a repair did to a solid, what is worse now, and the counts before and after."""
    colours = colours_now()
    words = ", ".join(mended.words) or "there was nothing that these repairs mend"
    undo = ' <a href="undo">Undo the repair</a>' if can_undo else ""
    text = f"<p><b>{escape(mended.name)}</b>: {escape(words)}.{undo}</p>"
    if mended.worse:
        worse = "; ".join(mended.worse)
        text += f'<p style="color:{colours.error}">Worse now: {escape(worse)}.</p>'
    if not mended.counts:
        return text
    titles = '<td width="60%"></td><td align="right">before</td><td align="right">now</td>'
    head = f'<tr style="color:{colours.muted}">{titles}</tr>'
    rows = ""
    for label, before, after, is_worse in mended.counts:
        name = escape(label).replace(" ", "&nbsp;") if len(label) < SHORT else escape(label)
        ink = colours.error if is_worse else colours.text if after.strip("0") else good_ink()
        rows += (
            f'<tr><td>{name}</td><td align="right" style="padding-left:14px">{escape(before)}</td>'
            f'<td align="right" style="padding-left:14px; color:{ink}">{escape(after)}</td></tr>'
        )
    return f'{text}<table cellspacing="0" cellpadding="1" width="100%">{head}{rows}</table>'
