"""The form of one node, made from the fields of its kind, and what several selected nodes share."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QCheckBox, QHBoxLayout, QLabel, QMenu, QPlainTextEdit, QToolButton, QWidget

from ...model.document.fields import FieldSpec
from ...model.document.nodes import Node, field_specs
from ...model.document.outlines import OUTLINES, Lettering
from ...model.document.placement import Affine, Move, Reflect, Scale, Step, Turn
from ...model.document.tree import find, walk
from ...model.editing.session import Session
from ..icons import icon, kind_icon
from ..normals.crease_row import CreaseRow
from ..surfaces.look_rows import MaterialRow, TextureForm
from .colour_field import ColourField
from .form import Form
from .number_field import LENGTH, STEPS, Steps
from .outline_words import field_words, measured_words
from .property_edit import Edit, field_edit, position_edit, step_edit, with_step
from .text_line import TextLine
from .words.lettering_rows import ROWS, slant_slider
from .words.text_rows import text_row

STEP_KINDS: tuple[tuple[str, str, Step], ...] = (
    ("Turn", "Degrees about x, then y, then z", Turn((0.0, 0.0, 0.0))),
    ("Scale", "Factors along x, y and z", Scale((1.0, 1.0, 1.0))),
    ("Mirror", "The normal of the mirror's plane through the origin", Reflect((1.0, 0.0, 0.0))),
    ("Matrix", "A (3, 4) affine matrix, row by row", Affine((1.0, 0, 0, 0, 0, 1.0, 0, 0, 0, 0, 1.0, 0))),
    ("Move", "Millimetres along x, y and z", Move((0.0, 0.0, 0.0))),
)
STEP_STEPS = {Turn: STEPS["angle"], Scale: STEPS["factor"], Move: LENGTH, Reflect: STEPS["direction"]}


def extra_steps(node: Node) -> tuple[Step, ...]:
    """The placement's steps without the move that is the position."""
    steps = node.placement.steps
    return steps[:-1] if steps and isinstance(steps[-1], Move) else steps


