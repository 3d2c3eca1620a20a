"""The docks around the picture: where they stand at first."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDockWidget, QMainWindow, QTabWidget, QWidget

LEFT, RIGHT, BOTTOM = 250, 290, 150  # pixels
FAULTS_HEIGHT = 230  # pixels that the list of faults has at least when it comes to the front


def arrange(
    window: QMainWindow, left: Mapping[str, QWidget], right: Mapping[str, QWidget], bottom: Mapping[str, QWidget]
) -> dict[str, QDockWidget]:
    """Docks by title; several on a side stand behind one another as tabs, the first one in front.

    The window's layout is left switched off, for the caller to restore a state and then switch it on: Qt would leave
    a tab bar in the picture from every layout on the way.
    """
    switch_layout(window, False)
    areas = Qt.DockWidgetArea
    window.setTabPosition(areas.BottomDockWidgetArea, QTabWidget.TabPosition.North)
    window.setTabPosition(areas.RightDockWidgetArea, QTabWidget.TabPosition.North)
    window.setTabPosition(areas.LeftDockWidgetArea, QTabWidget.TabPosition.North)
    window.setCorner(Qt.Corner.BottomLeftCorner, areas.LeftDockWidgetArea)
    window.setCorner(Qt.Corner.BottomRightCorner, areas.RightDockWidgetArea)
    window.setDockOptions(QMainWindow.DockOption.AllowTabbedDocks | QMainWindow.DockOption.AllowNestedDocks)
    docks: dict[str, QDockWidget] = {}
    for area, widgets in (
        (areas.LeftDockWidgetArea, left),
        (areas.RightDockWidgetArea, right),
        (areas.BottomDockWidgetArea, bottom),
    ):
        beside = [_dock(window, title, widget, area, len(widgets) > 1) for title, widget in widgets.items()]
        for dock in beside[1:]:
            window.tabifyDockWidget(beside[0], dock)
        if beside:
            beside[0].raise_()
        docks |= zip(widgets, beside, strict=True)
    return docks


def switch_layout(window: QMainWindow, on: bool) -> None:
    layout = window.layout()
    if layout is not None:
        layout.setEnabled(on)


def give_sizes(window: QMainWindow) -> None:
    """The sizes that the docks have at first, in a window that is on the screen; before, Qt would scale them."""
    areas = Qt.DockWidgetArea
    for area, size, direction in (
        (areas.LeftDockWidgetArea, LEFT, Qt.Orientation.Horizontal),
        (areas.RightDockWidgetArea, RIGHT, Qt.Orientation.Horizontal),
        (areas.BottomDockWidgetArea, BOTTOM, Qt.Orientation.Vertical),
    ):
        beside = [dock for dock in window.findChildren(QDockWidget) if window.dockWidgetArea(dock) == area]
        window.resizeDocks(beside[:1], [size], direction)


def raise_dock(window: QMainWindow, title: str, height: int) -> None:
    """Bring a dock to the front, at least so many pixels high; the focus stays where it is."""
    dock = window.findChild(QDockWidget, f"dock_{title.lower()}")
    if isinstance(dock, QDockWidget):
        dock.show()
        dock.raise_()
        if dock.height() < height:
            window.resizeDocks([dock], [height], Qt.Orientation.Vertical)


def _dock(window: QMainWindow, title: str, widget: QWidget, area: Qt.DockWidgetArea, tabbed: bool) -> QDockWidget:
    dock = QDockWidget(title, window)
    dock.setObjectName(f"dock_{title.lower()}")
    dock.setWidget(widget)
    features = QDockWidget.DockWidgetFeature
    dock.setFeatures(features.DockWidgetClosable | features.DockWidgetMovable)
    if tabbed:
        dock.setTitleBarWidget(QWidget(dock))  # the tab says it
    window.addDockWidget(area, dock)
    return dock
