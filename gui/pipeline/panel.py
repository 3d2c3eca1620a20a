"""The Pipeline panel. Nothing of it is made before it is looked at."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QDockWidget, QVBoxLayout, QWidget

from .vertex_tool import VertexTool

if TYPE_CHECKING:
    from ..window import MainWindow
    from .explorer import PipelineExplorer
    from .page import PipelinePage


class PipelinePanel(QWidget):
    """`refused` carries why something typed or asked for cannot be."""

    refused = Signal(str)

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window)
        self.setObjectName("pipeline")
        self._window = window
        self.tool = VertexTool(window.viewport, self)
        window.viewport.add_tool(self.tool)
        self.in_front = False
        self.explorer: PipelineExplorer | None = None
        self.page: PipelinePage | None = None

    def set_in_front(self, seen: bool) -> None:
        """Whether its tab is the one that is open."""
        self.in_front = seen
        if seen and self.page is None:
            self._make()
        if self.explorer is not None:
            self.explorer.set_active(seen)

    def toggle_pick(self) -> None:
        """Begin or end to take the vertex from the picture."""
        self._make()
        self.tool.end() if self.tool.active else self.tool.start()

    def forget(self) -> None:
        """Another document is open: nothing is followed and nothing tried any more."""
        self.tool.end()
        if self.explorer is not None:
            self.explorer.forget()

    def close_work(self) -> None:
        """End what is under way in a thread, before the window goes."""
        if self.explorer is not None:
            self.explorer.close()

    def _make(self) -> None:
        if self.page is not None:
            return
        from .explorer import PipelineExplorer
        from .page import PipelinePage

        self.page = PipelinePage(self)
        self.explorer = PipelineExplorer(self._window, self.page, self.tool, self)
        self.explorer.refused.connect(self.refused)
        dock = self._window.docks["Pipeline"]
        self.page.float_asked.connect(dock.setFloating)
        dock.topLevelChanged.connect(self.page.floating.setChecked)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.page)


def let_float(dock: QDockWidget) -> None:
    """A dock among tabs has no title of its own; it gets one while it floats, so that it can be moved and put back."""
    dock.setFeatures(dock.features() | QDockWidget.DockWidgetFeature.DockWidgetFloatable)

    def title(floats: bool) -> None:
        dock.setTitleBarWidget(None if floats else QWidget(dock))  # type: ignore[arg-type]

    dock.topLevelChanged.connect(title)
