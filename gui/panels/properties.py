"""The form of what is selected, made from the fields of its kind: values, placement, look and measures."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QFrame,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QMenu,
    QPlainTextEdit,
    QScrollArea,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from ...model.document.document import Document, parameter_values
from ...model.document.errors import Refusal
from ...model.document.expression import Number, resolved
from ...model.document.fields import FieldSpec
from ...model.document.nodes import Node, field_specs
from ...model.document.placement import Affine, Move, Reflect, Scale, Step, Turn
from ...model.document.session import Session, State
from ...model.document.tree import find, walk
from ..icons import icon, kind_icon
from .colour_field import ColourField
from .measures import MeasuresView
from .property_edit import Edit, field_edit, position_edit, sentence, step_edit, with_step
from .property_fields import LABEL_WIDTH, LENGTH, STEPS, NumberRow, Steps

STEP_KINDS: tuple[tuple[str, str, Step], ...] = (
    ("Turn", "Degrees about x, then y, then z", Turn((0.0, 0.0, 0.0))),
    ("Scale", "Factors along x, y and z", Scale((1.0, 1.0, 1.0))),
    ("Mirror", "The normal of the mirror's plane through the origin", Reflect((1.0, 0.0, 0.0))),
    ("Matrix", "A (3, 4) affine matrix, row by row", Affine((1.0, 0, 0, 0, 0, 1.0, 0, 0, 0, 0, 1.0, 0))),
    ("Move", "Millimetres along x, y and z", Move((0.0, 0.0, 0.0))),
)
STEP_STEPS = {Turn: STEPS["angle"], Scale: STEPS["factor"], Move: LENGTH, Reflect: STEPS["direction"]}


class Properties(QScrollArea):
    """Follows the selection. A change of values keeps the form and the focus in it; another kind makes a new form."""

    refused = Signal(str)

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("properties")
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self._session = session
        self._shape: Any = None
        self._rows: list[Callable[[Node, dict[str, float]], None]] = []
        self.measures = MeasuresView()
        self._build()

    def session_changed(self, before: State, after: State) -> None:
        shape = self._shape_of(after)
        if shape != self._shape:
            self._build()
        else:
            self._refresh(after.document)

    def _shape_of(self, state: State) -> Any:
        """What decides which rows the form has."""
        if len(state.selection) != 1:
            return state.selection
        try:
            node = find(state.document, state.selection[0])
        except Refusal:
            return ()
        steps = tuple(type(step) for step in node.placement.steps)
        extra = steps[:-1] if steps and steps[-1] is Move else steps
        return node.id, type(node), extra

    def _refresh(self, document: Document) -> None:
        if self._session.selection and self._rows:
            node = find(document, self._session.selection[0])
            values = parameter_values(document.parameters)[0]
            for row in self._rows:
                row(node, values)

    def _build(self) -> None:
        self._shape = self._shape_of(self._session.state)
        self._rows = []
        self.measures.setParent(None)
        form = QWidget(self)
        self._layout = QVBoxLayout(form)
        self._layout.setContentsMargins(12, 12, 12, 12)
        self._layout.setSpacing(6)
        selection = self._session.selection
        if not selection:
            self._empty()
        elif len(selection) == 1:
            self._single(find(self._session.document, selection[0]))
        else:
            self._several(selection)
        self._layout.addStretch(1)
        old = self.takeWidget()
        self.setWidget(form)
        if old is not None:
            old.deleteLater()
        self._refresh(self._session.document)

    # The three forms.

    def _empty(self) -> None:
        words = QLabel("Nothing is selected.\nClick a face in the picture or a row of the tree.", self)
        words.setProperty("muted", True)
        words.setWordWrap(True)
        words.setAlignment(Qt.AlignmentFlag.AlignHCenter)
        self._layout.addSpacing(24)
        self._layout.addWidget(words)

    def _several(self, ids: tuple[str, ...]) -> None:
        self._heading(f"{len(ids)} nodes")
        self._look(list(ids))
        self._measures()

    def _single(self, node: Node) -> None:
        name = QLineEdit(self)
        name.setObjectName("name")
        name.setPlaceholderText(node.title)
        name.setAccessibleName("Name")
        name.setToolTip("<b>Name</b>&nbsp;&nbsp;F2 in the tree")
        name.editingFinished.connect(partial(self._rename, node.id, name))
        picture = QLabel(self)
        picture.setPixmap(kind_icon(type(node)).pixmap(20, 20))
        picture.setToolTip(node.title)
        line = QHBoxLayout()
        line.setSpacing(8)
        line.addWidget(picture)
        line.addWidget(name, 1)
        self._layout.addLayout(line)
        self._rows.append(lambda node, values: None if name.hasFocus() and name.isModified() else name.setText(node.name))
        specs = field_specs(type(node))
        if specs:
            self._heading(node.title)
        for spec in specs:
            self._field(node.id, spec)
        self._placement(node)
        self._look([node.id])
        self._note(node.id)
        self._measures()

    # Parts of a form.

    def _heading(self, text: str, button: QToolButton | None = None) -> None:
        label = QLabel(text, self)
        label.setProperty("heading", True)
        line = QHBoxLayout()
        line.setContentsMargins(0, 10, 0, 0)
        line.addWidget(label, 1)
        if button is not None:
            line.addWidget(button)
        self._layout.addLayout(line)

    def _line(self, label: str, *widgets: QWidget, tip: str = "") -> QLabel:
        words = QLabel(label, self)
        words.setProperty("muted", True)
        words.setFixedWidth(LABEL_WIDTH)
        words.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        words.setToolTip(tip)
        line = QHBoxLayout()
        line.setSpacing(8)
        line.addWidget(words)
        for widget in widgets:
            widget.setToolTip(widget.toolTip() or tip)
            line.addWidget(widget)
        line.setStretch(1, 1)
        self._layout.addLayout(line)
        return words

    def _number(self, label: str, unit: str, steps: Steps, edit: Edit, value: Callable[[Node], Number | None], *,
                tip: str = "", optional: bool = False, name: str = "") -> None:  # fmt: skip
        row = NumberRow(label, unit, steps, edit.preview, edit.commit, edit.cancel, tip, optional, self)
        row.field.setObjectName(name)

        def refresh(node: Node, values: dict[str, float]) -> None:
            now = value(node)
            try:
                number = None if now is None else resolved(now, values)
            except Refusal:
                number = None
            row.set_value(now, number)

        self._rows.append(refresh)
        self._layout.addWidget(row)

    def _field(self, node_id: str, spec: FieldSpec) -> None:
        steps = STEPS.get(spec.type, LENGTH)
        steps = Steps(steps.plain, steps.fine, steps.coarse, spec.minimum, spec.above)
        if spec.dimension == 1:
            edit = field_edit(self._session, node_id, spec)
            self._number(spec.label, spec.unit, steps, edit, lambda node: getattr(node, spec.name), tip=spec.tip,
                         optional=spec.optional, name=spec.name)  # fmt: skip
        elif spec.dimension == 3:
            for i, axis in enumerate("xyz"):
                edit = field_edit(self._session, node_id, spec, i)
                self._number(f"{spec.label} {axis}" if i == 0 else axis, spec.unit, steps, edit,
                             lambda node, i=i: getattr(node, spec.name)[i], tip=spec.tip, name=f"{spec.name}_{axis}")  # fmt: skip
        elif spec.type == "flag":
            box = QCheckBox(self)
            box.setObjectName(spec.name)
            box.setAccessibleName(spec.label)
            box.clicked.connect(lambda on: self._do(field_edit(self._session, node_id, spec), on))
            self._rows.append(lambda node, values: box.setChecked(getattr(node, spec.name)))
            self._line(spec.label, box, tip=spec.tip)
        else:
            words = QLabel(self)
            words.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
            self._rows.append(lambda node, values: words.setText(_summary(getattr(node, spec.name), spec)))
            self._line(spec.label, words, tip=spec.tip)

    def _placement(self, node: Node) -> None:
        more = QToolButton(self)
        more.setObjectName("add_step")
        more.setProperty("flat", True)
        more.setIcon(icon("add"))
        more.setToolTip("Add a turn, a scaling, a mirroring or a matrix")
        more.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        menu = QMenu(more)
        menu.setToolTipsVisible(True)
        for title, tip, step in STEP_KINDS:
            action = menu.addAction(title, partial(self._add_step, node.id, step))
            action.setToolTip(tip)
        more.setMenu(menu)
        self._heading("Placement", more)
        for i, axis in enumerate("xyz"):
            edit = position_edit(self._session, node.id, i)
            self._number(f"Position {axis}" if i == 0 else axis, "mm", LENGTH, edit,
                         lambda node, i=i: node.placement.position[i], tip="Where it stands in its parent",
                         name=f"position_{axis}")  # fmt: skip
        steps = node.placement.steps
        for place, step in enumerate(steps[:-1] if steps and isinstance(steps[-1], Move) else steps):
            self._step(node.id, place, step)

    def _step(self, node_id: str, place: int, step: Step) -> None:
        remove = QToolButton(self)
        remove.setObjectName(f"remove_step_{place}")
        remove.setProperty("flat", True)
        remove.setIcon(icon("close"))
        remove.setToolTip("Remove this step")
        remove.clicked.connect(partial(self._remove_step, node_id, place))
        word = next(title for title, _, example in STEP_KINDS if type(example) is type(step))
        labels = "xyz" if step.length == 3 else [f"{row}{column}" for row in "xyz" for column in ("x", "y", "z", " move")]
        steps = STEP_STEPS.get(type(step), STEPS["factor"])
        unit = {Turn: "°", Move: "mm"}.get(type(step), "")
        words = QLabel(f"{place + 1} · {word}", self)
        words.setProperty("muted", True)
        words.setToolTip("Steps are applied in this order, the position last")
        line = QHBoxLayout()
        line.addWidget(words, 1)
        line.addWidget(remove)
        self._layout.addLayout(line)
        for i, label in enumerate(labels):
            edit = step_edit(self._session, node_id, place, i)
            self._number(f"{word} {label}" if i == 0 else label, unit, steps, edit,
                         lambda node, i=i: node.placement.steps[place].numbers[i], name=f"step_{place}_{i}")  # fmt: skip

    def _look(self, ids: list[str]) -> None:
        self._heading("Look")
        box = QCheckBox(self)
        box.setObjectName("visible")
        box.setAccessibleName("Visible")
        box.clicked.connect(lambda on: self._do_words("set_visible", "Show" if on else "Hide", ids, bool(on)))
        colour = ColourField(self._session, ids, self)

        def refresh(node: Node, values: dict[str, float]) -> None:
            nodes = [n for n in walk(*self._session.document.roots) if n.id in set(ids)] if len(ids) > 1 else [node]
            shown = {n.visible for n in nodes}
            box.setTristate(len(shown) > 1)
            mixed = Qt.CheckState.PartiallyChecked
            box.setCheckState(mixed if len(shown) > 1 else Qt.CheckState.Checked if True in shown else Qt.CheckState.Unchecked)
            colour.set_colours({n.colour for n in nodes})

        self._rows.append(refresh)
        self._line("Visible", box, tip="Shown, or hidden and still part of what it stands in")
        self._line("Colour", colour, tip="It stays on its faces in every result")

    def _note(self, node_id: str) -> None:
        note = QPlainTextEdit(self)
        note.setObjectName("note")
        note.setProperty("field", True)
        note.setPlaceholderText("A note to the reader")
        note.setAccessibleName("Note")
        note.setTabChangesFocus(True)
        note.setFixedHeight(56)
        note.installEventFilter(self)
        note.setProperty("node", node_id)
        self._rows.append(lambda node, values: None if note.hasFocus() else _set_text(note, node.note))
        self._line("Note", note)

    def _measures(self) -> None:
        self._heading("Measures of the solid", self.measures.copy_button)
        self._layout.addWidget(self.measures)
        self.measures.show()

    # What the forms do.

    def _rename(self, node_id: str, field: QLineEdit) -> None:
        if field.isModified():
            field.setModified(False)
            self._do_words("rename", "Rename", node_id, field.text())
            self._refresh(self._session.document)

    def _add_step(self, node_id: str, step: Step) -> None:
        steps = with_step(find(self._session.document, node_id), step)
        self._do_words("place", "Change placement", node_id, *steps)

    def _remove_step(self, node_id: str, place: int) -> None:
        steps = find(self._session.document, node_id).placement.steps
        self._do_words("place", "Change placement", node_id, *steps[:place], *steps[place + 1 :])

    def _do(self, edit: Edit, value: Any) -> None:
        fault = edit.commit(value)
        if fault:
            self.refused.emit(fault)
            self._refresh(self._session.document)

    def _do_words(self, operation: str, label: str, *arguments: Any) -> None:
        try:
            self._session.do(operation, *arguments, label=label)
        except Refusal as refusal:
            self.refused.emit(sentence(refusal))

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.FocusOut and isinstance(watched, QPlainTextEdit):
            self._do_words("set_note", "Change note", watched.property("node"), watched.toPlainText())
        return super().eventFilter(watched, event)


def _set_text(note: QPlainTextEdit, text: str) -> None:
    if note.toPlainText() != text:
        note.setPlainText(text)


def _summary(value: Any, spec: FieldSpec) -> str:
    if spec.type in ("points", "faces"):
        return f"{len(value)}"
    text = str(value)
    return text if len(text) <= 24 else text[:12] + "…"
