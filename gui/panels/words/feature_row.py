"""OpenType features: written out, or ticked in a menu of those that the font has."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QHBoxLayout, QMenu, QToolButton, QWidget

from ....model.document.fields import FieldSpec
from ....model.document.nodes import Node
from ....model.document.tree import find
from ...icons import icon
from ..property_edit import field_edit
from .face_of_node import face_in_use
from .settings_text import FEATURES, NEEDED, feature_name, feature_on, with_feature
from .text_rows import LineRow

if TYPE_CHECKING:
    from ..form import Form


class TickMenu(QMenu):
    """Stays open while its boxes are ticked."""

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        action = self.actionAt(event.position().toPoint())
        if action is not None and action.isCheckable():
            action.trigger()
        else:
            super().mouseReleaseEvent(event)


class FeatureRow(QWidget):
    def __init__(self, form: Form, node_id: str, spec: FieldSpec) -> None:
        super().__init__(form)
        self._form, self._node_id, self._name = form, node_id, spec.name
        self._edit = field_edit(form.session, node_id, spec)
        self._tags: tuple[str, ...] = ()
        self.words = LineRow(form, node_id, spec)
        self.words.setToolTip(spec.tip)
        self.button = QToolButton(self)
        self.button.setObjectName("font_features")
        self.button.setAccessibleName("Features of the font")
        self.button.setProperty("flat", True)
        self.button.setIcon(icon("more"))
        self.button.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.menu = TickMenu(self.button)
        self.button.setMenu(self.menu)
        line = QHBoxLayout(self)
        line.setContentsMargins(0, 0, 0, 0)
        line.setSpacing(4)
        line.addWidget(self.words, 1)
        line.addWidget(self.button)
        form.rows.append(self._refresh)

    def _refresh(self, node: Node, values: dict[str, float]) -> None:
        face = face_in_use(self._form.session.document, node, values)
        tags = tuple(tag for tag in dict.fromkeys(face.features) if tag not in NEEDED) if face is not None else ()
        if tags != self._tags:
            self._tags = tags
            self._build()
        name = face.name if face is not None else "The font"
        self.button.setEnabled(bool(tags))
        self.button.setToolTip(f"Features of {name}" if tags else f"{name} has no features to choose")
        for action in self.menu.actions():
            action.setChecked(feature_on(str(getattr(node, self._name)), str(action.data())))

    def _build(self) -> None:
        self.menu.clear()
        for tag in sorted(self._tags, key=lambda tag: (tag not in FEATURES, feature_name(tag).casefold(), tag)):
            words = feature_name(tag)
            action = self.menu.addAction(words if words == tag else f"{words}\t{tag}")
            action.setCheckable(True)
            action.setData(tag)
            action.triggered.connect(lambda on, tag=tag: self._tick(tag, on))

    def _tick(self, tag: str, on: bool) -> None:
        text = str(getattr(find(self._form.session.document, self._node_id), self._name))
        self._form.tell(self._edit.commit(with_feature(text, tag, on)))
