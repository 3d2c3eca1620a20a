"""The bar in a corner of the picture while a drawing tool is on: the work plane, and what the tool can be set to."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtWidgets import QComboBox, QDoubleSpinBox, QFrame, QHBoxLayout, QLabel, QSpinBox, QToolButton, QWidget

from ...commands.actions import Actions
from .draw_tool import DrawTool
from .work_plane import TITLES

GAP = 12  # pixels from the corner
ACCURACIES = {"Fine": 1.0, "Normal": 2.5, "Coarse": 6.0}
"""Pixels that a freehand curve may leave the stroke by."""


class DrawBar(QFrame):
    """It has a native window of its own, for VTK draws over all that has not."""

    def __init__(self, tool: DrawTool, actions: Actions, viewport: QWidget) -> None:
        super().__init__(viewport)
        self.setObjectName("draw_bar")
        self.setAttribute(Qt.WidgetAttribute.WA_NativeWindow)
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setProperty("welcome", True)
        self._tool, self._actions, self._viewport = tool, actions, viewport
        self._filling = False
        viewport.installEventFilter(self)
        self.title = QLabel(self)
        self.title.setProperty("heading", True)
        self.planes = QComboBox(self)
        self.planes.setToolTip("The plane that is drawn on")
        self.planes.setAccessibleName("Work plane")
        self.planes.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        for name, title in TITLES.items():
            self.planes.addItem(title, name)
        self.planes.activated.connect(self._plane_chosen)
        look = QToolButton(self)
        look.setDefaultAction(actions["look_at_plane"])
        look.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.sides = self._counter("Sides", 3, lambda options, value: setattr(options, "sides", value))
        self.tips = self._counter("Tips", 2, lambda options, value: setattr(options, "tips", value))
        self.inner = QDoubleSpinBox(self)
        self.inner.setRange(0.05, 0.95)
        self.inner.setSingleStep(0.05)
        self.inner.setToolTip("The inner radius of the star as a share of the outer one")
        self.inner.setAccessibleName("Inner radius")
        self.inner.valueChanged.connect(lambda value: self._set(lambda options: setattr(options, "inner", value)))
        self.accuracy = QComboBox(self)
        self.accuracy.setToolTip("How closely the curve follows the stroke")
        self.accuracy.setAccessibleName("Accuracy")
        for title, pixels in ACCURACIES.items():
            self.accuracy.addItem(title, pixels)
        self.accuracy.activated.connect(
            lambda row: self._set(lambda options: setattr(options, "tolerance", self.accuracy.itemData(row)))
        )
        layout = QHBoxLayout(self)
        layout.setContentsMargins(10, 6, 8, 6)
        layout.setSpacing(8)
        self._only: dict[str, list[QWidget]] = {"polygon": [], "star": [], "freehand": []}
        layout.addWidget(self.title)
        layout.addWidget(QLabel("on", self))
        layout.addWidget(self.planes)
        layout.addWidget(look)
        for kind, words, widget in (
            ("polygon", "Sides", self.sides),
            ("star", "Tips", self.tips),
            ("star", "Inner", self.inner),
            ("freehand", "Accuracy", self.accuracy),
        ):
            label = QLabel(words, self)
            self._only[kind] += [label, widget]
            layout.addWidget(label)
            layout.addWidget(widget)
        tool.changed.connect(self.follow)
        tool.plane.changed.connect(self.follow)
        self.hide()

    def _counter(self, name: str, least: int, take: Callable[[object, int], None]) -> QSpinBox:
        box = QSpinBox(self)
        box.setRange(least, 1000)
        box.setAccessibleName(name)
        box.setToolTip(f"{name}; Up and Down in the picture change them as well")
        box.valueChanged.connect(lambda value: self._set(lambda options: take(options, value)))
        return box

    def _set(self, change: Callable[[object], None]) -> None:
        if not self._filling:
            change(self._tool.options)
            self._tool.refresh()

    def _plane_chosen(self, row: int) -> None:
        name = self.planes.itemData(row)
        self._actions.run(f"work_plane_{name}")
        self.follow()
        self._viewport.setFocus()

    def follow(self) -> None:
        """Show what the tool is, or go."""
        tool = self._tool
        if not tool.active:
            self.hide()
            return
        self._filling = True
        self.title.setText(self._actions[f"draw_{tool.kind}"].text())
        self.planes.setCurrentIndex(self.planes.findData(tool.plane.name))
        self.sides.setValue(tool.options.sides)
        self.tips.setValue(tool.options.tips)
        self.inner.setValue(tool.options.inner)
        self.accuracy.setCurrentIndex(self.accuracy.findData(tool.options.tolerance))
        self._filling = False
        for kind, widgets in self._only.items():
            for widget in widgets:
                widget.setVisible(kind == tool.kind)
        self._place()
        self.show()

    def _place(self) -> None:
        self.adjustSize()
        self.move((self._viewport.width() - self.width()) // 2, GAP)
        self.raise_()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if watched is self._viewport and event.type() == QEvent.Type.Resize and self.isVisible():
            self._place()
        return super().eventFilter(watched, event)
