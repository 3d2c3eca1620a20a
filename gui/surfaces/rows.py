"""Rows of the editors of materials and lights: numbers with sliders, colours, choices, ticks."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from PySide6.QtWidgets import QCheckBox, QComboBox, QVBoxLayout, QWidget

from ...model.document.document import Document
from ...model.document.errors import Refusal
from ...model.document.expression import Expression, number
from ...model.editing.session import Session
from ..panels.colour_field import ColourField
from ..panels.form import Form
from ..panels.number_field import Steps
from ..panels.property_edit import Edit, sentence
from ..panels.property_fields import NumberRow
from ..panels.words.value_slider import ValueSlider

FIELD_WIDTH = 62


def plain_number(value: str | float | None, what: str) -> float:
    """What a field of a material, a light or a mapping takes: sums are reckoned at once. Raises Refusal."""
    found = number("" if value is None else value, what)
    if not isinstance(found, Expression):
        return found
    try:
        return found.evaluate({})
    except Refusal:
        raise Refusal(f"{what} must be a plain number, without parameters") from None


class SliderRow(NumberRow):
    """A number row with a slider, whose `limits` (low, default, high) may be narrower than what the field takes."""

    def __init__(
        self, label: str, unit: str, steps: Steps, limits: tuple[float, float, float], edit: Edit, tip: str,
        parent: QWidget | None = None,
    ) -> None:  # fmt: skip
        super().__init__(label, unit, steps, edit.preview, edit.commit, edit.cancel, tip, parent=parent)
        self.slider = ValueSlider(limits, edit.preview, lambda value: self.tell(edit.commit(value)), edit.cancel, self)
        self.slider.setAccessibleName(label)
        self.slider.setToolTip(f"{tip}\nA double click goes back to {limits[1]:g}; Escape takes a drag back")
        self.field.setFixedWidth(FIELD_WIDTH)
        self.unit.setVisible(bool(unit))
        self.line.insertWidget(1, self.slider, 1)
        self.line.setStretch(2, 0)

    def show_number(self, value: float, previewing: bool) -> None:
        self.set_value(value, value)
        self.slider.show_number(value, previewing)


class MemberForm(Form):
    """Rows that show and change one member of the document by its `name`, a material or a light.

    `operation` changes fields of it, given by name. Rows are functions of the member.
    """

    def __init__(self, session: Session, operation: str, parent: QWidget | None = None) -> None:
        super().__init__(session, parent)
        self.name = ""
        self.member: Any = None
        self._operation = operation
        self.shows: list[Callable[[Any], None]] = []

    def show_member(self, member: Any) -> None:
        """Bring the rows up to date."""
        self.name, self.member = member.name, member
        for show in self.shows:
            show(member)

    def set_field(self, field: str, value: Any, label: str) -> bool:
        """Change a field as one step; a refusal goes to the status bar."""
        try:
            self.session.do(self._operation, self.name, label=label, **{field: value})
        except Refusal as refusal:
            self.session.cancel()
            self.refused.emit(sentence(refusal))
            self.show_member(self.member)
            return False
        return True

    @contextmanager
    def where(self, wanted: Callable[[Any], bool]) -> Iterator[None]:
        """Rows that are there where the member is `wanted` to have them."""
        body = QWidget(self)
        whole, self.column = self.column, QVBoxLayout(body)
        self.column.setContentsMargins(0, 0, 0, 0)
        self.column.setSpacing(whole.spacing())
        yield
        self.column = whole
        whole.addWidget(body)
        self.shows.append(lambda member: body.setVisible(wanted(member)))

    def edit(self, field: str, label: str, made: Callable[[Any], Any]) -> Edit:
        """Changes a field to what `made` makes of the value."""

        def keywords(document: Document, value: Any) -> dict[str, Any]:
            return {field: made(value)}

        return Edit(self.session, self._operation, f"Change {label}", lambda document, value: (self.name,),
                    keywords=keywords)  # fmt: skip

    def slider(
        self, field: str, label: str, limits: tuple[float, float, float], tip: str, steps: Steps, unit: str = ""
    ) -> SliderRow:
        edit = self.edit(field, label.lower(), lambda value: plain_number(value, f"the {label.lower()}"))
        row = SliderRow(label, unit, steps, limits, edit, tip, self)
        row.field.setObjectName(field)
        row.slider.setObjectName(f"{field}_slider")
        self.shows.append(lambda member: row.show_number(getattr(member, field), self.session.previewing))
        self.column.addWidget(row)
        return row

    def component(self, field: str, place: int, label: str, unit: str, steps: Steps, tip: str) -> NumberRow:
        """A row for one number of a vector."""

        def made(value: Any) -> tuple[float, ...]:
            old = list(getattr(self.member, field))
            old[place] = plain_number(value, f"the {field}")
            return tuple(old)

        edit = self.edit(field, field, made)
        row = NumberRow(label, unit, steps, edit.preview, edit.commit, edit.cancel, tip, parent=self)
        row.field.setObjectName(f"{field}_{'xyz'[place]}")

        def show(member: Any) -> None:
            value = round(getattr(member, field)[place], 4) + 0.0  # of a unit vector the rest says nothing
            row.set_value(value, value)

        self.shows.append(show)
        self.column.addWidget(row)
        return row

    def colour(self, field: str, label: str, tip: str, none: str = "") -> ColourField:
        row = ColourField(self.edit(field, label.lower(), lambda value: value), none, tip if none else "", self)
        row.text.setObjectName(field)
        row.text.setAccessibleName(label)
        row.swatch.setObjectName(f"{field}_swatch")
        self.shows.append(lambda member: row.set_colours({getattr(member, field)}))
        self.line(label, row, tip)
        return row

    def choice(self, field: str, label: str, options: tuple[tuple[str, str], ...], tip: str) -> QComboBox:
        """`options` are (value, words)."""
        box = combo(options, self)
        box.setObjectName(field)
        box.setAccessibleName(label)
        box.activated.connect(lambda: self.set_field(field, box.currentData(), f"Change {label.lower()}"))
        self.shows.append(lambda member: box.setCurrentIndex(box.findData(getattr(member, field))))
        self.line(label, box, tip)
        return box

    def tick(self, field: str, label: str, tip: str, change: Callable[[bool], object] | None = None) -> QCheckBox:
        """`change` does it in another way than by setting the field."""
        change = change or (lambda on: self.set_field(field, on, f"Change {label.lower()}"))
        box = QCheckBox(self)
        box.setObjectName(field)
        box.setAccessibleName(label)
        box.clicked.connect(lambda on: change(bool(on)))
        self.shows.append(lambda member: box.setChecked(getattr(member, field)))
        self.line(label, box, tip)
        return box


def combo(options: tuple[tuple[str, str], ...], parent: QWidget) -> QComboBox:
    """A list of (value, words) that may be narrow, and leaves the wheel to the panel until it has the focus."""
    box = PatientCombo(parent)
    for value, words in options:
        box.addItem(words, value)
    return box


class PatientCombo(QComboBox):
    """Does not change by the wheel that scrolls past it."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.setMinimumContentsLength(8)

    def wheelEvent(self, event: Any) -> None:
        if self.hasFocus():
            super().wheelEvent(event)
        else:
            event.ignore()
