"""Checks for faults: asked of the second worker, kept as long as they are of the present document."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer, Signal

from ...model.document.errors import Refusal
from ...model.document.expression import Expression, number
from ...model.document.primitives import ImportedMesh, Polyhedron
from ...model.document.tree import homes, walk
from .checked import worth_telling

if TYPE_CHECKING:
    from ...model.checking.document_faults import NodeFaults
    from ...model.document.document import Document
    from ...model.document.nodes import Node
    from ...model.editing.session import State
    from ..window import MainWindow

REST = 400  # milliseconds without a change before a check is made again by itself
FINEST, COARSEST = 1e-9, 1e6  # mm
TOLERANCE = 0.001  # mm, where the user has chosen no other
MESHES = (ImportedMesh, Polyhedron)


class Checks(QObject):
    """`changed` tells of other `reports`; `working` what is under way and how far, "" for nothing; `dirty` that a file
    came in with faults, in words; `refused` why there is no report."""

    changed = Signal()
    working = Signal(str, int, int)
    dirty = Signal(str)
    refused = Signal(str)

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window)
        self._window = window
        self.reports: tuple[NodeFaults, ...] = ()
        self.tolerance = window.settings.tolerance("faults", TOLERANCE)
        self.checked = False
        """Whether there has been a check since the document was opened."""
        self._watching = False
        self._chosen: tuple[str, ...] = ()
        """The roots that were selected when the check was asked for; none: all that is visible."""
        self._seen: tuple[object, ...] = ()
        """What the reports are of."""
        self._asked: tuple[object, ...] | None = None
        self._arrived: dict[str, None] = {}
        """Nodes that came with a file, and are being looked at."""
        self._file = ""
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.setInterval(REST)
        self._soon.timeout.connect(self._again)
        jobs = window.evaluation.jobs
        jobs.faults_found.connect(self._found)
        jobs.faults_progress.connect(self._progress)

    @property
    def at_work(self) -> bool:
        return self._asked is not None

    @property
    def settled(self) -> bool:
        """Whether the reports are the last word on the present document."""
        return not self.at_work and not self._soon.isActive()

    def check(self) -> None:
        """Look at what is selected, or at all that is visible."""
        document, selection = self._window.session.document, self._window.session.selection
        self._chosen = tuple(homes(document, selection))
        self._ask()

    def set_watching(self, watching: bool) -> None:
        """Whether somebody looks: then the reports follow the document."""
        self._watching = watching
        if watching and (not self.checked or self._outdated):
            self._soon.start(0)

    def set_tolerance(self, tolerance: float) -> None:
        """In mm; what has been checked is checked again."""
        if tolerance != self.tolerance:
            self.tolerance = tolerance
            self._window.settings.set_tolerance("faults", tolerance)
            if self.checked or self._watching:
                self._soon.start()

    def cancel(self) -> None:
        """Give up the check that is under way; the last reports stay."""
        self._soon.stop()
        if self.at_work:
            self._asked = None
            self._arrived.clear()
            self._window.evaluation.jobs.stop_finding()
            self.working.emit("", 0, 0)

    def look_at_arrivals(self, ids: Sequence[str], name: str) -> None:
        """Look at what came with the file `name`; `dirty` follows where it has faults."""
        self._arrived |= dict.fromkeys(ids)
        self._file = name
        self._ask()

    def session_changed(self, before: State, after: State) -> None:
        if before.document is not after.document and self._watching:
            self._soon.start()

    def document_opened(self) -> None:
        self.cancel()
        self._chosen, self._seen, self.checked = (), (), False
        if self.reports:
            self.reports = ()
            self.changed.emit()

    # The work.

    @property
    def _scope(self) -> list[Node]:
        """The roots to look at, as they are in the document now."""
        roots = self._window.session.document.standing
        chosen = [root for root in roots if root.id in self._chosen]
        return chosen or [root for root in roots if root.visible]

    def _of(self, nodes: Sequence[Node]) -> tuple[object, ...]:
        document = self._window.session.document
        looks = tuple((node.id, node.digest, node.name) for node in nodes)
        return looks, document.definitions, document.parameters, self.tolerance

    @property
    def _outdated(self) -> bool:
        return self._seen != self._of(self._scope)

    def _again(self) -> None:
        if self._window.session.previewing:
            self._soon.start()
        elif self._watching and self._outdated:
            self._ask()

    def _ask(self) -> None:
        """Ask for reports on the scope, and on what has arrived."""
        self._soon.stop()
        document: Document = self._window.session.document
        scope = [root for root in document.standing if root.id in self._arrived] or self._scope
        if not scope:
            self.cancel()
            self.reports, self._seen, self.checked = (), self._of(scope), True
            self.changed.emit()
            return
        ids = dict.fromkeys(root.id for root in scope)
        ids |= dict.fromkeys(node.id for root in scope for node in walk(root) if isinstance(node, MESHES))
        self._asked = self._of(scope)
        self._window.evaluation.jobs.find_faults(document, tuple(ids), self.tolerance)
        self.working.emit("Checking", 0, 0)

    def _progress(self, done: int, total: int, label: str) -> None:
        if self.at_work:
            self.working.emit(f"Checking {label}", done, total)

    def _found(self, reports: tuple[NodeFaults, ...] | None, fault: str) -> None:
        if self._asked is None:
            return
        asked, self._asked = self._asked, None
        arrived, self._arrived = self._arrived, {}
        self.working.emit("", 0, 0)
        if reports is None:
            self.refused.emit(f"Not checked: {fault}")
            return
        known = {root.id for root in self._window.session.document.standing}
        if not arrived:
            self.reports, self._seen, self.checked = reports, asked, True
            self.changed.emit()
        elif known.issuperset(arrived):  # else it has been undone
            told = worth_telling(reports)
            if told:
                self._chosen = tuple(arrived)
                self.reports, self._seen, self.checked = reports, asked, True
                self.changed.emit()
                self.dirty.emit(_arrival_words(self._file, told))
        if self._watching:
            self._soon.start()


def _arrival_words(name: str, told: Sequence[NodeFaults]) -> str:
    if len(told) == 1:
        return f"{name} has faults: {str(told[0].faults).partition(': ')[2]}"
    return f"{name}: {len(told):,} of its parts have faults"


def millimetres_from(text: str, what: str) -> float:
    """The length that was typed. Raises Refusal, with `what` it is."""
    typed = number(text, what)
    value = typed.evaluate({}) if isinstance(typed, Expression) else float(typed)
    if not FINEST <= value <= COARSEST:
        raise Refusal(f"{what} lies between {FINEST:g} and {COARSEST:,.0f} mm, not at {value:g}")
    return value
