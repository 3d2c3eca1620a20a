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
    from ...model.mesh.faults.drawings import DrawingFaults
    from ...model.mesh.faults.report import MeshFaults
    from ..window import MainWindow

Counts = tuple[tuple[str, str, str, bool], ...]
"""Rows (label, before, now, whether that is worse)."""


@dataclass(frozen=True, slots=True)
class Mended:
    """What a repair did to one solid or outline."""

    name: str
    words: tuple[str, ...]
    worse: tuple[str, ...]
    counts: Counts


@dataclass(frozen=True, slots=True)
class Asked:
    """A repair that is wanted: of what, by its id; `flat` for an outline, `convert` for what is no mesh yet; `hole` is
    a vertex of the only border that is to be closed."""

    node_id: str
    name: str
    flat: bool = False
    convert: bool = False
    hole: int | None = None


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
                what = "Close hole of" if asked[0].hole is not None else "Repair"
                session.commit(f"{what}{names}", result.document, line="\n".join(result.lines))
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
    from ...model.checking.document_faults import document_faults
    from ...model.operations.curves.mending import REPAIRS as OF_LINES
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

        if one.flat or one.hole is not None:
            begun = document
            part(f"repairing {one.name}", 0.0)
            try:
                if one.hole is not None:
                    do("close_mesh_holes", one.node_id, [one.hole])
                else:
                    do("repair_outline", one.node_id, [name for name in OF_LINES if name in repairs], tolerance)
            except Refusal as refusal:
                if len(asked) == 1:
                    raise
                mended.append(Mended(one.name, (), (f"not repaired, {refusal}",), ()))
                continue
            before, after = (document_faults(it, tolerance, [one.node_id])[0].faults for it in (begun, document))
            if before is None or after is None:
                continue
            did = "the hole is closed" if one.hole is not None else _lines_words(repairs)
            mended.append(Mended(one.name, (did,) if document is not begun else (), *compared(before, after)))
            continue
        keywords = {} if longest is None else {"longest": longest}
        if one.convert:
            part(f"making a mesh of {one.name}", 0.0)
            do("convert_to_mesh", one.node_id)
        result = repair_of(document, one.node_id, repairs, tolerance, longest, part)
        do("repair_mesh", one.node_id, list(repairs), tolerance, **keywords)
        words = ("made a mesh", *result.words) if one.convert else result.words
        mended.append(Mended(one.name, words, *compared(result.before, result.after)))
    return _Result(document, tuple(lines), tuple(mended))


def _lines_words(repairs: Sequence[str]) -> str:
    joined = "curves joined where their ends met"
    return f"lines cut where they cross, {joined}" if "cut" in repairs else joined


def compared(before: MeshFaults | DrawingFaults, after: MeshFaults | DrawingFaults) -> tuple[tuple[str, ...], Counts]:
    """What is worse in a later report, and the counts of faults that there were before or are now; of meshes the volume
    too."""
    from ...model.mesh.faults.repair import NAMES, worsened
    from ...model.mesh.faults.report import FAULTS, MeshFaults
    from ...model.mesh.faults.words import DRAWING_KINDS

    flat = {words.count: words.several for words in DRAWING_KINDS.values()}
    names = {name: NAMES[name] for name in FAULTS} if isinstance(before, MeshFaults) else flat
    found: list[tuple[str, str, str, bool]] = []
    for name, label in names.items():
        one, two = int(getattr(before, name)), int(getattr(after, name))
        if one or two:
            found.append((sentence(label), f"{one:,}", f"{two:,}", two > one))
    if not (isinstance(before, MeshFaults) and isinstance(after, MeshFaults)):
        return tuple(f"{label}: {one} before, {two} now" for label, one, two, worse in found if worse), tuple(found)
    one, two = (None if faults.volume is None else f"{figure(faults.volume)} mm³" for faults in (before, after))
    found.append(("Volume", one or "not closed", two or "not closed", bool(one and not two)))
    return worsened(before, after), tuple(found)
