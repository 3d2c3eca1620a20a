"""A window for tests, with hands on its keys and its mouse."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, QSettings, Qt
from PySide6.QtWidgets import QApplication, QWidget

from solidtree.gui.panels.number_field import NumberField
from solidtree.gui.settings import Settings
from solidtree.gui.window import MainWindow
from solidtree.model.document.document import Document
from solidtree.model.document.nodes import Node
from solidtree.model.document.tree import walk
from solidtree.model.editing.session import Session

LEFT = Qt.MouseButton.LeftButton


class Driver:
    """`window` is shown and draws; everything here goes through events, as a user's hands do."""

    def __init__(self, window: MainWindow, qtbot) -> None:
        self.window = window
        self.session = window.session
        self.qtbot = qtbot

    @property
    def document(self) -> Document:
        return self.session.document

    def settle(self, timeout: int = 15000) -> None:
        """Until all that was asked for has been shown."""
        evaluation = self.window.evaluation
        self.qtbot.waitUntil(lambda: not evaluation.waiting, timeout=timeout)

    def keys(self, keys: str, widget: QWidget | None = None) -> None:
        """One shortcut such as `Shift+B`, sent to what has the focus."""
        *modifiers, key = keys.split("+") if keys != "+" else ["+"]
        held = Qt.KeyboardModifier.NoModifier
        for name in modifiers:
            held |= {"Ctrl": Qt.KeyboardModifier.ControlModifier, "Shift": Qt.KeyboardModifier.ShiftModifier,
                     "Alt": Qt.KeyboardModifier.AltModifier}[name]  # fmt: skip
        code = getattr(Qt.Key, f"Key_{key}")
        self.qtbot.keyClick(widget or QApplication.focusWidget() or self.window, code, held)

    def write(self, text: str, widget: QWidget | None = None) -> None:
        self.qtbot.keyClicks(widget or QApplication.focusWidget(), text)

    def node(self, name: str) -> Node:
        return next(node for node in walk(*self.document.roots) if node.label == name)

    def field(self, name: str) -> NumberField:
        found = self.window.properties.widget().findChild(NumberField, name)
        assert found is not None, name
        return found

    def child(self, kind: type, name: str):
        found = self.window.properties.widget().findChild(kind, name)
        assert found is not None, name
        return found

    def type_into(self, field: QWidget, text: str, end: str = "Return") -> None:
        """Click the field, write over what is in it, and press a key."""
        self.window.properties.ensureWidgetVisible(field)
        self.qtbot.mouseClick(field, LEFT)
        self.keys("Ctrl+A", field)
        self.write(text, field)
        self.keys(end, field)

    def row(self, node: Node, column: int = 0) -> QPoint:
        """Where a node's row stands in the tree's viewport."""
        tree = self.window.tree
        index = tree.nodes.index_of(node.id).siblingAtColumn(column)
        tree.scrollTo(index)
        return tree.visualRect(index).center()

    def click_row(self, node: Node, modifiers=Qt.KeyboardModifier.NoModifier, column: int = 0) -> None:
        self.qtbot.mouseClick(self.window.tree.viewport(), LEFT, modifiers, self.row(node, column))

    def pixel_of(self, point: tuple[float, float, float]) -> QPoint:
        """Where a point of the world stands in the picture."""
        from solidtree.render.camera import project

        viewer = self.window.viewport.viewer
        assert viewer is not None
        x, y, _ = project(viewer.camera, [point], viewer.size)[0]
        return QPoint(int(x), int(y))

    def click_at(self, point: tuple[float, float, float], modifiers=Qt.KeyboardModifier.NoModifier) -> None:
        self.qtbot.mouseClick(self.window.viewport, LEFT, modifiers, self.pixel_of(point))

    def look_from(self, name: str) -> None:
        """A standard view at once, without the animation."""
        from solidtree.render.views import standard_view

        def turn(viewer) -> None:
            viewer.set_camera(viewer.fitted(standard_view(viewer.camera, name)))

        self.window.viewport.change(turn)

    def open(self, document: Document) -> None:
        self.session.open(document)
        self.window.files.opened.emit()
        self.settle()


@pytest.fixture
def make_window(qtbot, tmp_path: Path) -> Iterator[Callable[..., Driver]]:
    """Makes windows with settings of their own; they are closed without questions at the end."""
    made: list[MainWindow] = []

    def make(document: Document | None = None) -> Driver:
        settings = Settings(QSettings(str(tmp_path / "settings.ini"), QSettings.Format.IniFormat))
        settings.folder = tmp_path
        window = MainWindow(Session(document), settings)
        made.append(window)
        window.show()
        qtbot.waitExposed(window)
        with qtbot.waitSignal(window.viewport.ready, timeout=20000):
            window.start()
        window.activateWindow()
        qtbot.waitUntil(window.isActiveWindow)
        window.viewport.setFocus()
        driver = Driver(window, qtbot)
        driver.settle()
        return driver

    yield make
    for window in made:
        window.session.cancel()
        window.session.mark_saved(window.session.document)
        window.close()
        window.deleteLater()


@pytest.fixture
def driver(make_window) -> Driver:
    return make_window()
