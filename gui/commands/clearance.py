"""The window's commands on clearances between solids. They take the MainWindow."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...model.editing.commands import Command

if TYPE_CHECKING:
    from ..window import MainWindow


def _toggle(window: MainWindow) -> None:
    """Bring the panel to the front; hide it where it is there already."""
    if window.clearance.in_front:
        window.docks["Clearance"].hide()
    else:
        window.show_clearance()


def _two(window: MainWindow) -> tuple[str, str] | None:
    solids = {root.id for root in window.session.document.solids}
    chosen = [node_id for node_id in window.session.selection if node_id in solids]
    return (chosen[0], chosen[1]) if len(chosen) == 2 == len(window.session.selection) else None


def _not_two(window: MainWindow) -> str | None:
    return None if _two(window) else "select two solids that stand by themselves"


def _meant(window: MainWindow) -> bool:
    pair = _two(window)
    rule = None if pair is None else window.session.document.checks.pair(*pair)
    return rule is not None and rule.touching


def _touch(window: MainWindow) -> None:
    pair = _two(window)
    assert pair is not None
    window.session.do("check_pair", *pair, touching=not _meant(window), label="Meant to touch")


CLEARANCE_COMMANDS: tuple[Command, ...] = (
    Command("clearance", "Clearance between solids", "Tools", _toggle, shortcut="Ctrl+Alt+K", icon="clearance",
            tip="Pairs that overlap or come too near: listed, shown with their gap or overlap, kept up to date",
            checked=lambda w: w.clearance.in_front),
    Command("meant_to_touch", "Meant to touch", "Tools", _touch, _not_two, icon="meant_to_touch",
            tip="Of the two selected solids a gap is a fault then, and contact is none", checked=_meant),
    Command("clearance_report", "Clearance report …", "Tools", lambda w: w.clearance.save_report(),
            lambda w: None if len(w.session.document.solids) > 1 else "a check takes two solids", icon="export",
            tip="Write all pairs that are not as asked as a page to print, with pictures"),
)  # fmt: skip
