"""The editing session: the one place that changes. It holds the history, the selection and one signal."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

from ..document.document import Document
from ..document.errors import Refusal
from ..document.tree import walk
from ..operations.operations import OPERATIONS
from . import echo
from .isolating import isolated, isolation_fault

DEPTH = 10_000


@dataclass(frozen=True, slots=True)
class State:
    """What a view shows: the document, the ids of the selected nodes in the order of selection, and those that are
    shown alone (none: all are shown)."""

    document: Document
    selection: tuple[str, ...] = ()
    isolated: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Done:
    """One step of the history: its name, and the states on both of its sides."""

    label: str
    before: State
    after: State


class Session:
    """History, selection and preview of one document.

    `changed` calls every listener with the states before and after; views compare their parts by identity. `log` holds
    the line of Python for each step done so far, undone ones left out.
    """

    def __init__(self, document: Document | None = None, depth: int = DEPTH) -> None:
        if depth < 1:
            raise ValueError(f"a history keeps one step or more, not {depth}")
        self._state = State(document or Document())
        self._depth = depth
        self._past: list[Done] = []
        self._future: list[Done] = []
        self._lines: list[str] = []
        self._undone_lines: list[str] = []
        self._shown: Document | None = None
        self._isolated: tuple[str, ...] = ()
        self._view: tuple[Document, tuple[str, ...], Document] | None = None
        self._saved = self._state.document
        self._listeners: list[Callable[[State, State], None]] = []

    @property
    def state(self) -> State:
        """The committed document, or the previewed one, and the selection."""
        return State(self.document, self._state.selection, self._isolated)

    @property
    def document(self) -> Document:
        return self._state.document if self._shown is None else self._shown

    @property
    def selection(self) -> tuple[str, ...]:
        return self._state.selection

    @property
    def isolated(self) -> tuple[str, ...]:
        """The ids of the nodes that are shown alone; empty where all is shown. Not a part of the history."""
        return self._isolated

    @property
    def view(self) -> Document:
        """What the picture shows: the document, or the isolated nodes of it as solids of their own."""
        document = self.document
        if not self._isolated:
            return document
        if self._view is None or self._view[0] is not document or self._view[1] != self._isolated:
            self._view = (document, self._isolated, isolated(document, self._isolated))
        return self._view[2]

    def isolate(self, ids: Iterable[str]) -> None:
        """Show these nodes alone, or everything again where there are none. Raises Refusal."""
        wanted = _held(self.document, ids)
        if wanted:
            isolated(self.document, wanted)  # may refuse
        if wanted != self._isolated:
            before, self._isolated = self.state, wanted
            self._tell(before)

    @property
    def log(self) -> tuple[str, ...]:
        return tuple(self._lines)

    @property
    def previewing(self) -> bool:
        return self._shown is not None

    @property
    def modified(self) -> bool:
        return self._state.document is not self._saved

    @property
    def saved(self) -> Document:
        """The document as it was opened or last saved."""
        return self._saved

    @property
    def undo_label(self) -> str | None:
        """The name of the step that undo takes back, or None."""
        return self._past[-1].label if self._past else None

    @property
    def redo_label(self) -> str | None:
        return self._future[-1].label if self._future else None

    def on_change(self, listener: Callable[[State, State], None]) -> Callable[[], None]:
        """Call `listener(before, after)` at every change; the result ends that."""
        self._listeners.append(listener)
        return lambda: self._listeners.remove(listener)

    def do(self, name: str, *arguments: Any, label: str | None = None, select: Iterable[str] | None = None,
           **keywords: Any) -> Document:  # fmt: skip
        """Do one operation of operations.py as a step of the history. Raises Refusal and then changes nothing.

        `select` names the nodes selected afterwards; by default those that are new at the top, else what remains.
        """
        if name not in OPERATIONS:
            raise Refusal(f"there is no operation called {name}")
        before = self._state.document
        after = OPERATIONS[name](before, *arguments, **keywords)
        line = echo.step(before, after, name, *arguments, **keywords)
        self.commit(label or name.replace("_", " ").capitalize(), after, select, line)
        return after

    def commit(self, label: str, document: Document | None = None, select: Iterable[str] | None = None,
               line: str = "") -> None:  # fmt: skip
        """Make `document`, or what is previewed, the next step of the history; no step where nothing changed."""
        new = document if document is not None else self.document
        shown = self.state
        self._shown = None
        if new is self._state.document:
            if select is not None:
                self._state = State(new, _held(new, select))
            if shown.document is not new or shown.selection != self._state.selection:
                self._tell(shown)
            return
        chosen = self._after(new) if select is None else _held(new, select)
        done = Done(label, self._state, State(new, chosen))
        self._past.append(done)
        del self._past[: -self._depth]
        self._future.clear()
        self._undone_lines.clear()
        self._lines.append(line or f"# {label}")
        self._state = done.after
        self._tell(shown)

    def _after(self, new: Document) -> tuple[str, ...]:
        """New top nodes where there are any, else the selection as far as it still exists."""
        old = {node.id: node for node in walk(*self._state.document.roots)}
        stack = list(reversed(new.roots))
        fresh: list[str] = []
        while stack:
            node = stack.pop()
            known = old.get(node.id)
            if known is None:
                fresh.append(node.id)
            elif type(known) is type(node):  # what an unlinked instance has become is not new below
                stack += reversed(node.children)
        return tuple(fresh) or _held(new, self._state.selection)

    def preview(self, document: Document) -> None:
        """Show a document without a step in the history, as a drag does on its way."""
        before = self.state
        self._shown = None if document is self._state.document else document
        if self.document is not before.document:
            self._tell(before)

    def cancel(self) -> None:
        """Forget what is previewed."""
        self.preview(self._state.document)

    def undo(self) -> bool:
        """Back to the very document before the last step; false where there is none."""
        self.cancel()
        if not self._past:
            return False
        done = self._past.pop()
        self._future.append(done)
        if self._lines:
            self._undone_lines.append(self._lines.pop())
        return self._go(done.before)

    def redo(self) -> bool:
        self.cancel()
        if not self._future:
            return False
        done = self._future.pop()
        self._past.append(done)
        if self._undone_lines:
            self._lines.append(self._undone_lines.pop())
        return self._go(done.after)

    def _go(self, state: State) -> bool:
        before, self._state = self.state, state
        self._tell(before)
        return True

    def select(self, ids: Iterable[str]) -> None:
        """Select these nodes; ids that the document does not hold are left out."""
        wanted = _held(self.document, ids)
        if wanted == self._state.selection:
            return
        before = self.state
        self._state = State(self._state.document, wanted)
        self._tell(before)

    def open(self, document: Document) -> None:
        """Start over with a document just read or new: no history, nothing selected, nothing unsaved."""
        before = self.state
        self._shown = None
        self._past, self._future, self._lines, self._undone_lines = [], [], [], []
        self._state = State(document)
        self._isolated = ()
        self._saved = document
        self._tell(before)

    def mark_saved(self, document: Document) -> None:
        """The document that is in the file now."""
        self._saved = document
        self._tell(self.state)

    def _tell(self, before: State) -> None:
        if self._isolated and self.document is not before.document:
            held = _held(self.document, self._isolated)
            self._isolated = held if isolation_fault(self.document, held) is None else ()
        after = self.state
        for listener in tuple(self._listeners):
            listener(before, after)


def _held(document: Document, ids: Iterable[str]) -> tuple[str, ...]:
    """The ids without doubles that the document holds."""
    wanted = dict.fromkeys(ids)
    known = {node.id for node in walk(*document.roots)} if wanted else set()
    return tuple(node_id for node_id in wanted if node_id in known)
