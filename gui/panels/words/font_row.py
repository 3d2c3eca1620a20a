"""The font of lettering: chosen from a list, typed, or opened from a file."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QDragEnterEvent, QDropEvent
from PySide6.QtWidgets import QComboBox, QCompleter, QHBoxLayout, QToolButton, QWidget

from ....model.document.fields import FieldSpec
from ....model.document.nodes import Node
from ....model.lettering.fonts.library import ENDINGS
from ...icons import icon
from ..property_edit import field_edit
from ..text_line import TextLine
from .font_file import ask_font_file, set_font, take_font_file

if TYPE_CHECKING:
    from ..form import Form


class FontRow(QWidget):
    """The list and the button that opens a font file; files can be dropped on both."""

    def __init__(self, form: Form, node_id: str, spec: FieldSpec) -> None:
        super().__init__(form)
        self._session, self._node_id = form.session, node_id
        self.setAcceptDrops(True)
        self.list = FontList(form, node_id, spec)
        self.button = QToolButton(self)
        self.button.setObjectName("open_font")
        self.button.setAccessibleName("Open font file")
        self.button.setProperty("flat", True)
        self.button.setIcon(icon("open"))
        self.button.setToolTip("Open a font file, which the project then carries")
        self.button.clicked.connect(lambda: ask_font_file(self.window(), self._session, node_id))
        line = QHBoxLayout(self)
        line.setContentsMargins(0, 0, 0, 0)
        line.setSpacing(4)
        line.addWidget(self.list, 1)
        line.addWidget(self.button)

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        if _fonts_in(event):
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:
        paths = _fonts_in(event)
        if paths:
            event.acceptProposedAction()
            take_font_file(self.window(), self._session, self._node_id, paths[0])


def _fonts_in(event: QDropEvent) -> list[Path]:
    paths = [Path(url.toLocalFile()) for url in event.mimeData().urls() if url.isLocalFile()]
    return [path for path in paths if path.suffix.lower() in ENDINGS]


class FontList(QComboBox):
    """A font by its name; the list is read when it is first needed. A name takes the place of a font file."""

    def __init__(self, form: Form, node_id: str, spec: FieldSpec) -> None:
        super().__init__(form)
        self._form, self._node_id, self._name = form, node_id, spec.name
        self._edit = field_edit(form.session, node_id, spec)
        self._now, self._by_file = "", False
        self.setObjectName(spec.name)
        self.setAccessibleName(spec.label)
        self.setEditable(True)
        self.setInsertPolicy(QComboBox.InsertPolicy.NoInsert)
        self.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.setMinimumContentsLength(10)
        self._line = TextLine(parent=self)
        self._line.setAcceptDrops(False)  # the row takes files
        self.setLineEdit(self._line)
        self._line.installEventFilter(self)
        self.textActivated.connect(self._keep)
        self._line.editingFinished.connect(self._typed)
        form.rows.append(self._refresh)

    def _refresh(self, node: Node, values: dict[str, float]) -> None:
        self._now = str(getattr(node, self._name))
        self._by_file = bool(getattr(node, "asset", "") or getattr(node, "face", 0.0))
        if not (self._line.hasFocus() and self._line.isModified()) and self._line.text() != self._now:
            self._show(self._now)

    def _show(self, text: str) -> None:
        """Also in the list, or leaving the field would choose what it stands at."""
        self.blockSignals(True)
        self.setCurrentIndex(self.findText(text))
        self.setEditText(text)
        self.blockSignals(False)

    def _typed(self) -> None:
        if self._line.isModified() and self._line.text() != self._now:
            self._keep(self._line.text())
        self._line.setModified(False)

    def _keep(self, text: str) -> None:
        self._line.setModified(False)
        if self._by_file:
            self._form.tell(set_font(self._form.session, self._node_id, text))
        elif text != self._now:
            self._form.tell(self._edit.commit(text))

    def _list(self) -> None:
        if self.count():
            return
        from ....model.lettering.fonts.library import BUNDLED, installed

        text = self.currentText()
        self.blockSignals(True)
        carried = [font.name for font in self._form.session.document.fonts]
        for name in carried:
            self._add(name, "In the project")
        for face in installed():
            if face.name not in carried:
                self._add(face.name, "Comes with Solidtree" if face.path.name in BUNDLED else str(face.path))
        self.blockSignals(False)
        self._show(text)
        completer = self.completer()
        if completer is not None:
            completer.setCompletionMode(QCompleter.CompletionMode.PopupCompletion)
            completer.setFilterMode(Qt.MatchFlag.MatchContains)

    def _add(self, name: str, tip: str) -> None:
        self.addItem(name)
        self.setItemData(self.count() - 1, tip, Qt.ItemDataRole.ToolTipRole)

    def showPopup(self) -> None:
        self._list()
        super().showPopup()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.FocusIn:
            self._list()
        return super().eventFilter(watched, event)
