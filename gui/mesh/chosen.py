"""Which elements of the inspected mesh are chosen: one set of vertices, edges or faces, and the one looked at."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QObject, Signal

from ...model.mesh.selecting import Flags, Kind, converted, flags
from ...model.mesh.winged import END, LEFT_AFTER, LEFT_BEFORE, RIGHT_AFTER, RIGHT_BEFORE, START

if TYPE_CHECKING:
    from ...model.mesh.inspected import InspectedMesh

NOTHING = np.zeros(0, bool)

# A walk's step: the column to go by as the edge is seen, whether the other way round, and which end the next edge has
# to share: its start or its end, as it is seen then, is our start or our end.
STEPS: dict[str, tuple[int, int, int]] = {
    "left_after": (LEFT_AFTER, END, START),
    "left_before": (LEFT_BEFORE, START, END),
    "right_after": (RIGHT_AFTER, START, END),
    "right_before": (RIGHT_BEFORE, END, START),
    "start_turned": (LEFT_BEFORE, START, START),
    "start_back": (RIGHT_AFTER, START, START),
    "end_turned": (RIGHT_BEFORE, END, END),
    "end_back": (LEFT_AFTER, END, END),
}


class Chosen(QObject):
    """A view's state, which no document holds. `changed` tells that anything of it is another one."""

    changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.mesh: InspectedMesh | None = None
        self.kind: Kind = "edge"
        self.members: Flags = NOTHING
        self.current = -1
        """The one that was chosen last, -1 for none; always a member."""
        self.reversed = False
        """Whether a walk sees the current edge from its end to its start: what is left and right of it, then, is left
        and right on the way."""

    @property
    def numbers(self) -> np.ndarray:
        return np.flatnonzero(self.members)

    @property
    def count(self) -> int:
        return int(np.count_nonzero(self.members))

    @property
    def edge(self) -> int:
        """The only edge that is chosen, else -1: its wings are shown."""
        return self.current if self.kind == "edge" and self.current >= 0 and self.count == 1 else -1

    def set_mesh(self, mesh: InspectedMesh | None) -> None:
        """Another mesh, of which nothing is chosen."""
        self.mesh = mesh
        self.clear()

    def size(self, kind: Kind) -> int:
        """How many elements of a kind there are."""
        if self.mesh is None:
            return 0
        return {
            "vertex": len(self.mesh.lists.vertices), "edge": len(self.mesh.winged), "face": self.mesh.lists.face_count,
        }[kind]  # fmt: skip

    def clear(self) -> None:
        self.set(self.kind, flags(self.size(self.kind), ()))

    def set(self, kind: Kind, members: Flags, current: int = -1) -> None:
        """Choose exactly these; without a `current` one the present one stays, or the only one is taken."""
        if current < 0 and kind == self.kind and 0 <= self.current < len(members) and members[self.current]:
            current = self.current
        self.kind, self.members = kind, members
        self.current = current if current >= 0 else int(np.argmax(members)) if np.count_nonzero(members) == 1 else -1
        self.reversed = False
        self.changed.emit()

    def choose(self, kind: Kind, elements: Iterable[int], current: int, way: str = "only") -> None:
        """Choose elements: these `only`, these too (`add`), or the other way round (`toggle`)."""
        picked = flags(self.size(kind), elements)
        old = self.members if kind == self.kind and len(self.members) == len(picked) else np.zeros_like(picked)
        if way == "add":
            picked = picked | old
        elif way == "toggle":
            picked = old & ~picked if current >= 0 and old[current] else old | picked
        if current >= 0 and not picked[current]:
            current = -1
        self.set(kind, picked, current)

    def convert(self, kind: Kind) -> None:
        """To elements of another kind."""
        if self.mesh is not None and kind != self.kind:
            self.set(kind, converted(self.mesh.winged, self.members, self.kind, kind))

    # Walks.

    def next_edge(self, step: str) -> tuple[int, bool]:
        """Where one of STEPS leads from the only edge, and whether it is seen the other way round there; -1 nowhere."""
        if self.mesh is None or self.edge < 0:
            return -1, False
        table, flip = self.mesh.winged.table, int(self.reversed)
        column, here, there = STEPS[step]
        swapped = (column - LEFT_BEFORE + 2) % 4 + LEFT_BEFORE  # before and after on the other side
        onward = int(table[self.edge, swapped if flip else column])
        if onward < 0:
            return -1, False
        joint = table[self.edge, here ^ flip]
        return onward, bool(table[onward, there] != joint)

    def walk(self, step: str) -> bool:
        """Go on to the next edge; whether there is one. What is walked round stays on its side."""
        onward, turned = self.next_edge(step)
        if onward < 0:
            return False
        self.members = flags(self.size("edge"), (onward,))
        self.current, self.reversed = onward, turned
        self.changed.emit()
        return True
