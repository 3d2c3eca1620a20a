"""A hand that draws outlines in the real window."""

from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

LEFT = Qt.MouseButton.LeftButton


class Drawer:
    """Draws in the plane z = `height`, seen from the top."""

    def __init__(self, driver, height: float = 0.0) -> None:
        self.driver, self.height = driver, height
        self.viewport = driver.window.viewport
        self.tool = driver.window.draw

    def pixel(self, x: float, y: float) -> QPoint:
        return self.driver.pixel_of((x, y, self.height))

    def move(self, x: float, y: float, buttons=Qt.MouseButton.NoButton) -> None:
        self.send(self.pixel(x, y), buttons)

    def send(self, place: QPoint, buttons=Qt.MouseButton.NoButton, modifiers=Qt.KeyboardModifier.NoModifier) -> None:
        """A move of the pointer as an event: the X server's own comes some time later."""
        where = QPointF(place)
        event = QMouseEvent(QEvent.Type.MouseMove, where, self.viewport.mapToGlobal(where), Qt.MouseButton.NoButton,
                            buttons, modifiers)  # fmt: skip
        QApplication.sendEvent(self.viewport, event)

    def click(self, x: float, y: float, modifiers=Qt.KeyboardModifier.NoModifier) -> None:
        self.move(x, y)
        self.driver.qtbot.mouseClick(self.viewport, LEFT, modifiers, self.pixel(x, y))

    def drag(self, *places: tuple[float, float], modifiers=Qt.KeyboardModifier.NoModifier) -> None:
        self.move(*places[0])
        QTest.mousePress(self.viewport, LEFT, modifiers, self.pixel(*places[0]))
        for place in places[1:]:
            self.send(self.pixel(*place), LEFT, modifiers)
        QTest.mouseRelease(self.viewport, LEFT, modifiers, self.pixel(*places[-1]))

    def start(self, kind: str) -> None:
        self.driver.window.actions_.run(f"draw_{kind}")
        assert self.tool.kind == kind

    def type(self, text: str) -> None:
        for letter in text:
            if letter == "\t":
                self.driver.keys("Tab", self.viewport)
            else:
                self.driver.write(letter, self.viewport)
        self.driver.keys("Return", self.viewport)

    @property
    def drawn(self):
        """The outline that is selected."""
        (node_id,) = self.driver.session.selection
        return next(root for root in self.driver.document.roots if root.id == node_id)
