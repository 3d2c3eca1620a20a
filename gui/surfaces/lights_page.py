"""The lights and the shading of the document: their list, and the editor of the chosen one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QFrame,
    QHBoxLayout,
    QLabel,
    QListWidgetItem,
    QMenu,
    QPushButton,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)

from ...model.document.errors import Refusal
from ...model.surface.light import Light
from ..icons import icon
from ..panels.property_edit import sentence
from ..panels.property_fields import LABEL_WIDTH
from .buttons import flat_button, menu_button
from .light_form import LightForm
from .member_list import MemberList
from .rows import combo

if TYPE_CHECKING:
    from ...model.editing.session import State
    from ..window import MainWindow

ADD = ("add_ambient_light", "add_directional_light", "add_point_light")
ICONS = {"ambient": "add_ambient_light", "directional": "add_directional_light", "point": "add_point_light"}
ICON, ROW = 18, 28  # pixels
OWN = "The document has no lights: the program's own three follow the eye."
SHADINGS = (
    ("", "as the program: Phong"),
    ("flat", "Flat"),
    ("gouraud", "Gouraud"),
    ("gouraud-diffuse", "Gouraud without highlights"),
    ("phong", "Phong"),
)


class LightsPage(QWidget):
    """`refused` carries why a change was not made; `chosen` the light whose rows are shown, "" for none."""

    refused = Signal(str)
    chosen = Signal(str)

    def __init__(self, window: MainWindow, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("lights_page")
        self._session = window.session
        self.name = ""
        self._filling = False
        bar = QHBoxLayout()
        bar.setContentsMargins(6, 4, 6, 4)
        bar.setSpacing(2)
        add = menu_button("Add", "Add a light", self)
        add.setObjectName("add_light")
        menu = QMenu(add)
        menu.setToolTipsVisible(True)
        menu.addActions([window.actions_[name] for name in ADD])
        add.setMenu(menu)
        bar.addWidget(add)
        bar.addStretch(1)
        bar.addWidget(flat_button(window.actions_["delete_light"], self))
        self.list = MemberList("lights", ICON, ROW, self)
        self.list.delete_asked.connect(lambda: window.actions_.run("delete_light"))
        self.list.itemChanged.connect(self._edited)
        self.list.currentRowChanged.connect(self._clicked)
        self.empty = QWidget(self)
        hint = QLabel(OWN, self.empty)
        hint.setProperty("muted", True)
        hint.setWordWrap(True)
        own = QPushButton("Make them lights of the document", self.empty)
        own.setObjectName("own_lights")
        own.setToolTip(window.actions_["own_lights"].toolTip())
        own.clicked.connect(window.actions_["own_lights"].trigger)
        column = QVBoxLayout(self.empty)
        column.setContentsMargins(12, 8, 12, 8)
        column.setSpacing(8)
        column.addWidget(hint)
        column.addWidget(own, 0, Qt.AlignmentFlag.AlignLeft)
        self.form = LightForm(window, self)
        self.form.refused.connect(self.refused)
        self.area = QScrollArea(self)
        self.area.setWidgetResizable(True)
        self.area.setFrameShape(QFrame.Shape.NoFrame)
        self.area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.area.setWidget(self.form)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addLayout(bar)
        column.addWidget(self.empty)
        column.addWidget(self.list)
        column.addWidget(self.area, 1)
        column.addStretch(0)
        column.addWidget(self._shading_row())
        self.refresh()

    def _shading_row(self) -> QWidget:
        row = QWidget(self)
        words = QLabel("Shading", row)
        words.setProperty("muted", True)
        words.setFixedWidth(LABEL_WIDTH)
        words.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.shading = combo(SHADINGS, row)
        self.shading.setObjectName("document_shading")
        self.shading.setAccessibleName("Shading of the document")
        self.shading.setToolTip("How all is shaded whose material says nothing else; kept with the document")
        self.shading.activated.connect(self._shade)
        line = QHBoxLayout(row)
        line.setContentsMargins(12, 6, 12, 8)
        line.setSpacing(8)
        line.addWidget(words)
        line.addWidget(self.shading, 1)
        return row

    @property
    def light(self) -> Light | None:
        """The chosen one."""
        return next((one for one in self._session.document.lights if one.name == self.name), None)

    def choose(self, name: str) -> None:
        if name != self.name:
            self.name = name
            self.refresh()

    def session_changed(self, before: State, after: State) -> None:
        new, old = after.document, before.document
        if new.lights is not old.lights or new.shading != old.shading:
            known = {light.name for light in old.lights}
            added = [light.name for light in new.lights if light.name not in known]
            if added and len(new.lights) > len(old.lights):
                self.name = added[-1]
            self.refresh()

    def refresh(self) -> None:
        """Bring the page up to date."""
        document = self._session.document
        lights = document.lights
        if lights and self.light is None:
            self.name = lights[min(max(self.list.currentRow(), 0), len(lights) - 1)].name
        self._filling = True
        try:
            self.list.cut_to(len(lights))
            for row, light in enumerate(lights):
                item = self.list.row_at(row)
                item.setFlags(item.flags() | Qt.ItemFlag.ItemIsUserCheckable)
                item.setToolTip("The tick lights it. A double click or F2 renames it")
                if item.data(Qt.ItemDataRole.UserRole) != light:
                    item.setData(Qt.ItemDataRole.UserRole, light)
                    item.setIcon(icon(ICONS[light.kind]))
                    item.setText(light.name)
                    item.setCheckState(Qt.CheckState.Checked if light.active else Qt.CheckState.Unchecked)
                if light.name == self.name:
                    self.list.setCurrentRow(row)
            self.shading.setCurrentIndex(self.shading.findData(document.shading))
        finally:
            self._filling = False
        self.empty.setVisible(not lights)
        self.area.setVisible(bool(lights))
        light = self.light
        if light is None:
            self.name = ""
        else:
            self.form.show_member(light)
        self.chosen.emit(self.name)

    def _clicked(self, row: int) -> None:
        lights = self._session.document.lights
        if not self._filling and 0 <= row < len(lights):
            self.choose(lights[row].name)

    def _shade(self) -> None:
        self._session.do("set_shading", self.shading.currentData() or None, label="Change shading")

    def _edited(self, item: QListWidgetItem) -> None:
        if self._filling:
            return
        light, text = item.data(Qt.ItemDataRole.UserRole), item.text()
        active = item.checkState() == Qt.CheckState.Checked
        was = self.name
        try:
            if active != light.active:
                label = f"Switch {light.name} {'on' if active else 'off'}"
                self._session.do("set_light", light.name, active=active, label=label)
            elif text != light.name:
                self.name = " ".join(text.split())
                self._session.do("rename_light", light.name, text, label=f"Rename {light.name}")
        except Refusal as refusal:
            self.name = was
            item.setData(Qt.ItemDataRole.UserRole, None)
            self.refresh()
            self.refused.emit(sentence(refusal))
