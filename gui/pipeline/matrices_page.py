"""The four matrices of the pipeline: shown, explained, tried with other numbers, and applied."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QPushButton, QScrollArea, QSizePolicy, QVBoxLayout, QWidget

from ...model.pipeline.explanation import entry_words
from ...model.pipeline.matrices import NAMES, Matrices
from .matrix_grid import MatrixGrid

TITLES = {
    "model": ("Model", "from the node\u2019s own axes to the world"),
    "view": ("View", "from the world to the eye"),
    "projection": ("Projection", "from the eye to clip coordinates"),
    "viewport": ("Viewport", "from the cube to pixels and depth"),
}
APPLIES = {
    "model": "Give the node this placement: one step that can be undone",
    "view": "Move the camera of the picture there",
    "projection": "Give the camera of the picture this angle, and these near and far planes",
}
HINT = "Point at an entry to see what it does. What you type is tried in this panel; Apply makes it so."


class MatricesPage(QWidget):
    """`edited` carries a matrix's name and the whole of it as typed; `reset_asked` and `apply_asked` a name."""

    edited = Signal(str, object)
    refused = Signal(str)
    reset_asked = Signal(str)
    apply_asked = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.grids: dict[str, MatrixGrid] = {}
        self.resets: dict[str, QPushButton] = {}
        self.applies: dict[str, QPushButton] = {}
        self._marks: dict[str, QLabel] = {}
        self._heads: dict[str, QLabel] = {}
        self._matrices: Matrices | None = None
        self._pointed = ("", -1, -1)
        content = QWidget(self)
        column = QVBoxLayout(content)
        column.setContentsMargins(8, 2, 8, 8)
        column.setSpacing(2)
        for name in NAMES:
            column.addLayout(self._head(name, content))
            grid = MatrixGrid(TITLES[name][0], content)
            grid.edited.connect(lambda matrix, name=name: self.edited.emit(name, matrix))
            grid.refused.connect(self.refused)
            grid.pointed.connect(lambda row, place, name=name: self._point(name, row, place))
            self.grids[name] = grid
            column.addWidget(grid)
        column.addStretch(1)
        scroll = QScrollArea(self)
        scroll.setWidget(content)
        scroll.setWidgetResizable(True)
        scroll.setFrameShape(QFrame.Shape.NoFrame)
        scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.words = QLabel(HINT, self)
        self.words.setWordWrap(True)
        self.words.setProperty("muted", True)
        self.words.setContentsMargins(8, 4, 8, 6)
        self.words.setMinimumHeight(3 * self.words.fontMetrics().lineSpacing() + 12)
        self.words.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.words.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addWidget(scroll, 1)
        layout.addWidget(self.words)

    def _head(self, name: str, parent: QWidget) -> QHBoxLayout:
        title, what = TITLES[name]
        label = QLabel(parent)
        label.setToolTip(f"{title}: {what}")
        label.setProperty("muted", True)
        label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        mark = QLabel("changed here", parent)
        mark.setObjectName("changed_here")
        reset = QPushButton("Reset", parent)
        reset.setToolTip(f"The {name} matrix of the picture again")
        reset.clicked.connect(lambda: self.reset_asked.emit(name))
        apply = QPushButton("Apply", parent)
        apply.setToolTip(APPLIES.get(name, ""))
        apply.clicked.connect(lambda: self.apply_asked.emit(name))
        for button, what in ((reset, "Reset"), (apply, "Apply")):
            button.setAccessibleName(f"{what} the {name} matrix")
        line = QHBoxLayout()
        line.setContentsMargins(0, 6, 0, 2)
        line.setSpacing(6)
        line.addWidget(label, 1)
        for widget in (mark, reset, apply):
            widget.hide()
            line.addWidget(widget)
        self._heads[name] = label
        self._marks[name], self.resets[name], self.applies[name] = mark, reset, apply
        return line

    def show_matrices(self, matrices: Matrices, changed: frozenset[str], appliable: frozenset[str]) -> None:
        """Their numbers; those `changed` here can be reset, and applied where they are `appliable`."""
        self._matrices = matrices
        for name, grid in self.grids.items():
            there = name in changed
            grid.show_matrix(
                getattr(matrices, name), there, lambda row, column, name=name: entry_words(name, matrices, row, column)
            )
            self._marks[name].setVisible(there)
            title, what = TITLES[name]
            self._heads[name].setText(f"<b>{title}</b>" + ("" if there else f"&nbsp; {what}"))
            self.resets[name].setVisible(there)
            self.applies[name].setVisible(there and name in appliable)
        self._explain()

    def _point(self, name: str, row: int, column: int) -> None:
        self._pointed = (name, row, column)
        self._explain()

    def _explain(self) -> None:
        name, row, column = self._pointed
        if self._matrices is None or row < 0 or column < 0:
            self.words.setText(HINT)
            return
        place = f"{TITLES[name][0]}, row {row + 1}, column {column + 1}"
        self.words.setText(f"{place}: {entry_words(name, self._matrices, row, column)}.")
