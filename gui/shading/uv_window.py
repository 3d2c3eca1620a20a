"""The view of texture coordinates: the unwrapped triangles of the selection over the bitmap of their material."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QCheckBox, QComboBox, QLabel, QMainWindow, QStackedWidget

from ...model.document.errors import Refusal
from ...model.document.resolve import Resolver
from ...model.document.tree import find
from ...model.operations.surfaces import set_mapping
from ..icons import icon
from ..panels.property_edit import sentence
from ..surfaces.in_force import mapping_changes, mapping_in_force
from .unwrapping import Sheet, sheets_of, words_of
from .uv_layer import MIRRORED, PLAIN
from .uv_view import UvView

if TYPE_CHECKING:
    from ...model.document.document import Document
    from ...model.editing.session import State
    from ..window import MainWindow

HINT = "Click a triangle to select its node; Shift+drag shifts the bitmap, Ctrl+wheel scales it; wheel zooms, F fits."
NOTHING = "There are no triangles to show.\nAdd a solid, and give it a material with a texture in the Surfaces panel."
MANY, QUIET = 20_000, 150
"""Triangles that take time to unwrap, and milliseconds without a change after which that is done."""
SHOWN = 8000  # milliseconds that a refusal stays


class UvWindow(QMainWindow):
    """One for each main window; its edits are steps of that window's history."""

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window, Qt.WindowType.Window)
        self.setObjectName("uv_window")
        self.setWindowTitle("Texture coordinates")
        self._window, self._session = window, window.session
        self._resolver = Resolver()
        self._sheets: list[Sheet] = []
        self._base: Document | None = None
        """What was there before the drag under way."""
        self.view = UvView(self)
        self.view.pointed.connect(self._point)
        self.view.clicked.connect(self._click)
        self.view.shifted.connect(self._shift)
        self.view.scaled.connect(self._scale)
        self.material = QComboBox(self)
        self.material.setObjectName("material")
        self.material.setAccessibleName("Material")
        self.material.setMinimumContentsLength(18)
        self.material.activated.connect(lambda _: self._show_sheet())
        self.filled = QCheckBox("Filled", self)
        self.filled.setChecked(True)
        self.filled.toggled.connect(self.view.set_filled)
        self.facts = QLabel(self)
        self.facts.setObjectName("facts")
        self.facts.setProperty("muted", True)
        self.facts.setContentsMargins(10, 0, 10, 0)
        legend = QLabel(
            f'<span style="color:{PLAIN}">\u25a0</span> as it is &nbsp; '
            f'<span style="color:{MIRRORED}">\u25a0</span> mirrored', self)  # fmt: skip
        legend.setContentsMargins(10, 0, 10, 0)
        bar = self.addToolBar("View")
        bar.setMovable(False)
        label = QLabel("Material", self)
        label.setProperty("muted", True)
        label.setContentsMargins(8, 0, 6, 0)
        bar.addWidget(label)
        bar.addWidget(self.material)
        bar.addAction(icon("fit"), "Fit", self.view.fit).setToolTip("All triangles (F)")
        bar.addWidget(self.filled)
        bar.addWidget(legend)
        self.empty = QLabel(NOTHING, self)
        self.empty.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.empty.setProperty("muted", True)
        self.stack = QStackedWidget(self)
        self.stack.addWidget(self.empty)
        self.stack.addWidget(self.view)
        self.setCentralWidget(self.stack)
        hint = QLabel(HINT, self)
        hint.setProperty("muted", True)
        self.statusBar().addWidget(hint, 1)
        self.statusBar().setSizeGripEnabled(False)
        facts_bar = self.addToolBar("Facts")
        facts_bar.setMovable(False)
        self.insertToolBarBreak(facts_bar)
        facts_bar.addWidget(self.facts)
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.timeout.connect(self._follow)
        self._unlisten = self._session.on_change(self._changed)
        window.viewport.displayed.connect(lambda _: self._follow_soon())
        self.resize(760, 700)

    # What is shown.

    def _changed(self, before: State, after: State) -> None:
        if before.selection != after.selection:
            self._follow_soon()

    def _follow_soon(self) -> None:
        """Once for many changes; where there are many triangles, when they have come to rest."""
        many = sum(len(sheet.coordinates) for sheet in self._sheets) > MANY
        self._soon.start(QUIET if many else 0)

    def _follow(self) -> None:
        viewer = self._window.viewport.viewer
        if not self.isVisible() or viewer is None:
            return
        document = self._session.view
        resolved = {root.id: root for root in self._resolver.resolve(document).solids}
        chosen = self.material.currentText()
        self._sheets = sheets_of(document, resolved, viewer.scene.solid_meshes, self._session.selection)
        self.material.clear()
        self.material.addItems([sheet.name for sheet in self._sheets])
        self.material.setCurrentIndex(max(self.material.findText(chosen), 0))
        self._show_sheet()

    def _show_sheet(self) -> None:
        sheet = self.sheet
        self.stack.setCurrentIndex(0 if sheet is None else 1)
        self.view.show_sheet(sheet)
        self.facts.setText("" if sheet is None else words_of(sheet))

    @property
    def sheet(self) -> Sheet | None:
        """What is shown."""
        place = self.material.currentIndex()
        return self._sheets[place] if 0 <= place < len(self._sheets) else None

    def _point(self, triangle: int) -> None:
        sheet = self.sheet
        self._window.viewport.tint(None if sheet is None or triangle < 0 else sheet.paths[int(sheet.owner[triangle])])

    def _click(self, triangle: int) -> None:
        sheet = self.sheet
        if sheet is not None:
            self._session.select([sheet.node(triangle)] if triangle >= 0 else [])

    # What is changed: the mapping of the selected node.

    def _node(self) -> str | None:
        chosen = self._session.selection
        if len(chosen) == 1:
            return chosen[0]
        self.statusBar().showMessage("Select one node first: its bitmap is shifted and scaled", SHOWN)
        return None

    def _shift(self, right: float, up: float, ended: bool) -> None:
        node_id = self._node()
        if node_id is None:
            return
        if self._base is None:
            self._base = self._session.document
        mapping = mapping_in_force(self._base, node_id)
        sign = [-1.0 if mirrored else 1.0 for mirrored in mapping.mirror]
        offset = (mapping.offset[0] - sign[0] * right, mapping.offset[1] - sign[1] * up)
        self._change(self._base, node_id, "offset", tuple(round(float(part), 4) + 0.0 for part in offset), ended)
        if ended:
            self._base = None

    def _scale(self, factor: float) -> None:
        node_id = self._node()
        if node_id is not None:
            mapping = mapping_in_force(self._session.document, node_id)
            scale = tuple(float(f"{part * factor:.6g}") for part in mapping.scale)
            self._change(self._session.document, node_id, "scale", scale, True)

    def _change(self, document: Document, node_id: str, field: str, value: tuple[float, ...], ended: bool) -> None:
        session = self._session
        changes = {**mapping_changes(document, node_id), field: value}
        try:
            if ended:
                session.cancel()
                name = find(session.document, node_id).label
                session.do("set_mapping", [node_id], label=f"Place the texture on {name}", **changes)
            else:
                session.preview(set_mapping(document, [node_id], **changes))
        except Refusal as refusal:
            session.cancel()
            self.statusBar().showMessage(sentence(refusal), SHOWN)

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self._follow()

    def end(self) -> None:
        """Before the main window goes."""
        self._unlisten()
        self.close()


def open_uv_window(window: MainWindow) -> None:
    found = window.side_windows.of(UvWindow)
    found.show()
    found.raise_()
    found.activateWindow()
    found.view.setFocus()
