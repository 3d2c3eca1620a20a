"""Memory against time: what representations of the same mesh take, and how long they search for an answer."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QPushButton,
    QSizePolicy,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from ..partition.inks import inks_now

if TYPE_CHECKING:
    from ...model.document.errors import Refusal
    from ...model.mesh.costs import Cost
    from ...model.mesh.inspected import InspectedMesh
    from ..background import Background

WORDS = (
    "Memory against time: what a structure does not hold has to be searched for. Times are of one answer here and now, "
    "the mean of a few hundred; <span style='color:{search}'>coloured</span> ones look at every row, so they grow with "
    "the mesh; the others take as long in any mesh. In Python, small scans of an array are quick too."
)
SHORT = {
    "triangle soup": "Triangle\nsoup",
    "face lists": "Face\nlists",
    "face lists and edge list": "+ edge\nlist",
    "winged edge": "Winged\nedge",
}


class CostsPage(QWidget):
    """Measures a mesh when it is first looked at, in the background."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.table = QTableWidget(self)
        self.table.setAccessibleName("Memory and time of each representation")
        self.table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.table.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
        self.table.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.table.setShowGrid(False)
        self.table.setCornerButtonEnabled(False)
        self.table.verticalHeader().setDefaultSectionSize(40)
        self.words = QLabel(self)
        self.words.setWordWrap(True)
        self.words.setContentsMargins(8, 6, 8, 6)
        self.words.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.again = QPushButton("Measure again", self)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addWidget(self.words)
        layout.addWidget(self.table, 1)
        below = QHBoxLayout()
        below.setContentsMargins(8, 6, 8, 6)
        below.addWidget(self.again, 0, Qt.AlignmentFlag.AlignLeft)
        layout.addLayout(below)
        self._costs: Sequence[Cost] = ()
        self._mesh: InspectedMesh | None = None
        """That the costs are of, or will be."""
        self._measuring = False
        self.show_costs(())

    def measure(self, background: Background, mesh: InspectedMesh | None, again: bool = False) -> None:
        """Show what this mesh costs; measured `again` where that is known."""
        if mesh is None or (mesh is self._mesh and not again):
            return
        self._mesh = mesh
        self.show_costs((), waiting=True)
        if self._measuring:
            return  # what is under way is followed by the latest
        from ...model.mesh.costs import costs

        self._measuring = True

        def done(found: list[Cost]) -> None:
            self._measuring = False
            if self._mesh is mesh:
                self.show_costs(found)
            else:
                latest, self._mesh = self._mesh, None
                self.measure(background, latest)

        def refused(refusal: Refusal) -> None:
            self._measuring = False
            self.words.setText(str(refusal))

        background.run("Measuring the representations", lambda: costs(mesh), done, refused)

    def show_costs(self, costs: Sequence[Cost], waiting: bool = False) -> None:
        """These figures; none of them while they are `waiting` to be measured."""
        from ...model.mesh.costs import QUESTIONS

        self._costs = costs
        self.again.setEnabled(bool(costs))
        self.table.setVisible(bool(costs))
        self.words.setText(
            WORDS.format(search=inks_now().own)
            if costs
            else "It is being measured …"
            if waiting
            else "Nothing to measure."
        )
        self.table.clear()
        self.table.setRowCount(1 + len(QUESTIONS))
        self.table.setColumnCount(len(costs))
        self.table.setVerticalHeaderLabels(
            ["Memory", *(question.capitalize().replace(" ", "\n", 1) for question in QUESTIONS)]
        )
        self.table.setHorizontalHeaderLabels([SHORT[cost.name] for cost in costs])
        for column, cost in enumerate(costs):
            header = self.table.horizontalHeaderItem(column)
            if header is not None:
                header.setToolTip(f"{cost.name.capitalize()}: {cost.holds}")
            self._put(0, column, bytes_words(cost.nbytes), False)
            for row, (seconds, searches) in enumerate(zip(cost.seconds, cost.searches, strict=True), 1):
                self._put(row, column, time_words(seconds), searches)
        header = self.table.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        self.table.verticalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Fixed)

    def retint(self) -> None:
        self.show_costs(self._costs)

    def _put(self, row: int, column: int, text: str, searches: bool) -> None:
        item = QTableWidgetItem(text)
        item.setTextAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        if searches:
            item.setForeground(QColor(inks_now().own))
            item.setToolTip("All rows are looked at")
        self.table.setItem(row, column, item)


def bytes_words(count: int) -> str:
    """A size in memory as people read it."""
    for unit in ("bytes", "kB", "MB"):
        if count < 1000 or unit == "MB":
            return f"{count:,} {unit}" if unit == "bytes" else f"{count:.3g} {unit}"
        count /= 1000  # type: ignore[assignment]
    raise AssertionError(count)


def time_words(seconds: float) -> str:
    """A short time as people read it."""
    if seconds != seconds:
        return "\u2013"
    if seconds < 1e-3:
        return f"{1e6 * seconds:.3g} µs"
    return f"{1e3 * seconds:.3g} ms"