class NodeForm(Form):
    def __init__(self, session: Session, placement: QAction | None = None, parent: QWidget | None = None) -> None:
        """`placement` is the command that shows how a texture lies."""
        super().__init__(session, parent)
        self._texture_placement = placement

    def build(self, node: Node) -> None:
        """Name, fields, placement, look and note of one node."""
        self._name(node)
        specs = field_specs(type(node))
        if specs:
            self.heading(node.title)
        for spec in specs:
            silent = spec.type in ("letters", "splines")  # they say nothing to a reader; the points' row sums them up
            by_name = isinstance(node, Lettering) and not node.asset and spec.name in ("asset", "face")
            if silent or by_name:
                continue
            if isinstance(node, Lettering) and spec.name in ROWS:
                ROWS[spec.name](self, node.id, spec)
                continue
            self._field(node.id, spec)
            if isinstance(node, Lettering) and spec.name == "slant":
                slant_slider(self, node.id, spec)
        if isinstance(node, OUTLINES):
            self._measures()
        self._placement(node)
        self.build_look([node.id], not isinstance(node, OUTLINES))
        self._note(node.id)
        if not isinstance(node, OUTLINES):
            TextureForm(self, node.id, self._texture_placement)

    def build_look(self, ids: list[str], surfaces: bool = True) -> None:
        """Visibility and colour, which all kinds of nodes have, and what is the surface's of those with `surfaces`."""
        self.heading("Look")
        box = QCheckBox(self)
        box.setObjectName("visible")
        box.setAccessibleName("Visible")
        box.clicked.connect(lambda on: self.do("set_visible", "Show" if on else "Hide", ids, bool(on)))
        edit = Edit(self.session, "set_colour", "Change colour", lambda document, colour: (ids, colour))
        colour = ColourField(edit, "as the solid", "empty: that of what it stands in", self)
        wanted = set(ids)

        def refresh(node: Node, values: dict[str, float]) -> None:
            nodes = [node] if len(ids) == 1 else [n for n in walk(*self.session.document.roots) if n.id in wanted]
            shown = {n.visible for n in nodes}
            box.setTristate(len(shown) > 1)
            states = Qt.CheckState
            whole = states.Checked if True in shown else states.Unchecked
            box.setCheckState(states.PartiallyChecked if len(shown) > 1 else whole)
            colour.set_colours({n.colour for n in nodes})

        self.rows.append(refresh)
        self.line("Visible", box, "Shown, or hidden and still part of what it stands in")
        self.line("Colour", colour, "It stays on its faces in every result")
        if surfaces:
            MaterialRow(self, ids)
            CreaseRow(self, ids)

    def _name(self, node: Node) -> None:
        name = TextLine(parent=self)
        name.setObjectName("name")
        name.setPlaceholderText(node.title)
        name.setAccessibleName("Name")
        name.setToolTip("<b>Name</b>&nbsp;&nbsp;F2 in the tree")
        picture = QLabel(self)
        picture.setPixmap(kind_icon(type(node)).pixmap(20, 20))
        picture.setToolTip(node.title)
        line = QHBoxLayout()
        line.setSpacing(8)
        line.addWidget(picture)
        line.addWidget(name, 1)
        self.column.addLayout(line)

        def rename() -> None:
            if name.isModified():
                name.setModified(False)
                if not self.do("rename", "Rename", node.id, name.text()):
                    name.setText(find(self.session.document, node.id).name)

        def refresh(node: Node, values: dict[str, float]) -> None:
            if not (name.hasFocus() and name.isModified()) and name.text() != node.name:
                name.setText(node.name)

        name.editingFinished.connect(rename)
        self.rows.append(refresh)

    def _field(self, node_id: str, spec: FieldSpec) -> None:
        steps = STEPS.get(spec.type, LENGTH)
        steps = Steps(steps.plain, steps.fine, steps.coarse, spec.minimum, spec.above)
        if spec.dimension == 1:
            edit = field_edit(self.session, node_id, spec)
            self.number(spec.name, spec.label, spec.unit, steps, edit, lambda node: getattr(node, spec.name),
                        tip=spec.tip, optional=spec.optional)  # fmt: skip
        elif spec.dimension == 3:
            for i, axis in enumerate("xyz"):
                label = f"{spec.label} {axis}" if i == 0 else axis
                edit = field_edit(self.session, node_id, spec, i)
                self.number(f"{spec.name}_{axis}", label, spec.unit, steps, edit,
                            lambda node, i=i: getattr(node, spec.name)[i], tip=spec.tip)  # fmt: skip
        elif spec.type == "choice" or spec.editor:
            self.line(spec.label, text_row(self, node_id, spec), spec.tip)
        elif spec.type == "flag":
            box = QCheckBox(self)
            box.setObjectName(spec.name)
            box.setAccessibleName(spec.label)
            box.clicked.connect(
                lambda on: self.do("set_field", f"Change {spec.label.lower()}", node_id, spec.name, bool(on))
            )
            self.rows.append(lambda node, values: box.setChecked(getattr(node, spec.name)))
            self.line(spec.label, box, spec.tip)
        else:
            words = QLabel(self)
            words.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
            self.rows.append(lambda node, values: words.setText(field_words(node, spec)))
            self.line(spec.label, words, spec.tip)

    def _measures(self) -> None:
        """Length and area of an outline, which do not follow every picture of a drag."""
        length, area = QLabel(self), QLabel(self)
        shown = b""
        for name, label, tip in (("length", length, "Of all contours"), ("area", area, "Of what is filled")):
            label.setObjectName(f"outline_{name}")
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
            self.line(name.capitalize(), label, tip)

        def refresh(node: Node, values: dict[str, float]) -> None:
            nonlocal shown
            if not self.session.previewing and (node.symbolic or node.shape_digest != shown):
                shown = node.shape_digest
                words = measured_words(node, values, self.session.view.fonts)
                length.setText(words[0])
                area.setText(words[1])

        self.rows.append(refresh)

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
        self.heading("Placement", more)
        for i, axis in enumerate("xyz"):
            edit = position_edit(self.session, node.id, i)
            self.number(f"position_{axis}", f"Position {axis}" if i == 0 else axis, "mm", LENGTH, edit,
                        lambda node, i=i: node.placement.position[i], tip="Where it stands in its parent")  # fmt: skip
        for place, step in enumerate(extra_steps(node)):
            self._step(node.id, place, step)

    def _step(self, node_id: str, place: int, step: Step) -> None:
        word = next(title for title, _, example in STEP_KINDS if type(example) is type(step))
        remove = QToolButton(self)
        remove.setObjectName(f"remove_step_{place}")
        remove.setProperty("flat", True)
        remove.setIcon(icon("close"))
        remove.setToolTip(f"Remove this {word.lower()}")
        remove.clicked.connect(partial(self._remove_step, node_id, place))
        words = QLabel(f"{place + 1}  {word}", self)
        words.setProperty("muted", True)
        words.setToolTip("Steps are applied in this order, the position last")
        line = QHBoxLayout()
        line.addWidget(words, 1)
        line.addWidget(remove)
        self.column.addLayout(line)
        labels = "xyz" if step.length == 3 else [row + column for row in "xyz" for column in ("x", "y", "z", " move")]
        steps = STEP_STEPS.get(type(step), STEPS["factor"])
        unit = {Turn: "°", Move: "mm"}.get(type(step), "")
        for i, label in enumerate(labels):
            edit = step_edit(self.session, node_id, place, i)
            self.number(f"step_{place}_{i}", f"{word} {label}" if i == 0 else label, unit, steps, edit,
                        lambda node, i=i: node.placement.steps[place].numbers[i])  # fmt: skip

    def _add_step(self, node_id: str, step: Step) -> None:
        self.do("place", "Change placement", node_id, *with_step(find(self.session.document, node_id), step))

    def _remove_step(self, node_id: str, place: int) -> None:
        steps = find(self.session.document, node_id).placement.steps
        self.do("place", "Change placement", node_id, *steps[:place], *steps[place + 1 :])

    def _note(self, node_id: str) -> None:
        note = QPlainTextEdit(self)
        note.setObjectName("note")
        note.setProperty("field", True)
        note.setProperty("node", node_id)
        note.setPlaceholderText("A note to the reader")
        note.setAccessibleName("Note")
        note.setTabChangesFocus(True)
        note.document().setDocumentMargin(2)
        note.installEventFilter(self)

        def refresh(node: Node, values: dict[str, float]) -> None:
            if not note.hasFocus() and note.toPlainText() != node.note:
                note.setPlainText(node.note)
                note.document().setModified(False)
            lines = min(max(note.toPlainText().count("\n") + 1, -(-len(note.toPlainText()) // 22)), 6)
            note.setFixedHeight(max(2, lines) * note.fontMetrics().lineSpacing() + 16)

        self.rows.append(refresh)
        self.line("Note", note)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        left = event.type() == QEvent.Type.FocusOut and not watched.signalsBlocked()
        if left and isinstance(watched, QPlainTextEdit) and watched.document().isModified():
            watched.document().setModified(False)
            self.do("set_note", "Change note", watched.property("node"), watched.toPlainText())
        return super().eventFilter(watched, event)
