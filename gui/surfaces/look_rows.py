"""Rows of a node's form: the material that it wears, and how bitmaps lie on it."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from PySide6.QtWidgets import QCheckBox, QComboBox, QHBoxLayout, QPushButton, QToolButton, QWidget

from ...model.document.document import Document, parameter_values
from ...model.document.errors import Refusal
from ...model.document.nodes import Node
from ...model.document.tree import find, trail, walk
from ...model.surface.mapping import PROJECTIONS, TextureMapping
from ...model.surface.material import PRESETS, Material
from ..icons import icon
from ..panels.form import Form
from ..panels.number_field import LENGTH, STEPS, Steps
from ..panels.property_edit import Edit, sentence
from .in_force import mapping_changes, mapping_in_force, material_in_force
from .rows import PatientCombo, combo, plain_number
from .steps import do_steps, new_material, put_checker
from .swatch import swatch

if TYPE_CHECKING:
    from PySide6.QtGui import QAction

SWATCH = 16  # pixels
NEW = "new:"
PROJECTION_WORDS = {
    "natural": "natural, as the primitive's faces are",
    "planar": "planar, along one direction",
    "box": "box, along x, y and z",
    "cylindrical": "cylindrical, around z",
    "spherical": "spherical, around z",
}
NUMBERS: tuple[tuple[str, str, str, int, Steps, str], ...] = (
    ("size", "Size", "mm", 2, Steps(1.0, 0.1, 10.0, 0.0, True), "Width and height of one copy of the bitmap"),
    ("offset", "Offset", "", 2, Steps(0.1, 0.01, 1.0), "By how many copies it is shifted"),
    ("scale", "Scale", "×", 2, STEPS["factor"], "How many times as large it is"),
    ("turn", "Turn", "°", 0, STEPS["angle"], "About the projection's origin"),
    ("origin", "Origin", "mm", 3, LENGTH, "Where the projection begins, in the node's axes"),
    ("turned", "Tilt", "°", 3, STEPS["angle"], "The projection's axes, turned about x, then y, then z"),
)
"""Field, label, unit, how many numbers (0: one that is no vector), steps, tip."""


class MaterialRow(PatientCombo):
    """The materials of the document, those of the presets, and none."""

    def __init__(self, form: Form, ids: list[str]) -> None:
        super().__init__(form)
        self._form, self._ids = form, ids
        self._shown: Any = None
        self.setObjectName("material")
        self.setAccessibleName("Material")
        self.activated.connect(self._choose)
        form.rows.append(self._refresh)
        form.line(
            "Material", self, "How its surface takes light, and the bitmap on it; it stays on its faces in every result"
        )

    def _refresh(self, node: Node, values: dict[str, float]) -> None:
        document = self._form.session.document
        if self._form.session.previewing and self._shown is not None:
            return
        wanted = set(self._ids)
        nodes = [node] if len(self._ids) == 1 else [one for one in walk(*document.roots) if one.id in wanted]
        worn = {str(one.material) for one in nodes}
        above = _from_above(document, self._ids[0]) if len(self._ids) == 1 else None
        shown = (document.materials, worn, above)
        if shown == self._shown:
            return
        self._shown = shown
        self.clear()
        self.addItem(f"as its parent: {above.name}" if above is not None else "none", "")
        for material in document.materials:
            self.addItem(swatch(material, SWATCH), material.name, material.name)
        self.insertSeparator(self.count())
        for preset, fields in PRESETS.items():
            self.addItem(swatch(Material(preset, **fields), SWATCH), f"New {preset.lower()}", NEW + preset)
        place = self.findData(next(iter(worn))) if len(worn) == 1 else -1
        self.setCurrentIndex(place)
        self.setPlaceholderText("several")

    def _choose(self) -> None:
        chosen = str(self.currentData() or "")
        session = self._form.session
        try:
            if chosen.startswith(NEW):
                preset = chosen.removeprefix(NEW)
                name, step = new_material(session.document, preset, preset=preset)
                do_steps(session, f"Put {name} on", [step, ("use_material", (self._ids, name), {})])
            else:
                label = f"Put {chosen} on" if chosen else "Take material off"
                session.do("use_material", self._ids, chosen or None, label=label)
        except Refusal as refusal:
            self._form.refused.emit(sentence(refusal))
            self._shown = None
            self._refresh(find(session.document, self._ids[0]), {})


class TextureForm(Form):
    """How bitmaps lie on one node, below a heading that folds it away."""

    def __init__(self, form: Form, node_id: str, placement: QAction | None = None) -> None:
        super().__init__(form.session, form)
        self._node_id = node_id
        self._kept: dict[str, Any] = {}
        self._now = TextureMapping()
        self.column.setContentsMargins(0, 0, 0, 0)
        self.refused.connect(form.refused)
        fold = QToolButton(form)
        fold.setObjectName("fold_texture")
        fold.setProperty("flat", True)
        fold.setCheckable(True)
        fold.setToolTip("How the bitmap lies on it")
        form.heading("Texture", fold)
        form.column.addWidget(self)
        form.rows.append(self.refresh)
        fold.toggled.connect(self._unfold)
        self._make(placement)
        self._fold = fold
        self._textured = self._is_textured()
        fold.setChecked(not self._textured)  # either way it is toggled
        fold.setChecked(self._textured)

    def _unfold(self, shown: bool) -> None:
        self._fold.setIcon(icon("unfolded" if shown else "folded"))
        self.setVisible(shown)
        if shown:
            document = self.session.document
            self.refresh(find(document, self._node_id), parameter_values(document.parameters)[0])

    def _make(self, placement: QAction | None) -> None:
        options = (("", "as its parent"), *((name, PROJECTION_WORDS[name]) for name in PROJECTIONS))
        projection = combo(options, self)
        projection.setObjectName("projection")
        projection.setAccessibleName("Projection")
        projection.activated.connect(lambda: self._project(projection.currentData()))
        self.rows.append(lambda node, values: self._show_projection(projection, node))
        self.line("Projection", projection, "Where each point of a face finds its place on the bitmap")
        for field, label, unit, count, steps, tip in NUMBERS:
            for place in range(count) if count else (None,):
                axis = "" if place is None else ("uv" if count == 2 else "xyz")[place]
                words = f"{'' if place else label} {axis}".strip()
                name = f"texture_{field}" + (f"_{axis}" if axis else "")
                self.number(name, words, unit, steps, self._edit(field, place), partial(self._value, field, place), tip)
            if field == "turn":
                self._mirror()
        self._buttons(placement)

    def _mirror(self) -> None:
        row = QWidget(self)
        line = QHBoxLayout(row)
        line.setContentsMargins(0, 0, 0, 0)
        line.setSpacing(16)
        boxes = []
        for place, axis in enumerate("uv"):
            box = QCheckBox(axis, row)
            box.setObjectName(f"texture_mirror_{axis}")
            box.setAccessibleName(f"Mirrored along {axis}")
            edit = self._edit("mirror", place)
            box.clicked.connect(lambda on, edit=edit: self.tell(edit.commit(bool(on))))
            line.addWidget(box)
            boxes.append(box)
        line.addStretch(1)

        def refresh(node: Node, values: dict[str, float]) -> None:
            for box, mirrored in zip(boxes, self._now.mirror, strict=True):
                box.setChecked(mirrored)

        self.rows.append(refresh)
        self.line("Mirrored", row, "Along the bitmap's width or height")

    def _buttons(self, placement: QAction | None) -> None:
        checker = QPushButton("Checker", self)
        checker.setObjectName("checker")
        checker.setToolTip("A test bitmap of squares A1 to H8, which shows how bitmaps lie on it")
        checker.clicked.connect(self._checker)
        row = QWidget(self)
        line = QHBoxLayout(row)
        line.setContentsMargins(0, 2, 0, 0)
        line.setSpacing(6)
        line.addWidget(checker)
        if placement is not None:
            place = QToolButton(row)
            place.setProperty("flat", True)
            place.setDefaultAction(placement)
            line.addWidget(place)
        line.addStretch(1)
        self.line("", row)

    def _is_textured(self) -> bool:
        document = self.session.document
        material = material_in_force(document, self._node_id)
        return find(document, self._node_id).mapping is not None or bool(material is not None and material.bitmaps)

    def _value(self, field: str, place: int | None, node: Node) -> float:
        value = getattr(self._now, field)
        return float(value if place is None else value[place])

    def _edit(self, field: str, place: int | None) -> Edit:
        def keywords(document: Document, value: Any) -> dict[str, Any]:
            new = value if field == "mirror" else plain_number(value, f"the texture's {field}")
            if place is not None:
                old = getattr(mapping_in_force(document, self._node_id), field)
                new = (*old[:place], new, *old[place + 1 :])
            return self._kept | {field: new}

        word = {"turned": "tilt"}.get(field, field)
        return Edit(self.session, "set_mapping", f"Change texture's {word}", lambda document, value: ([self._node_id],),
                    keywords=keywords)  # fmt: skip

    def refresh(self, node: Node, values: dict[str, float]) -> None:
        if not self.session.previewing:
            self._kept = mapping_changes(self.session.document, self._node_id)
            textured = self._is_textured()
            if textured and not self._textured:
                self._fold.setChecked(True)
            self._textured = textured
        if not self.isHidden():
            self._now = mapping_in_force(self.session.document, self._node_id)
            super().refresh(node, values)

    def _show_projection(self, box: QComboBox, node: Node) -> None:
        root = len(trail(self.session.document, self._node_id)) == 1
        words = "by default" if root else "as its parent"
        box.setItemText(0, f"{words}: {self._now.projection}" if node.mapping is None else words)
        box.setCurrentIndex(box.findData("" if node.mapping is None else node.mapping.projection))

    def _project(self, projection: str) -> None:
        if projection:
            self._do("Change texture's projection", projection=projection, **self._kept_without("projection"))
        else:
            self._do("Texture as its parent")

    def _kept_without(self, field: str) -> dict[str, Any]:
        return {key: value for key, value in self._kept.items() if key != field}

    def _do(self, label: str, **changes: Any) -> None:
        try:
            self.session.do("set_mapping", [self._node_id], label=label, **changes)
        except Refusal as refusal:
            self.refused.emit(sentence(refusal))

    def _checker(self) -> None:
        try:
            put_checker(self.session, [self._node_id])
        except Refusal as refusal:
            self.refused.emit(sentence(refusal))


def _from_above(document: Document, node_id: str) -> Material | None:
    """What a node wears where it wears nothing itself."""
    above = trail(document, node_id)[:-1]
    return material_in_force(document, above[-1].id) if above else None
