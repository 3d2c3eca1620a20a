"""The comparison of shadings: a coarse sphere, or the selected solid, in flat, Gouraud and Phong, and with bumps."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from math import cos, radians, sin
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import Qt
from PySide6.QtGui import QCloseEvent, QShowEvent, QStandardItemModel
from PySide6.QtWidgets import (
    QComboBox,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QMainWindow,
    QPushButton,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from ...model.document.document import Document
from ...model.document.primitives import Sphere
from ...model.document.resolve import Resolver
from ...model.document.tree import trail
from ...model.surface.light import PROGRAM, Light, lights_of
from ...model.surface.material import Material
from ..panels.words.value_slider import ValueSlider
from .board import Board, Picture
from .differences import Differences

if TYPE_CHECKING:
    from ...render.camera import Camera
    from ...render.surfaces.comparison import Comparison
    from ..window import MainWindow

NAMES = {"flat": "Flat", "gouraud": "Gouraud", "phong": "Phong", "bumps": "Phong with bumps"}
RADIUS = 10.0  # mm, of the sphere
SEGMENTS = (8, 12, 128)  # the fewest, at first, the most: octahedra cut finer, in steps of 4
SPHERE_MARGIN = 0.72  # a sphere is smaller than the box around it as it is seen
LEFT, ABOVE = -25.0, 25.0  # degrees: where the one light is at first, as the eye sees it


class ComparisonWindow(QMainWindow):
    """One for each main window. It changes nothing in the document but by the button that says so."""

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window, Qt.WindowType.Window)
        self.setObjectName("comparison_window")
        self.setWindowTitle("Compare shadings")
        self._window, self._session = window, window.session
        self._drawing: Comparison | None = None
        self._stale = True
        self._own_shine = True
        """Whether materials keep their highlights; those of the sphere without one are the sliders' in any case."""
        self._numbers: dict[ValueSlider, QLabel] = {}
        self.board = Board(self._draw, self._frame, self)
        self.board.show_names([*NAMES.values()])
        self.differences = Differences(self)
        self.board.drawn.connect(self._compare)
        self._lay_out()
        window.theme.changed.connect(self._theme)
        self._unlisten = self._session.on_change(lambda before, after: self._document_changed())
        window.evaluation.shown.connect(self._shown)
        self.resize(1080, 640)

    # What is shown.

    def show_model(self) -> None:
        """Of the selected solid where there is one, else the sphere."""
        self._fill_materials()
        self._offer_solid()
        self.model.setCurrentIndex(1 if self._solid() is not None and self._session.selection else 0)
        self.show()
        self.raise_()
        self.activateWindow()
        self.board.setFocus()

    def _solid(self) -> tuple[Any, Any] | None:
        """The resolved root that the selection stands in, or the first one, with its mesh."""
        document, latest = self._session.document, self._window.evaluation.latest
        if latest is None:
            return None
        wanted = [trail(document, node_id)[0].id for node_id in self._session.selection]
        for root in Resolver().resolve(document).solids:
            shown = latest.solids.get(root.id)
            if shown is not None and shown.mesh is not None and (root.id in wanted or not wanted):
                return root, shown.mesh
        return None

    def _lights(self) -> Sequence[Light]:
        if self.light.currentIndex() == 0:
            return lights_of(self._session.document.lights)
        across, up = radians(self.around.number), radians(self.above.number)
        towards = (sin(across) * cos(up), sin(up), cos(across) * cos(up))
        x, y, z = towards
        return (PROGRAM[0], Light("light", intensity=0.85, direction=(-x, -y, -z), with_camera=True))

    def _material(self) -> Material | None:
        """The one that was chosen; None for what the solid wears."""
        materials = self._session.document.materials
        place = self.material.currentIndex()
        return materials[place - 1] if 0 < place <= len(materials) else None

    def _changed_material(self, material: Material) -> Material:
        chosen, sphere = self._material(), self.model.currentIndex() == 0
        shine = material
        if not self._own_shine or (sphere and chosen is None):
            shine = material.with_(specular=self.specular.number, shininess=self.shininess.number)
        if chosen is None or sphere:
            return shine
        kept = {field: getattr(material, field) for field in ("bump", "bump_kind", "bump_height")}
        if not self._own_shine:
            kept |= {"specular": shine.specular, "shininess": shine.shininess}
        return chosen.with_(shading="", **kept)

    def _columns(self) -> list[Any]:
        from ...render.surfaces.comparison import columns_of

        solid = self._solid() if self.model.currentIndex() == 1 else None
        if solid is not None:
            return columns_of(self._session.document, [solid], change=self._changed_material)
        from ...model.solid.results import evaluate_document

        worn = self._material()
        ball = Sphere(radius=RADIUS, segments=self.segments.value(), name="ball")
        document = Document(solids=(ball,))
        if worn is not None:
            document = document.with_(materials=(worn,), solids=(ball.with_(material=worn.name),))
        evaluation = evaluate_document(document)
        (result,) = evaluation.solids
        mesh = evaluation.display(result)
        assert mesh is not None  # of a sphere
        return columns_of(document, [(result.root, mesh)], change=self._changed_material)

    def _comparison(self) -> Comparison:
        from ...render.look import look_of
        from ...render.surfaces.comparison import Comparison

        if self._drawing is None:
            self._drawing = Comparison(look_of(self._window.theme.name))
        if self._stale:
            self._stale = False
            self._drawing.show(self._columns(), self._lights())
        return self._drawing

    def _frame(self, aspect: float) -> Camera:
        from ...render.camera import Camera, fit
        from ...render.views import standard_view

        viewer = self._window.viewport.viewer
        seen = self.model.currentIndex() == 1 and viewer is not None
        camera = viewer.camera if seen and viewer is not None else standard_view(Camera(), "iso")
        return fit(camera, self._comparison().bounds(), aspect, 1.08 if seen else SPHERE_MARGIN)

    def _draw(self, camera: Camera, size: tuple[int, int]) -> list[Picture]:
        return self._comparison().draw(camera, size)

    def _compare(self) -> None:
        from ...render.surfaces.comparison import difference

        found = [difference(one, other) for one, other in pairwise(self.board.pictures)]
        self.differences.show_differences([f"{one} against {other}" for one, other in pairwise(NAMES.values())], found)

    # The controls.

    def _lay_out(self) -> None:
        self.model = self._choice("model", "Model", ["A sphere", "A solid of the document"])
        self.segments = QSpinBox(self)
        self.segments.setObjectName("segments")
        self.segments.setRange(SEGMENTS[0], SEGMENTS[2])
        self.segments.setSingleStep(4)
        self.segments.setValue(SEGMENTS[1])
        self.segments.setKeyboardTracking(False)
        self.segments.setToolTip("Faces around the sphere: the fewer, the more the shadings differ")
        self.segments.valueChanged.connect(self._show_again)
        self.material = self._choice("material", "Material", ["Its own"])
        self.material.activated.connect(self._take_numbers)
        self.specular, specular = self._slider("specular", "Highlight", (0.0, 0.5, 1.0), "rs: its share of white")
        self.shininess, shininess = self._slider("shininess", "Shininess", (1.0, 24.0, 200.0), "f: the exponent")
        self.light = self._choice("light", "Light", ["Of the document", "One light"])
        self.around, around = self._slider("around", "To the right", (-90.0, LEFT, 90.0), "degrees, as the eye sees it")
        self.above, above = self._slider("above", "Upwards", (-90.0, ABOVE, 90.0), "degrees, as the eye sees it")
        self.use = QComboBox(self)
        self.use.setObjectName("use")
        self.use.addItems([NAMES[name] for name in ("flat", "gouraud", "phong")])
        self.use.setCurrentIndex(2)
        button = QPushButton("Use in the document", self)
        button.setToolTip("Shade the document's solids so, where their materials say nothing else; can be undone")
        button.clicked.connect(self._use)
        forms = QGridLayout()
        forms.setContentsMargins(12, 8, 12, 10)
        forms.setHorizontalSpacing(10)
        forms.setVerticalSpacing(6)
        columns: tuple[tuple[tuple[str, QWidget], ...], ...] = (
            (("Model", self.model), ("Segments", self.segments), ("Material", self.material)),
            (("Highlight", specular), ("Shininess", shininess)),
            (("Light", self.light), ("To the right", around), ("Upwards", above)),
            (("Shading", self.use), ("", button)),
        )
        for column, rows in enumerate(columns):
            forms.setColumnStretch(2 * column + 1, 1)
            for row, (words, widget) in enumerate(rows):
                label = QLabel(words, self)
                label.setProperty("muted", True)
                label.setContentsMargins(14 if column else 0, 0, 0, 0)
                forms.addWidget(label, row, 2 * column, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
                forms.addWidget(widget, row, 2 * column + 1)
        hint = QLabel(
            "Flat: one intensity a face. Gouraud: at the vertices, interpolated; a highlight inside a face is lost. "
            "Phong: at every pixel. The controls count in this window only.",
            self,
        )
        hint.setProperty("muted", True)
        hint.setWordWrap(True)
        hint.setContentsMargins(12, 0, 12, 8)
        central = QWidget(self)
        down = QVBoxLayout(central)
        down.setContentsMargins(0, 0, 0, 0)
        down.setSpacing(0)
        down.addWidget(self.board, 3)
        down.addWidget(self.differences, 2)
        down.addLayout(forms)
        down.addWidget(hint)
        self.setCentralWidget(central)
        self._show_controls()

    def _choice(self, name: str, words: str, items: list[str]) -> QComboBox:
        box = QComboBox(self)
        box.setObjectName(name)
        box.setAccessibleName(words)
        box.addItems(items)
        box.activated.connect(self._chosen)
        return box

    def _slider(
        self, name: str, words: str, limits: tuple[float, float, float], tip: str
    ) -> tuple[ValueSlider, QWidget]:
        row = QWidget(self)
        line = QHBoxLayout(row)
        line.setContentsMargins(0, 0, 0, 0)
        number = QLabel(f"{limits[1]:g}", row)
        number.setMinimumWidth(34)
        slider = ValueSlider(limits, self._slid, self._slid, lambda: None, row)
        slider.setMinimumWidth(70)
        self._numbers[slider] = number
        slider.setObjectName(name)
        slider.setAccessibleName(words)
        slider.setToolTip(f"{tip}\nA double click goes back to {limits[1]:g}")
        slider.show_number(limits[1], False)
        line.addWidget(slider, 1)
        line.addWidget(number)
        return slider, row

    def _chosen(self) -> None:
        self._show_controls()
        self.board.fit()
        self._show_again()

    def _slid(self, value: float) -> None:
        self._own_shine = False
        self._show_numbers()
        self._show_again()

    def _show_numbers(self) -> None:
        for slider, number in self._numbers.items():
            number.setText(f"{slider.number:g}")

    def _take_numbers(self) -> None:
        """Those of the material that is chosen count until a slider is moved."""
        chosen, self._own_shine = self._material(), True
        if chosen is not None:
            self.specular.show_number(chosen.specular, False)
            self.shininess.show_number(chosen.shininess, False)
        self._show_numbers()

    def _show_controls(self) -> None:
        self.segments.setEnabled(self.model.currentIndex() == 0)
        own = self.light.currentIndex() == 1
        self.around.setEnabled(own)
        self.above.setEnabled(own)

    def _fill_materials(self) -> None:
        place = self.material.currentText()
        self.material.clear()
        self.material.addItems(["Its own", *(material.name for material in self._session.document.materials)])
        self.material.setCurrentIndex(max(self.material.findText(place), 0))

    def _offer_solid(self) -> None:
        """The solid can be chosen where there is one."""
        items = self.model.model()
        assert isinstance(items, QStandardItemModel)
        there = self._solid() is not None
        items.item(1).setEnabled(there)
        items.item(1).setToolTip("" if there else "The document shows no solid")
        if not there and self.model.currentIndex() == 1:
            self.model.setCurrentIndex(0)
            self._show_controls()
            self.board.fit()

    def _document_changed(self) -> None:
        if self.isVisible():
            self._fill_materials()
        self._show_again()

    def _shown(self, *_: object) -> None:
        self._offer_solid()
        self._show_again()

    def _show_again(self, *_: object) -> None:
        self._stale = True
        self.board.redraw()

    def _theme(self, name: str) -> None:
        from ...render.look import look_of

        if self._drawing is not None:
            self._drawing.set_look(look_of(name))
        self.board.redraw()

    def _use(self) -> None:
        name = ("flat", "gouraud", "phong")[self.use.currentIndex()]
        self._session.do("set_shading", name, label=f"{NAMES[name]} shading")

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self._show_again()

    def closeEvent(self, event: QCloseEvent) -> None:
        super().closeEvent(event)
        if self._drawing is not None:
            self._drawing.close()
            self._drawing = None
        self._stale = True

    def end(self) -> None:
        """Before the main window goes."""
        self._unlisten()
        self.close()


def open_comparison(window: MainWindow) -> None:
    window.side_windows.of(ComparisonWindow).show_model()
