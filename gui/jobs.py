"""The window's side of the second worker: what takes its time and must not delay a drag, such as writing a file."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Qt, Signal

from ..model.document.document import Document, Section

if TYPE_CHECKING:
    from ..model.drafting.plan import Plan
    from ..model.solid.display import DisplayMesh
    from ..model.worker.lane import Lane
    from ..model.worker.messages import LaneMessage

SORTING = "Sorting faces"


class Jobs(QObject):
    """A lane that is started when it is first needed.

    `began` when somebody waits for something new, `rested` whenever a job has come to its end.
    """

    began = Signal()
    rested = Signal()
    progress = Signal(int, int, str)
    notice = Signal(str)
    exported = Signal(str, str)
    """Path, and "" or why nothing was written."""
    partitioned = Signal(object, float)
    """The Tree that `partition` was asked for last, and how many seconds it took; None where it was given up."""
    drawn = Signal(object, tuple, str)
    """The Page that `draw` was asked for last, and the messages about its nodes; or None, and why there is none."""
    drawing_progress = Signal(int, int, str)
    faults_found = Signal(object, str)
    """A NodeFaults (model/checking/document_faults.py) for each node that `find_faults` was asked for last; or None,
    and why there are none."""
    faults_progress = Signal(int, int, str)
    played = Signal(object, str)
    """The Played (model/proximity/moving/playing.py) that `play` was asked for last; or None, and why there is none."""
    playing_progress = Signal(int, int, str)
    pairs_checked = Signal(object, str)
    """The Report (model/proximity/findings.py) that `check_pairs` was asked for last; or None, and why there is not."""
    pairs_progress = Signal(int, int, str)
    _told = Signal(object)

    def __init__(self, make_lane: Callable[[Callable[[LaneMessage], None]], Lane], parent: QObject) -> None:
        super().__init__(parent)
        self._make_lane = make_lane
        # The lane calls from a thread of its own: only a queued signal crosses over.
        self._told.connect(self._receive, Qt.ConnectionType.QueuedConnection)
        self._closed = False
        self._exports: set[int] = set()
        self._partition: int | None = None
        self._ahead = False  # nobody waits for the partition
        self._drawing: int | None = None
        self._finding: int | None = None
        self._playing: int | None = None
        self._pairs: int | None = None
        self.lane: Lane | None = None

    @property
    def exporting(self) -> bool:
        return bool(self._exports)

    @property
    def partitioning(self) -> bool:
        return self._partition is not None

    @property
    def at_work(self) -> bool:
        return self.exporting or self.partitioning

    @property
    def label(self) -> str:
        """What is going on, where the lane has not told yet."""
        return SORTING if self.partitioning and not (self.exporting or self._ahead) else ""

    def export(
        self,
        document: Document,
        path: str | Path,
        tolerance: float | None = None,
        solid: str | None = None,
        section: Section | None = None,
    ) -> None:
        """Write a mesh file, or of a section its outlines; `exported` tells when that is done."""
        from ..model.solid.tessellation import DEFAULT_TOLERANCE

        self._exports.add(self._started().export(document, path, tolerance or DEFAULT_TOLERANCE, solid, section))
        self.began.emit()

    def partition(self, meshes: tuple[DisplayMesh, ...], ahead: bool = False) -> None:
        """Sort the triangles of these meshes into a BSP tree, instead of those asked for before; none: no longer.

        `ahead`: nobody waits for it.
        """
        if meshes:
            self._partition, self._ahead = self._started().partition(meshes), ahead
            if not ahead:
                self.began.emit()
        elif self._partition is not None and self.lane is not None:
            self._partition = None
            self.lane.partition(())
            self.rested.emit()

    def draw(self, document: Document, plan: Plan, tolerance: float | None, solid: str | None = None) -> None:
        """Draw a page, instead of the one asked for before; `drawn` brings it."""
        self._drawing = self._started().draw(document, plan, tolerance, solid)

    def stop_drawing(self) -> None:
        if self._drawing is not None and self.lane is not None:
            self._drawing = None
            self.lane.stop_drawing()

    def export_drawing(
        self, document: Document, plan: Plan, path: str | Path, tolerance: float | None, solid: str | None = None
    ) -> None:
        """Write a page as SVG, PDF or DXF; `exported` tells when that is done."""
        self._exports.add(self._started().draw(document, plan, tolerance, solid, path))
        self.began.emit()

    def find_faults(self, document: Document, ids: tuple[str, ...] = (), tolerance: float = 0.001) -> None:
        """Look for the faults of nodes, none: of all that is visible, instead of those asked for before; `faults_found`
        brings them."""
        self._finding = self._started().find_faults(document, tuple(ids), tolerance)

    def stop_finding(self) -> None:
        """Give up looking for faults; `faults_found` does not come."""
        if self._finding is not None and self.lane is not None:
            self._finding = None
            self.lane.stop_finding()

    def play(self, document: Document, motion: str, tolerance: float, between: bool = False) -> None:
        """Look at a motion step by step, instead of the one asked for before; `played` brings it."""
        self._playing = self._started().play(document, motion, tolerance, between)

    def stop_playing(self) -> None:
        """Give up looking at a motion; `played` does not come."""
        if self._playing is not None and self.lane is not None:
            self._playing = None
            self.lane.stop_playing()

    @property
    def playing(self) -> bool:
        return self._playing is not None

    @property
    def finding(self) -> bool:
        return self._finding is not None

    def check_pairs(self, document: Document, tolerance: float) -> None:
        """Look for pairs of visible solids that are not as the document asks, instead of those asked for before;
        `pairs_checked` brings them. Solids are evaluated within `tolerance` mm."""
        self._pairs = self._started().check_pairs(document, tolerance)

    def stop_checking_pairs(self) -> None:
        """Give up checking pairs; `pairs_checked` does not come."""
        if self._pairs is not None and self.lane is not None:
            self._pairs = None
            self.lane.stop_checking_pairs()

    @property
    def checking_pairs(self) -> bool:
        return self._pairs is not None

    def cancel(self) -> None:
        """Give up all of it."""
        waited_for = self._drawing is not None or self.finding or self.checking_pairs or self.playing
        if self.lane is not None and (self.at_work or waited_for):
            self.lane.cancel()
        if self._drawing is not None:
            self._end_drawing("it was cancelled")
        if self._finding is not None:
            self._end_finding(None, "it was cancelled")
        if self._playing is not None:
            self._end_playing(None, "it was cancelled")
        if self._pairs is not None:
            self._end_pairs(None, "it was cancelled")
        if self._exports:
            self._exports.clear()
            self.notice.emit("The export was cancelled; no file was written")
        if self.partitioning:
            self._partition = None
            if not self._ahead:
                self.notice.emit("Sorting was cancelled: the picture is drawn with the z-buffer")
            self.partitioned.emit(None, 0.0)

    def close(self) -> None:
        self._closed = True
        if self.lane is not None:
            self.lane.close()

    def _started(self) -> Lane:
        if self.lane is None:
            self.lane = self._make_lane(self._told.emit)
            self.lane.start()
        return self.lane

    def _receive(self, message: LaneMessage) -> None:
        from ..model.worker.messages import (
            Died,
            Drawn,
            Exported,
            FaultsFound,
            MotionPlayed,
            PairsChecked,
            Partitioned,
            Progress,
        )

        if self._closed:
            return
        match message:
            case Exported(request, path, fault) if request in self._exports:
                self._exports.discard(request)
                self.rested.emit()
                self.exported.emit(path, fault or "")
            case Partitioned(request, tree, seconds, fault) if request == self._partition:
                self._sorted(tree, seconds, fault)
            case Drawn(request, page, messages, fault) if request == self._drawing:
                self._drawing = None
                self.drawn.emit(page, messages, fault or "")
            case FaultsFound(request, found, fault) if request == self._finding:
                self._end_finding(found, fault or "")
            case MotionPlayed(request, played, fault) if request == self._playing:
                self._end_playing(played, fault or "")
            case PairsChecked(request, report, fault) if request == self._pairs:
                self._end_pairs(report, fault or "")
            case Progress(request, done, total, label):
                if request == self._drawing:
                    self.drawing_progress.emit(done, total, label)
                elif request == self._finding:
                    self.faults_progress.emit(done, total, label)
                elif request == self._playing:
                    self.playing_progress.emit(done, total, label)
                elif request == self._pairs:
                    self.pairs_progress.emit(done, total, label)
                elif request in self._exports:
                    self.progress.emit(done, total, f"Exporting {label}")
                elif request == self._partition and not self._exports:
                    self.progress.emit(done, total, label)
            case Died(request, reason, given_up) if given_up and request in self._exports:
                self._exports.discard(request)
                self.rested.emit()
                self.exported.emit("", reason)
            case Died(request, reason, given_up) if given_up and request is not None and request == self._partition:
                self._sorted(None, 0.0, f"{reason}, twice")
            case Died(request, reason, given_up) if given_up and request is not None and request == self._drawing:
                self._end_drawing(f"{reason}, twice")
            case Died(request, reason, given_up) if given_up and request is not None and request == self._finding:
                self._end_finding(None, f"{reason}, twice")
            case Died(request, reason, given_up) if given_up and request is not None and request == self._pairs:
                self._end_pairs(None, f"{reason}, twice")

            case Died(request, reason, given_up) if given_up and request is not None and request == self._playing:
                self._end_playing(None, f"{reason}, twice")

    def _end_playing(self, played: object, why: str) -> None:
        self._playing = None
        self.played.emit(played, why)

    def _end_finding(self, found: object, why: str) -> None:
        self._finding = None
        self.faults_found.emit(found, why)

    def _end_pairs(self, report: object, why: str) -> None:
        self._pairs = None
        self.pairs_checked.emit(report, why)

    def _end_drawing(self, why: str) -> None:
        self._drawing = None
        self.drawn.emit(None, (), why)

    def _sorted(self, tree: object, seconds: float, fault: str | None) -> None:
        self._partition = None
        self.rested.emit()
        if fault and not self._ahead:
            self.notice.emit(f"The faces were not sorted: {fault}")
        self.partitioned.emit(tree, seconds)
