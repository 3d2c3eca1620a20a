"""What a worker answers, turned into what a lane tells; pictures and surfaces that were sent once are kept here."""

from __future__ import annotations

import time
from collections import OrderedDict
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from .job import Job
from .messages import (
    Drawn,
    Evaluated,
    Examined,
    Exported,
    FaultsFound,
    LaneMessage,
    MotionPlayed,
    PairsChecked,
    Partitioned,
    Progress,
)
from .shown import Message, Part, Pictures, Shown

if TYPE_CHECKING:
    from ..measuring.measure import Measures
    from ..solid.display import DisplayMesh

MOST_SURFACES = 64
"""Nodes by themselves whose surfaces are kept."""


class Answers:
    """`kept` bytes of the last solids' pictures are kept by key, so that going back to them asks nobody."""

    def __init__(self, tell: Callable[[LaneMessage], None], kept: int) -> None:
        self._tell = tell
        self._pictures = Pictures(kept)
        self._surfaces: OrderedDict[bytes, DisplayMesh | None] = OrderedDict()

    def keys(self) -> tuple[set[bytes], set[bytes]]:
        """Of pictures and of surfaces: what the worker need not send again."""
        return self._pictures.keys(), set(self._surfaces)

    def told_from_pictures(self, job: Job) -> bool:
        """Answer an evaluation for which every picture is here; whether it was."""
        start = time.perf_counter()
        if job.word != "evaluate" or not self._pictures.complete(job.document, job.tolerance):
            return False
        self._tell_shown(job, start, 0)
        return True

    def end(self, job: Job, message: tuple[Any, ...]) -> bool:
        """Tell what a message of the worker says of its job; whether the job ends with it."""
        match message:
            case (_, number, *_) if number != job.number:
                return False
            case ("progress", number, done, total, label):
                self._tell(Progress(number, done, total, label))
                return False
            case ("evaluated", _, answers, seconds, evaluations):
                self._pictures.keep(job.document, answers)
                self._tell_shown(job, time.perf_counter() - seconds, evaluations)
            case ("examined", number, answers):
                self._tell(Examined(number, self._parts(answers)))
            case ("exported", number, path):
                self._tell(Exported(number, path, None))
            case ("drawn", number, page, messages):
                self._tell(Drawn(number, page, messages))
            case ("partitioned", number, tree, seconds):
                self._tell(Partitioned(number, tree, seconds))
            case ("faults", number, found):
                self._tell(FaultsFound(number, found))
            case ("played", number, played):
                self._tell(MotionPlayed(number, played))
            case ("pairs", number, report):
                self._tell(PairsChecked(number, report))
            case ("refused", _, reason):
                self.refuse(job, reason)
            case ("superseded" | "prepared", _):
                pass
            case _:
                return False
        return True

    def refuse(self, job: Job, reason: str) -> None:
        """Tell in words why there is no answer."""
        if job.path:
            self._tell(Exported(job.number, job.path, reason))
        elif job.word == "draw":
            self._tell(Drawn(job.number, None, (), reason))
        elif job.word == "partition":
            self._tell(Partitioned(job.number, None, 0.0, reason))
        elif job.word == "faults":
            self._tell(FaultsFound(job.number, None, reason))
        elif job.word == "play":
            self._tell(MotionPlayed(job.number, None, reason))
        elif job.word == "pairs":
            self._tell(PairsChecked(job.number, None, reason))
        elif job.word == "evaluate":
            self._tell(Evaluated(job.number, Shown({}, {}, (Message("", "", reason, True),)), 0.0, 0))

    def _tell_shown(self, job: Job, start: float, evaluations: int) -> None:
        shown = self._pictures.shown(job.document, job.tolerance)
        self._tell(Evaluated(job.number, shown, time.perf_counter() - start, evaluations))

    def _parts(self, answers: list[tuple[str, bytes, DisplayMesh | None, Measures | None]]) -> dict[str, Part]:
        parts = {}
        for node_id, key, mesh, measures in answers:
            self._surfaces.setdefault(key, mesh)
            self._surfaces.move_to_end(key)
            parts[node_id] = Part(key, self._surfaces[key], measures)
        while len(self._surfaces) > max(MOST_SURFACES, len(answers)):
            self._surfaces.popitem(last=False)
        return parts
