"""The rows of lettering that know its font: the font itself, its axes and features, and a slider for the slant."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtWidgets import QHBoxLayout, QLabel

from ....model.document.expression import resolved
from ....model.document.fields import FieldSpec
from ....model.document.nodes import Node
from ..property_edit import field_edit
from ..property_fields import LABEL_WIDTH, UNIT_WIDTH
from .axis_rows import AxisRows
from .chain_line import ChainLine
from .feature_row import FeatureRow
from .font_row import FontRow
from .value_slider import ValueSlider

if TYPE_CHECKING:
    from ..form import Form

LEAN = 30.0
"""Degrees of slant that the slider reaches to both sides."""


def font_rows(form: Form, node_id: str, spec: FieldSpec) -> None:
    """The font, and below it what the text takes from others."""
    form.line(spec.label, FontRow(form, node_id, spec), spec.tip)
    form.line("", ChainLine(form))


def axis_rows(form: Form, node_id: str, spec: FieldSpec) -> None:
    """A slider for each axis of the font, and the axes in words."""
    rows = AxisRows(form, node_id, spec)
    form.column.addWidget(rows)
    form.line(spec.label, rows.words, spec.tip)


def feature_rows(form: Form, node_id: str, spec: FieldSpec) -> None:
    """The features in words, with a menu of those that the font has."""
    form.line(spec.label, FeatureRow(form, node_id, spec), spec.tip)


def slant_slider(form: Form, node_id: str, spec: FieldSpec) -> None:
    """Below the slant's number, which also takes angles beyond the slider's limits."""
    edit = field_edit(form.session, node_id, spec)
    slider = ValueSlider(
        (-LEAN, 0.0, LEAN),
        lambda value: form.tell(edit.preview(value)),
        lambda value: form.tell(edit.commit(value)),
        edit.cancel,
        form,
    )
    slider.setObjectName(f"{spec.name}_slider")
    slider.setAccessibleName(f"{spec.label}, from {-LEAN:g} to {LEAN:g} degrees")
    slider.setToolTip(f"{spec.tip}, from {-LEAN:g}° to {LEAN:g}°\nA double click makes it upright")

    def refresh(node: Node, values: dict[str, float]) -> None:
        now = getattr(node, spec.name)
        slider.setEnabled(isinstance(now, float))  # an expression is changed in its field
        if isinstance(now, float):
            slider.show_number(resolved(now, values), form.session.previewing)

    form.rows.append(refresh)
    room = QLabel(form)
    room.setFixedWidth(UNIT_WIDTH)
    line = QHBoxLayout()
    line.setSpacing(8)
    line.addWidget(slider, 1)
    line.addWidget(room)
    line.setContentsMargins(LABEL_WIDTH + 8, 0, 0, 0)
    form.column.addLayout(line)


ROWS = {"font": font_rows, "axes": axis_rows, "features": feature_rows}
"""What makes the rows of a field of lettering, by its name, in the place of those that its type has."""
