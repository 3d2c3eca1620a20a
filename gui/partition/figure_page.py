"""The page of the textbook's figure: the plane, the tree beside it, and the point p on its way down."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QHBoxLayout, QLabel, QPushButton, QSplitter, QVBoxLayout, QWidget

from ...model.partition.cone import flat_cone, prune
from ...model.partition.descent import below, way_down
from ...model.partition.figure import LINES, back_to_front, figure
from .figure_picture import FigurePicture
from .tree_picture import TreePicture
from .way_table import WayTable


class FigurePage(QWidget):
    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._figure = figure()
        names = self._figure.names
        self.words = QLabel(self)
        self.words.setWordWrap(True)
        self.words.setMargin(8)
        self.picture = FigurePicture(self)
        self.tree = TreePicture(self)
        self.tree.show_tree(self._figure.tree, names)
        self.table = WayTable("", self)
        self.reset = QPushButton("As in the textbook", self)
        self.reset.setToolTip("The eye on h3, looking along it; p as at first")
        self.reset.clicked.connect(self.picture.reset)
        parts = QSplitter(Qt.Orientation.Vertical, self)
        for part, stretch in ((self.picture, 5), (self.tree, 5), (self.table, 3)):
            parts.addWidget(part)
            parts.setStretchFactor(parts.count() - 1, stretch)
        parts.setChildrenCollapsible(False)
        foot = QHBoxLayout()
        foot.setContentsMargins(8, 4, 8, 6)
        foot.addWidget(self.reset)
        foot.addStretch(1)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addWidget(self.words)
        layout.addWidget(parts, 1)
        layout.addLayout(foot)
        self.picture.changed.connect(self._follow)
        self.picture.line_chosen.connect(self._choose_line)
        self.tree.chosen.connect(self._choose)
        self.table.chosen.connect(self._choose)
        self._follow()

    def _choose(self, node: int) -> None:
        self.tree.choose(node)
        name = self._figure.names[node] if node >= 0 else ""
        self.picture.choose_line(name if any(line.name == name for line in LINES) else "")

    def _choose_line(self, name: str) -> None:
        self._choose(self._figure.names.index(name) if name else -1)

    def _follow(self) -> None:
        """Bring the tree, the table and the words to what the picture has."""
        shown, picture = self._figure, self.picture
        cone = flat_cone(picture.eye, picture.forward, picture.angle)
        found = prune(shown.tree, cone)
        gone = frozenset(int(node) for top in found.cut for node in below(shown.tree, int(top)))
        pruned = frozenset(shown.names[node] for node in gone)
        order = tuple(name for name in back_to_front(shown, picture.eye) if name not in pruned)
        picture.show_result(pruned, order)
        self.tree.show_pruned(gone)
        self.tree.show_numbers({shown.names.index(name): str(place + 1) for place, name in enumerate(order)})
        way = way_down(shown.tree, (*picture.probe, 0.0))
        self.tree.show_way([step.node for step in way])
        self.table.show_way(way, shown.names)
        drawn = ", ".join(order) or "nothing"
        left_out = [f"{shown.names[top]} ({self._reason(int(top))})" for top in found.cut]
        self.words.setText(
            f"Drawn from back to front: <b>{drawn}</b>. "
            f"Pruned by the view cone: <b>{'; '.join(left_out) or 'nothing'}</b>."
        )

    def _reason(self, node: int) -> str:
        """Whose half-space a pruned sub-tree lies in."""
        tree, names = self._figure.tree, self._figure.names
        for above in range(len(names)):
            if node == tree.front[above]:
                return f"in front of {names[above]}"
            if node == tree.back[above]:
                return f"behind {names[above]}"
        raise AssertionError(node)
