"""The page of the second view: world or device space, the numbers of the lens, the planes that clip."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from ....model.pipeline.clipping import NAMES as PLANES
from ...icons import icon
from ..inks import inks_now
from .frustum_view import FrustumView
from .lens_rows import LensRows

SPACES = (
    ("World", "The eye and its frustum in the document\u2019s axes"),
    ("After division", "The frustum has become a cube, and the rays of the eye have become parallel"),
)


class FrustumPage(QWidget):
    """`plane_switched` carries a plane's name and whether it clips."""

    plane_switched = Signal(str, bool)
    automatic_asked = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.view = FrustumView(self)
        self.space = QComboBox(self)
        self.space.setAccessibleName("Space that is shown")
        for place, (title, tip) in enumerate(SPACES):
            self.space.addItem(title, bool(place))
            self.space.setItemData(place, tip, Qt.ItemDataRole.ToolTipRole)
        self.space.currentIndexChanged.connect(lambda place: self.view.set_device(bool(place)))
        self.legend = QLabel(self)
        fit = QToolButton(self)
        fit.setProperty("flat", True)
        fit.setIcon(icon("fit"))
        fit.setToolTip("Show all of it (F)")
        fit.setAccessibleName("Show all of it")
        fit.clicked.connect(self.view.fit)
        self.lens = LensRows(self)
        self.planes: dict[str, QCheckBox] = {}
        grid = QGridLayout()
        grid.setContentsMargins(8, 2, 8, 2)
        grid.setVerticalSpacing(2)
        for number, plane in enumerate(PLANES):
            box = QCheckBox(plane.capitalize(), self)
            box.setChecked(True)
            box.setToolTip(f"Whether the {plane} plane cuts off what lies beyond it, in this panel")
            box.setAccessibleName(f"Clip at the {plane} plane")
            box.toggled.connect(lambda on, plane=plane: self.plane_switched.emit(plane, on))
            grid.addWidget(box, number % 2, number // 2)
            self.planes[plane] = box
        self.range = QLabel(self)
        self.range.setWordWrap(True)
        self.automatic = QPushButton("Automatic", self)
        self.automatic.setToolTip("Let the picture\u2019s near and far plane follow what is shown again")
        self.automatic.clicked.connect(self.automatic_asked)
        top = QHBoxLayout()
        top.setContentsMargins(8, 4, 8, 4)
        top.setSpacing(10)
        top.addWidget(self.space)
        top.addWidget(self.legend, 1)
        top.addWidget(fit)
        fixed = QHBoxLayout()
        fixed.setContentsMargins(8, 2, 8, 4)
        fixed.addWidget(self.range, 1)
        fixed.addWidget(self.automatic)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 4)
        layout.setSpacing(0)
        layout.addLayout(top)
        layout.addWidget(self.view, 1)
        layout.addWidget(self.lens)
        layout.addLayout(grid)
        layout.addLayout(fixed)
        self.show_clipping(None)

    def retint(self) -> None:
        inks = inks_now()
        self.legend.setText(
            f'<span style="color:{inks.inside}">\u2501</span> seen &nbsp;'
            f'<span style="color:{inks.outside}">\u2501</span> clipped &nbsp;'
            f'<span style="color:{inks.cut}">\u25a0</span> cut'
        )
        self.view.update()

    def show_planes(self, clips: dict[str, bool]) -> None:
        for plane, box in self.planes.items():
            box.blockSignals(True)
            box.setChecked(clips[plane])
            box.blockSignals(False)

    def show_clipping(self, clipping: tuple[float, float] | None) -> None:
        """The near and far plane that the picture has been given; None where they are automatic."""
        self.range.setVisible(clipping is not None)
        self.automatic.setVisible(clipping is not None)
        if clipping is not None:
            self.range.setText(f"The picture shows {clipping[0]:.5g} to {clipping[1]:.5g} mm before the eye.")
