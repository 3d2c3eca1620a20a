"""The materials of the document: their list, what can be done with them, and the editor of the chosen one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QAction, QDragEnterEvent, QDropEvent
from PySide6.QtWidgets import (
    QFrame,
    QHBoxLayout,
    QLabel,
    QListWidgetItem,
    QMenu,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)

from ...model.document.errors import Refusal
from ...model.document.tree import find, walk
from ...model.surface.material import PRESETS, Material
from ..commands.actions import Actions
from ..panels.property_edit import sentence
from .bitmap_files import bitmap_paths
from .buttons import flat_button, menu_button
from .material_form import MaterialForm
from .member_list import MemberList
from .swatch import swatch

if TYPE_CHECKING:
    from ...model.editing.session import State
    from ..window import MainWindow

SWATCH = 28  # pixels
ROW = 36  # pixels


class MaterialsPage(QWidget):
    """`refused` carries why a change was not made. `name` is the chosen material, "" for none."""

    refused = Signal(str)
    chosen = Signal(str)

    def __init__(self, window: MainWindow, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("materials_page")
        self.setAcceptDrops(True)
        self._window, self._session = window, window.session
        self.name = ""
        self._filling = False
        self.list = MemberList("materials", SWATCH, ROW, self)
        self.list.delete_asked.connect(lambda: window.actions_.run("delete_material"))
        self.list.itemChanged.connect(self._renamed)
        self.list.currentRowChanged.connect(self._clicked)
        self.hint = QLabel(
            "A material says how a surface takes light, and which bitmaps lie on it. Add one, or drop a bitmap here.",
            self,
        )
        self.hint.setProperty("muted", True)
        self.hint.setContentsMargins(12, 8, 12, 8)
        self.hint.setWordWrap(True)
        self.form = MaterialForm(window, self)
        self.form.refused.connect(self.refused)
        self.area = QScrollArea(self)
        self.area.setWidgetResizable(True)
        self.area.setFrameShape(QFrame.Shape.NoFrame)
        self.area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.area.setWidget(self.form)
        self.form.column.addStretch(1)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addLayout(self._bar(window.actions_))
        column.addWidget(self.hint)
        column.addWidget(self.list)
        column.addWidget(self.area, 1)
        column.addStretch(0)
        self.refresh()

    def _bar(self, actions: Actions) -> QHBoxLayout:
        bar = QHBoxLayout()
        bar.setContentsMargins(6, 4, 6, 4)
        bar.setSpacing(2)
        add = menu_button("Add", "Add a material, of the presets or from a bitmap", self)
        add.setObjectName("add_material")
        self.menu = QMenu(add)
        self.menu.addAction(actions["add_material"])
        self.menu.addSeparator()
        for preset, values in PRESETS.items():
            action = QAction(swatch(Material(preset, **values), 16), preset, self.menu)
            action.triggered.connect(lambda _=False, preset=preset: self.add(preset))
            self.menu.addAction(action)
        self.menu.addSeparator()
        self.menu.addAction(actions["material_from_bitmap"])
        add.setMenu(self.menu)
        bar.addWidget(add)
        for name in ("duplicate_material", "delete_material"):
            bar.addWidget(flat_button(actions[name], self))
        bar.addStretch(1)
        for name, text in (("use_material", "Use"), ("take_off_material", "")):
            bar.addWidget(flat_button(actions[name], self, text))
        return bar

    @property
    def material(self) -> Material | None:
        """The chosen one."""
        return next((one for one in self._session.document.materials if one.name == self.name), None)

    def choose(self, name: str) -> None:
        if name != self.name:
            self.name = name
            self.refresh()

    def session_changed(self, before: State, after: State) -> None:
        new, old = after.document, before.document
        if new.materials is not old.materials:
            added = [one.name for one in new.materials if all(one.name != other.name for other in old.materials)]
            if len(added) == 1:
                self.name = added[0]
            self.refresh()
        elif new is not old and not self._session.previewing:
            self._tell_use()
        if before.selection != after.selection and len(after.selection) == 1:
            worn = find(new, after.selection[0]).material
            if isinstance(worn, str) and worn:
                self.choose(worn)

    def add(self, preset: str) -> None:
        """Add a material of a preset, under a free name."""
        from .steps import do_steps, new_material

        name, step = new_material(self._session.document, preset, preset=preset)
        try:
            do_steps(self._session, f"Add {name}", [step])
        except Refusal as refusal:
            self.refused.emit(sentence(refusal))

    def refresh(self) -> None:
        """Bring the page up to date."""
        materials = self._session.document.materials
        if materials and self.material is None:
            self.name = materials[min(max(self.list.currentRow(), 0), len(materials) - 1)].name
        self._filling = True
        try:
            self.list.cut_to(len(materials))
            for row, material in enumerate(materials):
                item = self.list.row_at(row)
                if item.data(Qt.ItemDataRole.UserRole) != material:
                    item.setData(Qt.ItemDataRole.UserRole, material)
                    item.setIcon(swatch(material, SWATCH))
                    item.setText(material.name)
                if material.name == self.name:
                    self.list.setCurrentRow(row)
        finally:
            self._filling = False
        self.hint.setVisible(not materials)
        self.area.setVisible(bool(materials))
        material = self.material
        if material is None:
            self.name = ""
        else:
            self.form.show_member(material)
        self._tell_use()
        self.chosen.emit(self.name)

    def _tell_use(self) -> None:
        """On how many nodes each material is, in its tip."""
        counts: dict[str, int] = {}
        if self._session.previewing:
            return
        for node in walk(*self._session.document.roots):
            if node.material:
                counts[str(node.material)] = counts.get(str(node.material), 0) + 1
        self._filling = True
        for row in range(self.list.count()):
            item = self.list.item(row)
            count = counts.get(item.text(), 0)
            where = "on no node yet" if not count else f"on {count} node{'s' if count > 1 else ''}"
            item.setToolTip(f"{where[0].upper()}{where[1:]}. A double click or F2 renames it")
        self._filling = False

    def _clicked(self, row: int) -> None:
        materials = self._session.document.materials
        if not self._filling and 0 <= row < len(materials):
            self.choose(materials[row].name)

    def _renamed(self, item: QListWidgetItem) -> None:
        if self._filling:
            return
        material, text = item.data(Qt.ItemDataRole.UserRole), item.text()
        if text == material.name:
            return
        was, self.name = self.name, " ".join(text.split())
        try:
            self._session.do("rename_material", material.name, text, label=f"Rename {material.name}")
        except Refusal as refusal:
            self.name = was
            self._filling = True
            item.setText(material.name)
            self._filling = False
            self.refused.emit(sentence(refusal))

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        if bitmap_paths(event.mimeData()):
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:
        from ..commands.surfaces import take_as_material

        paths = bitmap_paths(event.mimeData())
        if paths:
            event.acceptProposedAction()
        for path in paths:
            take_as_material(self._window, path)
