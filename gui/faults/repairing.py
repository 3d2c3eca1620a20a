"""Repairs as steps of the history: done in the background, told afterwards with counts before and after."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject, Signal

from ...model.document.document import Document
from ...model.document.errors import Refusal
from ...model.editing import echo
from ...model.operations.operations import OPERATIONS
from ..panels.property_edit import sentence
from ..status import figure

if TYPE_CHECKING:
    from ...model.mesh.faults.repair import Repaired
    from ..window import MainWindow


@dataclass(frozen=True, slots=True)
class Mended:
    """What a repair did to one solid or outline: `counts` are rows (label, before, now, whether that is worse)."""

    name: str
    words: tuple[str, ...]
    worse: tuple[str, ...]
    counts: tuple[tuple[str, str, str, bool], ...]


@dataclass(frozen=True, slots=True)
class Asked:
    """A repair that is wanted: of what, by its root's id; `flat` for an outline, `convert` for what is no mesh yet."""

    node_id: str
    name: str
    flat: bool = False
    convert: bool = False


@dataclass(frozen=True, slots=True)
class _Result:
    document: Document
    lines: tuple[str, ...]
    mended: tuple[Mended, ...]


class Repairing(QObject):
    """`done` carries what was mended (a tuple of Mended), `refused` why nothing was; `working` words, "" at the end."""

    done = Signal(tuple)
    refused = Signal(str)
    working = Signal(str, int, int)
    _told = Signal(str, int)

    def __init__(self, window: MainWindow, parent: QObject) -> None:
        super().__init__(parent)
        self._window = window
        self._stopped: list[bool] = []
        self._told.connect(self._tell)

    @property
    def at_work(self) -> bool:
        return bool(self._stopped)

    def start(
        self, asked: Sequence[Asked], repairs: tuple[str, ...], tolerance: float, longest: float | None = None
    ) -> None:
        """Repair all of these in one step of the history."""
        if self.at_work or not asked:
            return
        session = self._window.session
        session.cancel()
        before = session.document
        stopped = [False]
        self._stopped = stopped

        def told(label: str, share: float) -> None:
            if stopped[0]:
                raise Refusal("it was cancelled; nothing is changed")
            self._told.emit(label, round(100 * share))

        def end() -> None:
            self._stopped = []
            self.working.emit("", 0, 0)

        def finish(result: _Result) -> None:
            end()
            if stopped[0]:
                return
            if session.document is not before:
                self.refused.emit("Not repaired: the document was changed meanwhile. Repair again")
                return
            if result.document is not before:
                names = "s" if len(asked) > 1 else f" {asked[0].name}"
                session.commit(f"Repair{names}", result.document, line="\n".join(result.lines))
            self.done.emit(result.mended)

        def refuse(refusal: Refusal) -> None:
            end()
            self.refused.emit(f"Not repaired: {refusal}")

        self.working.emit("Repairing", 0, 0)
        self._window.files.background.run(
            "Repairing", lambda: _repair(before, asked, repairs, tolerance, longest, told), finish, refuse
        )

    def cancel(self) -> None:
        if self._stopped:
            self._stopped[0] = True
            self.working.emit("Giving up", 0, 0)

    def _tell(self, label: str, done: int) -> None:
        if self.at_work and not self._stopped[0]:
            self.working.emit(sentence(label), done, 100)


def _repair(
    document: Document,
    asked: Sequence[Asked],
    repairs: tuple[str, ...],
    tolerance: float,
    longest: float | None,
    told: Callable[[str, float], None],
) -> _Result:
    """Repair one after the other; the lines do it again. Raises Refusal."""
    from ...model.operations.meshes.mending import repair_of

    lines: list[str] = []
    mended: list[Mended] = []

    def do(name: str, *arguments: Any, **keywords: Any) -> None:
        nonlocal document
        before, document = document, OPERATIONS[name](document, *arguments, **keywords)
        if document is not before:
            lines.append(echo.step(before, document, name, *arguments, **keywords))

    for number, one in enumerate(asked):

        def part(label: str, share: float, number: int = number) -> None:
            told(label, (number + share) / len(asked))

        keywords = {} if longest is None else {"longest": longest}
        if one.convert:
            part(f"making a mesh of {one.name}", 0.0)
            do("convert_to_mesh", one.node_id)
        result = repair_of(document, one.node_id, repairs, tolerance, longest, part)
        do("repair_mesh", one.node_id, list(repairs), tolerance, **keywords)
        words = ("made a mesh", *result.words) if one.convert else result.words
        mended.append(Mended(one.name, words, result.worse, counts_of(result)))
    return _Result(document, tuple(lines), tuple(mended))


def counts_of(result: Repaired) -> tuple[tuple[str, str, str, bool], ...]:
    """The counts of faults that there were before or are now, and the volume: (label, before, now, whether worse)."""
    from ...model.mesh.faults.repair import NAMES
    from ...model.mesh.faults.report import FAULTS

    before, after = result.before, result.after
    found = []
    for name in FAULTS:
        one, two = int(getattr(before, name)), int(getattr(after, name))
        if one or two:
            found.append((sentence(NAMES[name]), f"{one:,}", f"{two:,}", two > one))
    one, two = (None if faults.volume is None else f"{figure(faults.volume)} mm³" for faults in (before, after))
    return (*found, ("Volume", one or "not closed", two or "not closed", bool(one and not two)))
