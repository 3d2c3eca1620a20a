"""The Surfaces panel: materials, and light. Nothing of it is made before it is looked at."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QTabWidget, QVBoxLayout, QWidget

if TYPE_CHECKING:
    from ...model.editing.session import State
    from ..window import MainWindow
    from .lights_page import LightsPage
    from .materials_page import MaterialsPage

MATERIALS, LIGHTS = 0, 1


class SurfacesPanel(QWidget):
    """`refused` carries why a change was not made; `light_chosen` the light whose handles are to be shown, "" for
    none; `chosen` tells that another material or light is chosen."""

    refused = Signal(str)
    light_chosen = Signal(str)
    chosen = Signal()

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window)
        self.setObjectName("surfaces")
        self._window = window
        self.in_front = False
        self.pages: QTabWidget | None = None
        self.materials: MaterialsPage | None = None
        self.lights: LightsPage | None = None

    def set_in_front(self, seen: bool) -> None:
        """Whether its tab is the one that is open."""
        was, self.in_front = self.in_front, seen
        if seen:
            self._make()
            if not was:
                self._refresh()
        self._follow()

    def show_page(self, page: int) -> None:
        """MATERIALS or LIGHTS."""
        self._make()
        assert self.pages is not None
        self.pages.setCurrentIndex(page)

    def shows(self, page: int) -> bool:
        """Whether a page is to be seen."""
        return self.in_front and self.pages is not None and self.pages.currentIndex() == page

    @property
    def material(self) -> str:
        """The name of the chosen material, or of the only one; "" for none."""
        known = [material.name for material in self._window.session.document.materials]
        return _chosen(known, "" if self.materials is None else self.materials.name)

    @property
    def light(self) -> str:
        """The name of the chosen light, or of the only one; "" for none."""
        known = [light.name for light in self._window.session.document.lights]
        return _chosen(known, "" if self.lights is None else self.lights.name)

    def choose_material(self, name: str) -> None:
        """Choose a material by its name."""
        if self.materials is not None:
            self.materials.choose(name)

    def choose_light(self, name: str) -> None:
        """Choose a light by its name."""
        if self.lights is not None:
            self.lights.choose(name)

    def session_changed(self, before: State, after: State) -> None:
        if self.in_front and self.materials is not None and self.lights is not None:
            self.materials.session_changed(before, after)
            self.lights.session_changed(before, after)
        if before.document.lights is not after.document.lights:
            self._follow()

    def _refresh(self) -> None:
        if self.materials is not None and self.lights is not None:
            self.materials.refresh()
            self.lights.refresh()

    def _make(self) -> None:
        if self.pages is not None:
            return
        from .lights_page import LightsPage
        from .materials_page import MaterialsPage

        self.pages = pages = QTabWidget(self)
        pages.setDocumentMode(True)
        self.materials, self.lights = MaterialsPage(self._window, pages), LightsPage(self._window, pages)
        for page in (self.materials, self.lights):
            page.refused.connect(self.refused)
            page.chosen.connect(self._follow)
        pages.addTab(self.materials, "Materials")
        pages.addTab(self.lights, "Light")
        pages.setTabToolTip(MATERIALS, "How surfaces take light, and the bitmaps on them")
        pages.setTabToolTip(LIGHTS, "The lights of the document, and its shading")
        pages.currentChanged.connect(self._follow)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(pages)

    def _follow(self) -> None:
        self.light_chosen.emit(self.light if self.shows(LIGHTS) else "")
        self.chosen.emit()


def _chosen(known: list[str], name: str) -> str:
    if name in known:
        return name
    return known[0] if len(known) == 1 else ""
