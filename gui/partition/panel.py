"""The BSP panel: the tree of the model, and the textbook's figure. Nothing of it is made before it is looked at."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QTabWidget, QVBoxLayout, QWidget

from .probe_tool import ProbeTool

if TYPE_CHECKING:
    from ..window import MainWindow
    from .explorer import Explorer
    from .figure_page import FigurePage
    from .model_page import ModelPage

MODEL, FIGURE = 0, 1


class BspPanel(QWidget):
    """`refused` carries why something typed cannot be taken."""

    refused = Signal(str)

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window)
        self.setObjectName("bsp")
        self._window = window
        self.probe = ProbeTool(window.viewport, self)
        window.viewport.add_tool(self.probe)
        self.in_front = False
        self.explorer: Explorer | None = None
        self.page: ModelPage | None = None
        self.figure: FigurePage | None = None
        self.pages: QTabWidget | None = None

    def set_in_front(self, seen: bool) -> None:
        """Whether its tab is the one that is open."""
        self.in_front = seen
        if seen and self.pages is None:
            self._make()
        self._follow()

    def show_page(self, page: int) -> None:
        """MODEL or FIGURE."""
        self._make()
        assert self.pages is not None
        self.pages.setCurrentIndex(page)

    def _make(self) -> None:
        if self.pages is not None:
            return
        from .explorer import Explorer
        from .figure_page import FigurePage
        from .model_page import ModelPage

        self.pages = pages = QTabWidget(self)
        pages.setDocumentMode(True)
        self.page, self.figure = ModelPage(pages), FigurePage(pages)
        self.explorer = Explorer(self._window, self.page, self.probe, self)
        self.page.refused.connect(self.refused)
        pages.addTab(self.page, "Model")
        pages.addTab(self.figure, "Textbook")
        pages.setTabToolTip(MODEL, "The tree of what is shown in the picture")
        pages.setTabToolTip(FIGURE, "Objects A to E and the planes h1 to h3")
        pages.currentChanged.connect(self._follow)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(pages)

    def _follow(self) -> None:
        if self.explorer is not None and self.pages is not None:
            self.explorer.set_active(self.in_front and self.pages.currentIndex() == MODEL)

    def toggle_play(self) -> None:
        """Play the painter's order of the model, or stop."""
        self.show_page(MODEL)
        if self.page is not None:
            self.page.order.toggle()

    def toggle_probe(self) -> None:
        """Begin or end to take points from the picture."""
        self.show_page(MODEL)
        self.probe.end() if self.probe.active else self.probe.start()
