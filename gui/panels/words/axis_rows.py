"""A slider for each axis of a variable font."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QHBoxLayout, QLabel, QVBoxLayout, QWidget

from ....model.document.errors import Refusal
from ....model.document.fields import FieldSpec
from ....model.document.nodes import Node
from ....model.document.tree import find
from ....model.lettering.fonts.face import Axis
from ..property_edit import field_edit
from ..property_fields import LABEL_WIDTH
from .face_of_node import face_in_use
from .settings_text import settings_in, with_axis
from .text_rows import LineRow
from .value_slider import ValueSlider

if TYPE_CHECKING:
    from ..form import Form

VALUE_WIDTH = 44


class AxisRows(QWidget):
    """The sliders follow the font: other axes make other sliders. `words` is the row with the axes written out."""

    def __init__(self, form: Form, node_id: str, spec: FieldSpec) -> None:
        super().__init__(form)
        self._form, self._node_id, self._name = form, node_id, spec.name
        self._edit = field_edit(form.session, node_id, spec)
        self._tip = spec.tip
        self._axes: tuple[Axis, ...] = ()
        self._sliders: dict[str, tuple[ValueSlider, QLabel]] = {}
        self.words = LineRow(form, node_id, spec)
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        self._column.setSpacing(6)
        form.rows.append(self._refresh)

    def _refresh(self, node: Node, values: dict[str, float]) -> None:
        face = face_in_use(self._form.session.document, node, values)
        axes = face.axes if face is not None else ()
        if axes != self._axes:
            self._axes = axes
            self._build()
        text = str(getattr(node, self._name))
        self.words.setEnabled(bool(axes or text))
        name = face.name if face is not None else "The font"
        self.words.setToolTip(self._tip if axes else f"{name} has no variable axes")
        now = settings_in(text, "axes")
        for axis in axes:
            slider, value = self._sliders[axis.tag]
            number = now.get(axis.tag)
            number = axis.default if number is None else number
            slider.show_number(number, self._form.session.previewing)
            value.setText(f"{number:.5g}")
        self.setVisible(bool(axes))

    def _build(self) -> None:
        while (item := self._column.takeAt(0)) is not None:
            row = item.widget()
            if row is not None:
                row.hide()
                row.deleteLater()
        self._sliders = {axis.tag: self._row(axis) for axis in self._axes}

    def _row(self, axis: Axis) -> tuple[ValueSlider, QLabel]:
        body = QWidget(self)
        label = QLabel(f"{axis.name or axis.tag} axis", body)  # lettering has a weight of its own
        label.setWordWrap(True)
        label.setProperty("muted", True)
        label.setFixedWidth(LABEL_WIDTH)
        label.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        slider = ValueSlider(
            (axis.low, axis.default, axis.high),
            partial(self._change, self._edit.preview, axis),
            partial(self._change, self._edit.commit, axis),
            self._edit.cancel,
            body,
        )
        slider.setObjectName(f"axis_{axis.tag}")
        slider.setAccessibleName(f"{axis.name or axis.tag}, from {axis.low:g} to {axis.high:g}")
        tip = f"{axis.tag}, from {axis.low:g} to {axis.high:g}\nA double click goes back to {axis.default:g}"
        slider.setToolTip(tip)
        label.setToolTip(tip)
        value = QLabel(body)
        value.setProperty("muted", True)
        value.setFixedWidth(VALUE_WIDTH)
        line = QHBoxLayout(body)
        line.setContentsMargins(0, 0, 0, 0)
        line.setSpacing(8)
        line.addWidget(label)
        line.addWidget(slider, 1)
        line.addWidget(value)
        self._column.addWidget(body)
        return slider, value

    def _change(self, how: Callable[[str], str | None], axis: Axis, value: float) -> None:
        try:
            text = str(getattr(find(self._form.session.document, self._node_id), self._name))
        except Refusal:
            return
        self._form.tell(how(with_axis(text, axis.tag, value, axis.default)))
